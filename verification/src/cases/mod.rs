//! The studies: one file each, one line each in the list.

mod lattice;
mod march;
pub mod operators;
pub mod riemann;
pub mod sine_wave;
pub mod sod;
pub mod spectral;

use crate::case::Case;

/// Every case, in the order of the page.
pub static ALL: [&dyn Case; 5] = [
    &sine_wave::SineWave,
    &riemann::Riemann,
    &sod::Sod,
    &operators::Operators,
    &spectral::Spectral,
];
