//! Parts of methods, and disordered blocks to try them on.

use proptest::prelude::*;
use transpoint::basis;
use transpoint::quadrature::Mixed;
use transpoint::reconstruction::MovingLeastSquares;
use transpoint::scene::Boundary;
use transpoint::shape::Gimp;
use transpoint::transfer::Flip;
use transpoint::variants::{Blend, PointVolume};

use super::scenes::{Block, SOUND_SPEED};

pub const FLIP: Flip = Flip { blend: Blend::PerStep(1.0) };
pub const BLEND: Flip = Flip { blend: Blend::PerStep(0.7) };
pub const GIMP: Gimp<f64> = Gimp { length: 0.5 };
pub const MIXED: Mixed = Mixed::new(PointVolume::VolumeFraction);

/// A time step at Courant number 0.25.
pub const DT: f64 = 0.25 * 0.09 / SOUND_SPEED;

/// Linear moving least squares with support 1.
pub fn mls() -> MovingLeastSquares<basis::Linear, f64> {
    MovingLeastSquares::new(1.0)
}

/// A disordered block: filling a periodic box, or in the middle of a box with free faces.
pub fn block<const D: usize>((seed, periodic): (u64, bool)) -> Block<D> {
    if periodic {
        return Block::full(4, Boundary::Periodic).random(seed);
    }
    Block { fluid: [[3.0, 6.5]; D], ..Block::full(10, Boundary::Free).random(seed) }
}

/// What `block` is made from.
pub fn setup() -> impl Strategy<Value = (u64, bool)> {
    (any::<u64>(), any::<bool>())
}

/// A short run of shrinkable cases that leaves no files behind.
pub fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig { failure_persistence: None, cases, ..ProptestConfig::default() }
}
