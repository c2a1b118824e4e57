//! Shape functions of other methods against independent evaluations, and the names and refusals of variants.

use std::collections::BTreeSet;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::shape::{
    AxisPosition, Bare, ConvectedGimp, Corrected, DualDomain, LeastSquares, QuadraticBspline, Row,
    ShapeFunction, Staggered,
};
use transpoint::variants::{Projection, ProjectionKind};
use transpoint::{Scene, Settings, Variant};

/// Sums of a few terms of order one.
const BOUND: f64 = 8.0 * f64::EPSILON;
const SAMPLES: usize = 32;

fn samples() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64)
}

fn inner(xi: f64) -> AxisPosition<f64> {
    AxisPosition { cell: 3, xi, n_cells: 8, periodic: false }
}

/// Value and gradient of each of the nodes 2 to 5 of the vertices, which a row of cell 3 touches.
fn by_vertex<S: ShapeFunction<f64>>(shape: &S, row: &Row<f64>) -> [[f64; 2]; 4] {
    let mut found = [[0.0; 2]; 4];
    for k in 0..S::WIDTH {
        let node: f64 = shape.node_coordinate(3 + row.first + k, 8, false);
        found[node as usize - 2] = [row.weight[k], row.gradient[k]];
    }
    found
}

fn hat(x: f64) -> f64 {
    (1.0 - x.abs()).max(0.0)
}

#[track_caller]
fn assert_close(found: f64, exact: f64, bound: f64) {
    assert!((found - exact).abs() <= bound, "{found:e} is not {exact:e}");
}

/// Points to cell centers by hats, then each center to its two vertices; gradients of the vertices' hats at the
/// centers.
#[test]
fn staggered_functions_go_by_way_of_the_centers() {
    for xi in samples() {
        let x = 3.0 + xi;
        let found = by_vertex(&Staggered, &Staggered.row(inner(xi)));
        for (vertex, [value, gradient]) in (2..6).zip(found) {
            let (mut exact, mut slope) = (0.0, 0.0);
            for center in 1..6 {
                let share = hat(x - (f64::from(center) + 0.5));
                let is_end = [center, center + 1].contains(&vertex);
                exact += if is_end { 0.5 * share } else { 0.0 };
                slope += share
                    * f64::from(i32::from(vertex == center + 1) - i32::from(vertex == center));
            }
            assert_close(value, exact, BOUND);
            assert_close(gradient, slope, BOUND);
        }
    }
}

/// Mean of the slope of hat `i`, weighted by hat `node`, over the cells next to `node` that are `full`; by the
/// midpoint rule, which is exact for what is linear in each part.
fn mean_slope(node: i32, i: i32, full: impl Fn(i32) -> bool) -> f64 {
    let (mut sum, mut volume) = (0.0, 0.0);
    for cell in [node - 1, node].into_iter().filter(|&cell| full(cell)) {
        for part in 0..16 {
            let x = f64::from(cell) + (f64::from(part) + 0.5) / 16.0;
            let weight = hat(x - f64::from(node));
            let slope = f64::from(i32::from(i == cell + 1) - i32::from(i == cell));
            sum += weight * slope;
            volume += weight;
        }
    }
    sum / volume
}

#[test]
fn dual_domain_gradients_blend_the_hat_with_means_about_the_nodes() {
    for (bare, xi) in BARE.into_iter().flat_map(|bare| samples().map(move |xi| (bare, xi))) {
        let shape = ShapeFunction::<f64>::beside(&DualDomain::default(), Bare([bare; 3]));
        let full = |cell: i32| !(bare[0] && cell < 3 || bare[1] && cell > 3);
        let found = by_vertex(&shape, &shape.row_along(0, inner(xi)));
        let alpha = 2.0 * xi * (1.0 - xi);
        for (vertex, [value, gradient]) in (2..6).zip(found) {
            assert_close(value, hat(3.0 + xi - f64::from(vertex)), BOUND);
            let own = f64::from(i32::from(vertex == 4) - i32::from(vertex == 3));
            let means = [(3, 1.0 - xi), (4, xi)]
                .map(|(node, weight)| weight * mean_slope(node, vertex, full));
            let exact = alpha * own + (1.0 - alpha) * (means[0] + means[1]);
            assert_close(gradient, exact, BOUND);
        }
    }
}

const BARE: [[bool; 2]; 4] = [[false, false], [true, false], [false, true], [true, true]];

/// Quadratic B-spline about a vertex.
fn spline(x: f64) -> f64 {
    match x.abs() {
        a if a < 0.5 => 0.75 - a * a,
        a if a < 1.5 => 0.5 * (1.5 - a).powi(2),
        _ => 0.0,
    }
}

