//! The scene, the measures, a small run, and the verdicts.

use super::plate::{Plate, asymmetry, places, relative_l2};
use super::scene::{JET, POINTS_PER_AXIS, REACH, SOUND_SPEED, scene};
use super::*;
use crate::case::{Outcome, Row};
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

/// The coarsest run, which tests can end early.
fn parameters() -> Parameters {
    let run = RUNS.iter().find(|run| run.tier == Tier::Smoke).expect("a small run");
    Parameters::new(run)
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| JetOnPlate.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let [smoke, paper, full] = [Tier::Smoke, Tier::Paper, Tier::Full].map(slugs);
    assert_eq!([smoke.len(), full.len()], [2, RUNS.len()]);
    assert!(paper.len() < full.len());
    assert!(smoke.iter().all(|slug| paper.contains(slug)));
    assert!(paper.iter().all(|slug| full.contains(slug)));
    let mut unique = full.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), full.len());
}

#[test]
fn settings_are_within_their_ranges_and_survive_json() {
    for (run, spec) in RUNS.iter().zip(JetOnPlate.runs(Tier::Full)) {
        runs::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
        let built = run.variant.build_2d(&scene(&read), &read.settings);
        assert!(built.is_ok(), "{} {}", run.variant.name(), run.layout);
    }
}

/// Density, velocity and mass are those of the exact flow; both halves are mirror images.
#[test]
fn the_box_holds_the_exact_flow_at_the_start() {
    let half = scene(&parameters());
    let h = JET.width / 4.0;
    assert_eq!(half.grid.cells, [REACH * 4, 13]);
    for point in &half.points {
        let flow = JET.at(point.position).expect("a place in the liquid");
        assert_eq!(point.velocity, flow.velocity);
        let pressure = (point.density - JET.density) * SOUND_SPEED.powi(2);
        assert!((pressure - flow.pressure).abs() < 1e-6);
    }
    // The sheet is half a jet thick, so that the areas of jet and sheet are known but for the corner.
    let area = half.points.len() as f64 * (h / POINTS_PER_AXIS as f64).powi(2);
    assert!((area / (JET.width * JET.width) - 3.5).abs() < 0.2, "{area}");
    let whole = scene(&Parameters { whole: true, ..parameters() });
    assert_eq!(whole.points.len(), 2 * half.points.len());
    let momentum: f64 = whole.points.iter().map(|p| p.mass * p.velocity[0]).sum();
    assert!(momentum.abs() < 1e-9);
}

/// At the start the measures are those of the exact flow, to the second order of the cells.
#[test]
fn measures_of_the_exact_flow_are_exact() {
    let measured = |cells: usize, whole: bool| {
        let parameters = Parameters { whole, cells, ..parameters() };
        let scene = scene(&parameters);
        let simulation =
            parameters.variant.build_2d(&scene, &parameters.settings).expect("a valid scene");
        let plate = Plate::of(&scene.grid, simulation.as_ref());
        let places = places(&scene.grid);
        let sides = if whole { 1.0 } else { 2.0 };
        let force = sides * plate.force(scene.grid.spacing[0]) / JET.force();
        let norm = relative_l2(&places, &plate.pressures, 3.0 * JET.width);
        let momentum = sides * plate.momentum / JET.force();
        (force, norm, momentum, asymmetry(&places, &plate.pressures))
    };
    let (force, norm, momentum, _) = measured(16, false);
    assert!((force - 1.0).abs() < 2e-3 && norm < 2e-3, "{force} {norm}");
    // The surface cuts the layer of cells between points.
    assert!((momentum - 1.0).abs() < 0.05, "{momentum}");
    assert!(measured(8, false).1 > 3.0 * norm);
    let (whole_force, whole_norm, _, difference) = measured(16, true);
    assert!((whole_force - force).abs() < 1e-12 && (whole_norm - norm).abs() < 1e-12);
    assert!(difference < 1e-12);
}

#[test]
fn a_plate_without_points_bears_no_pressure_and_a_wrong_one_is_seen() {
    let places: Vec<f64> = (0..30).map(|k| 0.1 * JET.width * (f64::from(k) + 0.5)).collect();
    let exact: Vec<f64> = places.iter().map(|&x| JET.pressure(x)).collect();
    assert_eq!(relative_l2(&places, &exact, 1.0), 0.0);
    assert_eq!(relative_l2(&places, &vec![0.0; 30], 1.0), 1.0);
    let high: Vec<f64> = exact.iter().map(|p| 1.1 * p).collect();
    assert!((relative_l2(&places, &high, 1.0) - 0.1).abs() < 1e-12);
    assert_eq!(asymmetry(&places, &exact), 0.0);
    assert!(asymmetry(&[-1.0, 1.0], &[1.0, 0.0]) > 1.0);
}

#[test]
fn a_short_run_lets_in_the_flux_and_is_repeated_to_the_bit() {
    let parameters = Parameters { end: 0.4, ..parameters() };
    let run = || march::execute(&parameters, &Progress::silent());
    let findings = run();
    assert_eq!(findings.outcome, Outcome::Completed);
    assert!(findings.counters["n_points_entered"] > 0);
    // It ends before the window of the means.
    assert!(value(&findings.rows, "force", "mean").is_nan());
    assert!(value(&findings.rows, "wall-pressure", "relative-l2").is_nan());
    let end = value(&findings.rows, "run", "end");
    assert!((0.36..0.42).contains(&end), "{end}");
    assert_eq!(findings.rasters.len(), 1);
    let names = |rows: &[Row]| -> Vec<String> {
        rows.iter().map(|row| format!("{} {}", row.quantity, row.norm)).collect()
    };
    assert_eq!(names(&findings.rows), names(&march::missing()));
    let again = run();
    assert_eq!(format!("{:?}", again.profiles), format!("{:?}", findings.profiles));
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let mut rows = march::missing();
        for row in &mut rows {
            row.value = measured;
        }
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
    };
    JetOnPlate.runs(Tier::Full).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = JetOnPlate.checks(&records(measured));
        // Three layouts: two forces and the pressure at two levels (`shift`: one), and an order.
        assert_eq!(checks.len(), 18);
        checks.iter().filter(|check| !check.holds()).count()
    };
    assert_eq!(failing(f64::NAN), 18);
    // The force is right then, the pressure is not; a constant error has the order 0.
    assert_eq!(failing(1.0), 5);
    assert!(failing(0.04) >= 10);
    assert!(JetOnPlate.checks(&[]).is_empty());
}

#[test]
fn artifacts_without_curves_are_whole() {
    assert_eq!(JetOnPlate.artifacts(&records(1.0)).len(), 4);
    assert_eq!(JetOnPlate.artifacts(&[]).len(), 4);
}
