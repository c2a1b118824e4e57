//! The strip, its measures against the exact field, and the verdicts.

use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::scene::{exact, execute, measure, scene};
use super::*;
use crate::case::{Outcome, Row};
use crate::exact::linear_riemann::LinearRiemann;
use crate::machine::Manifest;

fn parameters(layout: &str, dissipation: Dissipation, cells: usize) -> Parameters {
    Parameters::new(&METHODS[1], layout, dissipation, cells)
}

fn value(rows: &[Row], quantity: &str, norm: &str) -> f64 {
    let row = rows.iter().find(|row| row.quantity == quantity && row.norm == norm);
    row.map_or(f64::NAN, |row| row.value)
}

/// The exact field at the places of the scene's points.
fn exact_state(scene: &Scene<2>) -> Observation<2> {
    let solution = exact().expect("the paper's pressures");
    let points = scene.points.iter().enumerate().map(|(id, point)| {
        let state = solution.at((point.position[0] - INTERFACE) / TIME);
        PointState {
            id: id as u32,
            position: point.position,
            velocity: [state.velocity, 0.0],
            density: state.density,
            pressure: solution.pressure(state),
            mass: point.mass,
            energy: 0.0,
            stress: [[0.0; 2]; 2],
            velocity_gradient: [[0.0; 2]; 2],
            density_slope: [0.0; 2],
        }
    });
    Observation { time: TIME, points: points.collect() }
}

#[test]
fn every_run_has_its_own_file_and_the_smoke_tier_is_a_part_of_all() {
    let slugs = |tier| Riemann.runs(tier).iter().map(RunSpec::slug).collect::<Vec<_>>();
    let all = slugs(Tier::Paper);
    let mut unique = all.clone();
    unique.sort();
    unique.dedup();
    assert_eq!((unique.len(), all.len()), (80, 80));
    let smoke = slugs(Tier::Smoke);
    assert_eq!(smoke.len(), 6);
    assert!(smoke.iter().all(|slug| all.contains(slug)));
}

#[test]
fn names_without_a_suffix_are_those_of_the_library() {
    for method in &METHODS {
        assert!(method.name.starts_with(method.variant.name()), "{}", method.name);
        for &dissipation in method.dissipations {
            method.settings(dissipation).check().expect("settings within their ranges");
        }
    }
}

#[test]
fn the_runs_take_the_steps_of_the_paper() {
    let parameters = parameters("regular", Dissipation::Flip, 1000);
    assert_eq!(parameters.steps, 1250);
    assert!((parameters.dt / 4e-6 - 1.0).abs() < 1e-12);
    assert!((methods::RELAXATION_TIME - 2.0 * SPACING / SOUND_SPEED).abs() < 1e-18);
}

