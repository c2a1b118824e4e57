//! Nodes → nodes: accelerations that depend on the place, towards a point or of a field.

use super::NODE_GRAIN;
use crate::Scalar;
use crate::grid::Grid;
use crate::parallel::for_each_block;
use crate::scene::{CentralForce, ForceField};
use crate::shape::ShapeFunction;

/// An acceleration that depends on the place.
pub trait LocalAcceleration<T, const D: usize>: Sync {
    /// b at a position, m/s².
    fn acceleration(&self, position: [T; D]) -> [T; D];
}

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

    /// ½ Ω² |x − x_c|² of a position, J/kg.
    pub fn potential(&self, position: [T; D]) -> T {
        let square = (0..D)
            .map(|axis| position[axis] - self.center[axis])
            .fold(T::zero(), |sum, distance| sum + distance * distance);
        T::lit(0.5) * self.rate_squared * square
    }
}

impl<T: Scalar, const D: usize> LocalAcceleration<T, D> for Central<T, D> {
    fn acceleration(&self, position: [T; D]) -> [T; D] {
        std::array::from_fn(|axis| self.rate_squared * (self.center[axis] - position[axis]))
    }
}

/// A field of force at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldAt<'a, const D: usize> {
    /// The field.
    pub field: &'a ForceField<D>,
    /// Time, s.
    pub time: f64,
}

impl<T: Scalar, const D: usize> LocalAcceleration<T, D> for FieldAt<'_, D> {
    fn acceleration(&self, position: [T; D]) -> [T; D] {
        self.field.at(position.map(T::as_f64), self.time).map(T::lit)
    }
}

/// Adds Δt b(x) of each node with mass to velocity and increment, after
/// [`update_grid`](super::update_grid); `masses` are the last entries.
pub fn add_acceleration<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    dt: T,
    local: &impl LocalAcceleration<T, D>,
    (grid, shape): (&Grid<T, D>, &S),
    masses: &[[T; 4]],
    (index, velocity, increment): (&[u32], &mut [[T; 4]], &mut [[T; 4]]),
) {
    let work = |nodes: std::ops::Range<usize>,
                (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]])| {
        let rows = index[nodes.clone()].iter().zip(&masses[nodes]);
        for ((&node, mass), (v, dv)) in rows.zip(velocity.iter_mut().zip(increment)) {
            if mass[3] > T::zero() {
                let acceleration = local.acceleration(node_position(grid, shape, node));
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
