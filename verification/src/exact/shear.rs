//! Start-up of plane Couette flow and of plane Poiseuille flow.
//!
//! ∂u/∂t = ν ∂²u/∂y² + g between walls at y = 0 and y = H, from rest, \[Schlichting2017\]. Series in
//! time, \[Morris1997\], and for νt < H²/20 images at the walls, \[CarslawJaeger1959\]:
//!
//! ```text
//! Couette: wall y = H moves at U, g = 0
//!   u = U y/H + Σ_{n≥1} (2U/nπ) (−1)ⁿ sin(nπy/H) exp(−ν n²π² t/H²)
//!     = U Σ_{m≥0} [erfc(((2m+1)H − y)/2√(νt)) − erfc(((2m+1)H + y)/2√(νt))]
//! Poiseuille: walls at rest, body force g per mass
//!   u = (g/2ν) y(H − y) − Σ_{n odd} (4gH²/νπ³n³) sin(nπy/H) exp(−ν n²π² t/H²)
//!     = g t {1 − 4 Σ_{m≥0} (−1)ᵐ [i²erfc((mH + y)/2√(νt)) + i²erfc(((m+1)H − y)/2√(νt))]}
//! ```
//!
//! Terms are summed until they are below round-off: absolute error below 1e-14 of U, of gH²/8ν.

use std::f64::consts::PI;

/// νt/H² below which images are used instead of the series in time.
const SWITCH: f64 = 0.05;

/// Modes that count from the switch on: the first left out, n = 10, has exp(−n²π²/20) = 4e-22.
const N_MODES: u32 = 9;

/// Images that count up to the switch: the first left out is 4H away, erfc(4/2√0.05) = 1e-36.
const N_IMAGES: u32 = 4;

/// Flow between a wall at rest, y = 0, and a wall that moves at U from t = 0 on, y = H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Couette {
    /// Distance H of the walls, m.
    pub height: f64,
    /// Kinematic viscosity ν, m²/s.
    pub viscosity: f64,
    /// Velocity U of the wall y = H, m/s.
    pub wall_velocity: f64,
}

impl Couette {
    /// Velocity u at 0 ≤ y ≤ H, m/s.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let (y, s) = (position / self.height, self.viscosity * time / self.height.powi(2));
        self.wall_velocity * if s < SWITCH { couette_images(y, s) } else { couette_modes(y, s) }
    }

    /// Velocity U y/H of the steady flow, m/s.
    pub fn steady(&self, position: f64) -> f64 {
        self.wall_velocity * position / self.height
    }
}

/// Flow between walls at rest, y = 0 and y = H, under a body force from t = 0 on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Poiseuille {
    /// Distance H of the walls, m.
    pub height: f64,
    /// Kinematic viscosity ν, m²/s.
    pub viscosity: f64,
    /// Body force per mass g along the walls, m/s².
    pub acceleration: f64,
}

impl Poiseuille {
    /// Velocity u at 0 ≤ y ≤ H, m/s.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let (y, s) = (position / self.height, self.viscosity * time / self.height.powi(2));
        let unit = self.acceleration * self.height.powi(2) / self.viscosity;
        unit * if s < SWITCH { poiseuille_images(y, s) } else { poiseuille_modes(y, s) }
    }

    /// Velocity g y (H − y) / 2ν of the steady flow, m/s.
    pub fn steady(&self, position: f64) -> f64 {
        0.5 * self.acceleration / self.viscosity * position * (self.height - position)
    }
}

/// u/U over y/H and νt/H².
fn couette_modes(y: f64, s: f64) -> f64 {
    let modes = (1..=N_MODES).map(|n| {
        let (n, sign) = (f64::from(n), if n % 2 == 0 { 1.0 } else { -1.0 });
        sign * 2.0 / (n * PI) * (n * PI * y).sin() * (-(n * PI).powi(2) * s).exp()
    });
    y + modes.sum::<f64>()
}

fn couette_images(y: f64, s: f64) -> f64 {
    if s <= 0.0 {
        return if y < 1.0 { 0.0 } else { 1.0 };
    }
    let width = 2.0 * s.sqrt();
    (0..N_IMAGES)
        .map(|m| {
            let wall = f64::from(2 * m + 1);
            libm::erfc((wall - y) / width) - libm::erfc((wall + y) / width)
        })
        .sum()
}

/// uν/gH² over y/H and νt/H².
fn poiseuille_modes(y: f64, s: f64) -> f64 {
    let modes = (1..=N_MODES).step_by(2).map(|n| {
        let n = f64::from(n);
        4.0 / (n * PI).powi(3) * (n * PI * y).sin() * (-(n * PI).powi(2) * s).exp()
    });
    0.5 * y * (1.0 - y) - modes.sum::<f64>()
}

