//! Cell values: density, pressure and state of the material at centres, and the divergence of each cell.

use super::interpolate::divergence_at;
use super::{CELL_GRAIN, StateOf, View, affine_density_read, centers_read};
use crate::Scalar;
use crate::affine_density::density_of_cell;
use crate::basis::Fit;
use crate::cells::{CellKind, Cells};
use crate::grid::Grid;
use crate::material::Material;
use crate::math::{Field, Value};
use crate::method::Method;
use crate::parallel::{fold_blocks, for_each_block};
use crate::quadrature::{Quadrature, Samples, boxed_volume};
use crate::reconstruction::Reconstruction;
use crate::shape::ShapeFunction;
use crate::simd::{Simd, vectorized};
use crate::stencil::{Rows, rows_at, rows_at_center};
use crate::telemetry::Counters;

/// Fields of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Center<T, S> {
    /// Density, kg/m³.
    pub density: T,
    /// Pressure, Pa.
    pub pressure: T,
    /// Volume of fluid, m³.
    pub volume: T,
    /// State of the material.
    pub state: S,
}

impl<T: Scalar, S: Field<T>> Default for Center<T, S> {
    fn default() -> Self {
        let zero = T::zero();
        Self { density: zero, pressure: zero, volume: zero, state: S::default() }
    }
}

/// What the cells put on their nodes, one entry per active cell.
#[derive(Clone, Copy, Debug)]
pub struct CellSamples<'a, T, const D: usize, S> {
    /// Fields; empty where a method samples at its points only.
    pub centers: &'a [Center<T, S>],
    /// Places of the samples, m; empty where all stand at the cells' centres.
    pub sites: &'a [[T; D]],
}

impl<T: Scalar, const D: usize, S> CellSamples<'_, T, D, S> {
    /// Shape functions at the sample of an active cell.
    #[inline(always)]
    pub(super) fn rows<H: ShapeFunction<T>>(
        &self,
        shape: &H,
        grid: &Grid<T, D>,
        (slot, cell): (usize, [usize; D]),
    ) -> Rows<T, D> {
        sample_rows(shape, grid, self.sites, (slot, cell))
    }
}

#[inline(always)]
fn sample_rows<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    shape: &H,
    grid: &Grid<T, D>,
    sites: &[[T; D]],
    (slot, cell): (usize, [usize; D]),
) -> Rows<T, D> {
    if sites.is_empty() {
        rows_at_center(shape, grid, cell)
    } else {
        rows_at(shape, grid, cell, sites[slot])
    }
}

/// Rebuilds density, pressure and material state in every active cell, Eqs. (17)-(18) of \[Song2020\].
///
/// Cells sampled at their points get the volume-weighted means of these points, which only the
/// velocity-pressure formulation uses.
pub fn rebuild_centers<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    centers: &mut [Center<T, StateOf<T, D, K>>],
) -> Counters
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let quadrature = view.method.quadrature();
    let work = |slots: std::ops::Range<usize>, part: &mut [Center<T, StateOf<T, D, K>>]| {
        vectorized!(D, simd => {
            let mut counters = Counters::default();
            for (slot, center) in slots.zip(part) {
                *center = match quadrature.samples(view.cells.kind[slot]) {
                    Samples::Center => full_cell(simd, view, slot, &mut counters),
                    Samples::Points | Samples::Part | Samples::Wetted | Samples::Balanced => {
                        cut_cell(view, slot)
                    }
                };
            }
            counters
        })
    };
    fold_blocks(centers.len(), CELL_GRAIN, centers, &|slot| slot, &work, &Counters::sum)
}

