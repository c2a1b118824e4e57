//! Points are pushed out of nodes that hold more volume than there is room.

use super::{Event, EventKind, RearrangerOf};
use crate::Scalar;
use crate::grid::Grid;
use crate::material::Material;
use crate::math::dot;
use crate::method::Method;
use crate::shape::ShapeFunction;
use crate::solver::Solver;
use crate::step::{AffineOf, gradients_at_points, settle};

/// What the shift by overfill keeps.
#[derive(Clone, Debug)]
pub(super) struct Room<T, const D: usize, A> {
    /// Volume of a node is the product over the axes of ∫ N dx, m, stored per axis and node.
    along: [Vec<T>; D],
    per_density: Vec<[T; D]>,
    no_affine: Vec<A>,
    velocity: Vec<[T; 4]>,
    excess: Vec<[T; 4]>,
    slope: Vec<[[T; D]; D]>,
    push: Vec<[[T; D]; D]>,
}

impl<T: Scalar, const D: usize, A> Room<T, D, A> {
    pub(super) fn new<S: ShapeFunction<T>>(grid: &Grid<T, D>, shape: &S) -> Self {
        Self {
            along: std::array::from_fn(|axis| integrals(grid, shape, axis)),
            per_density: Vec::new(),
            no_affine: Vec::new(),
            velocity: Vec::new(),
            excess: Vec::new(),
            slope: Vec::new(),
            push: Vec::new(),
        }
    }
}

