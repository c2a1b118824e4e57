//! Nodes and cells → points: velocity, density, stress and position.

use std::marker::PhantomData;

use super::cell_divergence::CellDivergence;
use super::gather::{Gathered, Site, Want};
use super::{AffineOf, CELL_GRAIN, Physics, StressOf};
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::grid::Grid;
use crate::math::narrow;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::particles::ParticlesMut;
use crate::scene::Boundary;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::{Simd, vectorized};
use crate::stencil::{Rows, moments_at, node_positions, rows_at};
use crate::stress::DeviatoricStress;
use crate::transfer::Transfer;

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
}

impl Outcome {
    /// Records a failure of a point unless there was one before.
    #[inline(always)]
    fn note(&mut self, point: usize, failure: Option<Failure>) {
        if self.failure.is_none() {
            self.failure = failure.map(|why| (point, why));
        }
    }

    fn then(self, later: Self) -> Self {
        Self {
            failure: self.failure.or(later.failure),
            n_removed: self.n_removed + later.n_removed,
        }
    }
}

/// Where the state update takes its velocities from.
#[derive(Clone, Copy, Debug)]
pub struct StateSource<'a, T> {
    /// Node velocities whose gradient strains the points.
    pub velocity: &'a [[T; 4]],
    /// Whether these are v⁺ themselves, which are gathered anyway.
    pub is_end_velocity: bool,
    /// Divergence of each active cell, 1/s; empty in the standard formulation.
    pub divergence: &'a [T],
}

/// Inputs that do not belong to the points.
pub struct GridState<'a, T, const D: usize, M, K> {
    /// The recipe.
    pub method: &'a M,
    /// What the scene prescribes.
    pub physics: &'a Physics<T, D, K>,
    /// The grid.
    pub grid: &'a Grid<T, D>,
    /// Active cells.
    pub cells: &'a Cells,
    /// First node of each stencil row of each cell.
    pub rows: &'a [u32],
    /// v⁺ of the nodes, m/s.
    pub velocity: &'a [[T; 4]],
    /// Δt a of the nodes, m/s.
    pub increment: &'a [[T; 4]],
    /// Where the state update takes its velocities from.
    pub source: StateSource<'a, T>,
}

/// What a pass over the points does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pass {
    /// v_p ← α (v_p + Σ N Δt a) + (1 − α) Σ N v⁺, and the affine field.
    pub velocity: bool,
    /// ρ_p ← ρ_p / (1 + Δt D_p), Eq. (31) of \[Song2020\], and the stress.
    pub state: bool,
    /// x_p ← x_p + Δt Σ N v⁺, and the point's cell.
    pub motion: bool,
}

/// One gather over the points; a scheme that updates the stress last does all of it in one pass.
pub fn grid_to_particles<T, const D: usize, M, K>(
    state: &GridState<'_, T, D, M, K>,
    pass: Pass,
    dt: T,
    points: ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
) -> Outcome
where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    let first = &state.cells.first;
    let work = |slots: std::ops::Range<usize>, mut points: ParticlesMut<'_, T, D, _, _>| {
        let begin = first[slots.start] as usize;
        let block = Block { state, pass, dt, begin };
        vectorized!(simd => block.run(simd, slots, &mut points))
    };
    let cut = |slot: usize| first[slot] as usize;
    fold_blocks(state.cells.len(), CELL_GRAIN, points, &cut, &work, &Outcome::then)
}

/// A block of cells; `begin` is the first point of its view.
struct Block<'a, T, const D: usize, M, K> {
    state: &'a GridState<'a, T, D, M, K>,
    pass: Pass,
    dt: T,
    begin: usize,
}

