//! Densities of points that their cells do not see.

use super::SmootherOf;
use crate::Scalar;
use crate::cells::Cells;
use crate::formulation::{PointDivergence, weighted};
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::reconstruction::Reconstruction;
use crate::settings::ProjectionKind;
use crate::solver::Solver;
use crate::step::CELL_GRAIN;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Replaces the density of the points away from the surface by a truncated series, where that is due:
    ///
    /// ```text
    /// ρ ← Q Σ_{j<k} (1 − F Q)ʲ F ρ,   s₀ = F ρ,   s_{j+1} = s_j + F ρ − F Q s_j
    /// ```
    ///
    /// F fits densities at the centers of cells, as the step does; Q takes them to the points with quadratic
    /// B-splines about the cells, continued linearly beyond walls. With affine densities F is their mean and Q the linear
    /// field of least squares, which sets slopes too; cells near the surface, whose F is a fit, then keep their F ρ. Forces follow from F ρ alone, which does not see how
    /// the densities of points differ within a cell: what each collects along its path is neither opposed nor forgotten.
    pub(crate) fn filter_density(&mut self) {
        // A constant condition: not compiled for methods that carry their fields.
        if <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES {
            let Some(mut kept) = self.smoother.take() else { return };
            if let Some(projection) = kept.projection
                && projection.kind == ProjectionKind::AllAndDensity
            {
                // In every step, so that none but the first takes memory.
                kept.at_cells.resize(self.cells.len(), T::zero());
                kept.fitted.resize(self.cells.len(), T::zero());
                kept.density.clone_from(&self.particles.density);
                kept.density_slope.clone_from(&self.particles.density_slope);
                if (kept.n_steps + 1) % projection.interval == 0 {
                    self.series_of_density(projection.order, &mut kept);
                }
            }
            self.smoother = Some(kept);
        }
    }

    fn series_of_density(&mut self, order: u32, kept: &mut SmootherOf<T, D, M>) {
        self.rebuild_cells();
        for (slot, center) in self.centers.iter().enumerate() {
            (kept.fitted[slot], kept.at_cells[slot]) = (center.density, center.density);
        }
        let affine = self.affine_density.is_some();
        for _ in 1..order {
            self.spread_density(&kept.at_cells);
            self.rebuild_cells();
            for (slot, center) in self.centers.iter().enumerate() {
                if !affine || !self.cells.near_surface[slot] {
                    kept.at_cells[slot] += kept.fitted[slot] - center.density;
                }
            }
            self.particles.density.clone_from(&kept.density);
            self.particles.density_slope.clone_from(&kept.density_slope);
        }
        self.spread_density(&kept.at_cells);
    }

    /// Cells → points, where all cells around are full.
    fn spread_density(&mut self, at_cells: &[T]) {
        if self.affine_density.is_some() {
            return self.spread_affine_density(at_cells);
        }
        let Self { grid, cells, particles, .. } = self;
        let first = &cells.first;
        let position = &particles.position;
        let work = |slots: std::ops::Range<usize>, part: &mut [T]| {
            let begin = first[slots.start] as usize;
            for slot in slots.filter(|&slot| !cells.near_surface[slot]) {
                let cell = grid.cell_coordinates(cells.index[slot]);
                let around = around(grid, cells, cell, (slot, at_cells));
                for point in cells.points(slot) {
                    part[point - begin] = interpolated(grid, cell, &around, position[point]);
                }
            }
        };
        let cut = |slot: usize| first[slot] as usize;
        let density = particles.density.as_mut_slice();
        fold_blocks(cells.len(), CELL_GRAIN, density, &cut, &work, &|(), ()| ());
    }
}

/// Values of the 3^D cells around one, its own beyond walls, where they have no weight.
fn around<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cells: &Cells,
    cell: [usize; D],
    (slot, values): (usize, &[T]),
) -> [T; 27] {
    let mut around = [values[slot]; 27];
    for (code, value) in around.iter_mut().enumerate().take(3_usize.pow(D as u32)) {
        let mut rest = code;
        let shift = std::array::from_fn(|_| {
            let step = (rest % 3) as i32 - 1;
            rest /= 3;
            step
        });
        let slot = grid.neighbor(cell, shift).map(|found| cells.slot_of[found] as usize);
        *value = slot.and_then(|slot| values.get(slot).copied()).unwrap_or(*value);
    }
    around
}

/// Quadratic B-splines about the cells at a place, m; a cell beyond a wall is the linear continuation of the two before.
fn interpolated<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    around: &[T; 27],
    position: [T; D],
) -> T {
    let mut weights = [[T::zero(); 3]; D];
    for axis in 0..D {
        let xi = grid.in_cells(position, axis) - T::from_index(cell[axis]);
        let [mut below, mut here, mut above] = PointDivergence::Quadratic.weights(xi);
        let (first, last) = (cell[axis] == 0, cell[axis] + 1 == grid.n_cells[axis]);
        if !grid.periodic[axis] {
            match (first, last) {
                (true, true) => (below, here, above) = (T::zero(), T::one(), T::zero()),
                (true, false) => {
                    (here, above) = (here + below + below, above - below);
                    below = T::zero();
                }
                (false, true) => {
                    (here, below) = (here + above + above, below - above);
                    above = T::zero();
                }
                (false, false) => {}
            }
        }
        weights[axis] = [below, here, above];
    }
    weighted(weights, around)
}
