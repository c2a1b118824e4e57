//! A steady plane jet of a liquid without viscosity and weight hits a plate at a right angle,
//! \[MilneThomson1968\].
//!
//! Far away the jet has the width b and the speed U. On the free streamlines the pressure is zero and the
//! speed U, so that the complex velocity ζ = (u − iv)/U of one half maps it to a quarter of the unit disc:
//!
//! ```text
//! x + iy = (2b/π) (artanh ζ + arctan ζ)
//! plate, ζ = q:            x = (2b/π) (artanh q + arctan q),   p = ½ ρ U² (1 − q²)
//! free surface, ζ = e^{iα}: x = b/2 + (b/π) ln cot(α/2),   y = b/2 + (b/π) ln tan(α/2 + π/4)
//! force: ∫ p dx = ρ U² b
//! ```
//!
//! The plate is y = 0, the jet comes down the axis x = 0, and a sheet of the thickness b/2 leaves on either side.

use std::f64::consts::{FRAC_PI_4, PI};

use nalgebra::Complex;

/// Steps along the way from the stagnation point to a place, and of Newton's method after it.
const PATH_STEPS: u32 = 64;
const NEWTON_STEPS: usize = 20;

/// The flow at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// Velocity, m/s.
    pub velocity: [f64; 2],
    /// `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub velocity_gradient: [[f64; 2]; 2],
    /// Pressure, Pa.
    pub pressure: f64,
}

/// A jet on a plate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JetOnPlate {
    /// Width b, m.
    pub width: f64,
    /// Speed U, m/s.
    pub speed: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
}

impl JetOnPlate {
    /// Pressure at the stagnation point ½ ρ U², Pa.
    pub fn stagnation_pressure(&self) -> f64 {
        0.5 * self.density * self.speed * self.speed
    }

    /// Force on the plate per depth ρ U² b, N/m.
    pub fn force(&self) -> f64 {
        self.density * self.speed * self.speed * self.width
    }

    /// Distance from the axis (m) at which the speed along the plate is `q` U, 0 ≤ q < 1.
    pub fn position(&self, q: f64) -> f64 {
        2.0 * self.width / PI * (q.atanh() + q.atan())
    }

    /// Speed along the plate over U at the distance `x` (m) from the axis.
    pub fn speed_ratio(&self, x: f64) -> f64 {
        // In r = artanh q the left-hand side r + arctan tanh r is monotonic with a slope from 1 to 2, so that
        // Newton's method does not overshoot.
        let target = PI * x.abs() / (2.0 * self.width);
        let mut r = 0.5 * target;
        for _ in 0..60 {
            let q = r.tanh();
            let slope = 1.0 + (1.0 - q * q) / (1.0 + q * q);
            let change = (target - r - q.atan()) / slope;
            r += change;
            if change.abs() <= 1e-15 * (1.0 + r) {
                break;
            }
        }
        r.tanh()
    }

    /// Pressure on the plate at the distance `x` (m) from the axis, Pa.
    pub fn pressure(&self, x: f64) -> f64 {
        let q = self.speed_ratio(x);
        self.stagnation_pressure() * (1.0 - q) * (1.0 + q)
    }

    /// The flow at a place in the right half, 0 ≤ x and 0 ≤ y; `None` outside of the liquid.
    pub fn at(&self, [x, y]: [f64; 2]) -> Option<Flow> {
        let z = Complex::new(x, y);
        let rate = PI / (4.0 * self.width);
        let slope = |zeta: Complex<f64>| (Complex::new(1.0, 0.0) - zeta.powi(4)) * rate;
        // dζ/dz along the line from the stagnation point, on which the liquid is all on one side of the surface.
        let step = z / f64::from(PATH_STEPS);
        let mut zeta = Complex::new(0.0, 0.0);
        for _ in 0..PATH_STEPS {
            let middle = zeta + slope(zeta) * step * 0.5;
            zeta += slope(middle) * step;
        }
        for _ in 0..NEWTON_STEPS {
            let change = (z - (zeta.atanh() + zeta.atan()) * (2.0 * self.width / PI)) * slope(zeta);
            zeta += change;
            if change.norm() <= 1e-15 {
                break;
            }
        }
        // Also refuses what is not a number.
        if !(zeta.norm_sqr() <= 1.0) {
            return None;
        }
        let gradient = slope(zeta) * self.speed;
        Some(Flow {
            velocity: [self.speed * zeta.re, -self.speed * zeta.im],
            velocity_gradient: [[gradient.re, -gradient.im], [-gradient.im, -gradient.re]],
            pressure: self.stagnation_pressure() * (1.0 - zeta.norm_sqr()),
        })
    }

