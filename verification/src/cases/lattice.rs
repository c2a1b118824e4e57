//! Points on a lattice, and the same points displaced.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// A lattice of `counts` points per axis with the given point spacing (m) from the origin, each
/// displaced along every axis by up to `jitter` point spacings; last axis fastest.
pub(super) fn lattice<const D: usize>(
    counts: [usize; D],
    spacing: f64,
    jitter: f64,
    seed: u64,
) -> Vec<[f64; D]> {
    let mut random = Pcg64::seed_from_u64(seed);
    // Uniform in [−1, 1), from the upper 53 bits.
    let mut displacement = || (random.next_u64() >> 11) as f64 * 2f64.powi(-52) - 1.0;
    (0..counts.iter().product())
        .map(|flat| {
            let mut rest: usize = flat;
            let mut position = [0.0; D];
            for axis in (0..D).rev() {
                let index = (rest % counts[axis]) as f64;
                rest /= counts[axis];
                position[axis] = (index + 0.5 + jitter * displacement()) * spacing;
            }
            position
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::lattice;

    #[test]
    fn displacements_keep_to_their_bound_and_repeat() {
        let (regular, jittered) = (lattice([5, 40], 0.1, 0.0, 7), lattice([5, 40], 0.1, 0.3, 7));
        assert_eq!(regular[41], [1.5 * 0.1, 1.5 * 0.1]);
        let shifts =
            || regular.iter().flatten().zip(jittered.iter().flatten()).map(|(a, b)| (b - a) / 0.1);
        assert!(shifts().all(|shift| shift.abs() <= 0.3 + 1e-12));
        let mean_square = shifts().map(|shift| shift * shift).sum::<f64>() / 400.0;
        assert!((mean_square / 0.03 - 1.0).abs() < 0.15, "{mean_square}");
        assert_eq!(jittered, lattice([5, 40], 0.1, 0.3, 7));
        assert_ne!(jittered, lattice([5, 40], 0.1, 0.3, 8));
    }
}
