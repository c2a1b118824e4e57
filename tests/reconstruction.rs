//! Moving least squares reproduces its polynomials, falls back and is limited as defined.

use crate::common::clouds::{CloudData, reproduces, weight};
use crate::common::parts::{cases, setup};
use crate::common::phases::{scatter, scheme, solver};
use crate::common::scenes::Block;
use crate::common::{Precision, Random, near};
use proptest::prelude::*;
use transpoint::basis::{Constant, Fit, Limiters, Linear, PolynomialBasis, Quadratic};
use transpoint::math::Value;
use transpoint::quadrature::Gauss;
use transpoint::reconstruction::{Carried, MovingLeastSquares, Reconstruction};
use transpoint::scene::{Boundary, PointSpec, Scene};
use transpoint::{Settings, shape, transfer};

/// Half widths of the support, cells.
const SUPPORTS: [f64; 3] = [1.0, 1.5, 2.0];

/// A box of five cells per axis full of a jittered lattice, between walls or periodic.
///
/// Three points per axis for the quadratic basis: at a corner it sees one cell. The jitter keeps any
/// two points half a point spacing apart, since points that nearly coincide are (rightly) singular.
fn cloud<T: Precision, const D: usize>(
    (seed, periodic): (u64, bool),
    per_axis: usize,
) -> CloudData<T, D> {
    let faces = if periodic { Boundary::Periodic } else { Boundary::Slip };
    let block = Block { per_axis, jitter: 0.25, ..Block::full(5, faces).random(seed) };
    CloudData::new(&block.scene())
}

/// Bounds in ε: the offsets are rounded to 5 ε of a cell, and the normal equations multiply it by
/// their condition, which is largest for the small one-sided clouds at walls.
fn check_degree<T: Precision, B, const D: usize>(
    degree: usize,
    setup: (u64, bool),
    bound: f64,
) -> Result<(), TestCaseError>
where
    B: PolynomialBasis<T, D>,
{
    let data = cloud::<T, D>(setup, if degree == 2 { 3 } else { 2 });
    for support in SUPPORTS {
        let fit = MovingLeastSquares::<B, T>::new(T::lit(support));
        reproduces(&data, &fit, degree, bound * T::UNIT)
            .map_err(|e| TestCaseError::fail(format!("support {support}: {e}")))?;
    }
    Ok(())
}

macro_rules! reproduction {
    ($module:ident, $scalar:ty, $dimension:literal, $cases:literal) => {
        mod $module {
            use super::*;

            proptest! {
                #![proptest_config(cases($cases))]

                #[test]
                fn constants_are_reproduced(setup in setup()) {
                    check_degree::<$scalar, Constant, $dimension>(0, setup, 100.0)?;
                }

                #[test]
                fn linear_fields_are_reproduced(setup in setup()) {
                    check_degree::<$scalar, Linear, $dimension>(1, setup, 1000.0)?;
                }

                #[test]
                fn quadratic_fields_are_reproduced(setup in setup()) {
                    check_degree::<$scalar, Quadratic, $dimension>(2, setup, 4000.0)?;
                }
            }
        }
    };
}

reproduction!(in_1d_f64, f64, 1, 64);
reproduction!(in_1d_f32, f32, 1, 64);
reproduction!(in_2d_f64, f64, 2, 16);
reproduction!(in_2d_f32, f32, 2, 16);
reproduction!(in_3d_f64, f64, 3, 2);
reproduction!(in_3d_f32, f32, 3, 2);

/// Points at offsets (cells) from the centre of the middle cell of a 5 × 5 box.
fn scene_of(offsets: &[[f64; 2]]) -> Scene<2> {
    let mut scene = Block::<2>::full(5, Boundary::Slip).scene();
    let spacing = scene.grid.spacing;
    scene.points.truncate(offsets.len());
    for (point, offset) in scene.points.iter_mut().zip(offsets) {
        let position = std::array::from_fn(|axis| (2.5 + offset[axis]) * spacing[axis]);
        *point = PointSpec { position, ..*point };
    }
    scene
}

/// Σ φ q / Σ φ about the centre of the middle cell.
fn shepard(data: &CloudData<f64, 2>, support: f64, field: impl Fn(usize) -> f64) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for point in 0..data.particles.len() {
        let phi: f64 =
            data.offset(point, [2.5; 2]).into_iter().map(|x| weight(x / support)).product();
        sum += phi * field(point);
        total += phi;
    }
    sum / total
}

