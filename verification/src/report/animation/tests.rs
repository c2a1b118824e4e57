//! Frames are read back from the file; its size is that of a page.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use super::*;

fn frames(count: usize, cells: [usize; 2]) -> Vec<Raster> {
    // A heap of water that runs out, with a rough pressure.
    let mut random = Pcg64::seed_from_u64(7);
    let frame = |time: usize| {
        let [columns, rows] = cells;
        let share = time as f64 / count as f64;
        let front = columns as f64 * (0.4 + 0.6 * share);
        let values: Vec<_> = (0..columns * rows)
            .map(|i| {
                let (column, row) = ((i % columns) as f64, (i / columns) as f64);
                let height = 0.45 * rows as f64 * (1.0 - 0.4 * share) * (1.0 - column / front);
                // Within ±150 Pa of the hydrostatic one.
                let noise = (random.next_u64() >> 11) as f64 * 2f64.powi(-53) - 0.5;
                let pressure = 98.0 * 2.0 * (height - row) + 300.0 * noise;
                (row < height).then_some(pressure)
            })
            .collect();
        Raster::field("p", cells, [0.0; 2], [0.02; 2], [0.0, 6000.0], &values).expect("fits")
    };
    (0..count).map(frame).collect()
}

fn animation(frames: Vec<Raster>) -> Animation {
    let note = "Pressure from 0 to 6000 Pa.".to_owned();
    Animation { frames, palette: Palette::Sequential, milliseconds: 80, note }
}

#[test]
fn every_frame_is_read_back() {
    let animation = animation(frames(3, [40, 20]));
    let bytes = png(&animation).expect("encoded");
    assert_eq!(bytes, png(&animation).expect("encoded again"));
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().expect("a picture");
    let control = reader.info().animation_control().expect("an animation");
    assert_eq!((control.num_frames, control.num_plays), (3, 0));
    assert_eq!((reader.info().width, reader.info().height), (800, 400));
    for frame in &animation.frames {
        let mut codes = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut codes).expect("a frame");
        // Each cell has 20 × 20 pixels; rows run from the top.
        for (cell, &code) in frame.values.iter().enumerate() {
            let (column, row) = (cell % 40, cell / 40);
            assert_eq!(codes[(399 - 20 * row - 9) * 800 + 20 * column + 9], code);
        }
    }
}

#[test]
fn sixty_frames_of_a_dam_break_are_small() {
    let bytes = png(&animation(frames(60, [161, 75]))).expect("encoded");
    println!("{} bytes", bytes.len());
    assert!(bytes.len() < 300_000, "{} bytes", bytes.len());
}

#[test]
fn frames_that_differ_in_cells_are_refused() {
    assert!(png(&animation(Vec::new())).is_err());
    let mut mixed = frames(2, [8, 4]);
    mixed.extend(frames(1, [4, 8]));
    assert!(png(&animation(mixed)).is_err());
}