    /// Place (x, y) of the free surface on the right (m) where the velocity points down the plate at
    /// `alpha` below it, 0 < α < π/2.
    pub fn surface(&self, alpha: f64) -> [f64; 2] {
        let [cot, tan] = [1.0 / (0.5 * alpha).tan(), (0.5 * alpha + FRAC_PI_4).tan()];
        [cot, tan].map(|ratio| self.width * (0.5 + ratio.ln() / PI))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::quadrature::Panels;

    const JET: JetOnPlate = JetOnPlate { width: 0.3, speed: 2.0, density: 800.0 };

    #[test]
    fn the_fluid_rests_at_the_axis_and_is_free_far_away() {
        assert_eq!(JET.pressure(0.0), 1600.0);
        assert_eq!(JET.pressure(-0.2), JET.pressure(0.2));
        // 1 − q² ≈ 4 e^{−2r}, r = πx/2b − π/4.
        let far = 4.0 * JET.width;
        let tail = 4.0 * (-PI * far / JET.width + 0.5 * PI).exp();
        assert!((JET.pressure(far) / (1600.0 * tail) - 1.0).abs() < 1e-3);
        assert!(JET.pressure(1e3) < 1e-12);
    }

    #[test]
    fn the_inverse_is_one() {
        for k in 0..100 {
            let q = f64::from(k) / 100.0;
            assert!((JET.speed_ratio(JET.position(q)) - q).abs() < 1e-14, "{q}");
        }
    }

    /// ∫ p dx over the plate.
    #[test]
    fn the_force_is_the_momentum_of_the_jet() {
        let half = Panels::new(0.0, 8.0 * JET.width, 40.0).integrate(|x| JET.pressure(x));
        assert!((2.0 * half / JET.force() - 1.0).abs() < 1e-10, "{half}");
    }

    /// On the surface dz is parallel to the velocity, whose speed is U; between the surface and the wall
    /// passes half of the jet.
    #[test]
    fn the_surface_is_a_streamline_from_the_jet_to_the_sheet() {
        for k in 1..50 {
            let alpha = 0.5 * PI * f64::from(k) / 50.0;
            let d = 1e-6;
            let [a, b] = [JET.surface(alpha + d), JET.surface(alpha - d)];
            let slope = (b[1] - a[1]) / (b[0] - a[0]);
            assert!((slope / -alpha.tan() - 1.0).abs() < 1e-6, "{alpha}: {slope}");
        }
        let [jet, sheet] = [JET.surface(0.5 * PI - 1e-4), JET.surface(1e-4)];
        assert!((jet[0] - 0.15).abs() < 1e-4 && jet[1] > 3.0 * JET.width);
        assert!((sheet[1] - 0.15).abs() < 1e-4 && sheet[0] > 3.0 * JET.width);
        // Half way the surface is as far from the plate as from the axis.
        let [x, y] = JET.surface(FRAC_PI_4);
        assert!((x - y).abs() < 1e-14);
    }

    /// The relation of the parametric form with the hodograph: x + iy at ζ = e^{iα} by real parts of the
    /// series of artanh and arctan inside of the disc, ζ = r e^{iα}, as r → 1.
    #[test]
    fn the_surface_is_the_edge_of_the_hodograph() {
        let (alpha, r) = (0.9_f64, 1.0_f64 - 1e-5);
        let (mut x, mut y) = (0.0, 0.0);
        // artanh ζ + arctan ζ = 2 Σ ζ^{4n+1}/(4n+1).
        let mut n = 1.0_f64;
        while r.powf(n) > 1e-12 {
            let scale = 4.0 * JET.width / PI * r.powf(n) / n;
            x += scale * (n * alpha).cos();
            y += scale * (n * alpha).sin();
            n += 4.0;
        }
        let [found_x, found_y] = JET.surface(alpha);
        assert!((x - found_x).abs() < 1e-4 && (y - found_y).abs() < 1e-4, "{x} {y}");
    }

    /// On the plate and on the axis the flow is the parametric one, beyond the surface there is none, and
    /// Bernoulli's equation and the gradient hold inside.
    #[test]
    fn the_flow_is_that_of_the_plate_the_axis_and_the_surface() {
        for k in 0..30 {
            let x = 0.03 * f64::from(k);
            let [plate, axis] = [[x, 0.0], [0.0, x]].map(|place| JET.at(place).expect("liquid"));
            assert!((plate.pressure / JET.pressure(x) - 1.0).abs() < 1e-9, "{x}");
            let speed = JET.speed * JET.speed_ratio(x);
            assert!((plate.velocity[0] - speed).abs() < 1e-12 && plate.velocity[1].abs() < 1e-12);
            assert!((axis.velocity[1] + speed).abs() < 1e-12 && axis.velocity[0].abs() < 1e-12);
        }
        for k in 1..20 {
            let [x, y] = JET.surface(0.5 * PI * f64::from(k) / 20.0);
            assert!(JET.at([1.01 * x, 1.01 * y]).is_none());
            let place = [0.9 * x, 0.95 * y];
            let flow = JET.at(place).expect("liquid");
            let speed: f64 = flow.velocity.iter().map(|v| v * v).sum();
            let total = flow.pressure + 0.5 * JET.density * speed;
            assert!((total / JET.stagnation_pressure() - 1.0).abs() < 1e-12);
            for axis in 0..2 {
                let moved = |d: f64| {
                    let mut to = place;
                    to[axis] += d;
                    JET.at(to).expect("liquid").velocity
                };
                let [a, b] = [moved(-1e-6), moved(1e-6)];
                for row in 0..2 {
                    let slope = (b[row] - a[row]) / 2e-6;
                    assert!((slope - flow.velocity_gradient[row][axis]).abs() < 1e-6, "{place:?}");
                }
            }
        }
    }
}
