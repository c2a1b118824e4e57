//! What a run costs on any machine: how often a value on the grid or of a neighbour is read or added to.

use std::collections::BTreeMap;

use transpoint::Variant;
use transpoint::variants::{Settings, StressUpdate};

use crate::problems::Resolution;

/// Touches of a run: pairs of a point, sample or fit with a node or point in its reach, each pass counted.
///
/// ```text
/// (samples + points · gathers + points · extra passes) · w^D + fits · (points per cell) · (2 s)^D
///     + affine sums · (points per cell) · 3^D
/// ```
///
/// with w the nodes per axis of the grid functions and s the support of the fits in cells. Extra passes are the
/// way to the nodes and back of a stress updated modified-last and of an averaged divergence, and k − 1 ways there
/// and back where the velocity is projected with k terms, and one for the velocity gradient of affine densities. It is a count of accesses, not of seconds: what is done
/// at each differs between methods by a small factor.
pub(super) fn touches(
    variant: Variant,
    given: &Settings,
    counters: &BTreeMap<String, u64>,
    resolution: &Resolution,
    dimension: usize,
) -> f64 {
    let count = |name: &str| counters.get(name).copied().unwrap_or(0) as f64;
    let settings = variant.settings(given);
    let power = |base: f64| (0..dimension).map(|_| base).product::<f64>();
    let stencil = power(variant.parts().kernel.width() as f64);
    let points = count("n_point_updates");
    let mut passes = count("n_samples") + points;
    if settings.stress_update == StressUpdate::ModifiedLast {
        passes += 2.0 * points;
    }
    if settings.dilation.is_some() {
        passes += 2.0 * points;
    }
    if let Some(projection) = settings.projection {
        let share = count("n_projections") / count("n_steps").max(1.0);
        passes += 2.0 * f64::from(projection.order - 1) * points * share;
    }
    if settings.affine_density {
        // The velocity gradient that turns the slopes.
        passes += points;
    }
    let of_cells_around = power(resolution.points_per_axis as f64) * power(3.0);
    let near = power(resolution.points_per_axis as f64) * power(2.0 * settings.support);
    let sums = count("n_affine_sums") * of_cells_around;
    passes * stencil + count("n_reconstructions") * near + sums
}

#[cfg(test)]
mod tests {
    use super::*;

    const RESOLUTION: Resolution =
        Resolution { cells: 4, points_per_axis: 2, jitter: 0.0, seed: 0 };

    fn counters(entries: &[(&str, u64)]) -> BTreeMap<String, u64> {
        entries.iter().map(|&(name, count)| (name.to_owned(), count)).collect()
    }

    #[test]
    fn linear_mpm_touches_four_nodes_twice() {
        let counters = counters(&[("n_steps", 1), ("n_samples", 64), ("n_point_updates", 64)]);
        let count = touches(Variant::Mpm, &Settings::default(), &counters, &RESOLUTION, 2);
        assert_eq!(count, 64.0 * 8.0);
    }

    #[test]
    fn fits_touch_the_points_in_their_support() {
        let counters = counters(&[
            ("n_steps", 1),
            ("n_samples", 16),
            ("n_point_updates", 64),
            ("n_reconstructions", 41),
        ]);
        let count =
            touches(Variant::TpmVpQuadratic, &Settings::default(), &counters, &RESOLUTION, 2);
        assert_eq!(count, 80.0 * 4.0 + 41.0 * 16.0);
    }
}
