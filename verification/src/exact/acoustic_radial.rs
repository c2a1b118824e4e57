//! Cylindrical acoustic pulse from rest with a Gaussian start.
//!
//! Linear acoustics in the plane, \[MorseIngard1968\], p(r, 0) = A exp(−a r²), by Hankel's transform:
//!
//! ```text
//! p(r, t) = ∫₀^∞ (A/2a) exp(−k²/4a) cos(c₀kt) J₀(kr) k dk
//! u(r, t) = ∫₀^∞ (A/2a) exp(−k²/4a) sin(c₀kt) J₁(kr) k dk / (ρ₀ c₀)
//! ∂p/∂t + ρ₀ c₀² (1/r) ∂(ru)/∂r = 0,   ρ₀ ∂u/∂t + ∂p/∂r = 0
//! ```
//!
//! Quadrature by Gauss-Legendre panels, each over at most 8 rad of phase; absolute error of p below
//! 1e-14 A. In a box the solution holds until the pulse reaches a wall or its own image.

use super::quadrature::Panels;

/// A Gaussian bump of pressure about the origin, released from rest at t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialPulse {
    /// Amplitude A, Pa.
    pub amplitude: f64,
    /// Decay a, 1/m²; the standard deviation is 1/√(2a).
    pub decay: f64,
    /// Density at rest ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c₀, m/s.
    pub sound_speed: f64,
}

impl RadialPulse {
    /// Pressure p at the radius r ≥ 0, Pa.
    pub fn pressure(&self, radius: f64, time: f64) -> f64 {
        let path = self.sound_speed * time;
        self.integral(radius, time, |k| (k * path).cos() * libm::j0(k * radius))
    }

    /// Radial velocity u at the radius r ≥ 0, m/s.
    pub fn velocity(&self, radius: f64, time: f64) -> f64 {
        let path = self.sound_speed * time;
        self.integral(radius, time, |k| (k * path).sin() * libm::j1(k * radius))
            / (self.density * self.sound_speed)
    }

    /// ∫ (A/2a) exp(−k²/4a) f(k) k dk, with κ = k / 2√a as the variable.
    fn integral(&self, radius: f64, time: f64, f: impl Fn(f64) -> f64) -> f64 {
        let scale = 2.0 * self.decay.sqrt();
        let phase = scale * (radius.abs() + (self.sound_speed * time).abs());
        // exp(−κ²) κ is below 1e-17 beyond 6.4.
        let end = 6.4;
        let panels = Panels::new(0.0, end, (end * phase / 8.0).max(8.0));
        panels.integrate(|kappa| {
            2.0 * self.amplitude * (-kappa * kappa).exp() * kappa * f(scale * kappa)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn pulse() -> RadialPulse {
        RadialPulse { amplitude: 100.0, decay: 200.0, density: 1000.0, sound_speed: 50.0 }
    }

    fn places() -> impl Iterator<Item = (f64, f64)> {
        (0..13).flat_map(|i| (0..7).map(move |j| (0.05 * f64::from(i), 2e-3 * f64::from(j))))
    }

    #[test]
    fn it_starts_from_rest_with_the_bump() {
        for (r, _) in places() {
            let bump = 100.0 * (-200.0 * r * r).exp();
            assert!((pulse().pressure(r, 0.0) - bump).abs() < 2e-13, "{r}");
            assert_eq!(pulse().velocity(r, 0.0), 0.0);
        }
    }

    #[test]
    fn linear_acoustics_holds() {
        let pulse = pulse();
        let (dr, dt) = (1e-4, 1e-4 / 50.0);
        // Central differences of fourth order.
        let slope = |f: &dyn Fn(f64) -> f64, d: f64| {
            (8.0 * (f(d) - f(-d)) - (f(2.0 * d) - f(-2.0 * d))) / (12.0 * d)
        };
        let steepest = 100.0 * 400.0f64.sqrt();
        for (r, t) in places().filter(|&(r, _)| r > 0.0) {
            let p_t = slope(&|d| pulse.pressure(r, t + d), dt);
            let p_r = slope(&|d| pulse.pressure(r + d, t), dr);
            let u_t = slope(&|d| pulse.velocity(r, t + d), dt);
            let flux = slope(&|d| (r + d) * pulse.velocity(r + d, t), dr);
            assert!((p_t + 1000.0 * 2500.0 * flux / r).abs() < 1e-8 * 50.0 * steepest, "{r} {t}");
            assert!((1000.0 * u_t + p_r).abs() < 1e-8 * steepest, "{r} {t}");
        }
    }

    #[test]
    fn wave_equation_holds_in_the_plane() {
        // p_tt = c² (p_xx + p_yy) at places on no axis, fourth-order differences.
        let pulse = pulse();
        let d = 2e-3;
        let second = |f: &dyn Fn(f64) -> f64| {
            (16.0 * (f(d) + f(-d)) - f(2.0 * d) - f(-2.0 * d) - 30.0 * f(0.0)) / (12.0 * d * d)
        };
        let at = |x: f64, y: f64, path: f64| pulse.pressure(x.hypot(y), path / 50.0);
        for (x, y, path) in [(0.03, 0.02, 0.1), (0.2, -0.1, 0.2), (0.1, 0.3, 0.35), (0.0, 0.0, 0.1)]
        {
            let p_tt = second(&|d| at(x, y, path + d));
            let laplacian = second(&|d| at(x + d, y, path)) + second(&|d| at(x, y + d, path));
            // Of the size of A a = 2e4 Pa/m².
            assert!((p_tt - laplacian).abs() < 1.0, "{x} {y} {path}: {p_tt} {laplacian}");
        }
    }

    #[test]
    fn mass_stays() {
        let pulse = pulse();
        for t in [0.0, 1e-3, 4e-3, 1e-2] {
            let end = 0.5 + 50.0 * t;
            let sum = Panels::new(0.0, end, 60.0).integrate(|r| pulse.pressure(r, t) * TAU * r);
            let mass = 100.0 * PI / 200.0;
            assert!((sum / mass - 1.0).abs() < 1e-12, "{t}: {sum} {mass}");
        }
    }

    #[test]
    fn it_is_the_mean_of_plane_waves_over_all_directions() {
        // A Gaussian is the mean over directions of G(s) = A (1 − 2z D(z)), z = √a s, with D
        // Dawson's integral exp(−z²) ∫₀^z exp(y²) dy; each G travels by d'Alembert.
        let pulse = pulse();
        let plane = |s: f64| {
            let z = 200.0f64.sqrt() * s;
            let dawson =
                Panels::new(0.0, 1.0, 20.0).integrate(|q| z * ((q * q - 1.0) * z * z).exp());
            100.0 * (1.0 - 2.0 * z * dawson)
        };
        for (r, t) in [(0.0, 1e-3), (0.1, 2e-3), (0.2, 3e-3), (0.05, 6e-3)] {
            let n = 200;
            let mean = (0..n)
                .map(|i| plane(r * (TAU * (f64::from(i) + 0.5) / f64::from(n)).cos() + 50.0 * t))
                .sum::<f64>()
                / f64::from(n);
            assert!((mean - pulse.pressure(r, t)).abs() < 1e-12, "{r} {t}: {mean}");
        }
    }
}
