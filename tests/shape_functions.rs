//! Identities that every grid shape function keeps, in every cell, at walls and on periodic axes.

use crate::common::shape_identities::{
    Family, Precision, by_node, check_continuity, check_gradient, check_moments, check_reflection,
    check_support, check_wall, position,
};
use proptest::prelude::*;
use transpoint::shape::{
    AxisPosition, Bare, ConvectedGimp, Corrected, CubicBspline, DualDomain, Gimp, LeastSquares,
    Linear, QuadraticBspline, Row, ShapeFunction, Staggered,
};

impl<T: Precision> Family<T> for Linear {
    const SMOOTH: bool = false;
}

impl<T: Precision> Family<T> for Gimp<T> {
    const GHOSTS: usize = 1;

    /// A quarter of the step times the jump of the second derivative, at most 3/l.
    fn difference_error(&self, step: f64) -> f64 {
        0.75 * step / self.length.as_f64()
    }
}

impl<T: Precision> Family<T> for QuadraticBspline {}

impl<T: Precision> Family<T> for CubicBspline {
    /// step²/6 times the third derivative, at most 18 (one cell between walls).
    fn difference_error(&self, step: f64) -> f64 {
        3.0 * step * step
    }
}

/// The length along the first axis, which is the one that rows are taken along.
fn first_length<T: Precision>(shape: &ConvectedGimp<T>) -> f64 {
    let at = AxisPosition { cell: 3, xi: T::zero(), n_cells: 8, periodic: false };
    // On a node the outer weights are l/8.
    8.0 * shape.row(at).weight[0].as_f64()
}

impl<T: Precision> Family<T> for ConvectedGimp<T> {
    const GHOSTS: usize = 1;

    /// As of uGIMP with the length along the axis.
    fn difference_error(&self, step: f64) -> f64 {
        0.75 * step / first_length(self)
    }
}

/// Two hats half a cell apart have half the slope of one on the outer nodes, and the gradient is that of one.
impl<T: Precision> Family<T> for Staggered {
    const GHOSTS: usize = 1;
    const SLOPES: bool = false;
}

/// The values are hats, whose slopes jump.
impl<T: Precision> Family<T> for DualDomain {
    const GHOSTS: usize = 1;
    const SLOPES: bool = false;
}

impl<T: Precision> Family<T> for Corrected {
    const GHOSTS: usize = 1;

    /// As of uGIMP with length 1.
    fn difference_error(&self, step: f64) -> f64 {
        0.75 * step
    }
}

impl<T: Precision> Family<T> for LeastSquares<QuadraticBspline> {
    const SLOPES: bool = false;
    const MIRROR: f64 = 8.0;

    /// `Σ G = Σ N (x_i − x) / D`: the sum is zero to round-off, and D = ¼ but next to walls, where it vanishes.
    fn amplification(&self, at: AxisPosition<T>) -> f64 {
        let row = self.row(at);
        let offset = |k: usize| {
            let node: T = self.node_coordinate(at.cell + k, at.n_cells, at.periodic);
            node.as_f64() - at.cell as f64 - at.xi.as_f64()
        };
        let second: f64 = (0..3).map(|k| row.weight[k].as_f64() * offset(k).powi(2)).sum();
        1.0_f64.max(0.25 / second)
    }
}

/// A family as seen along the first axis, where that depends on more than the position.
#[derive(Clone, Copy, Debug)]
struct AlongFirst<S>(S);

impl<T: Precision, S: ShapeFunction<T>> ShapeFunction<T> for AlongFirst<S> {
    const WIDTH: usize = S::WIDTH;
    const REACH: usize = S::REACH;

    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        self.0.row_along(0, at)
    }

    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> T {
        self.0.node_coordinate(index, n_cells, periodic)
    }
}

impl<T: Precision, S: Family<T>> Family<T> for AlongFirst<S> {
    const GHOSTS: usize = S::GHOSTS;
}

fn gimp<T: Precision>() -> impl Strategy<Value = Gimp<T>> {
    prop_oneof![Just(0.25), Just(0.5), Just(1.0), 0.05..=1.0]
        .prop_map(|length: f64| Gimp { length: T::lit(length) })
}

fn convected<T: Precision>() -> impl Strategy<Value = ConvectedGimp<T>> {
    let length = prop_oneof![Just(1.0 / 16.0), Just(1.0), 1.0 / 16.0..=1.0];
    proptest::array::uniform3(length)
        .prop_map(|length| ConvectedGimp::default().stretched(length.map(T::lit)))
}

