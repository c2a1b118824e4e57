//! From the records of this case to figures and tables.

use super::{CELLS, FLOWS, INSTANTS, PROFILE_LEVEL, scene};
use crate::cases::errors::{self, NORMS, Shown, artifact};
use crate::cases::lattice::LAYOUTS;
use crate::convergence::{Series, series};
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::{Artifact, Content};

/// What each figure of a flow shows: quantity, norm and title.
const SHOWN: [[(&str, &str, &str); 4]; 3] = [
    shown("velocity@couette-0.1", "velocity@couette-0.5", "middle@couette-0.1"),
    shown("velocity@poiseuille-0.1", "velocity@poiseuille-0.5", "middle@poiseuille-0.1"),
    shown("velocity@couette-ramp-0.1", "velocity@couette-ramp-0.5", "middle@couette-ramp-0.1"),
];

const fn shown(
    early: &'static str,
    late: &'static str,
    middle: &'static str,
) -> [(&'static str, &'static str, &'static str); 4] {
    [
        (early, "point-l2", "at points, νt/H² = 0.1"),
        (early, "gauss-l2", "at cell centers, νt/H² = 0.1"),
        (late, "point-l2", "at points, νt/H² = 0.5"),
        (middle, "point-l2", "at points in the middle half, νt/H² = 0.1"),
    ]
}

/// Variants of the panels of velocity over height.
const PANELS: [&str; 3] = ["tpm", "mpm", "apic"];

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let mut artifacts = Vec::new();
    for (flow, shown) in FLOWS.into_iter().zip(SHOWN) {
        let of_flow = || records.iter().filter(move |record| record.spec.label("flow") == flow);
        let mut all: Vec<Series> = series(of_flow());
        all.retain(|series| NORMS.contains(&series.norm.as_str()));
        if all.is_empty() {
            continue;
        }
        let stem = format!("shear_startup_{}", flow.replace('-', "_"));
        let title = format!("Start-up of shear flow, {flow}");
        let shown =
            shown.map(|(quantity, norm, title)| Shown { quantity, norm, title, unit: "m²/s" });
        let figure = errors::figure(&all, &format!("{title}: velocity error"), &shown);
        artifacts.push(artifact(&stem, &title, Content::Figure(figure)));
        let note = format!("Errors √(Σ e² V) on a length of 1 m, in m²/s. {policy}");
        let table = errors::table(&all, &note);
        let stem = format!("{stem}_convergence");
        artifacts.push(artifact(
            &stem,
            &format!("{title}: errors and orders"),
            Content::Table(table),
        ));
        let figure = profiles(&of_flow().collect::<Vec<_>>(), flow);
        if !figure.panels.is_empty() {
            let stem = stem.replace("convergence", "profile");
            artifacts.push(artifact(&stem, &format!("{title}: profiles"), Content::Figure(figure)));
        }
    }
    artifacts
}

/// Velocities of some points over the height, beside the exact solution, at both instants.
fn profiles(records: &[&RunRecord], flow: &str) -> Figure {
    let mut panels = Vec::new();
    for layout in LAYOUTS {
        for variant in PANELS {
            let Some(record) = records.iter().find(|record| {
                let spec = &record.spec;
                (spec.level == PROFILE_LEVEL)
                    && (spec.variant == variant)
                    && (spec.layout == layout)
            }) else {
                continue;
            };
            let mut curves = Vec::new();
            for (index, (name, at)) in INSTANTS.into_iter().enumerate() {
                let Some(profile) = record.profile(&format!("velocity@{name}")) else { continue };
                let curve =
                    |label: String, points, look| Curve { label, style: index, points, look };
                let line = (0..=100).map(|i| {
                    let y = scene::HEIGHT * f64::from(i) / 100.0;
                    (y, scene::exact(flow, y, at * scene::HEIGHT.powi(2) / scene::VISCOSITY))
                });
                curves.push(curve(format!("points, {name}"), profile.pairs(), Look::Dots));
                curves.push(curve(format!("exact, {name}"), line.collect(), Look::Line));
            }
            panels.push(Panel {
                title: format!("{variant}, {layout} points, {} cells", CELLS[PROFILE_LEVEL]),
                x: Axis::linear("height y, m"),
                y: Axis::linear("velocity u, m/s"),
                legend: "at νt/H²".to_owned(),
                curves,
                slopes: Vec::new(),
            });
        }
    }
    Figure { title: format!("Shear flow, {flow}"), panels, columns: PANELS.len() }
}
