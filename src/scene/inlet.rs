//! Fluid that enters through a part of a face.

use serde::{Deserialize, Serialize};

use super::axes;
use crate::error::InvalidInput;

/// Which of the two faces of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// The face at the lower end.
    Lower,
    /// The face at the upper end.
    Upper,
}

/// How the velocity of an inlet varies over its opening.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InletProfile {
    /// The same everywhere.
    #[default]
    Uniform,
    /// `6 s (1 − s)` times the mean along every axis of the opening, s from 0 to 1: that of Poiseuille
    /// flow in 2D.
    Parabolic,
}

/// Where the points of an inlet come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Supply {
    /// A lattice slides in with the prescribed velocity: a row of the opening gets its next point when
    /// ∫ v dt has grown by a point spacing. For points that carry mass, and for all others.
    #[default]
    Flux,
    /// The two columns of \[Song2020\]: the points of the first column of cells are put back to
    /// their places in every step, and a cell of the second that holds fewer points than at the start
    /// gets new ones, with reconstructed fields. Their nominal mass is what has flowed in since, see
    /// [`InletSpec`].
    Columns,
}

/// An opening in a face through which fluid enters with a prescribed velocity.
///
/// The first column of cells behind the face belongs to the inlet: the nodes of its opening have the
/// prescribed velocity, and the rest of it is a slip wall. What lies beyond is the flow, so that the
/// mass flux into it is ∫ ρ v·n dA over the opening. The column, with [`Supply::Columns`] the second
/// one too, is full at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InletSpec<const D: usize> {
    /// Axis of the face.
    pub axis: usize,
    /// Which face of the axis; it must be neither periodic nor open.
    pub side: Side,
    /// Lower corner of the opening on a face between cells, m; the entry of `axis` is ignored.
    #[serde(with = "axes")]
    pub lower: [f64; D],
    /// Upper corner of the opening, as `lower`.
    #[serde(with = "axes")]
    pub upper: [f64; D],
    /// Mean velocity, m/s; it points into the box.
    #[serde(with = "axes")]
    pub velocity: [f64; D],
    /// How the velocity varies over the opening.
    #[serde(default)]
    pub profile: InletProfile,
    /// Whether the pressure grows along the body force from zero at the opening's edge, p = ρ₀ b·(x − x₀);
    /// else it is zero.
    #[serde(default)]
    pub hydrostatic: bool,
    /// Points per cell and axis.
    pub points_per_axis: usize,
    /// Where the points come from.
    #[serde(default)]
    pub supply: Supply,
}

impl<const D: usize> InletSpec<D> {
    /// Velocity at a position in the opening, m/s.
    pub fn velocity_at(&self, position: [f64; D]) -> [f64; D] {
        let shape: f64 = (0..D).map(|axis| self.factor(position, axis)).product();
        self.velocity.map(|v| v * shape)
    }

    /// `[i][j] = ∂v_i/∂x_j` at a position in the opening, 1/s.
    pub fn gradient_at(&self, position: [f64; D]) -> [[f64; D]; D] {
        let mut slopes = [0.0; D];
        for (axis, slope) in slopes.iter_mut().enumerate() {
            let others: f64 =
                (0..D).filter(|&other| other != axis).map(|o| self.factor(position, o)).product();
            *slope = others * self.slope(position, axis);
        }
        self.velocity.map(|v| slopes.map(|slope| v * slope))
    }

    /// Share of the position along an axis of the opening, 0 to 1; none along the face's own axis.
    fn place(&self, position: [f64; D], axis: usize) -> Option<f64> {
        let varies = self.profile == InletProfile::Parabolic && axis != self.axis;
        let along = (position[axis] - self.lower[axis]) / (self.upper[axis] - self.lower[axis]);
        varies.then(|| along.clamp(0.0, 1.0))
    }

    fn factor(&self, position: [f64; D], axis: usize) -> f64 {
        self.place(position, axis).map_or(1.0, |s| 6.0 * s * (1.0 - s))
    }

    fn slope(&self, position: [f64; D], axis: usize) -> f64 {
        let length = self.upper[axis] - self.lower[axis];
        self.place(position, axis).map_or(0.0, |s| 6.0 * (1.0 - 2.0 * s) / length)
    }

    /// Pressure at a position in the opening under an acceleration (m/s²), Pa.
    pub fn pressure_at(
        &self,
        position: [f64; D],
        reference_density: f64,
        body_force: [f64; D],
    ) -> f64 {
        if !self.hydrostatic {
            return 0.0;
        }
        let along = |axis: usize| {
            let force = body_force[axis];
            let edge = if force < 0.0 { self.upper[axis] } else { self.lower[axis] };
            force * (position[axis] - edge)
        };
        reference_density * (0..D).filter(|&axis| axis != self.axis).map(along).sum::<f64>()
    }

