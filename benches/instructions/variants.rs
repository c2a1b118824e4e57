//! Instructions of every named method per point and step: reported, not checked.

use transpoint::{Settings, Variant};

use crate::count;
use crate::plain::scene::{DT, Layout, scene_of_cells};

/// What names of these workloads begin with.
const PREFIX: &str = "variant/";
/// Cells, with 2 by 2 points each.
const SQUARE: [usize; 2] = [16, 16];
/// Steps of the shorter run: a multiple of the intervals of shifts and filters.
const STEPS: u32 = 40;

/// Runs a method on the scene of the workloads; false if there is none of that name.
pub fn run(name: &str, n_steps: usize) -> bool {
    transpoint::limit_to_baseline(true);
    let variant = name.strip_prefix(PREFIX).and_then(|name| Variant::parse(name).ok());
    let scene = scene_of_cells(SQUARE, Layout::Jittered);
    let Some(Ok(mut simulation)) =
        variant.map(|variant| variant.build_2d(&scene, &Settings::default()))
    else {
        return false;
    };
    // The first step, in which buffers take their size, is in both runs.
    (0..=n_steps).all(|_| simulation.step(DT).is_ok())
}

/// Prints a table of all methods, in Markdown.
pub fn report() -> Result<(), String> {
    let n_points = 4 * SQUARE.iter().product::<usize>();
    let count = |variant: Variant| {
        let counted = count::per_step(&format!("{PREFIX}{}", variant.name()), STEPS)?;
        Ok::<_, String>(counted / n_points as f64)
    };
    let mpm = count(Variant::Mpm)?;
    println!("| variant | instructions per point and step | over `mpm` |");
    println!("|---|---|---|");
    for variant in Variant::ALL {
        let counted = count(variant)?;
        println!("| {} | {counted:.0} | {:.2} |", variant.name(), counted / mpm);
    }
    Ok(())
}
