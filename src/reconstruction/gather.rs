//! Visiting the points around a target.

use std::ops::Range;

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

impl<const D: usize> Neighborhood<D> {
    /// A cell and those around it, faces and corners included.
    pub fn of_cells_around<T: Scalar>(grid: &Grid<T, D>, cell: [usize; D]) -> Self {
        let mut around =
            Self { first: cell.map(|c| c as i32 - 1), end: cell.map(|c| c as i32 + 2) };
        for axis in 0..D {
            if !grid.periodic[axis] {
                around.first[axis] = around.first[axis].max(0);
                around.end[axis] = around.end[axis].min(grid.n_cells[axis] as i32);
            }
        }
        around
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
        self.visit_runs(
            neighborhood,
            target,
            #[inline(always)]
            |run, base, _row| {
                for point in run.start as usize..run.end as usize {
                    let position = self.position[point];
                    let mut offset = base;
                    for axis in 0..D {
                        offset[axis] += self.grid.in_cells(position, axis);
                    }
                    visit(point, offset);
                }
            },
        );
    }

    /// Visits the points of a neighbourhood as runs that are stored one after another: the points of
    /// cells in a row along the last axis. With each comes what, added to the place of one of its
    /// points in cells from the lower corner, gives the offset from the target, and the first cell of
    /// the row, as in the neighbourhood.
    ///
    /// The order is that of [`Self::visit`].
    #[inline(always)]
    pub fn visit_runs(
        &self,
        neighborhood: Neighborhood<D>,
        target: [T; D],
        mut visit: impl FnMut(Range<u32>, [T; D], [i32; D]),
    ) {
        let Neighborhood { first, end } = neighborhood;
        if (0..D).any(|axis| first[axis] >= end[axis]) {
            return;
        }
        let mut at = first;
        loop {
            self.visit_row(at, end[D - 1], target, &mut visit);
            let mut axis = D - 1;
            loop {
                if axis == 0 {
                    return;
                }
                axis -= 1;
                at[axis] += 1;
                if at[axis] < end[axis] {
                    break;
                }
                at[axis] = first[axis];
            }
        }
    }

    /// The cells from `at` to `end` along the last axis; a periodic face cuts their points in two.
    #[inline(always)]
    fn visit_row(
        &self,
        at: [i32; D],
        end: i32,
        target: [T; D],
        visit: &mut impl FnMut(Range<u32>, [T; D], [i32; D]),
    ) {
        let mut row = 0;
        let mut base = [T::zero(); D];
        for axis in 0..D - 1 {
            let (cell, shift) = self.wrap(axis, at[axis]);
            row = row * self.grid.n_cells[axis] + cell;
            base[axis] = shift - target[axis];
        }
        let last = D - 1;
        let n = self.grid.n_cells[last];
        let mut along = at[last];
        while along < end {
            let (cell, shift) = self.wrap(last, along);
            base[last] = shift - target[last];
            let length = ((end - along) as usize).min(n - cell);
            let begin = row * n + cell;
            if let Some(run) = self.points_of(begin..begin + length) {
                visit(run, base, at);
            }
            along += length as i32;
        }
    }

    /// The cell of the box that a cell number stands for, and the shift from the one to the other.
    #[inline(always)]
    fn wrap(&self, axis: usize, at: i32) -> (usize, T) {
        let n = self.grid.n_cells[axis] as i32;
        if at >= 0 && at < n {
            return (at as usize, T::zero());
        }
        let wrapped = at.rem_euclid(n);
        (wrapped as usize, T::lit(f64::from(at - wrapped)))
    }

    /// The points of cells with consecutive numbers, which are stored in the order of cells.
    #[inline(always)]
    fn points_of(&self, cells: Range<usize>) -> Option<Range<u32>> {
        let slots = &self.cells.slot_of[cells];
        let first = *slots.iter().find(|&&slot| slot != ABSENT)?;
        let last = *slots.iter().rfind(|&&slot| slot != ABSENT)?;
        let starts = &self.cells.first;
        Some(starts[first as usize]..starts[last as usize + 1])
    }
}
