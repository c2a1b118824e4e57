//! Pressure as a function of density.

use crate::Scalar;
use crate::error::InvalidInput;
use crate::scene::EquationOfStateSpec;

/// A barotropic pressure law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EquationOfState<T> {
    /// p = c₀² (ρ − ρ₀), Eq. (35) of \[Song2020\].
    WeaklyCompressible {
        /// ρ₀, kg/m³.
        reference_density: T,
        /// c₀², m²/s².
        sound_speed_squared: T,
    },
}

impl<T: Scalar> EquationOfState<T> {
    /// Checks and converts the law of a scene.
    ///
    /// # Errors
    /// When a density or speed is not positive and finite.
    pub fn new(spec: &EquationOfStateSpec) -> Result<Self, InvalidInput> {
        match *spec {
            EquationOfStateSpec::WeaklyCompressible { reference_density, sound_speed } => {
                for (field, value, unit) in [
                    ("equation_of_state.reference_density", reference_density, "kg/m³"),
                    ("equation_of_state.sound_speed", sound_speed, "m/s"),
                ] {
                    if !(value.is_finite() && value > 0.0) {
                        let allowed = format!("a positive number in {unit}");
                        return Err(InvalidInput::new(field, value, allowed));
                    }
                }
                Ok(Self::WeaklyCompressible {
                    reference_density: T::lit(reference_density),
                    sound_speed_squared: T::lit(sound_speed * sound_speed),
                })
            }
        }
    }

    /// Pressure at a density, Pa, compression positive.
    #[inline(always)]
    pub fn pressure(&self, density: T) -> T {
        match *self {
            Self::WeaklyCompressible { reference_density, sound_speed_squared } => {
                sound_speed_squared * (density - reference_density)
            }
        }
    }

    /// Speed of sound √(dp/dρ) at a density, m/s.
    #[inline(always)]
    pub fn sound_speed(&self, _density: T) -> T {
        match *self {
            Self::WeaklyCompressible { sound_speed_squared, .. } => sound_speed_squared.sqrt(),
        }
    }
}