/// N P(x_i − x)ᵀ M⁻¹ P(0) over some nodes, P = (1, x), by Cramer's rule.
fn corrected(x: f64, nodes: &[i32]) -> Vec<f64> {
    let terms = nodes.iter().map(|&node| (spline(x - f64::from(node)), f64::from(node) - x));
    let moment = |power: i32| terms.clone().map(|(n, y)| n * y.powi(power)).sum::<f64>();
    let (zeroth, first, second) = (moment(0), moment(1), moment(2));
    let determinant = zeroth * second - first * first;
    terms.clone().map(|(n, y)| n * (second - first * y) / determinant).collect()
}

/// Beside an empty cell the node beyond it is left out of the half cell next to it. The determinant is at least
/// N₃ N₄ > 0.05, so that round-off grows by no more than 20.
#[test]
fn corrected_functions_are_weighted_least_squares_over_the_remaining_nodes() {
    for (bare, xi) in BARE.into_iter().flat_map(|bare| samples().map(move |xi| (bare, xi))) {
        let shape = ShapeFunction::<f64>::beside(&Corrected::default(), Bare([bare; 3]));
        let found = by_vertex(&shape, &shape.row_along(0, inner(xi)));
        let lower = xi < 0.5;
        let nodes = if lower { [2, 3, 4] } else { [3, 4, 5] };
        let dropped = if lower { bare[0].then_some(2) } else { bare[1].then_some(5) };
        let nodes: Vec<i32> = nodes.into_iter().filter(|&node| Some(node) != dropped).collect();
        let exact = corrected(3.0 + xi, &nodes);
        for (vertex, [value, gradient]) in (2..6).zip(found) {
            let at = nodes.iter().position(|&node| node == vertex);
            assert_close(value, at.map_or(0.0, |k| exact[k]), 20.0 * BOUND);
            // Both are at most quadratic in the half cell: central differences there are exact.
            let step = 1.0 / 64.0;
            let middle = xi.clamp(step, 1.0 - step);
            if (middle - 0.5).abs() >= step && middle == xi {
                let [a, b] = [xi - step, xi + step].map(|xi| corrected(3.0 + xi, &nodes));
                let slope = at.map_or(0.0, |k| (b[k] - a[k]) / (2.0 * step));
                assert_close(gradient, slope, 20.0 * BOUND / step);
            }
        }
    }
}

#[test]
fn longest_boxes_and_corrected_functions_inside_are_the_quadratic_bspline() {
    for xi in samples() {
        let long = ConvectedGimp::default().stretched([1.0, 0.25, 0.0625]);
        let rows = [
            by_vertex(&long, &long.row_along(0, inner(xi))),
            by_vertex(&Corrected::default(), &Corrected::default().row(inner(xi))),
        ];
        for found in rows {
            for (vertex, [value, gradient]) in (2..6).zip(found) {
                let x = 3.0 + xi - f64::from(vertex);
                assert_close(value, spline(x), BOUND);
                let slope = if x.abs() < 0.5 { -2.0 * x } else { -(1.5 - x.abs()) * x.signum() };
                let slope = if x.abs() < 1.5 { slope } else { 0.0 };
                assert_close(gradient, slope, BOUND);
            }
        }
    }
}

/// G = 4 N (x_i − x) is the derivative in the middle and on the faces; at ξ = ¼ and ¾ it is off by 3/32, 6/32, 3/32.
#[test]
fn least_squares_gradient_is_the_derivative_at_three_places_only() {
    let gradients = |xi: f64| {
        let row = LeastSquares(QuadraticBspline).row(inner(xi));
        let slope = QuadraticBspline.row(inner(xi)).gradient;
        assert_eq!(row.weight, QuadraticBspline.row(inner(xi)).weight);
        std::array::from_fn::<f64, 3, _>(|k| row.gradient[k] - slope[k])
    };
    let places = [(0.0, 0.0), (0.25, 1.0), (0.5, 0.0), (0.75, -1.0), (1.0, 0.0)];
    for (xi, sign) in places {
        let exact = [-3.0, 6.0, -3.0].map(|part| sign * part / 32.0);
        for (found, exact) in gradients(xi).into_iter().zip(exact) {
            assert_close(found, exact, BOUND);
        }
    }
    for xi in samples() {
        let row = LeastSquares(QuadraticBspline).row(inner(xi));
        for k in 0..3 {
            let offset = k as f64 - 0.5 - xi;
            assert_close(row.gradient[k], 4.0 * row.weight[k] * offset, BOUND);
        }
    }
}

