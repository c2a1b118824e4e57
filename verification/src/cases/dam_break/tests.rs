//! The scene, a small run, and the verdicts.

use transpoint::Simulation;

use super::occupancy::Occupancy;
use super::policy::Difference;
use super::scene::{COLUMN, DENSITY, GRAVITY, SOUND_SPEED, scaled_time, scene};
use super::state::State;
use super::*;
use crate::case::{Outcome, Row};
use crate::cases::series;
use crate::machine::Manifest;

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

/// Coarse enough for a test.
fn parameters(shape: Shape, end: f64) -> Parameters {
    let small = RUNS.iter().find(|run| run.layout == "small").expect("a small run");
    Parameters { shape, end, spacing: 0.1, ..Parameters::new(small) }
}

fn plane(parameters: &Parameters) -> Box<dyn Simulation<2>> {
    parameters.variant.build_2d(&scene(parameters), &parameters.settings).expect("a valid scene")
}

#[test]
fn every_run_has_its_own_file_and_tiers_grow() {
    let slugs = |tier| DamBreak.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let [smoke, paper, full] = [Tier::Smoke, Tier::Paper, Tier::Full].map(slugs);
    assert_eq!([smoke.len(), paper.len(), full.len()], [2, RUNS.len() - 1, RUNS.len()]);
    assert!(smoke.iter().all(|slug| paper.contains(slug)));
    assert!(paper.iter().all(|slug| full.contains(slug)));
    let mut unique = full.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), full.len());
}

#[test]
fn settings_are_within_their_ranges_and_survive_json() {
    for (run, spec) in RUNS.iter().zip(DamBreak.runs(Tier::Full)) {
        policy::settings(run).check().expect("settings within their ranges");
        let read: Parameters = serde_json::from_value(spec.parameters).expect("parameters");
        assert_eq!(read, Parameters::new(run));
    }
}

#[test]
fn scenes_hold_the_points_that_the_paper_counts() {
    let count = |layout: &str| {
        let run = RUNS.iter().find(|run| run.layout == layout).expect("a run");
        let parameters = Parameters::new(run);
        match run.shape {
            Shape::Plane => scene::<2>(&parameters).points.len(),
            Shape::Tank | Shape::Slab => scene::<3>(&parameters).points.len(),
        }
    };
    assert_eq!(["dense", "coarse", "small"].map(count), [28_800, 1_800, 800]);
    assert_eq!(["tank-3d", "slab"].map(count), [216_000, 7_200]);
    let grid = scene::<2>(&Parameters::new(&RUNS[1])).grid;
    assert_eq!(grid.cells, [161, 100]);
}

#[test]
fn energy_at_the_start_is_that_of_the_column() {
    let parameters = parameters(Shape::Plane, 1.0);
    let scene = scene::<2>(&parameters);
    let state = State::of(&scene.grid, plane(&parameters).as_ref());
    let [l, h] = COLUMN;
    let compressibility = GRAVITY / SOUND_SPEED.powi(2);
    // ∫ρ g y with ρ = ρ₀ (1 + β (h − y)); the midpoint rule misses β d² h/12 of the quadratic part.
    let d = parameters.spacing / 2.0;
    let quadratic = compressibility * (h.powi(3) / 6.0 + d * d * h / 12.0);
    let potential = DENSITY * GRAVITY * l * (0.5 * h * h + quadratic);
    let mass = DENSITY * l * (h + compressibility * 0.5 * h * h);
    assert_eq!(state.energies[0], 0.0);
    assert!((state.energies[1] / potential - 1.0).abs() < 1e-12, "{}", state.energies[1]);
    assert!((state.mass / mass - 1.0).abs() < 1e-12, "{}", state.mass);
    // ½ c₀² (δρ/ρ₀)² to leading order.
    let compression = DENSITY * l * (compressibility * SOUND_SPEED).powi(2) * h.powi(3) / 6.0;
    assert!((state.energies[2] / compression - 1.0).abs() < 0.02, "{}", state.energies[2]);
    assert_eq!((state.points, state.grid_mass), (288, 0.0));
    assert!((state.front - (l - 0.5 * d)).abs() < 1e-12);
}