#[test]
fn masses_are_those_of_the_pressure_on_each_side() {
    for layout in LAYOUTS {
        let scene = scene(&parameters(layout, Dissipation::Flip, 100));
        assert_eq!(scene.points.len(), 1200);
        assert_eq!(scene.points.iter().filter(|point| point.density == 1000.4).count(), 600);
        for point in &scene.points {
            let density = if point.position[0] < 0.5 { 1000.4 } else { 1000.04 };
            assert_eq!(point.density, density);
            assert!((point.mass / (density * 2.5e-5) - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn the_exact_field_has_no_error_and_measures_itself() {
    for layout in LAYOUTS {
        let scene = scene(&parameters(layout, Dissipation::Flip, 1000));
        let (rows, profile) = measure(&scene.grid, &exact_state(&scene)).expect("a grid");
        assert_eq!(profile.points.len(), 1000);
        let pressure = |norm| value(&rows, "pressure", norm);
        for norm in ["l1", "l2", "overshoot", "undershoot", "n-outside"] {
            assert!(pressure(norm).abs() < 1e-9, "{layout} {norm} {}", pressure(norm));
        }
        assert!(value(&rows, "velocity", "l1") < 1e-15);
        for norm in ["tv-cells", "tv-points"] {
            assert!((pressure(norm) / results::exact_variation() - 1.0).abs() < 1e-9, "{norm}");
        }
        for norm in ["plateau-min", "plateau-max"] {
            assert!((pressure(norm) - 549.959_51).abs() < 1e-5, "{norm}");
        }
        for norm in ["front-width-left", "front-width-right"] {
            assert!((0.5..2.0).contains(&pressure(norm)), "{norm} {}", pressure(norm));
        }
    }
}

#[test]
fn a_shifted_field_is_measured_by_its_shift() {
    let scene = scene(&parameters("regular", Dissipation::Flip, 200));
    let mut state = exact_state(&scene);
    for point in &mut state.points {
        point.pressure += 3.0;
    }
    let (rows, _) = measure(&scene.grid, &state).expect("a grid");
    let pressure = |norm| value(&rows, "pressure", norm);
    assert!((pressure("l1") - 3.0).abs() < 1e-9 && (pressure("l2") - 3.0).abs() < 1e-9);
    assert!((pressure("overshoot") - 3.0).abs() < 1e-9 && pressure("undershoot") == 0.0);
    assert_eq!(pressure("n-outside"), 600.0);
}

#[test]
fn the_linear_answer_of_the_paper_differs_by_less_than_any_check_sees() {
    let linear = LinearRiemann {
        left_pressure: PRESSURES[0],
        right_pressure: PRESSURES[1],
        density: DENSITY,
        sound_speed: SOUND_SPEED,
        interface: INTERFACE,
    };
    let solution = exact().expect("the paper's pressures");
    assert!((linear.star_pressure() - solution.pressure(solution.star())).abs() < 0.05);
    let fronts = [solution.left_wave(), solution.right_wave()];
    for (front, wave) in linear.fronts(TIME).into_iter().zip(fronts) {
        for speed in [wave.head(), wave.tail()] {
            assert!((INTERFACE + speed * TIME - front).abs() < 0.1 * SPACING);
        }
    }
}

#[test]
fn the_exact_curve_has_its_corners_within_the_range() {
    let curve = figures::exact_curve([0.7, 0.8]);
    assert_eq!(curve.len(), 4);
    let shock = curve[1].0;
    assert!(shock > 0.7 && shock < 0.8 && curve[2].0 >= shock);
    assert_eq!([curve[0].0, curve[3].0], [0.7, 0.8]);
    for ((_, pressure), expected) in curve.into_iter().zip([549.9595, 549.9595, 100.0, 100.0]) {
        assert!((pressure - expected).abs() < 1e-4, "{pressure}");
    }
}

#[test]
fn a_coarse_run_reaches_the_plateau_on_either_layout() {
    for layout in LAYOUTS {
        let findings = execute(&parameters(layout, Dissipation::Viscous, 50), &Progress::silent());
        assert_eq!(findings.outcome, Outcome::Completed);
        assert_eq!(findings.profiles.len(), 1);
        let l1 = value(&findings.rows, "pressure", "l1");
        assert!(l1 > 1.0 && l1 < 150.0, "{layout}: {l1}");
        let quiet = value(&findings.rows, "velocity", "l1");
        assert!(quiet < 2e-3, "{layout}: {quiet}");
    }
}

/// A record of every run with the measures of its scale, and `l1` in place of the error.
fn records(tier: Tier, l1: f64) -> Vec<RunRecord> {
    let scene = scene(&parameters("regular", Dissipation::Flip, 100));
    let (rows, profile) = measure(&scene.grid, &exact_state(&scene)).expect("a grid");
    let rows: Vec<Row> = rows
        .into_iter()
        .map(|row| if row.norm == "l1" { Row { value: l1, ..row } } else { row })
        .collect();
    let record = |spec| RunRecord {
        spec,
        key: String::new(),
        outcome: Outcome::Completed,
        rows: rows.clone(),
        profiles: vec![profile.clone()],
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: 0.0,
        manifest: Manifest::gather(1, 1),
    };
    Riemann.runs(tier).into_iter().map(record).collect()
}

#[test]
fn checks_fail_on_bad_rows_and_are_left_out_without_runs() {
    let failing = |l1: f64| {
        let checks = Riemann.checks(&records(Tier::Paper, l1));
        assert_eq!(checks.len(), 14);
        checks.iter().filter(|check| !check.holds()).count()
    };
    // An exact result fails the finding that MPM fails; a bad one fails every bound on the error.
    assert_eq!([failing(0.0), failing(60.0), failing(f64::NAN)], [1, 5, 6]);
    assert_eq!(Riemann.checks(&records(Tier::Smoke, 0.0)).len(), 12);
    assert!(Riemann.checks(&[]).is_empty());
}

#[test]
fn verdicts_on_the_claim_follow_the_numbers() {
    let verdicts = |l1: f64| -> Vec<String> {
        let table = claims::table(&records(Tier::Paper, l1));
        table.rows.iter().map(|row| format!("{:?}", row[2])).collect()
    };
    // The exact field does not ring and no method fails with it.
    let exact = verdicts(0.0);
    assert_eq!(exact.len(), 11);
    assert!(exact[0].contains("does not hold") && exact[1].contains("\"holds\""));
    assert!(exact[7].contains("does not hold") && exact[9].contains("\"holds\""));
    assert!(verdicts(60.0)[7].contains("\"holds\""));
    assert!(claims::table(&[]).rows.is_empty());
}

#[test]
fn artifacts_of_the_smoke_tier_are_whole() {
    let artifacts = Riemann.artifacts(&records(Tier::Smoke, 0.0));
    assert_eq!(artifacts.len(), 5);
    assert!(Riemann.artifacts(&[]).len() == 5);
}
