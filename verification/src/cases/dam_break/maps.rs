//! Pictures of the pressure and of the kinds of cells, and animations.

use super::march::{INSTANTS, picture};
use super::occupancy::KINDS;
use super::policy::Difference;
use super::results::find;
use crate::case::Raster;
use crate::record::RunRecord;
use crate::reference::dam_break::{VofSpacing, outline};
use crate::report::animation::Animation;
use crate::report::map::{Key, MapFigure, MapPanel, Overlay};
use crate::report::palette::Palette;
use crate::report::{Area, Artifact, Content};

/// Colour of the outline: red, which no cell has.
const OUTLINE: usize = 0;
/// How long a frame is shown, ms; 0.05 T is 25 ms.
const MILLISECONDS: u16 = 100;

/// A figure of one run: file, what it shows, variant, layout, difference.
type Shown = (&'static str, &'static str, &'static str, &'static str, Difference);

const FIGURES: [Shown; 9] = [
    ("fig14_dam_break", "dense TPM (Fig. 14)", "tpm-vp2", "dense", Difference::None),
    ("dam_break_gimp", "dense uGIMP", "gimp-vp", "dense", Difference::ModifiedLast),
    ("fig15_dam_break", "coarse TPM (Fig. 15)", "tpm-vp2", "coarse", Difference::None),
    ("fig16_dam_break", "coarse TPM with fills (Fig. 16)", "tpm-vp2", "coarse", Difference::Fill),
    (
        "fig16_dam_break_reduced",
        "coarse TPM with fills and N_m = 4 (Fig. 16)",
        "tpm-vp2",
        "coarse",
        Difference::FillReduce,
    ),
    ("fig18_dam_break", "coarse MPM (Fig. 18)", "mpm-vp", "coarse", Difference::ModifiedLast),
    (
        "fig18_dam_break_split",
        "coarse MPM split by stretch (Fig. 18)",
        "mpm-vp",
        "coarse",
        Difference::SplitStretch,
    ),
    ("dam_break_small", "TPM on cells of 60 mm", "tpm-vp2", "small", Difference::None),
    ("dam_break_3d", "TPM in three dimensions", "tpm-vp2", "tank-3d", Difference::None),
];

/// Maps of every run on record that is shown, and the animation where it has frames.
pub(super) fn artifacts(records: &[RunRecord]) -> Vec<Artifact> {
    let mut artifacts = Vec::new();
    for (stem, title, variant, layout, difference) in FIGURES {
        let Some(record) = find(records, variant, layout, difference) else { continue };
        let artifact = |stem: String, title: String, content| Artifact {
            stem,
            title,
            area: Area::Accuracy,
            content,
        };
        let maps = figure(record, title);
        if !maps.panels.is_empty() {
            let heading = format!("Pressure and kinds of cells: {title}");
            artifacts.push(artifact(stem.to_owned(), heading, Content::Maps(maps)));
        }
        let frames = frames(record);
        if frames.len() > INSTANTS.len() {
            let animation = Animation {
                frames,
                palette: Palette::Sequential,
                milliseconds: MILLISECONDS,
                note: "Mean pressure of the points of each cell from 0 (violet) to 6000 Pa (yellow), below 0 \
                       pink, every 0.05 T."
                    .to_owned(),
            };
            let heading = format!("Animation: {title}");
            artifacts.push(artifact(
                format!("{stem}_film"),
                heading,
                Content::Animation(animation),
            ));
        }
    }
    artifacts
}

/// Pressures in the left column and kinds in the right, an instant per row.
fn figure(record: &RunRecord, title: &str) -> MapFigure {
    let mut panels = Vec::new();
    for instant in INSTANTS {
        let shown = [
            ("pressure", Key::Field { label: "pressure, Pa".to_owned() }),
            ("kind", Key::Classes { names: KINDS.map(str::to_owned).to_vec() }),
        ];
        for (what, key) in shown {
            let Some(raster) = record.raster(&picture(what, instant)) else { continue };
            panels.push(MapPanel {
                title: format!("{}, T = {instant}", if what == "kind" { "cells" } else { what }),
                raster: raster.clone(),
                key,
                overlays: overlays(instant),
            });
        }
    }
    MapFigure { title: format!("Dam break: {title}"), panels, columns: 2 }
}

/// Where the volume-of-fluid run has its surface.
fn overlays(instant: f64) -> Vec<Overlay> {
    let lines = outline(VofSpacing::Millimeters20, instant).unwrap_or_default();
    if lines.is_empty() {
        return Vec::new();
    }
    vec![Overlay { label: "VOF 20 mm".to_owned(), style: OUTLINE, lines }]
}

/// Pictures of the pressure in the order of time.
fn frames(record: &RunRecord) -> Vec<Raster> {
    let is_frame = |raster: &&Raster| raster.name.starts_with("pressure@");
    record.rasters.iter().filter(is_frame).cloned().collect()
}