/// A cell full of fluid: fields of the reconstruction at the centre, volume of the cell.
#[inline(always)]
fn full_cell<S, T, const D: usize, M, K>(
    simd: S,
    view: &View<'_, T, D, M, K>,
    slot: usize,
    counters: &mut Counters,
) -> Center<T, StateOf<T, D, K>>
where
    S: Simd,
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let particles = view.particles;
    let cell = view.grid.cell_coordinates(view.cells.index[slot]);
    let is_affine = !particles.density_slope.is_empty() && !view.cells.near_surface[slot];
    let affine =
        is_affine.then(|| density_of_cell(simd, &view.cloud(), cell, affine_density_read(view)));
    counters.n_affine_sums += u64::from(is_affine);
    let volume = view.grid.cell_volume();
    if let Some(density) = affine
        && <StateOf<T, D, K> as Field<T>>::COMPONENTS == 0
    {
        let state = StateOf::<T, D, K>::default();
        let pressure = view.physics.pressure(density, &state);
        return Center { density, pressure, volume, state };
    }
    let reconstruction = view.method.reconstruction();
    let fit = reconstruction.fit_center(simd, &view.cloud(), cell, centers_read(view));
    counters.count_fit(&fit);
    let (Value(density), state) = fit.value().unwrap_or_else(|| {
        // The cell's own points all lie where the weight is zero: take the first of them.
        let point = view.cells.points(slot).start;
        (Value(particles.density[point]), particles.state[point])
    });
    let density = affine.unwrap_or(density);
    let pressure = view.physics.pressure(density, &state);
    Center { density, pressure, volume, state }
}

/// A cell cut by the surface: volume-weighted means over the points that it holds; their volume, or that of
/// their boxes where the cell is one sample.
#[inline(always)]
fn cut_cell<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    slot: usize,
) -> Center<T, StateOf<T, D, K>>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let particles = view.particles;
    let cloud = view.cloud();
    let volumes = view.method.quadrature().point_volumes(&cloud, slot);
    let (mut volume, mut mass, mut work) = (T::zero(), T::zero(), T::zero());
    let mut state = StateOf::<T, D, K>::default();
    for point in view.cells.points(slot) {
        let density = particles.density[point];
        let (part, part_mass) = volumes.of(point, particles.mass[point], density);
        volume += part;
        mass += part_mass;
        work += part * view.physics.pressure(density, &particles.state[point]);
        state.add_scaled(part, particles.state[point]);
    }
    let mut mean = StateOf::<T, D, K>::default();
    mean.add_scaled(T::one() / volume, state);
    let (density, pressure) = (mass / volume, work / volume);
    if view.method.quadrature().samples(CellKind::Boundary) != Samples::Points {
        volume = boxed_volume(&cloud, view.physics.box_edge, slot);
    }
    Center { density, pressure, volume, state: mean }
}

/// Divergence of each active cell by the one-point rule, D_c = Σ_I v_I · ∇N_I(x_c), 1/s.
///
/// Exact for the cell's mean with the linear hat; the adjoint of the velocity-pressure force. `sites` are
/// those of [`CellSamples`].
pub fn divergence<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    (grid, cells, shape): (&Grid<T, D>, &Cells, &S),
    (rows, sites): (&[u32], &[[T; D]]),
    velocity: &[[T; 4]],
    divergence: &mut [T],
) {
    let n_rows = S::REACH.pow(D as u32 - 1);
    for_each_block(cells.len(), CELL_GRAIN, divergence, &|slots, part: &mut [T]| {
        for (slot, out) in slots.zip(part) {
            let cell = grid.cell_coordinates(cells.index[slot]);
            let at = sample_rows(shape, grid, sites, (slot, cell));
            let starts = &rows[slot * n_rows..(slot + 1) * n_rows];
            *out = divergence_at::<T, D, S>(&at, starts, velocity);
        }
    });
}

impl Counters {
    /// Counts one reconstruction and what became of it.
    pub(crate) fn count_fit<F>(&mut self, fit: &Fit<F>) {
        self.n_reconstructions += 1;
        match fit {
            Fit::Regular(_) => {}
            Fit::Limited(_) => self.n_positivity_limited += 1,
            Fit::Tempered(_) => self.n_leverage_limited += 1,
            Fit::Empty | Fit::Constant(_) => self.n_singular_fallbacks += 1,
        }
    }
}
