//! Plane acoustic pulse from rest: d'Alembert's solution.
//!
//! Linear acoustics, \[MorseIngard1968\], for an initial pressure P(x) and no velocity:
//!
//! ```text
//! ∂p/∂t + ρ₀ c₀² ∂u/∂x = 0,   ρ₀ ∂u/∂t + ∂p/∂x = 0
//! p(x, t) = [P(x − c₀t) + P(x + c₀t)] / 2
//! u(x, t) = [P(x − c₀t) − P(x + c₀t)] / (2 ρ₀ c₀)
//! ```
//!
//! On an infinite line for any P; on a periodic domain for a periodic P. Valid for p ≪ ρ₀c₀²: the
//! pressure law Eq. (35) of \[Song2020\] adds relative errors of that order that grow with time.

/// A Gaussian P(x) = A exp(−a (x − x₀)²), alone or repeated with a period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianBump {
    /// Amplitude A, Pa.
    pub amplitude: f64,
    /// Decay a, 1/m²; the standard deviation is 1/√(2a).
    pub decay: f64,
    /// Center x₀, m.
    pub center: f64,
    /// Length of the periodic domain, m; `None` for an infinite line.
    pub period: Option<f64>,
}

impl GaussianBump {
    /// P at a place, Pa; in a periodic domain the sum over the images that count, 1000 a side at most.
    pub fn value(&self, position: f64) -> f64 {
        let offset = position - self.center;
        let Some(period) = self.period else { return self.single(offset) };
        // exp(−a r²) is below 1e-17 of the amplitude beyond r = √(40/a).
        let reach = (40.0 / self.decay).sqrt();
        let near = offset - period * (offset / period).round();
        let n_images = (reach / period + 0.5).ceil().min(1e3) as i32;
        (-n_images..=n_images).map(|i| self.single(near + f64::from(i) * period)).sum()
    }

    fn single(&self, offset: f64) -> f64 {
        self.amplitude * (-self.decay * offset * offset).exp()
    }
}

/// The two waves into which an initial pressure P splits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePulse<P> {
    /// Initial pressure P(x), Pa over m.
    pub initial: P,
    /// Density at rest ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c₀, m/s.
    pub sound_speed: f64,
}

impl<P: Fn(f64) -> f64> PlanePulse<P> {
    /// Pressure p, Pa.
    pub fn pressure(&self, position: f64, time: f64) -> f64 {
        let [right, left] = self.waves(position, time);
        right + left
    }

    /// Velocity u, m/s.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let [right, left] = self.waves(position, time);
        (right - left) / (self.density * self.sound_speed)
    }

    /// Pressure of the wave to the right and of the wave to the left, Pa.
    fn waves(&self, position: f64, time: f64) -> [f64; 2] {
        let path = self.sound_speed * time;
        [position - path, position + path].map(|x| 0.5 * (self.initial)(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RHO: f64 = 1000.0;
    const C: f64 = 50.0;

    fn bump(period: Option<f64>) -> GaussianBump {
        GaussianBump { amplitude: 100.0, decay: 200.0, center: 0.4, period }
    }

    fn pulse(period: Option<f64>) -> PlanePulse<impl Fn(f64) -> f64> {
        let bump = bump(period);
        PlanePulse { initial: move |x| bump.value(x), density: RHO, sound_speed: C }
    }

    fn places() -> impl Iterator<Item = (f64, f64)> {
        (0..21).flat_map(|i| (0..9).map(move |j| (f64::from(i) / 20.0, 7e-3 * f64::from(j))))
    }

    #[test]
    fn linear_acoustics_holds() {
        for pulse in [pulse(None), pulse(Some(1.0))] {
            let (dx, dt) = (1e-5, 1e-5 / C);
            // Largest slope of the pressure: A √(2a/e) / 2.
            let steepest = 50.0 * (400.0f64 / 1.0f64.exp()).sqrt();
            for (x, t) in places() {
                let p_t = (pulse.pressure(x, t + dt) - pulse.pressure(x, t - dt)) / (2.0 * dt);
                let p_x = (pulse.pressure(x + dx, t) - pulse.pressure(x - dx, t)) / (2.0 * dx);
                let u_t = (pulse.velocity(x, t + dt) - pulse.velocity(x, t - dt)) / (2.0 * dt);
                let u_x = (pulse.velocity(x + dx, t) - pulse.velocity(x - dx, t)) / (2.0 * dx);
                assert!((p_t + RHO * C * C * u_x).abs() < 1e-6 * C * steepest, "{x} {t}");
                assert!((RHO * u_t + p_x).abs() < 1e-6 * steepest, "{x} {t}");
            }
        }
    }

    #[test]
    fn it_starts_from_rest_with_the_bump() {
        let pulse = pulse(None);
        for (x, _) in places() {
            assert_eq!(pulse.velocity(x, 0.0), 0.0);
            let bump = 100.0 * (-200.0 * (x - 0.4f64).powi(2)).exp();
            assert!((pulse.pressure(x, 0.0) - bump).abs() < 1e-12);
        }
    }

    #[test]
    fn a_periodic_pulse_returns_after_the_length_over_the_speed() {
        let pulse = pulse(Some(1.0));
        for (x, t) in places() {
            for (a, b) in [
                (pulse.pressure(x, t), pulse.pressure(x + 3.0, t)),
                (pulse.pressure(x, t), pulse.pressure(x, t + 1.0 / C)),
            ] {
                assert!((a - b).abs() < 1e-10, "{x} {t}: {a} {b}");
            }
            let (a, b) = (pulse.velocity(x, t), pulse.velocity(x, t + 1.0 / C));
            assert!((a - b).abs() < 1e-15, "{x} {t}: {a} {b}");
        }
    }

    #[test]
    fn mass_momentum_and_energy_stay() {
        let pulse = pulse(Some(1.0));
        let total = |t: f64| {
            let n = 400;
            let mut sums = [0.0; 3];
            for i in 0..n {
                let x = f64::from(i) / f64::from(n);
                let (p, u) = (pulse.pressure(x, t), pulse.velocity(x, t));
                let energy = 0.5 * p * p / (RHO * C * C) + 0.5 * RHO * u * u;
                for (sum, q) in sums.iter_mut().zip([p / (C * C), RHO * u, energy]) {
                    *sum += q / f64::from(n);
                }
            }
            sums
        };
        let start = total(0.0);
        // ∫ A exp(−a x²) dx = A √(π/a).
        let mass = 100.0 * (std::f64::consts::PI / 200.0).sqrt() / (C * C);
        assert!((start[0] / mass - 1.0).abs() < 1e-14);
        for t in [1e-3, 3.3e-3, 0.017, 0.4] {
            let now = total(t);
            assert!((now[0] / mass - 1.0).abs() < 1e-13);
            assert!(now[1].abs() < 1e-13 * mass * C);
            assert!((now[2] / start[2] - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_bump_wider_than_the_domain_overlaps_its_images() {
        let wide = GaussianBump { amplitude: 1.0, decay: 0.5, center: 0.3, period: Some(1.0) };
        let direct = |x: f64| -> f64 {
            (-40..=40).map(|i| (-0.5 * (x - 0.3 + f64::from(i)).powi(2)).exp()).sum()
        };
        for i in 0..10 {
            let x = f64::from(i) / 10.0;
            assert!((wide.value(x) - direct(x)).abs() < 1e-14);
        }
    }
}
