//! The studies: one file each, one line each in the list.

pub mod sine_wave;

use crate::case::Case;

/// Every case, in the order of the page.
pub static ALL: [&dyn Case; 1] = [&sine_wave::SineWave];
