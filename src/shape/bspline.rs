//! Quadratic and cubic B-splines with knots on the cell faces, open (repeated) at walls.

use super::{AxisPosition, MAX_WIDTH, Row, ShapeFunction};
use std::ops::{Add, Mul, Neg, Sub};

use crate::Scalar;
use crate::simd::{Simd, SimdBase as _, lanes, splat};

/// Quadratic B-splines, \[Steffen2008\]: `n + 2` functions on `n` cells.
///
/// ```text
/// N = ½ (1 − ξ)²,  ½ + ξ − ξ²,  ½ ξ²       in cells that do not touch a wall
/// ```
///
/// At walls the knots are repeated, which doubles the outer function: the first function of the
/// first cell is (1 − ξ)². Weights lie in `[0, 1]`; first derivatives are continuous.
///
/// ```
/// use transpoint::shape::{AxisPosition, QuadraticBspline, ShapeFunction};
/// let row = QuadraticBspline.row(AxisPosition { cell: 3, xi: 0.5, n_cells: 8, periodic: false });
/// assert_eq!(row.weight[..3], [0.125, 0.75, 0.125]);
/// assert_eq!(row.gradient[..3], [-0.5, 0.0, 0.5]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct QuadraticBspline;

impl<T: Scalar> ShapeFunction<T> for QuadraticBspline {
    const WIDTH: usize = 3;
    const REACH: usize = 3;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        let zero = T::zero();
        let (lower, upper) = (lower_span(&at), upper_span(&at));
        let ([a, b, c], [da, db, dc]) = quadratic(at.xi, lower, upper, T::one());
        Row { first: 0, weight: [a, b, c, zero], gradient: [da, db, dc, zero] }
    }

    #[inline(always)]
    fn rows<S: Simd, const D: usize>(
        &self,
        simd: S,
        at: &[AxisPosition<T>; D],
        inverse_spacing: T::Four<S>,
    ) -> [Row<T>; D] {
        let lower = (
            lanes::<T, S, D>(simd, |axis| lower_span(&at[axis]).0),
            lanes::<T, S, D>(simd, |axis| lower_span(&at[axis]).1),
        );
        let upper = (
            lanes::<T, S, D>(simd, |axis| upper_span(&at[axis]).0),
            lanes::<T, S, D>(simd, |axis| upper_span(&at[axis]).1),
        );
        let xi = lanes::<T, S, D>(simd, |axis| at[axis].xi);
        let (weight, gradient) = quadratic(xi, lower, upper, splat(simd, T::one()));
        let mut rows = [Row::zero(); D];
        for k in 0..3 {
            let gradient = gradient[k] * inverse_spacing;
            for axis in 0..D {
                rows[axis].weight[k] = weight[k].as_array()[axis];
                rows[axis].gradient[k] = gradient.as_array()[axis];
            }
        }
        rows
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> T {
        if periodic {
            return T::from_index(index) - T::lit(0.5);
        }
        let knots = clamped_knot(index, 1, n_cells) + clamped_knot(index, 0, n_cells);
        T::from_index(knots) / T::lit(2.0)
    }
}

/// Cells from the lowest knot of the middle function to the cell, and 1 / cells to the cell's upper face.
///
/// A wall shortens the span from 2 cells to 1. Without short circuits this is a choice of factors, made
/// once per cell.
#[inline(always)]
#[expect(clippy::needless_bitwise_bool, reason = "a short circuit becomes a branch per point")]
fn lower_span<T: Scalar>(at: &AxisPosition<T>) -> (T, T) {
    let at_wall = !at.periodic & (at.cell == 0);
    if at_wall { (T::zero(), T::one()) } else { (T::one(), T::lit(0.5)) }
}

/// Cells from the cell's lower face to the highest knot of the middle function, and their inverse.
#[inline(always)]
#[expect(clippy::needless_bitwise_bool, reason = "a short circuit becomes a branch per point")]
fn upper_span<T: Scalar>(at: &AxisPosition<T>) -> (T, T) {
    let at_wall = !at.periodic & (at.cell + 1 == at.n_cells);
    if at_wall { (T::one(), T::one()) } else { (T::lit(2.0), T::lit(0.5)) }
}

