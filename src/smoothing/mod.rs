//! Ingredients that smooth: the nodes' velocity by the full mass matrix, the points' divergence, the cells'
//! density.

mod density_diffusion;
mod density_filter;
mod dilation;
mod projection;

use crate::Scalar;
use crate::error::InvalidInput;
use crate::formulation::Formulation;
use crate::material::Material;
use crate::method::Method;
use crate::reconstruction::Reconstruction;
use crate::settings::{Projection, ProjectionKind, Settings};
use crate::solver::Solver;
use crate::step::{AffineOf, CellSamples, ScatterParts, View, node_velocity, particles_to_grid};
use crate::transfer::Transfer;

/// What smoothing keeps from step to step; `A` is the affine field of the points.
#[derive(Clone, Debug)]
pub(crate) struct Smoother<T, const D: usize, A> {
    projection: Option<Projection>,
    dilation: Option<T>,
    density_diffusion: Option<T>,
    n_steps: u32,
    /// A field at the points that takes the place of their velocity.
    at_points: Vec<[T; D]>,
    /// And an affine field of zeros.
    no_affine: Vec<A>,
    at_nodes: Vec<[T; 4]>,
    rest: Vec<[T; 4]>,
    at_cells: Vec<T>,
    density_slope: Vec<[T; D]>,
    /// Densities of the cells and of the points before they are filtered, kg/m³.
    fitted: Vec<T>,
    density: Vec<T>,
    /// Divergence of each point, 1/s, where it was smoothed in this step.
    pub(crate) divergence: Vec<T>,
}

/// The smoother of a method.
pub(crate) type SmootherOf<T, const D: usize, M> = Smoother<T, D, AffineOf<T, D, M>>;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Sets what is smoothed from now on.
    ///
    /// # Errors
    /// When the method cannot honour a setting.
    pub fn set_smoothing(&mut self, settings: &Settings) -> Result<(), InvalidInput> {
        let Settings { projection, dilation, density_diffusion, .. } = *settings;
        let by_cell = self.method.formulation() != Formulation::Standard;
        let rebuilds = <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES;
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let by_fits = <M::Reconstruction as Reconstruction<T, D>>::BY_CELLS;
        let work = self.physics.material.wants_work();
        let parts = [
            (
                "projection",
                projection.is_some() && (affine || work),
                "absent, or a variant without affine transfer whose energy is updated by strain",
            ),
            (
                "projection",
                projection.is_some() && self.bodies.is_some(),
                "absent where the scene has bodies, whose forces are summed before it",
            ),
            (
                "projection.kind",
                projection.is_some_and(|p| p.kind == ProjectionKind::AllAndDensity) && !rebuilds,
                "`velocity` or `all`, or a method that reconstructs fields",
            ),
            (
                "dilation",
                dilation.is_some() && (by_cell || rebuilds || by_fits),
                "absent, or a variant with carried values whose divergence is that of its points",
            ),
            (
                "density_diffusion",
                density_diffusion.is_some() && !by_cell,
                "absent, or a variant with the velocity-pressure formulation",
            ),
        ];
        for (name, refused, allowed) in parts {
            if refused {
                return Err(InvalidInput::new(format!("settings.{name}"), "present", allowed));
            }
        }
        if projection.is_none() && dilation.is_none() && density_diffusion.is_none() {
            self.smoother = None;
            return Ok(());
        }
        self.smoother = Some(Box::new(Smoother {
            projection,
            dilation: dilation.map(T::lit),
            density_diffusion: density_diffusion.map(T::lit),
            n_steps: 0,
            at_points: Vec::new(),
            no_affine: Vec::new(),
            at_nodes: Vec::new(),
            rest: Vec::new(),
            at_cells: Vec::new(),
            density_slope: Vec::new(),
            fitted: Vec::new(),
            density: Vec::new(),
            divergence: Vec::new(),
        }));
        Ok(())
    }

    /// Points → nodes: any field by the method's own transfer of velocities, without affine parts. `no_affine` is
    /// room for as many zeros.
    pub(crate) fn transfer_field(
        &mut self,
        at_points: &mut Vec<[T; D]>,
        no_affine: &mut Vec<AffineOf<T, D, M>>,
        at_nodes: &mut Vec<[T; 4]>,
    ) {
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        std::mem::swap(&mut self.particles.velocity, at_points);
        if affine {
            no_affine.resize(self.particles.len(), AffineOf::<T, D, M>::default());
            std::mem::swap(&mut self.particles.affine, no_affine);
        }
        self.transfer_velocity(at_nodes);
        std::mem::swap(&mut self.particles.velocity, at_points);
        if affine {
            std::mem::swap(&mut self.particles.affine, no_affine);
        }
    }

    /// Points → nodes: velocities as they are, before constraints.
    pub(crate) fn transfer_velocity(&mut self, velocity: &mut Vec<[T; 4]>) {
        crate::step::gather_columns::<T, D, M, K>(&self.particles, &mut self.columns);
        let Self { method, physics, grid, cells, particles, columns, .. } = self;
        let view = View { method, physics, grid, cells, particles, columns };
        let samples = CellSamples { centers: &self.centers, sites: &self.sites };
        let parts = (ScatterParts::Momentum, T::zero());
        let mut counters = particles_to_grid(&view, samples, parts, &mut self.nodes);
        velocity.resize(self.nodes.len(), [T::zero(); 4]);
        let (index, transfer) = (&self.nodes.index, &self.nodes.transfer);
        counters = counters.sum(node_velocity(&view, index, transfer, velocity));
        self.counters = self.counters.sum(counters);
    }
}

/// Makes room for a vector per point.
fn resize_points<T: Scalar, const D: usize>(values: &mut Vec<[T; D]>, n: usize) {
    values.resize(n, [T::zero(); D]);
}
