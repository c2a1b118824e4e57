//! Maps and animations reach their folders and the page.

use super::*;
use crate::case::Raster;
use map::{Key, MapPanel};
use palette::Palette;

fn artifacts() -> [Artifact; 2] {
    let values = [Some(1.0), None, Some(3.0), Some(4.0)];
    let raster = Raster::field("p", [2, 2], [0.0; 2], [0.1; 2], [0.0, 4.0], &values).expect("fits");
    let panel = MapPanel {
        title: "pressure".to_owned(),
        raster: raster.clone(),
        key: Key::Field { label: "p, Pa".to_owned() },
        overlays: Vec::new(),
    };
    let maps = MapFigure { title: "Maps".to_owned(), panels: vec![panel], columns: 1 };
    let animation = Animation {
        frames: vec![raster; 2],
        palette: Palette::Sequential,
        milliseconds: 100,
        note: "Pressure from 0 to 4 Pa.".to_owned(),
    };
    let artifact = |stem: &str, content| Artifact {
        stem: stem.to_owned(),
        title: format!("The {stem}"),
        area: Area::Accuracy,
        content,
    };
    [artifact("maps", Content::Maps(maps)), artifact("film", Content::Animation(animation))]
}

#[test]
fn maps_and_animations_are_written_and_linked() {
    let folder = tempfile::tempdir().expect("a folder");
    for artifact in &artifacts() {
        write_artifact(folder.path(), artifact).expect("written");
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).expect(name);
    assert!(read("figures/maps.svg").starts_with(b"<svg"));
    for name in ["figures/maps.png", "animations/film.png"] {
        assert_eq!(read(name)[..8], *b"\x89PNG\r\n\x1a\n");
    }
    let chapter = page::Chapter {
        name: "made-up",
        about: "a case",
        artifacts: artifacts().to_vec(),
        checks: Vec::new(),
    };
    let page = page::render(&[chapter], &[]);
    for part in [
        "### The maps\n\n![The maps](figures/maps.svg)\n\n[PNG](figures/maps.png)\n",
        "### The film\n\n![The film](animations/film.png)\n\nPressure from 0 to 4 Pa.\n",
    ] {
        assert!(page.contains(part), "{page}");
    }
}
