//! Profiles at the end and convergence.

use super::scene::{FIELDS, Field, exact};
use super::{INTERFACE, LAYOUTS, METHODS, TIME};
use crate::case::Profile;
use crate::convergence::Series;
use crate::number;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};

/// Colour of the exact profile: black, which no method has.
const EXACT: usize = 2;
/// Intervals of the exact profile.
const SAMPLES: usize = 800;
/// Methods of the profiles.
const SHOWN: [&str; 4] = ["tpm-vp0", "apic", "bspline2-work", "mpm-work"];
/// Level of the profiles: 200 cells, or the finest that has runs.
const LEVEL: usize = 4;

/// A colour per method, black left out; with the energy by work as with the energy by strain.
fn style(method: &str) -> usize {
    let base = method.strip_suffix("-work").unwrap_or(method);
    let index = METHODS.iter().position(|known| known.name == base).unwrap_or(0);
    if index < EXACT { index } else { index + 1 }
}

/// Every field on either layout, and the level shown; `None` without runs.
pub(super) fn profiles(records: &[RunRecord]) -> Option<(usize, Figure)> {
    let level = records.iter().map(|record| record.spec.level).filter(|&l| l <= LEVEL).max()?;
    let mut panels = Vec::new();
    for field in &FIELDS {
        for layout in LAYOUTS {
            let shown = SHOWN.iter().filter_map(|&method| {
                let record = records.iter().find(|record| {
                    let spec = &record.spec;
                    spec.variant == method && spec.layout == layout && spec.level == level
                })?;
                Some(Curve {
                    label: method.to_owned(),
                    style: style(method),
                    points: record.profile(field.name).map(Profile::pairs).unwrap_or_default(),
                    look: Look::Sparse(16),
                })
            });
            panels.push(Panel {
                title: format!("{layout} points"),
                x: Axis::linear("x, m"),
                y: Axis::linear(format!("{}, {}", field.name, field.unit)),
                legend: "method".to_owned(),
                curves: std::iter::once(exact_curve(field)).chain(shown).collect(),
                slopes: Vec::new(),
            });
        }
    }
    let title = "Shock tube at t = 0.2 s, means over cells".to_owned();
    Some((level, Figure { title, panels, columns: LAYOUTS.len() }))
}

fn exact_curve(field: &Field) -> Curve {
    let solution = exact().ok();
    let points = (0..=SAMPLES).filter_map(|i| {
        let x = i as f64 / SAMPLES as f64;
        let state = solution?.at((x - INTERFACE) / TIME);
        Some((x, (field.of_state)(state)))
    });
    Curve { label: "exact".to_owned(), style: EXACT, points: points.collect(), look: Look::Line }
}

/// Methods of the convergence figure. In 1D `tpm` and `mpm-vp` are `tpm-vp0` and `mpm`.
const CONVERGING: [&str; 5] = ["tpm-vp0", "apic", "bspline2-work", "gimp-work", "mpm-work"];

/// L1 errors of every field on either layout.
pub(super) fn convergence(all: &[Series]) -> Figure {
    let mut panels = Vec::new();
    for field in &FIELDS {
        for layout in LAYOUTS {
            let curves = CONVERGING.iter().filter_map(|&method| {
                let series = all.iter().find(|series| {
                    (series.norm == "l1")
                        && (series.quantity == field.name)
                        && (series.layout == layout)
                        && (series.variant == method)
                })?;
                // The suffix would not fit beside the order; the title says it.
                let name = method.strip_suffix("-work").unwrap_or(method);
                Some(Curve {
                    label: format!("{name} ({})", number::order(series.order().order)),
                    style: style(method),
                    points: series.points.clone(),
                    look: Look::Marked,
                })
            });
            panels.push(Panel {
                title: format!("{layout} points: {}", field.name),
                x: Axis::log("cell size h, m").with_ticks([0.0025, 0.005, 0.01, 0.02, 0.05]),
                y: Axis::log(format!("L1 error of {}, {} · m", field.name, field.unit)),
                legend: "method (order)".to_owned(),
                curves: curves.collect(),
                slopes: vec![1.0],
            });
        }
    }
    let title =
        "Shock tube: L1 errors at t = 0.2 s (mpm, gimp, bspline2: energy by work)".to_owned();
    Figure { title, panels, columns: LAYOUTS.len() }
}
