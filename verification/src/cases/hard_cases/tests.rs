//! Hard cases turn red where a sound method is spoilt; measures and verdicts on numbers worked out by hand.

mod mutants;

use transpoint::variants::Blend;
use transpoint::{Settings, Variant};

use super::list::{CASES, HardCase, RUNS};
use super::trial::{Builder, Trial, slope};
use super::verdict::{Verdict, digits, on_record, strangers};
use super::*;
use mutants::{Mutant, Respelt, Spoil};

/// The verdict of a method that `builder` builds on a hard case.
fn judge(case: &str, variant: Variant, builder: &dyn Builder) -> Verdict {
    let case: &HardCase = CASES.iter().find(|known| known.name == case).expect("a hard case");
    let run = RUNS.iter().find(|run| run.name == case.run).expect("its run");
    let found = findings(run, (run.execute)(&Trial { variant, builder }), 0.0);
    assert_eq!(found.rows.len(), run.quantities.len());
    Verdict::of(case, &found.outcome, &found.rows)
}

/// A sound method passes, the same one spoilt does not.
fn turns_red(case: &str, variant: Variant, spoils: &[Spoil]) {
    let sound = judge(case, variant, &variant);
    assert_eq!(sound.word(), "pass", "{case}, {}: {sound:?}", variant.name());
    for &spoil in spoils {
        let spoilt = judge(case, variant, &Mutant { variant, spoil });
        assert_eq!(spoilt.word(), "fail", "{case}, {}, {spoil:?}: {spoilt:?}", variant.name());
    }
}

#[test]
fn cell_crossing_sees_noise_and_doubled_density() {
    turns_red("cell-crossing", Variant::TpmVpQuadratic, &[Spoil::Noise(1e-3), Spoil::Density(2.0)]);
}

#[test]
fn single_points_see_a_long_step_noise_and_a_lost_point() {
    let spoils = [Spoil::Step(1.02), Spoil::Noise(1e-9), Spoil::Lost];
    turns_red("single-points", Variant::Bspline2, &spoils);
}

#[test]
fn slender_cells_see_an_axis_that_is_preferred() {
    turns_red("slender-cells", Variant::Bspline2, &[Spoil::Skewed(1e-9)]);
}

#[test]
fn checkerboard_sees_a_transfer_that_does_not_filter() {
    assert_eq!(judge("checkerboard", Variant::Apic, &Variant::Apic).word(), "pass");
    assert_eq!(judge("checkerboard", Variant::Apic, &Variant::Bspline2).word(), "fail");
}

#[test]
fn long_time_sees_dissipation_and_noise() {
    turns_red("long-time", Variant::TpmVpQuadratic, &[Spoil::Noise(1.0)]);
    let pic = |settings: &mut Settings| settings.blend = Blend::PerStep(0.0);
    let damped = Respelt { variant: Variant::TpmVpQuadratic, change: pic };
    assert_eq!(judge("long-time", Variant::TpmVpQuadratic, &damped).word(), "fail");
}

#[test]
fn disorder_sees_a_long_step() {
    turns_red("disorder", Variant::TpmVp, &[Spoil::Step(1.02), Spoil::Density(1.001)]);
}

#[test]
fn what_cannot_be_built_is_not_judged() {
    let verdict = judge("ledger", Variant::Apic, &Variant::Apic);
    assert!(matches!(&verdict, Verdict::None(reason) if reason.contains("nothing is rearranged")));
    assert_eq!(verdict.cell(), "–");
}

#[test]
fn the_alternating_field_is_its_nodes_and_linear_between() {
    for (place, value) in [
        ([0.0, 0.0], 1.0),
        ([1.0, 0.0], -1.0),
        ([1.0, 3.0], 1.0),
        ([0.5, 0.2], 0.0),
        ([0.25, 0.25], 0.25),
    ] {
        assert_eq!(checkerboard::field(place), value);
    }
    let simulation = Variant::Mpm
        .build_2d(&checkerboard::scene(0.3), &Settings::default())
        .expect("a simulation");
    assert!((checkerboard::amplitude(simulation.as_ref()) - 1.0).abs() < 1e-12);
}