#[test]
fn gauges_see_the_column_that_stands_there() {
    // The tank's gauges moved into the column would read its height; here they are dry.
    let parameters = parameters(Shape::Tank, 1.0);
    let scene = scene::<3>(&parameters);
    let simulation = parameters.variant.build_3d(&scene, &parameters.settings).expect("a scene");
    let state = State::of(&scene.grid, simulation.as_ref());
    assert_eq!((state.depths, state.tops, state.run_up), ([0.0; 2], [0.0; 2], 0.0));
    assert!((state.left - 0.575).abs() < 1e-12);
    let plane = State::of(
        &super::scene::scene::<2>(&parameters).grid,
        plane(&Parameters { shape: Shape::Plane, ..parameters }).as_ref(),
    );
    assert!((state.energies[1] / (0.3 * plane.energies[1]) - 1.0).abs() < 1e-12);
}

#[test]
fn a_column_at_rest_has_internal_and_boundary_cells_and_no_fractures() {
    let parameters = parameters(Shape::Plane, 1.0);
    let scene = scene::<2>(&parameters);
    let occupancy = Occupancy::of(&scene, plane(&parameters).as_ref()).expect("a grid");
    assert_eq!((occupancy.fractures().len(), occupancy.most_points()), (0, 4));
    let kinds = occupancy.kinds("kind".to_owned()).expect("a picture");
    let mut counts = [0; 5];
    kinds.values.iter().for_each(|&code| counts[usize::from(code)] += 1);
    // 12 by 6 cells, of which the right column and the top row are cut.
    assert_eq!(counts[1..], [55, 17, 0, 0]);
    let pressure = occupancy.pressure("pressure".to_owned()).expect("a picture");
    assert_eq!(pressure.values.iter().filter(|&&value| value > 0).count(), 72);
    // The bottom row is the first, and its pressure the greatest.
    assert!(pressure.values[0] > pressure.values[5 * pressure.columns]);
}

#[test]
fn a_small_run_reaches_the_wall_and_keeps_mass_and_energy() {
    let parameters = parameters(Shape::Plane, 1.9);
    let run = || {
        march::execute::<2>(&parameters, &Progress::silent(), |scene| {
            parameters.variant.build_2d(scene, &parameters.settings)
        })
    };
    let findings = run();
    assert_eq!(findings.outcome, Outcome::Completed);
    let of = |quantity, norm| value(&findings.rows, quantity, norm);
    assert!(of("run", "end") >= 1.9 && of("run", "end") < 1.91);
    assert!(of("energy", "excess") < 0.005 && of("mass", "drift") < 1e-12);
    assert!(of("water", "wetting") > 1.2 && of("water", "wetting") < 1.8);
    assert!(of("p-160mm", "mean").is_nan() && of("fractures", "most") < 5.0);
    // T = 0.02 and 1.0, pressure and kinds.
    assert_eq!(findings.rasters.len(), 4);
    let names: Vec<&str> = findings.rasters.iter().map(|raster| raster.name.as_str()).collect();
    assert_eq!(names, ["pressure@0.02", "kind@0.02", "pressure@1.00", "kind@1.00"]);
    let again = run();
    assert_eq!(format!("{:?}", again.profiles), format!("{:?}", findings.profiles));
}

