//! Nodes and cells → points: velocity, density, stress and position.

use std::marker::PhantomData;

use super::{AffineOf, CELL_GRAIN, Physics, StressOf};
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::formulation::{Formulation, PointDivergence};
use crate::grid::Grid;
use crate::math::narrow;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::particles::ParticlesMut;
use crate::scene::Boundary;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::{Simd, SimdBase as _, load, splat, vectorized};
use crate::stencil::{Rows, for_each_outer_row, moments_at, node_positions, rows_at};
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
        let (shape, grid) = (state.method.shape(), state.grid);
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let share = state.method.transfer().flip_share(dt);
        let n_rows = M::Shape::REACH.pow(D as u32 - 1);
        let mut outcome = Outcome::default();
        for slot in slots {
            let cell = grid.cell_coordinates(state.cells.index[slot]);
            let mut moments = [[T::zero(); MAX_WIDTH]; D];
            let node_at = if affine { node_positions(&shape, grid, cell) } else { moments };
            let cell_divergence = if pass.state {
                CellDivergence::around(state, slot, cell)
            } else {
                CellDivergence::AtPoint
            };
            let starts = &state.rows[slot * n_rows..(slot + 1) * n_rows];
            for point in state.cells.points(slot) {
                let p = point - begin;
                let position = points.position[p];
                let rows = rows_at(&shape, grid, cell, position);
                if affine {
                    moments = moments_at::<T, D, M::Shape>(&rows, &node_at, position);
                }
                let at = Place::<T, D, M::Shape> { rows: &rows, starts, shape: PhantomData };
                let found = at.gather::<S, M::Transfer>(simd, state, &moments);
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
                    self.strain(simd, p, points, &at, (&found, &cell_divergence, cell));
                }
                if pass.motion {
                    let position = &mut points.position[p];
                    for axis in 0..D {
                        position[axis] += dt * motion[axis];
                    }
                    let place = settle(grid, &state.physics.boundaries, position);
                    points.cell[p] = place.unwrap_or(points.cell[p]);
                    outcome.note(point, place.is_none().then_some(Failure::LeftDomain));
                    outcome.n_removed += u64::from(place == Some(ABSENT));
                }
                let sound = check(points.velocity[p], points.position[p], points.density[p]);
                outcome.note(point, sound);
            }
        }
        outcome
    }

    /// Updates density and stress of point `p` of the view.
    #[inline(always)]
    fn strain<S: Simd>(
        &self,
        simd: S,
        p: usize,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StressOf<T, D, K>>,
        at: &Place<'_, T, D, M::Shape>,
        (found, cell_divergence, cell): (&Gathered<T, D>, &CellDivergence<T>, [usize; D]),
    ) {
        let source = &self.state.source;
        let divergence = match cell_divergence {
            CellDivergence::AtPoint if source.is_end_velocity => found.divergence,
            CellDivergence::AtPoint => at.divergence(simd, source.velocity),
            CellDivergence::Around(..) => {
                cell_divergence.at(&grid_xi(self.state.grid, cell, points.position[p]))
            }
        };
        points.density[p] /= T::one() + self.dt * divergence;
        if K::PRESENT {
            let gradient = at.velocity_gradient(simd, source.velocity);
            points.stress[p] = self.state.physics.stress.update(points.density[p], &gradient);
        }
    }
}

/// What a point gathers from its nodes; `moment[a]` is Σ N v (x − x_p)_a.
struct Gathered<T, const D: usize> {
    velocity: [T; 4],
    increment: [T; 4],
    moment: [[T; 4]; D],
    divergence: T,
}

/// The functions of a point and the nodes of its cell.
struct Place<'a, T, const D: usize, H> {
    rows: &'a Rows<T, D>,
    starts: &'a [u32],
    shape: PhantomData<H>,
}

