//! Closed forms that runs are measured against.

pub mod sine_wave;
pub mod smooth_field;
