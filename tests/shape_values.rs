//! Shape functions against published formulas and values, and against independent evaluations.

use transpoint::shape::{
    AxisPosition, CubicBspline, Gimp, Linear, QuadraticBspline, ShapeFunction,
};

const BOUND: f64 = 4.0 * f64::EPSILON;
const SAMPLES: usize = 32;

fn samples() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|k| k as f64 / SAMPLES as f64)
}

fn inner(xi: f64) -> AxisPosition<f64> {
    AxisPosition { cell: 3, xi, n_cells: 8, periodic: false }
}

#[track_caller]
fn assert_close(found: &[f64], exact: &[f64]) {
    for (found_value, exact_value) in found.iter().zip(exact) {
        assert!((found_value - exact_value).abs() <= BOUND, "{found:?} is not {exact:?}");
    }
}

/// Vertex-centered quadratic B-spline of \[Steffen2008\] and its derivative at `x`.
fn quadratic_about_node(x: f64) -> [f64; 2] {
    let a = x.abs();
    match a {
        _ if a < 0.5 => [0.75 - a * a, -2.0 * x],
        _ if a < 1.5 => [0.5 * (1.5 - a).powi(2), -(1.5 - a) * x.signum()],
        _ => [0.0, 0.0],
    }
}

/// uGIMP as published in three pieces, \[Bardenhagen2004\], and its derivative at `x`.
fn gimp_about_node(x: f64, l: f64) -> [f64; 2] {
    let a = x.abs();
    match a {
        _ if a < l / 2.0 => [1.0 - (4.0 * a * a + l * l) / (4.0 * l), -2.0 * x / l],
        _ if a <= 1.0 - l / 2.0 => [1.0 - a, -x.signum()],
        _ if a < 1.0 + l / 2.0 => {
            let overlap = 1.0 + l / 2.0 - a;
            [overlap * overlap / (2.0 * l), -overlap / l * x.signum()]
        }
        _ => [0.0, 0.0],
    }
}

/// B-spline `index` on `knots` at `x` in the span `[knots[span], knots[span + 1]]`, by recursion.
fn cox_de_boor(knots: &[f64], index: usize, degree: usize, span: usize, x: f64) -> f64 {
    if degree == 0 {
        return f64::from(index == span);
    }
    let part = |i: usize, rising: bool| {
        let width = knots[i + degree] - knots[i];
        let share = if rising { x - knots[i] } else { knots[i + degree] - x };
        if width == 0.0 {
            return 0.0;
        }
        share / width * cox_de_boor(knots, i, degree - 1, span, x)
    };
    part(index, true) + part(index + 1, false)
}

fn assert_is_open_bspline<S: ShapeFunction<f64>>(shape: S, degree: usize) {
    for n_cells in 1..=8 {
        let knots: Vec<f64> = (0..=n_cells + 2 * degree)
            .map(|k| k.saturating_sub(degree).min(n_cells) as f64)
            .collect();
        for (cell, xi) in (0..n_cells).flat_map(|cell| samples().map(move |xi| (cell, xi))) {
            let row = shape.row(AxisPosition { cell, xi, n_cells, periodic: false });
            let exact: Vec<f64> = (cell..=cell + degree)
                .map(|j| cox_de_boor(&knots, j, degree, cell + degree, cell as f64 + xi))
                .collect();
            assert_close(&row.weight, &exact);
        }
        for node in 0..n_cells + degree {
            let greville = knots[node + 1..=node + degree].iter().sum::<f64>() / degree as f64;
            assert_close(&[shape.node_coordinate(node, n_cells, false)], &[greville]);
        }
    }
}

#[test]
fn quadratic_is_the_open_knot_bspline() {
    assert_is_open_bspline(QuadraticBspline, 2);
}

#[test]
fn cubic_is_the_open_knot_bspline() {
    assert_is_open_bspline(CubicBspline, 3);
}

#[test]
fn bsplines_have_their_published_values() {
    let center = QuadraticBspline.row(inner(0.5));
    assert_eq!(center.weight, [0.125, 0.75, 0.125, 0.0]);
    let face = QuadraticBspline.row(inner(0.0));
    assert_eq!(face.weight, [0.5, 0.5, 0.0, 0.0]);
    let face = CubicBspline.row(inner(0.0));
    assert_close(&face.weight, &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0, 0.0]);
    assert_close(&face.gradient, &[-0.5, 0.0, 0.5, 0.0]);
    let center = CubicBspline.row(inner(0.5));
    assert_close(&center.weight, &[1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0]);
}

