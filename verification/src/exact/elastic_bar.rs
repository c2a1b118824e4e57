//! Standing longitudinal wave of an elastic bar in uniaxial strain between fixed ends.
//!
//! Linear theory, \[Graff1975\]: σ = (K + 4G/3) ε, ρ₀ ∂²u/∂t² = ∂σ/∂x, u = 0 at x = 0 and x = L.
//!
//! ```text
//! k = nπ/L,   ω = c k,   c² = (K + 4G/3) / ρ₀
//! v(x, t) = V sin(kx) cos(ωt),   u(x, t) = (V/ω) sin(kx) sin(ωt),   ε = ∂u/∂x
//! ```
//!
//! Valid for |ε| ≤ V/c ≪ 1.

use std::f64::consts::PI;

/// A bar that starts undeformed with the velocity V sin(nπx/L).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticBar {
    /// Amplitude V of the velocity, m/s.
    pub amplitude: f64,
    /// Number n of half waves, 1 or more.
    pub mode: u32,
    /// Length L, m.
    pub length: f64,
    /// Density at rest ρ₀, kg/m³.
    pub density: f64,
    /// Bulk modulus K, Pa.
    pub bulk_modulus: f64,
    /// Shear modulus G, Pa.
    pub shear_modulus: f64,
}

impl ElasticBar {
    /// Modulus of uniaxial strain K + 4G/3, Pa.
    pub fn modulus(&self) -> f64 {
        self.bulk_modulus + 4.0 / 3.0 * self.shear_modulus
    }

    /// Wave speed c = √((K + 4G/3) / ρ₀), m/s.
    pub fn wave_speed(&self) -> f64 {
        (self.modulus() / self.density).sqrt()
    }

    /// k = nπ/L, 1/m.
    pub fn wave_number(&self) -> f64 {
        f64::from(self.mode) * PI / self.length
    }

    /// ω = c k, 1/s.
    pub fn angular_frequency(&self) -> f64 {
        self.wave_speed() * self.wave_number()
    }

    /// T = 2L / (n c), s.
    pub fn period(&self) -> f64 {
        2.0 * PI / self.angular_frequency()
    }

    /// Displacement u, m.
    pub fn displacement(&self, position: f64, time: f64) -> f64 {
        let (k, w) = (self.wave_number(), self.angular_frequency());
        self.amplitude / w * (k * position).sin() * (w * time).sin()
    }

    /// Velocity v = ∂u/∂t, m/s.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let (k, w) = (self.wave_number(), self.angular_frequency());
        self.amplitude * (k * position).sin() * (w * time).cos()
    }

    /// Strain ε = ∂u/∂x.
    pub fn strain(&self, position: f64, time: f64) -> f64 {
        let (k, w) = (self.wave_number(), self.angular_frequency());
        self.amplitude / self.wave_speed() * (k * position).cos() * (w * time).sin()
    }

    /// Axial stress σ = (K + 4G/3) ε = s_xx − p, positive in tension, Pa.
    pub fn stress(&self, position: f64, time: f64) -> f64 {
        self.modulus() * self.strain(position, time)
    }

    /// Pressure p = −K ε, positive in compression, Pa.
    pub fn pressure(&self, position: f64, time: f64) -> f64 {
        -self.bulk_modulus * self.strain(position, time)
    }

    /// Axial deviatoric stress s_xx = (4/3) G ε, Pa.
    pub fn deviatoric_axial(&self, position: f64, time: f64) -> f64 {
        4.0 / 3.0 * self.shear_modulus * self.strain(position, time)
    }

    /// Lateral deviatoric stress s_yy = s_zz = −(2/3) G ε, Pa.
    pub fn deviatoric_lateral(&self, position: f64, time: f64) -> f64 {
        -2.0 / 3.0 * self.shear_modulus * self.strain(position, time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar() -> ElasticBar {
        ElasticBar {
            amplitude: 0.1,
            mode: 3,
            length: 2.0,
            density: 1000.0,
            bulk_modulus: 2.0e6,
            shear_modulus: 0.5e6,
        }
    }

    fn places(bar: &ElasticBar) -> impl Iterator<Item = (f64, f64)> {
        let (length, period) = (bar.length, bar.period());
        (1..12).flat_map(move |i| {
            (0..9).map(move |j| (length * f64::from(i) / 12.0, period * f64::from(j) / 7.0))
        })
    }

    #[test]
    fn momentum_balance_and_kinematics_hold() {
        let bar = bar();
        let (dx, dt) = (1e-5, 1e-7);
        let peak = bar.density * bar.amplitude * bar.angular_frequency();
        for (x, t) in places(&bar) {
            let rate = (bar.velocity(x, t + dt) - bar.velocity(x, t - dt)) / (2.0 * dt);
            let slope = (bar.stress(x + dx, t) - bar.stress(x - dx, t)) / (2.0 * dx);
            assert!((bar.density * rate - slope).abs() < 1e-6 * peak, "x = {x}, t = {t}");
            let rate = (bar.displacement(x, t + dt) - bar.displacement(x, t - dt)) / (2.0 * dt);
            assert!((rate - bar.velocity(x, t)).abs() < 1e-7 * bar.amplitude);
            let slope = (bar.displacement(x + dx, t) - bar.displacement(x - dx, t)) / (2.0 * dx);
            assert!((slope - bar.strain(x, t)).abs() < 1e-7 * bar.amplitude / bar.wave_speed());
        }
    }

    #[test]
    fn stress_splits_into_pressure_and_a_traceless_part() {
        let bar = bar();
        for (x, t) in places(&bar) {
            let (axial, lateral) = (bar.deviatoric_axial(x, t), bar.deviatoric_lateral(x, t));
            assert!((axial + 2.0 * lateral).abs() < 1e-9);
            assert!((axial - bar.pressure(x, t) - bar.stress(x, t)).abs() < 1e-9);
            // Hooke's law of an isotropic solid: σ_xx − σ_yy = 2G (ε_xx − ε_yy).
            assert!((axial - lateral - 2.0 * bar.shear_modulus * bar.strain(x, t)).abs() < 1e-9);
        }
    }

    #[test]
    fn ends_are_fixed_and_the_start_is_undeformed() {
        let bar = bar();
        for j in 0..9 {
            let t = bar.period() * f64::from(j) / 7.0;
            for end in [0.0, bar.length] {
                assert!(bar.velocity(end, t).abs() < 1e-15);
                assert!(bar.displacement(end, t).abs() < 1e-15);
            }
        }
        for (x, _) in places(&bar) {
            assert_eq!((bar.displacement(x, 0.0), bar.stress(x, 0.0)), (0.0, 0.0));
            assert_eq!(bar.velocity(x, 0.0), 0.1 * (1.5 * PI * x).sin());
        }
        assert!((bar.period() - 2.0 * 2.0 / (3.0 * bar.wave_speed())).abs() < 1e-15);
    }
}
