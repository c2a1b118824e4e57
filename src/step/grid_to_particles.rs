//! Nodes and cells → points: velocity, density, stress and position.

use super::{AffineOf, CELL_GRAIN, Physics, StressOf};
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::formulation::{Formulation, PointDivergence};
use crate::grid::Grid;
use crate::math::{add_row, narrow};
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::particles::ParticlesMut;
use crate::scene::Boundary;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::stencil::{Rows, for_each_outer_row, node_positions, rows_at};
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

/// One gather over the points. What it does is fixed at compile time:
///
/// - `VELOCITY`: v_p ← α (v_p + Σ N Δt a) + (1 − α) Σ N v⁺, and the affine field;
/// - `STATE`: ρ_p ← ρ_p / (1 + Δt D_p), Eq. (31) of \[Song2020\], and the stress;
/// - `MOVE`: x_p ← x_p + Δt Σ N v⁺, and the point's cell.
///
/// A scheme that updates the stress last does all three in one pass.
pub fn grid_to_particles<
    T,
    const D: usize,
    M,
    K,
    const VELOCITY: bool,
    const STATE: bool,
    const MOVE: bool,
>(
    state: &GridState<'_, T, D, M, K>,
    dt: T,
    points: ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
) -> Outcome
where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    let by_cell = matches!(state.method.formulation(), Formulation::VelocityPressure(_));
    let first = &state.cells.first;
    let work = |slots: std::ops::Range<usize>, mut points: ParticlesMut<'_, T, D, _, _>| {
        let mut outcome = Outcome::default();
        let begin = first[slots.start] as usize;
        for slot in slots {
            let pass = CellPass { state, dt, slot, begin };
            let done = if STATE && (K::PRESENT || !by_cell) {
                pass.run::<VELOCITY, STATE, MOVE, true>(&mut points)
            } else {
                pass.run::<VELOCITY, STATE, MOVE, false>(&mut points)
            };
            outcome = outcome.then(done);
        }
        outcome
    };
    let cut = |slot: usize| first[slot] as usize;
    fold_blocks(state.cells.len(), CELL_GRAIN, points, &cut, &work, &Outcome::then)
}

/// The points of one cell in one pass; `begin` is the first point of the task's view.
struct CellPass<'a, T, const D: usize, M, K> {
    state: &'a GridState<'a, T, D, M, K>,
    dt: T,
    slot: usize,
    begin: usize,
}

