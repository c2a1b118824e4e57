//! Points and cells → nodes: momentum, mass and force.

use super::spread::{Site, Spread};
use super::stencil_nodes::StencilNodes;
use super::{CellSamples, StateOf, View, nodes_read};
use crate::Scalar;
use crate::formulation::Formulation;
use crate::material::Material;
use crate::method::Method;
use crate::nodes::Nodes;
use crate::parallel::fold_blocks;
use crate::quadrature::{PointVolumes, Quadrature, Samples};
use crate::reconstruction::Reconstruction;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::{Simd, SimdBase as _, lanes, load, splat, vectorized};
use crate::stencil::{Frame, rows_at_center, shape_at_point, shape_in_cell};
use crate::telemetry::Counters;
use crate::transfer::Transfer;

/// Which sums a scatter forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScatterParts {
    /// Transfer momentum, mass and force.
    All,
    /// Transfer momentum only, to rebuild node velocities.
    Momentum,
}

/// Sums over samples, Eqs. (10)-(16), (21)-(27) of \[Song2020\]:
///
/// ```text
/// transfer_I = Σ_p m_p N_I(x_p) (v_p + C_p (x_I − x_p)),  Σ_p m_p N_I(x_p)
/// mass_I     = Σ_q V_q ρ_q N_I(x_q)
/// force_I    = Σ_q V_q (p_q I − s_q) ∇N_I(x_q)
/// ```
///
/// Methods that gather no increment and sample at their points only add the impulse Δt f to the
/// transfer momentum at once, see [`fuses_impulse`].
///
/// Slabs of cells along the first axis are worked on in two colours; slabs of one colour share no
/// node, so the order of summation depends on the grid alone.
pub fn particles_to_grid<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    cell_samples: CellSamples<'_, T, D, StateOf<T, D, K>>,
    (parts, dt): (ScatterParts, T),
    nodes: &mut Nodes<T>,
) -> Counters
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let zero = [T::zero(); 4];
    nodes.transfer.fill(zero);
    if parts == ScatterParts::All {
        nodes.force.fill(zero);
    }
    let Nodes { transfer, force, rows, slab_first, images, .. } = nodes;
    let n_slabs = slab_first.len() - 1;
    let node_cut = |slab: usize| slab_first[slab.min(n_slabs)] as usize;
    let mut counters = Counters::default();
    for color in 0..2 {
        let begin = node_cut(color);
        let work = |pairs: std::ops::Range<usize>,
                    (transfer, force): (&mut [[T; 4]], &mut [[T; 4]])| {
            let node_begin = node_cut(color + 2 * pairs.start);
            let slabs = pairs.map(|pair| color + 2 * pair);
            let mut target = Target { transfer, force, rows, node_begin };
            let input = Input { view, cell_samples, parts, dt };
            vectorized!(D, simd => input.scatter_slabs(simd, slabs, &mut target))
        };
        let n_pairs = (n_slabs.saturating_sub(color)).div_ceil(2);
        let data = (&mut transfer[begin..], &mut force[begin..]);
        let cut = |pair: usize| node_cut(color + 2 * pair) - begin;
        let sum = fold_blocks(n_pairs, 1, data, &cut, &work, &Counters::sum);
        counters = counters.sum(sum);
    }
    Nodes::fold(images, transfer);
    if parts == ScatterParts::All {
        Nodes::fold(images, force);
    }
    counters
}

/// Whether the impulse of the forces goes straight into the transfer momentum.
///
/// It can where a step needs neither the nodes' velocity before the forces nor a mass of its own.
pub fn fuses_impulse<T: Scalar, const D: usize, M: Method<T, D>>() -> bool {
    !<M::Transfer as Transfer<T, D>>::USES_INCREMENT
        && !<M::Quadrature as Quadrature<T, D>>::USES_CENTERS
        && !<M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES
}

