//! The scene, the regions, a small run, and the verdicts.

use transpoint::scene::{Boundary, GridSpec};

use super::outline::Region;
use super::run::{INSTANTS, SQUARE, execute, rows, vof};
use super::scene::{GRAVITY, SOUND_SPEED, SPEED, scene};
use super::*;
use crate::case::{Outcome, Row};
use crate::cases::fluid_cells::FluidCells;
use crate::machine::Manifest;

fn smoke(variant: Variant) -> Parameters {
    let run = RUNS.iter().find(|run| run.tier == Tier::Smoke && run.variant == variant);
    Parameters::new(run.expect("a small run"))
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| ChannelVof.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
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
    for (run, spec) in RUNS.iter().zip(ChannelVof.runs(Tier::Full)) {
        policy::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
        let scene = scene(&read);
        assert!(read.variant.build_2d(&scene, &read.settings).is_ok());
        let slips = matches!(run.flow, Flow::FullSlip | Flow::FullSlipWeightless);
        assert_eq!(scene.boundaries[1][0] == Boundary::Slip, slips);
        assert!((scene.grid.origin[0] + scene.grid.spacing[0]).abs() < 1e-15);
    }
    // Ten times the larger of the two speeds.
    let fastest = SPEED.max((GRAVITY * scene::DOMAIN[1]).sqrt());
    assert!((SOUND_SPEED / (10.0 * fastest) - 1.0).abs() < 1e-3);
}

#[test]
fn a_region_is_what_its_outline_encloses() {
    let line = [[0.02, 0.0], [0.02, 0.004], [0.01, 0.008], [0.0, 0.008]];
    let region = Region::of_outline(&line, SQUARE);
    // 20 mm × 4 mm, and a trapezium of 4 mm between 20 and 10 mm.
    assert!((region.area() / 1.4e-4 - 1.0).abs() < 0.01, "{}", region.area());
    assert!((region.front() - 0.02).abs() < 1.01 * SQUARE);
    let tops = region.tops();
    assert!((tops[0].1 - 0.008).abs() < 1.01 * SQUARE && tops[400].1.is_nan());
    let shorter = Region::of_outline(&[[0.01, 0.0], [0.01, 0.004], [0.0, 0.004]], SQUARE);
    assert!((region.difference(&shorter) / 1.0e-4 - 1.0).abs() < 0.01);
    assert_eq!(region.difference(&region), 0.0);
    let dry = Region::of_outline(&[], SQUARE);
    assert_eq!((dry.area(), dry.front()), (0.0, 0.0));
}

#[test]
fn volume_of_fluid_regions_hold_what_has_flowed_in() {
    for instant in INSTANTS {
        let region = vof(Flow::FullNoslip.film(), instant);
        let expected = SPEED * scene::DOMAIN[1] * instant;
        assert!((region.area() / expected - 1.0).abs() < 0.006, "{instant}: {}", region.area());
        // Without gravity a block moves in.
        let block = vof(Flow::FullSlipWeightless.film(), instant);
        assert!((block.front() - SPEED * instant).abs() < 1.5 * SQUARE);
    }
}

#[test]
fn holes_are_within_the_outline_and_bays_are_not() {
    let grid = GridSpec { origin: [-1e-3, 0.0], spacing: [1e-3; 2], cells: [61, 10] };
    let edge = 1e-3;
    let region = |dry: &[(i32, i32)]| {
        let mut cells = FluidCells::new(&grid, edge);
        for i in -1..20 {
            for j in (0..6).filter(|&j| !dry.contains(&(i, j))) {
                let position = [(f64::from(i) + 0.5) * 1e-3, (f64::from(j) + 0.5) * 1e-3];
                cells.add(&transpoint::simulation::PointState {
                    id: 0,
                    position,
                    velocity: [0.0; 2],
                    density: 1000.0,
                    pressure: 0.0,
                    mass: 1e-3,
                    energy: 0.0,
                    stress: [[0.0; 2]; 2],
                    velocity_gradient: [[0.0; 2]; 2],
                    density_slope: [0.0; 2],
                });
            }
        }
        Region::of_cells(&cells, 2.5e-4)
    };
    let whole = region(&[]);
    assert!((whole.area() / 1.2e-4 - 1.0).abs() < 0.01, "{}", whole.area());
    assert!((whole.front() - 0.02).abs() < 2.6e-4);
    assert_eq!(region(&[(10, 2)]), whole);
    let bay = region(&[(10, 5), (10, 4), (10, 3)]);
    assert!(bay.area() < whole.area() - 1e-6);
}

#[test]
fn small_runs_bring_in_the_water_and_repeat() {
    for variant in [Variant::TpmVpQuadratic, Variant::MpmVp] {
        let parameters = smoke(variant);
        let findings = execute(&parameters, &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed);
        let of = |norm: &str| {
            let row =
                findings.rows.iter().find(|row| row.quantity == "outline@0.05" && row.norm == norm);
            row.map_or(f64::NAN, |row| row.value)
        };
        assert!((of("area") - 1.0).abs() < 0.25, "{}", of("area"));
        assert!(of("difference") < 0.8 && of("front") > 0.4);
        assert_eq!((findings.profiles.len(), findings.rasters.len()), (1, 1));
        let again = execute(&parameters, &Progress::silent());
        assert_eq!(format!("{:?}", again.profiles), format!("{:?}", findings.profiles));
    }
}

#[test]
fn a_run_that_is_not_built_has_rows_without_values() {
    let parameters = Parameters { supply: Supply::Columns, ..smoke(Variant::MpmVp) };
    let findings = execute(&parameters, &Progress::silent());
    assert!(matches!(findings.outcome, Outcome::NotBuilt { .. }));
    let names = |rows: &[Row]| -> Vec<String> {
        rows.iter().map(|row| format!("{} {}", row.quantity, row.norm)).collect()
    };
    let complete = execute(&smoke(Variant::MpmVp), &Progress::silent());
    assert_eq!(names(&findings.rows), names(&complete.rows));
    assert!(findings.rows.iter().all(|row| row.value.is_nan()));
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let parameters: Parameters =
            serde_json::from_value(spec.parameters.clone()).expect("parameters");
        let mut rows = rows(&parameters, f64::NAN, &[]);
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
    ChannelVof.runs(Tier::Paper).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = ChannelVof.checks(&records(measured));
        let failing = checks.iter().filter(|check| !check.holds()).count();
        (failing, checks.len())
    };
    let (failed, all) = failing(f64::NAN);
    assert!(failed == all && all >= 19, "{failed} of {all}");
    // A front at the inlet, and one of twice what it should be with a difference likewise.
    assert!(failing(0.0).0 >= 6 && failing(2.0).0 == all);
    assert!(ChannelVof.checks(&[]).is_empty());
}

#[test]
fn artifacts_without_curves_are_whole() {
    assert_eq!(ChannelVof.artifacts(&records(1.0)).len(), 3);
    assert_eq!(ChannelVof.artifacts(&[]).len(), 3);
}