impl<T: Scalar, const D: usize, H: ShapeFunction<T>> Place<'_, T, D, H> {
    /// Weights of one stencil row, (N, N, N, N′): node rows repeat the last component in their last
    /// entry, which so becomes its derivative along the last axis.
    #[inline(always)]
    fn weights<S: Simd>(&self, simd: S) -> [T::Four<S>; MAX_WIDTH] {
        let last = &self.rows[D - 1];
        let mut weights = [splat(simd, T::zero()); MAX_WIDTH];
        for k in 0..H::WIDTH {
            let (n, slope) = (last.weight[k], last.gradient[k]);
            weights[k] = load(simd, &[n, n, n, slope]);
        }
        weights
    }

    /// Sums of v⁺ and, as the transfer needs them, of Δt a and of first moments.
    #[inline(always)]
    fn gather<S: Simd, X: Transfer<T, D>>(
        &self,
        simd: S,
        state: &GridState<'_, T, D, impl Method<T, D>, impl DeviatoricStress<T, D>>,
        moments: &[[T; MAX_WIDTH]; D],
    ) -> Gathered<T, D> {
        let (rows, inner) = (self.rows, D - 1);
        let weights = self.weights(simd);
        let zero = splat(simd, T::zero());
        let mut moment_last = [zero; MAX_WIDTH];
        if X::AFFINE {
            for k in 0..H::WIDTH {
                moment_last[k] = splat(simd, moments[inner][k]);
            }
        }
        let (mut velocity, mut increment, mut moment) = (zero, zero, [zero; D]);
        let mut divergence = T::zero();
        for_each_outer_row::<T, D, H>(
            rows,
            #[inline(always)]
            |outer| {
                let start = self.starts[outer.row] as usize + rows[inner].first;
                let nodes = &state.velocity[start..start + H::WIDTH];
                let weight = splat(simd, outer.weight);
                let mut line = load(simd, &nodes[0]) * weights[0];
                for k in 1..H::WIDTH {
                    line = line + load(simd, &nodes[k]) * weights[k];
                }
                velocity = velocity + line * weight;
                for axis in 0..inner {
                    divergence +=
                        outer.replace(rows, axis, &rows[axis].gradient) * line.as_array()[axis];
                }
                if X::AFFINE {
                    for axis in 0..inner {
                        let outer_moment = outer.replace(rows, axis, &moments[axis]);
                        moment[axis] = moment[axis] + line * splat(simd, outer_moment);
                    }
                    let mut along = load(simd, &nodes[0]) * moment_last[0];
                    for k in 1..H::WIDTH {
                        along = along + load(simd, &nodes[k]) * moment_last[k];
                    }
                    moment[inner] = moment[inner] + along * weight;
                }
                if X::USES_INCREMENT {
                    let nodes = &state.increment[start..start + H::WIDTH];
                    let mut change = load(simd, &nodes[0]) * weights[0];
                    for k in 1..H::WIDTH {
                        change = change + load(simd, &nodes[k]) * weights[k];
                    }
                    increment = increment + change * weight;
                }
            },
        );
        let velocity = velocity.to_array();
        let mut columns = [[T::zero(); 4]; D];
        if X::AFFINE {
            for axis in 0..D {
                columns[axis] = moment[axis].to_array();
            }
        }
        Gathered {
            velocity,
            increment: increment.to_array(),
            moment: columns,
            divergence: divergence + velocity[3],
        }
    }

    /// Σ v_I · ∇N_I, 1/s.
    #[inline(always)]
    fn divergence<S: Simd>(&self, simd: S, nodes: &[[T; 4]]) -> T {
        let weights = self.weights(simd);
        let mut sum = T::zero();
        for_each_outer_row::<T, D, H>(
            self.rows,
            #[inline(always)]
            |outer| {
                let start = self.starts[outer.row] as usize + self.rows[D - 1].first;
                let mut line = splat(simd, T::zero());
                for (k, node) in nodes[start..start + H::WIDTH].iter().enumerate() {
                    line = line + load(simd, node) * weights[k];
                }
                let line = line.to_array();
                sum += outer.weight * line[3];
                for axis in 0..D - 1 {
                    sum += outer.replace(self.rows, axis, &self.rows[axis].gradient) * line[axis];
                }
            },
        );
        sum
    }

    /// `[i][j] = ∂v_i/∂x_j`, 1/s.
    #[inline(always)]
    fn velocity_gradient<S: Simd>(&self, simd: S, nodes: &[[T; 4]]) -> [[T; D]; D] {
        let (rows, inner) = (self.rows, D - 1);
        let zero = splat(simd, T::zero());
        let mut columns = [zero; D];
        for_each_outer_row::<T, D, H>(
            rows,
            #[inline(always)]
            |outer| {
                let start = self.starts[outer.row] as usize + rows[inner].first;
                let (mut value, mut slope) = (zero, zero);
                for (k, node) in nodes[start..start + H::WIDTH].iter().enumerate() {
                    let node = load(simd, node);
                    value = value + node * splat(simd, rows[inner].weight[k]);
                    slope = slope + node * splat(simd, rows[inner].gradient[k]);
                }
                for axis in 0..inner {
                    let gradient = outer.replace(rows, axis, &rows[axis].gradient);
                    columns[axis] = columns[axis] + value * splat(simd, gradient);
                }
                columns[inner] = columns[inner] + slope * splat(simd, outer.weight);
            },
        );
        let columns = columns.map(|column| column.to_array());
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
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
        let length = grid.spacing[axis] * T::from_index(grid.n_cells[axis]);
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
    std::array::from_fn(|axis| grid.in_cells(position, axis) - T::from_index(cell[axis]))
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
    fn at<const D: usize>(&self, xi: &[T; D]) -> T {
        let (kind, around) = match self {
            Self::AtPoint => return T::zero(),
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
