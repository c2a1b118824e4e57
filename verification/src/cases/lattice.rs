//! Points on a lattice, undisturbed or displaced.
//!
//! On an undisturbed lattice every method looks alike, hence the second layout.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Arrangements of the points.
pub const LAYOUTS: [&str; 2] = ["regular", "jittered"];

/// Largest displacement along each axis of a jittered point, point spacings.
pub const JITTER: f64 = 0.3;

/// Largest displacement in a layout, point spacings.
pub fn jitter(layout: &str) -> f64 {
    if layout == "jittered" { JITTER } else { 0.0 }
}

/// Two points per cell and axis in cells of size `spacing`, see [`lattice`].
pub fn positions<const D: usize>(
    spacing: f64,
    cells: [usize; D],
    jitter: f64,
    seed: u64,
) -> Vec<[f64; D]> {
    lattice(cells.map(|n| 2 * n), 0.5 * spacing, jitter, seed)
}

/// Positions (m) of `counts` points per axis, `spacing` apart, in a box from the origin on that leaves half a
/// spacing all around; the last axis fastest.
///
/// Each coordinate is displaced by a uniform random number within ±`jitter` spacings.
pub fn lattice<const D: usize>(
    counts: [usize; D],
    spacing: f64,
    jitter: f64,
    seed: u64,
) -> Vec<[f64; D]> {
    let mut random = Pcg64::seed_from_u64(seed);
    (0..counts.iter().product::<usize>())
        .map(|flat| {
            let mut rest = flat;
            let mut position = [0.0; D];
            for axis in (0..D).rev() {
                let index = (rest % counts[axis]) as f64;
                rest /= counts[axis];
                position[axis] = (index + 0.5) * spacing;
            }
            for place in &mut position {
                *place += displacement(&mut random) * jitter * spacing;
            }
            position
        })
        .collect()
}

/// Uniform in [−1, 1), from the upper 53 bits.
fn displacement(random: &mut Pcg64) -> f64 {
    (random.next_u64() >> 11) as f64 * 2f64.powi(-52) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_holds_two_points_per_axis() {
        for layout in LAYOUTS {
            let points = positions(0.5, [3, 2], jitter(layout), 7);
            let mut counts = [0; 6];
            for [x, y] in points {
                counts[2 * (x / 0.5) as usize + (y / 0.5) as usize] += 1;
            }
            assert_eq!(counts, [4; 6], "{layout}");
        }
    }

    #[test]
    fn displacements_are_those_of_the_seed_and_within_bounds() {
        let (regular, jittered) = (positions(0.1, [40], 0.0, 3), positions(0.1, [40], 0.3, 3));
        assert!((regular[1][0] - 0.075).abs() < 1e-15);
        assert_eq!(jittered, positions(0.1, [40], 0.3, 3));
        assert_ne!(jittered, positions(0.1, [40], 0.3, 4));
        assert!(regular.iter().zip(&jittered).all(|(a, b)| (a[0] - b[0]).abs() <= 0.3 * 0.05));
    }
}
