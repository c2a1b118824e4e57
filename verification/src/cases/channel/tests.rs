//! The scene, the measures, a small run, and the verdicts.

use transpoint::scene::Boundary;

use super::march::Recording;
use super::measure::{inflow, rows, steady};
use super::scene::{DENSITY, GRAVITY, scene};
use super::state::{State, share};
use super::*;
use crate::case::{Outcome, Row};
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

/// Coarse and short enough for a test.
fn parameters(variant: Variant, supply: Supply, end: f64) -> Parameters {
    let run = RUNS
        .iter()
        .find(|run| (run.layout, run.variant, run.supply) == ("coarse", variant, supply));
    Parameters { end, ..Parameters::new(run.expect("a coarse run")) }
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| Channel.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let [smoke, paper, full] = [Tier::Smoke, Tier::Paper, Tier::Full].map(slugs);
    assert!(smoke.len() < paper.len() && paper.len() <= full.len());
    assert_eq!(full.len(), RUNS.len());
    assert!(smoke.iter().all(|slug| paper.contains(slug)));
    let mut unique = full.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), full.len());
}

#[test]
fn settings_are_within_their_ranges_and_survive_json() {
    for (run, spec) in RUNS.iter().zip(Channel.runs(Tier::Full)) {
        policy::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
        assert!(read.variant.build_2d(&scene(&read), &read.settings).is_ok(), "{}", run.name());
    }
}

#[test]
fn the_inlet_plane_is_the_beginning_of_the_channel() {
    for run in &RUNS {
        let parameters = Parameters::new(run);
        let scene = scene(&parameters);
        let [h, _] = scene.grid.spacing;
        assert!((scene.grid.origin[0] + h).abs() < 1e-15);
        assert!((scene.grid.origin[0] + h * scene.grid.cells[0] as f64 - 2.0).abs() < 1e-12);
        assert!((h * scene.grid.cells[1] as f64 - 0.2).abs() < 1e-12);
        let outflow = run.outlet == Outlet::ZeroGradient;
        assert_eq!(scene.boundaries[0][1] == Boundary::Free, !outflow);
        assert!(scene.points.is_empty());
    }
}

#[test]
fn what_is_in_the_channel_at_the_start_is_the_second_column() {
    for (supply, depth) in [(Supply::Flux, 0.0), (Supply::Columns, 0.05)] {
        let parameters = parameters(Variant::TpmVpQuadratic, supply, 1.0);
        let simulation = parameters
            .variant
            .build_2d(&scene(&parameters), &parameters.settings)
            .expect("a valid scene");
        let state = State::of(simulation.as_ref(), &parameters);
        // Compressed by ½ g h_in/c₀² in the mean.
        let expected = DENSITY * depth * 0.1 * (1.0 + 0.5 * GRAVITY * 0.1 / 400.0);
        assert!((state.mass - expected).abs() < 1e-9, "{}", state.mass);
        assert!(state.grid_mass.is_nan() && state.left == 0.0);
        assert!((state.energies[0] - 0.08 * state.mass).abs() < 1e-12);
    }
}

#[test]
fn a_lattice_that_slides_in_brings_its_mass_evenly() {
    let edge = 0.5;
    let mass = |shift: f64| -> f64 {
        (0..8).map(|k| share(-1.75 + shift + edge * f64::from(k), edge)).sum()
    };
    for step in 0..20 {
        let shift = 0.05 * f64::from(step);
        assert!((mass(shift) - mass(0.0) - shift / edge).abs() < 1e-12, "{shift}");
    }
}

/// Whatever the lattice of the inlet's column, what is taken from the mass on the nodes is that column.
#[test]
fn the_mass_on_the_nodes_does_not_see_the_lattice_slide() {
    let parameters = parameters(Variant::TpmVpQuadratic, Supply::Flux, 1.0);
    let mut simulation = parameters
        .variant
        .build_2d(&scene(&parameters), &parameters.settings)
        .expect("a valid scene");
    // A column crosses the plane every 0.0625 s.
    for _ in 0..400 {
        simulation.step(5e-4).expect("a step");
        let state = State::of(simulation.as_ref(), &parameters);
        // A full cell holds 2.5 kg, and up to two may be told apart from cut ones.
        assert!((state.grid_mass - state.mass).abs() < 1.5, "{state:?}");
    }
}

#[test]
fn slopes_and_distances_of_a_line_are_exact() {
    let line: Vec<_> = (0..=100).map(|k| f64::from(k) * 0.01).map(|t| (t, 2.0 + 3.0 * t)).collect();
    let [slope, deviation] = inflow(&line, 0.8, 3.0);
    assert!((slope - 3.0).abs() < 1e-12 && deviation < 1e-12);
    // Against a flux of 4 the line is 0.8 off at 0.8 s, where the mass is 4.4.
    assert!((inflow(&line, 0.8, 4.0)[1] - 0.8 / 4.4).abs() < 1e-12);
    assert!(inflow(&[], 1.0, 3.0)[0].is_nan());
    let gap = [(0.0, f64::NAN), (0.5, 1.5), (1.0, 3.0)];
    assert!((inflow(&gap, 1.0, 3.0)[0] - 3.0).abs() < 1e-12);
}

