//! An annulus of fluid that turns by an angle that depends on the radius: the generalized vortex of \[Kamojjala2015\].
//!
//! ```text
//! β(R, t) = g(t) h(R),   g = G sin(πt/T),   h = (1 − 4y²)²,   y = (R − R_m)/(R_o − R_i)
//! v_θ = R g' h,   b_r = −R (g' h)²,   b_θ = R g'' h,   p = 0
//! ```
//!
//! h and h' vanish on both rims, where the fluid therefore stays at rest. The motion keeps all volumes, so that with this
//! acceleration b it is a solution without pressure, for an inviscid fluid of any compressibility. Beyond the rims,
//! where only nodes of the grid are, all is zero.

use std::f64::consts::PI;

/// A generalized vortex about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GeneralizedVortex {
    /// Inner radius R_i, m.
    pub inner: f64,
    /// Outer radius R_o, m.
    pub outer: f64,
    /// Largest angle G, rad.
    pub angle: f64,
    /// Period over two T, s.
    pub half_period: f64,
}

impl GeneralizedVortex {
    /// y, from −½ to ½ between the rims.
    fn across(&self, radius: f64) -> f64 {
        (radius - 0.5 * (self.inner + self.outer)) / (self.outer - self.inner)
    }

    /// h.
    pub fn profile(&self, radius: f64) -> f64 {
        (1.0 - 4.0 * self.across(radius).powi(2)).max(0.0).powi(2)
    }

    /// dh/dR, 1/m.
    pub fn profile_slope(&self, radius: f64) -> f64 {
        let y = self.across(radius);
        -16.0 * y * (1.0 - 4.0 * y * y).max(0.0) / (self.outer - self.inner)
    }

    /// g, g' and g'': rad, rad/s and rad/s².
    fn turn(&self, time: f64) -> [f64; 3] {
        let rate = PI / self.half_period;
        let (sine, cosine) = (rate * time).sin_cos();
        [self.angle * sine, self.angle * rate * cosine, -self.angle * rate * rate * sine]
    }

    /// The angle β by which a radius has turned, rad.
    pub fn turned(&self, radius: f64, time: f64) -> f64 {
        self.turn(time)[0] * self.profile(radius)
    }

    /// Velocity at a place, m/s.
    pub fn velocity(&self, [x, y]: [f64; 2], time: f64) -> [f64; 2] {
        let rate = self.turn(time)[1] * self.profile(x.hypot(y));
        [-rate * y, rate * x]
    }

    /// Its gradient `[i][j] = ∂v_i/∂x_j`, 1/s.
    pub fn velocity_gradient(&self, [x, y]: [f64; 2], time: f64) -> [[f64; 2]; 2] {
        let radius = x.hypot(y).max(f64::MIN_POSITIVE);
        let rate = self.turn(time)[1];
        let (spin, shear) =
            (rate * self.profile(radius), rate * self.profile_slope(radius) / radius);
        [[-shear * x * y, -spin - shear * y * y], [spin + shear * x * x, shear * x * y]]
    }

    /// The acceleration b that the motion needs, m/s².
    pub fn acceleration(&self, [x, y]: [f64; 2], time: f64) -> [f64; 2] {
        let profile = self.profile(x.hypot(y));
        let [_, rate, change] = self.turn(time);
        let (inwards, along) = ((rate * profile).powi(2), change * profile);
        [-inwards * x - along * y, -inwards * y + along * x]
    }

