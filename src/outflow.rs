//! Points that leave through open faces, and the relaxation that lets sound out there.

use crate::Scalar;
use crate::cells::ABSENT;
use crate::material::Material;
use crate::method::Method;
use crate::rearrangement::Totals;
use crate::scene::{Boundary, Relaxation};
use crate::solver::Solver;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Writes down what the points held that left in this step.
    pub(crate) fn let_out(&mut self) {
        let mut gone = Totals::zero();
        for point in (0..self.particles.len()).filter(|&point| !self.is_present(point)) {
            self.add_totals(&self.particles, point, &mut gone);
        }
        self.ledger.leave(&gone);
    }

    /// Relaxes the points next to outflows, where the scene asks for it; cells are those at the start of
    /// the step.
    pub(crate) fn relax_outflows(&mut self, dt: T) {
        for axis in 0..D {
            for side in 0..2 {
                if let Boundary::Outflow { relaxation: Some(relaxation) } =
                    self.physics.boundaries[axis][side]
                {
                    self.relax_outflow(axis, side, &relaxation, dt);
                }
            }
        }
    }

    fn relax_outflow(&mut self, axis: usize, side: usize, relaxation: &Relaxation, dt: T) {
        let Self { grid, cells, particles, physics, counters, .. } = self;
        let n = grid.n_cells[axis];
        let outward = if side == 0 { -T::one() } else { T::one() };
        let share = (dt / T::lit(relaxation.time)).min(T::one());
        let target = T::lit(relaxation.pressure);
        for slot in 0..cells.len() {
            let layer = grid.cell_coordinates(cells.index[slot])[axis];
            let depth = if side == 0 { layer } else { n - 1 - layer };
            if depth >= relaxation.layers {
                continue;
            }
            for point in cells.points(slot).filter(|&point| particles.cell[point] != ABSENT) {
                let density = particles.density[point];
                let law = &physics.equation_of_state;
                let impedance = density * law.sound_speed(density, T::zero());
                let velocity = particles.velocity[point][axis] * outward;
                let beyond = relaxation.velocity.map_or(velocity, T::lit);
                let excess = law.pressure(density, T::zero()) - target;
                // Half of the invariant's change goes to the velocity, half to the pressure.
                let change = share * T::lit(0.5) * ((beyond - velocity) + excess / impedance);
                particles.velocity[point][axis] += outward * change;
                let pressure = target + excess - impedance * change;
                particles.density[point] = law.density(pressure, T::zero());
                counters.n_points_relaxed += 1;
            }
        }
    }
}
