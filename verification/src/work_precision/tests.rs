use super::*;

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
        bytes: 32.0,
        touches,
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
    let Some(crate::report::Content::Table(gaps)) = table("wp_gaps") else { panic!("no gaps") };
    assert_eq!(gaps.rows.len(), 1);
    let Some(crate::report::Content::Table(ranking)) = table("wp_ranking_touches") else {
        panic!("no ranking")
    };
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
