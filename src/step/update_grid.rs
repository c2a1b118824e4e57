//! Nodes → nodes: Newton's second law and the boundary conditions.

use super::NODE_GRAIN;
use crate::Scalar;
use crate::cells::ABSENT;
use crate::math::{dot, narrow};
use crate::nodes::{HeldNode, WallNode};
use crate::parallel::for_each_block;
use crate::scene::Boundary;

/// What moves the nodes.
#[derive(Clone, Copy, Debug)]
pub enum NodeForces<'a, T> {
    /// Force and mass (last entry) of each node.
    Separate(&'a [[T; 4]]),
    /// Forces are in the velocity already; the last entries are masses.
    Fused(&'a [[T; 4]]),
}

/// Advances the nodes, Eq. (10) of \[Song2020\]: `increment = Δt (f/m + b)`, `velocity += increment`.
///
/// Nodes without mass keep their velocity. The last entry of a velocity row repeats its last component,
/// which the gather turns into a derivative.
pub fn update_grid<T: Scalar, const D: usize>(
    dt: T,
    body_force: [T; D],
    forces: NodeForces<'_, T>,
    (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]]),
) {
    let work = |nodes: std::ops::Range<usize>,
                (velocity, increment): (&mut [[T; 4]], &mut [[T; 4]])| {
        let (rows, separate) = match forces {
            NodeForces::Separate(rows) => (rows, true),
            NodeForces::Fused(rows) => (rows, false),
        };
        for ((row, v), dv) in rows[nodes].iter().zip(velocity).zip(increment) {
            *dv = [T::zero(); 4];
            if row[3] > T::zero() {
                let scale = if separate { dt / row[3] } else { T::zero() };
                for axis in 0..D {
                    let force = if separate { scale * row[axis] } else { T::zero() };
                    dv[axis] = force + dt * body_force[axis];
                    v[axis] += dv[axis];
                }
            }
            v[3] = v[D - 1];
        }
    };
    for_each_block(velocity.len(), NODE_GRAIN, (velocity, increment), &work);
}

/// Writes ½ |Δt a|² (J/kg) to the last entries, so that the gather sums it with the rest.
pub fn increment_energy<T: Scalar, const D: usize>(increment: &mut [[T; 4]]) {
    for row in increment {
        let square = (0..D).fold(T::zero(), |sum, axis| sum + row[axis] * row[axis]);
        row[3] = T::lit(0.5) * square;
    }
}

/// Imposes the velocity of each face on the nodes of that face, then that of outflows, inlets and bodies, and
/// takes away its change.
///
/// Faces are worked on in order of axes, so that the last axis decides on edges and corners. The nodes of an
/// outflow take velocity and change from the nodes next to them.
pub fn constrain<T: Scalar, const D: usize>(
    (walls, held): (&[WallNode], &[HeldNode<T>]),
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
            Boundary::Periodic | Boundary::Free | Boundary::Outflow { .. } => None,
        };
        for axis in 0..D {
            if let Some(value) = prescribed(axis) {
                velocity[slot][axis] = value;
                if let Some(increment) = increment.as_deref_mut() {
                    increment[slot][axis] = T::zero();
                }
            }
        }
        velocity[slot][3] = velocity[slot][D - 1];
    }
    let is_outflow = |wall: &&WallNode| {
        let face = boundaries[wall.axis as usize][wall.side as usize];
        matches!(face, Boundary::Outflow { .. }) && wall.inner != ABSENT
    };
    for wall in walls.iter().filter(is_outflow) {
        let (slot, inner) = (wall.slot as usize, wall.inner as usize);
        velocity[slot] = velocity[inner];
        if let Some(increment) = increment.as_deref_mut() {
            increment[slot] = increment[inner];
        }
    }
    for node in held {
        let slot = node.slot as usize;
        hold::<T, D>(&mut velocity[slot], node.velocity, node.normal);
        velocity[slot][3] = velocity[slot][D - 1];
        if let Some(increment) = increment.as_deref_mut() {
            hold::<T, D>(&mut increment[slot], [T::zero(); 4], node.normal);
        }
    }
}

/// Gives a vector the prescribed value, or its part along a unit vector.
fn hold<T: Scalar, const D: usize>(row: &mut [T; 4], value: [T; 4], normal: Option<[T; 4]>) {
    let missing: [T; D] = std::array::from_fn(|axis| value[axis] - row[axis]);
    let normal = normal.map(narrow::<T, D>);
    let along = normal.map(|normal| dot(missing, normal));
    for axis in 0..D {
        row[axis] = match (normal, along) {
            (Some(normal), Some(along)) => row[axis] + along * normal[axis],
            _ => value[axis],
        };
    }
}
