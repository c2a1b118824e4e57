//! Points and cells → nodes: momentum, mass and force.

use super::{Center, StressOf, View};
use crate::Scalar;
use crate::formulation::Formulation;
use crate::math::{add_row, widen};
use crate::method::Method;
use crate::nodes::Nodes;
use crate::parallel::fold_blocks;
use crate::quadrature::{PointVolumes, Quadrature, Samples};
use crate::reconstruction::Reconstruction;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::stencil::{Rows, for_each_outer_row, node_positions, rows_at, rows_at_center};
use crate::stress::DeviatoricStress;
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
/// Slabs of cells along the first axis are worked on in two colours; slabs of one colour share no
/// node, so the order of summation depends on the grid alone.
pub fn particles_to_grid<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    centers: &[Center<T, StressOf<T, D, K>>],
    parts: ScatterParts,
    nodes: &mut Nodes<T>,
) -> Counters
where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
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
            let mut counters = Counters::default();
            let node_begin = node_cut(color + 2 * pairs.start);
            let mut target = Target { transfer, force, rows, node_begin };
            for pair in pairs {
                let slab = color + 2 * pair;
                let cells = view.cells.slab_first[slab]..view.cells.slab_first[slab + 1];
                for slot in cells {
                    scatter_cell(view, centers, parts, slot as usize, &mut target, &mut counters);
                }
            }
            counters
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

/// The nodes that one task writes to.
struct Target<'a, T> {
    transfer: &'a mut [[T; 4]],
    force: &'a mut [[T; 4]],
    rows: &'a [u32],
    node_begin: usize,
}

#[inline(always)]
fn scatter_cell<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    centers: &[Center<T, StressOf<T, D, K>>],
    parts: ScatterParts,
    slot: usize,
    target: &mut Target<'_, T>,
    counters: &mut Counters,
) where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    let shape = view.method.shape();
    let cell = view.grid.cell_coordinates(view.cells.index[slot]);
    if parts == ScatterParts::All {
        let samples = view.method.quadrature().samples(view.cells.kind[slot]);
        let at_center = samples == Samples::Center;
        let by_cell = matches!(view.method.formulation(), Formulation::VelocityPressure(_));
        if at_center || by_cell {
            let rows = rows_at_center(&shape, view.grid, cell);
            let center = &centers[slot];
            scatter_center::<T, D, M, K>(&rows, center, at_center, slot, target);
        }
        counters.n_samples += 1;
        if !at_center {
            counters.n_samples += view.cells.points(slot).len() as u64 - 1;
            let cloud = view.cloud();
            let volumes = view.method.quadrature().point_volumes(&cloud, slot);
            scatter_points::<T, D, M, K, true>(
                view,
                Some((&volumes, !by_cell)),
                cell,
                slot,
                target,
            );
            return;
        }
    }
    if !<M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES || view.cells.near_surface[slot]
    {
        scatter_points::<T, D, M, K, false>(view, None, cell, slot, target);
    }
}

/// One Gauss point: mass and stress at the centre of a full cell, or only the cell's pressure.
#[inline(always)]
fn scatter_center<T, const D: usize, M, K>(
    rows: &Rows<T, D>,
    center: &Center<T, StressOf<T, D, K>>,
    full: bool,
    slot: usize,
    target: &mut Target<'_, T>,
) where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    let mass = if full { center.density * center.volume } else { T::zero() };
    let scale = center.pressure * center.volume;
    let n_rows = M::Shape::REACH.pow(D as u32 - 1);
    let starts = &target.rows[slot * n_rows..(slot + 1) * n_rows];
    let last = rows[D - 1];
    for_each_outer_row::<T, D, M::Shape>(rows, |outer| {
        let start = starts[outer.row] as usize + last.first - target.node_begin;
        let force = &mut target.force[start..start + M::Shape::WIDTH];
        for (k, row) in force.iter_mut().enumerate() {
            let mut gradient = outer.gradient.map(|g| g * last.weight[k]);
            gradient[D - 1] = outer.weight * last.gradient[k];
            let viscous = if full { K::times(&center.stress, gradient) } else { [T::zero(); D] };
            for axis in 0..D {
                row[axis] += scale * gradient[axis] - center.volume * viscous[axis];
            }
            row[3] += mass * (outer.weight * last.weight[k]);
        }
    });
}

