//! The generic solver on the scenes of the plain kernels: one function per scheme.

use transpoint::basis;
use transpoint::formulation::Formulation;
use transpoint::material::{Deviatoric, Inviscid, Material};
use transpoint::method::{Method, Scheme};
use transpoint::quadrature::{Mixed, Particle};
use transpoint::reconstruction::{Carried, MovingLeastSquares};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::transfer::{Apic, Flip};
use transpoint::variants::{Blend, PointVolume, StressUpdate};
use transpoint::{Scalar, Scene, Simulation, Solver};

use crate::plain::{State, Stepper};

/// A generic solver that steps as the plain kernels do.
pub struct Generic<T: Scalar, const D: usize, M: Method<T, D>, K: Material<T, D>>(
    pub Solver<T, D, M, K>,
);

/// The transport point method as `Variant::Tpm` builds it.
pub type TpmScheme = Scheme<Linear, MovingLeastSquares<basis::Linear, f64>, Mixed, Flip>;
/// Linear MPM as `Variant::Mpm` builds it.
pub type MpmScheme = Scheme<Linear, Carried, Particle, Flip>;
/// Quadratic APIC as `Variant::Apic` builds it.
pub type ApicScheme = Scheme<QuadraticBspline, Carried, Particle, Apic>;

/// Quadratic B-splines, affine transfer.
pub fn apic<T: Scalar, const D: usize>(scene: &Scene<D>) -> Generic<T, D, ApicScheme, Inviscid> {
    build(scene, scheme(QuadraticBspline, Carried, Particle, Apic), Inviscid)
}

/// Quadratic B-splines, affine transfer, viscous fluid.
pub fn viscous_apic<const D: usize>(
    scene: &Scene<D>,
) -> Generic<f64, D, ApicScheme, Deviatoric<f64>> {
    let stress = Deviatoric::Newtonian { viscosity: 1e-6 };
    build(scene, scheme(QuadraticBspline, Carried, Particle, Apic), stress)
}

/// Linear hats, FLIP.
pub fn mpm<T: Scalar, const D: usize>(scene: &Scene<D>) -> Generic<T, D, MpmScheme, Inviscid> {
    build(scene, scheme(Linear, Carried, Particle, FLIP), Inviscid)
}

/// Moving least squares with a linear basis, Gauss points in full cells, FLIP.
pub fn tpm(scene: &Scene<2>) -> Generic<f64, 2, TpmScheme, Inviscid> {
    let reconstruction = MovingLeastSquares::new(1.0);
    let quadrature = Mixed::new(PointVolume::Sphere);
    build(scene, scheme(Linear, reconstruction, quadrature, FLIP), Inviscid)
}

const FLIP: Flip = Flip { blend: Blend::PerStep(1.0) };

fn scheme<S, R, Q, X>(
    shape: S,
    reconstruction: R,
    quadrature: Q,
    transfer: X,
) -> Scheme<S, R, Q, X> {
    Scheme {
        shape,
        reconstruction,
        quadrature,
        transfer,
        formulation: Formulation::Standard,
        stress_update: StressUpdate::Last,
    }
}

fn build<T: Scalar, const D: usize, M: Method<T, D>, K: Material<T, D>>(
    scene: &Scene<D>,
    method: M,
    stress: K,
) -> Generic<T, D, M, K> {
    Generic(Solver::new(scene, method, stress).expect("the scenes of the benches are valid"))
}

impl<T: Scalar, const D: usize, M: Method<T, D>, K: Material<T, D>> Stepper<D>
    for Generic<T, D, M, K>
{
    fn step(&mut self, dt: f64) {
        Simulation::step(&mut self.0, dt).expect("the scenes of the benches are stable");
    }

    fn points(&self) -> State<D> {
        let points = self.0.observe().points;
        State {
            position: points.iter().map(|p| p.position).collect(),
            velocity: points.iter().map(|p| p.velocity).collect(),
            density: points.iter().map(|p| p.density).collect(),
            mass: points.iter().map(|p| p.mass).collect(),
        }
    }

    fn bytes_per_point(&self) -> usize {
        Simulation::bytes_per_point(&self.0)
    }

    fn n_sorts(&self) -> u64 {
        self.0.counters.n_sorts
    }
}
