//! The time step that a running simulation may take.

use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::simulation::StableTimeStep;
use crate::solver::Solver;
use crate::step::{FieldAt, LocalAcceleration};
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
        let rate =
            physics.central_force.as_ref().map_or(T::zero(), |force| force.rate_squared.sqrt());
        self.raise_to_local_forces(&mut acceleration);
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

    /// Adds to the size of the uniform acceleration the largest of what depends on the place, at the points.
    fn raise_to_local_forces(&self, acceleration: &mut [T; D]) {
        let central = self.physics.central_force.as_ref();
        let field = self.force_field.as_ref().map(|field| FieldAt { field, time: self.time });
        if central.is_none() && field.is_none() {
            return;
        }
        let uniform = *acceleration;
        for &position in &self.particles.position {
            let towards = central.map_or([T::zero(); D], |force| force.acceleration(position));
            let there = field.map_or([T::zero(); D], |field| field.acceleration(position));
            for axis in 0..D {
                let local = (towards[axis] + there[axis]).abs();
                acceleration[axis] = acceleration[axis].max(uniform[axis] + local);
            }
        }
    }
}
