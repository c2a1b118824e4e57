//! From the state of a simulation to numbers. The same measures serve every method.

pub mod cell_centers;
pub mod fragments;
pub mod norms;
pub mod null_space;
pub mod profile;
pub mod samples;
pub mod spectral;
