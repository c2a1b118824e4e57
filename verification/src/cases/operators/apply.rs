//! The operators under study, each applied by the library's own code to a field.

use transpoint::basis::{Constant, Fit, Linear as LinearBasis, PolynomialBasis, Quadratic};
use transpoint::formulation::{Formulation, PointDivergence};
use transpoint::material::Inviscid;
use transpoint::math::Value;
use transpoint::method::Scheme;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::{Carried, MovingLeastSquares, Reconstruction};
use transpoint::scene::{EquationOfStateSpec, PointSpec};
use transpoint::shape::{CubicBspline, Gimp, Linear, QuadraticBspline, ShapeFunction};
use transpoint::stencil::{Rows, rows_at, rows_at_center};
use transpoint::transfer::{Apic, Pic, Transfer};
use transpoint::variants::StressUpdate;
use transpoint::{Scene, Solver};

use super::cloud::{BOUNDARIES, Region, Sorted, grid, grid_spec};
use super::{Field, Sample};

/// Length of a uGIMP particle, cells.
const GIMP: Gimp<f64> = Gimp { length: 0.5 };

/// Samples of the operator with that name, or `None` if there is no such operator.
pub(super) fn apply(
    name: &str,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Option<Vec<Sample>> {
    let mls = |support| MovingLeastSquares::<LinearBasis, f64>::new(support);
    let mls2 = |support| MovingLeastSquares::<Quadratic, f64>::new(support);
    Some(match name {
        "linear" => interpolate(Linear, n, positions, field),
        "gimp" => interpolate(GIMP, n, positions, field),
        "bspline2" => interpolate(QuadraticBspline, n, positions, field),
        "bspline3" => interpolate(CubicBspline, n, positions, field),
        "pic-linear" => transfer(Linear, Pic, n, positions, field),
        "pic-gimp" => transfer(GIMP, Pic, n, positions, field),
        "pic-bspline2" => transfer(QuadraticBspline, Pic, n, positions, field),
        "pic-bspline3" => transfer(CubicBspline, Pic, n, positions, field),
        "apic-linear" => transfer(Linear, Apic, n, positions, field),
        "apic-bspline2" => transfer(QuadraticBspline, Apic, n, positions, field),
        "apic-bspline3" => transfer(CubicBspline, Apic, n, positions, field),
        "carried" => reconstruct(Carried, n, positions, field),
        "shepard" => fitted::<Constant>(MovingLeastSquares::new(1.0), n, positions, field),
        "mls1-r1" => fitted(mls(1.0), n, positions, field),
        "mls1-r1.5" => fitted(mls(1.5), n, positions, field),
        "mls1-r2" => fitted(mls(2.0), n, positions, field),
        "mls2-r1.5" => fitted(mls2(1.5), n, positions, field),
        "mls2-r2" => fitted(mls2(2.0), n, positions, field),
        "div-constant" => divergence(PointDivergence::Constant, n, positions, field),
        "div-linear" => divergence(PointDivergence::Linear, n, positions, field),
        "div-quadratic" => divergence(PointDivergence::Quadratic, n, positions, field),
        "div-vertex-mean" => divergence(PointDivergence::VertexMean, n, positions, field),
        _ => return None,
    })
}

/// Sums over the nodes of a tensor-product stencil: visits `(node, weight, gradient)`.
fn for_each_node<S: ShapeFunction<f64>>(
    rows: &Rows<f64, 2>,
    cell: [usize; 2],
    mut visit: impl FnMut([usize; 2], f64, [f64; 2]),
) {
    let [x, y] = rows;
    for i in 0..S::WIDTH {
        for j in 0..S::WIDTH {
            let node = [cell[0] + x.first + i, cell[1] + y.first + j];
            let gradient = [x.gradient[i] * y.weight[j], x.weight[i] * y.gradient[j]];
            visit(node, x.weight[i] * y.weight[j], gradient);
        }
    }
}

/// Place of a node in the unit square.
fn node_place<S: ShapeFunction<f64>>(shape: &S, node: [usize; 2], n: usize) -> [f64; 2] {
    node.map(|index| shape.node_coordinate(index, n, false) / n as f64)
}

/// The field's values at the nodes as coefficients, evaluated at the points.
fn interpolate<S: ShapeFunction<f64>>(
    shape: S,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Vec<Sample> {
    let grid = grid(n, S::EXTRA);
    let mut samples = Vec::with_capacity(2 * positions.len());
    for &x in positions {
        let cell = grid.cell_coordinates(grid.cell_of(x).unwrap_or(0));
        let rows = rows_at(&shape, &grid, cell, x);
        let (mut value, mut slope) = (0.0, [0.0; 2]);
        for_each_node::<S>(&rows, cell, |node, weight, gradient| {
            let at_node = (field.value)(node_place(&shape, node, n));
            value += weight * at_node;
            slope = [slope[0] + gradient[0] * at_node, slope[1] + gradient[1] * at_node];
        });
        let region = Region::of(cell, n - 1);
        samples.push(Sample::scalar("value", region, value, (field.value)(x)));
        samples.push(Sample::vector("gradient", region, slope, (field.gradient)(x)));
    }
    samples
}

/// The field as velocity along x, from the points to the nodes and back: a step of no duration.
fn transfer<S, X>(
    shape: S,
    transfer: X,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Vec<Sample>
where
    S: ShapeFunction<f64> + 'static,
    X: Transfer<f64, 2>,
{
    let point = |&position: &[f64; 2]| PointSpec {
        velocity_gradient: [(field.gradient)(position), [0.0; 2]],
        ..PointSpec::new(
            position,
            [(field.value)(position), 0.0],
            1.0,
            1.0 / positions.len() as f64,
        )
    };
    let scene = Scene::new(
        grid_spec(n),
        BOUNDARIES,
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        positions.iter().map(point).collect(),
    );
    let scheme = Scheme {
        shape,
        reconstruction: Carried,
        quadrature: Particle,
        transfer,
        formulation: Formulation::Standard,
        stress_update: StressUpdate::Last,
    };
    let Ok(mut solver) = Solver::<f64, 2, _, _>::new(&scene, scheme, Inviscid) else {
        return Vec::new();
    };
    if solver.advance(0.0).is_err() {
        return Vec::new();
    }
    let points = &solver.particles;
    let found = points.position.iter().zip(&points.velocity).zip(&points.cell);
    found
        .map(|((&x, v), &cell)| {
            let region = Region::of(solver.grid.cell_coordinates(cell), n - 1);
            Sample::scalar("value", region, v[0], (field.value)(x))
        })
        .collect()
}

/// Moving least squares at the centres and at the nodes of the linear hat, and the one-point rule
/// for the gradient of the node values.
fn fitted<B: PolynomialBasis<f64, 2>>(
    reconstruction: MovingLeastSquares<B, f64>,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Vec<Sample> {
    let mut samples = reconstruct(reconstruction, n, positions, field);
    let sorted = Sorted::new(grid(n, 1), positions);
    let cloud = sorted.cloud();
    let values: Vec<f64> = sorted.particles.position.iter().map(|&x| (field.value)(x)).collect();
    let mut nodes = vec![f64::NAN; (n + 1) * (n + 1)];
    let mut singular = vec![false; nodes.len()];
    for (flat, found) in nodes.iter_mut().enumerate() {
        let node = [flat / (n + 1), flat % (n + 1)];
        let fit = reconstruction.at_node(&cloud, node.map(|i| i as f64), |p| Value(values[p]));
        let fell_back = !matches!(fit, Fit::Regular(_));
        *found = fit.value().map_or(f64::NAN, |Value(value)| value);
        let exact = (field.value)(node.map(|i| i as f64 / n as f64));
        let sample = Sample::scalar("node", Region::of(node, n), *found, exact);
        samples.push(Sample { fell_back, ..sample });
        singular[flat] = fell_back;
    }
    for flat in 0..n * n {
        let cell = [flat / n, flat % n];
        let (mut slope, mut fell_back) = ([0.0; 2], false);
        for_each_node::<Linear>(&rows_at_center(&Linear, &sorted.grid, cell), cell, |at, _, g| {
            let value = nodes[at[0] * (n + 1) + at[1]];
            fell_back |= singular[at[0] * (n + 1) + at[1]];
            slope = [slope[0] + g[0] * value, slope[1] + g[1] * value];
        });
        let exact = (field.gradient)(center(cell, n));
        let sample = Sample::vector("gradient", Region::of(cell, n - 1), slope, exact);
        samples.push(Sample { fell_back, ..sample });
    }
    samples
}

fn center(cell: [usize; 2], n: usize) -> [f64; 2] {
    cell.map(|c| (c as f64 + 0.5) / n as f64)
}

/// A reconstruction at the centres.
fn reconstruct<R: Reconstruction<f64, 2>>(
    reconstruction: R,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Vec<Sample> {
    let sorted = Sorted::new(grid(n, 1), positions);
    let cloud = sorted.cloud();
    let values: Vec<f64> = sorted.particles.position.iter().map(|&x| (field.value)(x)).collect();
    (0..n * n)
        .map(|flat| {
            let cell = [flat / n, flat % n];
            let fit = reconstruction.at_center(&cloud, cell, |p| Value(values[p]));
            let fell_back = !matches!(fit, Fit::Regular(_));
            let found = fit.value().map_or(f64::NAN, |Value(value)| value);
            let exact = (field.value)(center(cell, n));
            let sample = Sample::scalar("center", Region::of(cell, n - 1), found, exact);
            Sample { fell_back, ..sample }
        })
        .collect()
}

/// Cell divergences of the nodal interpolant of a velocity field, brought to the points.
///
/// Beyond a wall stands the cell before the wall.
fn divergence(
    kind: PointDivergence,
    n: usize,
    positions: &[[f64; 2]],
    field: &Field,
) -> Vec<Sample> {
    let grid = grid(n, 1);
    let mut of_cell = vec![0.0; n * n];
    for (flat, sum) in of_cell.iter_mut().enumerate() {
        let cell = [flat / n, flat % n];
        for_each_node::<Linear>(&rows_at_center(&Linear, &grid, cell), cell, |node, _, g| {
            let v = (field.velocity)(node_place(&Linear, node, n));
            *sum += g[0] * v[0] + g[1] * v[1];
        });
    }
    let sample = |&x: &[f64; 2]| {
        let cell = grid.cell_coordinates(grid.cell_of(x).unwrap_or(0));
        let weights: [[f64; 3]; 2] =
            std::array::from_fn(|axis| kind.weights(grid.axis_position(x, cell, axis).xi));
        let beside = |axis: usize, step: usize| (cell[axis] + step).clamp(1, n) - 1;
        let mut value = 0.0;
        for i in 0..3 {
            for j in 0..3 {
                let found = of_cell[beside(0, i) * n + beside(1, j)];
                value += weights[0][i] * weights[1][j] * found;
            }
        }
        Sample::scalar("divergence", Region::of(cell, n - 1), value, (field.divergence)(x))
    };
    positions.iter().map(sample).collect()
}
