//! Pressure as a function of density and, for gases, of internal energy.

use crate::Scalar;
use crate::error::InvalidInput;
use crate::scene::EquationOfStateSpec;

/// A pressure law; energies are specific internal energies in J/kg, which barotropic laws ignore.
///
/// ```
/// use transpoint::equation_of_state::EquationOfState;
/// use transpoint::scene::EquationOfStateSpec;
/// let air = EquationOfState::<f64>::new(&EquationOfStateSpec::IdealGas { ratio: 1.4 })?;
/// assert!((air.pressure(1.0, 2.5) - 1.0).abs() < 1e-15);
/// # Ok::<(), transpoint::InvalidInput>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EquationOfState<T> {
    /// Linear in the density.
    WeaklyCompressible(WeaklyCompressible<T>),
    /// p = B ((ρ/ρ₀)^γ − 1) with B = ρ₀ c₀² / γ, \[Cole1948\].
    Tait {
        /// ρ₀, kg/m³.
        reference_density: T,
        /// B, Pa.
        modulus: T,
        /// γ.
        exponent: T,
    },
    /// p = (γ − 1) ρ e − γ p∞, \[Harlow1971\]; an ideal gas with p∞ = 0.
    StiffenedGas {
        /// γ.
        ratio: T,
        /// p∞, Pa.
        stiffness: T,
    },
}

/// p = c₀² (ρ − ρ₀), Eq. (35) of \[Song2020\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeaklyCompressible<T> {
    /// ρ₀, kg/m³.
    pub reference_density: T,
    /// c₀², m²/s².
    pub sound_speed_squared: T,
}

impl<T: Scalar> WeaklyCompressible<T> {
    /// Pressure, Pa, compression positive.
    #[inline(always)]
    pub fn pressure(&self, density: T) -> T {
        self.sound_speed_squared * (density - self.reference_density)
    }
}

impl<T: Scalar> EquationOfState<T> {
    /// Checks and converts the law of a scene.
    ///
    /// # Errors
    /// When a parameter is out of range.
    pub fn new(spec: &EquationOfStateSpec) -> Result<Self, InvalidInput> {
        match *spec {
            EquationOfStateSpec::WeaklyCompressible { reference_density, sound_speed } => {
                check_liquid(reference_density, sound_speed)?;
                Ok(Self::WeaklyCompressible(WeaklyCompressible {
                    reference_density: T::lit(reference_density),
                    sound_speed_squared: T::lit(sound_speed * sound_speed),
                }))
            }
            EquationOfStateSpec::Tait { reference_density, sound_speed, exponent } => {
                check_liquid(reference_density, sound_speed)?;
                check("exponent", exponent, exponent >= 1.0, "a number from 1 on")?;
                Ok(Self::Tait {
                    reference_density: T::lit(reference_density),
                    modulus: T::lit(reference_density * sound_speed * sound_speed / exponent),
                    exponent: T::lit(exponent),
                })
            }
            EquationOfStateSpec::StiffenedGas { ratio, stiffness } => {
                check("ratio", ratio, ratio > 1.0, "a ratio of specific heats above 1")?;
                check("stiffness", stiffness, stiffness >= 0.0, "zero or a positive number in Pa")?;
                Ok(Self::StiffenedGas { ratio: T::lit(ratio), stiffness: T::lit(stiffness) })
            }
            EquationOfStateSpec::IdealGas { ratio } => {
                Self::new(&EquationOfStateSpec::StiffenedGas { ratio, stiffness: 0.0 })
            }
        }
    }

    /// The law as one that is linear in the density, if it is.
    pub fn linear(&self) -> Option<WeaklyCompressible<T>> {
        match *self {
            Self::WeaklyCompressible(law) => Some(law),
            Self::Tait { .. } | Self::StiffenedGas { .. } => None,
        }
    }

    /// Whether the pressure depends on the internal energy.
    pub fn uses_energy(&self) -> bool {
        matches!(self, Self::StiffenedGas { .. })
    }

    /// Pressure, Pa, compression positive.
    pub fn pressure(&self, density: T, energy: T) -> T {
        match *self {
            Self::WeaklyCompressible(law) => law.pressure(density),
            Self::Tait { reference_density, modulus, exponent } => {
                modulus * ((density / reference_density).powf(exponent) - T::one())
            }
            Self::StiffenedGas { ratio, stiffness } => {
                (ratio - T::one()) * density * energy - ratio * stiffness
            }
        }
    }

    /// Density at which a pressure (Pa) is found, kg/m³.
    pub fn density(&self, pressure: T, energy: T) -> T {
        match *self {
            Self::WeaklyCompressible(law) => {
                law.reference_density + pressure / law.sound_speed_squared
            }
            Self::Tait { reference_density, modulus, exponent } => {
                reference_density * (pressure / modulus + T::one()).powf(T::one() / exponent)
            }
            Self::StiffenedGas { ratio, stiffness } => {
                (pressure + ratio * stiffness) / ((ratio - T::one()) * energy)
            }
        }
    }

    /// Energy of compression ∫ p/ρ² dρ from rest, J/kg, of a law without internal energy; else zero.
    pub fn compression_energy(&self, density: T) -> T {
        match *self {
            Self::WeaklyCompressible(law) => {
                let ratio = density / law.reference_density;
                law.sound_speed_squared * (ratio.ln() + T::one() / ratio - T::one())
            }
            Self::Tait { reference_density, modulus, exponent } => {
                let (ratio, power) = (density / reference_density, exponent - T::one());
                let rise = if power > T::zero() {
                    (ratio.powf(power) - T::one()) / power
                } else {
                    ratio.ln()
                };
                modulus / reference_density * (rise + T::one() / ratio - T::one())
            }
            Self::StiffenedGas { .. } => T::zero(),
        }
    }

