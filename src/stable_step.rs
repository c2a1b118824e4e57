//! The time step that a running simulation may take.

use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::simulation::StableTimeStep;
use crate::solver::Solver;
use crate::time_step;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// The smallest limit of [`time_step`] times `courant`, with its name.
    ///
    /// The acoustic limit is that of full cells for every method, so that all are run at the same
    /// Courant number; a limit without a cause (no viscosity, no force) is infinite.
    pub fn stable_time_step(&self, courant: f64) -> StableTimeStep {
        let spacing = self.grid.spacing;
        let physics = &self.physics;
        let (mut sound, mut longitudinal, mut speed) = (T::zero(), T::zero(), T::zero());
        let p = &self.particles;
        for ((&density, v), state) in p.density.iter().zip(&p.velocity).zip(&p.state) {
            let c = physics.equation_of_state.sound_speed(density, K::energy(state));
            let shear = T::lit(4.0 / 3.0) * physics.material.shear_modulus() / density;
            sound = sound.max(c);
            longitudinal = longitudinal.max((c * c + shear).sqrt());
            speed = speed.max(crate::math::dot(*v, *v));
        }
        let mut acceleration = physics.body_force.map(nalgebra::ComplexField::abs);
        let mut rate = T::zero();
        if let Some(central) = &physics.central_force {
            rate = central.rate_squared.sqrt();
            let uniform = acceleration;
            for &position in &p.position {
                let towards = central.acceleration(position);
                for axis in 0..D {
                    acceleration[axis] =
                        acceleration[axis].max(uniform[axis] + towards[axis].abs());
                }
            }
        }
        let limits = [
            ("acoustic", time_step::acoustic_cell(spacing, longitudinal)),
            ("advective", time_step::advective(spacing, speed.sqrt())),
            ("viscous", time_step::viscous(spacing, physics.material.viscosity(sound))),
            ("body-force", time_step::body_force(spacing, acceleration)),
            ("central-force", time_step::central_force(rate)),
        ];
        let (limit, dt) = limits.into_iter().fold(("none", f64::INFINITY), |least, (name, dt)| {
            let dt = dt.as_f64();
            if dt < least.1 { (name, dt) } else { least }
        });
        StableTimeStep { dt: courant * dt, limit }
    }
}
