//! What the paper says of the dam break, and what was found.

use super::policy::Difference;
use super::results::{find, value};
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// A claim, the paper's number, and ours.
type Claim = (&'static str, &'static str, f64);

/// Claims of Sect. 4.3 of \[Song2020\] in the order of its figures.
pub(super) fn table(records: &[RunRecord]) -> Table {
    let row =
        |(claim, paper, ours): Claim| vec![Cell::from(claim), Cell::from(paper), Cell::Value(ours)];
    Table {
        columns: ["claim", "paper", "here"].map(str::to_owned).to_vec(),
        rows: claims(records).into_iter().map(row).collect(),
        note: "Times T; heights and numbers as in the tables above, from `tpm-vp2`. The paper does not print its \
               time integration, support, blend or surface treatment; `tpm` with what it prints bursts \
               here. Time saved is that of one run beside the other on this machine, see timing/tables; \
               work saved is the share of point updates."
            .to_owned(),
    }
}

fn claims(records: &[RunRecord]) -> Vec<Claim> {
    let of = |variant: &str, layout: &str, difference, quantity: &str, norm: &str| {
        find(records, variant, layout, difference)
            .map_or(f64::NAN, |record| value(record, quantity, norm))
    };
    let dense =
        |quantity: &str, norm: &str| of("tpm-vp2", "dense", Difference::None, quantity, norm);
    let coarse = |difference, quantity: &str, norm: &str| {
        of("tpm-vp2", "coarse", difference, quantity, norm)
    };
    let split =
        |difference, quantity: &str, norm: &str| of("mpm-vp", "coarse", difference, quantity, norm);
    let rebound =
        |difference| coarse(difference, "water", "rebound-mean") / dense("water", "rebound-mean");
    let updates = |difference| {
        find(records, "tpm-vp2", "coarse", difference)
            .and_then(|record| record.counters.get("n_point_updates"))
            .map_or(f64::NAN, |&count| count as f64)
    };
    let saved = 100.0 * (1.0 - updates(Difference::FillReduce) / updates(Difference::Fill));
    let (fill, reduce) = (Difference::Fill, Difference::FillReduce);
    let (quarters, budget, share) =
        (Difference::FillQuarters, Difference::FillBudget, Difference::FillShare);
    vec![
        ("water at the probe (Fig. 13)", "1.24", dense("water", "wetting")),
        ("second peak at the probe (Fig. 13)", "3.1", dense("p-160mm", "second-peak-time")),
        (
            "dense points without rearrangement: fractures (Fig. 14)",
            "none",
            dense("fractures", "most"),
        ),
        (
            "one point per cell, no rearrangement: fractures (Fig. 15)",
            "severe",
            coarse(Difference::None, "fractures", "most"),
        ),
        (
            "with filling: fractures at written instants (Fig. 16)",
            "none",
            coarse(fill, "fractures", "most"),
        ),
        ("with filling: rebound over that of Fig. 14 (Fig. 16)", "as in Fig. 14", rebound(fill)),
        ("with N_m = 4: rebound over that of Fig. 14", "as in Fig. 14", rebound(reduce)),
        (
            "with N_m = 4: growth of points after T = 2 (Fig. 17)",
            "none after 1.64",
            coarse(reduce, "points", "growth"),
        ),
        ("with N_m = 4: work saved, %", "15 (time)", saved),
        (
            "four points per fracture: most fractures at written instants",
            "-",
            coarse(Difference::FillQuarters, "fractures", "most"),
        ),
        ("four points per fracture: rebound over that of Fig. 14", "-", rebound(quarters)),
        (
            "fills that create at most 2 % of the mass: most fractures",
            "-",
            coarse(Difference::FillBudget, "fractures", "most"),
        ),
        ("fills that create at most 2 % of the mass: rebound", "-", rebound(budget)),
        (
            "β = 0.9 in place of empty neighbours (Sect. 2.3), filled: end of the run",
            "-",
            coarse(share, "run", "end"),
        ),
        ("β = 0.9, filled: rebound over that of Fig. 14", "-", rebound(share)),
        (
            "MPM, one point per cell: fractures without splitting (Fig. 18)",
            "severe",
            split(Difference::ModifiedLast, "fractures", "most"),
        ),
        (
            "MPM, split by volume (Fig. 18)",
            "does not help",
            split(Difference::SplitVolume, "fractures", "most"),
        ),
        (
            "MPM, split by stretch: end of the run",
            "-",
            split(Difference::SplitStretch, "run", "end"),
        ),
    ]
}
