//! Errors of building and stepping a simulation.

use thiserror::Error;

/// A scene or a method that cannot be built; names the field, its value and what is allowed.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field}: {value} is not allowed; {allowed}")]
pub struct InvalidInput {
    /// Path of the offending field, e.g. `grid.spacing[1]`.
    pub field: String,
    /// The value found.
    pub value: String,
    /// What would be accepted.
    pub allowed: String,
}

impl InvalidInput {
    /// Builds the error from anything printable.
    pub fn new(
        field: impl Into<String>,
        value: impl std::fmt::Display,
        allowed: impl Into<String>,
    ) -> Self {
        Self { field: field.into(), value: value.to_string(), allowed: allowed.into() }
    }
}

/// A step that cannot go on: the run has blown up, which is a result to be recorded.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepError {
    /// A field of a point is not finite.
    #[error("point {id} has a {field} that is not finite at t = {time} s")]
    NotFinite {
        /// Identifier of the point.
        id: u32,
        /// Name of the field.
        field: &'static str,
        /// Time at the start of the step, s.
        time: f64,
    },
    /// A point's density is not positive.
    #[error("point {id} has density {density} kg/m³ at t = {time} s")]
    NotPositive {
        /// Identifier of the point.
        id: u32,
        /// The density found, kg/m³.
        density: f64,
        /// Time at the start of the step, s.
        time: f64,
    },
    /// A point has crossed a closed wall.
    #[error("point {id} has left the domain through a wall at {position:?} m, t = {time} s")]
    LeftDomain {
        /// Identifier of the point.
        id: u32,
        /// Its position, m.
        position: Vec<f64>,
        /// Time at the start of the step, s.
        time: f64,
    },
}