/// The nodes that one task writes to.
struct Target<'a, T> {
    transfer: &'a mut [[T; 4]],
    force: &'a mut [[T; 4]],
    rows: &'a [u32],
    node_begin: usize,
}

impl<'a, T> Target<'a, T> {
    /// First node of each stencil row of a cell.
    #[inline(always)]
    fn starts<const D: usize>(&self, reach: usize, slot: usize) -> &'a [u32] {
        let n_rows = reach.pow(D as u32 - 1);
        &self.rows[slot * n_rows..][..n_rows]
    }
}

struct Input<'a, T, const D: usize, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    view: &'a View<'a, T, D, M, K>,
    cell_samples: CellSamples<'a, T, D, StateOf<T, D, K>>,
    parts: ScatterParts,
    dt: T,
}

impl<T, const D: usize, M, K> Input<'_, T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    #[inline(always)]
    fn scatter_slabs<S: Simd>(
        &self,
        simd: S,
        slabs: impl Iterator<Item = usize>,
        target: &mut Target<'_, T>,
    ) -> Counters {
        let first = &self.view.cells.slab_first;
        let mut counters = Counters::default();
        for slab in slabs {
            for slot in first[slab]..first[slab + 1] {
                let (n_samples, regular) = self.scatter_cell(simd, slot as usize, target);
                counters.n_samples += n_samples;
                counters.n_singular_fallbacks += u64::from(!regular);
            }
        }
        counters
    }

    /// Scatters one cell; returns the number of its samples, and whether fits were regular.
    #[inline(always)]
    fn scatter_cell<S: Simd>(
        &self,
        simd: S,
        slot: usize,
        target: &mut Target<'_, T>,
    ) -> (u64, bool) {
        let view = self.view;
        let cell = view.grid.cell_coordinates(view.cells.index[slot]);
        let all = self.parts == ScatterParts::All;
        let samples = view.method.quadrature().samples(view.cells.kind[slot]);
        let at_center = samples != Samples::Points;
        let by_cell = matches!(view.method.formulation(), Formulation::VelocityPressure(_));
        if all && (at_center || by_cell) {
            self.scatter_center(simd, at_center, cell, slot, target);
        }
        let transfers = !<M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES
            || view.cells.near_surface[slot];
        let mut regular = true;
        if at_center {
            if <M::Reconstruction as Reconstruction<T, D>>::BY_CELLS {
                regular = self.scatter_flow(simd, all, cell, slot, target);
            } else if transfers {
                let none = (PointVolumes::Scaled(T::zero()), false);
                self.scatter_points::<S, false>(simd, none, cell, slot, target);
            }
            return (u64::from(all), regular);
        }
        if !all {
            let none = (PointVolumes::Scaled(T::zero()), false);
            self.scatter_points::<S, false>(simd, none, cell, slot, target);
            return (0, regular);
        }
        let cloud = view.cloud();
        let volumes = view.method.quadrature().point_volumes(&cloud, slot);
        self.scatter_points::<S, true>(simd, (volumes, !by_cell), cell, slot, target);
        (view.cells.points(slot).len() as u64, regular)
    }

    /// One Gauss point: mass and stress at the centre of a cell, or only the cell's pressure.
    #[inline(always)]
    fn scatter_center<S: Simd>(
        &self,
        simd: S,
        full: bool,
        cell: [usize; D],
        slot: usize,
        target: &mut Target<'_, T>,
    ) {
        let center = &self.cell_samples.centers[slot];
        let view = self.view;
        let rows = self.cell_samples.rows(&view.method.shape(), view.grid, (slot, cell));
        let by_cells = <M::Reconstruction as Reconstruction<T, D>>::BY_CELLS;
        let mass = if full && !by_cells { center.density * center.volume } else { T::zero() };
        let state = if full { center.state } else { StateOf::<T, D, K>::default() };
        let none = [[T::zero(); MAX_WIDTH]; D];
        let site = Site { rows: &rows, moments: &none };
        let (begin, starts) = (target.node_begin, target.starts::<D>(M::Shape::REACH, slot));
        let nodes =
            if fuses_impulse::<T, D, M>() { &mut *target.transfer } else { &mut *target.force };
        let mut sums = StencilNodes::load::<M::Shape, D>(simd, nodes, starts, begin);
        let work = center.pressure * center.volume;
        self.add_sample(simd, &site, (center.volume, mass, work), &state, &mut sums);
        sums.store::<M::Shape, D>(nodes, starts, begin);
    }

    /// Mass and stress of a sample: of its volume, and `volume * pressure`, which is zero where the cell has it.
    #[inline(always)]
    fn add_sample<S: Simd>(
        &self,
        simd: S,
        site: &Site<'_, T, D>,
        (volume, mass, work): (T, T, T),
        state: &StateOf<T, D, K>,
        sums: &mut StencilNodes<T, S>,
    ) {
        if !K::PRESENT {
            let scale = if fuses_impulse::<T, D, M>() { self.dt } else { T::one() };
            site.add_isotropic::<S, M::Shape>(simd, (scale * work, mass), sums);
            return;
        }
        let (flux, zero) = (self.flux(work, volume, state), splat(simd, T::zero()));
        let value = load(simd, &[T::zero(), T::zero(), T::zero(), mass]);
        let mut spread = Spread { value, affine: [zero; D], flux: [zero; D] };
        for axis in 0..D {
            spread.flux[axis] = load(simd, &flux[axis]);
        }
        site.add::<S, M::Shape>(simd, (false, true), &spread, sums);
    }

    /// Momentum and mass of a cell as polynomials in it, integrated with linear hats:
    /// `∫ N (q + Σ s_a y_a) dV = V 2^−D (q ± s_a/6)`, y in cells from the center.
    #[inline(always)]
    fn scatter_flow<S: Simd>(
        &self,
        simd: S,
        with_mass: bool,
        cell: [usize; D],
        slot: usize,
        target: &mut Target<'_, T>,
    ) -> bool {
        let view = self.view;
        let (grid, shape) = (view.grid, view.method.shape());
        let reconstruction = view.method.reconstruction();
        let (flow, regular) =
            reconstruction.cell_flow(simd, &view.cloud(), (slot, cell), nodes_read(view));
        let volume = grid.cell_volume();
        let rows = rows_at_center(&shape, grid, cell);
        // First moments of the hats about the center are ± h/4: N s h/3 of them is N s/6.
        let mut moments = [[T::zero(); MAX_WIDTH]; D];
        let mut spread = Spread {
            value: load(simd, &flow[0].map(|q| q * volume)),
            affine: [splat(simd, T::zero()); D],
            flux: [splat(simd, T::zero()); D],
        };
        for axis in 0..D {
            let quarter = T::lit(0.25) * grid.spacing[axis];
            (moments[axis][0], moments[axis][1]) = (-quarter, quarter);
            let scale = volume * grid.inverse_spacing[axis] * T::lit(1.0 / 3.0);
            spread.affine[axis] = load(simd, &flow[1 + axis].map(|slope| slope * scale));
        }
        let site = Site { rows: &rows, moments: &moments };
        let (begin, starts) = (target.node_begin, target.starts::<D>(M::Shape::REACH, slot));
        let mut sums = StencilNodes::load::<M::Shape, D>(simd, target.transfer, starts, begin);
        site.add::<S, M::Shape>(simd, (true, false), &spread, &mut sums);
        sums.store::<M::Shape, D>(target.transfer, starts, begin);
        if with_mass {
            let mass_only = |row: [T; 4]| [T::zero(), T::zero(), T::zero(), row[3]];
            spread.value = load(simd, &mass_only(spread.value.to_array()));
            spread.affine = spread.affine.map(|row| load(simd, &mass_only(row.to_array())));
            let mut sums = StencilNodes::load::<M::Shape, D>(simd, target.force, starts, begin);
            site.add::<S, M::Shape>(simd, (true, false), &spread, &mut sums);
            sums.store::<M::Shape, D>(target.force, starts, begin);
        }
        regular
    }

    /// Columns of `V (p I − s)`, times Δt where the impulse is fused.
    #[inline(always)]
    fn flux(&self, work: T, volume: T, state: &StateOf<T, D, K>) -> [[T; 4]; D] {
        let scale = if fuses_impulse::<T, D, M>() { self.dt } else { T::one() };
        let mut columns = [[T::zero(); 4]; D];
        for axis in 0..D {
            columns[axis][axis] = scale * work;
            if K::PRESENT {
                let mut unit = [T::zero(); D];
                unit[axis] = scale * volume;
                let viscous = K::times(state, unit);
                for row in 0..D {
                    columns[axis][row] -= viscous[row];
                }
            }
        }
        columns
    }

    /// The points of a cell: transfer momentum and, given their volumes, mass and force as samples.
    #[inline(always)]
    fn scatter_points<S: Simd, const SAMPLES: bool>(
        &self,
        simd: S,
        (volumes, with_pressure): (PointVolumes<'_, T, D>, bool),
        cell: [usize; D],
        slot: usize,
        target: &mut Target<'_, T>,
    ) {
        let view = self.view;
        let shape = view.method.shape();
        let of_cell = view.cells.points(slot);
        let (first, p) = (of_cell.start, view.particles.part(of_cell));
        let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
        let frame = Frame::new(simd, &shape, view.grid, cell);
        let shape = shape_in_cell(&shape, view.grid, view.cells, cell);
        let zero = splat(simd, T::zero());
        let (begin, starts) = (target.node_begin, target.starts::<D>(M::Shape::REACH, slot));
        let mut transfer = StencilNodes::load::<M::Shape, D>(simd, target.transfer, starts, begin);
        for point in 0..p.position.len() {
            let position = p.position[point];
            let shape = shape_at_point(&shape, view.grid, &view.particles.length, first + point);
            let rows = frame.rows(&shape, &position);
            let (mass, density) = (p.mass[point], p.density[point]);
            let mut momentum = [T::zero(); 4];
            for axis in 0..D {
                momentum[axis] = mass * p.velocity[point][axis];
            }
            momentum[3] = mass;
            let mut spread =
                Spread { value: load(simd, &momentum), affine: [zero; D], flux: [zero; D] };
            let moments = frame.moments::<M::Shape>(&rows, &position).first;
            if affine {
                for axis in 0..D {
                    spread.affine[axis] = lanes::<T, S, D>(simd, |row| {
                        mass * M::Transfer::affine_entry(&p.affine[point], row, axis)
                    });
                }
            }
            let site = Site { rows: &rows, moments: &moments };
            if !SAMPLES {
                site.add::<S, M::Shape>(simd, (affine, false), &spread, &mut transfer);
                continue;
            }
            let (volume, sample_mass) = volumes.of(first + point, mass, density);
            let pressure = view.physics.pressure(density, &p.state[point]);
            let work = if with_pressure { volume * pressure } else { T::zero() };
            if fuses_impulse::<T, D, M>() {
                let flux = self.flux(work, volume, &p.state[point]);
                for axis in 0..D {
                    spread.flux[axis] = load(simd, &flux[axis]);
                }
                site.add::<S, M::Shape>(simd, (affine, true), &spread, &mut transfer);
            } else {
                site.add::<S, M::Shape>(simd, (affine, false), &spread, &mut transfer);
                // Held for all points, forces and momenta together are more than fits in 16 registers.
                let mut force =
                    StencilNodes::load::<M::Shape, D>(simd, target.force, starts, begin);
                let sample = (volume, sample_mass, work);
                self.add_sample(simd, &site, sample, &p.state[point], &mut force);
                force.store::<M::Shape, D>(target.force, starts, begin);
            }
        }
        transfer.store::<M::Shape, D>(target.transfer, starts, begin);
    }
}
