//! A force towards a point, in proportion to the distance.

use serde::{Deserialize, Serialize};

use super::axes;

/// The acceleration b = −Ω² (x − x_c), besides that of the uniform body force.
///
/// A point on which nothing else acts moves about x_c with the period 2π/Ω. The force of a mass has the
/// potential energy ½ m Ω² |x − x_c|². Angular momentum about x_c is kept; momentum is not.
///
/// It acts at the nodes, at their (Greville) abscissae. It is linear in x, so that what a point gathers
/// of it is that of its own place, in all shape functions that reproduce linear fields.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CentralForce<const D: usize> {
    /// x_c, m.
    #[serde(with = "axes")]
    pub center: [f64; D],
    /// Ω, 1/s.
    pub rate: f64,
}
