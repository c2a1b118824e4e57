//! Standing gravity wave on a weakly compressible liquid in a closed tank, linear theory.
//!
//! About the equilibrium ρ̄ = ρ₀ e^{g (H − y)/c²} of p = c² (ρ − ρ₀) the velocity is ∇φ, and the enthalpy c² ln ρ
//! departs by −∂φ/∂t, so that
//!
//! ```text
//! ∂²φ/∂t² = c² ∇²φ − g ∂φ/∂y,   ∂φ/∂y = 0 at y = 0,   ∂²φ/∂t² + g ∂φ/∂y = 0 at y = H
//! φ = B F(y) cos(kx) cos(ωt),   F = e^{sy} (cosh qy − (s/q) sinh qy),   s = g/(2c²),  q² = s² + k² − ω²/c²
//! ω² (cosh qH − (s/q) sinh qH) = g ((k² − ω²/c²)/q) sinh qH
//! ```
//!
//! with F' = e^{sy} ((k² − ω²/c²)/q) sinh qy. For c → ∞ that is ω² = g k tanh kH and F = cosh ky, \[Lamb1932\]. The
//! surface η = a sin(ωt) cos(kx) is flat at t = 0, and there the pressure is that of the equilibrium. Valid for
//! a k ≪ 1; the frequency of a wave of finite height differs by a part of order (a k)².

/// A wave in a tank of length π/k or a multiple of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityWave {
    /// Amplitude of the surface a, m.
    pub amplitude: f64,
    /// Wave number k, 1/m.
    pub wave_number: f64,
    /// Depth H, m.
    pub depth: f64,
    /// Acceleration downwards g, m/s².
    pub gravity: f64,
    /// Speed of sound c, m/s.
    pub sound_speed: f64,
}

impl GravityWave {
    /// √(g k tanh kH), 1/s: the frequency without compressibility.
    pub fn incompressible_frequency(&self) -> f64 {
        (self.gravity * self.wave_number * (self.wave_number * self.depth).tanh()).sqrt()
    }

    /// ω, 1/s: the fixed point of the dispersion relation, from the frequency without compressibility.
    pub fn frequency(&self) -> f64 {
        let mut frequency = self.incompressible_frequency();
        // Each pass gains a factor g/(k c²); for c = 10 √(gH) that is a hundredth or less.
        for _ in 0..40 {
            let [value, slope] = self.profile_with(self.depth, frequency);
            frequency = (self.gravity * slope / value).sqrt();
        }
        frequency
    }

    /// F and F' (1/m) at a height, with a frequency.
    fn profile_with(&self, y: f64, frequency: f64) -> [f64; 2] {
        let square = self.wave_number.powi(2) - (frequency / self.sound_speed).powi(2);
        let s = 0.5 * self.gravity / self.sound_speed.powi(2);
        let q = (s * s + square).sqrt();
        let grown = (s * y).exp();
        [grown * ((q * y).cosh() - s / q * (q * y).sinh()), grown * square / q * (q * y).sinh()]
    }

    /// B, m²/s.
    fn strength(&self) -> f64 {
        let frequency = self.frequency();
        self.amplitude * frequency / self.profile_with(self.depth, frequency)[1]
    }

    /// The velocity where cos(ωt) = 1, m/s.
    pub fn shape(&self) -> Shape {
        Shape { wave: *self, frequency: self.frequency(), strength: self.strength() }
    }
}

/// The velocity field of the wave, its numbers found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    wave: GravityWave,
    frequency: f64,
    strength: f64,
}

impl Shape {
    /// ω, 1/s.
    pub fn frequency(&self) -> f64 {
        self.frequency
    }

    /// φ/cos(ωt), m²/s.
    pub fn potential(&self, [x, y]: [f64; 2]) -> f64 {
        let [value, _] = self.wave.profile_with(y, self.frequency);
        self.strength * value * (self.wave.wave_number * x).cos()
    }

