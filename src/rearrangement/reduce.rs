//! Fewer points for crowded cells.

use super::{Event, EventKind, RearrangerOf};
use crate::Scalar;
use crate::cells::{ABSENT, CellKind};
use crate::material::Material;
use crate::method::Method;
use crate::solver::Solver;

/// New points per axis of a reduced cell.
const PER_AXIS: usize = 2;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Replaces the points of internal cells with more than `most_points`, with fields from the points
    /// as they are before. Mass and momentum of each cell stay.
    pub(super) fn reduce(&mut self, most_points: u32, kept: &mut RearrangerOf<T, D, M, K>) {
        let mut event = Event::new(self.time, EventKind::Reduce);
        for slot in 0..self.cells.len() {
            let is_crowded = self.cells.points(slot).len() > most_points as usize;
            if is_crowded && self.cells.kind[slot] == CellKind::Internal {
                self.reduce_cell(slot, kept, &mut event);
            }
        }
        self.counters.n_cells_reduced += event.n_cells;
        self.finish(event, kept);
    }

    fn reduce_cell(
        &mut self,
        slot: usize,
        kept: &mut RearrangerOf<T, D, M, K>,
        event: &mut Event<D>,
    ) {
        let start = kept.fresh.len();
        if !self.rebuild_points(self.cells.index[slot], PER_AXIS, T::zero(), kept) {
            kept.take_back(start);
            return;
        }
        let old = self.cells.points(slot);
        let (mut mass, mut momentum) = (T::zero(), [T::zero(); D]);
        for point in old.clone() {
            self.add_totals(&self.particles, point, &mut event.before);
            mass += self.particles.mass[point];
            for axis in 0..D {
                momentum[axis] += self.particles.mass[point] * self.particles.velocity[point][axis];
            }
            self.particles.cell[point] = ABSENT;
        }
        let new = start..kept.fresh.len();
        let count = T::from_index(new.len());
        for axis in 0..D {
            let sum = new.clone().fold(T::zero(), |sum, k| sum + kept.fresh.velocity[k][axis]);
            let change = momentum[axis] / mass - sum / count;
            for point in new.clone() {
                kept.fresh.velocity[point][axis] += change;
            }
        }
        event.n_cells += 1;
        event.n_added += new.len() as u64;
        event.n_removed += old.len() as u64;
        for point in new {
            kept.fresh.mass[point] = mass / count;
            self.add_totals(&kept.fresh, point, &mut event.after);
        }
    }
}
