//! Deviatoric stress: an ingredient that is a type, so that its absence costs nothing.

use crate::Scalar;
use crate::math::{Field, Tensor};

/// The deviatoric part of the stress of a point.
///
/// ```
/// use transpoint::stress::{DeviatoricStress, Inviscid, Newtonian};
/// assert_eq!(size_of::<<Inviscid as DeviatoricStress<f64, 2>>::Stress>(), 0);
/// assert_eq!(size_of::<<Newtonian<f64> as DeviatoricStress<f64, 2>>::Stress>(), 32);
/// ```
pub trait DeviatoricStress<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// What a point stores; `()` when there is none.
    type Stress: Field<T>;
    /// Whether there is any.
    const PRESENT: bool;

    /// Stress from density (kg/m³) and velocity gradient `L[i][j] = ∂v_i/∂x_j` (1/s), Pa.
    fn update(&self, density: T, gradient: &[[T; D]; D]) -> Self::Stress;

    /// s · g for a shape-function gradient g (1/m), Pa/m.
    fn times(stress: &Self::Stress, gradient: [T; D]) -> [T; D];

    /// Kinematic viscosity, m²/s, for the time step; zero when there is none.
    fn viscosity(&self) -> T;
}

/// No deviatoric stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inviscid;

/// Newtonian fluid, s = 2 ρ ν dev(sym L).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newtonian<T> {
    /// ν, m²/s.
    pub viscosity: T,
}

impl<T: Scalar, const D: usize> DeviatoricStress<T, D> for Inviscid {
    type Stress = ();
    const PRESENT: bool = false;

    #[inline(always)]
    fn update(&self, _density: T, _gradient: &[[T; D]; D]) {}

    #[inline(always)]
    fn times(_stress: &(), _gradient: [T; D]) -> [T; D] {
        [T::zero(); D]
    }

    #[inline(always)]
    fn viscosity(&self) -> T {
        T::zero()
    }
}

impl<T: Scalar, const D: usize> DeviatoricStress<T, D> for Newtonian<T> {
    type Stress = Tensor<T, D>;
    const PRESENT: bool = true;

    #[inline(always)]
    fn update(&self, density: T, gradient: &[[T; D]; D]) -> Tensor<T, D> {
        let dynamic = density * self.viscosity;
        let mut trace = T::zero();
        for axis in 0..D {
            trace += gradient[axis][axis];
        }
        let mut stress = Tensor::default();
        for i in 0..D {
            for j in 0..D {
                stress.0[i][j] = dynamic * (gradient[i][j] + gradient[j][i]);
            }
            // The third direction is at rest in 1D and 2D, hence a third and not 1/D.
            stress.0[i][i] -= T::lit(2.0 / 3.0) * dynamic * trace;
        }
        stress
    }

    #[inline(always)]
    fn times(stress: &Tensor<T, D>, gradient: [T; D]) -> [T; D] {
        std::array::from_fn(|row| crate::math::dot(stress.0[row], gradient))
    }

    #[inline(always)]
    fn viscosity(&self) -> T {
        self.viscosity
    }
}
