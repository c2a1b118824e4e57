//! A recipe: one choice of each part that the inner loops depend on.

use crate::Scalar;
use crate::formulation::Formulation;
use crate::quadrature::Quadrature;
use crate::reconstruction::Reconstruction;
use crate::shape::ShapeFunction;
use crate::transfer::Transfer;
use crate::variants::StressUpdate;

/// The parts of a method under one name, so that generic code carries one bound, not four.
pub trait Method<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Grid shape function.
    type Shape: ShapeFunction<T>;
    /// Fields between the points.
    type Reconstruction: Reconstruction<T, D>;
    /// Samples of the integrals.
    type Quadrature: Quadrature<T, D>;
    /// Velocity transfer.
    type Transfer: Transfer<T, D>;

    /// Grid shape function.
    fn shape(&self) -> Self::Shape;
    /// Fields between the points.
    fn reconstruction(&self) -> Self::Reconstruction;
    /// Samples of the integrals.
    fn quadrature(&self) -> Self::Quadrature;
    /// Velocity transfer.
    fn transfer(&self) -> Self::Transfer;
    /// Where pressure and divergence live.
    fn formulation(&self) -> Formulation;
    /// When density and stress are updated.
    fn stress_update(&self) -> StressUpdate;
}

/// A method put together from its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme<S, R, Q, X> {
    /// Grid shape function.
    pub shape: S,
    /// Fields between the points.
    pub reconstruction: R,
    /// Samples of the integrals.
    pub quadrature: Q,
    /// Velocity transfer.
    pub transfer: X,
    /// Where pressure and divergence live.
    pub formulation: Formulation,
    /// When density and stress are updated.
    pub stress_update: StressUpdate,
}

impl<T, const D: usize, S, R, Q, X> Method<T, D> for Scheme<S, R, Q, X>
where
    T: Scalar,
    S: ShapeFunction<T> + 'static,
    R: Reconstruction<T, D>,
    Q: Quadrature<T, D>,
    X: Transfer<T, D>,
{
    type Shape = S;
    type Reconstruction = R;
    type Quadrature = Q;
    type Transfer = X;

    fn shape(&self) -> S {
        self.shape
    }

    fn reconstruction(&self) -> R {
        self.reconstruction
    }

    fn quadrature(&self) -> Q {
        self.quadrature
    }

    fn transfer(&self) -> X {
        self.transfer
    }

    fn formulation(&self) -> Formulation {
        self.formulation
    }

    fn stress_update(&self) -> StressUpdate {
        self.stress_update
    }
}
