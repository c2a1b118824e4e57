//! The phases of a time step: points → grid → points.

mod cell_divergence;
mod centers;
mod columns;
mod gather;
mod grid_to_particles;
mod interpolate;
mod limit_pressure;
mod nodal_acceleration;
mod node_velocity;
mod particles_to_grid;
mod settle;
mod spread;
mod stencil_nodes;
mod stretch;
mod update_grid;

pub use centers::{CellSamples, Center, divergence, rebuild_centers};
pub use columns::{affine_density_read, centers_read, gather_columns, nodes_read};
pub use grid_to_particles::{GridState, Pass, StateSource, grid_to_particles};
pub use interpolate::{divergence_at_points, gradients_at_points, interpolate};
pub use limit_pressure::{CellMean, limit_pressure};
pub use nodal_acceleration::{Central, FieldAt, LocalAcceleration, add_acceleration};
pub use node_velocity::{node_velocity, transfer_velocity};
pub use particles_to_grid::{ScatterParts, fuses_impulse, particles_to_grid};
pub(crate) use settle::settle;
pub use settle::{Failure, Outcome};
pub use stretch::stretch;
pub use update_grid::{NodeForces, constrain, increment_energy, update_grid};

use crate::Scalar;
use crate::cells::Cells;
use crate::equation_of_state::{EquationOfState, WeaklyCompressible};
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::particles::Particles;
use crate::reconstruction::{Cloud, Columns};
use crate::scene::Boundary;
use crate::transfer::Transfer;

/// Cells per task in loops over cells and their points.
pub const CELL_GRAIN: usize = 256;

/// Nodes per task.
pub const NODE_GRAIN: usize = 1024;

/// Cells or nodes per task where a field is fitted to each.
pub const FIT_GRAIN: usize = 256;

/// The affine field that a method's points carry.
pub type AffineOf<T, const D: usize, M> = <<M as Method<T, D>>::Transfer as Transfer<T, D>>::Affine;

/// What points carry besides density.
pub type StateOf<T, const D: usize, K> = <K as Material<T, D>>::State;

/// The points of a method.
pub type ParticlesOf<T, const D: usize, M, K> =
    Particles<T, D, AffineOf<T, D, M>, StateOf<T, D, K>>;

/// What the scene prescribes.
#[derive(Clone, Copy, Debug)]
pub struct Physics<T, const D: usize, K> {
    /// Pressure law.
    pub equation_of_state: EquationOfState<T>,
    /// The same where it is linear, for materials that go with no other.
    pub linear: WeaklyCompressible<T>,
    /// What the material is made of besides its pressure law.
    pub material: K,
    /// Density to which a point of less is raised, kg/m³; zero: none.
    pub minimum_density: T,
    /// Edge of a point's box, cells, see [`boxed_volume`](crate::quadrature::boxed_volume).
    pub box_edge: T,
    /// Acceleration, m/s².
    pub body_force: [T; D],
    /// Acceleration towards a point, besides that.
    pub central_force: Option<Central<T, D>>,
    /// Lower and upper face of each axis.
    pub boundaries: [[Boundary; 2]; D],
}

impl<T: Scalar, const D: usize, K: Material<T, D>> Physics<T, D, K> {
    /// Pressure of the law and of the bulk viscosity, Pa.
    #[inline(always)]
    pub fn pressure(&self, density: T, state: &StateOf<T, D, K>) -> T {
        if K::ANY_LAW {
            let pressure = self.equation_of_state.pressure(density, K::energy(state));
            pressure + K::viscous_pressure(state)
        } else {
            self.linear.pressure(density)
        }
    }
}

/// The inputs of a phase: everything that it reads.
#[derive(Debug)]
pub struct View<'a, T, const D: usize, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// The recipe.
    pub method: &'a M,
    /// What the scene prescribes.
    pub physics: &'a Physics<T, D, K>,
    /// The grid.
    pub grid: &'a Grid<T, D>,
    /// Active cells.
    pub cells: &'a Cells,
    /// Sorted points.
    pub particles: &'a ParticlesOf<T, D, M, K>,
    /// What fits read of them, see [`gather_columns`].
    pub columns: &'a Columns<T>,
}

impl<T, const D: usize, M, K> View<'_, T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// The points as a searchable cloud.
    #[inline(always)]
    pub fn cloud(&self) -> Cloud<'_, T, D> {
        Cloud {
            grid: self.grid,
            cells: self.cells,
            position: &self.particles.position,
            mass: &self.particles.mass,
            density: &self.particles.density,
        }
    }
}
