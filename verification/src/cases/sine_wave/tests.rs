//! The measurement of this case against states that are known exactly.

use transpoint::simulation::PointState;
use transpoint::variants::StressUpdate;
use transpoint::{Observation, Scene};

use super::scene::{measure, scene, times, wave};
use super::*;
use crate::case::Row;

fn parameters(level: usize, layout: &str, dimension: usize, axis: usize) -> Parameters {
    let spec = spec(Variant::Mpm, layout, INSTANTS[1], level, dimension, axis);
    serde_json::from_value(spec.parameters).expect("parameters of this case")
}

/// The exact state at the points of the scene, as a symplectic scheme would hold it.
fn exact_state<const D: usize>(parameters: &Parameters, scene: &Scene<D>) -> Observation<D> {
    let time = parameters.dt * parameters.steps as f64;
    let wave = wave(parameters);
    let axis = parameters.axis;
    let points = scene.points.iter().enumerate().map(|(id, point)| {
        let material = point.position[axis];
        let mut position = point.position;
        position[axis] += wave.displacement(material, time);
        let mut velocity = [0.0; D];
        velocity[axis] = wave.velocity(material, time - 0.5 * parameters.dt);
        PointState {
            id: id as u32,
            position,
            velocity,
            density: wave.density(material, time),
            pressure: wave.pressure(material, time),
            mass: point.mass,
            energy: 0.0,
            stress: [[0.0; D]; D],
            velocity_gradient: [[0.0; D]; D],
            density_slope: [0.0; D],
        }
    });
    Observation { time, points: points.collect() }
}

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    rows.iter()
        .find(|row| row.quantity == format!("{quantity}@T/4") && row.norm == norm)
        .map_or(f64::NAN, |row| row.value)
}

#[test]
fn the_exact_state_has_no_error_at_points_and_second_order_at_cell_centres() {
    for layout in LAYOUTS {
        let mut errors = Vec::new();
        for level in [0, 1] {
            let parameters = parameters(level, layout, 2, 0);
            let scene = scene::<2>(&parameters);
            let measured =
                measure(&parameters, &scene, &exact_state(&parameters, &scene), "T/4").rows;
            assert!(value(&measured, "pressure", "point-l2") < 1e-12, "{layout}");
            assert!(value(&measured, "velocity", "point-l2") < 1e-18, "{layout}");
            errors.push((parameters.spacing, value(&measured, "pressure", "gauss-l2")));
        }
        let order = convergence::slope(&errors);
        assert!((order - 2.0).abs() < 0.15, "{layout}: {order}");
    }
}

#[test]
fn norms_of_the_exact_field_are_those_of_a_standing_wave_on_a_tenth_of_a_square_metre() {
    let parameters = parameters(2, "regular", 2, 1);
    let scene = scene::<2>(&parameters);
    let rows = measure(&parameters, &scene, &exact_state(&parameters, &scene), "T/4").rows;
    let amplitude = 1000.0 * 50f64.powi(2) * 1e-6 * std::f64::consts::TAU;
    for row in rows.iter().filter(|row| row.quantity.starts_with("pressure")) {
        assert!((row.scale / (amplitude * 0.05f64.sqrt()) - 1.0).abs() < 1e-5, "{}", row.norm);
    }
}

#[test]
fn scenes_along_different_axes_differ_by_a_permutation() {
    for layout in LAYOUTS {
        let along_x = scene::<2>(&parameters(0, layout, 2, 0));
        let along_y = scene::<2>(&parameters(0, layout, 2, 1));
        assert_eq!(along_x.grid.cells, [50, 5]);
        assert_eq!(along_y.grid.cells, [5, 50]);
        for (a, b) in along_x.points.iter().zip(&along_y.points) {
            assert_eq!(a.position, [b.position[1], b.position[0]]);
            assert_eq!(a.velocity, [b.velocity[1], b.velocity[0]]);
        }
        let a = scene::<3>(&parameters(0, layout, 3, 0));
        let b = scene::<3>(&parameters(0, layout, 3, 2));
        for (a, b) in a.points.iter().zip(&b.points) {
            assert_eq!(a.position, [b.position[2], b.position[0], b.position[1]]);
        }
    }
}

#[test]
fn jitter_stays_within_its_bounds_and_is_the_same_every_time() {
    let parameters = parameters(1, "jittered", 2, 0);
    let (regular, jittered) =
        (scene::<2>(&Parameters { jitter: 0.0, ..parameters }), scene::<2>(&parameters));
    let spacing = 0.5 * parameters.spacing;
    let shifts: Vec<f64> = regular
        .points
        .iter()
        .zip(&jittered.points)
        .flat_map(|(a, b)| [0, 1].map(|axis| (b.position[axis] - a.position[axis]) / spacing))
        .collect();
    assert!(shifts.iter().all(|shift| shift.abs() <= JITTER + 1e-12));
    let mean = shifts.iter().sum::<f64>() / shifts.len() as f64;
    let spread = shifts.iter().map(|shift| shift * shift).sum::<f64>() / shifts.len() as f64;
    assert!(mean.abs() < 0.01, "{mean}");
    assert!((spread / (JITTER * JITTER / 3.0) - 1.0).abs() < 0.05, "{spread}");
    assert_eq!(jittered, scene::<2>(&parameters));
}

/// Worst error of the velocity of x″ = −ω² x after 100 steps of symplectic Euler.
fn oscillator_error(stress_update: StressUpdate, dt: f64) -> (f64, f64) {
    let (w, mut x, mut v) = (1.0f64, 0.0f64, 1.0f64);
    let steps = (std::f64::consts::FRAC_PI_2 / dt).round() as i32;
    for _ in 0..steps {
        if stress_update == StressUpdate::First {
            x += dt * v;
            v -= dt * w * w * x;
        } else {
            v -= dt * w * w * x;
            x += dt * v;
        }
    }
    let (time_x, time_v) = times(stress_update, dt * f64::from(steps), dt);
    ((x - (w * time_x).sin()).abs(), (v - (w * time_v).cos()).abs())
}

#[test]
fn at_the_staggered_times_symplectic_euler_is_second_order() {
    for stress_update in [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast] {
        let coarse = oscillator_error(stress_update, 1e-2);
        let fine = oscillator_error(stress_update, 1e-3);
        assert!(coarse.0 < 1e-4 && coarse.1 < 1e-4, "{stress_update:?}: {coarse:?}");
        assert!(fine.0 < 1e-6 && fine.1 < 1e-6, "{stress_update:?}: {fine:?}");
    }
}

#[test]
fn every_run_has_its_own_file() {
    let mut slugs: Vec<_> = SineWave.runs(Tier::Full).iter().map(RunSpec::slug).collect();
    let n = slugs.len();
    slugs.sort();
    slugs.dedup();
    assert_eq!(slugs.len(), n);
    assert!(slugs.iter().all(|slug| !slug.contains(['/', ' '])));
}
