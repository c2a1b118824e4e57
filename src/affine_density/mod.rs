//! Density that each point carries as a linear field.
//!
//! ```text
//! cells:   ρ_c = Σ_p B_pc (ρ_p + s_p · (x_c − x_p)) / Σ_p B_pc
//! points:  (D_p, G_p) = argmin Σ_c B_pc (D_p + G_p · (x_c − x_p) − D_c)²
//!          ρ_p ← ρ_p / (1 + Δt D_p),   s_p ← (s_p − Δt (ρ_p G_p + Lᵀ s_p)) / (1 + Δt D_p)
//! ```
//!
//! B are quadratic B-splines about the cells, D_c the divergence of a cell, L the velocity gradient at the point. What
//! \[Jiang2015\] do with velocities and nodes is done with densities and cells: no system is solved for a cell, all its
//! weights are positive, and linear fields are reproduced whatever the layout. With N = diag(Σ_p B_pc) the densities of
//! the cells change by −ρ₀ N⁻¹ S D, where S is a sum of one projection per point, S ≤ N: such a change is never
//! amplified, and its part never has the wrong sign. In cells near the surface, where linear fields of points would
//! be extrapolated, the fits of the method stay, and slopes are those of the densities of the full cells around.

mod cell_density;
mod linear_fit;

pub(crate) use cell_density::density_of_cell;
pub(crate) use linear_fit::slope_among;

use std::ops::Range;

use crate::Scalar;
use crate::cells::CellKind;
use crate::error::InvalidInput;
use crate::formulation::{Formulation, PointDivergence};
use crate::material::Material;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::quadrature::Quadrature;
use crate::scene::Scene;
use crate::settings::StressUpdate;
use crate::solver::Solver;
use crate::step::{CELL_GRAIN, gradients_at_points};
use linear_fit::{Around, LEAST_AT_EDGES, LEAST_OF_CELLS};

/// Reach of quadratic B-splines, cells.
pub(crate) const REACH: f64 = 1.5;

/// What affine densities keep from phase to phase.
#[derive(Clone, Debug, Default)]
pub(crate) struct AffineDensity<T, const D: usize> {
    /// Divergence at each point, 1/s.
    pub(crate) divergence: Vec<T>,
    /// Velocity gradient at each point, 1/s.
    strain: Vec<[[T; D]; D]>,
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Gives the points of a scene density slopes, those of least squares over the points around where it has none, or
    /// takes them away.
    ///
    /// # Errors
    /// Where fields are not fitted, or the divergence of points is not that of quadratic B-splines about the cells.
    pub fn set_affine_density(
        &mut self,
        wanted: bool,
        scene: &Scene<D>,
    ) -> Result<(), InvalidInput> {
        self.particles.density_slope.clear();
        self.affine_density = None;
        if !wanted {
            return Ok(());
        }
        let by_cell = <M::Quadrature as Quadrature<T, D>>::CLASSIFIES;
        let formulation = Formulation::VelocityPressure(PointDivergence::Quadratic);
        if self.method.formulation() != formulation || !by_cell {
            let allowed = "false, or transport points whose divergence is that of quadratic B-splines about the cells";
            return Err(InvalidInput::new("settings.affine_density", "true", allowed));
        }
        let view = self.as_view();
        let cloud = view.cloud();
        let slope = |point: usize| {
            let spec = scene.points.get(self.particles.id[point] as usize);
            if let Some(slope) = spec.and_then(|spec| spec.density_slope) {
                return slope.map(T::lit);
            }
            let position = cloud.position[point];
            slope_among(&cloud, std::array::from_fn(|axis| cloud.grid.in_cells(position, axis)))
        };
        let slopes = (0..self.particles.len()).map(slope).collect();
        self.particles.density_slope = slopes;
        self.affine_density = Some(Box::default());
        Ok(())
    }

