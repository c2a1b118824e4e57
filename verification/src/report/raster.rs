//! SVG to PNG with the vendored font alone, so that the picture is the same everywhere.

use anyhow::{Context, Result};
use resvg::{tiny_skia, usvg};

use super::style::{FONT, FONT_FAMILY};

/// Renders SVG text as a PNG file at its own size.
///
/// # Errors
/// When the text is not SVG or the picture cannot be encoded.
pub fn png(svg: &str) -> Result<Vec<u8>> {
    let mut options =
        usvg::Options { font_family: FONT_FAMILY.to_owned(), ..usvg::Options::default() };
    options.fontdb_mut().load_font_data(FONT.to_vec());
    let tree = usvg::Tree::from_str(svg, &options).context("cannot read back a figure")?;
    let size = tree.size().to_int_size();
    let mut picture =
        tiny_skia::Pixmap::new(size.width(), size.height()).context("a figure has no area")?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut picture.as_mut());
    picture.encode_png().context("cannot encode a figure")
}
