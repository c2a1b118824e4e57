//! Animations of rasters as PNG files with several frames.
//!
//! A rough field takes about two bytes per cell with a value and frame; empty cells take none.

use anyhow::{Context, Result, ensure};
use png::{BlendOp, DisposeOp};

use super::palette::{self, MOST_CLASSES, Palette};
use crate::case::Raster;

/// Rasters of the same number of cells, one after the other, over and over.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// The frames in time.
    pub frames: Vec<Raster>,
    /// Their colours.
    pub palette: Palette,
    /// How long each is shown, ms.
    pub milliseconds: u16,
    /// Printed below: quantity, range and instants.
    pub note: String,
}

/// About how many pixels wide.
const WIDTH: usize = 800;

/// Encodes an animation as a PNG file, each cell as a square of whole pixels; the same bytes for the
/// same frames.
///
/// # Errors
/// When there is no frame, or a frame is damaged or differs in its cells from the first.
pub fn png(animation: &Animation) -> Result<Vec<u8>> {
    let first = animation.frames.first().context("an animation has no frame")?;
    for frame in &animation.frames {
        ensure!(
            (frame.columns, frame.rows) == (first.columns, first.rows),
            "frame {} has other cells than the first",
            frame.name
        );
        if animation.palette == Palette::Categorical {
            palette::check_classes(frame, MOST_CLASSES)?;
        }
    }
    first.clone().checked()?;
    let factor = ((WIDTH + first.columns / 2) / first.columns).max(1);
    let (width, height) = (first.columns * factor, first.rows * factor);
    let mut bytes = Vec::new();
    let mut encoder = palette::encoder(&mut bytes, animation.palette, width, height)?;
    encoder.set_animated(u32::try_from(animation.frames.len())?, 0)?;
    encoder.set_frame_delay(animation.milliseconds, 1000)?;
    encoder.set_blend_op(BlendOp::Source)?;
    encoder.set_dispose_op(DisposeOp::None)?;
    let mut writer = encoder.write_header()?;
    for frame in &animation.frames {
        let codes = palette::enlarged(frame, factor);
        writer
            .write_image_data(&codes)
            .with_context(|| format!("cannot encode frame {}", frame.name))?;
    }
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests;