/// ∫ N dx of the nodes of an axis, m, by three Gauss points in each half of a cell.
fn integrals<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    grid: &Grid<T, D>,
    shape: &S,
    axis: usize,
) -> Vec<T> {
    let gauss = [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)];
    let n = grid.n_cells[axis];
    let mut sums = vec![T::zero(); grid.n_nodes(axis)];
    for cell in 0..n {
        for half in [0.25, 0.75] {
            for (place, weight) in gauss {
                let xi = T::lit(half + 0.25 * place);
                let at = crate::shape::AxisPosition {
                    cell,
                    xi,
                    n_cells: n,
                    periodic: grid.periodic[axis],
                };
                let row = shape.row_along(axis, at);
                for k in 0..S::WIDTH {
                    let part = T::lit(0.5 * weight) * row.weight[k] * grid.spacing[axis];
                    sums[cell + row.first + k] += part;
                }
            }
        }
    }
    if grid.periodic[axis] {
        for k in 0..grid.extra {
            let sum = sums[k] + sums[n + k];
            (sums[k], sums[n + k]) = (sum, sum);
        }
    }
    sums
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// δ-correction, \[Baumgarten2023\]: one step down the slope of the sum of squared excess volumes,
    ///
    /// ```text
    /// δx_p = −(Σ_I E_I² / Σ_q |g_q|²) g_p,   g_p = 2 V_p Σ_I E_I ∇N_I,   E_I = (Σ_p N V_p − L ∫ N_I dV)₊
    /// L = max(1, Σ_I Σ_p N V_p / Σ_I ∫ N_I dV)
    /// ```
    ///
    /// The level L is 1 in the source; what a full box holds too much as a whole finds no room by moving, and the
    /// factor would have no bound. The velocity changes by its slope, `v_p ← v_p + ∇v δx_p`. A coordinate that would leave the box
    /// stays, and so does a point that would enter a body.
    pub(super) fn shift_overfill(&mut self, kept: &mut RearrangerOf<T, D, M, K>) {
        let Some(mut room) = kept.room.take() else { return };
        if let Some(scale) = self.find_excess(&mut room) {
            self.push_out(scale, &room, kept);
        }
        kept.room = Some(room);
    }

    /// The common factor of the displacements; `None` where no node is overfull.
    fn find_excess(&mut self, room: &mut Room<T, D, AffineOf<T, D, M>>) -> Option<T> {
        let zero = T::zero();
        let mut velocity = std::mem::take(&mut room.velocity);
        self.transfer_velocity(&mut velocity);
        room.per_density.clear();
        room.per_density.extend(self.particles.density.iter().map(|&density| {
            let mut field = [zero; D];
            field[0] = T::one() / density;
            field
        }));
        self.transfer_field(&mut room.per_density, &mut room.no_affine, &mut room.excess);
        let room_of = |node: u32| {
            let at = self.grid.node_coordinates(node);
            let is_image =
                (0..D).any(|axis| self.grid.periodic[axis] && at[axis] >= self.grid.n_cells[axis]);
            let space = (0..D).fold(T::one(), |space, axis| space * room.along[axis][at[axis]]);
            (space, !is_image)
        };
        // What all nodes together hold too much finds no room by moving.
        let (mut held, mut space) = (zero, zero);
        for (slot, &node) in self.nodes.index.iter().enumerate() {
            if let (volume, true) = room_of(node) {
                held += self.nodes.transfer[slot][0];
                space += volume;
            }
        }
        let level = (held / space).max(T::one());
        let mut squares = zero;
        for (slot, &node) in self.nodes.index.iter().enumerate() {
            let (volume, is_own) = room_of(node);
            let excess = (self.nodes.transfer[slot][0] - level * volume).max(zero);
            room.excess[slot] = [excess, zero, zero, zero];
            if is_own {
                squares += excess * excess;
            }
        }
        let Self { method, grid, cells, nodes, particles, .. } = &*self;
        let space = (grid, cells, &method.shape());
        let points = (particles.position.as_slice(), particles.length.as_slice());
        let none = [[zero; D]; D];
        room.slope.resize(particles.len(), none);
        room.push.resize(particles.len(), none);
        gradients_at_points(space, (&nodes.rows, &velocity), points, &mut room.slope);
        gradients_at_points(space, (&nodes.rows, &room.excess), points, &mut room.push);
        room.velocity = velocity;
        let mut total = zero;
        for (point, push) in room.push.iter_mut().enumerate() {
            let factor = T::lit(2.0) * particles.mass[point] / particles.density[point];
            push[0] = push[0].map(|slope| slope * factor);
            total += dot(push[0], push[0]);
        }
        (squares > zero && total > zero).then(|| squares / total)
    }

    fn push_out(
        &mut self,
        scale: T,
        room: &Room<T, D, AffineOf<T, D, M>>,
        kept: &mut RearrangerOf<T, D, M, K>,
    ) {
        let mut event = Event::new(self.time, EventKind::Shift);
        for slot in 0..self.cells.len() {
            let mut any = false;
            for point in self.cells.points(slot) {
                let push = room.push[point][0];
                if dot(push, push) > T::zero() {
                    any |= self.push_point(point, push.map(|g| -scale * g), room, &mut event);
                }
            }
            event.n_cells += u64::from(any);
        }
        self.finish(event, kept);
    }

    fn push_point(
        &mut self,
        point: usize,
        displacement: [T; D],
        room: &Room<T, D, AffineOf<T, D, M>>,
        event: &mut Event<D>,
    ) -> bool {
        let old = self.particles.position[point];
        let mut position = old;
        let mut moved = [T::zero(); D];
        for axis in 0..D {
            position[axis] += displacement[axis];
            let place = self.grid.in_cells(position, axis);
            let inside = place >= T::zero() && place <= T::from_index(self.grid.n_cells[axis]);
            if inside || self.grid.periodic[axis] {
                moved[axis] = displacement[axis];
            } else {
                position[axis] = old[axis];
            }
        }
        let Some(cell) = settle(&self.grid, &self.physics.boundaries, &mut position) else {
            return false;
        };
        if self.cells.is_solid(cell as usize) {
            return false;
        }
        self.add_totals(&self.particles, point, &mut event.before);
        let p = &mut self.particles;
        (p.position[point], p.cell[point]) = (position, cell);
        for row in 0..D {
            p.velocity[point][row] += dot(room.slope[point][row], moved);
        }
        self.add_totals(&self.particles, point, &mut event.after);
        self.counters.n_points_shifted += 1;
        true
    }
}
