//! From the records of this case to checks, figures and tables.

use super::sweep::{HISTORY, NORMS, quantities, shown, theta};
use super::{NO_VOLUME, Study, VOLUMES};
use crate::cases::errors::{artifact, style};
use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// Methods held to the bounds, as variant and volume.
const CHECKED: [(&str, &str); 1] = [("tpm-vp2", "cell-center")];
/// Quantity, largest value at any offset; set beforehand. √(gH) and ρgH are the scales.
const BOUNDS: [(&str, f64); 2] = [("velocity", 1e-3), ("base-pressure", 5e-3)];

/// Colour of what is exact: that of no method shown here.
const EXACT: usize = 5;

/// The column at rest at its worst offset.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    bounds(records, &CHECKED)
}

/// Verdicts on the methods listed.
pub(super) fn bounds(records: &[RunRecord], methods: &[(&str, &str)]) -> Vec<Check> {
    let held = |record: &&RunRecord| {
        let spec = &record.spec;
        (spec.label("study") == Study::Settled.name())
            && methods.contains(&(spec.variant.as_str(), spec.label("volume")))
    };
    let check = |record: &RunRecord, (quantity, most): (&str, f64)| Check {
        case: record.spec.case.clone(),
        variant: record.spec.variant.clone(),
        layout: record.spec.layout.clone(),
        check: format!("settled-{quantity}-{}", record.spec.label("volume")),
        measured: record.row(quantity, "max").map_or(f64::NAN, |row| row.value),
        lower: None,
        upper: Some(most),
        miss: None,
    };
    let held = records.iter().filter(held);
    held.flat_map(|record| BOUNDS.map(|bound| check(record, bound))).collect()
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let figure = |stem: &str, title: &str, figure: Figure| {
        (!figure.panels.is_empty()).then(|| artifact(stem, title, Content::Figure(figure)))
    };
    let studies = [Study::Hydrostatic, Study::Settled, Study::SuddenLoad];
    let [rest, settled, load] = studies.map(|study| {
        let of_study = |record: &&RunRecord| record.spec.label("study") == study.name();
        let mut found: Vec<&RunRecord> = records.iter().filter(of_study).collect();
        found.sort_by_key(|record| (volume_rank(record), style(&record.spec.variant)));
        found
    });
    let shown = [
        ("velocity", Axis::log("max |v| / √(gH)")),
        ("base-pressure", Axis::log("max |error of base pressure| / ρgH")),
    ];
    let at_rest = over_offsets(&rest, "Column at rest", &shown);
    let from_settled = over_offsets(&settled, "Column at rest, settled before", &shown);
    let loaded = over_offsets(
        &load,
        "Column under a sudden load",
        &[
            ("base-pressure", Axis::log("rms error of base pressure / ρgH")),
            ("height", Axis::linear("effective height − H, cells")),
        ],
    );
    let table = |study, records: &[&RunRecord], text: &str| {
        Content::Table(table(study, records, &format!("{text} {policy}")))
    };
    let mut artifacts = Vec::new();
    artifacts.extend(figure("column_hydrostatic", "Column at rest", at_rest));
    artifacts.push(artifact(
        "column_hydrostatic_table",
        "Column at rest: worst offsets",
        table(
            Study::Hydrostatic,
            &rest,
            "Over 20 H/c: largest |v|/√(gH); largest error of the mean pressure of the lowest cells and \
             root mean square error of the pressure at the points, both over ρgH.",
        ),
    ));
    artifacts.extend(figure("column_settled", "Column at rest, settled before", from_settled));
    artifacts.push(artifact(
        "column_settled_table",
        "Column at rest, settled before: worst offsets",
        table(
            Study::Settled,
            &settled,
            "As before, from the method's own equilibrium: the state after 40 H/c with PIC, at rest.",
        ),
    ));
    artifacts.extend(figure("column_load", "Column under a sudden load", loaded));
    artifacts.extend(figure("column_load_history", "Base pressure", histories(&load)));
    artifacts.push(artifact(
        "column_load_table",
        "Column under a sudden load: worst offsets",
        table(
            Study::SuddenLoad,
            &load,
            "Over five periods: root mean square error of the base pressure over ρgH; height that the \
             period stands for less H, in cells; relative loss of the first harmonic per period.",
        ),
    ));
    artifacts
}

/// Place of the rule of a record.
fn volume_rank(record: &RunRecord) -> usize {
    let volume = record.spec.label("volume");
    VOLUMES.iter().position(|(name, _)| *name == volume).unwrap_or(VOLUMES.len())
}

