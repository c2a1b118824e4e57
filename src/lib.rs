//! One generic particle solver for weakly compressible, free-surface flow.
//!
//! The modules stand in reading order.

#![cfg_attr(test, allow(dead_code, reason = "unit tests build no variant"))]

pub mod error;
pub mod scalar;

pub mod scene;
mod scene_check;

pub mod grid;
pub mod math;
pub mod parallel;
pub mod particles;

pub mod cells;
pub mod nodes;
pub mod shape;
mod simd;
pub mod stencil;

pub mod basis;
pub mod quadrature;
pub mod reconstruction;
pub mod transfer;

pub mod equation_of_state;
pub mod formulation;
pub mod material;

pub mod method;
pub mod settings;
pub mod step;

mod affine_density;
mod bodies;
pub mod conservation;
mod failure;
mod inflow;
mod lengths;
mod outflow;
pub mod rearrangement;
pub mod simulation;
mod smoothing;
pub mod solver;
mod stable_step;
pub mod telemetry;
pub mod time_step;
pub mod variants;

pub use error::{InvalidInput, StepError};
pub use scalar::Scalar;
pub use scene::Scene;
pub use simd::limit_to_baseline;
pub use simulation::{Observation, Simulation};
pub use solver::Solver;
pub use variants::{Settings, Variant};

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
