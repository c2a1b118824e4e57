//! From the records of this case to checks, a figure and tables.

use transpoint::Variant;

use super::growth::quantity;
use super::{COURANTS, DEFECTIVE, LAYOUTS, LINEAR, NEUTRAL};
use crate::judge::Check;
use crate::number::scientific;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// Largest change of a uniform velocity in one step: round-off of the Jacobian.
const TRANSLATION: f64 = 1e-11;

/// What a prototype in another language found in 1D (jitter 0.9, 10 seeds, 2 and 3 points per cell):
/// variant, setting, its growth per step at C = 0.1 and C = 1.0, `None` for below 10⁻¹⁴.
const GUIDES: [(&str, &str, Option<[f64; 2]>); 9] = [
    ("tpm", "usl", Some([9e-4, 4e-4])),
    ("tpm", "musl", Some([2e-3, 3e-2])),
    ("tpm-vp", "linear/usl", None),
    ("tpm-vp", "linear/musl", None),
    ("tpm-vp", "quadratic/usl", None),
    ("tpm-vp", "quadratic/musl", None),
    ("mpm", "musl", None),
    ("bspline2", "musl", None),
    ("bspline3", "musl", None),
];

fn growth(record: &RunRecord, courant: f64) -> f64 {
    value(record, "growth", courant)
}

fn value(record: &RunRecord, measure: &str, courant: f64) -> f64 {
    record.row(&quantity(measure, courant), "max").map_or(f64::NAN, |row| row.value)
}

/// All verdicts.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    let mut check = |record: &RunRecord, name: &str, measured: f64, upper: f64| {
        let spec = &record.spec;
        checks.push(Check {
            case: spec.case.clone(),
            variant: spec.variant.clone(),
            layout: spec.layout.clone(),
            check: name.to_owned(),
            measured,
            lower: None,
            upper: Some(upper),
            miss: None,
        });
    };
    for record in records.iter().filter(|record| record.spec.label("default") == "yes") {
        let uniform = record.row("translation", "max").map_or(f64::NAN, |row| row.value);
        check(record, "uniform-velocity", uniform, TRANSLATION);
        match record.spec.variant.as_str() {
            // Weakly unstable as printed: reported, with no bound to hold.
            "tpm" => {}
            // In 1D the divergence of the cell is that at the point.
            "tpm-vp0" if record.spec.layout == "1d" => {}
            // The vertex mean filters out the cells' checkerboard: growth is linear, not exponential.
            "tpm-vp" => check(record, "growth@0.5", growth(record, 0.5), DEFECTIVE),
            _ => {
                check(record, "growth@0.5", growth(record, 0.5), NEUTRAL);
                check(record, "doubling@0.5", value(record, "doubling", 0.5), LINEAR);
            }
        }
    }
    checks
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let accuracy = |stem: &str, title: &str, content| Artifact {
        stem: stem.to_owned(),
        title: title.to_owned(),
        area: Area::Accuracy,
        content,
    };
    vec![
        accuracy("spectral_growth", "Growth per step", Content::Figure(figure(records))),
        accuracy(
            "spectral_growth_table",
            "Growth per step by method, setting and Courant number",
            Content::Table(table(records, policy)),
        ),
        accuracy(
            "spectral_prototype",
            "Growth per step beside a prototype",
            Content::Table(comparison(records)),
        ),
    ]
}

fn table(records: &[RunRecord], policy: &str) -> Table {
    let mut columns: Vec<String> = ["layout", "variant", "setting"].map(str::to_owned).to_vec();
    columns.extend(COURANTS.iter().map(|courant| format!("C={courant}")));
    columns.extend(["neutral up to C", "linear growth"].map(str::to_owned));
    let row = |record: &RunRecord| {
        let spec = &record.spec;
        let mut row: Vec<Cell> =
            [&spec.layout, &spec.variant, spec.label("setting")].map(Cell::from).to_vec();
        row.extend(COURANTS.iter().map(|&courant| Cell::Value(growth(record, courant))));
        row.push(Cell::from(neutral_up_to(record).as_str()));
        row.push(Cell::from(if grows_linearly(record) { "yes" } else { "" }));
        row
    };
    let note = format!(
        "Largest growth per step ρ(A) − 1 over the layouts; up to {NEUTRAL:e} it counts as neutral and \
         is given by its decade. Linear growth: the powers of A grow like N at a Courant number where no \
         eigenvalue exceeds 1 by 10⁻⁶ (a defective eigenvalue 1, whose numerical value is then off by the \
         root of round-off). {policy}"
    );
    Table { columns, rows: records.iter().map(row).collect(), note }
}

