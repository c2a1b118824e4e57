//! Colours of rasters and the indexed pictures made of them.

use anyhow::{Context, Result};
use plotters::style::RGBColor;
use plotters::style::colors::colormaps::ViridisRGB;
use png::{BitDepth, ColorType, Compression, Encoder, Filter};

use super::style;
use crate::case::Raster;

/// Most classes that are told apart.
pub const MOST_CLASSES: usize = 5;

/// Indices of the classes' colours among those of curves; all differ from white and in lightness.
const CLASS_COLORS: [usize; MOST_CLASSES] = [4, 5, 2, 1, 6];

/// A value below the scale: a pink, lighter than the dark end and unlike any hue of the scale.
const BELOW: RGBColor = RGBColor(255, 150, 200);

const WHITE: RGBColor = RGBColor(255, 255, 255);

/// Which colours the codes of a raster have. Both palettes are told apart with any colour vision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// From dark violet over green to yellow with the value (viridis), pink below the scale.
    Sequential,
    /// Up to [`MOST_CLASSES`] colours.
    Categorical,
}

impl Palette {
    /// Colour of a code, see [`Raster::values`]; white where there is no value.
    pub fn color(self, code: u8) -> RGBColor {
        match (self, code) {
            (_, Raster::EMPTY) => WHITE,
            (Self::Sequential, Raster::BELOW) => BELOW,
            (Self::Sequential, _) => {
                let (value, last) = (f64::from(code), f64::from(u8::MAX));
                ViridisRGB::get_color_normalized(value, f64::from(Raster::LOWER), last)
            }
            (Self::Categorical, _) => {
                CLASS_COLORS.get(usize::from(code) - 1).map_or(WHITE, |&index| style::color(index))
            }
        }
    }

    /// Red, green and blue of all codes one after the other.
    fn bytes(self) -> Vec<u8> {
        (0..=u8::MAX)
            .map(|code| self.color(code))
            .flat_map(|RGBColor(red, green, blue)| [red, green, blue])
            .collect()
    }
}

/// An encoder of pictures whose pixels are codes of that palette.
///
/// # Errors
/// When the size is not one of a picture.
pub(super) fn encoder(
    bytes: &mut Vec<u8>,
    palette: Palette,
    width: usize,
    height: usize,
) -> Result<Encoder<'static, &mut Vec<u8>>> {
    let side = |pixels: usize| u32::try_from(pixels).context("a picture is too large");
    let mut encoder = Encoder::new(bytes, side(width)?, side(height)?);
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(palette.bytes());
    encoder.set_compression(Compression::High);
    encoder.set_filter(Filter::Adaptive);
    Ok(encoder)
}

/// A PNG file of one pixel for each code; rows of `width` codes from the top.
///
/// # Errors
/// When the number of codes is not a multiple of the width.
pub fn png(palette: Palette, width: usize, codes: &[u8]) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let height = codes.len() / width.max(1);
    let mut writer = encoder(&mut bytes, palette, width, height)?.write_header()?;
    writer.write_image_data(codes).context("cannot encode a raster")?;
    writer.finish()?;
    Ok(bytes)
}

/// The codes of a raster by rows from the top, each cell `factor` × `factor` times.
pub fn enlarged(raster: &Raster, factor: usize) -> Vec<u8> {
    let mut codes = Vec::with_capacity(raster.values.len() * factor * factor);
    for row in raster.values.chunks(raster.columns).rev() {
        let line: Vec<u8> =
            row.iter().flat_map(|&code| std::iter::repeat_n(code, factor)).collect();
        (0..factor).for_each(|_| codes.extend_from_slice(&line));
    }
    codes
}

/// Refuses a raster with a class that has no colour or no name.
///
/// # Errors
/// Names the raster.
pub(super) fn check_classes(raster: &Raster, n_classes: usize) -> Result<()> {
    let most = raster.values.iter().copied().max().map_or(0, usize::from);
    anyhow::ensure!(
        most <= n_classes && n_classes <= MOST_CLASSES,
        "raster {}: {most} classes with {n_classes} names; at most {MOST_CLASSES} are shown",
        raster.name
    );
    Ok(())
}
