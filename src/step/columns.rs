//! The columns that the fits of a step read.

use super::{ParticlesOf, StateOf, View};
use crate::Scalar;
use crate::material::Material;
use crate::math::{Field, MAX_COMPONENTS, Value, Vector};
use crate::method::Method;
use crate::quadrature::Quadrature;
use crate::reconstruction::{Columns, Flow, InColumns, Reconstruction};

/// Writes position, ρv, ρ, the state of the material and, where there is one, the slope of ρ of all points, in this order,
/// where a method reconstructs fields.
pub fn gather_columns<T, const D: usize, M, K>(
    particles: &ParticlesOf<T, D, M, K>,
    columns: &mut Columns<T>,
) where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let reconstructs = <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES
        || <M::Quadrature as Quadrature<T, D>>::USES_CENTERS;
    if !reconstructs {
        return;
    }
    let p = particles;
    let n_components = <StateOf<T, D, K> as Field<T>>::COMPONENTS;
    let is_affine = !p.density_slope.is_empty();
    columns.resize(p.len(), 2 * D + 1 + n_components + if is_affine { D } else { 0 });
    for axis in 0..D {
        columns.set(axis, |points| p.position[points].iter().map(move |x| x[axis]));
        columns.set(D + axis, |points| {
            let density = &p.density[points.clone()];
            p.velocity[points].iter().zip(density).map(move |(v, &density)| v[axis] * density)
        });
    }
    columns.set(2 * D, |points| p.density[points].iter().copied());
    for k in 0..n_components {
        columns.set(2 * D + 1 + k, |points| {
            p.state[points].iter().map(move |state| {
                let mut components = [T::zero(); MAX_COMPONENTS];
                state.write(&mut components[..n_components]);
                components[k]
            })
        });
    }
    for axis in (0..D).filter(|_| is_affine) {
        columns.set(2 * D + 1 + n_components + axis, |points| {
            p.density_slope[points].iter().map(move |slope| slope[axis])
        });
    }
}

/// Density and slope of the points, where density is affine.
#[inline(always)]
pub fn affine_density_read<'a, T, const D: usize, M, K>(
    view: &View<'a, T, D, M, K>,
) -> (InColumns<'a, T, Value<T>>, InColumns<'a, T, Vector<T, D>>)
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let n_components = <StateOf<T, D, K> as Field<T>>::COMPONENTS;
    (view.columns.field(2 * D), view.columns.field(2 * D + 1 + n_components))
}

/// What is fitted at centres: density and state of the material.
#[inline(always)]
pub fn centers_read<'a, T, const D: usize, M, K>(
    view: &View<'a, T, D, M, K>,
) -> InColumns<'a, T, (Value<T>, StateOf<T, D, K>)>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    view.columns.field(2 * D)
}

/// What is fitted at nodes.
#[inline(always)]
pub fn nodes_read<'a, T, const D: usize, M, K>(
    view: &View<'a, T, D, M, K>,
) -> InColumns<'a, T, Flow<T, D>>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    view.columns.field(D)
}