/// Values and derivatives of the three functions: Cox-de Boor recursion written out.
#[inline(always)]
fn quadratic<V>(
    xi: V,
    (before, per_lower_span): (V, V),
    (after, per_upper_span): (V, V),
    one: V,
) -> ([V; 3], [V; 3])
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<Output = V> + Neg<Output = V>,
{
    let two = one + one;
    let (left, right) = (per_lower_span * (one - xi), per_upper_span * xi);
    let value = [left * (one - xi), left * (xi + before) + right * (after - xi), right * xi];
    (value, [-two * left, two * (left - right), two * right])
}

/// Cubic B-splines, \[Steffen2008\]: `n + 3` functions on `n` cells.
///
/// ```text
/// N = (1 − ξ)³/6,  2/3 − ξ² + ξ³/2,  2/3 − (1 − ξ)² + (1 − ξ)³/2,  ξ³/6
/// ```
///
/// in cells at least two away from a wall; near walls the knots are repeated. Weights lie in `[0, 1]`;
/// second derivatives are continuous.
///
/// ```
/// use transpoint::shape::{AxisPosition, CubicBspline, ShapeFunction};
/// let row = CubicBspline.row(AxisPosition { cell: 3, xi: 0.0, n_cells: 8, periodic: false });
/// let expected: [f64; 4] = [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0];
/// assert!(row.weight.iter().zip(expected).all(|(found, exact)| (found - exact).abs() < 1e-15));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CubicBspline;

impl<T: Scalar> ShapeFunction<T> for CubicBspline {
    const WIDTH: usize = 4;
    const REACH: usize = 4;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        if at.periodic || (at.cell >= 2 && at.cell + 3 <= at.n_cells) {
            uniform_cubic(at.xi)
        } else {
            clamped_cubic(at)
        }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> T {
        if periodic {
            return T::from_index(index) - T::one();
        }
        let knots: usize = (0..3).map(|back| clamped_knot(index, back, n_cells)).sum();
        T::from_index(knots) / T::lit(3.0)
    }
}

/// Knot `index − back`, kept within the axis, in cells.
#[inline(always)]
fn clamped_knot(index: usize, back: usize, n_cells: usize) -> usize {
    index.saturating_sub(back).min(n_cells)
}

#[inline(always)]
fn uniform_cubic<T: Scalar>(xi: T) -> Row<T> {
    let (half, two) = (T::lit(0.5), T::lit(2.0));
    let (sixth, two_thirds, three_halves) = (T::lit(1.0 / 6.0), T::lit(2.0 / 3.0), T::lit(1.5));
    let eta = T::one() - xi;
    let (xi_2, eta_2) = (xi * xi, eta * eta);
    Row {
        first: 0,
        weight: [
            sixth * eta_2 * eta,
            two_thirds - xi_2 * (T::one() - half * xi),
            two_thirds - eta_2 * (T::one() - half * eta),
            sixth * xi_2 * xi,
        ],
        gradient: [
            -half * eta_2,
            xi * (three_halves * xi - two),
            -eta * (three_halves * eta - two),
            half * xi_2,
        ],
    }
}

/// Cox-de Boor recursion on the open knot vector.
///
/// ```text
/// N_r^k = (x − t_r)/(t_{r+k} − t_r) N_r^{k−1} + (t_{r+k+1} − x)/(t_{r+k+1} − t_{r+1}) N_{r+1}^{k−1}
/// ```
///
/// The span of a cell's functions always contains the cell, so no divisor is below one cell.
#[inline]
fn clamped_cubic<T: Scalar>(at: AxisPosition<T>) -> Row<T> {
    const DEGREE: usize = MAX_WIDTH - 1;
    let from_below = |k: usize| at.xi + T::from_index(k.min(at.cell));
    let to_above = |k: usize| T::from_index((k + 1).min(at.n_cells - at.cell)) - at.xi;

    let mut weight = [T::one(), T::zero(), T::zero(), T::zero()];
    let mut gradient = [T::zero(); MAX_WIDTH];
    for degree in 1..=DEGREE {
        let mut carried = T::zero();
        let mut carried_slope = T::zero();
        for r in 0..degree {
            let (above, below) = (to_above(r), from_below(degree - 1 - r));
            let share = weight[r] / (above + below);
            weight[r] = carried + above * share;
            carried = below * share;
            let slope = T::from_index(degree) * share;
            gradient[r] = carried_slope - slope;
            carried_slope = slope;
        }
        weight[degree] = carried;
        gradient[degree] = carried_slope;
    }
    Row { first: 0, weight, gradient }
}
