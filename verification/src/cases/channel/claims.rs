//! What the paper says of the channel, and what was found.

use super::results::{find, value};
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// Claims of Sect. 4.4 of \[Song2020\] on Fig. 19-21.
pub(super) fn table(records: &[RunRecord]) -> Table {
    let of = |run: &str, speed: &str, quantity: &str, norm: &str| {
        find(records, "tpm-vp2", "100mm", run, speed)
            .map_or(f64::NAN, |record| value(record, quantity, norm))
    };
    let mut claims = Vec::new();
    for run in ["columns", "flux"] {
        for speed in ["0.2", "0.4", "0.6", "0.8"] {
            claims.push((
                format!("dm/dt over ρ v₀ h_in before it flows out, `{run}`, v₀ = {speed} m/s"),
                "1 (a line)",
                of(run, speed, "grid-mass", "slope"),
            ));
        }
    }
    let steady = [
        ("m(3 s)/m(2 s) − 1", "0 (steady at t = 2.0)", "growth@2"),
        ("mass within 1 % over each second since t, s", "2.0", "since"),
        ("change of the mass in the last second of 12 s", "0", "variation"),
    ];
    claims.extend(steady.map(|(claim, paper, norm)| {
        (format!("{claim}, `flux`, v₀ = 0.4 m/s"), paper, of("flux", "0.4", "steady", norm))
    }));
    let row = |(claim, paper, ours): (String, &str, f64)| {
        vec![Cell::Text(claim), Cell::from(paper), Cell::Text(format!("{ours:.4}"))]
    };
    Table {
        columns: ["claim", "paper", "here"].map(str::to_owned).to_vec(),
        rows: claims.into_iter().map(row).collect(),
        note: "Grid mass for the slopes, as in the tables above. The paper prints neither h_in nor what it means \
               by steady; h_in = 0.1 m here. The volume-of-fluid run of the same inlet is not steady at 2 s \
               either: its mass grows by 16 % within the next second."
            .to_owned(),
    }
}
