//! Families that are chosen at run time: kernels are compiled once for all that touch equally many nodes.

use super::{
    AxisPosition, Bare, ConvectedGimp, Corrected, CubicBspline, DualDomain, Gimp, LeastSquares,
    QuadraticBspline, Row, ShapeFunction, Staggered,
};
use crate::Scalar;
use crate::simd::Simd;

/// A choice among families with the same width and reach. The cost is a branch per point and axis, which always goes
/// the same way.
macro_rules! choice {
    (
        $(#[$doc:meta])*
        $name:ident<$scalar:ident>, $width:literal, $reach:literal,
        $($(#[$family_doc:meta])* $family:ident($type:ty)),+
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $name<$scalar> {
            $($(#[$family_doc])* $family($type),)+
            /// No family; keeps the scalar type.
            #[doc(hidden)]
            Never(std::convert::Infallible, std::marker::PhantomData<$scalar>),
        }

        impl<$scalar: Scalar> ShapeFunction<$scalar> for $name<$scalar> {
            const WIDTH: usize = $width;
            const REACH: usize = $reach;

            #[inline(always)]
            fn row(&self, at: AxisPosition<$scalar>) -> Row<$scalar> {
                match self {
                    $(Self::$family(family) => family.row(at),)+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn row_along(&self, axis: usize, at: AxisPosition<$scalar>) -> Row<$scalar> {
                match self {
                    $(Self::$family(family) => family.row_along(axis, at),)+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn rows<S: Simd, const D: usize>(
                &self,
                simd: S,
                at: &[AxisPosition<$scalar>; D],
                inverse_spacing: $scalar::Four<S>,
            ) -> [Row<$scalar>; D] {
                match self {
                    $(Self::$family(family) => family.rows(simd, at, inverse_spacing),)+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn looks_around(&self) -> bool {
                match self {
                    $(Self::$family(family) => {
                        ShapeFunction::<$scalar>::looks_around(family)
                    })+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn stretches(&self) -> bool {
                match self {
                    $(Self::$family(family) => ShapeFunction::<$scalar>::stretches(family),)+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn beside(&self, bare: Bare) -> Self {
                match self {
                    $(Self::$family(family) => {
                        Self::$family(ShapeFunction::<$scalar>::beside(family, bare))
                    })+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn stretched(&self, length: [$scalar; 3]) -> Self {
                match self {
                    $(Self::$family(family) => Self::$family(family.stretched(length)),)+
                    Self::Never(never, _) => match *never {},
                }
            }

            #[inline(always)]
            fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> $scalar {
                match self {
                    $(Self::$family(family) => family.node_coordinate(index, n_cells, periodic),)+
                    Self::Never(never, _) => match *never {},
                }
            }
        }
    };
}

choice! {
    /// Families about the vertices that touch three nodes along an axis.
    AboutVertices<T>, 3, 4,
    /// One length for all.
    Gimp(Gimp<T>),
    /// A length for each.
    ConvectedGimp(ConvectedGimp<T>),
    /// By way of cell centres.
    Staggered(Staggered),
    /// Corrected at surfaces and walls.
    Corrected(Corrected)
}

choice! {
    /// Families that touch four nodes along an axis.
    FourWide<T>, 4, 4,
    /// Cubic B-splines.
    CubicBspline(CubicBspline),
    /// Dual domains.
    DualDomain(DualDomain)
}

choice! {
    /// Quadratic B-splines with one of two gradients.
    Quadratic<T>, 3, 3,
    /// Their derivative.
    Bspline(QuadraticBspline),
    /// That of a least-squares fit.
    LeastSquares(LeastSquares<QuadraticBspline>)
}
