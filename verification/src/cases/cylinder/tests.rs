//! The scene, small runs, and the verdicts.

use transpoint::scene::Boundary;

use super::scene::{CIRCLE, DIAMETER, HEIGHT, SPEED, scene, start_velocity};
use super::*;
use crate::case::{Outcome, Row};
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

fn small() -> Parameters {
    let small = RUNS.iter().find(|run| run.layout == "small-re20").expect("a small run");
    Parameters {
        cells_across: 16,
        radius: policy::Body::Matched.radius(scene::spacing(16)),
        length: 4.0,
        end: 0.3,
        measured_from: 0.1,
        ..Parameters::new(small)
    }
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| Cylinder.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let [smoke, paper, full] = [Tier::Smoke, Tier::Paper, Tier::Full].map(slugs);
    assert_eq!([smoke.len(), paper.len(), full.len()], [1, 1, RUNS.len()]);
    assert!(smoke.iter().all(|slug| full.contains(slug)));
    let mut unique = full.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), full.len());
    assert!(RUNS.iter().all(|run| run.level < Cylinder.levels()));
}

#[test]
fn settings_are_within_their_ranges_and_survive_json() {
    for (run, spec) in RUNS.iter().zip(Cylinder.runs(Tier::Full)) {
        policy::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
    }
}

#[test]
fn the_start_has_the_flux_of_the_inlet_and_no_divergence() {
    let step = 1e-4;
    for x in [0.05, 0.12, 0.2, 0.28, 0.7] {
        let n = 4000;
        let at = |k: i32| HEIGHT * (f64::from(k) + 0.5) / f64::from(n);
        let flux: f64 = (0..n)
            .filter(|&k| CIRCLE.level([x, at(k)]) > 0.0)
            .map(|k| start_velocity([x, at(k)])[0] * HEIGHT / f64::from(n))
            .sum();
        assert!((flux / (SPEED * HEIGHT) - 1.0).abs() < 1e-4, "{x}: {flux}");
        for y in [0.1, 0.26, 0.33] {
            let slope = |axis: usize| {
                let mut places = [[x, y]; 2];
                places[0][axis] += step;
                places[1][axis] -= step;
                let [above, below] = places.map(|place| start_velocity(place)[axis]);
                (above - below) / (2.0 * step)
            };
            assert!((slope(0) + slope(1)).abs() < 1e-2 * SPEED / DIAMETER, "{x} {y}");
        }
    }
    // Far from the cylinder it is the parabola, on it the fluid stands still.
    assert!((start_velocity([0.7, 0.5 * HEIGHT])[0] - 1.5 * SPEED).abs() < 1e-6);
    let speed = start_velocity([0.25 + 1e-7, 0.2]).map(f64::abs);
    assert!(speed[0] < 1e-3 && speed[1] < 1e-3, "{speed:?}");
}

#[test]
fn the_channel_is_full_but_for_the_inlet_and_the_cylinder() {
    let parameters = Parameters::new(&RUNS[1]);
    let scene = scene(&parameters).expect("a scene");
    assert_eq!(scene.grid.cells, [100, 41]);
    let solid = 41 * 100 - 41 - scene.points.len() / 4;
    // A hull of 78 cells, without its corners.
    assert!((60..=78).contains(&solid), "{solid}");
    assert!(scene.points.iter().all(|point| CIRCLE.level(point.position) > -0.01));
    assert!(matches!(scene.boundaries[0][1], Boundary::Outflow { relaxation: Some(_) }));
    for (broken, field) in [
        (Parameters { cells_across: 0, ..parameters }, "cells_across"),
        (Parameters { length: f64::NAN, ..parameters }, "length"),
        (Parameters { reynolds: 0.0, ..parameters }, "reynolds"),
        (Parameters { points_per_axis: 0, ..parameters }, "points_per_axis"),
        (Parameters { radius: 0.0, ..parameters }, "radius"),
    ] {
        assert_eq!(super::scene::scene(&broken).expect_err("refused").field, field);
    }
}

#[test]
fn a_small_run_has_drag_and_explains_its_mass() {
    let run = || march::execute(&small(), &Progress::silent());
    let findings = run();
    assert_eq!(findings.outcome, Outcome::Completed);
    let of = |quantity, norm| value(&findings.rows, quantity, norm);
    assert!(of("run", "end") >= 0.3 && of("drag", "mean") > 0.1, "{}", of("drag", "mean"));
    assert!(of("ledger", "error") <= 1e-12 && of("energy", "largest") < 1.5);
    assert!(of("points", "in-the-body") == 0.0 && of("speed", "largest") < 4.0 * SPEED);
    // Too short for a period.
    assert!(of("strouhal", "crossings").is_nan() && of("lift", "max").is_nan());
    let names: Vec<&str> = findings.rasters.iter().map(|raster| raster.name.as_str()).collect();
    assert_eq!(names, ["vorticity", "pressure"]);
    assert_eq!(format!("{:?}", run().profiles), format!("{:?}", findings.profiles));
}

#[test]
fn a_run_that_is_not_built_has_rows_without_values() {
    let findings = march::execute(&Parameters { length: 0.0, ..small() }, &Progress::silent());
    assert!(matches!(findings.outcome, Outcome::NotBuilt { .. }));
    assert_eq!(findings.rows.len(), 20);
    assert!(findings.rows.iter().all(|row| row.value.is_nan()));
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let mut rows = measure::rows(&Recording::default());
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
    Cylinder.runs(Tier::Full).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = Cylinder.checks(&records(measured));
        let judged = RUNS
            .iter()
            .filter(|run| run.variant.name() == "tpm-vp2" && run.body == policy::Body::Matched)
            .count();
        assert_eq!(checks.len(), 3 + 3 * judged + 1);
        (checks.iter().filter(|check| !check.holds()).count(), checks.len())
    };
    let (all, total) = failing(f64::NAN);
    assert_eq!(all, total);
    // No drag and no shedding.
    assert_eq!(failing(0.0).0, 4);
    assert!(failing(100.0).0 > 4);
    assert!(Cylinder.checks(&[]).is_empty());
}

#[test]
fn bounds_are_the_published_ones_with_their_allowance() {
    let checks = Cylinder.checks(&records(0.3));
    let of = |name: &str| {
        let check = checks.iter().find(|check| check.check == name).expect("a check");
        (check.lower.expect("a bound"), check.upper.expect("a bound"))
    };
    let (lower, upper) = of("strouhal");
    assert!((lower - 0.28025).abs() < 1e-12 && (upper - 0.32025).abs() < 1e-12);
    let (lower, upper) = of("largest-drag");
    assert!((lower - 2.898).abs() < 1e-12 && (upper - 3.564).abs() < 1e-12);
}

#[test]
fn artifacts_without_curves_are_whole() {
    assert_eq!(Cylinder.artifacts(&records(1.0)).len(), 2);
    assert_eq!(Cylinder.artifacts(&[]).len(), 2);
}
