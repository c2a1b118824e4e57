//! Deviatoric stress of a laminar fluid or of a linear elastic solid.

use super::{Material, Strain};
use crate::Scalar;
use crate::equation_of_state::EquationOfState;
use crate::math::{Tensor, dot};

/// Law of the deviatoric stress s; in 1D and 2D the other directions are at rest (plane strain).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Deviatoric<T> {
    /// Newtonian fluid, s = 2 ρ ν dev(sym L).
    Newtonian {
        /// ν, m²/s.
        viscosity: T,
    },
    /// Linear elastic solid with the spin Ω of Eqs. (28)-(29) of \[Song2020\] (Jaumann rate):
    /// s ← s + Δt (2 G dev(sym L) + Ω s − s Ω).
    Elastic {
        /// G, Pa.
        shear_modulus: T,
    },
}

impl<T: Scalar> Deviatoric<T> {
    /// Stress (Pa) from that before and the strain of a step.
    #[inline(always)]
    pub(super) fn updated<const D: usize>(
        &self,
        old: &Tensor<T, D>,
        strain: &Strain<T, D>,
    ) -> Tensor<T, D> {
        match *self {
            Self::Newtonian { viscosity } => {
                let mut stress = Tensor::default();
                add_deviator(&mut stress, strain.density[1] * viscosity, &strain.gradient);
                stress
            }
            Self::Elastic { shear_modulus } => {
                let mut stress = *old;
                add_spin(&mut stress, strain.dt, old, &strain.gradient);
                add_deviator(&mut stress, strain.dt * shear_modulus, &strain.gradient);
                stress
            }
        }
    }
}

/// Adds `2 factor dev(sym L)`.
#[inline(always)]
fn add_deviator<T: Scalar, const D: usize>(
    stress: &mut Tensor<T, D>,
    factor: T,
    gradient: &[[T; D]; D],
) {
    let mut trace = T::zero();
    for axis in 0..D {
        trace += gradient[axis][axis];
    }
    for i in 0..D {
        for j in 0..D {
            stress.0[i][j] += factor * (gradient[i][j] + gradient[j][i]);
        }
        // The third direction is at rest in 1D and 2D, hence a third and not 1/D.
        stress.0[i][i] -= T::lit(2.0 / 3.0) * factor * trace;
    }
}

/// Adds `Δt (Ω s − s Ω)` with Ω the antisymmetric part of L.
#[inline(always)]
fn add_spin<T: Scalar, const D: usize>(
    stress: &mut Tensor<T, D>,
    dt: T,
    old: &Tensor<T, D>,
    gradient: &[[T; D]; D],
) {
    let half = T::lit(0.5) * dt;
    let spin = |i: usize, j: usize| half * (gradient[i][j] - gradient[j][i]);
    for i in 0..D {
        for j in 0..D {
            for k in 0..D {
                stress.0[i][j] += spin(i, k) * old.0[k][j] - old.0[i][k] * spin(k, j);
            }
        }
    }
}

impl<T: Scalar, const D: usize> Material<T, D> for Deviatoric<T> {
    type State = Tensor<T, D>;
    const PRESENT: bool = true;

    #[inline(always)]
    fn update(
        &self,
        _law: &EquationOfState<T>,
        state: &Tensor<T, D>,
        strain: &Strain<T, D>,
    ) -> Tensor<T, D> {
        self.updated(state, strain)
    }

    #[inline(always)]
    fn times(state: &Tensor<T, D>, gradient: [T; D]) -> [T; D] {
        std::array::from_fn(|row| dot(state.0[row], gradient))
    }

    fn viscosity(&self, _sound_speed: T) -> T {
        match *self {
            Self::Newtonian { viscosity } => viscosity,
            Self::Elastic { .. } => T::zero(),
        }
    }

    fn shear_modulus(&self) -> T {
        match *self {
            Self::Newtonian { .. } => T::zero(),
            Self::Elastic { shear_modulus } => shear_modulus,
        }
    }
}