#[test]
fn the_same_column_runs_in_three_dimensions() {
    let parameters = parameters(Shape::Tank, 0.6);
    let findings = march::execute::<3>(&parameters, &Progress::silent(), |scene| {
        parameters.variant.build_3d(scene, &parameters.settings)
    });
    assert_eq!(findings.outcome, Outcome::Completed);
    let flat = Parameters { shape: Shape::Plane, ..parameters };
    let plane = march::execute::<2>(&flat, &Progress::silent(), |scene| {
        flat.variant.build_2d(scene, &flat.settings)
    });
    // Slip walls let the water do across the depth what it does in the plane.
    let kinetic = |findings: &Findings| {
        let profile = findings.profiles.iter().find(|profile| profile.name == "kinetic");
        series::at(&profile.expect("a profile").pairs(), 0.5)
    };
    let ratio = kinetic(&findings) / (0.3 * kinetic(&plane));
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
fn a_slab_is_the_plane_to_round_off() {
    let findings = slab::execute(&parameters(Shape::Slab, 20.0), &Progress::silent());
    assert_eq!(findings.outcome, Outcome::Completed);
    for row in &findings.rows {
        assert!(row.value <= 1e-10, "{} {}", row.quantity, row.value);
    }
}

#[test]
fn a_run_that_is_not_built_has_rows_without_values() {
    let parameters = parameters(Shape::Plane, 1.0);
    let refused = |_: &transpoint::Scene<2>| {
        Err(transpoint::InvalidInput::new("scene", "this", "no scene at all"))
    };
    let findings = march::execute::<2>(&parameters, &Progress::silent(), refused);
    assert!(matches!(findings.outcome, Outcome::NotBuilt { .. }));
    let complete = march::execute::<2>(
        &Parameters { end: 0.01, ..parameters },
        &Progress::silent(),
        |scene| parameters.variant.build_2d(scene, &parameters.settings),
    );
    let names = |rows: &[Row]| -> Vec<String> {
        rows.iter().map(|row| format!("{} {}", row.quantity, row.norm)).collect()
    };
    assert_eq!(names(&findings.rows), names(&complete.rows));
    assert!(findings.rows.iter().all(|row| row.value.is_nan()));
}

#[test]
fn times_scale_as_in_the_paper() {
    // T is half of t √(g/h₀).
    assert!((scaled_time(1.0) - 0.5 * (GRAVITY / 0.6).sqrt()).abs() < 1e-12);
}

/// A record of every run, each measure with the same value.
fn records(measured: f64) -> Vec<RunRecord> {
    let record = |spec: RunSpec| {
        let parameters: Parameters =
            serde_json::from_value(spec.parameters.clone()).expect("parameters");
        let mut rows = measure::rows(&Recording::empty(&parameters));
        if spec.layout == "slab" {
            rows = slab::execute(&Parameters { end: 0.0, ..parameters }, &Progress::silent()).rows;
        }
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
            counters: BTreeMap::from([("n_point_updates".to_owned(), 1)]),
            seconds: 1.0,
            manifest: Manifest::gather(1, 1),
        }
    };
    DamBreak.runs(Tier::Paper).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |measured: f64| {
        let checks = DamBreak.checks(&records(measured));
        assert_eq!(checks.len(), 18);
        checks.iter().filter(|check| !check.holds()).count()
    };
    // Without a number all fail but the ratio of the work, which comes from counters.
    assert_eq!(failing(f64::NAN), 17);
    assert!(failing(0.0) > 5 && failing(0.0) < 17);
    assert!(DamBreak.checks(&[]).is_empty());
}

#[test]
fn artifacts_without_curves_are_whole() {
    let artifacts = DamBreak.artifacts(&records(1.0));
    assert_eq!(artifacts.len(), 10);
    assert_eq!(DamBreak.artifacts(&[]).len(), 10);
    let find = |difference| results::find(&[], "tpm-vp2", "dense", difference).is_none();
    assert!(find(Difference::None));
}

#[test]
fn volume_of_fluid_runs_have_the_measures_that_are_compared() {
    for (spacing, name) in outside::RUNS {
        let of = |quantity, norm| outside::measure(spacing, quantity, norm);
        assert!((of("p-160mm", "mean") - 0.40).abs() < 0.011, "{name}");
        assert!((of("p-120mm", "mean") - 0.578).abs() < 0.005, "{name}");
        assert!((of("water", "wetting") - 1.27).abs() < 0.02, "{name}");
        assert!((0.4..0.6).contains(&of("water", "rebound")), "{name}");
    }
    let experiment = |norm| outside::measure_of_experiment("p-disc", norm);
    assert!((experiment("mean") - 0.542).abs() < 0.005);
    assert!((experiment("second-peak-time") - 2.92).abs() < 0.02);
}
