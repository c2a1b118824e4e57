//! Several fields beside their exact values, at the points and at the cell centres.

use std::ops::Range;

use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::cell_centers;
use super::norms::L2;

/// Values and exact values of `F` fields at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample<const D: usize, const F: usize> {
    /// Position, m.
    pub position: [f64; D],
    /// Values found.
    pub values: [f64; F],
    /// Exact values.
    pub exact: [f64; F],
    /// Volume, m^D.
    pub volume: f64,
}

/// The points as samples, with their carried volumes: Eq. (40) of \[Song2020\], `point-l2`.
pub fn at_points<const D: usize, const F: usize>(
    state: &Observation<D>,
    values: impl Fn(&PointState<D>) -> [f64; F],
    exact: impl Fn([f64; D]) -> [f64; F],
) -> Vec<Sample<D, F>> {
    let sample = |point: &PointState<D>| Sample {
        position: point.position,
        values: values(point),
        exact: exact(point.position),
        volume: point.volume(),
    };
    state.points.iter().map(sample).collect()
}

/// Samples at the cell centres with the counts of [`cell_centers::CellCenters`].
#[derive(Clone, Debug, PartialEq)]
pub struct AtCenters<const D: usize, const F: usize> {
    /// One per cell.
    pub samples: Vec<Sample<D, F>>,
    /// Cells with too few points for a linear fit.
    pub n_fallbacks: u64,
    /// Cells without any point in the support.
    pub n_empty: u64,
}

/// The cell centres as samples: Eq. (41) of \[Song2020\], `gauss-l2`.
pub fn at_centers<const D: usize, const F: usize>(
    scene: &Scene<D>,
    state: &Observation<D>,
    values: impl Fn(&PointState<D>) -> [f64; F],
    exact: impl Fn([f64; D]) -> [f64; F],
) -> AtCenters<D, F> {
    let positions: Vec<_> = state.points.iter().map(|point| point.position).collect();
    let fields: Vec<_> = state.points.iter().map(values).collect();
    let cells = cell_centers::reconstruct(&scene.grid, &scene.boundaries, &positions, &fields);
    let volume = scene.grid.spacing.iter().product();
    let sample = |(position, values)| Sample { position, values, exact: exact(position), volume };
    AtCenters {
        samples: cells.samples.into_iter().map(sample).collect(),
        n_fallbacks: cells.n_fallbacks,
        n_empty: cells.n_empty,
    }
}

/// Norm over some of the fields: one for a scalar, several for the components of a vector.
pub fn l2<'a, const D: usize, const F: usize>(
    samples: impl IntoIterator<Item = &'a Sample<D, F>>,
    fields: &Range<usize>,
) -> L2 {
    let mut norm = L2::default();
    for sample in samples {
        let (mut error, mut exact) = (0.0, 0.0);
        for field in fields.clone() {
            error += (sample.values[field] - sample.exact[field]).powi(2);
            exact += sample.exact[field].powi(2);
        }
        norm.add(error, exact, sample.volume);
    }
    norm
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_add_up_as_squares() {
        let sample = Sample {
            position: [0.0; 2],
            values: [1.0, 3.0, 4.0],
            exact: [1.0, 0.0, 0.0],
            volume: 0.25,
        };
        assert_eq!(l2(&[sample], &(0..1)).error(), 0.0);
        assert_eq!(l2(&[sample], &(0..1)).exact(), 0.5);
        assert_eq!(l2(&[sample], &(1..3)).error(), 2.5);
    }
}