/// Σ G v = 3 for v = 2 + 3 x, also next to walls, where D is small: bounds of the samples off the wall, D ≥ 1/70.
#[test]
fn least_squares_gradient_of_a_linear_velocity_is_exact() {
    let shape = LeastSquares(QuadraticBspline);
    for (n_cells, xi) in (1..=4).flat_map(|n| samples().map(move |xi| (n, xi))) {
        for cell in 0..n_cells {
            if (cell == 0 && xi == 0.0) || (cell + 1 == n_cells && xi == 1.0) {
                continue;
            }
            let row = shape.row(AxisPosition { cell, xi, n_cells, periodic: false });
            let velocity = |k: usize| {
                let node: f64 = shape.node_coordinate(cell + k, n_cells, false);
                2.0 + 3.0 * node
            };
            let gradient: f64 = (0..3).map(|k| row.gradient[k] * velocity(k)).sum();
            assert_close(gradient, 3.0, 70.0 * 14.0 * f64::EPSILON);
        }
    }
}

/// A position is split into cell and coordinate so that nothing is lost far from the origin.
#[test]
fn least_squares_gradient_loses_nothing_far_from_the_origin() {
    let shape = LeastSquares(QuadraticBspline);
    for xi in samples().map(|xi| 0.999 * xi as f32 + 0.0003) {
        let row = |cell| shape.row(AxisPosition { cell, xi, n_cells: 100_000, periodic: false });
        assert_eq!(row(50_000), row(3));
    }
}

fn scene() -> Scene<2> {
    let law = EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 };
    let grid = GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [4; 2] };
    let points = vec![PointSpec::new([1.5; 2], [0.0; 2], 1.0, 1.0)];
    Scene::new(grid, [[Boundary::Slip; 2]; 2], law, points)
}

/// Field and what is allowed, of the error of a variant with some settings.
fn refusal(variant: Variant, settings: &Settings) -> (String, String) {
    let built = variant.build_2d(&scene(), settings);
    let Err(error) = built else { panic!("{} takes it", variant.name()) };
    (error.field, error.allowed)
}

fn projection(order: u32, interval: u32) -> Settings {
    let kind = ProjectionKind::All;
    Settings { projection: Some(Projection { kind, order, interval }), ..Settings::default() }
}

#[test]
fn smoothing_that_a_method_cannot_honor_is_refused() {
    let dilation = Settings { dilation: Some(0.5), ..Settings::default() };
    let diffusion = Settings { density_diffusion: Some(0.1), ..Settings::default() };
    let cases = [
        (Variant::Apic, projection(2, 1), "projection", "without affine transfer"),
        (Variant::Tpic, projection(2, 1), "projection", "without affine transfer"),
        (Variant::TpmVpQuadratic, dilation, "dilation", "carried values"),
        (Variant::Tpm, dilation, "dilation", "carried values"),
        (Variant::MpmVp, dilation, "dilation", "carried values"),
        (Variant::SulskyGong, dilation, "dilation", "carried values"),
        (Variant::Mpm, diffusion, "density_diffusion", "velocity-pressure formulation"),
        (Variant::Tpm, diffusion, "density_diffusion", "velocity-pressure formulation"),
    ];
    for (variant, settings, name, allowed) in cases {
        let (field, found) = refusal(variant, &settings);
        assert_eq!(field, format!("settings.{name}"), "{}", variant.name());
        assert!(found.contains(allowed), "{found}");
    }
    assert!(Variant::Mpm.build_2d(&scene(), &dilation).is_ok());
    assert!(Variant::MpmVp.build_2d(&scene(), &diffusion).is_ok());
}

#[test]
fn numbers_of_a_projection_have_a_range() {
    for (order, interval, field, allowed) in [
        (0, 1, "settings.projection.order", "1 to 20 terms"),
        (21, 1, "settings.projection.order", "1 to 20 terms"),
        (2, 0, "settings.projection.interval", "at least 1 step"),
    ] {
        let found = refusal(Variant::Mpm, &projection(order, interval));
        assert_eq!(found, (field.into(), allowed.into()));
    }
    for (order, interval) in [(1, 1), (20, 1000)] {
        assert!(Variant::Mpm.build_2d(&scene(), &projection(order, interval)).is_ok());
    }
}

#[test]
fn every_variant_is_found_by_its_own_name() {
    let names: BTreeSet<_> = Variant::ALL.iter().map(|variant| variant.name()).collect();
    assert_eq!(names.len(), Variant::ALL.len());
    for variant in Variant::ALL {
        assert_eq!(Variant::parse(variant.name()), Ok(variant));
    }
    assert_eq!(Variant::CORE[..], Variant::ALL[..Variant::CORE.len()]);
    let error = Variant::parse("mpm3").unwrap_err();
    assert_eq!((error.field.as_str(), error.value.as_str()), ("variant", "mpm3"));
    assert!(names.iter().all(|name| error.allowed.contains(name)), "{}", error.allowed);
}