/// Largest Courant number up to which all growth is neutral.
fn neutral_up_to(record: &RunRecord) -> String {
    let neutral = |courant: &&f64| {
        growth(record, **courant) <= NEUTRAL && value(record, "doubling", **courant) < LINEAR
    };
    COURANTS.iter().take_while(neutral).last().map_or("none".to_owned(), f64::to_string)
}

/// Whether the powers grow although all eigenvalues are 1 to the root of round-off.
fn grows_linearly(record: &RunRecord) -> bool {
    COURANTS.iter().any(|&courant| {
        growth(record, courant) <= DEFECTIVE && value(record, "doubling", courant) >= LINEAR
    })
}

fn comparison(records: &[RunRecord]) -> Table {
    let columns =
        ["variant", "setting", "Courant number", "prototype", "1d", "1d-mild", "verdicts agree"];
    let mut rows = Vec::new();
    for (variant, setting, guide) in GUIDES {
        for (courant, guide) in [(0.1, guide.map(|g| g[0])), (1.0, guide.map(|g| g[1]))] {
            let [strong, mild] = ["1d", "1d-mild"].map(|layout| {
                let found = records.iter().find(|record| {
                    (record.spec.variant == variant)
                        && (record.spec.layout == layout)
                        && (record.spec.label("setting") == setting)
                });
                found.map_or(f64::NAN, |record| growth(record, courant))
            });
            let agree = |found: f64| (found > NEUTRAL) == guide.is_some();
            let verdict = match (agree(strong), agree(mild)) {
                _ if strong.is_nan() || mild.is_nan() => "",
                (true, true) => "yes",
                (false, true) => "only for 1d-mild",
                (true, false) => "only for 1d",
                (false, false) => "no",
            };
            let guide = guide.map_or("< 1e-14".to_owned(), scientific);
            rows.push(vec![
                Cell::from(variant),
                Cell::from(setting),
                Cell::Text(courant.to_string()),
                Cell::Text(guide),
                Cell::Value(strong),
                Cell::Value(mild),
                Cell::from(verdict),
            ]);
        }
    }
    let note = "The prototype was a separate program in another language, 10 seeds, 2 and 3 points per \
                cell; its jitter of 0.9 is taken for a full width, which is the layout 1d-mild. A guide, \
                not evidence."
        .to_owned();
    Table { columns: columns.map(str::to_owned).to_vec(), rows, note }
}

/// Growth over Courant number: above, methods as they are by default; below, settings of `tpm-vp`.
fn figure(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for of_settings in [false, true] {
        for layout in ["1d", "2d"] {
            let chosen = records.iter().filter(|record| {
                let spec = &record.spec;
                spec.layout == layout
                    && if of_settings {
                        spec.variant == "tpm-vp" && !spec.label("setting").ends_with("usf")
                    } else {
                        spec.label("default") == "yes"
                    }
            });
            let curves =
                chosen.enumerate().map(|(index, record)| curve(record, of_settings, index));
            let (_, dimension, cells, jitter) =
                LAYOUTS.into_iter().find(|known| known.0 == layout).unwrap_or(LAYOUTS[0]);
            let what = if of_settings { "tpm-vp by setting" } else { "methods, default settings" };
            panels.push(Panel {
                title: format!("{dimension}D, {cells} cells per axis, jitter ±{jitter}: {what}"),
                x: Axis::linear("Courant number c Δt √D / h").with_ticks([0.1, 0.3, 0.5, 0.7, 0.9]),
                y: Axis::log("growth per step ρ(A) − 1")
                    .with_ticks([1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0]),
                legend: if of_settings { "divergence/update" } else { "method" }.to_owned(),
                curves: curves.collect(),
                slopes: Vec::new(),
            });
        }
    }
    let title = "Linearised step at frozen, disordered points; up to 10⁻¹⁰ is neutral".to_owned();
    Figure { title, panels, columns: 2 }
}

fn curve(record: &RunRecord, of_settings: bool, index: usize) -> Curve {
    let spec = &record.spec;
    let style = Variant::ALL.iter().position(|variant| variant.name() == spec.variant);
    let points = COURANTS.iter().map(|&courant| (courant, growth(record, courant).max(1e-15)));
    Curve {
        label: if of_settings {
            spec.label("setting").replace("vertex-mean", "vertex")
        } else {
            spec.variant.clone()
        },
        style: if of_settings { index } else { style.unwrap_or(0) },
        // A missing value is a gap; the maximum above would hide it.
        points: points.filter(|&(courant, _)| !growth(record, courant).is_nan()).collect(),
        look: Look::Marked,
    }
}
