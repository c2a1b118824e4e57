//! Identities of one row of shape functions, for any family.
//!
//! Bounds are multiples of the round-off unit ε, about twice the largest error of 1e5 random points.

use proptest::prelude::*;
use transpoint::Scalar;
use transpoint::shape::{AxisPosition, MAX_WIDTH, Row, ShapeFunction};

/// Round-off unit and difference step of a scalar type.
pub trait Precision: Scalar {
    const UNIT: f64;
    const DIFFERENCE_STEP: f64;
}

impl Precision for f64 {
    const UNIT: f64 = f64::EPSILON;
    const DIFFERENCE_STEP: f64 = 1.0 / 65536.0;
}

impl Precision for f32 {
    const UNIT: f64 = f32::EPSILON as f64;
    const DIFFERENCE_STEP: f64 = 1.0 / 128.0;
}

/// What a test must know about a family besides its rows.
pub trait Family<T: Precision>: ShapeFunction<T> {
    /// Nodes beyond each wall, whose weight there is always zero.
    const GHOSTS: usize = 0;
    /// Whether the derivative is continuous.
    const SMOOTH: bool = true;
    /// Whether the gradients are the slopes of the values.
    const SLOPES: bool = true;
    /// Largest difference of a gradient and the mirrored one, in ε: zero unless sums over nodes are formed.
    const MIRROR: f64 = 0.0;

    /// Largest error of a central difference quotient of this family in exact arithmetic.
    fn difference_error(&self, _step: f64) -> f64 {
        0.0
    }

    /// Factor on the round-off of the gradients, where they are quotients; infinite where there are none.
    fn amplification(&self, _at: AxisPosition<T>) -> f64 {
        1.0
    }
}

pub fn position<T: Precision>() -> impl Strategy<Value = AxisPosition<T>> {
    let xi = prop_oneof![1 => Just(0.0), 1 => Just(0.5), 1 => Just(1.0), 9 => 0.0..=1.0];
    (1_usize..=8, 0.0..1.0, xi, any::<bool>()).prop_map(|(n_cells, place, xi, periodic)| {
        let cell = (place * n_cells as f64) as usize;
        AxisPosition { cell, xi: T::lit(xi), n_cells, periodic }
    })
}

/// Values and derivatives by stored node of the axis, in `f64`.
pub fn by_node<T: Precision, S: Family<T>>(shape: &S, at: AxisPosition<T>) -> (Vec<f64>, Vec<f64>) {
    let row = shape.row(at);
    let mut values = vec![0.0; at.n_cells + S::EXTRA];
    let mut slopes = values.clone();
    for k in 0..S::WIDTH {
        values[at.cell + row.first + k] += row.weight[k].as_f64();
        slopes[at.cell + row.first + k] += row.gradient[k].as_f64();
    }
    (values, slopes)
}

/// Adds the images of a periodic axis.
pub fn folded(values: &[f64], n_cells: usize) -> Vec<f64> {
    let mut sums = vec![0.0; n_cells];
    values.iter().enumerate().for_each(|(node, value)| sums[node % n_cells] += value);
    sums
}

