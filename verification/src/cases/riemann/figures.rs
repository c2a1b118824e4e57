//! Curves of pressure over x.

use super::results::find;
use super::scene::exact;
use super::{INTERFACE, LAYOUTS, PRESSURES, SPACING, TIME};
use crate::case::Profile;
use crate::number::significant;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};

/// Colour of the exact profile: black, which no method has.
const EXACT: usize = 2;
/// Markers along a curve.
const MARKERS: usize = 12;

/// Curves of one row of panels: method, dissipation, colour.
struct Group {
    title: &'static str,
    runs: &'static [(&'static str, &'static str, usize)],
}

/// Rows of panels from top to bottom.
const GROUPS: [Group; 4] = [
    Group {
        title: "MPM, carried pressure, no dissipation",
        runs: &[
            ("mpm", "flip", 1),
            ("gimp", "flip", 3),
            ("bspline2", "flip", 4),
            ("apic", "affine", 5),
        ],
    },
    Group {
        title: "velocity-pressure or TPM, no dissipation",
        runs: &[
            ("mpm-vp", "flip", 8),
            ("tpm", "flip", 0),
            ("tpm-vp0", "flip", 6),
            ("tpm-vp2", "flip", 7),
        ],
    },
    Group {
        title: "relaxed towards PIC, τ = 2 h/c₀",
        runs: &[
            ("mpm", "relaxed", 1),
            ("mpm-vp", "relaxed", 8),
            ("tpm", "relaxed", 0),
            ("tpm-vp0", "relaxed", 6),
            ("tpm-vp2", "relaxed", 7),
        ],
    },
    Group {
        title: "bulk viscosity",
        runs: &[
            ("mpm", "viscous", 1),
            ("mpm-vp", "viscous", 8),
            ("tpm", "viscous", 0),
            ("tpm-vp0", "viscous", 6),
            ("tpm-vp2", "viscous", 7),
        ],
    },
];

/// The whole tube.
pub(super) fn whole(records: &[RunRecord]) -> Figure {
    figure(records, "Pressure jump in water at t = 5 ms", [0.0, 1.0])
}

/// The surroundings of the shock.
pub(super) fn shock(records: &[RunRecord]) -> Figure {
    figure(records, "Pressure jump in water at t = 5 ms, about the shock", [0.7, 0.77])
}

fn figure(records: &[RunRecord], title: &str, range: [f64; 2]) -> Figure {
    let mut panels = Vec::new();
    for group in &GROUPS {
        for layout in LAYOUTS {
            let exact = Curve {
                label: "exact".to_owned(),
                style: EXACT,
                points: exact_curve(range),
                look: Look::Line,
            };
            let runs = group.runs.iter().filter_map(|&(method, dissipation, style)| {
                let record = find(records, method, layout, dissipation)?;
                Some(curve(record, style, range))
            });
            panels.push(Panel {
                title: format!("{layout} points: {}", group.title),
                x: Axis::linear("x, m"),
                y: Axis::linear("mean pressure of a column of cells, Pa"),
                legend: "method".to_owned(),
                curves: std::iter::once(exact).chain(runs).collect(),
                slopes: Vec::new(),
            });
        }
    }
    Figure { title: title.to_owned(), panels, columns: LAYOUTS.len() }
}

fn curve(record: &RunRecord, style: usize, [from, to]: [f64; 2]) -> Curve {
    let mut points = record.profile("pressure").map(Profile::pairs).unwrap_or_default();
    points.retain(|&(x, _)| (from..=to).contains(&x));
    Curve { label: record.spec.variant.clone(), style, points, look: Look::Sparse(MARKERS) }
}

/// Corners of the exact profile; within the fan, 0.05 cells wide, it is straight to any eye.
pub(super) fn exact_curve([from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let Ok(solution) = exact() else { return Vec::new() };
    let star = solution.pressure(solution.star());
    let at = |speed: f64| INTERFACE + speed * TIME;
    let (left, right) = (solution.left_wave(), solution.right_wave());
    let corners = [
        (at(left.head()), PRESSURES[0]),
        (at(left.tail()), star),
        (at(right.tail()), star),
        (at(right.head()), PRESSURES[1]),
    ];
    let end = |x: f64| (x, solution.pressure(solution.at((x - INTERFACE) / TIME)));
    let inside = corners.into_iter().filter(|&(x, _)| x > from && x < to);
    std::iter::once(end(from)).chain(inside).chain([end(to)]).collect()
}

/// The curves of the figures side by side, one row per column of cells.
pub(super) fn profiles(records: &[RunRecord]) -> Table {
    let n_cells = (1.0 / SPACING).round() as usize;
    let mut columns = vec!["x".to_owned()];
    let mut values: Vec<Vec<f64>> = Vec::new();
    for layout in LAYOUTS {
        for &(method, dissipation, _) in GROUPS.iter().flat_map(|group| group.runs) {
            let found = find(records, method, layout, dissipation)
                .and_then(|record| record.profile("pressure"));
            let Some(profile) = found else { continue };
            columns.push(format!("{method} {dissipation} {layout}"));
            let mut column = vec![f64::NAN; n_cells];
            for (x, pressure) in profile.pairs() {
                let cell = (x / SPACING) as usize;
                if let Some(place) = column.get_mut(cell) {
                    *place = pressure;
                }
            }
            values.push(column);
        }
    }
    let rows = (0..n_cells).map(|cell| {
        let center = Cell::Text(significant((cell as f64 + 0.5) * SPACING));
        let pressures = values.iter().map(|column| Cell::Value(column[cell]));
        std::iter::once(center).chain(pressures).collect()
    });
    let note =
        "Mean pressure in Pa of the points in the cells whose centres are at x, m.".to_owned();
    Table { columns, rows: rows.collect(), note }
}
