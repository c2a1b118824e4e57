//! Weakly compressible liquid at rest under gravity of any direction.
//!
//! ∇p = ρ b with b = g d along the unit vector d downwards: the [`HydrostaticColumn`] over the height
//! −d · (x − x₀) above a place x₀ on its floor, whatever the walls. The surface is the plane at the height H.

use super::hydrostatic_column::HydrostaticColumn;

/// A liquid at rest in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HydrostaticTank {
    /// The liquid along gravity.
    pub column: HydrostaticColumn,
    /// Unit vector downwards d.
    pub down: [f64; 2],
    /// A place at the height zero x₀, m.
    pub floor: [f64; 2],
}

impl HydrostaticTank {
    /// Height above the floor, m.
    pub fn height(&self, [x, y]: [f64; 2]) -> f64 {
        -self.down[0] * (x - self.floor[0]) - self.down[1] * (y - self.floor[1])
    }

    /// y of the surface at x, m, where gravity has a part along −y.
    pub fn surface(&self, x: f64) -> f64 {
        let height = self.column.height + self.down[0] * (x - self.floor[0]);
        self.floor[1] - height / self.down[1]
    }

    /// Density ρ, kg/m³.
    pub fn density(&self, position: [f64; 2]) -> f64 {
        self.column.density(self.height(position))
    }

    /// Pressure p, Pa.
    pub fn pressure(&self, position: [f64; 2]) -> f64 {
        self.column.pressure(self.height(position))
    }

    /// Acceleration b, m/s².
    pub fn acceleration(&self) -> [f64; 2] {
        self.down.map(|along| self.column.gravity * along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tank(degrees: f64) -> HydrostaticTank {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        HydrostaticTank {
            column: HydrostaticColumn {
                height: 0.8,
                gravity: 9.81,
                density: 1000.0,
                sound_speed: 12.0,
            },
            down: [sine, -cosine],
            floor: [0.7, 0.1],
        }
    }

    /// ∇p = ρ b.
    #[test]
    fn pressure_holds_the_weight() {
        let step = 1e-5;
        for degrees in [0.0, 30.0, 77.0] {
            let tank = tank(degrees);
            for place in [[0.1, 0.2], [0.6, 0.4], [0.9, -0.3]] {
                for axis in 0..2 {
                    let at = |by: f64| {
                        let mut moved = place;
                        moved[axis] += by;
                        tank.pressure(moved)
                    };
                    let slope = (at(step) - at(-step)) / (2.0 * step);
                    let weight = tank.density(place) * tank.acceleration()[axis];
                    assert!((slope - weight).abs() < 1e-3, "{degrees}: {slope} {weight}");
                }
            }
        }
    }

    /// p = 0 along the surface, p > 0 below, and as deep as the place that it is measured from.
    #[test]
    fn the_surface_is_a_plane_without_pressure() {
        let tank = tank(30.0);
        let [x, y] = tank.down;
        for along in [-0.4, 0.0, 1.3] {
            let up = |height: f64| [0.7 - height * x - along * y, 0.1 - height * y + along * x];
            assert!(tank.pressure(up(0.8)).abs() < 1e-8);
            let [at, surface] = up(0.8);
            assert!((tank.surface(at) - surface).abs() < 1e-14);
            assert!((tank.pressure(up(0.0)) / tank.column.pressure(0.0) - 1.0).abs() < 1e-12);
        }
    }
}
