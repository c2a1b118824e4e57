use super::{Operators, spec};
use crate::case::{Case, Outcome, Tier};
use crate::progress::Progress;

#[test]
fn smoke_runs_of_every_operator_are_finite() {
    let runs = Operators.runs(Tier::Smoke);
    assert_eq!(runs.len(), 22 * 3 * 3);
    for spec in runs.iter().filter(|spec| spec.level == 1) {
        let findings = Operators.execute(spec, &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed, "{}", spec.slug());
        assert!(findings.rows.iter().all(|row| row.value.is_finite()), "{findings:?}");
    }
}

/// The hat at a lattice of cell quarters: f − If = −(h²/2) ξ(1 − ξ) f″ per axis, with ξ = ¼ the
/// factor is 3/32 (2π)² h² on each axis, 2·3/32·(2π)² h² f in all.
#[test]
fn error_of_linear_interpolation_is_the_known_one() {
    let level = 4;
    let findings = Operators.execute(&spec("linear", "regular", level), &Progress::silent());
    let row = findings.rows.iter().find(|row| row.quantity == "value@interior").unwrap();
    let h = 1.0 / 128.0;
    let exact = 2.0 * 3.0 / 32.0 * (std::f64::consts::TAU * h).powi(2);
    assert!(
        (row.value / row.scale / exact - 1.0).abs() < 2e-3,
        "{} {exact}",
        row.value / row.scale
    );
}

/// A regular lattice is symmetric about each centre, so that even the constant basis is of second
/// order there: order alone on a lattice says nothing.
#[test]
fn on_a_lattice_every_reconstruction_is_of_second_order() {
    for operator in ["carried", "shepard", "mls1-r1"] {
        let error = |level| {
            let findings =
                Operators.execute(&spec(operator, "regular", level), &Progress::silent());
            findings.rows.iter().find(|row| row.quantity == "center@interior").unwrap().value
        };
        let order = (error(2) / error(3)).log2();
        assert!((order - 2.0).abs() < 0.1, "{operator}: {order}");
    }
}
