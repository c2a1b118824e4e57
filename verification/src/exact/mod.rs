//! Closed forms that runs are measured against.

pub mod elastic_bar;
pub mod ideal_gas_riemann;
pub mod isothermal_riemann;
pub mod linear_riemann;
pub mod riemann;
pub mod sine_wave;
pub mod smooth_field;
