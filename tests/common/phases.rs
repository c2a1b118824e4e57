//! Calls of single phases, so that a change of their signatures is made here only.

use transpoint::material::{Inviscid, Material};
use transpoint::method::{Method, Scheme};
use transpoint::scene::Scene;
use transpoint::step::Pass;
use transpoint::variants::StressUpdate;
use transpoint::{Scalar, Solver, StepError, formulation::Formulation};

/// A method with the standard formulation and the stress updated last.
pub fn scheme<S, R, Q, X>(
    shape: S,
    reconstruction: R,
    quadrature: Q,
    transfer: X,
) -> Scheme<S, R, Q, X> {
    Scheme {
        shape,
        reconstruction,
        quadrature,
        transfer,
        formulation: Formulation::Standard,
        stress_update: StressUpdate::Last,
    }
}

/// A solver without viscosity.
pub fn solver<T: Scalar, const D: usize, M: Method<T, D>>(
    scene: &Scene<D>,
    method: M,
) -> Solver<T, D, M, Inviscid> {
    Solver::new(scene, method, Inviscid).unwrap()
}

/// Points → nodes.
pub fn scatter<T, const D: usize, M, K>(solver: &mut Solver<T, D, M, K>, dt: T)
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    solver.bin_particles();
    solver.particles_to_grid(dt);
}

/// Velocity and affine field only.
pub const VELOCITY: Pass = Pass { velocity: true, state: false, motion: false };
/// Density and stress only.
pub const STATE: Pass = Pass { velocity: false, state: true, motion: false };
/// Position and cell only.
pub const MOTION: Pass = Pass { velocity: false, state: false, motion: true };

/// Nodes → points, from `nodes.velocity` and `nodes.increment`.
pub fn gather<T, const D: usize, M, K>(
    solver: &mut Solver<T, D, M, K>,
    pass: Pass,
    dt: T,
) -> Result<(), StepError>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    solver.strain_from_nodes();
    solver.grid_to_particles(dt, pass)
}

/// A row of `nodes.velocity`: a vector, and its last component once more in the last entry.
pub fn velocity_row<const D: usize>(velocity: [f64; D]) -> [f64; 4] {
    let mut row = [0.0; 4];
    row[..D].copy_from_slice(&velocity);
    row[3] = velocity[D - 1];
    row
}

/// Slots of the nodes, each image of a periodic node once.
pub fn owned_nodes<T, const D: usize, M, K>(solver: &Solver<T, D, M, K>) -> Vec<usize>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let grid = &solver.grid;
    let owned = |node: u32| {
        let at = grid.node_coordinates(node);
        (0..D).all(|axis| !grid.periodic[axis] || at[axis] < grid.n_cells[axis])
    };
    (0..solver.nodes.len()).filter(|&slot| owned(solver.nodes.index[slot])).collect()
}

/// Σ over nodes of the rows, and of their absolute values; images count once.
pub fn node_sums<T, const D: usize, M, K>(
    solver: &Solver<T, D, M, K>,
    rows: &[[T; 4]],
) -> ([f64; 4], [f64; 4])
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let (mut sum, mut size) = ([0.0; 4], [0.0; 4]);
    for slot in owned_nodes(solver) {
        for k in 0..4 {
            let value = rows[slot][k].as_f64();
            sum[k] += value;
            size[k] += value.abs();
        }
    }
    (sum, size)
}