    /// Largest velocity of any point at any time, m/s.
    pub fn largest_speed(&self) -> f64 {
        // R h' + h = 0 with h = (1 − 4y²)²: 1 − 4y² − 16y R/(R_o − R_i) = 0, or 20y² + 16my − 1 = 0.
        let m = 0.5 * (self.inner + self.outer) / (self.outer - self.inner);
        let y = ((64.0 * m * m + 20.0).sqrt() - 8.0 * m) / 20.0;
        let radius = 0.5 * (self.inner + self.outer) + y * (self.outer - self.inner);
        self.turn(0.0)[1] * radius * self.profile(radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VORTEX: GeneralizedVortex =
        GeneralizedVortex { inner: 0.75, outer: 1.25, angle: 1.3, half_period: 0.8 };
    /// Step of the difference quotients.
    const STEP: f64 = 1e-5;
    const PLACES: [[f64; 2]; 4] = [[0.9, 0.1], [-0.3, 0.95], [-0.8, -0.8], [0.5, -0.6]];

    fn slopes(field: impl Fn([f64; 2]) -> [f64; 2], at: [f64; 2]) -> [[f64; 2]; 2] {
        let moved = |j: usize, by: f64| {
            let mut place = at;
            place[j] += by;
            field(place)
        };
        std::array::from_fn(|i| {
            std::array::from_fn(|j| (moved(j, STEP)[i] - moved(j, -STEP)[i]) / (2.0 * STEP))
        })
    }

    #[test]
    fn no_volume_changes_and_the_gradient_is_that_of_the_velocity() {
        for time in [0.0, 0.3, 0.7] {
            for place in PLACES {
                let found = slopes(|place| VORTEX.velocity(place, time), place);
                assert!((found[0][0] + found[1][1]).abs() < 1e-7, "{found:?}");
                let exact = VORTEX.velocity_gradient(place, time);
                for (found, exact) in found.as_flattened().iter().zip(exact.as_flattened()) {
                    assert!((found - exact).abs() < 1e-7, "{place:?}: {found} {exact}");
                }
            }
        }
    }

    /// ∂v/∂t + v·∇v = b.
    #[test]
    fn the_acceleration_is_that_of_the_fluid() {
        for time in [0.0, 0.3, 0.7] {
            for place in PLACES {
                let [now, before, after] =
                    [0.0, -STEP, STEP].map(|by| VORTEX.velocity(place, time + by));
                let gradient = slopes(|place| VORTEX.velocity(place, time), place);
                let exact = VORTEX.acceleration(place, time);
                for i in 0..2 {
                    let carried = now[0] * gradient[i][0] + now[1] * gradient[i][1];
                    let found = (after[i] - before[i]) / (2.0 * STEP) + carried;
                    assert!((found - exact[i]).abs() < 1e-6, "{place:?} {time}: {found} {exact:?}");
                }
            }
        }
    }

    /// A point that has turned by β about the origin has the velocity of its place.
    #[test]
    fn points_turn_with_the_fluid() {
        for radius in [0.8, 1.0, 1.1] {
            let at = |time: f64| {
                let (sine, cosine) = VORTEX.turned(radius, time).sin_cos();
                [radius * cosine, radius * sine]
            };
            let exact = VORTEX.velocity(at(0.2), 0.2);
            for axis in 0..2 {
                let found = (at(0.2 + STEP)[axis] - at(0.2 - STEP)[axis]) / (2.0 * STEP);
                assert!((found - exact[axis]).abs() < 1e-8, "{found} {exact:?}");
            }
        }
    }

    /// h = 1 − 8y² + 16y⁴ as printed, zero with its slope at the rims and beyond.
    #[test]
    fn the_rims_are_at_rest() {
        for radius in [0.75, 1.25, 0.6, 1.4] {
            assert!(VORTEX.profile(radius) < 1e-30 && VORTEX.profile_slope(radius).abs() < 1e-14);
        }
        for (radius, y) in [(1.0, 0.0_f64), (0.85, -0.3), (1.2, 0.4)] {
            let printed = 1.0 - 8.0 * y.powi(2) + 16.0 * y.powi(4);
            assert!((VORTEX.profile(radius) - printed).abs() < 1e-14, "{radius}");
        }
    }

    #[test]
    fn no_point_is_faster_than_the_fastest() {
        let speed = |k: i32| {
            let [u, v] = VORTEX.velocity([0.75 + 5e-4 * f64::from(k), 0.0], 0.0);
            u.hypot(v)
        };
        let found = (0..=1000).map(speed).fold(0.0, f64::max);
        assert!((found / VORTEX.largest_speed() - 1.0).abs() < 1e-6, "{found}");
    }
}