#[test]
fn quadratic_wall_functions_have_their_published_form() {
    for xi in samples() {
        let row = QuadraticBspline.row(AxisPosition { cell: 0, xi, n_cells: 8, periodic: false });
        let exact = [(1.0 - xi).powi(2), 2.0 * xi - 1.5 * xi * xi, 0.5 * xi * xi];
        assert_close(&row.weight, &exact);
        let next = QuadraticBspline.row(AxisPosition { cell: 1, xi, n_cells: 8, periodic: false });
        let x = 1.0 + xi;
        let exact = [0.5 * (2.0 - x).powi(2), -x * x + 3.0 * x - 1.5, 0.5 * xi * xi];
        assert_close(&next.weight, &exact);
    }
}

#[test]
fn periodic_bsplines_are_uniform_in_every_cell() {
    for xi in samples() {
        for (cell, n_cells) in [(0, 1), (0, 2), (1, 2), (0, 5), (4, 5)] {
            let at = AxisPosition { cell, xi, n_cells, periodic: true };
            assert_eq!(QuadraticBspline.row(at), QuadraticBspline.row(inner(xi)));
            assert_eq!(CubicBspline.row(at), CubicBspline.row(inner(xi)));
        }
    }
}

#[test]
fn gimp_is_the_published_convolution() {
    for (length, xi) in
        [0.1, 0.25, 0.5, 0.75, 1.0].into_iter().flat_map(|l| samples().map(move |xi| (l, xi)))
    {
        for (cell, n_cells, periodic) in [(3, 8, false), (0, 1, true), (0, 8, true), (7, 8, true)] {
            let shape = Gimp { length };
            let row = shape.row(AxisPosition { cell, xi, n_cells, periodic });
            for k in 0..3 {
                let node = shape.node_coordinate(cell + row.first + k, n_cells, periodic);
                let exact = gimp_about_node(cell as f64 + xi - node, length);
                assert_close(&[row.weight[k]], &exact[..1]);
                assert_close(&[row.gradient[k] * length], &[exact[1] * length]);
            }
        }
    }
}

#[test]
fn gimp_of_one_cell_is_the_quadratic_bspline() {
    let shape = Gimp { length: 1.0 };
    for xi in samples() {
        let row = shape.row(inner(xi));
        for k in 0..3 {
            let node: f64 = shape.node_coordinate(3 + row.first + k, 8, false);
            let exact = quadratic_about_node(3.0 + xi - node);
            assert_close(&[row.weight[k], row.gradient[k]], &exact);
        }
        // The same functions with their knots moved by half a cell onto the faces.
        let moved = if xi < 0.5 { xi + 0.5 } else { xi - 0.5 };
        let bspline = QuadraticBspline.row(inner(moved));
        assert_close(&row.weight, &bspline.weight);
        assert_close(&row.gradient, &bspline.gradient);
    }
}

#[test]
fn gimp_is_the_linear_hat_in_the_half_cell_at_a_wall() {
    for (length, xi) in [0.1, 0.5, 1.0].into_iter().flat_map(|l| samples().map(move |xi| (l, xi))) {
        for n_cells in 1..=3 {
            let cell = if xi < 0.5 { 0 } else { n_cells - 1 };
            let at = AxisPosition { cell, xi, n_cells, periodic: false };
            let (row, hat) = (Gimp { length }.row(at), Linear.row(at));
            let offset = 1 - row.first;
            assert_close(&row.weight[offset..offset + 2], &hat.weight[..2]);
            assert_close(&row.gradient[offset..offset + 2], &hat.gradient[..2]);
            assert_eq!(row.weight[2 * (1 - offset)], 0.0);
        }
    }
}

#[test]
fn gimp_at_a_wall_is_the_convolution_with_extrapolated_ghosts() {
    let length = 0.5;
    for xi in samples() {
        let row = Gimp { length }.row(AxisPosition { cell: 0, xi, n_cells: 4, periodic: false });
        let raw = |node: f64| gimp_about_node(xi - node, length)[0];
        let ghost = raw(-1.0);
        let exact = [raw(0.0) + 2.0 * ghost, raw(1.0) - ghost, raw(2.0)];
        for (node, value) in exact.into_iter().enumerate() {
            let found = (node + 1).checked_sub(row.first).filter(|&k| k < 3);
            assert_close(&[found.map_or(0.0, |k| row.weight[k])], &[value]);
        }
    }
}
