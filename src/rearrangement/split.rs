//! Points that stand for too much fluid are split.

use super::{Event, EventKind, RearrangerOf};
use crate::Scalar;
use crate::cells::{ABSENT, CellKind};
use crate::material::Material;
use crate::method::Method;
use crate::settings::Split;
use crate::solver::Solver;
use crate::step::settle;

/// Half distances of the parts of a point along each axis, m; zero: not split along it.
type Parts<T, const D: usize> = [T; D];

/// Largest length over α with which a lone point is split: among others it may have been stretched without end.
const MOST: f64 = 1.25;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Splits every point that is too large, once, after \[Ma2009\].
    ///
    /// Parts have equal masses and lie about the point at a quarter of its length, less near a wall
    /// (half the distance to it). Everything else is copied, so that mass, momentum, angular momentum
    /// and energy stay.
    pub(super) fn split(&mut self, split: Split, kept: &mut RearrangerOf<T, D, M, K>) {
        let mut event = Event::new(self.time, EventKind::Split);
        for slot in 0..self.cells.len() {
            let start = kept.fresh.len();
            if let Split::Lone(ratio) = split {
                let points = self.cells.points(slot);
                if points.len() > 1 || self.cells.kind[slot] == CellKind::Internal {
                    continue;
                }
                self.limit_length(points.start, T::lit(ratio * MOST));
            }
            for point in self.cells.points(slot) {
                if let Some(parts) = self.parts(split, point) {
                    self.split_point(point, &parts, kept, &mut event);
                }
            }
            event.n_cells += u64::from(kept.fresh.len() > start);
        }
        self.finish(event, kept);
    }

    /// Limits the lengths of a point to `most` cells.
    fn limit_length(&mut self, point: usize, most: T) {
        let length = &mut self.particles.length[point];
        for axis in 0..D {
            let within = length[axis].min(most * self.grid.spacing[axis]);
            self.counters.n_lengths_limited += u64::from(within != length[axis]);
            length[axis] = within;
        }
    }

    /// How a point is split, if it is too large.
    fn parts(&self, split: Split, point: usize) -> Option<Parts<T, D>> {
        let p = &self.particles;
        let mut parts = [T::zero(); D];
        match split {
            Split::Volume(ratio) => {
                let most = T::lit(ratio.powi(D as i32)) * self.grid.cell_volume();
                if !(p.mass[point] / p.density[point] > most) {
                    return None;
                }
                let length = self.length_by_volume(point);
                for axis in 0..D {
                    parts[axis] = self.half_distance(point, axis, length[axis]);
                }
            }
            Split::Stretch(ratio) | Split::Lone(ratio) => {
                let length = p.length[point];
                let cells = |axis: usize| length[axis] * self.grid.inverse_spacing[axis];
                let axis = (1..D).fold(
                    0,
                    |most, axis| {
                        if cells(axis) > cells(most) { axis } else { most }
                    },
                );
                if !(cells(axis) > T::lit(ratio)) {
                    return None;
                }
                parts[axis] = self.half_distance(point, axis, length[axis]);
            }
        }
        parts.iter().any(|&part| part > T::zero()).then_some(parts)
    }

    /// A quarter of a length, or half the distance to the nearest wall if that is less.
    fn half_distance(&self, point: usize, axis: usize, length: T) -> T {
        let quarter = T::lit(0.25) * length;
        if self.grid.periodic[axis] {
            return quarter;
        }
        let lower = self.particles.position[point][axis] - self.grid.origin[axis];
        let size = self.grid.spacing[axis] * T::from_index(self.grid.n_cells[axis]);
        let room = lower.min(size - lower) * T::lit(0.5);
        quarter.min(room).max(T::zero())
    }

    fn split_point(
        &mut self,
        point: usize,
        parts: &Parts<T, D>,
        kept: &mut RearrangerOf<T, D, M, K>,
        event: &mut Event<D>,
    ) {
        let n_axes = parts.iter().filter(|&&part| part > T::zero()).count();
        let n_new = (1_u32 << n_axes) - 1;
        let Some(next_id) = kept.next_id.checked_add(n_new) else { return };
        let center = self.particles.position[point];
        let mut places = [(center, ABSENT); 8];
        for (code, (position, cell)) in places[..=n_new as usize].iter_mut().enumerate() {
            let mut rest = code;
            for axis in (0..D).filter(|&axis| parts[axis] > T::zero()) {
                position[axis] += if rest % 2 == 0 { -parts[axis] } else { parts[axis] };
                rest /= 2;
            }
            match settle(&self.grid, &self.physics.boundaries, position) {
                Some(found) if found != ABSENT => *cell = found,
                _ => return,
            }
        }
        self.add_totals(&self.particles, point, &mut event.before);
        let p = &mut self.particles;
        p.mass[point] /= T::from_index(n_new as usize + 1);
        if let Some(length) = p.length.get_mut(point) {
            for axis in (0..D).filter(|&axis| parts[axis] > T::zero()) {
                length[axis] *= T::lit(0.5);
            }
        }
        (p.position[point], p.cell[point]) = places[0];
        let start = kept.fresh.len();
        for (k, &(position, cell)) in places[1..=n_new as usize].iter().enumerate() {
            let id = kept.next_id + k as u32;
            kept.fresh.push(id, position, p.velocity[point], p.density[point], p.mass[point]);
            let new = start + k;
            (kept.fresh.cell[new], kept.fresh.affine[new]) = (cell, p.affine[point]);
            kept.fresh.state[new] = p.state[point];
            kept.fresh.length.extend(p.length.get(point));
            kept.fresh.density_slope.extend(p.density_slope.get(point));
        }
        kept.next_id = next_id;
        self.add_totals(&self.particles, point, &mut event.after);
        for new in start..kept.fresh.len() {
            self.add_totals(&kept.fresh, new, &mut event.after);
        }
        event.n_added += u64::from(n_new);
        self.counters.n_points_split += 1;
    }
}
