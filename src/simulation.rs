//! A running simulation, seen without its type parameters.

use crate::Scalar;
use crate::cells::ABSENT;
use crate::error::{InvalidInput, StepError};
use crate::material::Material;
use crate::method::Method;
use crate::rearrangement::Ledger;
use crate::settings::Rearrangement;
use crate::solver::Solver;
use crate::step::{AffineOf, ParticlesOf};
use crate::telemetry::Counters;
use crate::transfer::Transfer;

/// State of one point as reported to the outside, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointState<const D: usize> {
    /// Identifier; points of the scene are numbered from zero in scene order.
    pub id: u32,
    /// Position, m.
    pub position: [f64; D],
    /// Velocity, m/s.
    pub velocity: [f64; D],
    /// Density, kg/m³.
    pub density: f64,
    /// Pressure of the law, without viscous pressure, Pa.
    pub pressure: f64,
    /// (Nominal) mass, kg.
    pub mass: f64,
    /// Specific internal energy, J/kg; zero where the scene has none.
    pub energy: f64,
    /// Deviatoric stress, tension positive, Pa.
    pub stress: [[f64; D]; D],
    /// Affine velocity field `[i][j]`: change of v_i per metre along x_j, 1/s; zero where points carry none.
    pub velocity_gradient: [[f64; D]; D],
    /// Slope of the density, kg/m⁴; zero where points carry none.
    pub density_slope: [f64; D],
}

impl<const D: usize> PointState<D> {
    /// Volume m / ρ, m³ (m² in 2D, m in 1D).
    pub fn volume(&self) -> f64 {
        self.mass / self.density
    }
}

/// All points at one instant, in order of their identifiers.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation<const D: usize> {
    /// Time, s.
    pub time: f64,
    /// The points.
    pub points: Vec<PointState<D>>,
}

/// Totals over the points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conserved<const D: usize> {
    /// Σ m, kg.
    pub mass: f64,
    /// Σ m v, kg m/s.
    pub momentum: [f64; D],
    /// Σ m x × v about the origin as (yz, zx, xy) components, kg m²/s; zero in 1D.
    pub angular_momentum: [f64; 3],
    /// Σ ½ m v², J.
    pub kinetic_energy: f64,
    /// Σ m e, J, where the scene has an energy equation.
    pub internal_energy: f64,
}

/// The largest time step and the limit that sets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableTimeStep {
    /// Time step, s.
    pub dt: f64,
    /// Name of the limit, see `time_step`.
    pub limit: &'static str,
}

/// A simulation of any method, scalar type and recipe.
pub trait Simulation<const D: usize>: Send {
    /// Advances by `dt` seconds.
    ///
    /// # Errors
    /// When a point's state is not finite, has no positive density, or has left through a wall; the
    /// simulation must not be stepped again then.
    fn step(&mut self, dt: f64) -> Result<(), StepError>;

    /// The largest stable time step times `courant`, and what limits it.
    fn stable_dt(&self, courant: f64) -> StableTimeStep;

    /// Time, s.
    fn time(&self) -> f64;

    /// Number of points.
    fn n_points(&self) -> usize;

    /// Every point, in order of identifiers.
    fn observe(&self) -> Observation<D>;

    /// Shows every point once, in no particular order: for measurements after each step.
    fn visit_points(&self, visit: &mut dyn FnMut(&PointState<D>));

    /// Mass on the nodes by the quadrature of the last step, kg; zero before the first.
    ///
    /// It is the sum of the points' masses only where the points are the samples.
    fn grid_mass(&self) -> f64;

    /// Totals over the points.
    fn conserved(&self) -> Conserved<D>;

    /// Work and event counters since the start.
    fn counters(&self) -> Counters;

    /// What rearrangement, inlets and open faces did since the start.
    fn ledger(&self) -> &Ledger<D>;

