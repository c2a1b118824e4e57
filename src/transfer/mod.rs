//! Velocity transfer between points and nodes.

mod apic;
mod flip;
mod taylor;

pub use apic::Apic;
pub use flip::{Flip, Pic};
pub use taylor::Tpic;

use crate::Scalar;
use crate::math::Field;

/// What a point knows about velocity besides its own value, and how it takes up the grid's.
///
/// ```
/// use transpoint::transfer::{Flip, Transfer};
/// use transpoint::variants::Blend;
/// let half = Flip { blend: Blend::PerStep(0.5) };
/// let share = Transfer::<f64, 2>::flip_share(&half, 1e-3);
/// assert_eq!(share, 0.5);
/// ```
pub trait Transfer<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Affine velocity field carried by a point; `()` when there is none.
    type Affine: Field<T>;
    /// Whether the nodes' velocity change is gathered as well as their velocity.
    const USES_INCREMENT: bool;
    /// Whether an affine field is carried.
    const AFFINE: bool;
    /// Whether that is the gradient of the nodes' velocity, not its first moment.
    const BY_GRADIENT: bool = false;

    /// Share of the FLIP update in a step of `dt` seconds, 0 to 1.
    fn flip_share(&self, dt: T) -> T;

    /// Entry of the affine matrix C: change of velocity component `row` per metre along `axis`, 1/s.
    fn affine_entry(affine: &Self::Affine, row: usize, axis: usize) -> T;

    /// Affine field of a point whose velocity gradient `[i][j] = ∂v_i/∂x_j` (1/s) is known.
    fn affine_of(gradient: [[T; D]; D]) -> Self::Affine;

    /// Affine field from `columns[a] = Σ N v (x − x_p)_a` and the diagonal of
    /// `Σ N (x − x_p)(x − x_p)ᵀ`, m², in the first entries of a row; from `columns[a] = Σ ∂N/∂x_a v` where it
    /// is [`Self::BY_GRADIENT`].
    fn affine_from(columns: &[[T; 4]; D], second_moment: &[T; 4]) -> Self::Affine;
}