fn poiseuille_images(y: f64, s: f64) -> f64 {
    if s <= 0.0 {
        return 0.0;
    }
    let width = 2.0 * s.sqrt();
    let images = (0..N_IMAGES).map(|m| {
        let (m, sign) = (f64::from(m), if m % 2 == 0 { 4.0 } else { -4.0 });
        sign * (erfc_twice_integrated((m + y) / width)
            + erfc_twice_integrated((m + 1.0 - y) / width))
    });
    s * (1.0 - images.sum::<f64>())
}

/// i²erfc(z) = [(1 + 2z²) erfc z − (2/√π) z exp(−z²)] / 4, \[CarslawJaeger1959\], Appendix II.
fn erfc_twice_integrated(z: f64) -> f64 {
    let slope = 2.0 / PI.sqrt() * (-z * z).exp();
    0.25 * ((1.0 + 2.0 * z * z) * libm::erfc(z) - z * slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    const H: f64 = 0.5;
    const NU: f64 = 0.02;

    fn couette() -> Couette {
        Couette { height: H, viscosity: NU, wall_velocity: 3.0 }
    }

    fn poiseuille() -> Poiseuille {
        Poiseuille { height: H, viscosity: NU, acceleration: 0.7 }
    }

    /// ∂u/∂t − ν ∂²u/∂y² by differences of fourth order.
    fn residual(u: &dyn Fn(f64, f64) -> f64, y: f64, t: f64) -> f64 {
        let (dy, dt) = (2e-3 * H, 1e-3 * t);
        let rate = 8.0 * (u(y, t + dt) - u(y, t - dt)) - u(y, t + 2.0 * dt) + u(y, t - 2.0 * dt);
        let bend = 16.0 * (u(y + dy, t) + u(y - dy, t))
            - u(y + 2.0 * dy, t)
            - u(y - 2.0 * dy, t)
            - 30.0 * u(y, t);
        rate / (12.0 * dt) - NU * bend / (12.0 * dy * dy)
    }

    /// Places inside, and times on both sides of the switch, νt/H² = 0.05 at 0.625 s.
    fn places() -> impl Iterator<Item = (f64, f64)> {
        (1..10).flat_map(|i| {
            [0.05, 0.2, 0.6, 0.65, 2.0, 10.0].map(move |t| (H * f64::from(i) / 10.0, t))
        })
    }

    #[test]
    fn diffusion_equation_holds() {
        for (y, t) in places() {
            // Against the largest rate, of the order of U/t and of g.
            let left = residual(&|y, t| couette().velocity(y, t), y, t);
            assert!(left.abs() < 1e-7 * 3.0 / t, "Couette {y} {t}: {left}");
            let left = residual(&|y, t| poiseuille().velocity(y, t), y, t);
            assert!((left - 0.7).abs() < 1e-6 * 0.7, "Poiseuille {y} {t}: {left}");
        }
    }

    #[test]
    fn walls_and_start() {
        for (_, t) in places() {
            assert!(couette().velocity(0.0, t).abs() < 1e-15);
            assert!((couette().velocity(H, t) - 3.0).abs() < 1e-14);
            assert!(poiseuille().velocity(0.0, t).abs() < 1e-14);
            assert!(poiseuille().velocity(H, t).abs() < 1e-14);
        }
        for i in 0..10 {
            let y = H * f64::from(i) / 10.0;
            assert_eq!(couette().velocity(y, 0.0), 0.0);
            assert!(couette().velocity(y, 1e-5).abs() < 1e-14);
            assert_eq!(poiseuille().velocity(y, 0.0), 0.0);
        }
        // Far from the walls the fluid falls freely at first.
        assert!((poiseuille().velocity(0.5 * H, 0.01) - 0.007).abs() < 1e-16);
    }

    #[test]
    fn flow_becomes_steady_and_the_steady_flow_balances() {
        for (y, _) in places() {
            assert!((couette().velocity(y, 60.0) - couette().steady(y)).abs() < 1e-14);
            assert!((poiseuille().velocity(y, 60.0) - poiseuille().steady(y)).abs() < 1e-14);
            assert!((residual(&|y, _| poiseuille().steady(y), y, 1.0) - 0.7).abs() < 1e-9);
        }
        // Largest velocity gH²/8ν.
        assert!((poiseuille().steady(0.5 * H) - 0.7 * H * H / (8.0 * NU)).abs() < 1e-15);
    }

    #[test]
    fn both_series_agree_where_they_meet() {
        for i in 0..=20 {
            let y = f64::from(i) / 20.0;
            for s in [0.9 * SWITCH, SWITCH, 1.1 * SWITCH] {
                let gap = couette_images(y, s) - couette_modes(y, s);
                assert!(gap.abs() < 1e-15, "{y} {s}: {gap}");
                let gap = poiseuille_images(y, s) - poiseuille_modes(y, s);
                assert!(gap.abs() < 1e-15, "{y} {s}: {gap}");
            }
        }
    }
}