    /// Checks what does not depend on the grid; `field` is where the inlet stands in the scene.
    ///
    /// # Errors
    /// Names the first entry out of range.
    pub fn check(&self, field: &str) -> Result<(), InvalidInput> {
        let error = |name: &str, value: String, allowed: &str| {
            Err(InvalidInput::new(format!("{field}.{name}"), value, allowed))
        };
        if self.axis >= D {
            return error("axis", self.axis.to_string(), &format!("0 to {}", D - 1));
        }
        if !(1..=8).contains(&self.points_per_axis) {
            return error("points_per_axis", self.points_per_axis.to_string(), "1 to 8");
        }
        let inward = match self.side {
            Side::Lower => self.velocity[self.axis],
            Side::Upper => -self.velocity[self.axis],
        };
        if !(self.velocity.iter().all(|v| v.is_finite()) && inward > 0.0) {
            let allowed = "finite, in m/s, and into the box along the face's axis";
            return error("velocity", format!("{:?}", self.velocity), allowed);
        }
        let spans = |axis: usize| {
            let (lower, upper) = (self.lower[axis], self.upper[axis]);
            lower.is_finite() && upper.is_finite() && lower < upper
        };
        if !(0..D).all(|axis| axis == self.axis || spans(axis)) {
            return error("upper", format!("{:?}", self.upper), "above `lower`, in m");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inlet() -> InletSpec<2> {
        InletSpec {
            axis: 0,
            side: Side::Lower,
            lower: [0.0, 1.0],
            upper: [0.0, 3.0],
            velocity: [2.0, 0.5],
            profile: InletProfile::Parabolic,
            hydrostatic: true,
            points_per_axis: 2,
            supply: Supply::Flux,
        }
    }

    #[test]
    fn a_parabola_has_the_mean_velocity_and_its_own_gradient() {
        let inlet = inlet();
        let n = 1000;
        let mean: f64 = (0..n)
            .map(|k| inlet.velocity_at([0.0, 1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(n)])[0])
            .sum::<f64>()
            / f64::from(n);
        assert!((mean - 2.0).abs() < 1e-5, "{mean}");
        assert!((inlet.velocity_at([9.0, 2.0])[0] - 3.0).abs() < 1e-15);
        let (at, d) = ([0.0, 1.3], 1e-6);
        let slope = (inlet.velocity_at([0.0, at[1] + d])[1] - inlet.velocity_at(at)[1]) / d;
        let gradient = inlet.gradient_at(at);
        assert!((gradient[1][1] - slope).abs() < 1e-5 && gradient[0][0] == 0.0);
        let uniform = InletSpec { profile: InletProfile::Uniform, ..inlet };
        assert_eq!(uniform.velocity_at(at), [2.0, 0.5]);
        assert_eq!(uniform.gradient_at(at), [[0.0; 2]; 2]);
    }

    #[test]
    fn pressure_grows_along_the_body_force() {
        let inlet = inlet();
        let at = |y: f64, g: f64| inlet.pressure_at([5.0, y], 1000.0, [7.0, g]);
        assert_eq!([at(3.0, -10.0), at(1.0, -10.0)], [0.0, 20_000.0]);
        assert_eq!([at(1.0, 10.0), at(2.0, 10.0)], [0.0, 10_000.0]);
        let still = InletSpec { hydrostatic: false, ..inlet };
        assert_eq!(still.pressure_at([0.0, 1.0], 1000.0, [0.0, -10.0]), 0.0);
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let fields = [
            (InletSpec { axis: 2, ..inlet() }, "axis"),
            (InletSpec { points_per_axis: 0, ..inlet() }, "points_per_axis"),
            (InletSpec { velocity: [-2.0, 0.0], ..inlet() }, "velocity"),
            (InletSpec { side: Side::Upper, ..inlet() }, "velocity"),
            (InletSpec { velocity: [f64::NAN, 0.0], ..inlet() }, "velocity"),
            (InletSpec { upper: [0.0, 1.0], ..inlet() }, "upper"),
        ];
        for (inlet, field) in fields {
            assert_eq!(inlet.check("inlets[0]").unwrap_err().field, format!("inlets[0].{field}"));
        }
        assert!(inlet().check("inlets[0]").is_ok());
    }
}
