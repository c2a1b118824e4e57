//! Active nodes: the nodes that the points of active cells touch, stored in ascending order.

use crate::Scalar;
use crate::cells::{ABSENT, Cells, Marks, SLAB_LAYERS};
use crate::grid::Grid;
use crate::scene::Boundary;
use crate::shape::ShapeFunction;

/// A node on a face of the box where a velocity is prescribed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WallNode {
    /// Slot of the node.
    pub slot: u32,
    /// Slot of the node next to it along the axis, or [`ABSENT`].
    pub inner: u32,
    /// Axis of the face.
    pub axis: u8,
    /// 0 lower, 1 upper face.
    pub side: u8,
}

/// Marks a held node that belongs to no body.
pub const NO_BODY: u32 = u32::MAX;

/// A node within the box whose velocity an inlet or a body prescribes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldNode<T> {
    /// Slot of the node.
    pub slot: u32,
    /// Velocity, m/s, in the first entries.
    pub velocity: [T; 4],
    /// Unit vector along which the velocity is prescribed; `None`: all of it is.
    pub normal: Option<[T; 4]>,
    /// Number of the body, or [`NO_BODY`].
    pub body: u32,
}

/// Node rows: vectors in entries `0..D`, a scalar in entry 3.
///
/// Nodes of one stencil row (consecutive along the last axis) have consecutive slots.
#[derive(Clone, Debug)]
pub struct Nodes<T> {
    /// Dense number → slot, or [`ABSENT`].
    pub slot_of: Vec<u32>,
    /// Slot → dense number.
    pub index: Vec<u32>,
    /// Velocity-transfer sums over points: Σ w m v (kg m/s) and Σ w m (kg).
    pub transfer: Vec<[T; 4]>,
    /// Force (N) and mass by quadrature (kg).
    pub force: Vec<[T; 4]>,
    /// Velocity at the start of the step, later at its end, m/s.
    pub velocity: Vec<[T; 4]>,
    /// Velocity change of the step Δt a, m/s.
    pub increment: Vec<[T; 4]>,
    /// Velocity rebuilt from the points for the stress update, m/s; empty unless a step needs it.
    pub rebuilt: Vec<[T; 4]>,
    /// Per active cell, the slot of the first node of each of its `REACH^(D−1)` stencil rows.
    pub rows: Vec<u32>,
    /// Nodes of faces with a prescribed velocity.
    pub walls: Vec<WallNode>,
    /// Nodes held by inlets and bodies.
    pub held: Vec<HeldNode<T>>,
    /// Pairs of slots that are one node, in order of axes.
    pub images: Vec<[u32; 2]>,
    /// Slot of the first node of each slab along the first axis; one entry more than slabs.
    pub slab_first: Vec<u32>,
    marks: Marks,
    mirrored: Vec<u32>,
}

impl<T: Scalar> Nodes<T> {
    /// No active node on a grid.
    pub fn new<const D: usize>(grid: &Grid<T, D>) -> Self {
        let n = grid.total_nodes();
        Self {
            slot_of: vec![ABSENT; n],
            index: Vec::new(),
            transfer: Vec::new(),
            force: Vec::new(),
            velocity: Vec::new(),
            increment: Vec::new(),
            rebuilt: Vec::new(),
            rows: Vec::new(),
            walls: Vec::new(),
            held: Vec::new(),
            images: Vec::new(),
            slab_first: Vec::new(),
            marks: Marks::new(n),
            mirrored: Vec::new(),
        }
    }

    /// Number of active nodes.
    pub fn len(&self) -> usize {
        self.index.len()
    }

    /// Whether no node is active.
    pub fn is_empty(&self) -> bool {
        self.index.is_empty()
    }

    /// Lists the nodes that the active cells touch, with their images, rows and walls.
    pub fn activate<const D: usize, S: ShapeFunction<T>>(
        &mut self,
        grid: &Grid<T, D>,
        shape: &S,
        cells: &Cells,
        boundaries: &[[Boundary; 2]; D],
    ) {
        self.number(grid, S::REACH, cells);
        self.list_rows(grid, S::REACH, cells);
        self.list_images(grid);
        self.list_walls(grid, shape, boundaries);
        let nodes_per_layer = grid.total_nodes() / grid.n_nodes(0);
        self.slab_first.clear();
        for slab in 0..grid.n_cells[0].div_ceil(SLAB_LAYERS) {
            let begin = slab * SLAB_LAYERS * nodes_per_layer;
            let slot = self.index.partition_point(|&node| (node as usize) < begin);
            self.slab_first.push(slot as u32);
        }
        self.slab_first.push(self.index.len() as u32);
        let zero = [T::zero(); 4];
        for rows in [&mut self.transfer, &mut self.force, &mut self.velocity, &mut self.increment] {
            rows.resize(self.index.len(), zero);
        }
    }

