//! The divergence that strains a point: at the point, or from the cells around it.

use std::ops::Range;

use super::GridState;
use crate::Scalar;
use crate::cells::ABSENT;
use crate::formulation::{Formulation, PointDivergence, weighted};
use crate::material::Material;
use crate::method::Method;

/// Divergence at the points of one cell.
pub(super) enum CellDivergence<'a, T> {
    /// Trace of the velocity gradient at the point.
    AtPoint,
    /// As given for each point, 1/s.
    OfPoints(&'a [T]),
    /// Weighted mean of the 3^D cells around.
    Around(PointDivergence, [T; 27]),
}

impl<'a, T: Scalar> CellDivergence<'a, T> {
    /// For the points of a cell, given by their numbers.
    #[inline(always)]
    pub fn around<const D: usize, M: Method<T, D>, K: Material<T, D>>(
        state: &GridState<'a, T, D, M, K>,
        (slot, points): (usize, Range<usize>),
        cell: [usize; D],
    ) -> Self {
        if !state.source.at_points.is_empty() {
            return Self::OfPoints(&state.source.at_points[points]);
        }
        let Formulation::VelocityPressure(kind) = state.method.formulation() else {
            return Self::AtPoint;
        };
        let values = state.source.divergence;
        let mut around = [values[slot]; 27];
        if kind != PointDivergence::Constant {
            for (code, value) in around.iter_mut().enumerate().take(3_usize.pow(D as u32)) {
                let mut rest = code;
                let shift = std::array::from_fn(|axis| {
                    let step = (rest % 3) as i32 - 1;
                    rest /= 3;
                    let beyond = (step < 0 && cell[axis] == 0)
                        || (step > 0 && cell[axis] + 1 == state.grid.n_cells[axis]);
                    if beyond && !state.grid.periodic[axis] { 0 } else { step }
                });
                if let Some(neighbor) = state.grid.neighbor(cell, shift) {
                    let slot = state.cells.slot_of[neighbor];
                    if slot != ABSENT {
                        *value = values[slot as usize];
                    }
                }
            }
        }
        Self::Around(kind, around)
    }

    /// At point number `point` of the cell, `xi` being its place in it.
    #[inline(always)]
    pub fn at<const D: usize>(&self, point: usize, xi: &[T; D]) -> T {
        let (kind, around) = match self {
            Self::AtPoint => return T::zero(),
            Self::OfPoints(divergence) => return divergence[point],
            Self::Around(PointDivergence::Constant, around) => return around[0],
            Self::Around(kind, around) => (*kind, around),
        };
        let weights = xi.map(|x| kind.weights(x));
        weighted(weights, around)
    }
}