proptest! {
    #![proptest_config(cases(256))]

    /// The order of summation is the same, so that only the weights' product may differ.
    #[test]
    fn points_on_a_line_get_the_constant_basis(
        direction in 0.0..std::f64::consts::TAU,
        places in prop::collection::vec(-0.9..0.9_f64, 1..6),
        support in prop::sample::select(SUPPORTS.to_vec()),
    ) {
        let along = |s: &f64| [s * direction.cos(), s * direction.sin()];
        let offsets: Vec<_> = places.iter().map(along).collect();
        let data = CloudData::<f64, 2>::new(&scene_of(&offsets));
        let field = |point: usize| f64::from(data.particles.id[point]) - 1.3;
        let fit = MovingLeastSquares::<Linear, f64>::new(support);
        let found = fit.at_center(&data.cloud(), [2; 2], |point| Value(field(point)));
        let Fit::Constant(Value(found)) = found else {
            return Err(TestCaseError::fail(format!("{found:?}")));
        };
        let exact = shepard(&data, support, field);
        prop_assert!((found - exact).abs() <= 1e-13, "{} is not {}", found, exact);
    }
}

#[test]
fn no_point_within_reach_is_an_empty_fit() {
    let data = CloudData::<f64, 2>::new(&scene_of(&[[0.3, -0.2]]));
    let fit = MovingLeastSquares::<Linear, f64>::new(1.0);
    assert_eq!(fit.at_node(&data.cloud(), [0.0; 2], |_| Value(1.0)), Fit::Empty);
    assert_eq!(fit.at_center(&data.cloud(), [2; 2], |_| Value(3.0)), Fit::Constant(Value(3.0)));
}

/// Own points to the right, neighbours nearly above and below the centre: a line through them falls
/// below zero where the own points are heavy.
const LINED_UP: [[f64; 2]; 4] = [[0.42, 0.0], [0.45, 0.02], [0.1, 0.62], [0.12, -0.6]];

fn positivity(theta: Option<f64>) -> Limiters<f64> {
    Limiters { positivity: theta, ..Limiters::default() }
}

fn own_weight(data: &CloudData<f64, 2>, point: usize) -> f64 {
    let offset = data.offset(point, [2.5; 2]);
    f64::from(u8::from(offset.iter().all(|x| x.abs() <= 0.5)))
}

#[test]
fn limiter_lifts_a_negative_own_weight_to_its_share_of_shepard() {
    let data = CloudData::<f64, 2>::new(&scene_of(&LINED_UP));
    let own = |point: usize| Value(own_weight(&data, point));
    let shepard = shepard(&data, 1.0, |point| own_weight(&data, point));
    let free = MovingLeastSquares::<Linear, f64>::new(1.0);
    let Fit::Regular(Value(negative)) = free.at_center(&data.cloud(), [2; 2], own) else {
        panic!("not regular");
    };
    assert!(negative < -0.1 && shepard > 0.1, "{negative} {shepard}");
    for theta in [0.0, 0.1, 0.5, 0.9] {
        let limited = MovingLeastSquares { limiters: positivity(Some(theta)), ..free };
        let Fit::Limited(Value(found)) = limited.at_center(&data.cloud(), [2; 2], own) else {
            panic!("not limited");
        };
        near("own weight", found, theta * shepard, 1e-14).unwrap();
        let constant = limited.at_center(&data.cloud(), [2; 2], |_| Value(1.0));
        near("constant", constant.value().unwrap().0, 1.0, 1e-14).unwrap();
    }
}

#[test]
fn limiter_leaves_positive_weights_alone() {
    let data = cloud::<f64, 2>((5, true), 2);
    let free = MovingLeastSquares::<Linear, f64>::new(1.5);
    let limited = MovingLeastSquares { limiters: positivity(Some(0.01)), ..free };
    let mut random = Random(1);
    let values: Vec<_> = (0..data.particles.len()).map(|_| random.signed()).collect();
    for &cell in &data.cells.index {
        let cell = data.grid.cell_coordinates(cell);
        let fit =
            |r: &MovingLeastSquares<_, _>| r.at_center(&data.cloud(), cell, |p| Value(values[p]));
        assert_eq!(fit(&free), fit(&limited));
    }
}

#[test]
fn limiter_is_off_by_default() {
    assert_eq!(MovingLeastSquares::<Linear, f64>::new(1.0).limiters, positivity(None));
    assert_eq!(Settings::default().positivity, None);
}