    fn number<const D: usize>(&mut self, grid: &Grid<T, D>, reach: usize, cells: &Cells) {
        for &node in &self.index {
            self.slot_of[node as usize] = ABSENT;
        }
        for &cell in &cells.index {
            for_each_row_start(grid, reach, grid.cell_coordinates(cell), |start| {
                for node in start..start + reach {
                    self.marks.set(node);
                }
            });
        }
        if grid.periodic.contains(&true) {
            self.mark_images(grid);
        }
        self.index.clear();
        let index = &mut self.index;
        self.marks.drain(|node| index.push(node));
        for (slot, &node) in self.index.iter().enumerate() {
            self.slot_of[node as usize] = slot as u32;
        }
    }

    /// Marks the image of every marked node, axis by axis so that corners get all of theirs.
    fn mark_images<const D: usize>(&mut self, grid: &Grid<T, D>) {
        for axis in 0..D {
            if !grid.periodic[axis] {
                continue;
            }
            self.mirrored.clear();
            let mirrored = &mut self.mirrored;
            self.marks.drain(|node| mirrored.push(node));
            for &node in &self.mirrored {
                self.marks.set(node as usize);
                if let Some(image) = image_of(grid, node, axis) {
                    self.marks.set(image);
                }
            }
        }
    }

    fn list_rows<const D: usize>(&mut self, grid: &Grid<T, D>, reach: usize, cells: &Cells) {
        self.rows.clear();
        for &cell in &cells.index {
            for_each_row_start(grid, reach, grid.cell_coordinates(cell), |start| {
                self.rows.push(self.slot_of[start]);
            });
        }
    }

    fn list_images<const D: usize>(&mut self, grid: &Grid<T, D>) {
        self.images.clear();
        for axis in 0..D {
            if !grid.periodic[axis] {
                continue;
            }
            for (slot, &node) in self.index.iter().enumerate() {
                if grid.node_coordinates(node)[axis] < grid.extra
                    && let Some(image) = image_of(grid, node, axis)
                {
                    self.images.push([slot as u32, self.slot_of[image]]);
                }
            }
        }
    }

    fn list_walls<const D: usize, S: ShapeFunction<T>>(
        &mut self,
        grid: &Grid<T, D>,
        shape: &S,
        boundaries: &[[Boundary; 2]; D],
    ) {
        let on_wall = std::array::from_fn::<_, D, _>(|axis| {
            [0, 1].map(|side| {
                let n = grid.n_cells[axis];
                let open = matches!(boundaries[axis][side], Boundary::Periodic | Boundary::Free);
                let wall = T::lit(if side == 0 { 0.0 } else { n as f64 });
                (0..grid.n_nodes(axis))
                    .find(|&node| !open && shape.node_coordinate(node, n, false) == wall)
            })
        });
        self.walls.clear();
        for (slot, &node) in self.index.iter().enumerate() {
            let at = grid.node_coordinates(node);
            for axis in 0..D {
                for side in 0..2 {
                    if on_wall[axis][side] == Some(at[axis]) {
                        let inner = self.inner(grid, node, (axis, side));
                        let (axis, side) = (axis as u8, side as u8);
                        self.walls.push(WallNode { slot: slot as u32, inner, axis, side });
                    }
                }
            }
        }
    }

    /// Slot of the node next to one on a face, [`ABSENT`] if it is not stored.
    fn inner<const D: usize>(
        &self,
        grid: &Grid<T, D>,
        node: u32,
        (axis, side): (usize, usize),
    ) -> u32 {
        let stride: usize = (axis + 1..D).map(|a| grid.n_nodes(a)).product();
        let node = node as usize;
        let inner = if side == 0 { Some(node + stride) } else { node.checked_sub(stride) };
        inner.and_then(|inner| self.slot_of.get(inner)).copied().unwrap_or(ABSENT)
    }

    /// Adds the sums of image nodes, so that both hold the total.
    pub fn fold(images: &[[u32; 2]], rows: &mut [[T; 4]]) {
        for &[a, b] in images {
            for k in 0..4 {
                let sum = rows[a as usize][k] + rows[b as usize][k];
                rows[a as usize][k] = sum;
                rows[b as usize][k] = sum;
            }
        }
    }
}

/// Visits the dense number of the first node of each stencil row of a cell.
fn for_each_row_start<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    reach: usize,
    cell: [usize; D],
    mut visit: impl FnMut(usize),
) {
    let n_rows = reach.pow(D as u32 - 1);
    let base = grid.first_node(cell);
    for row in 0..n_rows {
        let mut rest = row;
        let mut start = base;
        let mut stride = grid.n_nodes(D - 1);
        for axis in (0..D - 1).rev() {
            start += (rest % reach) * stride;
            rest /= reach;
            stride *= grid.n_nodes(axis);
        }
        visit(start);
    }
}

/// The other stored copy of a node along a periodic axis, if it has one.
fn image_of<T: Scalar, const D: usize>(grid: &Grid<T, D>, node: u32, axis: usize) -> Option<usize> {
    let stride: usize = (axis + 1..D).map(|a| grid.n_nodes(a)).product();
    let at = grid.node_coordinates(node)[axis];
    let n = grid.n_cells[axis];
    if at < grid.extra {
        Some(node as usize + n * stride)
    } else if at >= n {
        Some(node as usize - n * stride)
    } else {
        None
    }
}