impl<T, const D: usize, M, K> CellPass<'_, T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    #[inline(always)]
    fn run<const VELOCITY: bool, const STATE: bool, const MOVE: bool, const GRADIENT: bool>(
        &self,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
    ) -> Outcome {
        let Self { state, dt, slot, begin } = *self;
        let shape = state.method.shape();
        let grid = state.grid;
        let cell = grid.cell_coordinates(state.cells.index[slot]);
        let n_rows = M::Shape::REACH.pow(D as u32 - 1);
        let starts = &state.rows[slot * n_rows..(slot + 1) * n_rows];
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let node_at = if affine && VELOCITY {
            node_positions(&shape, grid, cell)
        } else {
            [[T::zero(); 4]; D]
        };
        let share = state.method.transfer().flip_share(dt);
        let cell_divergence =
            if STATE { CellDivergence::around(state, slot, cell) } else { CellDivergence::AtPoint };
        let mut outcome = Outcome::default();
        for point in state.cells.points(slot) {
            let p = point - begin;
            let rows = rows_at(&shape, grid, cell, points.position[p]);
            let found =
                self.gather::<VELOCITY, GRADIENT>(starts, &rows, &node_at, points.position[p]);
            let motion = narrow(found.velocity);
            if VELOCITY {
                points.velocity[p] =
                    blend::<T, D, M::Transfer>(share, points.velocity[p], found.increment, motion);
                if affine {
                    points.affine[p] = found.affine::<M::Transfer>();
                }
            }
            if STATE {
                let gradient = found.velocity_gradient();
                let divergence =
                    cell_divergence.at(&gradient, &grid_xi(grid, cell, points.position[p]));
                points.density[p] /= T::one() + dt * divergence;
                if K::PRESENT {
                    points.stress[p] = state.physics.stress.update(points.density[p], &gradient);
                }
            }
            if MOVE {
                let position = &mut points.position[p];
                for axis in 0..D {
                    position[axis] += dt * motion[axis];
                }
                if let Some(place) = settle(grid, &state.physics.boundaries, position) {
                    points.cell[p] = place;
                    outcome.n_removed += u64::from(place == ABSENT);
                } else if outcome.failure.is_none() {
                    outcome.failure = Some((point, Failure::LeftDomain));
                }
            }
            if outcome.failure.is_none_or(|(first, _)| first == point) {
                let sound = check(points.velocity[p], points.position[p], points.density[p]);
                outcome.failure = sound.map(|why| (point, why)).or(outcome.failure);
            }
        }
        outcome
    }

    /// Sums over the nodes of a point.
    #[inline(always)]
    fn gather<const VELOCITY: bool, const GRADIENT: bool>(
        &self,
        starts: &[u32],
        rows: &Rows<T, D>,
        node_at: &[[T; MAX_WIDTH]; D],
        position: [T; D],
    ) -> Gathered<T, D> {
        let mut sums = Gathered::zero();
        let last = rows[D - 1];
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE && VELOCITY;
        let increments = <M::Transfer as Transfer<T, D>>::USES_INCREMENT && VELOCITY;
        let mut offset = [[T::zero(); MAX_WIDTH]; D];
        if affine {
            for axis in 0..D {
                for k in 0..M::Shape::WIDTH {
                    offset[axis][k] = node_at[axis][rows[axis].first + k] - position[axis];
                    let second = rows[axis].weight[k] * offset[axis][k] * offset[axis][k];
                    sums.second_moment[axis] += second;
                }
            }
        }
        let width = M::Shape::WIDTH;
        for_each_outer_row::<T, D, M::Shape>(rows, |outer| {
            let start = starts[outer.row] as usize + last.first;
            let velocity = &self.state.velocity[start..start + width];
            let mut line = RowSums::zero();
            for k in 0..width {
                add_row(&mut line.velocity, last.weight[k], velocity[k]);
                if affine {
                    add_row(&mut line.moment, last.weight[k] * offset[D - 1][k], velocity[k]);
                }
            }
            if increments {
                let increment = &self.state.increment[start..start + width];
                for k in 0..width {
                    add_row(&mut line.increment, last.weight[k], increment[k]);
                }
                add_row(&mut sums.increment, outer.weight, line.increment);
            }
            add_row(&mut sums.velocity, outer.weight, line.velocity);
            if affine {
                for axis in 0..D - 1 {
                    let weight = outer.weight * offset[axis][outer.index[axis]];
                    add_row(&mut sums.moment[axis], weight, line.velocity);
                }
                add_row(&mut sums.moment[D - 1], outer.weight, line.moment);
            }
            if GRADIENT {
                let source = &self.state.source.velocity[start..start + width];
                let (mut value, mut slope) = ([T::zero(); 4], [T::zero(); 4]);
                for k in 0..width {
                    add_row(&mut value, last.weight[k], source[k]);
                    add_row(&mut slope, last.gradient[k], source[k]);
                }
                for axis in 0..D - 1 {
                    add_row(&mut sums.gradient[axis], outer.gradient[axis], value);
                }
                add_row(&mut sums.gradient[D - 1], outer.weight, slope);
            }
        });
        sums
    }
}

/// Sums along one stencil row.
struct RowSums<T> {
    velocity: [T; 4],
    increment: [T; 4],
    moment: [T; 4],
}

impl<T: Scalar> RowSums<T> {
    #[inline(always)]
    fn zero() -> Self {
        let zero = [T::zero(); 4];
        Self { velocity: zero, increment: zero, moment: zero }
    }
}

