//! What becomes of a point after its update: its cell, its removal, or the end of the run.

use crate::Scalar;
use crate::cells::ABSENT;
use crate::grid::Grid;
use crate::scene::Boundary;

/// Why a point cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// Velocity or position is not finite.
    NotFinite,
    /// Density is not positive.
    NotPositive,
    /// The point has crossed a wall.
    LeftDomain,
}

/// What became of the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// First failing point and why.
    pub failure: Option<(usize, Failure)>,
    /// Points marked for removal.
    pub n_removed: u64,
    /// Points raised to the minimum density.
    pub n_raised: u64,
}

impl Outcome {
    /// Records a failure of a point unless there was one before.
    #[inline(always)]
    pub(super) fn note(&mut self, point: usize, failure: Option<Failure>) {
        if self.failure.is_none() {
            self.failure = failure.map(|why| (point, why));
        }
    }

    pub(super) fn then(self, later: Self) -> Self {
        Self {
            failure: self.failure.or(later.failure),
            n_removed: self.n_removed + later.n_removed,
            n_raised: self.n_raised + later.n_raised,
        }
    }
}

/// Moves a point into the box over periodic faces and finds its cell.
///
/// [`ABSENT`] marks a point that has left through a free face; `None` one that has left elsewhere.
#[inline(never)]
pub(crate) fn settle<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    boundaries: &[[Boundary; 2]; D],
    position: &mut [T; D],
) -> Option<u32> {
    if let Some(cell) = grid.cell_of(*position) {
        return Some(cell);
    }
    let mut removed = false;
    for axis in 0..D {
        let n = T::from_index(grid.n_cells[axis]);
        let below = grid.in_cells(*position, axis) < T::zero();
        let above = grid.in_cells(*position, axis) > n;
        if grid.periodic[axis] && (below || above) {
            let length = grid.spacing[axis] * n;
            position[axis] += if below { length } else { -length };
            // On the face itself rounding can put the image out on the other side.
            let image = grid.in_cells(*position, axis);
            if (below && image > n) || (above && image < T::zero()) {
                position[axis] = grid.origin[axis];
            }
        } else if below || above {
            removed |= boundaries[axis][usize::from(above)].is_open();
        }
    }
    if removed { Some(ABSENT) } else { grid.cell_of(*position) }
}

/// Whether a point is sound, above the density `floor` and still in its cell, in which it lies at `xi`;
/// spares the search.
#[inline(always)]
pub(super) fn is_quiet<T: Scalar, const D: usize>(
    xi: &[T; 4],
    velocity: &[T; D],
    (density, floor): (T, T),
) -> bool {
    let mut quiet = density > floor;
    // Not a number unless everything is finite.
    let mut zero = T::zero() * density;
    for axis in 0..D {
        quiet &= (xi[axis] >= T::zero()) & (xi[axis] < T::one());
        zero += T::zero() * velocity[axis];
    }
    quiet && zero == T::zero()
}

#[cold]
pub(super) fn check<T: Scalar, const D: usize>(
    velocity: &[T; D],
    position: &[T; D],
    density: T,
) -> Option<Failure> {
    let mut finite = density.is_finite();
    for axis in 0..D {
        finite &= velocity[axis].is_finite() & position[axis].is_finite();
    }
    if !finite {
        Some(Failure::NotFinite)
    } else if density > T::zero() {
        None
    } else {
        Some(Failure::NotPositive)
    }
}
