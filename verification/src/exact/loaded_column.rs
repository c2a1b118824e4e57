//! Column of a weakly compressible liquid on which gravity is switched on, linear acoustics.
//!
//! ρ₀ ∂v/∂t = −∂p/∂y − ρ₀ g and ∂p/∂t = −ρ₀ c² ∂v/∂y on 0 ≤ y ≤ H, at rest without pressure at t = 0;
//! v = 0 at the floor y = 0, p = 0 at the surface y = H. By separation of variables, \[MorseIngard1968\]:
//!
//! ```text
//! p(y, t) = ρ₀ g (H − y) − ρ₀ g Σ_n 2/(H k_n²) cos(k_n y) cos(k_n c t),   k_n = (2n − 1) π / (2H)
//! S(ξ) = Σ_n 2/(H k_n²) cos(k_n ξ):   even, of period 4H, S = H − ξ on 0 ≤ ξ ≤ 2H
//! p = ρ₀ g (H − y − (S(y − ct) + S(y + ct))/2),   v = g/(2c) (S(y + ct) − S(y − ct))
//! ```
//!
//! At the floor the pressure is a triangle wave between 0 and 2 ρ₀ g H. Valid for g H / c² ≪ 1.

/// A column that starts at rest without pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedColumn {
    /// Height H, m.
    pub height: f64,
    /// Acceleration downwards g, m/s².
    pub gravity: f64,
    /// Density ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c, m/s.
    pub sound_speed: f64,
}

impl LoadedColumn {
    /// Period 4H/c, s.
    pub fn period(&self) -> f64 {
        4.0 * self.height / self.sound_speed
    }

    /// Static pressure at the floor ρ₀ g H, Pa: half of the largest pressure.
    pub fn static_pressure(&self) -> f64 {
        self.density * self.gravity * self.height
    }

    /// Pressure p, Pa, at the height `position` (m).
    pub fn pressure(&self, position: f64, time: f64) -> f64 {
        let along = self.sound_speed * time;
        let waves = 0.5 * (self.triangle(position - along) + self.triangle(position + along));
        self.density * self.gravity * (self.height - position - waves)
    }

    /// Velocity v, m/s, upwards.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let along = self.sound_speed * time;
        let waves = self.triangle(position + along) - self.triangle(position - along);
        0.5 * self.gravity / self.sound_speed * waves
    }

    /// S(ξ), m.
    fn triangle(&self, at: f64) -> f64 {
        let folded = at.rem_euclid(4.0 * self.height);
        self.height - folded.min(4.0 * self.height - folded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const COLUMN: LoadedColumn =
        LoadedColumn { height: 1.7, gravity: 9.81, density: 1000.0, sound_speed: 40.0 };

    /// Places and times away from the kinks, which pass on y ± ct = 2jH.
    fn places() -> Vec<(f64, f64)> {
        let mut places = Vec::new();
        for i in 0..17 {
            for j in 0..23 {
                let y = COLUMN.height * (f64::from(i) + 0.31) / 17.0;
                let t = COLUMN.period() * (f64::from(j) + 0.17) / 9.0;
                let ends = [y + 40.0 * t, y - 40.0 * t]
                    .map(|xi| (xi / (2.0 * COLUMN.height)).fract().abs());
                if ends.iter().all(|part| (0.01..0.99).contains(part)) {
                    places.push((y, t));
                }
            }
        }
        assert!(places.len() > 300);
        places
    }

    #[test]
    fn momentum_and_continuity_hold() {
        let (c, rho, g) = (COLUMN.sound_speed, COLUMN.density, COLUMN.gravity);
        let (dy, dt) = (1e-4, 1e-6);
        for (y, t) in places() {
            let along_y = |f: &dyn Fn(f64) -> f64| (f(y + dy) - f(y - dy)) / (2.0 * dy);
            let along_t = |f: &dyn Fn(f64) -> f64| (f(t + dt) - f(t - dt)) / (2.0 * dt);
            let momentum = rho * along_t(&|t| COLUMN.velocity(y, t))
                + along_y(&|y| COLUMN.pressure(y, t))
                + rho * g;
            let continuity = along_t(&|t| COLUMN.pressure(y, t))
                + rho * c * c * along_y(&|y| COLUMN.velocity(y, t));
            assert!(momentum.abs() < 1e-6 * rho * g, "{y} {t}: {momentum}");
            assert!(continuity.abs() < 1e-6 * rho * g * c, "{y} {t}: {continuity}");
        }
    }

    #[test]
    fn it_starts_at_rest_and_keeps_its_ends() {
        let scale = COLUMN.static_pressure();
        for (y, t) in places() {
            assert!(COLUMN.pressure(y, 0.0).abs() < 1e-13 * scale);
            assert_eq!(COLUMN.velocity(y, 0.0), 0.0);
            assert!(COLUMN.pressure(COLUMN.height, t).abs() < 1e-13 * scale);
            assert!(COLUMN.velocity(0.0, t).abs() < 1e-14);
        }
    }

    #[test]
    fn the_floor_feels_a_triangle_wave() {
        for j in 0..200 {
            let share = f64::from(j) / 40.0;
            let folded = share.fract().min(1.0 - share.fract());
            let found = COLUMN.pressure(0.0, share * COLUMN.period()) / COLUMN.static_pressure();
            assert!((found - 4.0 * folded).abs() < 1e-12, "{share}: {found}");
        }
    }

    #[test]
    fn the_series_is_the_same() {
        for (y, t) in places() {
            let mut sum = COLUMN.height - y;
            for n in 0..4000 {
                let k = (2.0 * f64::from(n) + 1.0) * PI / (2.0 * COLUMN.height);
                let shape = (k * y).cos() * (k * COLUMN.sound_speed * t).cos();
                sum -= 2.0 / (COLUMN.height * k * k) * shape;
            }
            let found = COLUMN.pressure(y, t) / (COLUMN.density * COLUMN.gravity);
            // The terms left out add up to 4H/π²/4000 at most.
            assert!((found - sum).abs() < 2e-4, "{y} {t}: {found} {sum}");
        }
    }
}
