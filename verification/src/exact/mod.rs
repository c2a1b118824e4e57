//! Closed forms that runs are measured against.

pub mod acoustic;
pub mod acoustic_radial;
pub mod elastic_bar;
pub mod elliptical_drop;
pub mod generalized_vortex;
pub mod gravity_wave;
pub mod gresho;
pub mod hydrostatic_column;
pub mod hydrostatic_tank;
pub mod ideal_gas_riemann;
pub mod isothermal_riemann;
pub mod jet_on_plate;
pub mod linear_riemann;
pub mod loaded_column;
mod quadrature;
pub mod riemann;
pub mod shear;
pub mod sine_wave;
pub mod smooth_field;
pub mod solitary_wave;
pub mod taylor_green;