/// Rules that have records, in their order.
fn volumes(records: &[&RunRecord]) -> Vec<&'static str> {
    let names = VOLUMES.iter().map(|(name, _)| *name).chain([NO_VOLUME]);
    names.filter(|name| records.iter().any(|record| record.spec.label("volume") == *name)).collect()
}

fn panel_title(volume: &str) -> String {
    if volume == NO_VOLUME {
        return "points carry their volume everywhere".to_owned();
    }
    format!("points of cut cells: {volume}")
}

/// One row of panels per quantity, one column per rule.
fn over_offsets(records: &[&RunRecord], title: &str, shown: &[(&str, Axis)]) -> Figure {
    let volumes = volumes(records);
    let mut panels = Vec::new();
    for (quantity, axis) in shown {
        for volume in &volumes {
            let curves = records
                .iter()
                .filter(|record| record.spec.label("volume") == *volume)
                .filter_map(|record| {
                    Some(Curve {
                        label: record.spec.variant.clone(),
                        style: style(&record.spec.variant),
                        points: record.profile(quantity)?.pairs(),
                        look: Look::Sparse(6),
                    })
                });
            panels.push(Panel {
                title: panel_title(volume),
                x: Axis::linear("offset θ of the surface, cells"),
                y: axis.clone(),
                legend: "method".to_owned(),
                curves: curves.collect(),
                slopes: Vec::new(),
            });
        }
    }
    Figure { title: title.to_owned(), panels, columns: volumes.len() }
}

/// Base pressure over time at one offset, one panel per rule.
fn histories(records: &[&RunRecord]) -> Figure {
    let volumes = volumes(records);
    let mut panels = Vec::new();
    for volume in &volumes {
        let of_volume = || records.iter().filter(|record| record.spec.label("volume") == *volume);
        let curve = |record: &RunRecord, name: &str, label: &str, look| {
            let points = record.profile(name)?.pairs();
            Some(Curve { label: label.to_owned(), style: style(label), points, look })
        };
        let mut curves: Vec<Curve> = of_volume()
            .filter_map(|record| curve(record, HISTORY[0], &record.spec.variant, Look::Sparse(8)))
            .collect();
        let exact = of_volume().find_map(|record| curve(record, HISTORY[1], "exact", Look::Line));
        curves.extend(exact.map(|exact| Curve { style: EXACT, ..exact }));
        panels.push(Panel {
            title: panel_title(volume),
            x: Axis::linear("time ct/H"),
            y: Axis::linear("mean pressure of the lowest cells / ρgH"),
            legend: "method".to_owned(),
            curves,
            slopes: Vec::new(),
        });
    }
    let offsets = records.iter().find_map(|record| record.spec.parameters["offsets"].as_u64());
    let offsets = offsets.unwrap_or_default() as usize;
    let theta = theta(shown(offsets), offsets);
    Figure {
        title: format!("Sudden load: base pressure at θ = {theta:.3}"),
        panels,
        columns: volumes.len(),
    }
}

fn table(study: Study, records: &[&RunRecord], note: &str) -> Table {
    let quantities = quantities(study);
    let mut columns: Vec<String> = ["volume", "variant", "blow-ups"].map(str::to_owned).to_vec();
    for quantity in quantities {
        columns.extend(NORMS.map(|norm| format!("{quantity} {norm}")));
    }
    columns.push("least Δt".to_owned());
    let value = |record: &RunRecord, quantity: &str, norm: &str| {
        record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
    };
    let row = |record: &&RunRecord| {
        let blown = value(record, "blow-ups", "count");
        let blown = if blown.is_finite() { Cell::Count(blown as u64) } else { Cell::Value(blown) };
        let mut row =
            vec![record.spec.label("volume").into(), record.spec.variant.as_str().into(), blown];
        for quantity in quantities {
            for norm in NORMS {
                let found = value(record, quantity, norm);
                let is_place = norm == "worst-theta";
                row.push(if is_place { Cell::Decimal(found) } else { Cell::Value(found) });
            }
        }
        row.push(Cell::Decimal(value(record, "time-step", "least-ratio")));
        row
    };
    let note = format!(
        "Over all offsets θ of the surface: largest absolute value, 95th percentile, θ of the largest. \
         Least Δt: stable step at the end over that of full cells. {note}"
    );
    Table { columns, rows: records.iter().map(row).collect(), note }
}
