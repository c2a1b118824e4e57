//! The two columns of the paper: the first is put back in every step, the second topped up.

use super::InflowOf;
use crate::Scalar;
use crate::cells::ABSENT;
use crate::material::Material;
use crate::math::dot;
use crate::method::Method;
use crate::rearrangement::{Totals, fields_at};
use crate::reconstruction::Reconstruction;
use crate::solver::Solver;
use crate::telemetry::Counters;

/// Least half width of the support for fields of new points, cells: it reaches the first column.
const SUPPORT: f64 = 1.0;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Puts the first column of an inlet back and tops up the second.
    pub(super) fn feed_columns(&mut self, inflow: &mut InflowOf<T, D, M, K>, number: usize, dt: T) {
        let full = inflow.inlets[number].points_per_cell();
        for place in 0..inflow.inlets[number].cells.len() {
            self.put_back(inflow, (number, place), full);
            let inlet = &mut inflow.inlets[number];
            let rate = inlet.rates[place];
            inlet.debts[place] += dt * rate;
            let present = self.points_in(inlet.next_cells[place]).len();
            if present < full && inlet.debts[place] > T::zero() {
                self.top_up(inflow, (number, place), full - present);
            }
        }
    }

    /// Puts the points of a cell of the first column on its lattice with the prescribed values, takes out
    /// those beyond, and puts in what is missing.
    fn put_back(
        &mut self,
        inflow: &mut InflowOf<T, D, M, K>,
        (number, place): (usize, usize),
        full: usize,
    ) {
        let inlet = &inflow.inlets[number];
        let cell = inlet.cells[place];
        let points = self.points_in(cell);
        let mut gone = Totals::zero();
        for (code, point) in points.clone().enumerate() {
            if code >= full {
                self.add_totals(&self.particles, point, &mut gone);
                self.particles.cell[point] = ABSENT;
                self.counters.n_points_returned += 1;
                continue;
            }
            let position = inlet.place_in_cell(&self.grid, cell, code);
            self.particles.position[point] = position;
            self.prescribe_point(inlet, point);
            let mass = self.particles.density[point] * inlet.point_volume();
            gone.conserved.mass += (self.particles.mass[point] - mass).as_f64();
            self.particles.mass[point] = mass;
        }
        self.ledger.leave(&gone);
        for code in points.len()..full {
            let position = inlet.place_in_cell(&self.grid, cell, code);
            self.push_prescribed(inlet, position, &mut inflow.fresh);
        }
    }

    /// Adds points to a cell of the second column at the places of its lattice that are farthest from its
    /// points; the mass that has flowed in is shared among them.
    fn top_up(
        &mut self,
        inflow: &mut InflowOf<T, D, M, K>,
        (number, place): (usize, usize),
        wanted: usize,
    ) {
        let inlet = &inflow.inlets[number];
        let cell = inlet.next_cells[place];
        let points = self.points_in(cell);
        let places = &mut inflow.places;
        places.clear();
        places.extend((0..inlet.points_per_cell()).map(|code| {
            let position = inlet.place_in_cell(&self.grid, cell, code);
            let mut nearest = T::max_value().unwrap_or(T::one());
            for point in points.clone() {
                let other = self.particles.position[point];
                let offset = std::array::from_fn::<T, D, _>(|axis| position[axis] - other[axis]);
                nearest = nearest.min(dot(offset, offset));
            }
            (nearest, code)
        }));
        farthest_first(places);
        let mass = inlet.debts[place] / T::from_index(wanted);
        for &(_, code) in &places[..wanted] {
            let position = inlet.place_in_cell(&self.grid, cell, code);
            let target = std::array::from_fn(|axis| self.grid.in_cells(position, axis));
            let reconstruction = self.method.reconstruction().unlimited(T::lit(SUPPORT));
            let mut counters = Counters::default();
            let found = fields_at(&self.as_view(), &reconstruction, target, &mut counters);
            self.counters = self.counters.sum(counters);
            self.push_prescribed(inlet, position, &mut inflow.fresh);
            let point = inflow.fresh.len() - 1;
            let fresh = &mut inflow.fresh;
            if let Some(found) = found {
                fresh.velocity[point] = found.velocity;
                fresh.density[point] = found.density;
                fresh.affine[point] = found.affine;
                fresh.state[point] = found.state;
                if let (Some(slope), Some(found)) =
                    (fresh.density_slope.last_mut(), found.density_slope)
                {
                    *slope = found;
                }
            }
            fresh.mass[point] = mass;
        }
        inflow.inlets[number].debts[place] = T::zero();
    }
}

/// Far places first; among equals the first of the lattice.
fn farthest_first<T: Scalar>(places: &mut [(T, usize)]) {
    places.sort_unstable_by(|a, b| b.0.as_f64().total_cmp(&a.0.as_f64()).then(a.1.cmp(&b.1)));
}
