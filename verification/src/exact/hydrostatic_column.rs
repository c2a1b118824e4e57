//! Column of a weakly compressible liquid at rest under gravity.
//!
//! dp/dy = −ρ g with p = c² (ρ − ρ₀), Eq. (35) of \[Song2020\], and p = 0 at the surface y = H:
//!
//! ```text
//! ρ(y) = ρ₀ e^{g (H − y)/c²},   p(y) = ρ₀ c² (e^{g (H − y)/c²} − 1)
//! ```

/// A column at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HydrostaticColumn {
    /// Height H, m.
    pub height: f64,
    /// Acceleration downwards g, m/s².
    pub gravity: f64,
    /// Density at the surface ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c, m/s.
    pub sound_speed: f64,
}

impl HydrostaticColumn {
    /// g/c², 1/m.
    fn rate(&self) -> f64 {
        self.gravity / (self.sound_speed * self.sound_speed)
    }

    /// Density ρ, kg/m³, at the height `position` (m).
    pub fn density(&self, position: f64) -> f64 {
        self.density * (self.rate() * (self.height - position)).exp()
    }

    /// Pressure p, Pa.
    pub fn pressure(&self, position: f64) -> f64 {
        let modulus = self.density * self.sound_speed * self.sound_speed;
        modulus * (self.rate() * (self.height - position)).exp_m1()
    }

    /// Mass per area between two heights, kg/m².
    pub fn mass(&self, lower: f64, upper: f64) -> f64 {
        self.density(upper) * (self.rate() * (upper - lower)).exp_m1() / self.rate()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMN: HydrostaticColumn =
        HydrostaticColumn { height: 0.8, gravity: 9.81, density: 1000.0, sound_speed: 12.0 };

    #[test]
    fn pressure_carries_the_weight_above() {
        for i in 0..8 {
            let y = 0.1 * f64::from(i);
            let weight = COLUMN.gravity * COLUMN.mass(y, COLUMN.height);
            assert!((COLUMN.pressure(y) / weight - 1.0).abs() < 1e-12);
            let law = COLUMN.sound_speed.powi(2) * (COLUMN.density(y) - COLUMN.density);
            assert!((COLUMN.pressure(y) / law - 1.0).abs() < 1e-12);
        }
        assert_eq!(COLUMN.pressure(COLUMN.height), 0.0);
        let parts = COLUMN.mass(0.0, 0.3) + COLUMN.mass(0.3, 0.8);
        assert!((parts / COLUMN.mass(0.0, 0.8) - 1.0).abs() < 1e-14);
    }

    /// p(0) = ρ₀ g H (1 + gH/2c² + …).
    #[test]
    fn a_stiff_liquid_has_the_pressure_of_an_incompressible_one() {
        let stiff = HydrostaticColumn { sound_speed: 100.0, ..COLUMN };
        let ratio = stiff.pressure(0.0) / (1000.0 * 9.81 * 0.8);
        assert!((ratio - 1.0 - 9.81 * 0.8 / 2e4).abs() < 1e-6, "{ratio}");
    }
}
