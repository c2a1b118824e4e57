//! Linear fields by weighted least squares: over the cells around a point, over the points around a place.

use super::REACH;
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::formulation::{PointDivergence, weighted};
use crate::grid::{Grid, shift_of};
use crate::reconstruction::{Cloud, Neighborhood};

/// Least pivot of a slope over the sum of the weights, cells², to which smaller ones are raised. Centres of cells that do
/// not lie in one row tell a slope, however small the weight of some: this is above round-off.
pub(super) const LEAST_OF_CELLS: f64 = 1e-10;
/// The same near the surface and among points, where too little may lie across an axis to tell a slope. It is 1/4 where
/// all cells around are full.
pub(super) const LEAST_AT_EDGES: f64 = 1.0 / 16.0;

/// Values of the cells around one.
pub(super) struct Around<T, const D: usize> {
    cell: [usize; D],
    /// `None` where there is no cell.
    values: [Option<T>; 27],
}

impl<T: Scalar, const D: usize> Around<T, D> {
    /// That of the value of each active cell, where it has one.
    pub fn new(
        grid: &Grid<T, D>,
        cells: &Cells,
        slot: usize,
        value: impl Fn(usize) -> Option<T>,
    ) -> Self {
        let cell = grid.cell_coordinates(cells.index[slot]);
        let mut values = [None; 27];
        for (code, out) in values.iter_mut().enumerate().take(3_usize.pow(D as u32)) {
            let found = grid.neighbor(cell, shift_of::<D>(code));
            let slot = found.map(|found| cells.slot_of[found]);
            *out = slot.filter(|&slot| slot != ABSENT).and_then(|slot| value(slot as usize));
        }
        Self { cell, values }
    }

    /// Place of a position in the cell in the middle, cells from its lower corner.
    pub fn xi(&self, grid: &Grid<T, D>, position: [T; D]) -> [T; D] {
        std::array::from_fn(|axis| grid.in_cells(position, axis) - T::from_index(self.cell[axis]))
    }

    /// Weighted mean, the value of the cell in the middle in place of those that are not there.
    pub fn mean(&self, xi: [T; D]) -> T {
        let middle = self.values[3_usize.pow(D as u32) / 2].unwrap_or(T::zero());
        let around = self.values.map(|value| value.unwrap_or(middle));
        weighted(xi.map(|x| PointDivergence::Quadratic.weights(x)), &around)
    }

    /// Value, and gradient per metre, of the weighted least squares over the cells that are there.
    pub fn fit(&self, xi: [T; D], grid: &Grid<T, D>, least: f64) -> (T, [T; D]) {
        let weights = xi.map(|x| PointDivergence::Quadratic.weights(x));
        let mut fit = LinearFit::<T, D>::default();
        for (code, value) in self.values.iter().enumerate().take(3_usize.pow(D as u32)) {
            let Some(value) = value else { continue };
            let shift = shift_of::<D>(code);
            let (mut weight, mut offset) = (T::one(), xi);
            for axis in 0..D {
                weight *= weights[axis][(shift[axis] + 1) as usize];
                offset[axis] = T::lit(0.5 + f64::from(shift[axis])) - xi[axis];
            }
            fit.add(weight, offset, *value);
        }
        let (value, slope) = fit.solve(T::lit(least));
        (value, std::array::from_fn(|axis| slope[axis] * grid.inverse_spacing[axis]))
    }
}

/// Slope of the density, kg/m⁴, by least squares over the points around a place in cells.
pub(crate) fn slope_among<T: Scalar, const D: usize>(
    cloud: &Cloud<'_, T, D>,
    target: [T; D],
) -> [T; D] {
    let reach = T::lit(REACH);
    let mut fit = LinearFit::<T, D>::default();
    let around = Neighborhood::around(cloud.grid, target, reach);
    cloud.visit(around, target, |point, offset| {
        let share = |along: T| (T::one() - along * along / (reach * reach)).max(T::zero());
        let weight = offset.iter().fold(T::one(), |weight, &along| weight * share(along));
        fit.add(weight, offset, cloud.density[point]);
    });
    let (_, slope) = fit.solve(T::lit(LEAST_AT_EDGES));
    std::array::from_fn(|axis| slope[axis] * cloud.grid.inverse_spacing[axis])
}

/// Weighted least squares of a linear field: moments and right-hand sides of the basis (1, x).
struct LinearFit<T, const D: usize> {
    moments: [[T; 4]; 4],
    values: [T; 4],
}

impl<T: Scalar, const D: usize> Default for LinearFit<T, D> {
    fn default() -> Self {
        Self { moments: [[T::zero(); 4]; 4], values: [T::zero(); 4] }
    }
}

impl<T: Scalar, const D: usize> LinearFit<T, D> {
    #[inline(always)]
    fn add(&mut self, weight: T, offset: [T; D], value: T) {
        let mut basis = [T::one(); 4];
        basis[1..=D].copy_from_slice(&offset);
        for i in 0..=D {
            let part = weight * basis[i];
            self.values[i] += part * value;
            for j in 0..=i {
                self.moments[i][j] += part * basis[j];
            }
        }
    }

    /// Value and slopes at the origin, by the factors L D Lᵀ of the moments, with no entry of D less than `least` times
    /// the sum of the weights; zero without data.
    #[inline(always)]
    fn solve(&self, least: T) -> (T, [T; D]) {
        if !(self.moments[0][0] > T::zero()) {
            return (T::zero(), [T::zero(); D]);
        }
        let mut lower = self.moments;
        let (mut pivots, mut x) = ([T::zero(); 4], self.values);
        for i in 0..=D {
            for j in 0..i {
                let mut entry = lower[i][j];
                for k in 0..j {
                    entry -= lower[i][k] * lower[j][k] * pivots[k];
                }
                lower[i][j] = entry / pivots[j];
            }
            let mut pivot = lower[i][i];
            for k in 0..i {
                pivot -= lower[i][k] * lower[i][k] * pivots[k];
                let known = lower[i][k] * x[k];
                x[i] -= known;
            }
            pivots[i] = pivot.max(least * self.moments[0][0]);
        }
        for i in (0..=D).rev() {
            x[i] /= pivots[i];
            for k in i + 1..=D {
                let known = lower[k][i] * x[k];
                x[i] -= known;
            }
        }
        (x[0], std::array::from_fn(|axis| x[1 + axis]))
    }
}
