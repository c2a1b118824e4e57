//! Standing acoustic wave between two walls.
//!
//! \[Song2020\], Eqs. (37) and (38), gives the solution of linear acoustics. The pressure law (35)
//! makes the fluid nonlinear in the strain, so the linear solution itself is wrong by a relative
//! A k ω t; [`StandingWave`] adds the term of second order in the amplitude, in Lagrangian form:
//!
//! ```text
//! x = X + u,   k = 2π/L,   ω = c₀ k
//! u(X, t) = A sin(kX) sin(ωt) + (A² k / 8) [1 − cos(2ωt) − ωt sin(2ωt)] sin(2kX)
//! ρ = ρ₀ / (1 + ∂u/∂X),   p = c₀² (ρ − ρ₀),   v = ∂u/∂t
//! ```
//!
//! What it leaves is of third order, (A k)² relative.

use std::f64::consts::TAU;

/// A standing wave of one wavelength between walls at x = 0 and x = L.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingWave {
    /// Amplitude A of the displacement, m.
    pub amplitude: f64,
    /// Length L of the domain, one wavelength, m.
    pub length: f64,
    /// Density at rest ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c₀, m/s.
    pub sound_speed: f64,
}

impl StandingWave {
    /// k = 2π / L, 1/m.
    pub fn wave_number(&self) -> f64 {
        TAU / self.length
    }

    /// ω = c₀ k, 1/s.
    pub fn angular_frequency(&self) -> f64 {
        self.sound_speed * self.wave_number()
    }

    /// T = L / c₀, s.
    pub fn period(&self) -> f64 {
        self.length / self.sound_speed
    }

    /// Displacement u of the material point X at time t, m.
    pub fn displacement(&self, material: f64, time: f64) -> f64 {
        let (k, a) = (self.wave_number(), self.amplitude);
        let second = a * a * k / 8.0 * self.modulation(time);
        let first = a * (self.angular_frequency() * time).sin();
        first * (k * material).sin() + second * (2.0 * k * material).sin()
    }

    /// Strain ∂u/∂X of the material point X at time t.
    pub fn strain(&self, material: f64, time: f64) -> f64 {
        let (k, a) = (self.wave_number(), self.amplitude);
        let second = a * a * k / 8.0 * self.modulation(time);
        let first = a * (self.angular_frequency() * time).sin();
        k * first * (k * material).cos() + 2.0 * k * second * (2.0 * k * material).cos()
    }

    /// Velocity ∂u/∂t of the material point X at time t, m/s.
    pub fn velocity(&self, material: f64, time: f64) -> f64 {
        let k = self.wave_number();
        let (first, second) = self.rates(time);
        first * (k * material).sin() + second * (2.0 * k * material).sin()
    }

    /// Velocity gradient ∂v/∂x = (∂v/∂X) / (1 + ∂u/∂X) of the material point X at time t, 1/s.
    pub fn velocity_gradient(&self, material: f64, time: f64) -> f64 {
        let k = self.wave_number();
        let (first, second) = self.rates(time);
        let slope =
            first * k * (k * material).cos() + second * 2.0 * k * (2.0 * k * material).cos();
        slope / (1.0 + self.strain(material, time))
    }

    /// Velocity amplitudes of the first and second harmonic, m/s.
    fn rates(&self, time: f64) -> (f64, f64) {
        let (k, a, w) = (self.wave_number(), self.amplitude, self.angular_frequency());
        let phase = 2.0 * w * time;
        let rate = w * (phase.sin() - phase * phase.cos());
        (a * w * (w * time).cos(), a * a * k / 8.0 * rate)
    }

    /// 1 − cos(2ωt) − ωt sin(2ωt).
    fn modulation(&self, time: f64) -> f64 {
        let phase = 2.0 * self.angular_frequency() * time;
        // 1 − cos φ as 2 sin²(φ/2), exact for small φ.
        2.0 * (0.5 * phase).sin().powi(2) - 0.5 * phase * phase.sin()
    }

    /// Density of the material point X at time t, kg/m³.
    pub fn density(&self, material: f64, time: f64) -> f64 {
        self.density / (1.0 + self.strain(material, time))
    }

    /// Pressure c₀² (ρ − ρ₀) of the material point X at time t, Pa; written without the difference
    /// of two nearly equal densities.
    pub fn pressure(&self, material: f64, time: f64) -> f64 {
        let strain = self.strain(material, time);
        -self.density * self.sound_speed.powi(2) * strain / (1.0 + strain)
    }

    /// Material point X that is at `position` at time t: Newton's method on X + u(X, t) = x.
    ///
    /// Valid while A k < 1, where the map is one to one.
    pub fn material(&self, position: f64, time: f64) -> f64 {
        let mut material = position;
        for _ in 0..20 {
            let residual = material + self.displacement(material, time) - position;
            material -= residual / (1.0 + self.strain(material, time));
            if residual.abs() <= f64::EPSILON * self.length {
                break;
            }
        }
        material
    }

    /// Pressure at a place, Pa.
    pub fn pressure_at(&self, position: f64, time: f64) -> f64 {
        self.pressure(self.material(position, time), time)
    }

