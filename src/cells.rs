//! Active cells: which cells hold points, and which points each holds.

use crate::Scalar;
use crate::grid::Grid;
use crate::math::Field;
use crate::particles::Particles;
use crate::shape::Bare;

/// Marks a cell or node that is not stored.
pub const ABSENT: u32 = u32::MAX;

/// Layers of cells along the first axis that one scatter task owns; at least the widest overlap of
/// shape functions, so that two tasks of one colour never write to the same node.
pub const SLAB_LAYERS: usize = 3;

/// What a cell is to the mixed quadrature (Sect. 2.3 of \[Song2020\]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellKind {
    /// Full of fluid.
    #[default]
    Internal,
    /// Cut by the free surface.
    Boundary,
}

/// A bit per cell or node, read out in ascending order; replaces sorting.
#[derive(Clone, Debug, Default)]
pub struct Marks {
    words: Vec<u64>,
}

impl Marks {
    /// Marks for `n` items, none set.
    pub fn new(n: usize) -> Self {
        Self { words: vec![0; n.div_ceil(64)] }
    }

    /// Sets the mark of an item.
    #[inline(always)]
    pub fn set(&mut self, item: usize) {
        self.words[item / 64] |= 1 << (item % 64);
    }

    /// Visits the marked items in ascending order and clears all marks.
    pub fn drain(&mut self, mut visit: impl FnMut(u32)) {
        for (w, word) in self.words.iter_mut().enumerate() {
            while *word != 0 {
                visit((w * 64) as u32 + word.trailing_zeros());
                *word &= *word - 1;
            }
        }
    }
}

/// The cells that hold points, in ascending order of their dense numbers.
///
/// Active cell `s` holds points `first[s] .. first[s + 1]` of the sorted point arrays.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Dense number → slot of an active cell, or [`ABSENT`].
    pub slot_of: Vec<u32>,
    /// Slot → dense number.
    pub index: Vec<u32>,
    /// Slot → first point; one entry more than cells.
    pub first: Vec<u32>,
    /// Slot of the first cell of each slab along the first axis; one entry more than slabs.
    pub slab_first: Vec<u32>,
    /// Slot → kind.
    pub kind: Vec<CellKind>,
    /// Slot → whether a node of the cell touches a boundary or empty cell.
    pub near_surface: Vec<bool>,
    /// Dense number → whether a rigid body fills the cell; without entries where there is no body.
    pub solid: Vec<bool>,
    marks: Marks,
    order: Vec<u32>,
    cursor: Vec<u32>,
    previous: Vec<u32>,
}

/// What sorting found out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binned {
    /// Points were in cell order already; nothing has changed.
    Unchanged,
    /// Points have been reordered; the same cells are active as before.
    SameCells,
    /// The set of active cells has changed.
    NewCells,
}

impl Cells {
    /// No active cell on a grid.
    pub fn new<T: Scalar, const D: usize>(grid: &Grid<T, D>) -> Self {
        let n = grid.total_cells();
        Self { slot_of: vec![ABSENT; n], marks: Marks::new(n), ..Self::default() }
    }

    /// Number of active cells.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether no cell is active.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// Whether a cell holds neither points nor a rigid body.
    #[inline(always)]
    pub fn is_vacant(&self, cell: usize) -> bool {
        self.slot_of[cell] == ABSENT && !self.is_solid(cell)
    }

    /// Whether a rigid body fills a cell.
    #[inline(always)]
    pub fn is_solid(&self, cell: usize) -> bool {
        self.solid.get(cell).is_some_and(|&solid| solid)
    }

    /// Which neighbours of a cell hold no points; those beyond walls do not count.
    #[inline(always)]
    pub fn bare<T: Scalar, const D: usize>(&self, grid: &Grid<T, D>, cell: [usize; D]) -> Bare {
        let mut bare = Bare::default();
        for axis in 0..D {
            for side in 0..2 {
                let mut shift = [0; D];
                shift[axis] = 2 * side as i32 - 1;
                let neighbor = grid.neighbor(cell, shift);
                bare.0[axis][side] = neighbor.is_some_and(|cell| self.slot_of[cell] == ABSENT);
            }
        }
        bare
    }

