//! Nodes → nodes: Newton's second law and the boundary conditions.

use super::NODE_GRAIN;
use crate::Scalar;
use crate::nodes::WallNode;
use crate::parallel::for_each_block;
use crate::scene::Boundary;

/// Advances the nodes, Eq. (10) of \[Song2020\]: `increment = Δt (f/m + b)`, `velocity += increment`.
///
/// `force` holds the mass in its last entry; nodes without mass keep their velocity.
pub fn update_grid<T: Scalar, const D: usize>(
    dt: T,
    body_force: [T; D],
    force: &[[T; 4]],
    (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]]),
) {
    let work = |nodes: std::ops::Range<usize>,
                (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]])| {
        for ((force, v), dv) in force[nodes].iter().zip(velocity).zip(increment) {
            *dv = [T::zero(); 4];
            if force[3] > T::zero() {
                let scale = dt / force[3];
                for axis in 0..D {
                    dv[axis] = scale * force[axis] + dt * body_force[axis];
                    v[axis] += dv[axis];
                }
            }
        }
    };
    for_each_block(force.len(), NODE_GRAIN, (velocity, increment), &work);
}

/// Imposes the velocity of each face on the nodes of that face, and takes away its change.
///
/// Faces are worked on in order of axes, so that the last axis decides on edges and corners.
pub fn constrain<T: Scalar, const D: usize>(
    walls: &[WallNode],
    boundaries: &[[Boundary; 2]; D],
    velocity: &mut [[T; 4]],
    mut increment: Option<&mut [[T; 4]]>,
) {
    for wall in walls {
        let (slot, normal) = (wall.slot as usize, wall.axis as usize);
        let prescribed = |axis: usize| match boundaries[normal][wall.side as usize] {
            Boundary::Slip => (axis == normal).then(T::zero),
            Boundary::NoSlip => Some(T::zero()),
            Boundary::Velocity(v) => Some(T::lit(v[axis])),
            Boundary::Periodic | Boundary::Free => None,
        };
        for axis in 0..D {
            if let Some(value) = prescribed(axis) {
                velocity[slot][axis] = value;
                if let Some(increment) = increment.as_deref_mut() {
                    increment[slot][axis] = T::zero();
                }
            }
        }
    }
}