    /// Velocity at a place, m/s.
    pub fn velocity_at(&self, position: f64, time: f64) -> f64 {
        self.velocity(self.material(position, time), time)
    }

    /// Velocity of linear acoustics, Eq. (37) of \[Song2020\], m/s.
    pub fn linear_velocity_at(&self, position: f64, time: f64) -> f64 {
        let (k, w) = (self.wave_number(), self.angular_frequency());
        self.amplitude * w * (k * position).sin() * (w * time).cos()
    }

    /// Pressure of linear acoustics, Eq. (38) of \[Song2020\] with ρ₀ for ρ, Pa.
    pub fn linear_pressure_at(&self, position: f64, time: f64) -> f64 {
        let (k, w) = (self.wave_number(), self.angular_frequency());
        let stiffness = self.density * self.sound_speed.powi(2);
        -stiffness * self.amplitude * k * (k * position).cos() * (w * time).sin()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(amplitude: f64) -> StandingWave {
        StandingWave { amplitude, length: 1.0, density: 1000.0, sound_speed: 50.0 }
    }

    /// Material points and fractions of a period that avoid the zeros of the wave.
    fn places() -> impl Iterator<Item = (f64, f64)> {
        (0..17).flat_map(|i| (1..9).map(move |j| (f64::from(i) / 16.0, 0.02 * f64::from(j) / 8.0)))
    }

    #[test]
    fn velocity_and_strain_are_derivatives_of_the_displacement() {
        let wave = wave(1e-2);
        let (dt, dx) = (1e-7, 1e-6);
        for (x, t) in places() {
            let rate = (wave.displacement(x, t + dt) - wave.displacement(x, t - dt)) / (2.0 * dt);
            let slope = (wave.displacement(x + dx, t) - wave.displacement(x - dx, t)) / (2.0 * dx);
            assert!((rate - wave.velocity(x, t)).abs() < 1e-7, "x = {x}, t = {t}");
            assert!((slope - wave.strain(x, t)).abs() < 1e-8, "x = {x}, t = {t}");
            let slope = (wave.velocity(x + dx, t) - wave.velocity(x - dx, t)) / (2.0 * dx);
            let gradient = slope / (1.0 + wave.strain(x, t));
            assert!((gradient - wave.velocity_gradient(x, t)).abs() < 1e-7, "x = {x}, t = {t}");
        }
    }

    /// Residual of ρ₀ ∂²u/∂t² = −∂p/∂X, relative to its largest term ρ₀ A ω².
    fn momentum_residual(amplitude: f64) -> f64 {
        let wave = wave(amplitude);
        let (dt, dx) = (1e-6, 1e-5);
        let scale = wave.density * amplitude * wave.angular_frequency().powi(2);
        places()
            .map(|(x, t)| {
                let dv = wave.velocity(x, t + dt) - wave.velocity(x, t - dt);
                let dp = wave.pressure(x + dx, t) - wave.pressure(x - dx, t);
                (wave.density * dv / (2.0 * dt) + dp / (2.0 * dx)).abs() / scale
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn momentum_balance_holds_to_second_order_in_the_amplitude() {
        let (large, small) = (momentum_residual(2e-3), momentum_residual(1e-3));
        assert!(small < 5e-4, "{small}");
        let order = (large / small).log2();
        assert!((order - 2.0).abs() < 0.05, "order {order}");
    }

    #[test]
    fn walls_do_not_move_and_the_start_is_as_prescribed() {
        let wave = wave(1e-3);
        for j in 0..9 {
            let t = 0.02 * f64::from(j) / 8.0;
            assert!(wave.velocity(0.0, t).abs() < 1e-12);
            assert!(wave.velocity(1.0, t).abs() < 1e-12);
        }
        for i in 0..9 {
            let x = f64::from(i) / 8.0;
            assert_eq!(wave.pressure_at(x, 0.0), 0.0);
            let start = TAU * 1e-3 / 0.02 * (TAU * x).sin();
            assert!((wave.velocity_at(x, 0.0) - start).abs() < 1e-12);
        }
    }

    #[test]
    fn material_inverts_the_motion() {
        let wave = wave(2e-2);
        for (x, t) in places() {
            let found = wave.material(x + wave.displacement(x, t), t);
            assert!((found - x).abs() < 1e-14, "x = {x}, t = {t}: {found}");
        }
    }

    #[test]
    fn linear_acoustics_is_within_two_in_a_hundred_thousand_at_the_instant_of_the_paper() {
        let wave = wave(1e-3);
        let t = 5e-6;
        let pressure = wave.linear_pressure_at(0.0, t).abs();
        let velocity = wave.linear_velocity_at(0.25, 0.0);
        for i in 0..=64 {
            let x = f64::from(i) / 64.0;
            let gap = wave.pressure_at(x, t) - wave.linear_pressure_at(x, t);
            assert!(gap.abs() < 2e-5 * pressure, "{x}: {gap}");
            let gap = wave.velocity_at(x, t) - wave.linear_velocity_at(x, t);
            assert!(gap.abs() < 2e-5 * velocity, "{x}: {gap}");
        }
    }
}