    /// Points of an active cell.
    #[inline(always)]
    pub fn points(&self, slot: usize) -> std::ops::Range<usize> {
        self.first[slot] as usize..self.first[slot + 1] as usize
    }

    /// Sorts the points by cell (stable counting sort) and lists the active cells.
    ///
    /// `particles.cell` must be up to date; points marked [`ABSENT`] are dropped. `spare` is the other half of a double buffer.
    pub fn bin<T: Scalar, const D: usize, A: Field<T>, S: Field<T>>(
        &mut self,
        grid: &Grid<T, D>,
        particles: &mut Particles<T, D, A, S>,
        spare: &mut Particles<T, D, A, S>,
    ) -> Binned {
        if self.is_sorted(&particles.cell) {
            return Binned::Unchanged;
        }
        let new_cells = self.activate(&particles.cell);
        self.sort_order(&particles.cell);
        spare.gather_from(particles, &self.order);
        std::mem::swap(particles, spare);
        if new_cells {
            self.cut_slabs(grid);
            Binned::NewCells
        } else {
            Binned::SameCells
        }
    }

    fn is_sorted(&self, cell_of_point: &[u32]) -> bool {
        let n = self.first.last().map_or(0, |&last| last as usize);
        n == cell_of_point.len()
            && self.index.iter().enumerate().all(|(slot, &cell)| {
                cell_of_point[self.points(slot)].iter().all(|&found| found == cell)
            })
    }

    fn activate(&mut self, cell_of_point: &[u32]) -> bool {
        for &cell in cell_of_point.iter().filter(|&&cell| cell != ABSENT) {
            self.marks.set(cell as usize);
        }
        std::mem::swap(&mut self.previous, &mut self.index);
        self.index.clear();
        let index = &mut self.index;
        self.marks.drain(|cell| index.push(cell));
        if self.index == self.previous {
            return false;
        }
        for &cell in &self.previous {
            self.slot_of[cell as usize] = ABSENT;
        }
        for (slot, &cell) in self.index.iter().enumerate() {
            self.slot_of[cell as usize] = slot as u32;
        }
        self.kind.clear();
        self.kind.resize(self.index.len(), CellKind::Internal);
        self.near_surface.clear();
        self.near_surface.resize(self.index.len(), false);
        true
    }

    fn sort_order(&mut self, cell_of_point: &[u32]) {
        let n_cells = self.index.len();
        self.first.clear();
        self.first.resize(n_cells + 1, 0);
        for &cell in cell_of_point.iter().filter(|&&cell| cell != ABSENT) {
            self.first[self.slot_of[cell as usize] as usize + 1] += 1;
        }
        for slot in 0..n_cells {
            self.first[slot + 1] += self.first[slot];
        }
        self.cursor.clear();
        self.cursor.extend_from_slice(&self.first[..n_cells]);
        self.order.resize(self.first[n_cells] as usize, 0);
        for (point, &cell) in cell_of_point.iter().enumerate() {
            if cell == ABSENT {
                continue;
            }
            let cursor = &mut self.cursor[self.slot_of[cell as usize] as usize];
            self.order[*cursor as usize] = point as u32;
            *cursor += 1;
        }
    }

    fn cut_slabs<T: Scalar, const D: usize>(&mut self, grid: &Grid<T, D>) {
        let cells_per_layer = grid.total_cells() / grid.n_cells[0];
        self.slab_first.clear();
        let n_slabs = grid.n_cells[0].div_ceil(SLAB_LAYERS);
        for slab in 0..n_slabs {
            let begin = slab * SLAB_LAYERS * cells_per_layer;
            let slot = self.index.partition_point(|&cell| (cell as usize) < begin);
            self.slab_first.push(slot as u32);
        }
        self.slab_first.push(self.index.len() as u32);
    }
}
