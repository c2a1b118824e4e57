//! Node velocities by a series for the inverse of the full mass matrix.

use super::SmootherOf;
use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::for_each_block;
use crate::settings::ProjectionKind;
use crate::solver::Solver;
use crate::step::{NODE_GRAIN, constrain, interpolate};

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Replaces v⁺ of the nodes by a truncated series, \[Hammerquist2017\], \[Nairn2021\]:
    ///
    /// ```text
    /// FMPM(k): v ← Σ_{j<k} (1 − R N)ʲ v⁺          XPIC(k): v ← Σ_{j<k} (1 − R N)ʲ vⁿ + Δt a
    /// ```
    ///
    /// R takes velocities from the points to the nodes, as the method does, and N back. The points then take up
    /// all of it, as in PIC; for k = 1 it is PIC. Returns whether it was done: with an interval n, in every n-th step.
    pub(crate) fn project_velocity(&mut self) -> bool {
        let Some(mut kept) = self.smoother.take() else { return false };
        let due = kept.projection.is_some_and(|projection| {
            kept.n_steps = (kept.n_steps + 1) % projection.interval;
            kept.n_steps == 0
        });
        if kept.projection.is_some() {
            // In every step, so that none but the first takes memory.
            super::resize_points(&mut kept.at_points, self.particles.len());
            kept.rest.resize(self.nodes.len(), [T::zero(); 4]);
            kept.at_nodes.resize(self.nodes.len(), [T::zero(); 4]);
        }
        if let Some(projection) = kept.projection.filter(|_| due) {
            self.start_rest(projection.kind, &mut kept);
            for _ in 1..projection.order {
                self.filter_rest(&mut kept);
            }
            self.counters.n_projections += 1;
        }
        self.smoother = Some(kept);
        due
    }

    fn start_rest(&self, kind: ProjectionKind, kept: &mut SmootherOf<T, D, M>) {
        kept.rest.clone_from(&self.nodes.velocity);
        if kind == ProjectionKind::Velocity {
            for (rest, increment) in kept.rest.iter_mut().zip(&self.nodes.increment) {
                for axis in 0..D {
                    rest[axis] -= increment[axis];
                }
            }
        }
    }

    /// `rest ← rest − R N rest`, then `v ← v + rest`.
    fn filter_rest(&mut self, kept: &mut SmootherOf<T, D, M>) {
        let Self { method, grid, cells, nodes, particles, .. } = &*self;
        let shape = method.shape();
        interpolate(
            (grid, cells, &shape),
            (&nodes.rows, &kept.rest),
            (&particles.position, &particles.length),
            &mut kept.at_points,
        );
        self.transfer_field(&mut kept.at_points, &mut kept.no_affine, &mut kept.at_nodes);
        let Self { physics, nodes, .. } = self;
        let smooth = &kept.at_nodes;
        for_each_block(
            nodes.len(),
            NODE_GRAIN,
            kept.rest.as_mut_slice(),
            &|range, part: &mut [[T; 4]]| {
                for (rest, smooth) in part.iter_mut().zip(&smooth[range]) {
                    for axis in 0..D {
                        rest[axis] -= smooth[axis];
                    }
                }
            },
        );
        // Only changes are to vanish where the velocity is prescribed.
        let fixed = (nodes.walls.as_slice(), nodes.held.as_slice());
        constrain(fixed, &physics.boundaries, &mut kept.at_nodes, Some(&mut kept.rest));
        let rest = &kept.rest;
        for_each_block(
            nodes.len(),
            NODE_GRAIN,
            nodes.velocity.as_mut_slice(),
            &|range, part: &mut [[T; 4]]| {
                for (v, rest) in part.iter_mut().zip(&rest[range]) {
                    for axis in 0..D {
                        v[axis] += rest[axis];
                    }
                    v[3] = v[D - 1];
                }
            },
        );
    }
}