/// What a point gathers from its nodes; `gradient[j]` is ∂v/∂x_j, `moment[j]` is Σ N v (x − x_p)_j.
struct Gathered<T, const D: usize> {
    velocity: [T; 4],
    increment: [T; 4],
    gradient: [[T; 4]; D],
    moment: [[T; 4]; D],
    second_moment: [T; D],
}

impl<T: Scalar, const D: usize> Gathered<T, D> {
    #[inline(always)]
    fn zero() -> Self {
        let zero = [T::zero(); 4];
        Self {
            velocity: zero,
            increment: zero,
            gradient: [zero; D],
            moment: [zero; D],
            second_moment: [T::zero(); D],
        }
    }

    #[inline(always)]
    fn affine<X: Transfer<T, D>>(&self) -> X::Affine {
        X::affine_from(self.moment, self.second_moment)
    }

    #[inline(always)]
    fn velocity_gradient(&self) -> [[T; D]; D] {
        std::array::from_fn(|i| std::array::from_fn(|j| self.gradient[j][i]))
    }
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
#[inline(always)]
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
        let length = grid.spacing[axis] * T::lit(grid.n_cells[axis] as f64);
        let below = position[axis] < grid.origin[axis];
        let above = position[axis] > grid.origin[axis] + length;
        if grid.periodic[axis] {
            if below {
                position[axis] += length;
            } else if above {
                position[axis] -= length;
            }
        } else if below || above {
            removed |= boundaries[axis][usize::from(above)] == Boundary::Free;
        }
    }
    if removed { Some(ABSENT) } else { grid.cell_of(*position) }
}

#[inline(always)]
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
    std::array::from_fn(|axis| grid.in_cells(position, axis) - T::lit(cell[axis] as f64))
}

/// Divergence at the points of one cell.
enum CellDivergence<T> {
    /// Trace of the velocity gradient at the point.
    AtPoint,
    /// Weighted mean of the 3^D cells around.
    Around(PointDivergence, [T; 27]),
}

impl<T: Scalar> CellDivergence<T> {
    #[inline(always)]
    fn around<const D: usize, M: Method<T, D>, K: DeviatoricStress<T, D>>(
        state: &GridState<'_, T, D, M, K>,
        slot: usize,
        cell: [usize; D],
    ) -> Self {
        let Formulation::VelocityPressure(kind) = state.method.formulation() else {
            return Self::AtPoint;
        };
        let values = state.source.divergence;
        let mut around = [values[slot]; 27];
        if kind != PointDivergence::Constant {
            for (code, value) in around.iter_mut().enumerate().take(3_usize.pow(D as u32)) {
                let mut rest = code;
                let shift = std::array::from_fn(|axis| {
                    let step = (rest % 3) as i32 - 1;
                    rest /= 3;
                    let beyond = (step < 0 && cell[axis] == 0)
                        || (step > 0 && cell[axis] + 1 == state.grid.n_cells[axis]);
                    if beyond && !state.grid.periodic[axis] { 0 } else { step }
                });
                if let Some(neighbor) = state.grid.neighbor(cell, shift) {
                    let slot = state.cells.slot_of[neighbor];
                    if slot != ABSENT {
                        *value = values[slot as usize];
                    }
                }
            }
        }
        Self::Around(kind, around)
    }

    #[inline(always)]
    fn at<const D: usize>(&self, gradient: &[[T; D]; D], xi: &[T; D]) -> T {
        let (kind, around) = match self {
            Self::AtPoint => return (0..D).fold(T::zero(), |sum, axis| sum + gradient[axis][axis]),
            Self::Around(PointDivergence::Constant, around) => return around[0],
            Self::Around(kind, around) => (*kind, around),
        };
        let weights = xi.map(|x| kind.weights(x));
        let mut sum = T::zero();
        for (code, value) in around.iter().enumerate().take(3_usize.pow(D as u32)) {
            let (mut rest, mut weight) = (code, T::one());
            for row in weights {
                weight *= row[rest % 3];
                rest /= 3;
            }
            sum += weight * *value;
        }
        sum
    }
}
