//! All ingredients in one material: deviatoric stress, internal energy, bulk viscosity.

use super::{Deviatoric, Material, Strain};
use crate::Scalar;
use crate::equation_of_state::EquationOfState;
use crate::math::{Field, Tensor, dot};
use crate::settings::{BulkViscosity, EnergyUpdate};

/// A material with internal energy or bulk viscosity; scenes without either use
/// [`Inviscid`](super::Inviscid) or [`Deviatoric`], whose points carry less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct General<T> {
    /// Deviatoric stress, if any.
    pub deviatoric: Option<Deviatoric<T>>,
    /// How the internal energy is updated; `None`: it stays as it is.
    pub energy: Option<EnergyUpdate>,
    /// Bulk viscosity, if any.
    pub bulk_viscosity: Option<BulkViscosity>,
    /// Length h of the bulk viscosity, m.
    pub cell_size: T,
}

/// What a point of [`General`] carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralState<T, const D: usize> {
    /// Deviatoric Cauchy stress, tension positive, Pa.
    pub stress: Tensor<T, D>,
    /// Specific internal energy e, J/kg.
    ///
    /// \[Song2020\] carries E per unit initial volume; E = ρ₀ e with the point's density at the start.
    pub energy: T,
    /// Viscous pressure q, Pa.
    pub viscous_pressure: T,
}

impl<T: Scalar, const D: usize> Default for GeneralState<T, D> {
    fn default() -> Self {
        let zero = T::zero();
        Self { stress: Tensor::default(), energy: zero, viscous_pressure: zero }
    }
}

impl<T: Scalar, const D: usize> Field<T> for GeneralState<T, D> {
    const COMPONENTS: usize = D * D + 2;

    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        self.stress.add_scaled(weight, other.stress);
        self.energy += weight * other.energy;
        self.viscous_pressure += weight * other.viscous_pressure;
    }

    #[inline(always)]
    fn write(&self, components: &mut [T]) {
        self.stress.write(&mut components[..D * D]);
        components[D * D] = self.energy;
        components[D * D + 1] = self.viscous_pressure;
    }

    #[inline(always)]
    fn read(components: &[T]) -> Self {
        Self {
            stress: Tensor::read(&components[..D * D]),
            energy: components[D * D],
            viscous_pressure: components[D * D + 1],
        }
    }
}

impl<T: Scalar> General<T> {
    /// Change of the specific internal energy, J/kg.
    ///
    /// Eq. (34) of \[Song2020\] divided by the initial density, with V = ρ₀/ρ and q added to p:
    ///
    /// ```text
    /// Δe = ½ (1/ρ + 1/ρ') (s : Δε − (p + q) tr Δε)
    /// ```
    ///
    /// or the work that the nodes see, with v̄ the mean of their velocities before and after:
    /// Δe = Δt (s : ∇v̄ − (p + q) div v̄) / ρ + heat of the transfer, after \[Burgess1992\].
    fn energy_increment<const D: usize>(
        &self,
        law: &EquationOfState<T>,
        state: &GeneralState<T, D>,
        strain: &Strain<T, D>,
    ) -> T {
        let [before, after] = strain.density;
        let pressure = law.pressure(before, state.energy) + state.viscous_pressure;
        match (self.energy, &strain.work) {
            (None, _) => T::zero(),
            (Some(_), Some(work)) => {
                let mut divergence = T::zero();
                for axis in 0..D {
                    divergence += work.gradient[axis][axis];
                }
                let power = contract(&state.stress, &work.gradient) - pressure * divergence;
                strain.dt * power / before + work.heat
            }
            (Some(_), None) => {
                let volume = T::lit(0.5) * (T::one() / before + T::one() / after);
                let power =
                    contract(&state.stress, &strain.gradient) - pressure * strain.divergence;
                strain.dt * volume * power
            }
        }
    }
}

/// s : L.
#[inline(always)]
fn contract<T: Scalar, const D: usize>(stress: &Tensor<T, D>, gradient: &[[T; D]; D]) -> T {
    (0..D).fold(T::zero(), |sum, row| sum + dot(stress.0[row], gradient[row]))
}

/// q = −ρ h D (C₁ c + C₂ h |D|) in compression, \[VonNeumann1950\], \[Landshoff1955\]; in expansion zero, or
/// −ρ h C₁ c D where the linear term acts there too.
#[inline(always)]
fn viscous_pressure<T: Scalar>(
    coefficients: BulkViscosity,
    (density, sound_speed): (T, T),
    cell_size: T,
    divergence: T,
) -> T {
    if divergence >= T::zero() && !coefficients.expansion {
        return T::zero();
    }
    let jump = -divergence * cell_size;
    let linear = T::lit(coefficients.linear) * sound_speed;
    density * jump * (linear + T::lit(coefficients.quadratic) * jump.max(T::zero()))
}

impl<T: Scalar, const D: usize> Material<T, D> for General<T> {
    type State = GeneralState<T, D>;
    const PRESENT: bool = true;
    const ANY_LAW: bool = true;

    fn initial(&self, energy: T) -> GeneralState<T, D> {
        GeneralState { energy, ..GeneralState::default() }
    }

    fn update(
        &self,
        law: &EquationOfState<T>,
        state: &GeneralState<T, D>,
        strain: &Strain<T, D>,
    ) -> GeneralState<T, D> {
        let energy = state.energy + self.energy_increment(law, state, strain);
        let stress = match &self.deviatoric {
            Some(law) => law.updated(&state.stress, strain),
            None => Tensor::default(),
        };
        let density = strain.density[1];
        let viscous_pressure = match self.bulk_viscosity {
            Some(coefficients) => {
                let sound_speed = law.sound_speed(density, energy);
                let at = (density, sound_speed);
                viscous_pressure(coefficients, at, self.cell_size, strain.divergence)
            }
            None => T::zero(),
        };
        GeneralState { stress, energy, viscous_pressure }
    }

    #[inline(always)]
    fn times(state: &GeneralState<T, D>, gradient: [T; D]) -> [T; D] {
        <Deviatoric<T> as Material<T, D>>::times(&state.stress, gradient)
    }

    #[inline(always)]
    fn energy(state: &GeneralState<T, D>) -> T {
        state.energy
    }

    #[inline(always)]
    fn viscous_pressure(state: &GeneralState<T, D>) -> T {
        state.viscous_pressure
    }

    #[inline(always)]
    fn wants_work(&self) -> bool {
        self.energy == Some(EnergyUpdate::Work)
    }

    /// The linear bulk viscosity acts as ν = C₁ c h.
    fn viscosity(&self, sound_speed: T) -> T {
        let bulk = self.bulk_viscosity.map_or(T::zero(), |coefficients| {
            T::lit(coefficients.linear) * sound_speed * self.cell_size
        });
        let shear = self.deviatoric.map_or(T::zero(), |law| {
            <Deviatoric<T> as Material<T, D>>::viscosity(&law, sound_speed)
        });
        bulk + shear
    }

    fn shear_modulus(&self) -> T {
        self.deviatoric
            .map_or(T::zero(), |law| <Deviatoric<T> as Material<T, D>>::shear_modulus(&law))
    }
}
