use std::collections::BTreeSet;

use transpoint::Variant;

use super::*;
use crate::case::Outcome;

#[test]
fn runs_have_different_names_and_every_tier_is_part_of_the_sweep() {
    for benchmark in &ALL {
        let sweep: BTreeSet<String> = benchmark.sweep().iter().map(RunSpec::slug).collect();
        assert_eq!(sweep.len(), benchmark.sweep().len(), "{}", benchmark.name());
        for tier in [Tier::Smoke, Tier::Paper, Tier::Full] {
            for run in benchmark.runs(tier) {
                assert!(sweep.contains(&run.slug()), "{}", run.slug());
            }
        }
    }
}

#[test]
fn levels_are_four_and_get_finer() {
    for benchmark in &ALL {
        assert!(benchmark.levels() >= 4, "{}", benchmark.name());
        let cells: Vec<usize> =
            (0..benchmark.levels()).map(|level| benchmark.resolution(level, 2).cells).collect();
        assert!(cells.windows(2).all(|pair| pair[0] < pair[1]), "{}", benchmark.name());
    }
}

/// The coarsest run of each problem by the one of two methods that ends it: errors are there and below the answer itself.
#[test]
fn every_problem_runs_at_its_coarsest() {
    for benchmark in &ALL {
        let run = |variant| {
            let spec = benchmark.spec(variant, 0, 2, Courant::Common);
            benchmark.execute(&spec, &Progress::silent())
        };
        // Points of FLIP part in `cavity` before the flow is steady.
        let mut findings = run(Variant::TpmVpQuadratic);
        if findings.outcome != Outcome::Completed {
            findings = run(Variant::Apic);
        }
        assert_eq!(findings.outcome, Outcome::Completed, "{}", benchmark.name());
        for (kind, row) in benchmark.errors().iter().zip(&findings.rows) {
            assert_eq!(row.quantity, kind.quantity);
            assert!(row.value < 1.0, "{}: {} {}", benchmark.name(), kind.quantity, row.value);
        }
    }
}
