//! Drop whose ellipse changes its shape, in the plane, with or without a force towards its center.
//!
//! Without gravity and viscosity, with the acceleration −Ω² x and p = 0 on the surface, \[MonaghanRafiee2013\]:
//!
//! ```text
//! v = (A x, −A y),   p = p₀ (1 − x²/a² − y²/b²),   p₀ = ρ (A² + Ω²) a² b²/(a² + b²)
//! a' = A a,   b' = −A b,   A' = (A² + Ω²) (b² − a²)/(a² + b²)
//! ```
//!
//! a b and (A² + Ω²)(a² + b²), four times the energy over the mass, do not change. An exact solution of the Euler
//! equations of an incompressible fluid. The equations are integrated with the classical Runge-Kutta method.

/// A drop that is a circle at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticalDrop {
    /// Radius at the start R, m.
    pub radius: f64,
    /// Rate of strain at the start A₀, 1/s.
    pub rate: f64,
    /// Ω, 1/s.
    pub force_rate: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
}

/// The drop at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Semi-axis a along x, m.
    pub a: f64,
    /// Semi-axis b along y, m.
    pub b: f64,
    /// Rate of strain A, 1/s.
    pub rate: f64,
    /// Pressure at the center p₀, Pa.
    pub center_pressure: f64,
}

/// Steps per 1/A₀ or 1/Ω, whichever is shorter: the error is below 10⁻¹² then.
const STEPS: f64 = 2000.0;

impl EllipticalDrop {
    /// The drop at a time, s, before or after the start.
    pub fn at(&self, time: f64) -> Ellipse {
        let fastest = self.rate.abs().max(self.force_rate.abs());
        let steps = (STEPS * (fastest * time).abs()).ceil().max(1.0);
        let dt = time / steps;
        let mut state = [self.radius, self.radius, self.rate];
        for _ in 0..steps as u64 {
            let first = self.slope(state);
            let second = self.slope(moved(state, 0.5 * dt, first));
            let third = self.slope(moved(state, 0.5 * dt, second));
            let fourth = self.slope(moved(state, dt, third));
            for i in 0..3 {
                state[i] += dt / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]);
            }
        }
        self.ellipse(state)
    }

    /// (a', b', A').
    fn slope(&self, [a, b, rate]: [f64; 3]) -> [f64; 3] {
        let bent = (rate * rate + self.force_rate.powi(2)) * (b * b - a * a) / (a * a + b * b);
        [rate * a, -rate * b, bent]
    }

    fn ellipse(&self, [a, b, rate]: [f64; 3]) -> Ellipse {
        let square = a * a * b * b / (a * a + b * b);
        let center_pressure = self.density * (rate * rate + self.force_rate.powi(2)) * square;
        Ellipse { a, b, rate, center_pressure }
    }

    /// Period of the oscillation with a force, s: from one passage through the circle to the second next.
    pub fn period(&self) -> f64 {
        // From A₀ the rate falls to zero at a quarter of the period, where the drop is longest.
        let step = 0.01 / self.force_rate;
        let mut time = 0.0;
        let mut state = [self.radius, self.radius, self.rate];
        while state[2] > 0.0 {
            time += step;
            let Ellipse { a, b, rate, .. } = self.at(time);
            state = [a, b, rate];
        }
        for _ in 0..8 {
            time -= state[2] / self.slope(state)[2];
            let Ellipse { a, b, rate, .. } = self.at(time);
            state = [a, b, rate];
        }
        4.0 * time
    }
}

fn moved(state: [f64; 3], by: f64, slope: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| state[i] + by * slope[i])
}

