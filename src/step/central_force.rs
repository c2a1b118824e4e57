//! Nodes → nodes: the force towards a point.

use super::NODE_GRAIN;
use crate::Scalar;
use crate::grid::Grid;
use crate::parallel::for_each_block;
use crate::scene::CentralForce;
use crate::shape::ShapeFunction;

/// The acceleration b = −Ω² (x − x_c).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Central<T, const D: usize> {
    /// x_c, m.
    pub center: [T; D],
    /// Ω², 1/s².
    pub rate_squared: T,
}

impl<T: Scalar, const D: usize> Central<T, D> {
    /// That of a scene.
    pub fn new(force: &CentralForce<D>) -> Self {
        Self { center: force.center.map(T::lit), rate_squared: T::lit(force.rate * force.rate) }
    }

    /// b at a position, m/s².
    pub fn acceleration(&self, position: [T; D]) -> [T; D] {
        std::array::from_fn(|axis| self.rate_squared * (self.center[axis] - position[axis]))
    }

    /// ½ Ω² |x − x_c|² of a position, J/kg.
    pub fn potential(&self, position: [T; D]) -> T {
        let square = (0..D)
            .map(|axis| position[axis] - self.center[axis])
            .fold(T::zero(), |sum, distance| sum + distance * distance);
        T::lit(0.5) * self.rate_squared * square
    }
}

/// Adds Δt b of each node with mass to velocity and increment, after
/// [`update_grid`](super::update_grid); `masses` are the last entries.
pub fn add_central_force<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    dt: T,
    force: &Central<T, D>,
    (grid, shape): (&Grid<T, D>, &S),
    masses: &[[T; 4]],
    (index, velocity, increment): (&[u32], &mut [[T; 4]], &mut [[T; 4]]),
) {
    let work = |nodes: std::ops::Range<usize>,
                (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]])| {
        let rows = index[nodes.clone()].iter().zip(&masses[nodes]);
        for ((&node, mass), (v, dv)) in rows.zip(velocity.iter_mut().zip(increment)) {
            if mass[3] > T::zero() {
                let acceleration = force.acceleration(node_position(grid, shape, node));
                for axis in 0..D {
                    dv[axis] += dt * acceleration[axis];
                    v[axis] += dt * acceleration[axis];
                }
                v[3] = v[D - 1];
            }
        }
    };
    for_each_block(velocity.len(), NODE_GRAIN, (velocity, increment), &work);
}

/// Where a node is, m.
fn node_position<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    grid: &Grid<T, D>,
    shape: &S,
    node: u32,
) -> [T; D] {
    let at = grid.node_coordinates(node);
    std::array::from_fn(|axis| {
        let place = shape.node_coordinate(at[axis], grid.n_cells[axis], grid.periodic[axis]);
        grid.origin[axis] + grid.spacing[axis] * place
    })
}
