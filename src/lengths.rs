//! Lengths that points carry: for shape functions that depend on them, and for splitting by stretch.

use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::particles::POINT_GRAIN;
use crate::shape::ShapeFunction;
use crate::solver::Solver;
use crate::step::stretch;

/// Least length, cells, where the shape functions depend on it; the most is one cell.
const LEAST: f64 = 1.0 / 16.0;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Gives lengths to all points, or to none but for shape functions that need them.
    pub(crate) fn set_lengths(&mut self, wanted: bool) {
        self.particles.length.clear();
        if wanted || self.method.shape().stretches() {
            self.complete_lengths();
        }
    }

    /// Gives lengths to new points at the end of the list: those of a piece of a cell with volume m/ρ.
    fn complete_lengths(&mut self) {
        for point in self.particles.length.len()..self.particles.len() {
            let length = self.length_by_volume(point);
            self.particles.length.push(length);
        }
    }

    /// The same, where the points carry lengths.
    pub(crate) fn append_lengths(&mut self) {
        if !self.particles.length.is_empty() {
            self.complete_lengths();
        }
    }

    /// Finds how the flow stretches the lengths of the points, where they carry any; they take it up with
    /// [`Self::take_lengths`], once the step no longer needs those from its start.
    pub(crate) fn stretch_lengths(&mut self, dt: T) {
        let Self { method, grid, cells, particles, nodes, stretched, .. } = self;
        stretched.clone_from(&particles.length);
        if !stretched.is_empty() {
            let space = (&*grid, &*cells, &method.shape());
            let nodes = (nodes.rows.as_slice(), nodes.velocity.as_slice(), dt);
            stretch(space, nodes, (&particles.position, &particles.length), stretched);
        }
    }

    /// Replaces the lengths by those found before.
    pub(crate) fn take_lengths(&mut self) {
        std::mem::swap(&mut self.particles.length, &mut self.stretched);
        if self.method.shape().stretches() {
            self.counters.n_lengths_limited += self.limit_lengths();
        }
    }

    /// Keeps the lengths within what the shape functions allow; returns how many that changes.
    fn limit_lengths(&mut self) -> u64 {
        let spacing = self.grid.spacing;
        let work = |_: std::ops::Range<usize>, part: &mut [[T; D]]| {
            let mut n_limited = 0;
            for length in part {
                for axis in 0..D {
                    let within = length[axis].max(T::lit(LEAST) * spacing[axis]).min(spacing[axis]);
                    n_limited += u64::from(within != length[axis]);
                    length[axis] = within;
                }
            }
            n_limited
        };
        let length = self.particles.length.as_mut_slice();
        fold_blocks(length.len(), POINT_GRAIN, length, &|point| point, &work, &|a, b| a + b)
    }

    pub(crate) fn length_by_volume(&self, point: usize) -> [T; D] {
        let p = &self.particles;
        let share = p.mass[point] / p.density[point] / self.grid.cell_volume();
        let ratio = share.powf(T::one() / T::from_index(D));
        self.grid.spacing.map(|h| ratio * h)
    }
}
