//! The measurement of this case against the exact wave, and coarse runs.

use transpoint::Observation;
use transpoint::simulation::PointState;

use super::*;
use crate::case::Outcome;

fn parameters(layout: &str, level: usize) -> Parameters {
    let spec = spec(Variant::Tpm, layout, level);
    serde_json::from_value(spec.parameters).expect("parameters of this case")
}

/// The exact wave at a time that differs from the time of the state by a delay.
fn state(parameters: &Parameters, time: f64, share: f64, delay: f64) -> Observation<1> {
    let bar = scene::BAR;
    let at = time - delay;
    let points = scene::scene(parameters).points.into_iter().enumerate().map(|(id, point)| {
        let [x] = point.position;
        PointState {
            id: id as u32,
            position: [x],
            velocity: [share * bar.velocity(x, at - 0.5 * parameters.dt)],
            density: point.density,
            pressure: share * bar.pressure(x, at),
            mass: point.mass,
            energy: 0.0,
            stress: [[share * bar.deviatoric_axial(x, at)]],
            velocity_gradient: [[0.0; 1]; 1],
            density_slope: [0.0; 1],
        }
    });
    Observation { time, points: points.collect() }
}

#[test]
fn the_exact_wave_has_no_error_at_points_and_second_order_at_cell_centers() {
    let period = scene::BAR.period();
    for layout in LAYOUTS {
        for time in [0.25 * period, period] {
            let mut at_centers = Vec::new();
            for level in [0, 4] {
                let parameters = parameters(layout, level);
                let scene = scene::scene(&parameters);
                let state = state(&parameters, time, 1.0, 0.0);
                let errors = scene::errors(&parameters, &scene, &state);
                assert_eq!(2 * errors.len() + 2, scene::missing_rows().len());
                assert!(errors.iter().step_by(2).all(|(error, _)| *error < 1e-12), "{layout}");
                // The field that is not zero at this time.
                let largest = if time < 0.5 * period { errors[1] } else { errors[5] };
                at_centers.push((1.0 / parameters.cells as f64, largest.0));
            }
            let order = convergence::slope(&at_centers);
            assert!(order > 1.8, "{layout}: {order}");
        }
    }
}

#[test]
fn a_late_and_low_wave_is_found_so() {
    let period = scene::BAR.period();
    for layout in LAYOUTS {
        let parameters = parameters(layout, 2);
        let [phase, loss] =
            scene::phase_and_loss(&parameters, &state(&parameters, period, 1.0, 0.0));
        assert!(phase.abs() < 1e-12 && loss.abs() < 1e-12, "{layout} {phase} {loss}");
        let late = state(&parameters, period, 0.98, 0.01 * period);
        let [phase, loss] = scene::phase_and_loss(&parameters, &late);
        assert!((phase + 0.01).abs() < 1e-10, "{layout} {phase}");
        assert!((loss - 0.02).abs() < 1e-10, "{layout} {loss}");
    }
}

#[test]
fn a_quarter_of_a_period_is_a_whole_number_of_steps_of_the_courant_number() {
    for level in 0..CELLS.len() {
        let parameters = parameters("regular", level);
        let quarter = parameters.dt * parameters.quarter as f64;
        assert!((quarter / scene::BAR.period() - 0.25).abs() < 1e-14);
        let courant = scene::BAR.wave_speed() * parameters.dt * parameters.cells as f64;
        assert!((courant / COURANT - 1.0).abs() < 1e-12, "{courant}");
    }
}

#[test]
fn coarse_runs_work_for_every_variant() {
    for variant in Variant::CORE {
        for layout in LAYOUTS {
            let findings = ElasticBarWave.execute(&spec(variant, layout, 0), &Progress::silent());
            assert_eq!(findings.outcome, Outcome::Completed, "{}", variant.name());
            assert!(findings.rows.iter().all(|row| row.value.is_finite()));
        }
    }
}

#[test]
fn every_run_has_its_own_file() {
    let mut slugs: Vec<_> = ElasticBarWave.runs(Tier::Full).iter().map(RunSpec::slug).collect();
    let n = slugs.len();
    slugs.sort();
    slugs.dedup();
    let expected = 10 * Variant::CORE.len();
    assert_eq!((slugs.len(), n), (expected, expected));
}
