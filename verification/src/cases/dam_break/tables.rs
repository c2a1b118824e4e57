//! Tables of measures, with those of the experiment and of the volume-of-fluid runs beside.

use super::outside;
use super::policy::Difference;
use super::results::{find, value};
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// A column: quantity, norm, heading.
type Column = (&'static str, &'static str, &'static str);

const PRESSURE: [Column; 17] = [
    ("water", "wetting", "wetting"),
    ("p-160mm", "arrival", "arrival"),
    ("p-160mm", "mean", "mean 160"),
    ("p-120mm", "mean", "mean 120"),
    ("p-60mm", "mean", "mean 60"),
    ("p-20mm", "mean", "mean 20"),
    ("p-disc", "mean", "mean disc"),
    ("p-disc", "impulse", "impulse disc"),
    ("p-160mm", "first-peak", "1st peak"),
    ("p-160mm", "first-peak-time", "at T"),
    ("p-160mm", "second-peak", "2nd peak"),
    ("p-160mm", "second-peak-time", "at T"),
    ("p-disc", "second-peak", "2nd peak disc"),
    ("p-disc", "second-peak-time", "at T"),
    ("p-160mm", "noise", "noise"),
    ("p-160mm", "noise-before", "noise T<2.5"),
    ("p-160mm", "noise-after", "noise T>2.5"),
];

const WATER: [Column; 19] = [
    ("run", "end", "T at the end"),
    ("energy", "excess", "energy excess"),
    ("energy", "dissipated@2.5", "dissipated by 2.5"),
    ("energy", "dissipated@3.95", "by 3.95"),
    ("mass", "drift", "mass drift"),
    ("grid-mass", "drift", "grid mass drift"),
    ("points", "start", "points"),
    ("points", "end", "at the end"),
    ("points", "most-in-a-cell", "most in a cell"),
    ("fractures", "most", "fractures"),
    ("fractures", "most-lasting", "lasting"),
    ("water", "front-deviation", "front, m"),
    ("water", "depth2228-deviation", "depth 2.228, m"),
    ("water", "run-up", "run-up, m"),
    ("water", "rebound", "rebound, m"),
    ("water", "rebound-time", "at T"),
    ("water", "rebound-mean", "mean, m"),
    ("water", "rebound-top", "rebound top, m"),
    ("points", "growth", "growth after 2"),
];

/// Measures of the pressure on the wall.
pub(super) fn pressure(records: &[RunRecord], policy: &str) -> Table {
    let note = format!(
        "T and P without dimension. Wetting: first point within half a cell of 160 mm at the wall (VOF: \
         volume fraction above 0.1). Arrival: running mean over 0.05 T above 0.1. Means over 1.75 < T < \
         2.5; impulse over 1.2 < T < 3.6. Peaks: largest running mean in 1.2 < T < 1.75 and in 2.5 < T < 3.5. \
         Noise: root mean square of raw minus running mean at 160 mm from T = 1.3 on. The experiment is one \
         curve, of the disc of 90 mm. On the plateau it lies above every computation here: without air, a third \
         dimension and viscosity the pressure at 160 mm does not reach it (VOF 0.39 to 0.41, experiment \
         0.54), while at 120 mm it does. After the breaking wave has closed, the air that it traps \
         matters, which only VOF has. {policy}"
    );
    table(records, &PRESSURE, note)
}

/// Measures of the water as a whole.
pub(super) fn water(records: &[RunRecord], policy: &str) -> Table {
    let note = format!(
        "Energies over that at the start: largest excess, and what was dissipated. Mass drift: largest \
         relative change of the nominal mass of the points, and of the mass on the nodes since the first \
         step. Fractures: most cells empty although the fluid fills them, over the instants written, one every \
         0.05 T; lasting: those still there a step later, at whose start fills are made. Front (0.2 < T < \
         1.15) and depth at x = 2.228 m (1 < T < 2.5): root mean square difference from VOF on 10 mm \
         cells. Run-up: highest point in the last column of cells. Rebound: largest volume over width at x \
         = 2.725 m for T > 2.5, its largest running mean over 0.05 T (of few points the volume in a column of \
         cells jumps as they cross its sides), and the highest point there. {policy}"
    );
    table(records, &WATER, note)
}

fn table(records: &[RunRecord], columns: &[Column], note: String) -> Table {
    let cells = |of: &dyn Fn(&str, &str) -> f64| -> Vec<Cell> {
        columns.iter().map(|(quantity, norm, _)| cell(norm, of(quantity, norm))).collect()
    };
    let named = |names: [&str; 3], cells: Vec<Cell>| -> Vec<Cell> {
        names.map(Cell::from).into_iter().chain(cells).collect()
    };
    let of_run = |record: &RunRecord| {
        let spec = &record.spec;
        let cells = cells(&|quantity, norm| value(record, quantity, norm));
        named([&spec.layout, &spec.variant, spec.label("run")], cells)
    };
    let mut rows: Vec<Vec<Cell>> =
        records.iter().filter(|record| record.spec.layout != "slab").map(of_run).collect();
    for (spacing, name) in outside::RUNS {
        let cells = cells(&|quantity, norm| outside::measure(spacing, quantity, norm));
        rows.push(named(["", name, ""], cells));
    }
    rows.push(named(["", "experiment", ""], cells(&outside::measure_of_experiment)));
    let headings = ["layout", "method", "run"].into_iter();
    let columns = headings.chain(columns.iter().map(|column| column.2));
    Table { columns: columns.map(str::to_owned).collect(), rows, note }
}

fn cell(norm: &str, value: f64) -> Cell {
    match norm {
        "drift" | "excess" | "front-deviation" | "depth2228-deviation" => Cell::Value(value),
        "start" | "end" | "most" | "most-lasting" | "most-in-a-cell" if value.fract() == 0.0 => {
            Cell::Count(value as u64)
        }
        _ => Cell::Decimal(value),
    }
}

/// What every kind of rearrangement changed.
pub(super) fn ledger(records: &[RunRecord]) -> Table {
    let norms =
        ["cells", "added", "removed", "mass", "momentum-x", "kinetic", "potential", "compression"];
    let mut rows = Vec::new();
    for record in records {
        for kind in ["fill", "reduce", "shift", "split"] {
            let of = |norm: &str| value(record, &format!("ledger-{kind}"), norm);
            if !(of("cells") > 0.0) {
                continue;
            }
            let spec = &record.spec;
            let names = [&spec.layout, &spec.variant, spec.label("run"), kind].map(Cell::from);
            let count = |norm: &&str| Cell::Count(of(norm) as u64);
            let change = |norm: &&str| Cell::Value(of(norm));
            let cells = norms[..3].iter().map(count).chain(norms[3..].iter().map(change));
            rows.push(names.into_iter().chain(cells).collect());
        }
    }
    let columns = [
        "layout",
        "method",
        "run",
        "kind",
        "cells",
        "points added",
        "points removed",
        "mass, kg",
        "momentum x, kg m/s",
        "kinetic, J",
        "potential, J",
        "compression, J",
    ];
    let note = "Sums over the run of what rearrangement added to the totals, of nominal masses, per metre of \
                depth. At the start there are 720.8 kg and 2119 J."
        .to_owned();
    Table { columns: columns.map(str::to_owned).to_vec(), rows, note }
}

/// Wall time with and without N_m, of this machine.
pub(super) fn time(records: &[RunRecord]) -> Table {
    let of = |difference| find(records, "tpm-vp2", "coarse", difference);
    let base = of(Difference::Fill).map_or(f64::NAN, |record| record.seconds);
    let row = |difference: Difference| {
        let record = of(difference)?;
        Some(vec![
            Cell::from(difference.name()),
            Cell::Decimal(record.seconds),
            Cell::Decimal(record.seconds / base),
        ])
    };
    let runs = [Difference::None, Difference::Fill, Difference::FillReduce];
    Table {
        columns: ["run", "seconds", "over fill"].map(str::to_owned).to_vec(),
        rows: runs.into_iter().filter_map(row).collect(),
        note: "Coarse runs of tpm-vp2. The paper: 172.6 s with fills, 146.3 s with N_m = 4 too, a ratio \
               of 0.85."
            .to_owned(),
    }
}