impl Ellipse {
    /// Velocity about the center, m/s.
    pub fn velocity(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.rate * x, -self.rate * y]
    }

    /// Its gradient, 1/s.
    pub fn velocity_gradient(&self) -> [[f64; 2]; 2] {
        [[self.rate, 0.0], [0.0, -self.rate]]
    }

    /// x²/a² + y²/b²: 1 on the surface.
    pub fn share(&self, [x, y]: [f64; 2]) -> f64 {
        (x / self.a).powi(2) + (y / self.b).powi(2)
    }

    /// Pressure p, Pa.
    pub fn pressure(&self, position: [f64; 2]) -> f64 {
        self.center_pressure * (1.0 - self.share(position))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const FREE: EllipticalDrop =
        EllipticalDrop { radius: 0.7, rate: 1.3, force_rate: 0.0, density: 900.0 };
    const HELD: EllipticalDrop = EllipticalDrop { force_rate: 2.1, ..FREE };

    #[test]
    fn area_and_energy_are_kept() {
        for drop in [FREE, HELD] {
            for time in [-0.2, 0.3, 1.0, 3.0] {
                let found = drop.at(time);
                assert!((found.a * found.b / 0.49 - 1.0).abs() < 1e-12, "{time}");
                let energy = |rate: f64, a: f64, b: f64| {
                    (rate * rate + drop.force_rate.powi(2)) * (a * a + b * b)
                };
                let ratio = energy(found.rate, found.a, found.b) / energy(1.3, 0.7, 0.7);
                assert!((ratio - 1.0).abs() < 1e-12, "{time}: {ratio}");
            }
        }
    }

    #[test]
    fn it_solves_the_euler_equations() {
        let step = 1e-4;
        for drop in [FREE, HELD] {
            for (x, y, time) in [(0.1, 0.2, 0.4), (0.5, -0.1, 1.1), (0.3, 0.0, 0.0)] {
                let now = drop.at(time);
                let [u, v] = now.velocity([x, y]);
                let rates: [f64; 2] = std::array::from_fn(|i| {
                    let at = |t| drop.at(t).velocity([x, y])[i];
                    (at(time + step) - at(time - step)) / (2.0 * step)
                });
                let slope = [
                    (now.pressure([x + step, y]) - now.pressure([x - step, y])) / (2.0 * step),
                    (now.pressure([x, y + step]) - now.pressure([x, y - step])) / (2.0 * step),
                ];
                let gradient = now.velocity_gradient();
                for i in 0..2 {
                    let carried = u * gradient[i][0] + v * gradient[i][1];
                    let force = drop.force_rate.powi(2) * [x, y][i];
                    let residual = rates[i] + carried + slope[i] / drop.density + force;
                    assert!(residual.abs() < 1e-6, "{i} {time}: {residual}");
                }
                assert_eq!(gradient[0][0] + gradient[1][1], 0.0);
            }
        }
    }

    /// The surface moves with the fluid and has no pressure.
    #[test]
    fn the_surface_is_one_of_the_fluid() {
        let now = HELD.at(0.8);
        for i in 0..12 {
            let (sine, cosine) = (f64::from(i) * PI / 6.0).sin_cos();
            let position = [now.a * cosine, now.b * sine];
            assert!(now.pressure(position).abs() < 1e-12 * now.center_pressure);
        }
        let (before, after) = (HELD.at(0.8 - 1e-5), HELD.at(0.8 + 1e-5));
        assert!(((after.a - before.a) / 2e-5 - now.rate * now.a).abs() < 1e-8);
        assert!(((after.b - before.b) / 2e-5 + now.rate * now.b).abs() < 1e-8);
    }

    /// It comes back to the circle with its first rate after a period, and small ones take 2π/(√2 Ω).
    #[test]
    fn it_oscillates() {
        let found = HELD.at(HELD.period());
        assert!((found.a / 0.7 - 1.0).abs() < 1e-10, "{found:?}");
        assert!((found.rate / 1.3 - 1.0).abs() < 1e-10, "{found:?}");
        let small = EllipticalDrop { rate: 1e-4, ..HELD };
        let linear = 2.0 * PI / (2.0_f64.sqrt() * 2.1);
        assert!((small.period() / linear - 1.0).abs() < 1e-7, "{}", small.period());
    }
}
