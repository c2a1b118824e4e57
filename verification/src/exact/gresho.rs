//! The steady vortex of \[GreshoChan1990\], carried along with a uniform velocity.
//!
//! With U = 1 m/s and R = 0.2 m, s = r/R:
//!
//! ```text
//! u_θ/U = s,  2 − s,  0              for s < 1,  1 ≤ s < 2,  2 ≤ s
//! p/(ρU²) = s²/2 + 2 − 4 ln 2,  s²/2 − 4s + 4 ln(s/2) + 6,  0
//! ```
//!
//! dp/dr = ρ u_θ²/r. An exact solution of the Euler equations of an incompressible fluid, with kinks of the velocity at
//! s = 1 and 2. The pressure is taken over that far away.

use std::f64::consts::{LN_2, PI};

/// A vortex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gresho {
    /// Radius R of the largest velocity, m.
    pub radius: f64,
    /// Largest velocity U, m/s.
    pub speed: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
}

impl Gresho {
    /// u_θ, m/s.
    pub fn swirl(&self, r: f64) -> f64 {
        let s = r / self.radius;
        self.speed * if s < 1.0 { s } else { (2.0 - s).max(0.0) }
    }

    /// Velocity at a place relative to the center, m/s.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let r = x.hypot(y).max(f64::MIN_POSITIVE);
        let rate = self.swirl(r) / r;
        [-rate * y, rate * x]
    }

    /// Its gradient `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub fn velocity_gradient(&self, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        let r = x.hypot(y).max(f64::MIN_POSITIVE);
        let rate = self.swirl(r) / r;
        let s = r / self.radius;
        // r d(u_θ/r)/dr; in the ring u_θ/r = 2U/r − U/R.
        let fall = if (1.0..2.0).contains(&s) { -2.0 * self.speed / r } else { 0.0 };
        let [ex, ey] = [x / r, y / r];
        [[-fall * ex * ey, -rate - fall * ey * ey], [rate + fall * ex * ex, fall * ex * ey]]
    }

    /// Pressure over that far away, Pa.
    pub fn pressure(&self, [x, y]: [f64; 2]) -> f64 {
        let s = x.hypot(y) / self.radius;
        let share = if s < 1.0 {
            0.5 * s * s + 2.0 - 4.0 * LN_2
        } else if s < 2.0 {
            0.5 * s * s - 4.0 * s + 4.0 * (0.5 * s).ln() + 6.0
        } else {
            0.0
        };
        self.density * self.speed * self.speed * share
    }

    /// ∫ ρ r u_θ dA, kg m²/s per metre of depth.
    pub fn angular_momentum(&self) -> f64 {
        // 2π ρ U R³ (∫₀¹ s³ ds + ∫₁² (2 − s) s² ds).
        2.0 * PI * self.density * self.speed * self.radius.powi(3) * (0.25 + 14.0 / 3.0 - 3.75)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VORTEX: Gresho = Gresho { radius: 0.2, speed: 1.0, density: 900.0 };

    #[test]
    fn pressure_turns_the_fluid() {
        for r in [0.03, 0.15, 0.21, 0.3, 0.39, 0.45] {
            let step = 1e-6;
            let slope = (VORTEX.pressure([r + step, 0.0]) - VORTEX.pressure([r - step, 0.0]))
                / (2.0 * step);
            let turning = VORTEX.density * VORTEX.swirl(r).powi(2) / r;
            assert!((slope - turning).abs() < 1e-4, "{r}: {slope} {turning}");
        }
    }

    #[test]
    fn velocity_and_pressure_have_no_jump() {
        for r in [0.2, 0.4] {
            for field in [
                VORTEX.swirl(r - 1e-9) - VORTEX.swirl(r + 1e-9),
                VORTEX.pressure([r - 1e-9, 0.0]) - VORTEX.pressure([r + 1e-9, 0.0]),
            ] {
                assert!(field.abs() < 1e-4, "{r}: {field}");
            }
        }
        assert_eq!(VORTEX.velocity([0.0, 0.0]), [0.0, 0.0]);
    }

    /// p = 5 + 12.5 r², 9 − 4 ln 0.2 + 12.5 r² − 20 r + 4 ln r and 3 + 4 ln 2, the last taken off.
    #[test]
    fn it_is_the_one_of_the_literature() {
        let far = 3.0 + 4.0 * 2.0_f64.ln();
        let inside = |r: f64| 5.0 + 12.5 * r * r - far;
        let ring = |r: f64| 9.0 - 4.0 * 0.2_f64.ln() + 12.5 * r * r - 20.0 * r + 4.0 * r.ln() - far;
        for (r, exact) in [(0.1, inside(0.1)), (0.25, ring(0.25)), (0.35, ring(0.35))] {
            let found = VORTEX.pressure([0.0, r]) / VORTEX.density;
            assert!((found - exact).abs() < 1e-14, "{r}: {found} {exact}");
        }
    }

    #[test]
    fn gradient_and_angular_momentum_are_those_of_the_velocity() {
        for at in [[0.05, 0.1], [0.2, -0.15], [0.5, 0.1]] {
            for j in 0..2 {
                let moved = |by: f64| {
                    let mut place = at;
                    place[j] += by;
                    VORTEX.velocity(place)
                };
                for i in 0..2 {
                    let slope = (moved(1e-6)[i] - moved(-1e-6)[i]) / 2e-6;
                    assert!((slope - VORTEX.velocity_gradient(at)[i][j]).abs() < 1e-7);
                }
            }
        }
        let n = 4000;
        let sum: f64 = (0..n)
            .map(|i| {
                let r = 0.4 * (f64::from(i) + 0.5) / f64::from(n);
                2.0 * PI * r * r * VORTEX.density * VORTEX.swirl(r) * 0.4 / f64::from(n)
            })
            .sum();
        assert!((sum / VORTEX.angular_momentum() - 1.0).abs() < 1e-6);
    }
}
