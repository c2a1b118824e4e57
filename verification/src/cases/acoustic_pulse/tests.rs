//! The measurement of this case against states that are known exactly, and coarse runs.

use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::*;
use crate::case::{Outcome, Row};
use crate::exact::acoustic::{GaussianBump, PlanePulse};

fn parameters(dimension: usize, level: usize, layout: &str) -> Parameters {
    let spec = spec(Variant::Tpm, layout, dimension, level);
    serde_json::from_value(spec.parameters).expect("parameters of this case")
}

/// The scene with pressure and velocity as given.
fn state<const D: usize>(
    scene: &Scene<D>,
    time: f64,
    field: impl Fn([f64; D]) -> (f64, [f64; D]),
) -> Observation<D> {
    let points = scene.points.iter().enumerate().map(|(id, point)| {
        let (pressure, velocity) = field(point.position);
        PointState {
            id: id as u32,
            position: point.position,
            velocity,
            density: point.density,
            pressure,
            mass: point.mass,
            energy: 0.0,
            stress: [[0.0; D]; D],
            velocity_gradient: [[0.0; D]; D],
            density_slope: [0.0; D],
        }
    });
    Observation { time, points: points.collect() }
}

fn value(rows: &[Row], quantity: &str) -> f64 {
    rows.iter().find(|row| row.quantity == quantity).map_or(f64::NAN, |row| row.value)
}

#[test]
fn the_exact_pulse_in_1d_has_no_error_and_a_late_and_low_one_is_found_so() {
    for layout in LAYOUTS {
        let parameters = parameters(1, 1, layout);
        let scene = scene::scene::<1>(&parameters);
        let time = PATHS[0] / scene::SOUND_SPEED;
        let bump = GaussianBump { center: 0.5, period: Some(1.0), ..scene::BUMP };
        let pulse = PlanePulse {
            initial: |x| bump.value(x),
            density: scene::DENSITY,
            sound_speed: scene::SOUND_SPEED,
        };
        let measured = |share: f64, delay: f64| {
            let state = state(&scene, time, |[x]| {
                let earlier = time - 0.5 * parameters.dt;
                (share * pulse.pressure(x, time - delay), [pulse.velocity(x, earlier)])
            });
            measure::line(&parameters, &scene, &state).rows
        };
        let rows = measured(1.0, 0.0);
        assert_eq!(rows.len(), measure::missing_rows("1d").len());
        for quantity in ["pressure@1d", "velocity@1d"] {
            assert!(value(&rows, quantity).abs() < 1e-14, "{layout} {quantity}");
        }
        // The tail of the other pulse is exp(−200 · 0.25²) = 4e-6 half way, and there each weighs as much.
        for quantity in ["lag@1d", "loss@1d"] {
            assert!(value(&rows, quantity).abs() < 1e-8, "{layout} {quantity}");
        }
        let rows = measured(0.9, 2e-4);
        assert!((value(&rows, "lag@1d") - 2e-4 * 50.0 * 64.0).abs() < 1e-8);
        assert!((value(&rows, "loss@1d") - 0.1).abs() < 1e-8);
    }
}

#[test]
fn the_exact_pulse_in_2d_has_no_error_and_an_oval_one_is_found_so() {
    let parameters = parameters(2, 1, "jittered");
    let scene = scene::scene::<2>(&parameters);
    let time = PATHS[1] / scene::SOUND_SPEED;
    let solution = measure::Radial::new(time, time - 0.5 * parameters.dt);
    let [[_, crest], _] = solution.crest_and_trough();
    let measured = |share: f64| {
        let state = state(&scene, time, |[x, y]| {
            let offset = [x - 0.5, y - 0.5];
            let [pressure, u, v] = solution.at(offset);
            let four_fold = (4.0 * offset[1].atan2(offset[0])).cos();
            (pressure + share * crest * four_fold, [u, v])
        });
        measure::plane(&parameters, &scene, &state).rows
    };
    let rows = measured(0.0);
    assert_eq!(rows.len(), measure::missing_rows("2d").len());
    for row in rows.iter().filter(|row| row.norm != "gauss-l2") {
        assert!(row.value.abs() < 1e-13, "{}", row.quantity);
    }
    // cos 4φ over a sector of π/8 about an axis has the mean sin(π/4)/(π/4) = 0.90.
    let rows = measured(0.01);
    assert!((value(&rows, "axis-less-diagonal@crest") / 0.018 - 1.0).abs() < 0.05);
    assert!(value(&rows, "anisotropy@crest") > 0.005);
}

#[test]
fn interpolation_in_the_table_is_exact_to_ten_digits() {
    let time = PATHS[1] / scene::SOUND_SPEED;
    let table = measure::Radial::new(time, time);
    let pulse = crate::exact::acoustic_radial::RadialPulse {
        amplitude: scene::BUMP.amplitude,
        decay: scene::BUMP.decay,
        density: scene::DENSITY,
        sound_speed: scene::SOUND_SPEED,
    };
    for i in 0..70 {
        let r = 0.010_03 * f64::from(i);
        let [pressure, velocity] = table.along(r);
        let impedance = scene::DENSITY * scene::SOUND_SPEED;
        assert!((pressure - pulse.pressure(r, time)).abs() < 1e-9 * scene::BUMP.amplitude);
        let gap = impedance * (velocity - pulse.velocity(r, time));
        assert!(gap.abs() < 1e-9 * scene::BUMP.amplitude, "{r}: {gap}");
    }
}

#[test]
fn the_scene_has_the_mass_of_the_bump_and_starts_half_a_step_back() {
    let parameters = parameters(2, 2, "regular");
    let scene = scene::scene::<2>(&parameters);
    let excess: f64 =
        scene.points.iter().map(|p| p.mass - scene::DENSITY * p.mass / p.density).sum();
    let bump = 2500.0 * 1e-3 * std::f64::consts::PI / 200.0 / 2500.0;
    assert!((excess / bump - 1.0).abs() < 1e-6, "{excess} {bump}");
    let solution = measure::Radial::new(0.0, -0.5 * parameters.dt);
    // Half a step of the steepest pressure, A √(2a/e) / ρ₀.
    let fastest = 0.5 * parameters.dt * 2.5e-3 * (400.0 / 1f64.exp()).sqrt();
    for point in &scene.points {
        let [_, u, v] = solution.at(point.position.map(|x| x - 0.5));
        let gap = (u - point.velocity[0]).hypot(v - point.velocity[1]);
        assert!(gap < 2e-3 * fastest, "{:?}", point.position);
    }
}

#[test]
fn coarse_runs_work_for_every_variant() {
    for variant in Variant::CORE {
        for dimension in [1, 2] {
            let spec = spec(variant, "jittered", dimension, 0);
            let findings = AcousticPulse.execute(&spec, &Progress::silent());
            assert_eq!(findings.outcome, Outcome::Completed, "{}", variant.name());
            assert!(findings.rows.iter().all(|row| row.value.is_finite()));
        }
    }
}

#[test]
fn every_run_has_its_own_file() {
    let mut slugs: Vec<_> = AcousticPulse.runs(Tier::Full).iter().map(RunSpec::slug).collect();
    let n = slugs.len();
    slugs.sort();
    slugs.dedup();
    let expected = 20 * Variant::CORE.len();
    assert_eq!((slugs.len(), n), (expected, expected));
}
