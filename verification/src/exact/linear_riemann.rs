//! Riemann problem of linear acoustics from rest.
//!
//! ```text
//! ∂p/∂t + ρ₀ c₀² ∂u/∂x = 0,   ρ₀ ∂u/∂t + ∂p/∂x = 0
//! p* = (p_L + p_R) / 2,   u* = (p_L − p_R) / (2 ρ₀ c₀)   for |x − x₀| < c₀ t
//! ```
//!
//! The pressure is Eq. (43) of \[Song2020\]. It leaves out terms of relative order (p_L − p_R)/(ρ₀c₀²),
//! see [`super::isothermal_riemann`].

/// Two fluids at rest with different pressures; the interface is at x = x₀ when t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRiemann {
    /// Pressure p_L of x < x₀ at the start, Pa.
    pub left_pressure: f64,
    /// Pressure p_R of x > x₀ at the start, Pa.
    pub right_pressure: f64,
    /// Density at rest ρ₀, kg/m³.
    pub density: f64,
    /// Speed of sound c₀, m/s.
    pub sound_speed: f64,
    /// Interface x₀, m.
    pub interface: f64,
}

impl LinearRiemann {
    /// p* = (p_L + p_R) / 2, Eq. (43) of \[Song2020\], Pa.
    pub fn star_pressure(&self) -> f64 {
        0.5 * (self.left_pressure + self.right_pressure)
    }

    /// u* = (p_L − p_R) / (2 ρ₀ c₀), m/s.
    pub fn star_velocity(&self) -> f64 {
        (self.left_pressure - self.right_pressure) / (2.0 * self.density * self.sound_speed)
    }

    /// Places x₀ ∓ c₀ t of the two jumps, m.
    pub fn fronts(&self, time: f64) -> [f64; 2] {
        let reach = self.sound_speed * time;
        [self.interface - reach, self.interface + reach]
    }

    /// Pressure at a place, Eq. (43) of \[Song2020\], Pa.
    pub fn pressure(&self, position: f64, time: f64) -> f64 {
        let [left, right] = self.fronts(time);
        if position < left {
            self.left_pressure
        } else if position > right {
            self.right_pressure
        } else {
            self.star_pressure()
        }
    }

    /// Velocity at a place, m/s.
    pub fn velocity(&self, position: f64, time: f64) -> f64 {
        let [left, right] = self.fronts(time);
        if position < left || position > right { 0.0 } else { self.star_velocity() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::isothermal_riemann::{IsothermalRiemann, State};
    use super::*;

    fn paper() -> LinearRiemann {
        LinearRiemann {
            left_pressure: 1000.0,
            right_pressure: 100.0,
            density: 1000.0,
            sound_speed: 50.0,
            interface: 0.5,
        }
    }

    #[test]
    fn jumps_satisfy_the_linear_equations() {
        let wave = paper();
        let t = 5e-3;
        for (front, speed) in wave.fronts(t).into_iter().zip([-50.0, 50.0]) {
            let jump = |f: &dyn Fn(f64) -> f64| f(front + 1e-9) - f(front - 1e-9);
            let pressure = jump(&|x| wave.pressure(x, t));
            let velocity = jump(&|x| wave.velocity(x, t));
            assert!(pressure != 0.0);
            assert!((speed * pressure - 1000.0 * 2500.0 * velocity).abs() < 1e-9);
            assert!((speed * 1000.0 * velocity - pressure).abs() < 1e-11);
            let moved = wave.fronts(t + 1e-3)[usize::from(speed > 0.0)] - front;
            assert!((moved - 1e-3 * speed).abs() < 1e-15);
        }
    }

    #[test]
    fn plateau_of_the_paper_and_the_start() {
        let wave = paper();
        assert_eq!(wave.pressure(0.3, 5e-3), 550.0);
        assert_eq!(wave.velocity(0.7, 5e-3), 0.009);
        assert_eq!(wave.fronts(5e-3), [0.25, 0.75]);
        assert_eq!((wave.pressure(0.49, 0.0), wave.velocity(0.49, 0.0)), (1000.0, 0.0));
        assert_eq!((wave.pressure(0.51, 0.0), wave.velocity(0.51, 0.0)), (100.0, 0.0));
    }

    #[test]
    fn it_is_the_limit_of_the_nonlinear_problem() {
        let gap = |scale: f64| {
            let at_rest = |p: f64| State { density: 1000.0 + scale * p / 2500.0, velocity: 0.0 };
            let exact =
                IsothermalRiemann::new(at_rest(1000.0), at_rest(100.0), 50.0, 1000.0).unwrap();
            (exact.pressure(exact.star()) / scale - paper().star_pressure()).abs()
        };
        let order = (gap(20.0) / gap(10.0)).log2();
        assert!((order - 1.0).abs() < 0.02, "order {order}");
    }
}