pub fn largest_gap(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

pub fn check_support<T: Precision, S: Family<T>>(
    shape: &S,
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    let Row { first, weight, gradient } = shape.row(at);
    prop_assert!(S::WIDTH <= S::REACH && S::REACH <= MAX_WIDTH && S::EXTRA + 1 == S::REACH);
    prop_assert!(first + S::WIDTH <= S::REACH, "first = {first}");
    for k in 0..MAX_WIDTH {
        prop_assert!(weight[k] >= T::zero() && weight[k] <= T::one(), "{weight:?}");
        prop_assert!(k < S::WIDTH || (weight[k] == T::zero() && gradient[k] == T::zero()));
    }
    let (values, slopes) = by_node(shape, at);
    let last = values.len() - 1;
    for ghost in (0..S::GHOSTS).flat_map(|k| [k, last - k]).filter(|_| !at.periodic) {
        prop_assert_eq!((values[ghost], slopes[ghost]), (0.0, 0.0), "ghost {}", ghost);
    }
    Ok(())
}

/// `Σ N = 1, Σ dN = 0, Σ N x_i = x, Σ dN x_i = 1`.
pub fn check_moments<T: Precision, S: Family<T>>(
    shape: &S,
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    let (values, slopes) = by_node(shape, at);
    let from_cell = |node: usize| {
        let coordinate = shape.node_coordinate(node, at.n_cells, at.periodic);
        coordinate.as_f64() - at.cell as f64
    };
    let moment = |of: &[f64]| of.iter().enumerate().map(|(i, v)| v * from_cell(i)).sum::<f64>();
    let errors = [
        values.iter().sum::<f64>() - 1.0,
        slopes.iter().sum::<f64>(),
        moment(&values) - at.xi.as_f64(),
        moment(&slopes) - 1.0,
    ];
    let slopes = shape.amplification(at);
    for (error, bound) in errors.into_iter().zip([4.0, 4.0 * slopes, 4.0, 10.0 * slopes]) {
        prop_assert!(error.abs() <= bound * T::UNIT, "{errors:?} at {at:?}");
    }
    Ok(())
}

pub fn check_gradient<T: Precision, S: Family<T>>(
    shape: &S,
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    if !S::SLOPES {
        return Ok(());
    }
    let step = T::DIFFERENCE_STEP;
    let xi = at.xi.as_f64().clamp(step, 1.0 - step);
    let sample = |xi: f64| by_node(shape, AxisPosition { xi: T::lit(xi), ..at });
    let ((before, _), (_, slopes), (after, _)) = (sample(xi - step), sample(xi), sample(xi + step));
    let width = T::lit(xi + step).as_f64() - T::lit(xi - step).as_f64();
    let quotients: Vec<_> = after.iter().zip(&before).map(|(b, a)| (b - a) / width).collect();
    let bound = shape.difference_error(step) + 2.0 * T::UNIT / step;
    let gap = largest_gap(&quotients, &slopes);
    prop_assert!(gap <= bound, "{gap:e} > {bound:e} at {at:?}");
    Ok(())
}

/// Node by node, across the face to the next cell; a periodic axis wraps around.
pub fn check_continuity<T: Precision, S: Family<T>>(
    shape: &S,
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    let wraps = at.cell + 1 == at.n_cells;
    if wraps && !at.periodic {
        return Ok(());
    }
    let next = if wraps { 0 } else { at.cell + 1 };
    let (mut before, mut slope_before) = by_node(shape, AxisPosition { xi: T::one(), ..at });
    let (mut after, mut slope_after) =
        by_node(shape, AxisPosition { cell: next, xi: T::zero(), ..at });
    if at.periodic {
        for values in [&mut before, &mut slope_before, &mut after, &mut slope_after] {
            *values = folded(values, at.n_cells);
        }
    }
    prop_assert!(largest_gap(&before, &after) <= T::UNIT, "{before:?} {after:?}");
    if S::SMOOTH {
        let gap = largest_gap(&slope_before, &slope_after);
        prop_assert!(gap <= T::UNIT, "{slope_before:?} {slope_after:?}");
    }
    Ok(())
}

/// Exact: the outermost node alone is one on its wall.
pub fn check_wall<T: Precision, S: Family<T>>(
    shape: &S,
    n_cells: usize,
    upper: bool,
) -> Result<(), TestCaseError> {
    let (cell, xi) = if upper { (n_cells - 1, T::one()) } else { (0, T::zero()) };
    let (values, _) = by_node(shape, AxisPosition { cell, xi, n_cells, periodic: false });
    let wall_node = if upper { values.len() - 1 - S::GHOSTS } else { S::GHOSTS };
    for (node, value) in values.into_iter().enumerate() {
        prop_assert_eq!(value, f64::from(node == wall_node), "node {}", node);
    }
    let coordinate = shape.node_coordinate(wall_node, n_cells, false);
    prop_assert_eq!(coordinate.as_f64(), if upper { n_cells as f64 } else { 0.0 });
    Ok(())
}

/// The mirrored point has the mirrored row, values to the last bit, where 1 − ξ is exact and ξ ≠ ½.
pub fn check_reflection<T: Precision, S: Family<T>>(
    shape: &S,
    at: AxisPosition<T>,
) -> Result<(), TestCaseError> {
    let xi = ((at.xi.as_f64() * 1023.0).floor() + 0.5) / 1024.0;
    let (values, slopes) = by_node(shape, AxisPosition { xi: T::lit(xi), ..at });
    let mirror = AxisPosition { cell: at.n_cells - 1 - at.cell, xi: T::lit(1.0 - xi), ..at };
    let (mut mirrored, mirrored_slopes) = by_node(shape, mirror);
    mirrored.reverse();
    let mirrored_slopes: Vec<_> = mirrored_slopes.into_iter().rev().map(|slope| -slope).collect();
    prop_assert_eq!(values, mirrored);
    let gap = largest_gap(&slopes, &mirrored_slopes);
    prop_assert!(gap <= S::MIRROR * T::UNIT, "{slopes:?} {mirrored_slopes:?}");
    Ok(())
}
