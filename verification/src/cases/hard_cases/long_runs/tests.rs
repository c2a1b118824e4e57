use super::*;
use transpoint::Variant;

/// Periods whose energies fall by 1 % and whose kinetic energies grow by a rate, with noise of a size.
fn series(rate: f64, noise: f64) -> Periods {
    let mut periods = Periods::new(2.0, 81.0);
    for step in 0..810 {
        let time = 0.1 * f64::from(step);
        let n = (0.5 * time).floor().min(39.0);
        let sign = if n % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let kinetic = (rate * n + sign * noise).exp();
        let state = State { kinetic, largest_velocity: 0.3, ..State::default() };
        periods.add(time, 5.0 * 0.99_f64.powf(n), &state);
    }
    periods
}

#[test]
fn drifts_and_rates_of_known_series() {
    let found = series(0.01, 0.0).measure(2.0, 0.5, 9);
    let exact = [
        -0.01,
        0.01,
        0.01,
        0.99_f64.powi(39) - 1.0,
        2.0 * 0.09_f64.exp().sqrt(),
        2.0 * 0.39_f64.exp().sqrt(),
        0.6,
    ];
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-9, "{found} {exact}");
    }
    assert_eq!(drift(1.0, -0.1, 10), -1.0);
}

#[test]
fn noise_is_no_growth() {
    let of = |rate, noise| series(rate, noise).measure(1.0, 1.0, 0)[1];
    assert!(of(0.0, 0.3) < 1e-3);
    assert!(of(0.1, 0.3) > 0.05);
}

#[test]
fn the_error_of_a_slope_is_that_of_its_residuals() {
    let (slope, error) = slope_with_error(&[(0.0, 1.0), (1.0, -2.0), (2.0, 1.0)]);
    // Residuals 1, −2, 1: √(6/1/2).
    assert!(slope.abs() < 1e-15 && (error - 3.0_f64.sqrt()).abs() < 1e-15, "{slope} {error}");
}

/// A drop that starts as the round one has the energy of its motion, M A₀² R²/4.
#[test]
fn the_energy_of_the_drop_is_that_of_its_motion() {
    let scene = drop().set_up(&resolution(DROP.0)).scene;
    let trial = Trial { variant: Variant::Mpm, builder: &Variant::Mpm };
    let settings = trial.surface(2, scene.grid.spacing[0], DROP.1, INFLOW_RELAXATION);
    let simulation = trial.plane(&scene, &settings).expect("a simulation");
    let state = State::of(simulation.as_ref(), &|_| 0.0, (1000.0, DROP.1));
    let ratio = state.kinetic / (state.mass * 0.0625);
    assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    assert!(state.stored > 0.0 && state.stored < 0.1 * state.kinetic, "{state:?}");
}
