use std::collections::BTreeMap;

use super::*;
use crate::benchmark::{Courant, OF_THE_RUN};
use crate::case::{Outcome, Row};
use crate::machine::Manifest;
use crate::report::{Area, Content};
use transpoint::Variant;

fn run(variant: &str, level: usize, error: f64, touches: f64, seconds: f64) -> Measured {
    Measured {
        variant: variant.to_owned(),
        points: "2".to_owned(),
        courant: "common".to_owned(),
        courant_number: 0.5,
        level,
        spacing: 0.1,
        error,
        steps: 10.0,
        n_points: 8.0,
        bytes_per_point: 32.0,
        touches,
        point_steps: 80.0,
        instructions: 8000.0,
        bytes: 5120.0,
        seconds,
        reason: if error.is_nan() {
            "step 3: density of point 1".to_owned()
        } else {
            String::new()
        },
    }
}

#[test]
fn advice_is_the_cheapest_run_of_each_method_that_reached_the_error() {
    let runs = [
        run("mpm", 0, 0.02, 1.0, 0.1),
        run("mpm", 1, 0.009, 8.0, 0.8),
        run("mpm", 2, 0.004, 64.0, 6.4),
        run("apic", 1, 0.008, 16.0, 0.7),
        run("tpm", 1, f64::NAN, 1.0, 0.01),
    ];
    let advice = advise(&runs, 0.01);
    let names: Vec<_> =
        advice.iter().map(|advice| (advice.run.variant.as_str(), advice.cost)).collect();
    assert_eq!(names, [("apic", 0.7), ("mpm", 0.8)]);
    assert!(advise(&runs, 1e-3).is_empty());
}

#[test]
fn advice_counts_touches_where_nothing_was_timed() {
    let runs = [run("mpm", 1, 0.009, 8.0, f64::NAN), run("apic", 1, 0.008, 16.0, f64::NAN)];
    let advice = advise(&runs, 0.01);
    assert_eq!(advice[0].run.variant, "mpm");
    assert_eq!(advice[0].cost, 8.0);
}

#[test]
fn a_burst_leaves_a_gap_and_a_reason_and_no_place_on_the_front() {
    let runs = vec![run("mpm", 0, f64::NAN, 1.0, 0.1), run("apic", 0, 0.1, 2.0, 0.2)];
    let problems = [(&benchmark::ALL[0], runs)];
    let artifacts = artifacts::all(&problems, Cost::Touches);
    let page = artifacts::page(&artifacts, Cost::Touches);
    let table = |stem: &str| {
        artifacts.iter().find(|artifact| artifact.stem == stem).map(|artifact| &artifact.content)
    };
    let Some(Content::Table(gaps)) = table("wp_gaps") else { panic!("no gaps") };
    assert_eq!(gaps.rows.len(), 1);
    let Some(Content::Table(ranking)) = table("wp_ranking_touches") else { panic!("no ranking") };
    assert_eq!(ranking.rows[0][0], crate::report::table::Cell::Text("apic".to_owned()));
    assert!(page.contains("Speed against error"));
}

#[test]
fn every_timing_has_its_own_name_and_joins_the_runs_of_its_resolution() {
    for timing in timing::all() {
        let runs = timing.runs(crate::case::Tier::Full);
        let names: std::collections::BTreeSet<_> =
            runs.iter().map(crate::case::RunSpec::slug).collect();
        assert_eq!(names.len(), runs.len());
    }
}

/// A run of 10 steps with 24 points of 40 bytes of state, but for one step with 25.
fn record(variant: Variant, counters: &[(&str, u64)]) -> RunRecord {
    let spec = benchmark::ALL[0].spec(variant, 0, 3, Courant::Common);
    let fact = |quantity: &str, value: f64| Row { value, ..Row::missing(quantity, OF_THE_RUN) };
    RunRecord {
        key: String::new(),
        spec,
        outcome: Outcome::Completed,
        rows: vec![fact("steps", 10.0), fact("points", 24.0), fact("bytes-per-point", 40.0)],
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: counters.iter().map(|&(name, n)| (name.to_owned(), n)).collect(),
        seconds: 0.0,
        manifest: Manifest::gather(1, 1),
    }
}

#[test]
fn machine_free_costs_follow_the_points_of_every_step() {
    let records = [record(Variant::Mpm, &[("n_point_updates", 241)])];
    let points = measured::collect(&benchmark::ALL[0], &records, &[]);
    let flow = instructions::Flow::Inviscid;
    let kind = instructions::Kind { variant: "mpm", dimension: 1, points_per_axis: 3, flow };
    let instructions = 241.0 * instructions::per_point_step(&kind);
    assert_eq!(points[0].cost(Cost::PointSteps), 241.0);
    assert_eq!(points[0].cost(Cost::Bytes), 2.0 * 40.0 * 241.0);
    assert_eq!(points[0].cost(Cost::Instructions), instructions);
    assert!(points[0].cost(Cost::Seconds).is_nan());
}

#[test]
fn what_was_not_counted_is_a_gap() {
    let mut unknown = record(Variant::Mpm, &[("n_point_updates", 241)]);
    "nobody".clone_into(&mut unknown.spec.variant);
    let records = [record(Variant::Mpm, &[]), unknown];
    let points = measured::collect(&benchmark::ALL[0], &records, &[]);
    for cost in [Cost::PointSteps, Cost::Bytes, Cost::Instructions] {
        assert!(points[0].cost(cost).is_nan(), "{cost:?}");
    }
    assert_eq!(points[1].cost(Cost::PointSteps), 241.0);
    assert!(points[1].cost(Cost::Instructions).is_nan());
}

#[test]
fn every_scale_has_its_tables_and_a_page_that_leads_to_the_others() {
    let problems = [(&benchmark::ALL[0], vec![run("mpm", 0, 0.1, 1.0, 0.1)])];
    for cost in Cost::ALL {
        let artifacts = artifacts::all(&problems, cost);
        let has = |stem: &str| {
            artifacts.iter().any(|artifact| artifact.stem == format!("{stem}_{}", cost.name()))
        };
        for stem in ["wp_ranking", "wp_cheapest", "wp_cost_of_1pct", "wp_error_in_budget"] {
            assert!(has(stem), "{stem} {cost:?}");
        }
        assert_eq!(has("wp_advected_wave"), cost.shows_problems());
        assert_eq!(has("wp_front_advected_wave"), cost.shows_problems());
        let page = artifacts::page(&artifacts, cost);
        for other in Cost::ALL {
            let leads = page.contains(&format!("[{}]({})", other.label(), other.page()));
            let beside = other != cost && other.area() == cost.area();
            assert_eq!(leads, beside, "{cost:?} to {other:?}");
        }
    }
    let pages: BTreeMap<_, _> =
        Cost::ALL.map(|cost| ((cost.area() == Area::Timing, cost.page()), cost.name())).into();
    assert_eq!(pages.len(), Cost::ALL.len());
}