    /// Force of the fluid on each body of the scene over the last step, N; zero before the first.
    fn body_forces(&self) -> &[[f64; D]];

    /// Sets what is done to the points at the end of each step from now on, whatever the variant fixes.
    ///
    /// # Errors
    /// When a setting is out of range, or the method cannot honour it.
    fn set_rearrangement(&mut self, settings: Option<Rearrangement>) -> Result<(), InvalidInput>;

    /// Bytes of state that each point carries.
    fn bytes_per_point(&self) -> usize;
}

/// The affine field of a point as a matrix, 1/s; zero where it carries none.
fn affine_matrix<T: Scalar, const D: usize, M: Method<T, D>>(
    affine: &AffineOf<T, D, M>,
) -> [[f64; D]; D] {
    if !<M::Transfer as Transfer<T, D>>::AFFINE {
        return [[0.0; D]; D];
    }
    std::array::from_fn(|row| {
        std::array::from_fn(|axis| M::Transfer::affine_entry(affine, row, axis).as_f64())
    })
}

/// Points in order of their identifiers; compiled once per dimension.
fn in_order<const D: usize>(mut points: Vec<PointState<D>>) -> Vec<PointState<D>> {
    points.sort_unstable_by_key(|point| point.id);
    points
}

impl<T, const D: usize, M, K> Simulation<D> for Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    fn step(&mut self, dt: f64) -> Result<(), StepError> {
        self.advance(T::lit(dt))
    }

    fn stable_dt(&self, courant: f64) -> StableTimeStep {
        self.stable_time_step(courant)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn n_points(&self) -> usize {
        self.particles.cell.iter().filter(|&&cell| cell != ABSENT).count()
    }

    fn observe(&self) -> Observation<D> {
        let mut points = Vec::with_capacity(self.particles.len());
        self.visit_points(&mut |point| points.push(*point));
        Observation { time: self.time, points: in_order(points) }
    }

    fn visit_points(&self, visit: &mut dyn FnMut(&PointState<D>)) {
        let (p, law) = (&self.particles, &self.physics.equation_of_state);
        for k in (0..p.len()).filter(|&k| p.cell[k] != ABSENT) {
            visit(&PointState {
                id: p.id[k],
                position: p.position[k].map(Scalar::as_f64),
                velocity: p.velocity[k].map(Scalar::as_f64),
                density: p.density[k].as_f64(),
                pressure: law.pressure(p.density[k], K::energy(&p.state[k])).as_f64(),
                mass: p.mass[k].as_f64(),
                energy: K::energy(&p.state[k]).as_f64(),
                stress: K::stress(&p.state[k]).map(|row| row.map(Scalar::as_f64)),
                velocity_gradient: affine_matrix::<T, D, M>(&p.affine[k]),
                density_slope: p
                    .density_slope
                    .get(k)
                    .map_or([0.0; D], |slope| slope.map(Scalar::as_f64)),
            });
        }
    }

    fn grid_mass(&self) -> f64 {
        if self.sorts_twice() { self.grid_mass_before } else { self.sampled_mass() }
    }

    fn conserved(&self) -> Conserved<D> {
        self.particle_totals()
    }

    fn counters(&self) -> Counters {
        self.counters
    }

    fn ledger(&self) -> &Ledger<D> {
        &self.ledger
    }

    fn body_forces(&self) -> &[[f64; D]] {
        self.bodies.as_ref().map_or(&[], |bodies| &bodies.forces)
    }

    fn set_rearrangement(&mut self, settings: Option<Rearrangement>) -> Result<(), InvalidInput> {
        Self::set_rearrangement(self, settings)
    }

    fn bytes_per_point(&self) -> usize {
        let optional = [&self.particles.length, &self.particles.density_slope];
        let carried = optional.into_iter().filter(|values| !values.is_empty()).count();
        ParticlesOf::<T, D, M, K>::bytes_per_point() + carried * size_of::<[T; D]>()
    }
}
