use super::*;
use transpoint::Variant;

/// Periods of 20 instants whose potential energies fall by 1 %, and whose kinetic ones grow by a rate, with noise.
fn series(rate: f64, noise: f64) -> Periods {
    let mut periods = Periods::new(2.0, 81.0);
    for step in 0..810 {
        let time = 0.1 * f64::from(step);
        let n = (0.5 * time).floor().min(39.0);
        let sign = if n % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let kinetic = 2e-9 * (rate * n + sign * noise).exp();
        let potential = 5.0 * 0.99_f64.powf(n);
        let state = State { count: 1.0, mass: 2.0, kinetic, potential, compression: 0.0 };
        periods.add(time, (state, 0.3));
    }
    periods
}

const START: State =
    State { count: 1.0, mass: 4.0, kinetic: 0.0, potential: 10.0, compression: 0.0 };

#[test]
fn drifts_and_rates_of_known_series() {
    let found = series(0.01, 0.0).measure(&START, 0.5, 9);
    let velocity = |n: f64| 2.0 * (2e-9 * (0.01 * n).exp()).sqrt();
    let exact = [
        -0.01,
        0.01_f64.exp_m1(),
        0.01,
        0.01,
        0.5,
        0.99_f64.powi(39),
        velocity(9.0),
        velocity(39.0),
        0.6,
    ];
    assert_eq!(found.len(), QUANTITIES.len());
    for (found, exact) in found.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-8, "{found} {exact}");
    }
}

#[test]
fn noise_is_no_growth() {
    let of = |rate, noise| series(rate, noise).measure(&START, 1.0, 0)[2];
    assert!(of(0.0, 0.3) < GROWTH);
    assert!(of(0.1, 0.3) > 0.05);
}

#[test]
fn the_error_of_a_slope_is_that_of_its_residuals() {
    let (slope, error) = slope_with_error(&[(0.0, 1.0), (1.0, -2.0), (2.0, 1.0)]);
    // Residuals 1, −2, 1: √(6/1/2).
    assert!(slope.abs() < 1e-15 && (error - 3.0_f64.sqrt()).abs() < 1e-15, "{slope} {error}");
}

/// M A₀² R²/4 of motion M Ω² R²/4 of the force, and a little of compression.
#[test]
fn the_energies_of_the_drop_are_those_of_a_disk() {
    let scene = drop().set_up(&resolution(DROP.0)).scene;
    let simulation = Variant::Mpm.build_2d(&scene, &transpoint::Settings::default());
    let [x, y] = drop().center();
    let potential = |point: &PointState<2>| {
        0.5 * ((point.position[0] - x).powi(2) + (point.position[1] - y).powi(2))
    };
    let simulation = simulation.expect("a simulation");
    let (state, largest) = State::of(simulation.as_ref(), &potential, (1000.0, DROP.1));
    for (found, exact) in [(state.kinetic, 0.0625), (state.potential, 0.25)] {
        let ratio = found / (state.mass * exact);
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }
    assert!((0.45..0.5).contains(&largest), "{largest}");
    assert!(state.compression > 0.0 && state.compression < 0.1 * state.kinetic, "{state:?}");
}
