use transpoint::variants::StressUpdate;
use transpoint::{Scene, Settings, Variant};

use super::Spectral;
use super::step::{Step, scene};
use crate::case::{Case, Outcome, Tier};
use crate::measure::spectral::{jacobian, spectrum};
use crate::progress::Progress;

/// One point at the centre of each of 8 cells.
fn centered() -> Scene<1> {
    let mut scene = scene::<1>(8, 0.0, 1);
    scene.points.truncate(8);
    for (cell, point) in scene.points.iter_mut().enumerate() {
        point.position = [cell as f64 + 0.5];
        point.mass = 1.0;
    }
    scene
}

/// Linear MPM with one centred point per cell has, for the wave number k and s = sin(kh/2), the
/// eigenvalue pair with determinant 1 − (2 C s²)² if stress is updated last and 1 if modified-last.
#[test]
fn determinant_of_linear_mpm_is_the_known_one() {
    for (stress_update, damps) in [(StressUpdate::Last, 1.0), (StressUpdate::ModifiedLast, 0.0)] {
        let settings = Settings { stress_update, ..Settings::default() };
        let courant = 0.4;
        let mut step = Step {
            variant: Variant::Mpm,
            settings: &settings,
            build: &|scene, settings| Variant::Mpm.build_1d(scene, settings),
            scene: centered(),
            dt: courant,
            period: 1,
        };
        let base = step.base();
        let matrix = jacobian(&base, |state, after| step.advance(state, after)).unwrap();
        let exact: f64 = (0..8)
            .map(|k| (std::f64::consts::PI * f64::from(k) / 8.0).sin())
            .map(|s| 1.0 - damps * (2.0 * courant * s * s).powi(2))
            .product();
        assert!((matrix.determinant() - exact).abs() < 1e-11, "{} {exact}", matrix.determinant());
        assert!(spectrum(&matrix).growth().abs() < 1e-11);
    }
}

/// What a step of the map leaves is what the points of the simulation show, affine field included.
#[test]
fn the_affine_field_is_part_of_the_map() {
    let settings = Settings::default();
    let mut step = Step {
        variant: Variant::Apic,
        settings: &settings,
        build: &|scene, settings| Variant::Apic.build_2d(scene, settings),
        scene: scene::<2>(4, 0.5, 3),
        dt: 0.3,
        period: 1,
    };
    let mut state = step.base();
    for (k, value) in state.iter_mut().enumerate() {
        *value += 0.01 * (k as f64).sin();
    }
    let (mut found, width) = (vec![0.0; state.len()], step.width());
    step.advance(&state, &mut found).unwrap();
    let mut simulation = Variant::Apic.build_2d(&step.scene, &settings).unwrap();
    simulation.step(0.3).unwrap();
    for (values, point) in found.chunks(width).zip(simulation.observe().points) {
        assert_eq!(values[..2], point.velocity);
        assert_eq!(values[2], point.density);
        assert_eq!(values[3..], *point.velocity_gradient.as_flattened());
    }
    assert!(found.chunks(width).any(|values| values[3].abs() > 1e-4));
}

#[test]
fn smoke_runs_measure_every_method() {
    let runs = Spectral.runs(Tier::Smoke);
    assert_eq!(runs.len(), 2 * Variant::CORE.len());
    for spec in runs.iter().filter(|spec| spec.layout == "1d") {
        let findings = Spectral.execute(spec, &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed, "{}", spec.slug());
        assert!(findings.rows.iter().all(|row| row.value.is_finite()), "{findings:?}");
        let growth = findings.rows[0].value;
        // Divergence from the gradient at the points grows; cubic splines are neutral.
        match spec.variant.as_str() {
            "tpm" => assert!(growth > 1e-3, "{growth}"),
            "bspline3" | "apic" => assert!(growth <= 1e-10, "{growth}"),
            _ => {}
        }
    }
}
