//! Decaying vortices in a periodic square, \[TaylorGreen1937\].
//!
//! ```text
//! u = −U cos(kx) sin(ky) e^{bt},   v = U sin(kx) cos(ky) e^{bt},   k = 2π/L,  b = −2 ν k²
//! p = −¼ ρ U² (cos(2kx) + cos(2ky)) e^{2bt}
//! ```
//!
//! An exact solution of the incompressible Navier-Stokes equations.

use std::f64::consts::TAU;

/// An array of vortices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorGreen {
    /// Largest velocity U at the start, m/s.
    pub speed: f64,
    /// Period L of the array, m.
    pub length: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Kinematic viscosity ν, m²/s.
    pub viscosity: f64,
}

impl TaylorGreen {
    fn wave_number(&self) -> f64 {
        TAU / self.length
    }

    /// U e^{bt}, m/s.
    pub fn largest_speed(&self, time: f64) -> f64 {
        self.speed * (-2.0 * self.viscosity * self.wave_number().powi(2) * time).exp()
    }

    /// Velocity, m/s.
    pub fn velocity(&self, [x, y]: [f64; 2], time: f64) -> [f64; 2] {
        let (k, speed) = (self.wave_number(), self.largest_speed(time));
        [-speed * (k * x).cos() * (k * y).sin(), speed * (k * x).sin() * (k * y).cos()]
    }

    /// Velocity gradient `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub fn velocity_gradient(&self, [x, y]: [f64; 2], time: f64) -> [[f64; 2]; 2] {
        let (k, speed) = (self.wave_number(), self.largest_speed(time));
        let (both_sines, both_cosines) =
            ((k * x).sin() * (k * y).sin() * k * speed, (k * x).cos() * (k * y).cos() * k * speed);
        [[both_sines, -both_cosines], [both_cosines, -both_sines]]
    }

    /// Pressure about its mean, Pa.
    pub fn pressure(&self, [x, y]: [f64; 2], time: f64) -> f64 {
        let k = 2.0 * self.wave_number();
        -0.25 * self.density * self.largest_speed(time).powi(2) * ((k * x).cos() + (k * y).cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOW: TaylorGreen =
        TaylorGreen { speed: 1.3, length: 0.8, density: 900.0, viscosity: 0.02 };

    /// ∂f/∂x by central differences.
    fn slope(f: impl Fn(f64) -> f64, at: f64) -> f64 {
        let step = 1e-5;
        (f(at + step) - f(at - step)) / (2.0 * step)
    }

    fn curvature(f: impl Fn(f64) -> f64, at: f64) -> f64 {
        let step = 1e-4;
        (f(at + step) - 2.0 * f(at) + f(at - step)) / (step * step)
    }

    #[test]
    fn it_solves_the_navier_stokes_equations() {
        for (x, y, t) in [(0.13, 0.41, 0.2), (0.7, 0.05, 0.0), (0.33, 0.66, 1.0)] {
            let [u, v] = FLOW.velocity([x, y], t);
            for i in 0..2 {
                let component = |x, y, t| FLOW.velocity([x, y], t)[i];
                let rate = slope(|t| component(x, y, t), t);
                let [along_x, along_y] =
                    [slope(|x| component(x, y, t), x), slope(|y| component(x, y, t), y)];
                let pressure = if i == 0 {
                    slope(|x| FLOW.pressure([x, y], t), x)
                } else {
                    slope(|y| FLOW.pressure([x, y], t), y)
                };
                let diffusion =
                    curvature(|x| component(x, y, t), x) + curvature(|y| component(x, y, t), y);
                let residual = rate + u * along_x + v * along_y + pressure / FLOW.density
                    - FLOW.viscosity * diffusion;
                assert!(residual.abs() < 1e-5, "{residual}");
                let gradient = FLOW.velocity_gradient([x, y], t)[i];
                assert!((gradient[0] - along_x).abs() < 1e-7);
                assert!((gradient[1] - along_y).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn it_has_no_divergence() {
        let gradient = FLOW.velocity_gradient([0.21, 0.37], 0.4);
        assert_eq!(gradient[0][0] + gradient[1][1], 0.0);
    }
}
