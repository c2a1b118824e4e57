//! New points for numerical fractures.

use super::{Event, EventKind, RearrangerOf, fields_at};
use crate::Scalar;
use crate::cells::ABSENT;
use crate::material::Material;
use crate::method::Method;
use crate::particles::Particles;
use crate::reconstruction::Reconstruction;
use crate::settings::{Fill, FillMass, FillPoints};
use crate::solver::Solver;
use crate::telemetry::Counters;

/// Least half width of the support for fields in an empty cell, cells: it reaches the cells around.
const FILL_SUPPORT: f64 = 1.5;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Fills the fractures, with fields from the points as they are before.
    pub(super) fn fill(&mut self, fill: Fill, kept: &mut RearrangerOf<T, D, M, K>) {
        let n_fractures = kept.survey.fractures.len();
        if n_fractures == 0 {
            return;
        }
        self.counters.n_fracture_cells += n_fractures as u64;
        let mut event = Event::new(self.time, EventKind::Fill);
        for fracture in 0..n_fractures {
            let cell = kept.survey.fractures[fracture];
            let start = kept.fresh.len();
            if self.fill_cell(cell, fill, kept, &mut event) {
                event.n_cells += 1;
                event.n_added += (kept.fresh.len() - start) as u64;
                for point in start..kept.fresh.len() {
                    self.add_totals(&kept.fresh, point, &mut event.after);
                }
            } else {
                kept.take_back(start);
                self.counters.n_fills_refused += 1;
            }
        }
        self.counters.n_points_filled += event.n_added;
        self.finish(event, kept);
    }

    /// Fills one cell, unless a field or mass is wanting.
    fn fill_cell(
        &mut self,
        cell: u32,
        fill: Fill,
        kept: &mut RearrangerOf<T, D, M, K>,
        event: &mut Event<D>,
    ) -> bool {
        let per_axis = match fill.points {
            FillPoints::Center => 1,
            FillPoints::Quarters => 2,
        };
        let start = kept.fresh.len();
        if !self.rebuild_points(cell, per_axis, T::lit(FILL_SUPPORT), kept) {
            return false;
        }
        let new = start..kept.fresh.len();
        let wanted = kept.fresh.mass[new.clone()].iter().fold(T::zero(), |sum, &mass| sum + mass);
        match fill.mass {
            FillMass::Created => {}
            FillMass::Budget(share) => {
                if kept.created_mass + wanted.as_f64() > share * kept.initial_mass {
                    return false;
                }
            }
            FillMass::Donated => return self.collect(cell, new, kept, event),
        }
        kept.created_mass += wanted.as_f64();
        true
    }

    /// Takes the mass of new points from those around a cell: as much as wanted, at most half of what there
    /// is. Whether there is any.
    ///
    /// The new points get the momentum of what they are given, by the same change of all of their velocities;
    /// those that give keep theirs, however little mass they have left.
    fn collect(
        &mut self,
        cell: u32,
        new: std::ops::Range<usize>,
        kept: &mut RearrangerOf<T, D, M, K>,
        event: &mut Event<D>,
    ) -> bool {
        let fresh = &mut kept.fresh;
        // Over a narrow periodic axis the same cell lies on both sides.
        let mut slots = [ABSENT; 27];
        let at = self.grid.cell_coordinates(cell);
        for (slot, found) in slots.iter_mut().zip(self.grid.around(at)) {
            *slot = self.cells.slot_of[found];
        }
        slots.sort_unstable();
        let donors = |k: usize| {
            let is_new = slots[k] != ABSENT && (k == 0 || slots[k] != slots[k - 1]);
            is_new.then_some(slots[k] as usize)
        };
        let (mut present, mut momentum) = (T::zero(), [T::zero(); D]);
        for slot in (0..slots.len()).filter_map(donors) {
            for point in self.cells.points(slot) {
                add_momentum(&self.particles, point, (&mut present, &mut momentum));
            }
        }
        let wanted = fresh.mass[new.clone()].iter().fold(T::zero(), |sum, &mass| sum + mass);
        if !(present > T::zero()) {
            return false;
        }
        let share = (wanted / present).min(T::lit(0.5));
        let mut taken = T::zero();
        for slot in (0..slots.len()).filter_map(donors) {
            for point in self.cells.points(slot) {
                self.add_totals(&self.particles, point, &mut event.before);
                let mass = &mut self.particles.mass[point];
                let part = *mass * share;
                *mass -= part;
                taken += part;
                self.add_totals(&self.particles, point, &mut event.after);
            }
        }
        let (mut received, mut carried) = (T::zero(), [T::zero(); D]);
        for point in new.clone() {
            fresh.mass[point] *= taken / wanted;
            add_momentum(fresh, point, (&mut received, &mut carried));
        }
        for axis in 0..D {
            let change = momentum[axis] / present - carried[axis] / received;
            for point in new.clone() {
                fresh.velocity[point][axis] += change;
            }
        }
        true
    }

    /// Appends `per_axis` points per axis for a cell to the new ones, with fields by moving least
    /// squares and equal shares of the cell's volume; `false` if a field is not sound.
    pub(super) fn rebuild_points(
        &mut self,
        cell: u32,
        per_axis: usize,
        least_support: T,
        kept: &mut RearrangerOf<T, D, M, K>,
    ) -> bool {
        let n = per_axis.pow(D as u32);
        if kept.next_id.checked_add(n as u32).is_none() {
            return false;
        }
        let at = self.grid.cell_coordinates(cell);
        let volume = self.grid.cell_volume() / T::from_index(n);
        let reconstruction = self.method.reconstruction().unlimited(least_support);
        let view = self.as_view();
        let mut counters = Counters::default();
        for code in 0..n {
            let target = place(at, code, per_axis);
            let position = std::array::from_fn(|axis| {
                self.grid.origin[axis] + self.grid.spacing[axis] * target[axis]
            });
            let found = fields_at(&view, &reconstruction, target, &mut counters);
            let Some(found) = found else {
                self.counters = self.counters.sum(counters);
                return false;
            };
            let fresh = &mut kept.fresh;
            let mass = found.density * volume;
            fresh.push(kept.next_id, position, found.velocity, found.density, mass);
            kept.next_id += 1;
            let point = fresh.len() - 1;
            (fresh.cell[point], fresh.affine[point]) = (cell, found.affine);
            fresh.state[point] = found.state;
            fresh.density_slope.extend(found.density_slope);
        }
        self.counters = self.counters.sum(counters);
        true
    }
}

/// Adds mass and momentum of a point.
fn add_momentum<T: Scalar, const D: usize, A, S>(
    particles: &Particles<T, D, A, S>,
    point: usize,
    (mass, momentum): (&mut T, &mut [T; D]),
) {
    *mass += particles.mass[point];
    for axis in 0..D {
        momentum[axis] += particles.mass[point] * particles.velocity[point][axis];
    }
}

/// Place of a new point in cells: the centre of part `code` of a cell cut in `per_axis` along each axis.
fn place<T: Scalar, const D: usize>(cell: [usize; D], code: usize, per_axis: usize) -> [T; D] {
    let mut rest = code;
    let mut place = [T::zero(); D];
    for axis in (0..D).rev() {
        let part = T::from_index(2 * (rest % per_axis) + 1) / T::from_index(2 * per_axis);
        place[axis] = T::from_index(cell[axis]) + part;
        rest /= per_axis;
    }
    place
}
