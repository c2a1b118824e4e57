//! The scatter kernel: one sample onto the nodes of its cell.

use super::stencil_nodes::StencilNodes;
use crate::Scalar;
use crate::shape::{MAX_WIDTH, Row, ShapeFunction};
use crate::simd::{Simd, load, splat};
use crate::stencil::Rows;

/// What a sample spreads over its nodes, as node rows:
/// `N value + Σ_a N (x_i − x)_a affine[a] + Σ_a ∂N/∂x_a flux[a]`.
#[derive(Clone, Copy)]
pub(super) struct Spread<F, const D: usize> {
    pub value: F,
    pub affine: [F; D],
    pub flux: [F; D],
}

/// Where a sample sits: its functions and their first moments.
pub(super) struct Site<'a, T, const D: usize> {
    pub rows: &'a Rows<T, D>,
    pub moments: &'a [[T; MAX_WIDTH]; D],
}

impl<T: Scalar, const D: usize> Site<'_, T, D> {
    /// Adds a spread to the node rows of a cell.
    ///
    /// `affine` and `flux` say which columns there are. The axes are contracted one by one; a node then
    /// costs two four-wide products.
    #[inline(always)]
    pub fn add<S: Simd, H: ShapeFunction<T>>(
        &self,
        simd: S,
        (affine, flux): (bool, bool),
        spread: &Spread<T::Four<S>, D>,
        sums: &mut StencilNodes<T, S>,
    ) {
        let inner = D - 1;
        let last = &self.rows[inner];
        let zero = splat(simd, T::zero());
        let mut along = [zero; MAX_WIDTH];
        for k in 0..H::WIDTH {
            if affine {
                along[k] = spread.affine[inner] * splat(simd, self.moments[inner][k]);
            }
            if flux {
                along[k] += spread.flux[inner] * splat(simd, last.gradient[k]);
            }
        }
        let mut line = Line { last, along, sums };
        match D {
            1 => line.add::<H>(simd, 0, spread.value, T::one(), affine || flux),
            2 => {
                let first = self.rows[0].first;
                for i in 0..H::WIDTH {
                    let row = self.contract(simd, (affine, flux), spread, 0, i);
                    let weight = self.rows[0].weight[i];
                    line.add::<H>(simd, first + i, row.value, weight, affine || flux);
                }
            }
            _ => {
                let first = self.rows[0].first * H::REACH + self.rows[1].first;
                for i in 0..H::WIDTH {
                    let plane = self.contract(simd, (affine, flux), spread, 0, i);
                    for j in 0..H::WIDTH {
                        let row = self.contract(simd, (affine, flux), &plane, 1, j);
                        let weight = self.rows[0].weight[i] * self.rows[1].weight[j];
                        let index = first + i * H::REACH + j;
                        line.add::<H>(simd, index, row.value, weight, affine || flux);
                    }
                }
            }
        }
    }

    /// Adds `N mass` to entry 3 of the node rows and `∂N/∂x_a work` to entry `a`: a sample without shear stress.
    ///
    /// Each entry takes its own function along an axis; a node then costs one four-wide product.
    #[inline(always)]
    pub fn add_isotropic<S: Simd, H: ShapeFunction<T>>(
        &self,
        simd: S,
        (work, mass): (T, T),
        sums: &mut StencilNodes<T, S>,
    ) {
        let (inner, o) = (D - 1, T::zero());
        let last = &self.rows[inner];
        if D == 1 {
            for k in 0..H::WIDTH {
                let node = [work * last.gradient[k], o, o, mass * last.weight[k]];
                sums.0[0][last.first + k] += load(simd, &node);
            }
            return;
        }
        let mut along = [splat(simd, o); MAX_WIDTH];
        for k in 0..H::WIDTH {
            along[k] = entries(simd, inner, (last.weight[k], work * last.gradient[k]));
        }
        let outer = &self.rows[0];
        for i in 0..H::WIDTH {
            let (weight, slope) = (outer.weight[i], work * outer.gradient[i]);
            let plane = match D {
                2 => [slope, weight, o, mass * weight],
                _ => [slope, work * weight, weight, mass * weight],
            };
            let plane = load(simd, &plane);
            if D == 2 {
                let row = &mut sums.0[outer.first + i];
                for k in 0..H::WIDTH {
                    row[last.first + k] += plane * along[k];
                }
                continue;
            }
            let middle = &self.rows[1];
            for j in 0..H::WIDTH {
                let of_axis = (middle.weight[j], middle.gradient[j]);
                let line = plane * entries(simd, 1, of_axis);
                let index = outer.first * H::REACH + middle.first + i * H::REACH + j;
                let row = &mut sums.0[index];
                for k in 0..H::WIDTH {
                    row[last.first + k] += line * along[k];
                }
            }
        }
    }

    /// Takes function `k` of an axis but the last; the last axis' columns are left alone.
    #[inline(always)]
    fn contract<S: Simd>(
        &self,
        simd: S,
        (affine, flux): (bool, bool),
        spread: &Spread<T::Four<S>, D>,
        axis: usize,
        k: usize,
    ) -> Spread<T::Four<S>, D> {
        let weight = splat(simd, self.rows[axis].weight[k]);
        let mut taken = *spread;
        taken.value = spread.value * weight;
        if affine {
            let moment = splat(simd, self.moments[axis][k]);
            taken.value += spread.affine[axis] * moment;
        }
        if flux {
            let gradient = splat(simd, self.rows[axis].gradient[k]);
            taken.value += spread.flux[axis] * gradient;
        }
        for later in axis + 1..D - 1 {
            if affine {
                taken.affine[later] = spread.affine[later] * weight;
            }
            if flux {
                taken.flux[later] = spread.flux[later] * weight;
            }
        }
        taken
    }
}

/// A function's value in all entries but that of its axis, which has the slope.
#[inline(always)]
fn entries<T: Scalar, S: Simd>(simd: S, axis: usize, (value, slope): (T, T)) -> T::Four<S> {
    let mut entries = [value; 4];
    entries[axis] = slope;
    load(simd, &entries)
}

/// The last axis: a stencil row of nodes.
struct Line<'a, T: Scalar, S: Simd> {
    last: &'a Row<T>,
    along: [T::Four<S>; MAX_WIDTH],
    sums: &'a mut StencilNodes<T, S>,
}

impl<T: Scalar, S: Simd> Line<'_, T, S> {
    #[inline(always)]
    fn add<H: ShapeFunction<T>>(
        &mut self,
        simd: S,
        row: usize,
        value: T::Four<S>,
        weight: T,
        with_along: bool,
    ) {
        let outer = splat(simd, weight);
        for k in 0..H::WIDTH {
            let mut part = value * splat(simd, self.last.weight[k]);
            if with_along {
                part += self.along[k] * outer;
            }
            self.sums.0[row][self.last.first + k] += part;
        }
    }
}
