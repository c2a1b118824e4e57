//! The measurement of this case against the exact flow, and coarse runs.

use transpoint::Observation;
use transpoint::simulation::PointState;

use super::*;
use crate::case::Outcome;

fn parameters(layout: &str, flow: &str, level: usize) -> Parameters {
    let spec = spec(Variant::Tpm, layout, flow, level);
    serde_json::from_value(spec.parameters).expect("parameters of this case")
}

/// The exact flow at an instant, plus a constant.
fn state(parameters: &Parameters, time: f64, offset: f64) -> Observation<2> {
    let points = scene::scene(parameters).points.into_iter().enumerate().map(|(id, point)| {
        let u = scene::exact(&parameters.flow, point.position[1], time);
        PointState {
            id: id as u32,
            position: point.position,
            velocity: [u + offset, 0.0],
            density: point.density,
            pressure: 0.0,
            mass: point.mass,
            energy: 0.0,
            stress: [[0.0; 2]; 2],
            velocity_gradient: [[0.0; 2]; 2],
            density_slope: [0.0; 2],
        }
    });
    Observation { time, points: points.collect() }
}

#[test]
fn the_exact_flow_has_no_error_at_points_and_a_constant_is_found() {
    for flow in FLOWS {
        for layout in LAYOUTS {
            let parameters = parameters(layout, flow, 1);
            let scene = scene::scene(&parameters);
            let measured = |offset| {
                let state = state(&parameters, 0.1, offset);
                scene::measure(&parameters, &scene, &state, "0.1")
            };
            let rows = measured(0.0);
            assert!(rows[0].value < 1e-15 && rows[2].value < 1e-15, "{flow} {layout}");
            // Linear fits to a curved profile.
            assert!(rows[1].value < 5e-3 * rows[1].scale, "{flow} {layout} {}", rows[1].value);
            let rows = measured(0.01);
            // On the length of 1 m: √(1 m · H) 0.01 m/s, and half the points.
            assert!((rows[0].value - 0.01).abs() < 1e-12, "{flow} {layout} {}", rows[0].value);
            assert!((rows[2].value / 0.01 - 0.5f64.sqrt()).abs() < 0.03, "{flow} {layout}");
        }
    }
}

#[test]
fn flows_reach_the_velocity_of_the_scale_and_scenes_start_as_they_should() {
    assert!((scene::exact("poiseuille", 0.5, 9.0) - scene::VELOCITY).abs() < 1e-12);
    assert!((scene::exact("couette", 1.0, 9.0) - scene::VELOCITY).abs() < 1e-12);
    for flow in ["couette", "poiseuille"] {
        let scene = scene::scene(&parameters("regular", flow, 0));
        assert!(scene.points.iter().all(|point| point.velocity == [0.0; 2]));
        assert_eq!(scene.body_force[0] > 0.0, flow == "poiseuille");
    }
    let ramp = scene::scene(&parameters("regular", "couette-ramp", 0));
    let moving = ramp.points.iter().filter(|point| point.velocity[0] > 0.0);
    assert!(moving.clone().all(|point| point.position[1] > 0.875));
    // Two rows of eight points, at a quarter and three quarters of the cell.
    assert_eq!(moving.map(|point| point.velocity[0]).sum::<f64>(), 8.0);
}

#[test]
fn instants_are_whole_numbers_of_steps() {
    for flow in FLOWS {
        for level in 0..CELLS.len() {
            let parameters = parameters("regular", flow, level);
            for (name, step) in &parameters.instants {
                let at = parameters.dt * *step as f64;
                let named: f64 = name.parse().expect("a number");
                assert!((at / named - 1.0).abs() < 1e-12, "{flow} {level} {name}");
            }
        }
    }
}

#[test]
fn coarse_runs_work_for_every_variant() {
    for variant in Variant::CORE {
        for flow in FLOWS {
            let findings =
                ShearStartup.execute(&spec(variant, "jittered", flow, 0), &Progress::silent());
            assert_eq!(findings.rows.len(), 6);
            if findings.outcome == Outcome::Completed {
                assert!(findings.rows.iter().all(|row| row.value.is_finite()));
            }
        }
    }
}

#[test]
fn every_run_has_its_own_file() {
    let mut slugs: Vec<_> = ShearStartup.runs(Tier::Full).iter().map(RunSpec::slug).collect();
    let n = slugs.len();
    slugs.sort();
    slugs.dedup();
    let expected = 22 * Variant::CORE.len();
    assert_eq!((slugs.len(), n), (expected, expected));
}
