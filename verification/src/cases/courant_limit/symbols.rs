//! The functions and fits of the methods on a lattice.

use nalgebra::Complex;
use transpoint::shape::{
    AxisPosition, ConvectedGimp, Corrected, CubicBspline, DualDomain, Gimp, LeastSquares, Linear,
    QuadraticBspline, ShapeFunction, Staggered,
};
use transpoint::variants::Kernel;
use transpoint::{Settings, Variant};

type C = Complex<f64>;

/// Cell whose functions are evaluated, far from the ends of its axis.
pub(super) const MIDDLE: usize = 32;

/// What a fit at `target` (cells from a cell's lower end) takes of each point of a cell: the splines of all cells around,
/// over their sum.
pub(super) fn fit(n: usize, target: f64, support: f64, theta: f64) -> Vec<C> {
    let spline = |r: f64| (1.0 - r.abs()).max(0.0).powi(3) - 4.0 * (0.5 - r.abs()).max(0.0).powi(3);
    let reach = support.ceil() as i32 + 1;
    let mut weights = vec![C::ZERO; n];
    let mut total = 0.0;
    for cell in -reach..=reach {
        for (p, weight) in weights.iter_mut().enumerate() {
            let place = f64::from(cell) + (p as f64 + 0.5) / n as f64;
            let spline = spline((place - target) / support);
            *weight += C::from_polar(spline, theta * f64::from(cell));
            total += spline;
        }
    }
    weights.into_iter().map(|weight| weight / total).collect()
}

/// One function at a point.
pub(super) struct Function {
    /// Number of its node, and the node's place in cells.
    pub place: (usize, f64),
    /// N.
    pub weight: f64,
    /// dN/dx.
    pub gradient: f64,
}

/// The functions of a variant at a point of a cell.
pub(super) fn functions(variant: Variant, settings: &Settings, xi: f64) -> Vec<Function> {
    let at = AxisPosition { cell: MIDDLE, xi, n_cells: 2 * MIDDLE, periodic: true };
    let lengths = [settings.gimp_length; 3];
    match variant.parts().kernel {
        Kernel::Linear => at_nodes(&Linear, at),
        Kernel::Gimp => at_nodes(&Gimp { length: settings.gimp_length }, at),
        Kernel::ConvectedGimp => {
            at_nodes(&ShapeFunction::<f64>::stretched(&ConvectedGimp::default(), lengths), at)
        }
        Kernel::QuadraticBspline => at_nodes(&QuadraticBspline, at),
        Kernel::CubicBspline => at_nodes(&CubicBspline, at),
        Kernel::DualDomain => at_nodes(&DualDomain::default(), at),
        Kernel::Staggered => at_nodes(&Staggered, at),
        Kernel::Corrected => at_nodes(&Corrected::default(), at),
        Kernel::LeastSquares => at_nodes(&LeastSquares(QuadraticBspline), at),
    }
}

fn at_nodes<S: ShapeFunction<f64>>(shape: &S, at: AxisPosition<f64>) -> Vec<Function> {
    let row = shape.row(at);
    (0..S::WIDTH)
        .map(|k| {
            let node = at.cell + row.first + k;
            let place = shape.node_coordinate(node, at.n_cells, at.periodic);
            Function { place: (node, place), weight: row.weight[k], gradient: row.gradient[k] }
        })
        .collect()
}
