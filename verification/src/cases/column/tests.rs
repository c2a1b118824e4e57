//! The set-up and the measures of this case on states that are known, and short runs.

use transpoint::Observation;
use transpoint::simulation::PointState;

use super::scene::{SPACING, Setup};
use super::*;
use crate::case::Outcome;
use crate::machine::Manifest;

const STUDIES: [Study; 2] = [Study::Hydrostatic, Study::SuddenLoad];

fn parameters(study: Study, offsets: usize) -> Parameters {
    let settings = Settings::default();
    Parameters { study, cells: 4, offsets, courant: COURANT, duration: DURATION, settings }
}

/// Set-ups at the offsets of the paper tier.
fn setups(study: Study) -> impl Iterator<Item = Setup> {
    (0..100).map(move |k| Setup::new(&parameters(study, 100), sweep::theta(k, 100)))
}

/// A state at rest with pressures of our own.
fn state(setup: &Setup, time: f64, pressure: impl Fn(f64) -> f64) -> Observation<2> {
    let points = setup.scene(&parameters(Study::Hydrostatic, 1)).points.into_iter().enumerate();
    let points = points.map(|(id, point)| PointState {
        id: id as u32,
        position: point.position,
        velocity: [0.0; 2],
        density: point.density,
        pressure: pressure(point.position[1]),
        mass: point.mass,
        energy: 0.0,
        stress: [[0.0; 2]; 2],
        velocity_gradient: [[0.0; 2]; 2],
        density_slope: [0.0; 2],
    });
    Observation { time, points: points.collect() }
}

#[test]
fn rows_fill_the_column_from_the_floor_to_the_surface() {
    for setup in setups(Study::Hydrostatic) {
        let rows = setup.rows();
        assert_eq!(rows[0][0], 0.0);
        assert!((rows[rows.len() - 1][1] - setup.height).abs() < 1e-15);
        assert!(rows.windows(2).all(|pair| pair[0][1] == pair[1][0]));
        let lowest = (rows[0][1] - rows[0][0]) / SPACING;
        assert!((0.25 - 1e-12..0.75 + 1e-12).contains(&lowest), "{lowest}");
        assert!(rows[1..].iter().all(|[a, b]| ((b - a) / SPACING - 0.5).abs() < 1e-12));
        let in_lowest_cell = rows.iter().filter(|[a, b]| 0.5 * (a + b) < SPACING).count();
        assert_eq!(in_lowest_cell, 2);
    }
}

#[test]
fn the_points_have_the_mass_of_the_column() {
    for study in STUDIES {
        for setup in setups(study) {
            let points = setup.scene(&parameters(study, 1)).points;
            let mass: f64 = points.iter().map(|point| point.mass).sum();
            let height = match study {
                Study::Hydrostatic | Study::Settled => setup.at_rest().mass(0.0, setup.height),
                Study::SuddenLoad => 1000.0 * setup.height,
            };
            assert!((mass / (4.0 * SPACING * height) - 1.0).abs() < 1e-13);
            let volume: f64 = points.iter().map(|point| point.mass / point.density).sum();
            assert!((volume / (4.0 * SPACING * setup.height) - 1.0).abs() < 1e-8);
        }
    }
}

#[test]
fn a_period_is_a_whole_number_of_steps_below_the_courant_number() {
    for study in STUDIES {
        for setup in setups(study) {
            assert_eq!(setup.steps % sudden_load::PERIODS as u64, 0);
            let duration = setup.dt * setup.steps as f64;
            assert!((duration * setup.sound_speed / setup.height - DURATION).abs() < 1e-10);
            let share = setup.dt / setup.stable_step(COURANT);
            assert!(share <= 1.0 && share > 0.95, "{share}");
        }
    }
}

#[test]
fn the_equilibrium_has_no_error_and_a_lighter_column_is_found_so() {
    for setup in setups(Study::Hydrostatic) {
        let exact = setup.at_rest();
        let mut watch = hydrostatic::Watch::default();
        watch.see(&setup, &state(&setup, 0.0, |y| exact.pressure(y)));
        assert!(watch.largest.iter().all(|value| *value < 1e-13), "{watch:?}");
        let lighter = |y: f64| exact.pressure(y) - 0.02 * setup.static_pressure();
        let mut moving = state(&setup, 0.0, lighter);
        moving.points[3].velocity = [0.3 * setup.speed(), -0.4 * setup.speed()];
        watch.see(&setup, &moving);
        watch.see(&setup, &state(&setup, 0.0, |y| exact.pressure(y)));
        for (found, expected) in watch.largest.into_iter().zip([0.5, 0.02, 0.02]) {
            assert!((found - expected).abs() < 1e-12, "{watch:?}");
        }
        assert!(!watch.is_lost());
        watch.see(&setup, &state(&setup, 0.0, |_| f64::NAN));
        assert!(watch.largest[1] == f64::INFINITY);
    }
}

