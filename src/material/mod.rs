//! What a material has besides its pressure law: types, so that an absent ingredient costs nothing.

mod deviatoric;
mod general;

pub use deviatoric::Deviatoric;
pub use general::{General, GeneralState};

use crate::Scalar;
use crate::equation_of_state::EquationOfState;
use crate::math::Field;

/// What happens to a point in one step, for the update of its state.
#[derive(Clone, Copy, Debug)]
pub struct Strain<T, const D: usize> {
    /// Time step, s.
    pub dt: T,
    /// Density before and after, kg/m³.
    pub density: [T; 2],
    /// Divergence that changed the density, 1/s.
    pub divergence: T,
    /// Velocity gradient `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub gradient: [[T; D]; D],
    /// Work of the forces, where the material asks for it.
    pub work: Option<Work<T, D>>,
}

/// What a step's forces do to a point, consistent with the nodes' kinetic energy.
#[derive(Clone, Copy, Debug)]
pub struct Work<T, const D: usize> {
    /// Gradient of the mean of the nodes' velocities before and after the step, 1/s.
    pub gradient: [[T; D]; D],
    /// Kinetic energy that the transfer takes from the point, J/kg.
    pub heat: T,
}

/// Deviatoric stress, internal energy and viscous pressure of a point, as far as there are any.
///
/// ```
/// use transpoint::material::{Deviatoric, General, Inviscid, Material};
/// assert_eq!(size_of::<<Inviscid as Material<f64, 2>>::State>(), 0);
/// assert_eq!(size_of::<<Deviatoric<f64> as Material<f64, 2>>::State>(), 32);
/// assert_eq!(size_of::<<General<f64> as Material<f64, 2>>::State>(), 48);
/// ```
pub trait Material<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// What a point stores; `()` when there is nothing.
    type State: Field<T>;
    /// Whether there is anything.
    const PRESENT: bool;
    /// Whether it goes with every pressure law; else with the weakly compressible one only, whose
    /// pressure then takes two operations in the step's loops and no branch.
    const ANY_LAW: bool = false;

    /// State at the start; specific internal energy in J/kg.
    fn initial(&self, _energy: T) -> Self::State {
        Self::State::default()
    }

    /// State after a step.
    fn update(
        &self,
        law: &EquationOfState<T>,
        state: &Self::State,
        strain: &Strain<T, D>,
    ) -> Self::State;

    /// s · g for a shape-function gradient g (1/m), Pa/m.
    fn times(state: &Self::State, gradient: [T; D]) -> [T; D];

    /// Deviatoric stress `[T; D]²`, tension positive, Pa.
    fn stress(state: &Self::State) -> [[T; D]; D] {
        let mut columns = [[T::zero(); D]; D];
        for (axis, column) in columns.iter_mut().enumerate() {
            let mut unit = [T::zero(); D];
            unit[axis] = T::one();
            *column = Self::times(state, unit);
        }
        columns
    }

    /// Specific internal energy, J/kg; zero when none is carried.
    #[inline(always)]
    fn energy(_state: &Self::State) -> T {
        T::zero()
    }

    /// Viscous pressure, Pa, which is added to that of the law.
    #[inline(always)]
    fn viscous_pressure(_state: &Self::State) -> T {
        T::zero()
    }

    /// Whether the update needs [`Strain::work`].
    #[inline(always)]
    fn wants_work(&self) -> bool {
        false
    }

    /// Kinematic viscosity, m²/s, for the time step at a given speed of sound in m/s.
    fn viscosity(&self, sound_speed: T) -> T;

    /// Shear modulus G, Pa, for the speed of longitudinal waves.
    fn shear_modulus(&self) -> T {
        T::zero()
    }
}

/// Nothing but pressure as a function of density.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inviscid;

impl<T: Scalar, const D: usize> Material<T, D> for Inviscid {
    type State = ();
    const PRESENT: bool = false;

    #[inline(always)]
    fn update(&self, _law: &EquationOfState<T>, _state: &(), _strain: &Strain<T, D>) {}

    #[inline(always)]
    fn times(_state: &(), _gradient: [T; D]) -> [T; D] {
        [T::zero(); D]
    }

    #[inline(always)]
    fn viscosity(&self, _sound_speed: T) -> T {
        T::zero()
    }
}
