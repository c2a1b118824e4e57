//! Points taken four at a time from runs of cells give what a sum over all points and images gives.

use crate::common::clouds::{CloudData, weight};
use crate::common::parts::cases;
use crate::common::scenes::Block;
use crate::common::{Random, near};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use transpoint::basis::{Constant, Fit, Limiters, Linear, PolynomialBasis};
use transpoint::math::Value;
use transpoint::reconstruction::{MovingLeastSquares, Reconstruction};
use transpoint::scene::{Boundary, PointSpec};

/// Cells per axis: a support of four cells reaches around a periodic box more than once.
const N_CELLS: usize = 3;

/// A box whose cells hold from no to seven points at random, so that runs have gaps and tails.
fn cloud<const D: usize>(seed: u64, periodic: bool) -> CloudData<f64, D> {
    let faces = if periodic { Boundary::Periodic } else { Boundary::Slip };
    let mut scene = Block::<D>::full(N_CELLS, faces).scene();
    scene.grid.origin = std::array::from_fn(|axis| 0.3 - axis as f64);
    let (grid, like) = (scene.grid.clone(), scene.points[0]);
    let mut random = Random(seed);
    scene.points.clear();
    for cell in 0..N_CELLS.pow(D as u32) {
        for _ in 0..(8.0 * random.unit()) as usize {
            let mut rest = cell;
            let position = std::array::from_fn(|axis| {
                let along = (rest % N_CELLS) as f64 + 0.01 + 0.98 * random.unit();
                rest /= N_CELLS;
                grid.origin[axis] + grid.spacing[axis] * along
            });
            scene.points.push(PointSpec { position, ..like });
        }
    }
    CloudData::new(&scene)
}

/// Offsets in units of the half width of all points and their periodic images, with their weights.
fn images<const D: usize>(
    data: &CloudData<f64, D>,
    target: [f64; D],
    support: f64,
) -> Vec<(usize, [f64; D], f64)> {
    let mut found = Vec::new();
    for point in 0..data.particles.len() {
        let position = data.particles.position[point];
        for image in 0..7_usize.pow(D as u32) {
            let mut rest = image;
            let shift: [f64; D] = std::array::from_fn(|_| ((rest % 7) as f64 - 3.0, rest /= 7).0);
            if !data.grid.periodic[0] && shift.iter().any(|&boxes| boxes != 0.0) {
                continue;
            }
            let offset: [f64; D] = std::array::from_fn(|axis| {
                let along = data.grid.in_cells(position, axis) - target[axis];
                (along + shift[axis] * N_CELLS as f64) / support
            });
            let phi = offset.iter().map(|&r| weight(r)).product();
            if phi > 0.0 {
                found.push((point, offset, phi));
            }
        }
    }
    found
}

/// The constant term of the weighted least-squares polynomial, which is its value at the target.
fn reference<const D: usize>(
    images: &[(usize, [f64; D], f64)],
    linear: bool,
    field: &[f64],
) -> Option<f64> {
    let n_terms = if linear { 1 + D } else { 1 };
    let mut matrix = DMatrix::zeros(n_terms, n_terms);
    let mut right = DVector::zeros(n_terms);
    for (point, offset, phi) in images {
        let mut terms = DVector::from_element(n_terms, 1.0);
        for axis in 1..n_terms {
            terms[axis] = offset[axis - 1];
        }
        matrix += *phi * &terms * terms.transpose();
        right += *phi * field[*point] * &terms;
    }
    Some(matrix.lu().solve(&right)?[0])
}

fn check<B: PolynomialBasis<f64, D>, const D: usize>(
    (seed, periodic, support): (u64, bool, f64),
    linear: bool,
) -> Result<(), TestCaseError> {
    let data = cloud::<D>(seed, periodic);
    let mut random = Random(!seed);
    let field: Vec<f64> = (0..data.particles.len()).map(|_| random.signed()).collect();
    let free = MovingLeastSquares::<B, f64>::new(support);
    // A limiter that never acts must not change a thing either.
    let limiters = Limiters { positivity: Some(-1e9), leverage: None };
    let limited = MovingLeastSquares { limiters, ..free };
    let cloud = data.cloud();
    for (target, cell) in data.targets() {
        let fit = |method: MovingLeastSquares<B, f64>| match cell {
            Some(cell) => method.at_center(&cloud, cell, |p| Value(field[p])),
            None => method.at_node(&cloud, target, |p| Value(field[p])),
        };
        let found = fit(free);
        prop_assert_eq!(found, fit(limited));
        let images = images(&data, target, support);
        let expected = match found {
            Fit::Empty => {
                prop_assert!(images.is_empty());
                continue;
            }
            Fit::Regular(_) => reference(&images, linear, &field),
            Fit::Constant(_) | Fit::Tempered(_) | Fit::Limited(_) => {
                reference(&images, false, &field)
            }
        };
        let (Some(Value(found)), Some(expected)) = (found.value(), expected) else {
            return Err(TestCaseError::fail(format!("{found:?} and {expected:?}")));
        };
        // Normal equations: ε times their condition, which the least pivot bounds.
        near(&format!("at {target:?}"), found, expected, 1e-8).map_err(TestCaseError::fail)?;
    }
    Ok(())
}

fn setup() -> impl Strategy<Value = (u64, bool, f64)> {
    (any::<u64>(), any::<bool>(), prop::sample::select(vec![0.6, 1.0, 1.7, 4.0]))
}

macro_rules! sums {
    ($name:ident, $dimension:literal, $cases:literal) => {
        proptest! {
            #![proptest_config(cases($cases))]

            #[test]
            fn $name(setup in setup()) {
                check::<Constant, $dimension>(setup, false)?;
                check::<Linear, $dimension>(setup, true)?;
            }
        }
    };
}

sums!(fits_in_1d_equal_the_sum_over_all_images, 1, 64);
sums!(fits_in_2d_equal_the_sum_over_all_images, 2, 16);
sums!(fits_in_3d_equal_the_sum_over_all_images, 3, 2);