    /// Speed of sound, m/s; zero where the law has none.
    #[inline]
    pub fn sound_speed(&self, density: T, energy: T) -> T {
        let squared = match *self {
            Self::WeaklyCompressible(law) => law.sound_speed_squared,
            Self::Tait { reference_density, modulus, exponent } => {
                let compression = density / reference_density;
                modulus * exponent / reference_density * compression.powf(exponent - T::one())
            }
            Self::StiffenedGas { ratio, stiffness } => {
                ratio * (self.pressure(density, energy) + stiffness) / density
            }
        };
        squared.max(T::zero()).sqrt()
    }
}

fn check(field: &str, value: f64, holds: bool, allowed: &str) -> Result<(), InvalidInput> {
    if value.is_finite() && holds {
        return Ok(());
    }
    Err(InvalidInput::new(format!("equation_of_state.{field}"), value, allowed))
}

fn check_liquid(reference_density: f64, sound_speed: f64) -> Result<(), InvalidInput> {
    let density_holds = reference_density > 0.0;
    check("reference_density", reference_density, density_holds, "a positive number in kg/m³")?;
    check("sound_speed", sound_speed, sound_speed > 0.0, "a positive number in m/s")
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: [EquationOfStateSpec; 2] = [
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1000.0, sound_speed: 50.0 },
        EquationOfStateSpec::Tait { reference_density: 1000.0, sound_speed: 50.0, exponent: 7.0 },
    ];
    const GASES: [EquationOfStateSpec; 2] = [
        EquationOfStateSpec::IdealGas { ratio: 1.4 },
        EquationOfStateSpec::StiffenedGas { ratio: 4.4, stiffness: 6e3 },
    ];

    fn law(spec: &EquationOfStateSpec) -> EquationOfState<f64> {
        EquationOfState::new(spec).unwrap()
    }

    #[track_caller]
    fn assert_near(found: f64, exact: f64, bound: f64) {
        assert!((found - exact).abs() <= bound, "{found} is not {exact}");
    }

    #[test]
    fn density_is_the_inverse_of_pressure() {
        for spec in WATER.iter().chain(&GASES) {
            for (density, energy) in [(900.0, 20.0), (1000.0, 25.0), (1100.0, 30.0)] {
                let pressure = law(spec).pressure(density, energy);
                assert_near(law(spec).density(pressure, energy), density, 1e-9);
            }
        }
    }

    /// c² = ∂p/∂ρ + (p/ρ²) ∂p/∂e, the slope along an adiabat.
    #[test]
    fn sound_speed_is_the_adiabatic_slope() {
        for spec in WATER.iter().chain(&GASES) {
            let law = law(spec);
            let (density, energy) = (1020.0, 23.0);
            let (d, e) = (1e-3, 1e-5);
            let along_density =
                (law.pressure(density + d, energy) - law.pressure(density - d, energy)) / (2.0 * d);
            let along_energy =
                (law.pressure(density, energy + e) - law.pressure(density, energy - e)) / (2.0 * e);
            let pressure = law.pressure(density, energy);
            let squared = along_density + pressure / (density * density) * along_energy;
            let found = law.sound_speed(density, energy);
            assert_near(found * found / squared, 1.0, 1e-7);
        }
    }

    /// p = ρ² de/dρ.
    #[test]
    fn compression_energy_is_the_integral_of_pressure() {
        let exponent = 1.0;
        let isothermal =
            EquationOfStateSpec::Tait { reference_density: 1000.0, sound_speed: 50.0, exponent };
        for spec in WATER.iter().chain([&isothermal]) {
            let (density, d) = (1020.0, 1e-2);
            let energy = |density| law(spec).compression_energy(density);
            let slope = (energy(density + d) - energy(density - d)) / (2.0 * d);
            let pressure = law(spec).pressure(density, 0.0);
            assert_near(density * density * slope / pressure, 1.0, 1e-6);
            assert_eq!(energy(1000.0), 0.0);
        }
    }

    #[test]
    fn laws_of_water_agree_at_rest() {
        for spec in &WATER {
            assert_eq!(law(spec).pressure(1000.0, 0.0), 0.0);
            assert_near(law(spec).sound_speed(1000.0, 0.0), 50.0, 1e-12);
            assert!(!law(spec).uses_energy());
        }
        assert_near(law(&WATER[1]).pressure(1010.0, 0.0), 25_762.6, 0.1);
        assert!(GASES.iter().all(|spec| law(spec).uses_energy()));
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        use EquationOfStateSpec::{IdealGas, StiffenedGas, Tait};
        let tait = |exponent| Tait { reference_density: 1.0, sound_speed: 1.0, exponent };
        for (spec, field) in [
            (tait(0.5), "exponent"),
            (tait(f64::NAN), "exponent"),
            (IdealGas { ratio: 1.0 }, "ratio"),
            (StiffenedGas { ratio: 2.0, stiffness: -1.0 }, "stiffness"),
            (
                EquationOfStateSpec::WeaklyCompressible {
                    reference_density: 0.0,
                    sound_speed: 1.0,
                },
                "reference_density",
            ),
        ] {
            let error = EquationOfState::<f64>::new(&spec).unwrap_err();
            assert_eq!(error.field, format!("equation_of_state.{field}"));
        }
    }
}
