//! One generic particle solver for weakly compressible, free-surface flow.
//!
//! The modules stand in reading order.

pub mod error;
pub mod scalar;
pub mod scene;
pub mod shape;
pub mod simulation;
pub mod telemetry;
pub mod time_step;
pub mod variants;

pub use error::{InvalidInput, StepError};
pub use scalar::Scalar;
pub use scene::Scene;
pub use simulation::{Observation, Simulation};
pub use variants::{Settings, Variant};
