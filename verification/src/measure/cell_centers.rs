//! Fields at the cell centres from scattered points: the measure behind `gauss-l2`.
//!
//! Linear moving least squares with the product cubic-spline weight of half width one cell. It is
//! part of the measure, not of any method, so that all methods are measured alike; the support is
//! cut off at walls and wraps around at periodic faces.

use nalgebra::{SMatrix, SVector};
use transpoint::scene::{Boundary, GridSpec};

/// Values of `F` fields at the centre of every cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellCenters<const D: usize, const F: usize> {
    /// Centre and values per cell, last axis fastest; not a number where no point is near.
    pub samples: Vec<([f64; D], [f64; F])>,
    /// Cells with too few points for a linear fit, given the weighted mean.
    pub n_fallbacks: u64,
    /// Cells without any point in the support.
    pub n_empty: u64,
}

/// Reconstructs `fields`, given at `positions`, at the centre of every cell of `grid`.
pub fn reconstruct<const D: usize, const F: usize>(
    grid: &GridSpec<D>,
    boundaries: &[[Boundary; 2]; D],
    positions: &[[f64; D]],
    fields: &[[f64; F]],
) -> CellCenters<D, F> {
    let bins = Bins::new(grid, positions);
    let periodic = boundaries.map(|faces| faces[0] == Boundary::Periodic);
    let n_cells: usize = grid.cells.iter().product();
    let mut result =
        CellCenters { samples: Vec::with_capacity(n_cells), n_fallbacks: 0, n_empty: 0 };
    let mut near: Vec<([f64; D], f64, usize)> = Vec::new();
    for flat in 0..n_cells {
        let cell = unflatten(grid, flat);
        let center: [f64; D] = std::array::from_fn(|axis| {
            grid.origin[axis] + (cell[axis] as f64 + 0.5) * grid.spacing[axis]
        });
        near.clear();
        for (neighbor, shift) in neighbors(grid, cell, periodic) {
            for &point in bins.points(neighbor) {
                let offset: [f64; D] = std::array::from_fn(|axis| {
                    (positions[point][axis] + shift[axis] - center[axis]) / grid.spacing[axis]
                });
                let weight: f64 = offset.iter().map(|&r| cubic_spline(r)).product();
                if weight > 0.0 {
                    near.push((offset, weight, point));
                }
            }
        }
        let fit = fit(&near, fields);
        match fit {
            Fit::Linear(_) => {}
            Fit::Mean(_) => result.n_fallbacks += 1,
            Fit::Empty => result.n_empty += 1,
        }
        result.samples.push((center, fit.values()));
    }
    result
}

/// The same fit at one place, to all points nearer than a cell along each axis; no face is periodic here. Not a number
/// where no point is near.
pub fn at<const D: usize, const F: usize>(
    place: [f64; D],
    spacing: [f64; D],
    positions: &[[f64; D]],
    fields: &[[f64; F]],
) -> [f64; F] {
    let near = positions.iter().enumerate().map(|(point, position)| {
        let offset: [f64; D] =
            std::array::from_fn(|axis| (position[axis] - place[axis]) / spacing[axis]);
        (offset, offset.iter().map(|&r| cubic_spline(r)).product(), point)
    });
    fit(&near.filter(|&(_, weight, _)| weight > 0.0).collect::<Vec<_>>(), fields).values()
}

/// w(r) = 2/3 − 4r² + 4r³ for |r| ≤ ½, 4/3 (1 − |r|)³ for |r| ≤ 1, else 0.
fn cubic_spline(r: f64) -> f64 {
    let r = r.abs();
    if r <= 0.5 {
        2.0 / 3.0 - 4.0 * r * r * (1.0 - r)
    } else if r < 1.0 {
        4.0 / 3.0 * (1.0 - r).powi(3)
    } else {
        0.0
    }
}

enum Fit<const F: usize> {
    Linear([f64; F]),
    Mean([f64; F]),
    Empty,
}

impl<const F: usize> Fit<F> {
    fn values(&self) -> [f64; F] {
        match self {
            Self::Linear(values) | Self::Mean(values) => *values,
            Self::Empty => [f64::NAN; F],
        }
    }
}

/// Spread of the points, in cells squared, below which a direction counts as not sampled.
const SINGULAR: f64 = 1e-6;

/// Linear least squares about the weighted mean: with mean offset s, mean values f̄ and second
/// moments C, the value at the origin is f̄ − sᵀ C⁻¹ Σ w (r − s)(f − f̄).
fn fit<const D: usize, const F: usize>(
    near: &[([f64; D], f64, usize)],
    fields: &[[f64; F]],
) -> Fit<F> {
    let total: f64 = near.iter().map(|(_, weight, _)| weight).sum();
    if total <= 0.0 {
        return Fit::Empty;
    }
    let mut mean_offset = SVector::<f64, D>::zeros();
    let mut mean = SVector::<f64, F>::zeros();
    for &(offset, weight, point) in near {
        mean_offset += SVector::from(offset) * (weight / total);
        mean += SVector::from(fields[point]) * (weight / total);
    }
    let mut second = SMatrix::<f64, D, D>::zeros();
    let mut mixed = SMatrix::<f64, D, F>::zeros();
    for &(offset, weight, point) in near {
        let r = SVector::from(offset) - mean_offset;
        let f = SVector::from(fields[point]) - mean;
        second += r * r.transpose() * (weight / total);
        mixed += r * f.transpose() * (weight / total);
    }
    let factor = second.cholesky().filter(|factor| {
        let l = factor.l_dirty();
        (0..D).all(|axis| l[(axis, axis)].powi(2) > SINGULAR)
    });
    match factor {
        Some(factor) => {
            let gradient = factor.solve(&mixed);
            Fit::Linear((mean - gradient.transpose() * mean_offset).into())
        }
        None => Fit::Mean(mean.into()),
    }
}

