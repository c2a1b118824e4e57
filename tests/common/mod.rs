//! What the test files share: scenes, calls of the phases, and the checks that mutants must fail.

pub mod checks;
pub mod clouds;
pub mod gas;
pub mod parts;
pub mod phases;
pub mod rearranging;
pub mod scenes;
pub mod shape_identities;

use transpoint::{Observation, Scalar};

/// Round-off unit of a scalar type.
pub trait Precision: Scalar {
    /// Distance from 1 to the next number.
    const UNIT: f64;
}

impl Precision for f64 {
    const UNIT: f64 = f64::EPSILON;
}

impl Precision for f32 {
    const UNIT: f64 = f32::EPSILON as f64;
}

/// What a check found: nothing, or what is wrong.
pub type Check = Result<(), String>;

/// `|found − expected| ≤ bound`; a NaN fails.
pub fn near(what: &str, found: f64, expected: f64, bound: f64) -> Check {
    let error = (found - expected).abs();
    if error <= bound {
        return Ok(());
    }
    Err(format!("{what}: {found:e} is not {expected:e}: error {error:e} > {bound:e}"))
}

/// Numbers from 0 to 1 that depend on a seed alone (splitmix64).
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// The next number in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / 2.0_f64.powi(64)
    }

    /// The next number in `[−1, 1)`.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
}

/// Largest differences of two states, made dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Of positions over `length`.
    pub position: f64,
    /// Of velocities over `speed`.
    pub velocity: f64,
    /// Of densities, relative.
    pub density: f64,
}

impl Gap {
    /// Compares point by point, `b` being given in the frame of `a`.
    pub fn between<const D: usize>(
        a: &Observation<D>,
        b: &Observation<D>,
        (length, speed): (f64, f64),
    ) -> Self {
        assert_eq!(a.points.len(), b.points.len());
        let mut gap = Self { position: 0.0, velocity: 0.0, density: 0.0 };
        // `max` would drop a NaN.
        let raise = |most: &mut f64, x: f64| {
            if !(x <= *most) {
                *most = x;
            }
        };
        for (p, q) in a.points.iter().zip(&b.points) {
            assert_eq!(p.id, q.id);
            for axis in 0..D {
                raise(&mut gap.position, (p.position[axis] - q.position[axis]).abs() / length);
                raise(&mut gap.velocity, (p.velocity[axis] - q.velocity[axis]).abs() / speed);
            }
            raise(&mut gap.density, (p.density - q.density).abs() / p.density);
        }
        gap
    }

    /// The largest of the three.
    pub fn largest(&self) -> f64 {
        if self.position.is_nan() || self.velocity.is_nan() || self.density.is_nan() {
            return f64::NAN;
        }
        self.position.max(self.velocity).max(self.density)
    }
}

/// The first failure.
pub fn all<const N: usize>(checks: [Check; N]) -> Check {
    checks.into_iter().collect()
}
