//! Rigid bodies at rest, given by a level set.

use serde::{Deserialize, Serialize};

use super::axes;
use crate::error::InvalidInput;

/// Shape of a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum BodyShape<const D: usize> {
    /// A circle (2D) or sphere (3D).
    Ball {
        /// Center, m.
        #[serde(with = "axes")]
        center: [f64; D],
        /// Radius, m.
        radius: f64,
    },
    /// A box along the axes.
    Box {
        /// Lower corner, m.
        #[serde(with = "axes")]
        lower: [f64; D],
        /// Upper corner, m.
        #[serde(with = "axes")]
        upper: [f64; D],
    },
}

/// What holds on the surface of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BodySurface {
    /// Normal velocity zero.
    Slip,
    /// Velocity zero.
    NoSlip,
}

/// A rigid body at rest. It is the union of the cells whose centers it contains.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodySpec<const D: usize> {
    /// Its shape.
    pub shape: BodyShape<D>,
    /// What holds on its surface.
    pub surface: BodySurface,
}

impl<const D: usize> BodyShape<D> {
    /// Level set φ, m: negative inside; the distance to the surface of a ball, and for a box the largest
    /// of the distances beyond its faces.
    pub fn level(&self, position: [f64; D]) -> f64 {
        match self {
            Self::Ball { center, radius } => {
                length::<D>(std::array::from_fn(|a| position[a] - center[a])) - radius
            }
            Self::Box { lower, upper } => (0..D)
                .fold(f64::NEG_INFINITY, |most, a| most.max(beyond(position, lower, upper, a).0)),
        }
    }

    /// Outward unit normal ∇φ; on an edge of a box that of the last of its faces, at the center of a ball
    /// along the first axis.
    pub fn normal(&self, position: [f64; D]) -> [f64; D] {
        match self {
            Self::Ball { center, .. } => {
                let offset: [f64; D] = std::array::from_fn(|a| position[a] - center[a]);
                let distance = length(offset);
                if distance > 0.0 {
                    offset.map(|x| x / distance)
                } else {
                    std::array::from_fn(|a| if a == 0 { 1.0 } else { 0.0 })
                }
            }
            Self::Box { lower, upper } => {
                let mut normal = [0.0; D];
                let mut most = (f64::NEG_INFINITY, 0.0, 0);
                for axis in 0..D {
                    let (distance, direction) = beyond(position, lower, upper, axis);
                    // Positions on an edge carry the rounding of their coordinates.
                    if distance >= most.0 - 1e-9 * (upper[axis] - lower[axis]) {
                        most = (distance, direction, axis);
                    }
                }
                normal[most.2] = most.1;
                normal
            }
        }
    }

    /// Checks the numbers; `field` is where the body stands in the scene.
    ///
    /// # Errors
    /// Names the first entry out of range.
    pub fn check(&self, field: &str) -> Result<(), InvalidInput> {
        let finite = |x: &[f64; D]| x.iter().all(|x| x.is_finite());
        let error = |name: &str, value: String, allowed: &str| {
            Err(InvalidInput::new(format!("{field}.shape.{name}"), value, allowed))
        };
        match self {
            Self::Ball { center, .. } if !finite(center) => {
                error("center", format!("{center:?}"), "finite, in m")
            }
            Self::Ball { radius, .. } if !(radius.is_finite() && *radius > 0.0) => {
                error("radius", radius.to_string(), "a positive length in m")
            }
            Self::Box { lower, .. } if !finite(lower) => {
                error("lower", format!("{lower:?}"), "finite, in m")
            }
            Self::Box { lower, upper }
                if !(finite(upper) && (0..D).all(|a| lower[a] < upper[a])) =>
            {
                error("upper", format!("{upper:?}"), "finite and above `lower`, in m")
            }
            _ => Ok(()),
        }
    }
}

fn length<const D: usize>(vector: [f64; D]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Distance beyond the nearer face of an axis, and the outward direction there.
fn beyond<const D: usize>(
    position: [f64; D],
    lower: &[f64; D],
    upper: &[f64; D],
    axis: usize,
) -> (f64, f64) {
    let (below, above) = (lower[axis] - position[axis], position[axis] - upper[axis]);
    if above >= below { (above, 1.0) } else { (below, -1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_distances_and_normals_their_gradients() {
        let ball = BodyShape::Ball { center: [1.0, 2.0], radius: 0.5 };
        let slab = BodyShape::Box { lower: [0.0, -1.0], upper: [4.0, 1.0] };
        assert!((ball.level([1.0, 3.0]) - 0.5).abs() < 1e-15 && ball.level([1.0, 2.1]) < 0.0);
        assert_eq!([slab.level([2.0, 1.5]), slab.level([2.0, 0.75])], [0.5, -0.25]);
        for (shape, at) in
            [(ball, [1.7, 2.4]), (slab, [2.0, 0.9]), (slab, [4.2, 0.0]), (slab, [-0.1, 0.3])]
        {
            let d = 1e-6;
            let slope = |axis: usize| {
                let mut moved = at;
                moved[axis] += d;
                (shape.level(moved) - shape.level(at)) / d
            };
            let normal = shape.normal(at);
            assert!((0..2).all(|a| (normal[a] - slope(a)).abs() < 1e-5), "{normal:?}");
        }
    }

    #[test]
    fn the_last_axis_decides_on_an_edge() {
        let slab = BodyShape::Box { lower: [0.0, 0.0], upper: [4.0, 1.0] };
        assert_eq!(slab.normal([4.0, 1.0]), [0.0, 1.0]);
        assert_eq!(slab.normal([4.0, 0.5]), [1.0, 0.0]);
        assert_eq!(BodyShape::Ball { center: [0.0; 2], radius: 1.0 }.normal([0.0; 2]), [1.0, 0.0]);
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        for (shape, field) in [
            (BodyShape::Ball { center: [f64::NAN, 0.0], radius: 1.0 }, "center"),
            (BodyShape::Ball { center: [0.0; 2], radius: 0.0 }, "radius"),
            (BodyShape::Box { lower: [0.0; 2], upper: [1.0, 0.0] }, "upper"),
            (BodyShape::Box { lower: [f64::INFINITY, 0.0], upper: [1.0; 2] }, "lower"),
        ] {
            assert_eq!(
                shape.check("bodies[3]").unwrap_err().field,
                format!("bodies[3].shape.{field}")
            );
        }
        assert!(BodyShape::Box { lower: [0.0; 2], upper: [1.0; 2] }.check("bodies[0]").is_ok());
    }
}