/// One phase with Gauss points: what the counters say about fallbacks and limits.
fn events(offsets: &[[f64; 2]], limiters: Limiters<f64>) -> [u64; 4] {
    let reconstruction =
        MovingLeastSquares { limiters, ..MovingLeastSquares::<Linear, f64>::new(1.0) };
    let method = scheme(shape::Linear, reconstruction, Gauss, transfer::Pic);
    let mut solver = solver::<f64, 2, _>(&scene_of(offsets), method);
    scatter(&mut solver, 0.0);
    let c = solver.counters;
    [c.n_reconstructions, c.n_singular_fallbacks, c.n_positivity_limited, c.n_leverage_limited]
}

#[test]
fn fallbacks_are_counted() {
    // One cell and its four nodes see one point.
    assert_eq!(events(&[[0.1, 0.2]], positivity(None)), [5, 5, 0, 0]);
}

#[test]
fn limited_fits_are_counted() {
    let [fits, singular, limited, tempered] = events(&LINED_UP, positivity(None));
    assert_eq!([limited, tempered], [0, 0]);
    let [same_fits, same_singular, limited, _] = events(&LINED_UP, positivity(Some(0.1)));
    assert_eq!([same_fits, same_singular], [fits, singular]);
    assert!((1..=fits - singular).contains(&limited), "{limited} of {fits}");
}

/// Σ Φ² / φ · Σ φ − 1 of a fit at the centre of cell 2, from its answers to unit values.
fn leverage(data: &CloudData<f64, 2>, fit: &MovingLeastSquares<Linear, f64>) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for point in 0..data.particles.len() {
        let unit = |other: usize| Value(f64::from(u8::from(other == point)));
        let shape = fit.at_center(&data.cloud(), [2; 2], unit).value().unwrap().0;
        let phi: f64 =
            data.offset(point, [2.5; 2]).map(|x| weight(x / fit.support)).iter().product();
        if phi > 0.0 {
            sum += shape * shape / phi;
            total += phi;
        }
    }
    sum * total - 1.0
}

/// Points nearly on a line beside the centre: a fit must extrapolate from their scatter.
const BESIDE: [[f64; 2]; 4] = [[0.40, -0.4], [0.42, -0.1], [0.41, 0.15], [0.40, 0.45]];

#[test]
fn leverage_is_limited_to_its_bound() {
    let data = CloudData::<f64, 2>::new(&scene_of(&BESIDE));
    let free = MovingLeastSquares::<Linear, f64>::new(1.0);
    let unlimited = leverage(&data, &free);
    assert!(unlimited > 1000.0, "{unlimited}");
    for most in [0.5, 4.0, 16.0, 100.0] {
        let limiters = Limiters { leverage: Some(most), positivity: None };
        let limited = MovingLeastSquares { limiters, ..free };
        near("leverage", leverage(&data, &limited), most, 1e-9 * most).unwrap();
        let one = limited.at_center(&data.cloud(), [2; 2], |_| Value(1.0));
        let Fit::Tempered(Value(one)) = one else { panic!("{one:?}") };
        near("constant", one, 1.0, 1e-12).unwrap();
    }
    let limiters = Limiters { leverage: Some(1.01 * unlimited), positivity: None };
    let slack = MovingLeastSquares { limiters, ..free };
    assert!(matches!(slack.at_center(&data.cloud(), [2; 2], |_| Value(1.0)), Fit::Regular(_)));
}

#[test]
fn tempered_fits_are_counted() {
    let limiters = Limiters { leverage: Some(4.0), positivity: None };
    let [fits, singular, limited, tempered] = events(&BESIDE, limiters);
    assert_eq!(limited, 0);
    assert!((1..=fits - singular).contains(&tempered), "{tempered} of {fits}");
}

#[test]
fn carried_mean_weighs_by_volume() {
    let mut scene = scene_of(&[[0.1, 0.2], [-0.3, 0.4], [0.6, 0.0]]);
    for (point, (mass, density)) in
        scene.points.iter_mut().zip([(2.0, 4.0), (3.0, 2.0), (9.0, 1.0)])
    {
        (point.mass, point.density) = (mass, density);
    }
    let data = CloudData::<f64, 2>::new(&scene);
    // Volumes 0.5 and 1.5; the third point is in another cell.
    let value = |point: usize| Value([8.0, 16.0, 1e9][data.particles.id[point] as usize]);
    assert_eq!(Carried.at_center(&data.cloud(), [2; 2], value), Fit::Regular(Value(14.0)));
    assert_eq!(Carried.at_node(&data.cloud(), [2.5; 2], value), Fit::Empty);
}
