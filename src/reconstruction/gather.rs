//! Visiting the points around a target.

use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::grid::Grid;

/// The sorted points of a grid, ready to be searched.
#[derive(Clone, Copy, Debug)]
pub struct Cloud<'a, T, const D: usize> {
    /// The grid.
    pub grid: &'a Grid<T, D>,
    /// Which points each active cell holds.
    pub cells: &'a Cells,
    /// Positions in cell order, m.
    pub position: &'a [[T; D]],
    /// Masses in cell order, kg.
    pub mass: &'a [T],
    /// Densities in cell order, kg/m³.
    pub density: &'a [T],
}

/// A box of cells around a target, as a range per axis that may reach over a periodic face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighborhood<const D: usize> {
    /// First cell per axis, possibly negative on a periodic axis.
    pub first: [i32; D],
    /// One past the last cell per axis.
    pub end: [i32; D],
}

impl<const D: usize> Neighborhood<D> {
    /// The cells that a box of half width `reach` cells about `target` (in cells) overlaps.
    #[inline(always)]
    pub fn around<T: Scalar>(grid: &Grid<T, D>, target: [T; D], reach: T) -> Self {
        let mut first = [0; D];
        let mut end = [0; D];
        for axis in 0..D {
            // Shifted to positive numbers, since truncation is only a floor there.
            let lift = 16;
            let lifted = target[axis] + T::from_index(16);
            first[axis] = (lifted - reach).truncate() - lift;
            let upper = lifted + reach;
            let whole = upper.truncate();
            let partial = i32::from(T::from_index(whole as usize) < upper);
            end[axis] = whole + partial - lift;
            if !grid.periodic[axis] {
                first[axis] = first[axis].max(0);
                end[axis] = end[axis].min(grid.n_cells[axis] as i32);
            }
        }
        Self { first, end }
    }
}

impl<T: Scalar, const D: usize> Cloud<'_, T, D> {
    /// Visits the points of a neighbourhood with their offsets from the target, in cells.
    ///
    /// The order is that of cells, then of points within a cell: it does not depend on threads.
    #[inline(always)]
    pub fn visit(
        &self,
        neighborhood: Neighborhood<D>,
        target: [T; D],
        mut visit: impl FnMut(usize, [T; D]),
    ) {
        let Neighborhood { first, end } = neighborhood;
        if (0..D).any(|axis| first[axis] >= end[axis]) {
            return;
        }
        let mut at = first;
        loop {
            self.visit_cell(at, target, &mut visit);
            let mut axis = D - 1;
            loop {
                at[axis] += 1;
                if at[axis] < end[axis] {
                    break;
                }
                if axis == 0 {
                    return;
                }
                at[axis] = first[axis];
                axis -= 1;
            }
        }
    }

    #[inline(always)]
    fn visit_cell(&self, at: [i32; D], target: [T; D], visit: &mut impl FnMut(usize, [T; D])) {
        let mut index = 0;
        let mut base = [T::zero(); D];
        for axis in 0..D {
            let n = self.grid.n_cells[axis] as i32;
            let mut wrapped = at[axis];
            let mut shift = 0;
            if wrapped < 0 || wrapped >= n {
                wrapped = wrapped.rem_euclid(n);
                shift = at[axis] - wrapped;
            }
            index = index * n as usize + wrapped as usize;
            base[axis] = T::lit(f64::from(shift)) - target[axis];
        }
        let slot = self.cells.slot_of[index];
        if slot == ABSENT {
            return;
        }
        for point in self.cells.points(slot as usize) {
            let position = self.position[point];
            let mut offset = base;
            for axis in 0..D {
                offset[axis] += self.grid.in_cells(position, axis);
            }
            visit(point, offset);
        }
    }
}
