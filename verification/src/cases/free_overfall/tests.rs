//! The scene, the measures, a small run, and the verdicts.

use transpoint::Simulation;

use super::results::RATIO;
use super::scene::{
    CRITICAL_DEPTH, DENSITY, GRAVITY, columns_to_brink, discharge, layers_below, scene,
};
use super::stream::{Stream, at_face};
use super::*;
use crate::case::{Outcome, Row};
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

fn parameters() -> Parameters {
    let run = RUNS.iter().find(|run| run.tier == Tier::Smoke).expect("a small run");
    Parameters::new(run)
}

fn start(parameters: &Parameters) -> (Box<dyn Simulation<2>>, Stream) {
    let scene = scene(parameters);
    let simulation =
        parameters.variant.build_2d(&scene, &parameters.settings).expect("a valid scene");
    let stream = Stream::of(&scene.grid, layers_below(parameters.cells), simulation.as_ref());
    (simulation, stream)
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| FreeOverfall.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let [smoke, paper, full] = [Tier::Smoke, Tier::Paper, Tier::Full].map(slugs);
    assert_eq!([smoke.len(), full.len()], [1, RUNS.len()]);
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
    for (run, spec) in RUNS.iter().zip(FreeOverfall.runs(Tier::Full)) {
        runs::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
        assert!(run.variant.build_2d(&scene(&read), &read.settings).is_ok());
    }
}

/// q = √(g y_c³), and a stream of the critical depth has the Froude number 1.
#[test]
fn every_inflow_has_the_same_discharge() {
    assert!((discharge().powi(2) / (GRAVITY * CRITICAL_DEPTH.powi(3)) - 1.0).abs() < 1e-14);
    for run in &RUNS {
        let parameters = Parameters::new(run);
        let inlet = scene(&parameters).inlets[0];
        let depth = inlet.upper[1] - inlet.lower[1];
        assert!((inlet.velocity[0] * depth / discharge() - 1.0).abs() < 1e-12);
        let froude = inlet.velocity[0] / (GRAVITY * depth).sqrt();
        assert_eq!(format!("fr{froude:.2}"), run.layout);
    }
}

/// Depth, discharge and pressure of the stream that fills the channel at the start, which ends at the brink.
#[test]
fn measures_of_the_start_are_those_of_the_stream() {
    for layers in [8, 12] {
        let parameters = Parameters { inlet_cells: layers, ..parameters() };
        let (simulation, stream) = start(&parameters);
        let brink = columns_to_brink(parameters.cells);
        let depth = layers as f64 / 8.0 * CRITICAL_DEPTH;
        let h = CRITICAL_DEPTH / 8.0;
        for face in [1, 9, brink - 1] {
            assert!((at_face(&stream.depths, face) / depth - 1.0).abs() < 1e-12);
            assert!((at_face(&stream.discharges, face) / discharge() - 1.0).abs() < 1e-12);
            let bed = DENSITY * GRAVITY * (depth - 0.5 * h);
            assert!((at_face(&stream.bed_pressures, face) / bed - 1.0).abs() < 1e-9);
        }
        // Half of what lies beside the brink is empty still.
        assert!((at_face(&stream.depths, brink) / depth - 0.5).abs() < 1e-12);
        let floor = layers_below(8) as f64 * h;
        assert!((stream.tops[3] - (floor + depth - 0.25 * h)).abs() < 1e-12);
        assert!((stream.bottoms[3] - (floor + 0.25 * h)).abs() < 1e-12);
        assert!((stream.mass / simulation.conserved().mass - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_short_run_falls_over_the_brink_and_is_repeated_to_the_bit() {
    let parameters = Parameters { end: 1.0, ..parameters() };
    let run = || march::execute(&parameters, &Progress::silent());
    let findings = run();
    assert_eq!(findings.outcome, Outcome::Completed);
    assert!((value(&findings.rows, "run", "end") - 1.0).abs() < 0.06);
    let profile = |name: &str| {
        let found = findings.profiles.iter().find(|profile| profile.name == name);
        found.expect("a profile").pairs()
    };
    let brink = profile("brink-depth");
    // Half of what lies beside the brink is empty at first; the stream is denser than ρ₀ on the bed.
    assert!((brink[0].1 - 0.5).abs() < 0.1 && brink.iter().all(|point| point.1 < 1.05));
    let names = |rows: &[Row]| -> Vec<String> {
        rows.iter().map(|row| format!("{} {}", row.quantity, row.norm)).collect()
    };
    assert_eq!(names(&findings.rows), names(&march::missing(&parameters)));
    let again = run();
    assert_eq!(format!("{:?}", again.profiles), format!("{:?}", findings.profiles));
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let mut rows = march::missing(&parameters());
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
    FreeOverfall.runs(Tier::Full).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = FreeOverfall.checks(&records(measured));
        assert_eq!(checks.len(), 5);
        checks.iter().filter(|check| !check.holds()).count()
    };
    assert_eq!([failing(RATIO), failing(0.70)], [0, 0]);
    assert_eq!([failing(f64::NAN), failing(0.67), failing(0.76), failing(1.0)], [5, 5, 5, 5]);
    assert!(FreeOverfall.checks(&[]).is_empty());
}

#[test]
fn artifacts_without_curves_are_whole() {
    assert_eq!(FreeOverfall.artifacts(&records(1.0)).len(), 3);
    assert_eq!(FreeOverfall.artifacts(&[]).len(), 3);
}