#[test]
fn the_wave_has_no_error_and_a_higher_and_damped_one_is_found_so() {
    for setup in setups(Study::SuddenLoad) {
        let (exact, cells) = (setup.loaded(), setup.height / SPACING);
        let mut watch = sudden_load::Watch::default();
        for step in 1..=setup.steps {
            let time = step as f64 * setup.dt;
            let pressure = |y| exact.pressure(y, time + 0.5 * setup.dt);
            watch.see(&setup, &state(&setup, time, pressure));
        }
        let values = watch.values(cells);
        assert!(values.iter().all(|value| value.abs() < 1e-10), "{values:?}");
        // A harmonic wave of 1.03 H that loses 2 % per period, beside one of H.
        let history: Vec<_> = (0..setup.steps)
            .map(|step| {
                let time = (step as f64 + 1.5) * setup.dt / exact.period();
                let wave = |rate: f64| -(std::f64::consts::TAU * rate * time).cos();
                [0.98_f64.powf(time) * wave(1.0 / 1.03), wave(1.0)]
            })
            .collect();
        let [_, height, damping] = sudden_load::Watch { history }.values(cells);
        assert!((height / cells - 0.03).abs() < 1e-3, "{height} {cells}");
        assert!((damping - 0.02).abs() < 5e-3, "{damping}");
    }
}

#[test]
fn the_worst_of_a_sweep() {
    assert_eq!(sweep::worst(&[]), None);
    assert_eq!(sweep::worst(&[-3.0, 2.0, 3.0]), Some((3.0, 3.0, 0)));
    let values: Vec<f64> = (0..100).map(f64::from).collect();
    assert_eq!(sweep::worst(&values), Some((99.0, 94.0, 99)));
    assert_eq!(sweep::worst(&[1.0, f64::NAN]).map(|found| found.2), Some(1));
}

#[test]
fn short_runs_work_for_every_method() {
    for run in Column.runs(Tier::Smoke) {
        let study = STUDIES[usize::from(run.label("study") == "sudden-load")];
        let given: Parameters = serde_json::from_value(run.parameters.clone()).unwrap();
        let short = Parameters { settings: given.settings, ..parameters(study, 1) };
        let variant = Variant::parse(&run.variant).unwrap();
        let findings = sweep::execute(variant, &short, &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed, "{}", run.slug());
        assert!(findings.rows.iter().all(|row| row.value.is_finite()), "{}", run.slug());
        assert_eq!(findings.rows.len(), sweep::missing_rows(study).len());
    }
}

fn record(velocity: f64) -> RunRecord {
    let spec = spec(Variant::TpmVp, "sphere", &parameters(Study::Settled, 1));
    let mut rows = sweep::missing_rows(Study::Settled);
    rows[0].value = velocity;
    rows[3].value = 1e-3;
    RunRecord {
        spec,
        key: String::new(),
        outcome: Outcome::Completed,
        rows,
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: 1.0,
        manifest: Manifest::gather(1, 1),
    }
}

#[test]
fn bounds_hold_the_methods_listed_and_a_blow_up_fails() {
    let verdicts = |velocity: f64, volume: &str| -> Vec<bool> {
        let checks = results::bounds(&[record(velocity)], &[("tpm-vp", volume)]);
        checks.iter().map(Check::holds).collect()
    };
    assert_eq!(verdicts(5e-4, "sphere"), [true, true]);
    assert_eq!(verdicts(2e-3, "sphere"), [false, true]);
    assert_eq!(verdicts(f64::NAN, "sphere"), [false, true]);
    assert!(verdicts(5e-4, "volume-fraction").is_empty());
}

#[test]
fn every_run_has_its_own_file() {
    for tier in [Tier::Smoke, Tier::Paper] {
        let mut slugs: Vec<_> = Column.runs(tier).iter().map(RunSpec::slug).collect();
        let n = slugs.len();
        slugs.sort();
        slugs.dedup();
        assert_eq!((slugs.len(), n), (66, 66));
    }
}