/// The points of a cell: transfer momentum and, with `FORCE`, mass and force as samples.
#[inline(always)]
fn scatter_points<T, const D: usize, M, K, const FORCE: bool>(
    view: &View<'_, T, D, M, K>,
    volumes: Option<(&PointVolumes<'_, T, D>, bool)>,
    cell: [usize; D],
    slot: usize,
    target: &mut Target<'_, T>,
) where
    T: Scalar,
    M: Method<T, D>,
    K: DeviatoricStress<T, D>,
{
    let shape = view.method.shape();
    let affine = <M::Transfer as Transfer<T, D>>::AFFINE;
    let node_at =
        if affine { node_positions(&shape, view.grid, cell) } else { [[T::zero(); 4]; D] };
    let n_rows = M::Shape::REACH.pow(D as u32 - 1);
    let starts = &target.rows[slot * n_rows..(slot + 1) * n_rows];
    let p = view.particles;
    for point in view.cells.points(slot) {
        let rows = rows_at(&shape, view.grid, cell, p.position[point]);
        let (carried, density) = (p.mass[point], p.density[point]);
        let moment = Moment::<T, D>::new::<M::Transfer>(view, point, &rows, &node_at);
        let mut sample = Sample { mass: T::zero(), scale: T::zero(), volume: T::zero() };
        if FORCE && let Some((volumes, with_pressure)) = volumes {
            (sample.volume, sample.mass) = volumes.of(point, carried, density);
            if with_pressure {
                sample.scale = sample.volume * view.physics.equation_of_state.pressure(density);
            }
        }
        let last = rows[D - 1];
        for_each_outer_row::<T, D, M::Shape>(&rows, |outer| {
            let start = starts[outer.row] as usize + last.first - target.node_begin;
            let transfer = &mut target.transfer[start..start + M::Shape::WIDTH];
            let base = moment.row::<M::Transfer>(&outer.index);
            for (k, row) in transfer.iter_mut().enumerate() {
                let weight = outer.weight * last.weight[k];
                let mut value = base;
                if affine {
                    add_row(&mut value, moment.offset[D - 1][k], moment.columns[D - 1]);
                }
                add_row(row, weight, value);
            }
            if FORCE {
                let force = &mut target.force[start..start + M::Shape::WIDTH];
                for (k, row) in force.iter_mut().enumerate() {
                    let mut gradient = outer.gradient.map(|g| g * last.weight[k]);
                    gradient[D - 1] = outer.weight * last.gradient[k];
                    let mut value = widen(gradient.map(|g| sample.scale * g));
                    value[3] = sample.mass * (outer.weight * last.weight[k]);
                    if K::PRESENT {
                        let viscous = K::times(&p.stress[point], gradient);
                        for axis in 0..D {
                            value[axis] -= sample.volume * viscous[axis];
                        }
                    }
                    add_row(row, T::one(), value);
                }
            }
        });
    }
}

/// Mass, volume and volume × pressure of a point as a sample.
struct Sample<T> {
    mass: T,
    scale: T,
    volume: T,
}

/// Momentum of a point as node rows (vector, mass): its value and its change per metre.
struct Moment<T, const D: usize> {
    value: [T; 4],
    columns: [[T; 4]; D],
    offset: [[T; MAX_WIDTH]; D],
}

impl<T: Scalar, const D: usize> Moment<T, D> {
    #[inline(always)]
    fn new<X: Transfer<T, D>>(
        view: &View<'_, T, D, impl Method<T, D, Transfer = X>, impl DeviatoricStress<T, D>>,
        point: usize,
        rows: &Rows<T, D>,
        node_at: &[[T; MAX_WIDTH]; D],
    ) -> Self {
        let p = view.particles;
        let mass = p.mass[point];
        let mut value = widen(p.velocity[point].map(|v| mass * v));
        value[3] = mass;
        let mut columns = [[T::zero(); 4]; D];
        let mut offset = [[T::zero(); MAX_WIDTH]; D];
        if X::AFFINE {
            for axis in 0..D {
                let column = X::affine_column(&p.affine[point], axis);
                columns[axis] = widen(column.map(|c| mass * c));
                for k in 0..MAX_WIDTH {
                    let node = (rows[axis].first + k).min(MAX_WIDTH - 1);
                    offset[axis][k] = node_at[axis][node] - p.position[point][axis];
                }
            }
        }
        Self { value, columns, offset }
    }

    /// Momentum at the outer indices of a row.
    #[inline(always)]
    fn row<X: Transfer<T, D>>(&self, index: &[usize; D]) -> [T; 4] {
        let mut value = self.value;
        if X::AFFINE {
            for axis in 0..D - 1 {
                add_row(&mut value, self.offset[axis][index[axis]], self.columns[axis]);
            }
        }
        value
    }
}
