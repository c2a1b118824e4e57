//! Points that are too close are pushed apart.

use super::{Event, EventKind, RearrangerOf, fields_at};
use crate::Scalar;
use crate::material::Material;
use crate::math::{Field, dot};
use crate::method::Method;
use crate::parallel::{fold_blocks, for_each_block};
use crate::particles::{POINT_GRAIN, ParticlesMut};
use crate::reconstruction::{Neighborhood, Reconstruction};
use crate::settings::Shift;
use crate::solver::Solver;
use crate::step::{CELL_GRAIN, StateOf, View, settle};
use crate::telemetry::Counters;

/// Where a point goes and what it carries there; `None` where it stays.
pub(super) type Moved<T, const D: usize, S> = Option<Place<T, D, S>>;

/// A place with the fields of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<T, const D: usize, S> {
    cell: u32,
    position: [T; D],
    velocity: [T; D],
    density: T,
    state: S,
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Pushes the points of internal cells apart, all from the places where they were before:
    ///
    /// ```text
    /// δx_p = s h/2 Σ_q (1 − r/d₀) (x_p − x_q)/r,   |δx_p| ≤ s h/2
    /// r = |x_p − x_q| < d₀ = h / n_c^(1/D)
    /// ```
    ///
    /// with the strength s, the smallest cell size h and the n_c points of the cell of p. What a point
    /// carries changes by the difference of the reconstructed field between both places. A coordinate
    /// that would leave the box stays, and so does a point that would enter a body.
    pub(super) fn shift(&mut self, shift: Shift, kept: &mut RearrangerOf<T, D, M, K>) {
        let (view, internal) = (self.as_view(), &kept.survey.internal);
        let spacing = self.grid.spacing;
        let smallest = spacing.iter().fold(spacing[0], |least, &h| least.min(h));
        let push = Push { view: &view, smallest, reach: T::lit(0.5 * shift.strength) * smallest };
        let first = &self.cells.first;
        kept.moved.resize(self.particles.len(), None);
        let work = |slots: std::ops::Range<usize>, part: &mut [Moved<T, D, StateOf<T, D, K>>]| {
            let begin = first[slots.start] as usize;
            let mut counters = Counters::default();
            for slot in slots {
                for point in self.cells.points(slot) {
                    part[point - begin] =
                        if internal[slot] { push.moved(slot, point, &mut counters) } else { None };
                }
            }
            counters
        };
        let cut = |slot: usize| first[slot] as usize;
        let moved = kept.moved.as_mut_slice();
        let counters =
            fold_blocks(self.cells.len(), CELL_GRAIN, moved, &cut, &work, &Counters::sum);
        self.counters = self.counters.sum(counters);
        self.move_points(kept);
    }

    /// Takes over the new places, if there are any.
    fn move_points(&mut self, kept: &mut RearrangerOf<T, D, M, K>) {
        let mut event = Event::new(self.time, EventKind::Shift);
        let moved = &mut kept.moved;
        for slot in 0..self.cells.len() {
            let mut any = false;
            for point in self.cells.points(slot).filter(|&point| moved[point].is_some()) {
                self.add_totals(&self.particles, point, &mut event.before);
                self.counters.n_points_shifted += 1;
                any = true;
            }
            event.n_cells += u64::from(any);
        }
        if event.n_cells == 0 {
            return;
        }
        let n_points = moved.len();
        let data = (self.particles.view().0, moved.as_mut_slice());
        let work = |_, (points, moved): (ParticlesMut<'_, T, D, _, _>, &mut [Moved<T, D, _>])| {
            for (point, place) in moved.iter().enumerate() {
                if let Some(place) = place {
                    points.cell[point] = place.cell;
                    points.position[point] = place.position;
                    points.velocity[point] = place.velocity;
                    points.density[point] = place.density;
                    points.state[point] = place.state;
                }
            }
        };
        for_each_block(n_points, POINT_GRAIN, data, &work);
        for point in (0..self.particles.len()).filter(|&point| moved[point].is_some()) {
            self.add_totals(&self.particles, point, &mut event.after);
        }
        self.finish(event, kept);
    }
}

/// What one application needs; `reach` is the largest displacement, m.
struct Push<'a, 'b, T, const D: usize, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    view: &'a View<'b, T, D, M, K>,
    smallest: T,
    reach: T,
}

impl<T, const D: usize, M, K> Push<'_, '_, T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// The new place of a point of an active cell, unless it stays where it is.
    fn moved(
        &self,
        slot: usize,
        point: usize,
        counters: &mut Counters,
    ) -> Moved<T, D, StateOf<T, D, K>> {
        let view = self.view;
        let p = view.particles;
        let displacement = self.displacement(slot, point)?;
        let mut position = p.position[point];
        for axis in 0..D {
            let old = position[axis];
            position[axis] += displacement[axis];
            let place = view.grid.in_cells(position, axis);
            let inside = place >= T::zero() && place <= T::from_index(view.grid.n_cells[axis]);
            if !(inside || view.grid.periodic[axis]) {
                position[axis] = old;
            }
        }
        let cell = settle(view.grid, &view.physics.boundaries, &mut position)?;
        if view.cells.is_solid(cell as usize) {
            return None;
        }
        let reconstruction = view.method.reconstruction().unlimited(T::zero());
        let mut at = |position| {
            let target = std::array::from_fn(|axis| view.grid.in_cells(position, axis));
            fields_at(view, &reconstruction, target, counters)
        };
        let (here, there) = (at(p.position[point])?, at(position)?);
        let density = p.density[point] + there.density - here.density;
        let mut state = p.state[point];
        state.add_scaled(T::one(), there.state);
        state.add_scaled(-T::one(), here.state);
        let mut velocity = p.velocity[point];
        for axis in 0..D {
            velocity[axis] += there.velocity[axis] - here.velocity[axis];
        }
        let density = density.max(view.physics.minimum_density);
        (density > T::zero()).then_some(Place { cell, position, velocity, density, state })
    }

    /// How far the points around push a point, m; `None` if none is close.
    fn displacement(&self, slot: usize, point: usize) -> Option<[T; D]> {
        let grid = self.view.grid;
        let cell = grid.cell_coordinates(self.view.cells.index[slot]);
        let count = T::from_index(self.view.cells.points(slot).len());
        let distance = self.smallest / count.powf(T::one() / T::from_index(D));
        let position = self.view.particles.position[point];
        let target = std::array::from_fn(|axis| grid.in_cells(position, axis));
        let neighborhood = Neighborhood::of_cells_around(grid, cell);
        let mut sum = [T::zero(); D];
        self.view.cloud().visit(
            neighborhood,
            target,
            #[inline(always)]
            |_, offset| {
                let mut away = offset;
                for axis in 0..D {
                    away[axis] *= -grid.spacing[axis];
                }
                let squared = dot(away, away);
                // The point itself, or one at the same place, gives no direction.
                if squared > T::zero() && squared < distance * distance {
                    let r = squared.sqrt();
                    let push = (T::one() - r / distance) / r;
                    for axis in 0..D {
                        sum[axis] += push * away[axis];
                    }
                }
            },
        );
        let length = dot(sum, sum).sqrt();
        if !(length > T::zero()) {
            return None;
        }
        let scale = self.reach / length.max(T::one());
        Some(sum.map(|component| component * scale))
    }
}
