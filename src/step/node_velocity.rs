//! Node velocities from the points.

use super::{FIT_GRAIN, NODE_GRAIN, View, nodes_read};
use crate::Scalar;
use crate::cells::{ABSENT, CellKind};
use crate::material::Material;
use crate::math::{Value, Vector, widen};
use crate::method::Method;
use crate::parallel::{fold_blocks, for_each_block};
use crate::quadrature::Quadrature;
use crate::reconstruction::Reconstruction;
use crate::shape::ShapeFunction;
use crate::simd::{Simd, vectorized};
use crate::telemetry::Counters;

/// Velocity of a node from its transfer sums, v_I = Σ w m v / Σ w m; zero where no mass arrives.
///
/// The last entry repeats the last component, see [`super::update_grid`].
#[inline(always)]
pub fn transfer_velocity<T: Scalar, const D: usize>(transfer: [T; 4]) -> [T; 4] {
    if !(transfer[3] > T::zero()) {
        return [T::zero(); 4];
    }
    let inverse = T::one() / transfer[3];
    let velocity = transfer.map(|momentum| momentum * inverse);
    [velocity[0], velocity[1], velocity[2], velocity[D - 1]]
}

/// Node velocities before constraints: reconstructed v_I = (ρv)(x_I) / ρ(x_I), Eq. (20) of \[Song2020\], at
/// nodes all of whose cells are full of fluid, and by mass-weighted transfer elsewhere.
pub fn node_velocity<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    index: &[u32],
    transfer: &[[T; 4]],
    velocity: &mut [[T; 4]],
) -> Counters
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    if !<M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES {
        for_each_block(index.len(), NODE_GRAIN, velocity, &|nodes, part: &mut [[T; 4]]| {
            for (node, out) in nodes.zip(part) {
                *out = transfer_velocity::<T, D>(transfer[node]);
            }
        });
        return Counters::default();
    }
    let work = |nodes: std::ops::Range<usize>, part: &mut [[T; 4]]| {
        vectorized!(D, simd => {
            let mut counters = Counters::default();
            for (node, out) in nodes.zip(part) {
                let at = view.grid.node_coordinates(index[node]);
                let rebuilt =
                    if is_interior(view, at) { rebuild(simd, view, at, &mut counters) } else { None };
                *out = match rebuilt {
                    Some(velocity) => velocity,
                    None if transfer[node][3] > T::zero() => transfer_velocity::<T, D>(transfer[node]),
                    None => limit_velocity(view, at),
                };
            }
            counters
        })
    };
    fold_blocks(index.len(), FIT_GRAIN, velocity, &|node| node, &work, &Counters::sum)
}

/// Velocity of a node to which no mass arrives although points are near: all of them lie on far faces of their cells.
///
/// As they come closer to these faces, their weights go to zero but the velocity Σ w m v / Σ w m does not. The limit is
/// the mean over the points around for points that go there together. Zero would be a strain v/h of the cell.
#[inline(never)]
fn limit_velocity<T, const D: usize, M, K>(view: &View<'_, T, D, M, K>, node: [usize; D]) -> [T; 4]
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let mut sum = [T::zero(); 4];
    for code in 0..M::Shape::REACH.pow(D as u32) {
        let Some(found) = view.grid.neighbor(node, below::<M::Shape, T, D>(code)) else { continue };
        let slot = view.cells.slot_of[found];
        if slot == ABSENT {
            continue;
        }
        for point in view.cells.points(slot as usize) {
            let mass = view.particles.mass[point];
            for axis in 0..D {
                sum[axis] += mass * view.particles.velocity[point][axis];
            }
            sum[3] += mass;
        }
    }
    transfer_velocity::<T, D>(sum)
}

/// The shift from a node to one of the cells whose functions reach it.
#[inline(always)]
fn below<S: ShapeFunction<T>, T: Scalar, const D: usize>(code: usize) -> [i32; D] {
    let mut rest = code;
    std::array::from_fn(|_| {
        let back = rest % S::REACH;
        rest /= S::REACH;
        -(back as i32)
    })
}

#[inline(always)]
fn rebuild<S, T, const D: usize, M, K>(
    simd: S,
    view: &View<'_, T, D, M, K>,
    node: [usize; D],
    counters: &mut Counters,
) -> Option<[T; 4]>
where
    S: Simd,
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let shape = view.method.shape();
    let mut at = [T::zero(); D];
    for axis in 0..D {
        let (n, periodic) = (view.grid.n_cells[axis], view.grid.periodic[axis]);
        at[axis] = shape.node_coordinate(node[axis], n, periodic);
    }
    let reconstruction = view.method.reconstruction();
    let fit = reconstruction.fit_node(simd, &view.cloud(), at, nodes_read(view));
    counters.count_fit(&fit);
    let (Vector(momentum), Value(density)) = fit.value()?;
    let mut row = widen(momentum);
    row[3] = density;
    Some(transfer_velocity::<T, D>(row))
}

/// Whether every cell of the box whose functions reach the node is full of fluid.
#[inline(always)]
fn is_interior<T, const D: usize, M, K>(view: &View<'_, T, D, M, K>, node: [usize; D]) -> bool
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    if !<M::Quadrature as Quadrature<T, D>>::CLASSIFIES {
        return true;
    }
    (0..M::Shape::REACH.pow(D as u32)).all(|code| {
        let shift = below::<M::Shape, T, D>(code);
        view.grid.neighbor(node, shift).is_none_or(|cell| {
            let kind = view.cells.kind.get(view.cells.slot_of[cell] as usize);
            kind == Some(&CellKind::Internal) || view.cells.is_solid(cell)
        })
    })
}
