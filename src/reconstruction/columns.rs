//! What a fit reads of the points: one by one, or four side by side from columns.

use std::marker::PhantomData;
use std::ops::Range;

use super::Cloud;
use crate::Scalar;
use crate::math::{Field, MAX_COMPONENTS};
use crate::parallel::for_each_block;
use crate::particles::POINT_GRAIN;
use crate::simd::{Simd, SimdBase as _, load, splat};

/// Points that are read at once.
const LANES: usize = 4;

/// Numbers of the points in columns, in the order of cells: the position first, then the components of
/// fields.
///
/// A fit then reads four points with one instruction per column. Every column ends with room for three
/// points more, so that four can be read from any point on.
#[derive(Clone, Debug)]
pub struct Columns<T> {
    values: Vec<T>,
    n_points: usize,
}

impl<T> Default for Columns<T> {
    fn default() -> Self {
        Self { values: Vec::new(), n_points: 0 }
    }
}

impl<T: Scalar> Columns<T> {
    /// Makes room for a number of points and columns; the numbers are those from before or zero.
    pub fn resize(&mut self, n_points: usize, n_columns: usize) {
        self.n_points = n_points;
        self.values.resize(n_columns * self.stride(), T::zero());
    }

    /// Sets a column; `values` gives the numbers of a range of points.
    pub fn set<I>(&mut self, column: usize, values: impl Fn(Range<usize>) -> I + Sync)
    where
        I: Iterator<Item = T>,
    {
        let start = column * self.stride();
        let column = &mut self.values[start..start + self.n_points];
        for_each_block(self.n_points, POINT_GRAIN, column, &|points, part: &mut [T]| {
            for (out, value) in part.iter_mut().zip(values(points)) {
                *out = value;
            }
        });
    }

    /// The field whose components are the columns from `first` on.
    pub fn field<F: Field<T>>(&self, first: usize) -> InColumns<'_, T, F> {
        InColumns { columns: self, first, field: PhantomData }
    }

    fn stride(&self) -> usize {
        self.n_points + LANES - 1
    }

    /// Part of a column from a point on.
    #[inline(always)]
    fn part(&self, column: usize, first: usize, length: usize) -> &[T] {
        &self.values[column * self.stride() + first..][..length]
    }
}

/// Four points side by side: positions, m, and the components of a field.
#[derive(Clone, Copy, Debug)]
pub struct Quad<V, const D: usize> {
    /// Positions, m.
    pub position: [V; D],
    /// Components of the field; the rest are zero.
    pub components: [V; MAX_COMPONENTS],
}

/// A field known at the points of a cloud.
pub trait PointField<T: Scalar, const D: usize> {
    /// What it is.
    type Field: Field<T>;

    /// Its value at a point.
    fn at(&self, point: usize) -> Self::Field;

    /// Points that are stored one after another, ready to be read.
    type Run<'c>;

    /// The points of a range.
    fn run<'c>(&self, cloud: &Cloud<'c, T, D>, points: Range<usize>) -> Self::Run<'c>;

    /// Four points of a run from number `first` of the run on. What lies beyond its end are any points of
    /// the cloud or zeros; the caller gives them no weight.
    fn quad<S: Simd>(&self, simd: S, run: &Self::Run<'_>, first: usize) -> Quad<T::Four<S>, D>;
}

/// A field in columns of [`Columns`].
#[derive(Clone, Copy, Debug)]
pub struct InColumns<'a, T, F> {
    columns: &'a Columns<T>,
    first: usize,
    field: PhantomData<F>,
}

impl<'a, T: Scalar, F: Field<T>, const D: usize> PointField<T, D> for InColumns<'a, T, F> {
    type Field = F;

    fn at(&self, point: usize) -> F {
        let mut components = [T::zero(); MAX_COMPONENTS];
        let columns = self.columns;
        for k in 0..F::COMPONENTS {
            components[k] = columns.values[(self.first + k) * columns.stride() + point];
        }
        F::read(&components[..F::COMPONENTS])
    }

    type Run<'c> = ([&'a [T]; D], [&'a [T]; MAX_COMPONENTS]);

    #[inline(always)]
    fn run<'c>(&self, _cloud: &Cloud<'c, T, D>, points: Range<usize>) -> Self::Run<'c> {
        // Parts of one length, so that one check of a bound serves all of them.
        let columns = self.columns;
        let (first, length) = (points.start, points.len() + LANES - 1);
        let mut components: [&'a [T]; MAX_COMPONENTS] = [&[]; MAX_COMPONENTS];
        for k in 0..F::COMPONENTS {
            components[k] = columns.part(self.first + k, first, length);
        }
        let position = std::array::from_fn(
            #[inline(always)]
            |axis| columns.part(axis, first, length),
        );
        (position, components)
    }

    #[inline(always)]
    fn quad<S: Simd>(&self, simd: S, run: &Self::Run<'_>, first: usize) -> Quad<T::Four<S>, D> {
        let none = splat(simd, T::zero());
        let mut quad = Quad { position: [none; D], components: [none; MAX_COMPONENTS] };
        for axis in 0..D {
            quad.position[axis] =
                T::Four::<S>::from_slice(simd, &run.0[axis][first..first + LANES]);
        }
        for k in 0..F::COMPONENTS {
            let part = &run.1[k][first..first + LANES];
            quad.components[k] = T::Four::<S>::from_slice(simd, part);
        }
        quad
    }
}