impl<T, const D: usize, M, K> Block<'_, T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    #[inline(always)]
    fn run<S: Simd>(
        &self,
        simd: S,
        slots: std::ops::Range<usize>,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
    ) -> Outcome {
        let Self { state, pass, dt, begin } = *self;
        let (shape, grid) = (state.method.shape(), *state.grid);
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let share = state.method.transfer().flip_share(dt);
        let n_rows = M::Shape::REACH.pow(D as u32 - 1);
        let mut outcome = Outcome::default();
        for slot in slots {
            let cell = grid.cell_coordinates(state.cells.index[slot]);
            let mut moments = [[T::zero(); MAX_WIDTH]; D];
            let node_at = if affine { node_positions(&shape, &grid, cell) } else { moments };
            let cell_divergence = if pass.state {
                CellDivergence::around(state, slot, cell)
            } else {
                CellDivergence::AtPoint
            };
            let starts = &state.rows[slot * n_rows..(slot + 1) * n_rows];
            let of_cell = state.cells.points(slot);
            let first = of_cell.start;
            let mut points = points.part(first - begin..of_cell.end - begin);
            for p in 0..of_cell.len() {
                let position = points.position[p];
                let rows = rows_at(&shape, &grid, cell, position);
                if affine {
                    moments = moments_at::<T, D, M::Shape>(&rows, &node_at, position);
                }
                let site = Site::<T, D, M::Shape> {
                    rows: &rows,
                    moments: &moments,
                    starts,
                    shape: PhantomData,
                };
                let found = self.gather(simd, &site);
                let motion = narrow(found.velocity);
                if pass.velocity {
                    let old = points.velocity[p];
                    points.velocity[p] =
                        blend::<T, D, M::Transfer>(share, old, found.increment, motion);
                    if affine {
                        let second =
                            second_moments::<T, D, M::Shape>(&rows, &moments, &node_at, position);
                        points.affine[p] = M::Transfer::affine_from(found.moment, second);
                    }
                }
                if pass.state {
                    self.strain(simd, p, &mut points, &site, (&found, &cell_divergence, cell));
                }
                if pass.motion {
                    for axis in 0..D {
                        points.position[p][axis] += dt * motion[axis];
                    }
                }
                let (velocity, density) = (points.velocity[p], points.density[p]);
                if !is_quiet(&grid, cell, points.position[p], velocity, density) {
                    outcome.note(first + p, check(velocity, points.position[p], density));
                    if pass.motion {
                        let place =
                            settle(&grid, &state.physics.boundaries, &mut points.position[p]);
                        points.cell[p] = place.unwrap_or(points.cell[p]);
                        outcome.note(first + p, place.is_none().then_some(Failure::LeftDomain));
                        outcome.n_removed += u64::from(place == Some(ABSENT));
                    }
                }
            }
        }
        outcome
    }

    /// What the transfer needs from the nodes.
    #[inline(always)]
    fn gather<S: Simd>(&self, simd: S, site: &Site<'_, T, D, M::Shape>) -> Gathered<T, D> {
        let (velocity, increment) = (self.state.velocity, self.state.increment);
        let want = Want {
            moments: <M::Transfer as Transfer<T, D>>::AFFINE,
            increment: <M::Transfer as Transfer<T, D>>::USES_INCREMENT,
        };
        site.gather(simd, want, velocity, increment)
    }

    /// Updates density and stress of point `p` of the view.
    #[inline(always)]
    fn strain<S: Simd>(
        &self,
        simd: S,
        p: usize,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
        site: &Site<'_, T, D, M::Shape>,
        (found, cell_divergence, cell): (&Gathered<T, D>, &CellDivergence<T>, [usize; D]),
    ) {
        let source = &self.state.source;
        let divergence = match cell_divergence {
            CellDivergence::AtPoint if source.is_end_velocity => found.divergence,
            CellDivergence::AtPoint => {
                let want = Want { moments: false, increment: false };
                site.gather(simd, want, source.velocity, &[]).divergence
            }
            CellDivergence::Around(..) => {
                cell_divergence.at(&grid_xi(self.state.grid, cell, points.position[p]))
            }
        };
        points.density[p] /= T::one() + self.dt * divergence;
        if K::PRESENT {
            let gradient = site.velocity_gradient(simd, source.velocity);
            points.stress[p] = self.state.physics.stress.update(points.density[p], &gradient);
        }
    }
}

/// Diagonal of Σ N (x − x_p)(x − x_p)ᵀ, m².
#[inline(always)]
fn second_moments<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    rows: &Rows<T, D>,
    moments: &[[T; MAX_WIDTH]; D],
    node_at: &[[T; MAX_WIDTH]; D],
    position: [T; D],
) -> [T; D] {
    let mut second = [T::zero(); D];
    for axis in 0..D {
        for k in 0..H::WIDTH {
            let offset = node_at[axis][rows[axis].first + k] - position[axis];
            second[axis] += moments[axis][k] * offset;
        }
    }
    second
}

#[inline(always)]
fn blend<T: Scalar, const D: usize, X: Transfer<T, D>>(
    share: T,
    old: [T; D],
    increment: [T; 4],
    grid: [T; D],
) -> [T; D] {
    if !X::USES_INCREMENT {
        return grid;
    }
    let rest = T::one() - share;
    std::array::from_fn(|axis| share * (old[axis] + increment[axis]) + rest * grid[axis])
}

/// Moves a point into the box over periodic faces and finds its cell.
///
/// [`ABSENT`] marks a point that has left through a free face; `None` one that has left elsewhere.
#[inline(never)]
fn settle<T: Scalar, const D: usize>(
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
            removed |= boundaries[axis][usize::from(above)] == Boundary::Free;
        }
    }
    if removed { Some(ABSENT) } else { grid.cell_of(*position) }
}

/// Whether a point is sound and still in its cell, which spares the search.
#[inline(always)]
fn is_quiet<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    position: [T; D],
    velocity: [T; D],
    density: T,
) -> bool {
    let mut quiet = density > T::zero() && density.is_finite();
    let mut zero = T::zero();
    for axis in 0..D {
        let xi = grid.in_cells(position, axis) - T::from_index(cell[axis]);
        quiet &= xi >= T::zero() && xi < T::one();
        zero += T::zero() * velocity[axis];
    }
    quiet && zero == T::zero()
}

#[cold]
fn check<T: Scalar, const D: usize>(
    velocity: [T; D],
    position: [T; D],
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

#[inline(always)]
fn grid_xi<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    position: [T; D],
) -> [T; D] {
    std::array::from_fn(|axis| grid.in_cells(position, axis) - T::from_index(cell[axis]))
}
