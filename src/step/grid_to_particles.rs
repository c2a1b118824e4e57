//! Nodes and cells → points: velocity, density, stress and position.

use std::marker::PhantomData;

use super::cell_divergence::CellDivergence;
use super::gather::{Gathered, Site, Want};
use super::settle::{Failure, Outcome, check, is_quiet, settle};
use super::stencil_nodes::StencilNodes;
use super::{AffineOf, CELL_GRAIN, Physics, StateOf};
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::grid::Grid;
use crate::material::{Material, Strain, Work};
use crate::math::{dot, narrow};
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::particles::ParticlesMut;
use crate::shape::ShapeFunction;
use crate::simd::{Simd, SimdBase as _, vectorized};
use crate::stencil::{Frame, gradients, shape_at_point, shape_in_cell};
use crate::transfer::Transfer;

/// Where the state update takes its velocities from.
#[derive(Clone, Copy, Debug)]
pub struct StateSource<'a, T> {
    /// Node velocities whose gradient strains the points.
    pub velocity: &'a [[T; 4]],
    /// Whether these are v⁺ themselves, which are gathered anyway.
    pub is_end_velocity: bool,
    /// Divergence of each active cell, 1/s; empty in the standard formulation.
    pub divergence: &'a [T],
    /// Divergence of each point, 1/s; empty unless it was smoothed.
    pub at_points: &'a [T],
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
    /// Lengths of the points along the axes, m; empty unless the shape functions depend on them.
    pub length: &'a [[T; D]],
    /// Share of the FLIP update, 0 to 1.
    pub flip_share: T,
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
    points: ParticlesMut<'_, T, D, AffineOf<T, D, M>, StateOf<T, D, K>>,
) -> Outcome
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let first = &state.cells.first;
    let work = |slots: std::ops::Range<usize>, mut points: ParticlesMut<'_, T, D, _, _>| {
        let begin = first[slots.start] as usize;
        let block = Block { state, pass, dt, begin };
        vectorized!(D, simd => block.run(simd, slots, &mut points))
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
    K: Material<T, D>,
{
    #[inline(always)]
    fn run<S: Simd>(
        &self,
        simd: S,
        slots: std::ops::Range<usize>,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StateOf<T, D, K>>,
    ) -> Outcome {
        let Self { state, pass, dt, begin } = *self;
        let (shape, grid) = (state.method.shape(), *state.grid);
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let want =
            Want { moments: affine, increment: <M::Transfer as Transfer<T, D>>::USES_INCREMENT };
        let share = state.flip_share;
        let floor = state.physics.minimum_density;
        let n_rows = M::Shape::REACH.pow(D as u32 - 1);
        let mut outcome = Outcome::default();
        for slot in slots {
            let cell = grid.cell_coordinates(state.cells.index[slot]);
            let frame = Frame::new(simd, &shape, state.grid, cell);
            let shape = shape_in_cell(&shape, state.grid, state.cells, cell);
            let of_cell = state.cells.points(slot);
            let cell_divergence = if pass.state {
                CellDivergence::around(state, (slot, of_cell.clone()), cell)
            } else {
                CellDivergence::AtPoint
            };
            let starts = &state.rows[slot * n_rows..][..n_rows];
            let velocity = StencilNodes::load::<M::Shape, D>(simd, state.velocity, starts, 0);
            let mut increment = StencilNodes::zero(simd);
            if want.increment {
                increment = StencilNodes::load::<M::Shape, D>(simd, state.increment, starts, 0);
            }
            let first = of_cell.start;
            let mut points = points.part(first - begin..of_cell.end - begin);
            for p in 0..of_cell.len() {
                let position = points.position[p];
                let shape = shape_at_point(&shape, state.grid, state.length, first + p);
                let rows = frame.rows(&shape, &position);
                let moments = frame.moments::<M::Shape>(&rows, &position);
                let by_gradient = <M::Transfer as Transfer<T, D>>::BY_GRADIENT;
                let site = Site::<T, D, M::Shape> {
                    rows: &rows,
                    moments: &if by_gradient { gradients(&rows) } else { moments.first },
                    starts,
                    shape: PhantomData,
                };
                let found = site.gather(simd, want, &velocity, &increment);
                let old = points.velocity[p];
                let (mut velocity, mut moved) = (old, position);
                if pass.velocity {
                    for axis in 0..D {
                        velocity[axis] = found.velocity[axis];
                        if want.increment {
                            let (kept, rest) =
                                (old[axis] + found.increment[axis], T::one() - share);
                            velocity[axis] = share * kept + rest * velocity[axis];
                        }
                    }
                    points.velocity[p] = velocity;
                    if affine {
                        let second = moments.second.as_array();
                        points.affine[p] = M::Transfer::affine_from(&found.moment, second);
                    }
                }
                let mut density = points.density[p];
                if pass.state {
                    let found = (&found, old, &cell_divergence, cell);
                    density = self.strain(simd, p, &mut points, &site, found);
                }
                if pass.motion {
                    for axis in 0..D {
                        moved[axis] += dt * found.velocity[axis];
                    }
                    points.position[p] = moved;
                }
                let xi = frame.xi(&moved);
                if !is_quiet::<T, D>(xi.as_array(), &velocity, (density, floor)) {
                    outcome.note(first + p, check(&velocity, &moved, density));
                    if density > T::zero() && density < floor {
                        points.density[p] = floor;
                        outcome.n_raised += 1;
                    }
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

    /// Updates density and stress of point `p` of the view; returns the density.
    #[inline(always)]
    fn strain<S: Simd>(
        &self,
        simd: S,
        p: usize,
        points: &mut ParticlesMut<'_, T, D, AffineOf<T, D, M>, StateOf<T, D, K>>,
        site: &Site<'_, T, D, M::Shape>,
        (found, old, cell_divergence, cell): Found<'_, T, D>,
    ) -> T {
        let source = &self.state.source;
        let divergence = match cell_divergence {
            CellDivergence::AtPoint if source.is_end_velocity => found.divergence,
            CellDivergence::AtPoint => {
                let want = Want { moments: false, increment: false };
                let velocity =
                    StencilNodes::load::<M::Shape, D>(simd, source.velocity, site.starts, 0);
                site.gather(simd, want, &velocity, &StencilNodes::zero(simd)).divergence
            }
            CellDivergence::OfPoints(_) | CellDivergence::Around(..) => {
                cell_divergence.at(p, &grid_xi(self.state.grid, cell, points.position[p]))
            }
        };
        let before = points.density[p];
        let density = before / (T::one() + self.dt * divergence);
        points.density[p] = density;
        if K::PRESENT {
            let gradient = site.velocity_gradient(simd, source.velocity);
            let Physics { material, equation_of_state, .. } = &self.state.physics;
            let work = material.wants_work().then(|| {
                let heat = heat(found.increment, old, points.velocity[p]);
                let change = site.velocity_gradient(simd, self.state.increment);
                Work { gradient: mean_gradient(gradient, change), heat }
            });
            let density = [before, density];
            let strain = Strain { dt: self.dt, density, divergence, gradient, work };
            points.state[p] = material.update(equation_of_state, &points.state[p], &strain);
        }
        density
    }
}

/// What the strain of a point is found from: sums over its nodes, its velocity before the step, the
/// divergences around, and its cell.
type Found<'a, T, const D: usize> =
    (&'a Gathered<T, D>, [T; D], &'a CellDivergence<'a, T>, [usize; D]);

/// Kinetic energy per mass that the nodes gave a point and that it does not have, J/kg.
///
/// ```text
/// v_p · δ + Σ N ½ |Δt a|² − ½ (|v_p'|² − |v_p|²),   δ = Σ N Δt a
/// ```
///
/// Summed over the points with their masses, the first two terms are the change of the nodes' kinetic
/// energy. With pure FLIP the rest is Σ N ½ |Δt a − δ|², never negative.
#[inline(always)]
fn heat<T: Scalar, const D: usize>(increment: [T; 4], old: [T; D], new: [T; D]) -> T {
    let change = T::lit(0.5) * (dot(new, new) - dot(old, old));
    dot(old, narrow(increment)) + increment[3] - change
}

/// Gradient of the velocity half-way through the step from that at its end and its change.
#[inline(always)]
fn mean_gradient<T: Scalar, const D: usize>(
    mut end: [[T; D]; D],
    change: [[T; D]; D],
) -> [[T; D]; D] {
    for i in 0..D {
        for j in 0..D {
            end[i][j] -= T::lit(0.5) * change[i][j];
        }
    }
    end
}

#[inline(always)]
fn grid_xi<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    position: [T; D],
) -> [T; D] {
    std::array::from_fn(|axis| grid.in_cells(position, axis) - T::from_index(cell[axis]))
}