/// Sums stay what they are; on a bare side nothing reaches the node beyond the cell, and without bare sides nothing
/// changes.
fn check_bare<T: Precision, S: Family<T>>(
    shape: &S,
    bare: [bool; 2],
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    let beside = AlongFirst(shape.beside(Bare([bare; 3])));
    check_support(&beside, at)?;
    check_moments(&beside, at)?;
    let Row { first, weight, gradient } = beside.row(at);
    for (is_bare, outer) in bare.into_iter().zip([0, 3]) {
        if let Some(k) = usize::checked_sub(outer, first).filter(|&k| is_bare && k < S::WIDTH) {
            prop_assert_eq!((weight[k], gradient[k]), (T::zero(), T::zero()), "node {}", outer);
        }
    }
    if bare == [false; 2] {
        prop_assert_eq!(beside.row(at), shape.row(at));
    }
    // The other axes have sides of their own.
    let mut elsewhere = Bare([bare; 3]);
    elsewhere.0[0] = [false; 2];
    let (values, slopes) = by_node(&AlongFirst(shape.beside(elsewhere)), at);
    prop_assert_eq!((values, slopes), by_node(shape, at));
    Ok(())
}

macro_rules! identities {
    ($module:ident, $scalar:ty, $shapes:expr) => {
        mod $module {
            use super::*;

            proptest! {
                #![proptest_config(ProptestConfig {
                    failure_persistence: None,
                    ..ProptestConfig::default()
                })]

                #[test]
                fn support_is_contained_and_weights_are_not_negative(
                    shape in $shapes, at in position::<$scalar>()
                ) {
                    check_support(&shape, at)?;
                }

                #[test]
                fn moments_are_reproduced(shape in $shapes, at in position::<$scalar>()) {
                    check_moments(&shape, at)?;
                }

                #[test]
                fn gradient_is_the_difference_quotient(
                    shape in $shapes, at in position::<$scalar>()
                ) {
                    check_gradient(&shape, at)?;
                }

                #[test]
                fn faces_are_continuous(shape in $shapes, at in position::<$scalar>()) {
                    check_continuity(&shape, at)?;
                }

                #[test]
                fn wall_node_interpolates(
                    shape in $shapes, n_cells in 1_usize..=8, upper in any::<bool>()
                ) {
                    check_wall::<$scalar, _>(&shape, n_cells, upper)?;
                }

                #[test]
                fn reflection_mirrors_the_row(shape in $shapes, at in position::<$scalar>()) {
                    check_reflection(&shape, at)?;
                }
            }
        }
    };
}

identities!(linear_f64, f64, Just(Linear));
identities!(linear_f32, f32, Just(Linear));
identities!(gimp_f64, f64, gimp::<f64>());
identities!(gimp_f32, f32, gimp::<f32>());
identities!(quadratic_f64, f64, Just(QuadraticBspline));
identities!(quadratic_f32, f32, Just(QuadraticBspline));
identities!(cubic_f64, f64, Just(CubicBspline));
identities!(cubic_f32, f32, Just(CubicBspline));
identities!(convected_f64, f64, convected::<f64>());
identities!(convected_f32, f32, convected::<f32>());
identities!(staggered_f64, f64, Just(Staggered));
identities!(staggered_f32, f32, Just(Staggered));
identities!(dual_domain_f64, f64, Just(DualDomain::default()));
identities!(dual_domain_f32, f32, Just(DualDomain::default()));
identities!(corrected_f64, f64, Just(Corrected::default()));
identities!(corrected_f32, f32, Just(Corrected::default()));
identities!(least_squares_f64, f64, Just(LeastSquares(QuadraticBspline)));
identities!(least_squares_f32, f32, Just(LeastSquares(QuadraticBspline)));

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bare_sides_keep_the_sums(at in position::<f64>(), lower in any::<bool>(), upper in any::<bool>()) {
        check_bare(&DualDomain::default(), [lower, upper], at)?;
        check_bare(&Corrected::default(), [lower, upper], at)?;
    }

    #[test]
    fn bare_sides_keep_the_sums_in_f32(
        at in position::<f32>(), lower in any::<bool>(), upper in any::<bool>()
    ) {
        check_bare(&DualDomain::default(), [lower, upper], at)?;
        check_bare(&Corrected::default(), [lower, upper], at)?;
    }
}