#[test]
fn the_pressure_of_the_patch_solves_its_equation() {
    // ∇²p = 2 ρ ω²; the middle of a square, from Prandtl's function of torsion.
    let middle = tension::pressure([0.5, 0.5]);
    assert!((middle + 0.147_343).abs() < 1e-4, "{middle}");
    assert!(tension::pressure([0.0, 0.3]).abs() < 1e-15);
    let d = 0.05;
    let around: f64 = [[d, 0.0], [-d, 0.0], [0.0, d], [0.0, -d]]
        .iter()
        .map(|[x, y]| tension::pressure([0.4 + x, 0.6 + y]) - tension::pressure([0.4, 0.6]))
        .sum();
    assert!((around / (d * d) - 2.0).abs() < 0.02, "{}", around / (d * d));
}

#[test]
fn the_vortex_keeps_its_volume_and_its_gradient() {
    let (d, place) = (1e-6, [0.3, 0.8]);
    let ([u, v], gradient) = vortex::velocity(place);
    let ([along, _], _) = vortex::velocity([place[0] + d, place[1]]);
    let ([_, up], _) = vortex::velocity([place[0], place[1] + d]);
    assert!(((along - u) / d - gradient[0][0]).abs() < 1e-5);
    assert!(((up - v) / d - gradient[1][1]).abs() < 1e-5);
    assert!((gradient[0][0] + gradient[1][1]).abs() < 1e-15);
}

#[test]
fn impulses_spreads_and_slopes_of_known_curves() {
    let ramp: Vec<(f64, f64)> =
        (0..=30).map(|k| (0.1 * f64::from(k), 0.2 * f64::from(k))).collect();
    // p = 2 T from 0.55 to 1.55.
    assert!((impact::impulse(&ramp, 0.55) - 2.1).abs() < 1e-12);
    assert!(impact::impulse(&ramp, 2.5).is_nan() && impact::impulse(&ramp, f64::NAN).is_nan());
    assert_eq!(locking::spread(&[1.0, 3.0, 2.0]), 1.0);
    assert!((slope(&[(0.0, 1.0), (1.0, 3.5), (2.0, 6.0)]) - 2.5).abs() < 1e-15);
}

#[test]
fn verdicts_say_what_failed() {
    let case = &CASES[1];
    let rows = |values: [f64; 3]| findings(&RUNS[1], Ok(values.to_vec()), 0.0).rows;
    let of = |values| Verdict::of(case, &Outcome::Completed, &rows(values)).cell();
    assert_eq!(of([1.9, 1.5, 0.1]), "✓ 1.9");
    assert_eq!(of([0.9, 1.5, 0.1]), "✗ 0.90");
    assert_eq!(of([1.9, 734.2, 0.1]), "✗ over-regular 734");
    assert_eq!(of([1.9, f64::INFINITY, 0.1]), "✗ over-regular no number");
    let reason = "density of point 7 at (0.1, 0.2) m: point 7 has density -1 kg/m³".to_owned();
    let burst = Outcome::BlownUp { step: 38, time: 0.1, reason };
    let cell = Verdict::of(case, &burst, &rows([f64::NAN; 3])).cell();
    assert_eq!(cell, "✗ burst in step 39: density of point 7");
    let shown = [0.0, 3.24e-4, 0.123, 1.0, 12.34, 5000.0].map(digits);
    assert_eq!(shown, ["0", "3.2e-4", "0.12", "1", "12", "5.0e3"]);
}

#[test]
fn every_verdict_is_on_record() {
    assert_eq!(strangers(), 0);
    for variant in Variant::ALL.map(Variant::name) {
        for case in &CASES {
            let word = on_record(variant, case.name);
            assert!(matches!(word, Some("pass" | "fail" | "none")), "{variant}, {}", case.name);
        }
    }
}

#[test]
fn every_hard_case_has_a_run_that_measures_its_goals_and_a_paragraph() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/hard-cases.md");
    let page = std::fs::read_to_string(page).expect("the page");
    for case in &CASES {
        let run = RUNS.iter().find(|run| run.name == case.run).expect("its run");
        assert!(case.goals.iter().all(|goal| run.quantities.contains(&goal.quantity)));
        assert!(page.contains(&format!("**{}**", case.name)), "{}", case.name);
    }
}

#[test]
fn tiers_grow_and_no_record_gives_no_check() {
    let count = |tier| HardCases.runs(tier).len();
    assert!(count(Tier::Smoke) < count(Tier::Paper) && count(Tier::Paper) < count(Tier::Full));
    assert_eq!(count(Tier::Full), Variant::ALL.len() * RUNS.len());
    assert!(HardCases.checks(&[]).is_empty());
}