/// A field given by a function of the point's number, for single fits.
#[derive(Clone, Copy, Debug)]
pub struct EachPoint<G>(pub G);

impl<T: Scalar, F: Field<T>, G: Fn(usize) -> F, const D: usize> PointField<T, D> for EachPoint<G> {
    type Field = F;

    fn at(&self, point: usize) -> F {
        (self.0)(point)
    }

    type Run<'c> = (&'c [[T; D]], Range<usize>);

    #[inline(always)]
    fn run<'c>(&self, cloud: &Cloud<'c, T, D>, points: Range<usize>) -> Self::Run<'c> {
        (cloud.position, points)
    }

    #[inline(always)]
    fn quad<S: Simd>(&self, simd: S, run: &Self::Run<'_>, first: usize) -> Quad<T::Four<S>, D> {
        let zero = T::zero();
        let mut at = [[zero; LANES]; D];
        let mut values = [[zero; LANES]; MAX_COMPONENTS];
        let (position, points) = run;
        for (lane, point) in points.clone().skip(first).take(LANES).enumerate() {
            for axis in 0..D {
                at[axis][lane] = position[point][axis];
            }
            let mut components = [zero; MAX_COMPONENTS];
            (self.0)(point).write(&mut components[..F::COMPONENTS]);
            for k in 0..F::COMPONENTS {
                values[k][lane] = components[k];
            }
        }
        let none = splat(simd, zero);
        let mut quad = Quad { position: [none; D], components: [none; MAX_COMPONENTS] };
        for axis in 0..D {
            quad.position[axis] = load(simd, &at[axis]);
        }
        for k in 0..F::COMPONENTS {
            quad.components[k] = load(simd, &values[k]);
        }
        quad
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MovingLeastSquares, Reconstruction as _};
    use super::*;
    use crate::basis::{Limiters, Linear};
    use crate::cells::Cells;
    use crate::grid::Grid;
    use crate::math::Value;
    use crate::particles::Particles;
    use crate::scene::{Boundary, GridSpec};
    use crate::simd::vectorized;

    #[test]
    fn fits_from_columns_and_from_single_points_are_the_same_bits() {
        let spec = GridSpec { origin: [0.5, -0.25], spacing: [0.3, 0.2], cells: [5, 6] };
        let grid =
            Grid::<f64, 2>::new(&spec, &[[Boundary::Periodic; 2], [Boundary::Slip; 2]], 1).unwrap();
        let mut particles = Particles::<f64, 2, (), ()>::default();
        for k in 0..97_u32 {
            // Two irrational numbers spread the points over the box, at 0 to 6 per cell.
            let place = [0.754_877_666, 0.569_840_291].map(|step| (step * f64::from(k)).fract());
            let position = [0.5 + 1.5 * place[0], -0.25 + 1.2 * place[1]];
            particles.push(k, position, [0.0; 2], 1.0 + place[0] * place[1], 1.0);
            particles.cell[k as usize] = grid.cell_of(position).unwrap();
        }
        let mut cells = Cells::new(&grid);
        cells.bin(&grid, &mut particles, &mut Particles::default());
        let (position, density) = (&particles.position, &particles.density);
        let cloud = Cloud { grid: &grid, cells: &cells, position, mass: &particles.mass, density };
        let mut columns = Columns::default();
        columns.resize(particles.len(), 3);
        for axis in 0..2 {
            columns.set(axis, |points| position[points].iter().map(move |x| x[axis]));
        }
        columns.set(2, |points| density[points].iter().copied());
        for support in [1.0, 1.5] {
            let mut fit = MovingLeastSquares::<Linear, f64>::new(support);
            fit.limiters = Limiters { leverage: Some(3.0), positivity: Some(0.8) };
            for &cell in &cells.index {
                let cell = grid.cell_coordinates(cell);
                let node = cell.map(|c| c as f64);
                let field = || columns.field::<Value<f64>>(2);
                let center = vectorized!(2, simd => fit.fit_center(simd, &cloud, cell, field()));
                assert_eq!(center, fit.at_center(&cloud, cell, |p| Value(density[p])));
                let corner = vectorized!(2, simd => fit.fit_node(simd, &cloud, node, field()));
                assert_eq!(corner, fit.at_node(&cloud, node, |p| Value(density[p])));
            }
        }
    }
}
