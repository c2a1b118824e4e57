//! What is drawn is looked up in the pixels of the picture.

use plotters::style::RGBColor;

use super::*;
use crate::report::raster;
use crate::report::style::color;

/// Red, green and blue of a place in a PNG file.
fn pixels(png: Vec<u8>) -> impl Fn(i32, i32) -> RGBColor {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a picture");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    assert_eq!(info.color_type, png::ColorType::Rgba);
    move |x, y| {
        let at = 4 * (y as usize * info.width as usize + x as usize);
        RGBColor(bytes[at], bytes[at + 1], bytes[at + 2])
    }
}

fn field() -> Raster {
    let values = [Some(-5.0), Some(0.0), Some(2.5), Some(10.0), None, Some(20.0)];
    Raster::field("p", [3, 2], [0.0; 2], [0.1; 2], [0.0, 10.0], &values).expect("a raster")
}

fn figure(raster: Raster, key: Key, overlays: Vec<Overlay>) -> MapFigure {
    let panel = MapPanel { title: "a panel".to_owned(), raster, key, overlays };
    MapFigure { title: "a figure".to_owned(), panels: vec![panel], columns: 1 }
}

fn pressure() -> Key {
    Key::Field { label: "pressure, Pa".to_owned() }
}

/// Centre of a cell of the only panel, whose cells have 240 pixels.
fn center(column: i32, row: i32) -> (i32, i32) {
    (LEFT + 240 * column + 120, TITLE + ABOVE + 480 - 240 * row - 120)
}

#[test]
fn cells_have_the_colors_of_their_codes() {
    let svg = svg(&figure(field(), pressure(), Vec::new())).expect("drawn");
    let at = pixels(raster::png(&svg).expect("a picture"));
    let palette = Palette::Sequential;
    let expected = [(0, 0, 1), (1, 0, 2), (2, 0, 65), (0, 1, 255), (1, 1, 0), (2, 1, 255)];
    for (column, row, code) in expected {
        let (x, y) = center(column, row);
        for (dx, dy) in [(0, 0), (-115, -115), (115, 115)] {
            assert_eq!(at(x + dx, y + dy), palette.color(code), "cell {column}, {row}");
        }
    }
    // The bar, from below, and the square of values below it.
    let (bar, bottom) = (LEFT + 720 + 26 + 10, TITLE + ABOVE + 480);
    assert_eq!(at(bar, bottom - 2), palette.color(2));
    assert_eq!(at(bar, TITLE + ABOVE + 2), palette.color(254));
    assert_eq!(at(bar, bottom + 40), palette.color(1));
    for text in ["pressure, Pa", "below 0", "x, m", "y, m", "a panel", "a figure"] {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn classes_have_a_list_and_lines_lie_on_top() {
    let classes = [Some(0), Some(1), Some(2), Some(3), Some(4), None];
    let raster = Raster::classes("k", [3, 2], [0.0; 2], [0.1; 2], 5, &classes).expect("a raster");
    let names = ["one", "two", "three", "four", "five"].map(str::to_owned).to_vec();
    let line = vec![[0.0, 0.15], [0.3, 0.15], [9.0, 0.15]];
    let overlay = Overlay { label: "surface".to_owned(), style: 2, lines: vec![line] };
    let svg = svg(&figure(raster, Key::Classes { names }, vec![overlay])).expect("drawn");
    let at = pixels(raster::png(&svg).expect("a picture"));
    for (index, code) in (0..).zip([1, 2, 3, 4, 5]) {
        let (x, y) = center(index % 3, index / 3);
        assert_eq!(at(x, y + 60), Palette::Categorical.color(code));
    }
    let (x, y) = center(2, 1);
    assert_eq!(at(x, y + 60), RGBColor(255, 255, 255));
    assert_eq!(at(x, y), color(2));
    // Nothing is drawn beyond the frame.
    assert_eq!(at(LEFT + 720 + 15, y), RGBColor(255, 255, 255));
}

#[test]
fn drawing_again_gives_the_same_text() {
    let figure = figure(field(), pressure(), Vec::new());
    assert_eq!(svg(&figure).expect("drawn"), svg(&figure).expect("drawn"));
}

#[test]
fn damaged_rasters_and_nameless_classes_are_refused() {
    let short = Raster { values: vec![0; 5], ..field() };
    assert!(svg(&figure(short, pressure(), Vec::new())).is_err());
    let names = Key::Classes { names: vec!["one".to_owned()] };
    let error = svg(&figure(field(), names, Vec::new())).expect_err("refused").to_string();
    assert_eq!(error, "raster p: 255 classes with 1 names; at most 5 are shown");
}

#[test]
fn no_panel_makes_an_empty_figure() {
    let figure = MapFigure { title: "none".to_owned(), panels: Vec::new(), columns: 3 };
    assert!(raster::png(&svg(&figure).expect("drawn")).is_ok());
}
