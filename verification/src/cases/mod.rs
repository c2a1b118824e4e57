//! The studies: one file each, one line each in the list.

pub mod operators;
pub mod sine_wave;
pub mod spectral;

use crate::case::Case;

/// Every case, in the order of the page.
pub static ALL: [&dyn Case; 3] = [&sine_wave::SineWave, &operators::Operators, &spectral::Spectral];
