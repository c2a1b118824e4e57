//! The tube, its measures against the exact field, and the verdicts.

use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::scene::{Drift, FIELDS, exact, execute, measure, scene};
use super::*;
use crate::case::{Outcome, Row};
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str) -> f64 {
    rows.iter().find(|row| row.quantity == quantity).map_or(f64::NAN, |row| row.value)
}

/// The exact field at the places of the scene's points, each with its share of the length.
fn exact_state(scene: &Scene<1>) -> Observation<1> {
    let solution = exact().expect("the states of Sod");
    let length = 1.0 / scene.points.len() as f64;
    let points = scene.points.iter().enumerate().map(|(id, point)| {
        let state = solution.at((point.position[0] - INTERFACE) / TIME);
        PointState {
            id: id as u32,
            position: point.position,
            velocity: [state.velocity],
            density: state.density,
            pressure: state.pressure,
            mass: state.density * length,
            energy: state.pressure / (0.4 * state.density),
            stress: [[0.0]],
            velocity_gradient: [[0.0; 1]; 1],
            density_slope: [0.0; 1],
        }
    });
    Observation { time: TIME, points: points.collect() }
}

#[test]
fn every_run_has_its_own_file_and_the_smoke_tier_is_a_part_of_all() {
    let slugs = |tier| Sod.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let all = slugs(Tier::Paper);
    let mut unique = all.clone();
    unique.sort();
    unique.dedup();
    assert_eq!((unique.len(), all.len()), (120, 120));
    let smoke = slugs(Tier::Smoke);
    assert_eq!(smoke.len(), 16);
    assert!(smoke.iter().all(|slug| all.contains(slug)));
}

#[test]
fn masses_and_energies_are_those_of_each_side() {
    for layout in LAYOUTS {
        let scene = scene(&parameters(&METHODS[0], layout, 1));
        assert!(scene.energy && scene.points.len() == 128);
        for point in &scene.points {
            let (density, energy) = if point.position[0] < 0.5 { (1.0, 2.5) } else { (0.125, 2.0) };
            assert_eq!(point.density, density);
            assert!((point.energy - energy).abs() < 1e-12);
            assert!((point.mass * 128.0 / density - 1.0).abs() < 1e-12);
        }
        let mass: f64 = scene.points.iter().map(|point| point.mass).sum();
        assert!((mass - 0.5625).abs() < 1e-12);
    }
}

#[test]
fn steps_end_at_the_time_of_measurement_and_keep_to_the_courant_number() {
    for level in 0..CELLS.len() {
        let Parameters { dt, steps, cells, .. } = parameters(&METHODS[0], "regular", level);
        assert!((dt * steps as f64 / TIME - 1.0).abs() < 1e-12);
        assert!(dt * FASTEST * cells as f64 <= COURANT * (1.0 + 1e-12));
    }
}

#[test]
fn no_sound_in_the_exact_solution_is_faster_than_the_bound() {
    let solution = exact().expect("the states of Sod");
    let fastest = (-2000..2000)
        .map(|i| solution.at(f64::from(i) * 1e-3))
        .map(|state| state.velocity.abs() + (RATIO * state.pressure / state.density).sqrt());
    assert!((fastest.fold(0.0, f64::max) - 2.19).abs() < 0.01);
}

#[test]
fn the_exact_field_has_no_error() {
    for layout in LAYOUTS {
        let scene = scene(&parameters(&METHODS[0], layout, 2));
        let (rows, profiles) =
            measure(&scene.grid, &exact_state(&scene), Drift::default()).expect("a grid");
        assert_eq!(profiles.len(), FIELDS.len());
        for row in &rows {
            assert!(row.value.abs() < 1e-12, "{layout} {} {}", row.quantity, row.value);
            assert!(row.scale > 0.1, "{} {}", row.quantity, row.scale);
        }
    }
}

#[test]
fn round_off_is_given_by_its_decade_and_other_drifts_as_they_are() {
    let scene = scene(&parameters(&METHODS[0], "regular", 0));
    let rows = |energy| {
        let drift = Drift { energy, mass: 0.0 };
        measure(&scene.grid, &exact_state(&scene), drift).expect("a grid").0
    };
    assert!((value(&rows(3e-15), "total-energy") / 1e-14 - 1.0).abs() < 1e-12);
    assert_eq!(value(&rows(3e-3), "total-energy"), 3e-3);
}

#[test]
fn a_coarse_run_is_near_the_exact_solution_and_keeps_its_energy() {
    for layout in LAYOUTS {
        let findings = execute(&parameters(&METHODS[7], layout, 1), &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed);
        assert!(value(&findings.rows, "density") < 0.05, "{layout}");
        assert!(value(&findings.rows, "total-energy") <= 1e-11, "{layout}");
        assert_eq!(value(&findings.rows, "mass"), 0.0);
    }
}

#[test]
fn a_method_that_cannot_keep_the_energy_is_not_built() {
    let mut parameters = parameters(&METHODS[4], "regular", 0);
    parameters.settings.energy_update = EnergyUpdate::Work;
    let findings = execute(&parameters, &Progress::silent());
    assert!(matches!(findings.outcome, Outcome::NotBuilt { .. }));
    assert!(findings.rows.iter().all(|row| row.value.is_nan()));
}

/// Records whose errors fall with the given order and whose energy drifts.
fn records(tier: Tier, order: f64, drift: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let rows = scene::missing_rows().into_iter().map(|row| {
            let value = if row.norm == "l1" { spec.spacing.powf(order) } else { drift };
            Row { value, scale: 1.0, ..row }
        });
        RunRecord {
            rows: rows.collect(),
            spec,
            key: String::new(),
            outcome: Outcome::Completed,
            profiles: Vec::new(),
            rasters: Vec::new(),
            counters: BTreeMap::new(),
            seconds: 0.0,
            manifest: Manifest::gather(1, 1),
        }
    };
    Sod.runs(tier).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_low_orders_drift_and_blow_ups() {
    let failing = |order: f64, drift: f64| {
        let checks = Sod.checks(&records(Tier::Paper, order, drift));
        assert_eq!(checks.len(), 10);
        checks.iter().filter(|check| !check.holds()).count()
    };
    assert_eq!(failing(1.0, 1e-14), 0);
    assert_eq!(failing(0.7, 1e-14), 4);
    assert_eq!(failing(1.0, 1e-3), 6);
    assert_eq!(failing(f64::NAN, f64::NAN), 10);
    // The best of two methods is not the best of all: only the drift is judged.
    assert_eq!(Sod.checks(&records(Tier::Smoke, 0.1, 1e-14)).len(), 2);
    assert!(Sod.checks(&[]).is_empty());
}

#[test]
fn tables_have_a_column_per_level_on_record() {
    for (tier, levels) in [(Tier::Smoke, SMOKE_LEVELS), (Tier::Paper, CELLS.len())] {
        let artifacts = Sod.artifacts(&records(tier, 1.0, 1e-14));
        let columns: Vec<usize> = artifacts
            .iter()
            .filter_map(|artifact| match &artifact.content {
                crate::report::Content::Table(table) => Some(table.columns.len()),
                _ => None,
            })
            .collect();
        assert_eq!(columns, [levels + 5, levels + 3]);
    }
}
