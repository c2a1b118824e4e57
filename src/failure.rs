//! A failing point in words.

use crate::Scalar;
use crate::error::StepError;
use crate::material::Material;
use crate::method::Method;
use crate::solver::Solver;
use crate::step::Failure;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Which point failed, where, and in what.
    pub(crate) fn describe(&self, point: usize, failure: Failure) -> StepError {
        let p = &self.particles;
        let (id, time) = (p.id[point], self.time);
        let finite = |v: &[T; D]| v.iter().all(nalgebra::ComplexField::is_finite);
        match failure {
            Failure::NotFinite => {
                let field = if !finite(&p.velocity[point]) {
                    "velocity"
                } else if finite(&p.position[point]) {
                    "density"
                } else {
                    "position"
                };
                StepError::NotFinite { id, field, time }
            }
            Failure::NotPositive => {
                StepError::NotPositive { id, density: p.density[point].as_f64(), time }
            }
            Failure::LeftDomain => {
                let position = p.position[point].iter().map(|x| x.as_f64()).collect();
                StepError::LeftDomain { id, position, time }
            }
        }
    }
}