#[test]
fn a_mass_that_settles_is_steady_from_then_on() {
    let curve: Vec<_> =
        (0..=1000).map(|k| f64::from(k) * 0.01).map(|t| (t, 100.0 - 100.0 * (-t).exp())).collect();
    let [since, variation] = steady(&curve);
    // e⁻ᵗ (e − 1) < 0.01 (1 − e⁻ᵗ) from t = 5.152 on.
    assert!((since - 4.152).abs() < 0.02, "{since}");
    assert!(variation < 0.001);
    let growing: Vec<_> = curve.iter().map(|&(t, _)| (t, 10.0 + t)).collect();
    let [since, variation] = steady(&growing);
    assert!(since.is_nan() && (variation - 0.05).abs() < 1e-3, "{variation}");
    assert!(steady(&[])[0].is_nan() && steady(&[])[1].is_nan());
}

#[test]
fn small_runs_bring_in_the_flux_and_balance() {
    for (variant, supply) in [
        (Variant::TpmVpQuadratic, Supply::Flux),
        (Variant::TpmVpQuadratic, Supply::Columns),
        (Variant::MpmVp, Supply::Flux),
    ] {
        let parameters = parameters(variant, supply, 0.6);
        let run = || march::execute(&parameters, &Progress::silent());
        let findings = run();
        assert_eq!(findings.outcome, Outcome::Completed);
        let of = |quantity, norm| value(&findings.rows, quantity, norm);
        assert_eq!(of("run", "unfinished"), 0.0);
        assert!((of("mass", "slope") - 1.0).abs() < 0.05, "{}", of("mass", "slope"));
        assert!(of("ledger", "step") <= 1e-12 && of("ledger", "run") <= 1e-11);
        assert!(of("energy", "over-head") < 1.0 && of("front", "outlet").is_nan());
        assert!(of("mass", "mass@2").is_nan() && of("depth", "vof@2").is_nan());
        let names: Vec<&str> = findings.rasters.iter().map(|raster| raster.name.as_str()).collect();
        assert_eq!(names, ["pressure@0.5"]);
        let raster = &findings.rasters[0];
        assert_eq!((raster.columns, raster.rows, raster.origin), (40, 4, [0.0, 0.0]));
        assert_eq!(format!("{:?}", run().profiles), format!("{:?}", findings.profiles));
    }
}

#[test]
fn parameters_that_do_not_fit_give_rows_without_values() {
    let parameters = parameters(Variant::MpmVp, Supply::Flux, 0.1);
    // Points that carry mass cannot be topped up.
    let refused = Parameters { supply: Supply::Columns, ..parameters };
    let findings = march::execute(&refused, &Progress::silent());
    assert!(matches!(findings.outcome, Outcome::NotBuilt { .. }));
    let complete = march::execute(&parameters, &Progress::silent());
    let names = |rows: &[Row]| -> Vec<String> {
        rows.iter().map(|row| format!("{} {}", row.quantity, row.norm)).collect()
    };
    assert_eq!(names(&findings.rows), names(&complete.rows));
    assert!(findings.rows.iter().all(|row| row.value.is_nan()));
}

#[test]
fn the_volume_of_fluid_run_is_read_where_it_is_compared() {
    for (instant, expected) in [(2.0, 67.2), (3.0, 78.2), (4.0, 83.0)] {
        assert!((outside::mass(instant) - expected).abs() < 0.1, "{}", outside::mass(instant));
    }
    assert!(outside::mass(5.0).is_nan());
    let mean: f64 = (0..100)
        .map(|column| outside::depth(2.0, 0.01 + 0.02 * f64::from(column), 0.02))
        .sum::<f64>()
        / 100.0;
    assert!((2000.0 * mean - 67.2).abs() < 0.3, "{mean}");
    for (spacing, _) in outside::RUNS {
        assert!((1.05..1.2).contains(&outside::left(spacing, 0.1)));
    }
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let parameters: Parameters =
            serde_json::from_value(spec.parameters.clone()).expect("parameters");
        let mut rows = rows(&parameters, &Recording::default());
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
    Channel.runs(Tier::Paper).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = Channel.checks(&records(measured));
        let failing = checks.iter().filter(|check| !check.holds()).count();
        (failing, checks.len())
    };
    let (failed, all) = failing(f64::NAN);
    assert!(failed == all && all > 100, "{failed} of {all}");
    // A mass of zero, and one of twice what is allowed.
    assert!(failing(0.0).0 > 40 && failing(2.0).0 > 100);
    assert!(Channel.checks(&[]).is_empty());
    let names: Vec<String> = Channel
        .checks(&records(0.0))
        .into_iter()
        .map(|c| c.variant + &c.layout + &c.check)
        .collect();
    let mut unique = names.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), names.len());
}

#[test]
fn artifacts_without_curves_are_whole() {
    assert_eq!(Channel.artifacts(&records(1.0)).len(), 7);
    assert_eq!(Channel.artifacts(&[]).len(), 7);
}