    /// Cells → points away from the surface: the linear field of least squares at each of them, kg/m³ and kg/m⁴.
    pub(crate) fn spread_affine_density(&mut self, at_cells: &[T]) {
        let Self { grid, cells, particles, .. } = self;
        let position = &particles.position;
        let cut = |slot: usize| cells.first[slot] as usize;
        let work = |slots: Range<usize>, (value, slope): (&mut [T], &mut [[T; D]])| {
            let begin = cut(slots.start);
            for slot in slots.filter(|&slot| !cells.near_surface[slot]) {
                let around = Around::new(grid, cells, slot, |slot| Some(at_cells[slot]));
                for point in cells.points(slot) {
                    let xi = around.xi(grid, position[point]);
                    let fitted = around.fit(xi, grid, LEAST_OF_CELLS);
                    (value[point - begin], slope[point - begin]) = fitted;
                }
            }
        };
        let data = (particles.density.as_mut_slice(), particles.density_slope.as_mut_slice());
        fold_blocks(cells.len(), CELL_GRAIN, data, &cut, &work, &|(), ()| ());
    }

    /// Finds the divergence of the points and strains their slopes over `dt` seconds with it.
    pub(crate) fn strain_slopes(&mut self, dt: T) {
        let Some(mut kept) = self.affine_density.take() else { return };
        if self.method.stress_update() == StressUpdate::First {
            // The cells of this step are not known yet.
            self.rebuild_cells();
        }
        kept.divergence.resize(self.particles.len(), T::zero());
        kept.strain.resize(self.particles.len(), [[T::zero(); D]; D]);
        let mut slopes = std::mem::take(&mut self.particles.density_slope);
        let AffineDensity { divergence: at_points, strain } = &mut *kept;
        let Self { method, grid, cells, particles, nodes, divergence, centers, .. } = &*self;
        let velocity = if self.strain_is_rebuilt { &nodes.rebuilt } else { &nodes.velocity };
        let points = (particles.position.as_slice(), particles.length.as_slice());
        gradients_at_points(
            (grid, cells, &method.shape()),
            (&nodes.rows, velocity),
            points,
            strain,
        );
        let cut = |slot: usize| cells.first[slot] as usize;
        let full = |slot: usize| cells.kind[slot] == CellKind::Internal;
        let density_of = |slot: usize| full(slot).then(|| centers[slot].density);
        let work = |slots: Range<usize>, (value, slopes): (&mut [T], &mut [[T; D]])| {
            let begin = cut(slots.start);
            for slot in slots {
                let around = Around::new(grid, cells, slot, |slot| Some(divergence[slot]));
                let near_surface = cells.near_surface[slot];
                let densities = near_surface.then(|| Around::new(grid, cells, slot, density_of));
                for point in cells.points(slot) {
                    let xi = around.xi(grid, particles.position[point]);
                    let slope = &mut slopes[point - begin];
                    if let Some(densities) = &densities {
                        value[point - begin] = around.mean(xi);
                        *slope = densities.fit(xi, grid, LEAST_AT_EDGES).1;
                    } else {
                        let (divergence, gradient) = around.fit(xi, grid, LEAST_OF_CELLS);
                        value[point - begin] = divergence;
                        let rates = (divergence, gradient, &strain[point]);
                        *slope = strained(*slope, particles.density[point], rates, dt);
                    }
                }
            }
        };
        let data = (at_points.as_mut_slice(), slopes.as_mut_slice());
        fold_blocks(cells.len(), CELL_GRAIN, data, &cut, &work, &|(), ()| ());
        self.particles.density_slope = slopes;
        self.affine_density = Some(kept);
    }
}

/// A slope after `dt` seconds of divergence, its gradient and the velocity gradient `[i][j] = ∂v_i/∂x_j`; the density is
/// that before.
#[inline(always)]
fn strained<T: Scalar, const D: usize>(
    slope: [T; D],
    density: T,
    (divergence, gradient, strain): (T, [T; D], &[[T; D]; D]),
    dt: T,
) -> [T; D] {
    let growth = T::one() / (T::one() + dt * divergence);
    std::array::from_fn(|axis| {
        let mut rate = density * growth * gradient[axis];
        for row in 0..D {
            rate += strain[row][axis] * slope[row];
        }
        (slope[axis] - dt * rate) * growth
    })
}