/// Points by cell.
struct Bins {
    starts: Vec<usize>,
    points: Vec<usize>,
}

impl Bins {
    /// Counting sort; points outside the grid go to the nearest cell.
    fn new<const D: usize>(grid: &GridSpec<D>, positions: &[[f64; D]]) -> Self {
        let cell_of = |position: &[f64; D]| {
            let cell: [usize; D] = std::array::from_fn(|axis| {
                let place = (position[axis] - grid.origin[axis]) / grid.spacing[axis];
                (place.max(0.0) as usize).min(grid.cells[axis].saturating_sub(1))
            });
            flatten(grid, cell)
        };
        let cells: Vec<usize> = positions.iter().map(cell_of).collect();
        let mut starts = vec![0; grid.cells.iter().product::<usize>() + 1];
        for &cell in &cells {
            starts[cell + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut points = vec![0; positions.len()];
        for (point, &cell) in cells.iter().enumerate() {
            points[next[cell]] = point;
            next[cell] += 1;
        }
        Self { starts, points }
    }

    fn points(&self, cell: usize) -> &[usize] {
        &self.points[self.starts[cell]..self.starts[cell + 1]]
    }
}

fn flatten<const D: usize>(grid: &GridSpec<D>, cell: [usize; D]) -> usize {
    (0..D).fold(0, |flat, axis| flat * grid.cells[axis] + cell[axis])
}

fn unflatten<const D: usize>(grid: &GridSpec<D>, mut flat: usize) -> [usize; D] {
    let mut cell = [0; D];
    for axis in (0..D).rev() {
        cell[axis] = flat % grid.cells[axis];
        flat /= grid.cells[axis];
    }
    cell
}

/// The cell and its neighbours with the shift that periodic images need, m.
fn neighbors<const D: usize>(
    grid: &GridSpec<D>,
    cell: [usize; D],
    periodic: [bool; D],
) -> Vec<(usize, [f64; D])> {
    let mut found = Vec::with_capacity(27);
    'images: for code in 0..3usize.pow(D as u32) {
        let mut neighbor = [0; D];
        let mut shift = [0.0; D];
        let mut rest = code;
        for axis in 0..D {
            let n = grid.cells[axis].cast_signed();
            let index = (cell[axis] + rest % 3).cast_signed() - 1;
            rest /= 3;
            let inside = (0..n).contains(&index);
            if !inside && !periodic[axis] {
                continue 'images;
            }
            let wraps = index.div_euclid(n);
            neighbor[axis] = index.rem_euclid(n) as usize;
            shift[axis] = wraps as f64 * n as f64 * grid.spacing[axis];
        }
        found.push((flatten(grid, neighbor), shift));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(cells: [usize; 2]) -> GridSpec<2> {
        GridSpec { origin: [0.0, -1.0], spacing: [0.5, 0.25], cells }
    }

    /// Disordered points: four per cell, displaced by a fixed irregular pattern.
    fn cloud(grid: &GridSpec<2>) -> Vec<[f64; 2]> {
        let mut points = Vec::new();
        for i in 0..2 * grid.cells[0] {
            for j in 0..2 * grid.cells[1] {
                let wobble = |n: usize| 0.3 * ((n as f64 * 12.9898).sin() * 43_758.545).fract();
                let seed = 31 * i + 17 * j;
                points.push([
                    grid.origin[0] + (i as f64 + 0.5 + wobble(seed)) * grid.spacing[0] / 2.0,
                    grid.origin[1] + (j as f64 + 0.5 + wobble(seed + 7)) * grid.spacing[1] / 2.0,
                ]);
            }
        }
        points
    }

    #[test]
    fn linear_fields_come_back_exactly_next_to_walls_too() {
        let grid = grid([6, 5]);
        let points = cloud(&grid);
        let linear = |x: [f64; 2]| [3.0 - 2.0 * x[0] + 5.0 * x[1], 7.0 * x[0]];
        let fields: Vec<_> = points.iter().map(|&x| linear(x)).collect();
        let slip = [[Boundary::Slip; 2]; 2];
        let cells = reconstruct(&grid, &slip, &points, &fields);
        assert_eq!((cells.samples.len(), cells.n_fallbacks, cells.n_empty), (30, 0, 0));
        for (center, values) in cells.samples {
            let expected = linear(center);
            for (value, expected) in values.iter().zip(expected) {
                assert!((value - expected).abs() < 1e-12, "{center:?}");
            }
        }
    }

    #[test]
    fn periodic_support_wraps_around() {
        let grid = grid([8, 4]);
        let points = cloud(&grid);
        let periodic = [[Boundary::Periodic; 2]; 2];
        // The same cloud moved by one period along x must give the same values.
        let wave = |x: f64| (std::f64::consts::TAU * x / 4.0).sin();
        let fields: Vec<_> = points.iter().map(|x| [wave(x[0])]).collect();
        let cells = reconstruct(&grid, &periodic, &points, &fields);
        let worst = cells
            .samples
            .iter()
            .map(|(center, [value])| (value - wave(center[0])).abs())
            .fold(0.0, f64::max);
        assert!(worst < 0.05, "{worst}");
        assert_eq!(cells.n_empty, 0);
    }

    #[test]
    fn few_points_give_their_mean_and_none_give_no_number() {
        let grid = grid([4, 1]);
        let slip = [[Boundary::Slip; 2]; 2];
        let cells = reconstruct(&grid, &slip, &[[0.2, -0.9]], &[[4.0]]);
        assert_eq!(cells.samples[0].1, [4.0]);
        assert!(cells.samples[3].1[0].is_nan());
        assert_eq!((cells.n_fallbacks, cells.n_empty), (1, 3));
    }
}