    /// Velocity at t = 0, m/s: largest, with cos(ωt) as factor at other times.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let k = self.wave.wave_number;
        let [value, slope] = self.wave.profile_with(y, self.frequency);
        [-self.strength * k * value * (k * x).sin(), self.strength * slope * (k * x).cos()]
    }

    /// Its gradient `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub fn velocity_gradient(&self, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        let (k, g, c) = (self.wave.wave_number, self.wave.gravity, self.wave.sound_speed);
        let [value, slope] = self.wave.profile_with(y, self.frequency);
        // F'' = (g/c²) F' + (k² − ω²/c²) F.
        let bent = g / (c * c) * slope + (k * k - (self.frequency / c).powi(2)) * value;
        let (sine, cosine) = (k * x).sin_cos();
        let mixed = -self.strength * k * slope * sine;
        [[-self.strength * k * k * value * cosine, mixed], [mixed, self.strength * bent * cosine]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const WAVE: GravityWave = GravityWave {
        amplitude: 0.01,
        wave_number: PI,
        depth: 0.5,
        gravity: 9.81,
        sound_speed: 22.0,
    };

    #[test]
    fn it_solves_the_wave_equation_and_its_boundary_conditions() {
        let (shape, step) = (WAVE.shape(), 1e-4);
        let (omega, c, g) = (shape.frequency(), WAVE.sound_speed, WAVE.gravity);
        let phi = |x, y| shape.potential([x, y]);
        for (x, y) in [(0.1, 0.05), (0.37, 0.3), (0.9, 0.49)] {
            let along_y = (phi(x, y + step) - phi(x, y - step)) / (2.0 * step);
            let laplacian =
                (phi(x + step, y) + phi(x - step, y) + phi(x, y + step) + phi(x, y - step)
                    - 4.0 * phi(x, y))
                    / (step * step);
            let residual = -omega * omega * phi(x, y) - c * c * laplacian + g * along_y;
            assert!((residual / (c * c * PI * PI * phi(x, y))).abs() < 1e-5, "{residual}");
            assert!((shape.velocity([x, y])[1] / along_y - 1.0).abs() < 1e-6);
            let surface = -omega * omega * phi(x, 0.5) + g * shape.velocity([x, 0.5])[1];
            assert!((surface / (omega * omega * phi(x, 0.5))).abs() < 1e-13, "{surface}");
            assert_eq!(shape.velocity([x, 0.0])[1], 0.0);
            assert!(shape.velocity([1.0, y])[0].abs() < 1e-15);
        }
    }

    #[test]
    fn its_gradient_is_that_of_its_velocity() {
        let (shape, step) = (WAVE.shape(), 1e-5);
        let at = [0.3, 0.4];
        for j in 0..2 {
            let moved = |by: f64| {
                let mut place = at;
                place[j] += by;
                shape.velocity(place)
            };
            for i in 0..2 {
                let slope = (moved(step)[i] - moved(-step)[i]) / (2.0 * step);
                assert!((slope - shape.velocity_gradient(at)[i][j]).abs() < 1e-8, "{i} {j}");
            }
        }
    }

    /// ω rises to √(g k tanh kH); at c = 10 √(gH) it is 0.04 % below: elasticity takes 0.19 % off, stratification gives
    /// 0.15 % back.
    #[test]
    fn a_stiff_liquid_has_the_frequency_of_an_incompressible_one() {
        let stiff = GravityWave { sound_speed: 2e4, ..WAVE };
        assert!((stiff.frequency() / WAVE.incompressible_frequency() - 1.0).abs() < 1e-8);
        let ratio = WAVE.frequency() / WAVE.incompressible_frequency();
        assert!((0.9995..0.9997).contains(&ratio), "{ratio}");
        let surface = WAVE.shape().velocity([0.0, 0.5])[1];
        assert!((surface / (WAVE.amplitude * WAVE.frequency()) - 1.0).abs() < 1e-14);
    }
}
