//! Properties of the parts and of whole steps; real parts pass them, mutants must not.

use transpoint::Solver;
use transpoint::cells::{ABSENT, CellKind};
use transpoint::material::{Inviscid, Material};
use transpoint::method::Method;
use transpoint::quadrature::Quadrature;
use transpoint::scene::{Boundary, Scene};
use transpoint::shape::{AxisPosition, ShapeFunction};
use transpoint::simulation::Conserved;

use super::phases::{node_sums, owned_nodes, scatter, solver};
use super::scenes::{Block, DENSITY, SPACING};
use super::{Check, Precision, Random, near};

/// Σ N = 1, Σ N x_i = x, Σ dN = 0, Σ dN x_i = 1 at points of every cell, and N = 1 on the walls.
///
/// The bound is twice that of the identities in `shape_functions`.
pub fn shape_is_linear<S: ShapeFunction<f64>>(shape: &S) -> Check {
    let mut random = Random(3);
    for sample in 0..200 {
        let n_cells = 1 + sample % 8;
        let cell = (random.unit() * n_cells as f64) as usize;
        let xi = [0.0, 1.0, random.unit()][sample % 3];
        let at = AxisPosition { cell, xi, n_cells, periodic: false };
        let row = shape.row(at);
        let mut moments = [0.0; 4];
        for k in 0..S::WIDTH {
            let x = shape.node_coordinate(cell + row.first + k, n_cells, false) - cell as f64;
            moments[0] += row.weight[k];
            moments[1] += row.weight[k] * x;
            moments[2] += row.gradient[k];
            moments[3] += row.gradient[k] * x;
        }
        for (k, expected) in [1.0, xi, 0.0, 1.0].into_iter().enumerate() {
            near(&format!("moment {k} at {at:?}"), moments[k], expected, 20.0 * f64::EPSILON)?;
        }
        let on_wall = (cell == 0 && xi == 0.0) || (cell + 1 == n_cells && xi == 1.0);
        let largest = row.weight.into_iter().fold(0.0, f64::max);
        if on_wall && largest != 1.0 {
            return Err(format!("no function is one on the wall: {row:?}"));
        }
    }
    Ok(())
}

/// Weights of a point divergence: Σ w = 1 and Σ w x_c = x, with the cell's centre at ξ = ½.
pub fn point_divergence_is_linear(weights: impl Fn(f64) -> [f64; 3]) -> Check {
    for sample in 0..=16 {
        let xi = f64::from(sample) / 16.0;
        let [before, own, after] = weights(xi);
        near("Σ w", before + own + after, 1.0, 4.0 * f64::EPSILON)?;
        near("Σ w x", after - before, xi - 0.5, 4.0 * f64::EPSILON)?;
    }
    Ok(())
}

/// Compares totals; each quantity on its own scale of absolute sums.
fn same_totals<T, M, const D: usize>(
    solver: &Solver<T, D, M, Inviscid>,
    what: &str,
    (found, expected): (&Conserved<D>, &Conserved<D>),
    (angular, bound): (bool, f64),
) -> Check
where
    T: Precision,
    M: Method<T, D>,
{
    let p = &solver.particles;
    let bound = bound * T::UNIT;
    let mut scale = 0.0;
    let mut arm: f64 = 0.0;
    for k in 0..p.len() {
        for axis in 0..D {
            let affine = 2.0 * SPACING[axis] / SPACING[axis];
            scale += p.mass[k].as_f64() * (p.velocity[k][axis].as_f64().abs() + affine);
            arm = arm.max(p.position[k][axis].as_f64().abs());
        }
    }
    near(&format!("{what}: mass"), found.mass, expected.mass, bound * expected.mass)?;
    for axis in 0..D {
        let (a, b) = (found.momentum[axis], expected.momentum[axis]);
        near(&format!("{what}: momentum {axis}"), a, b, bound * scale)?;
    }
    for axis in (0..3).filter(|_| angular) {
        let (a, b) = (found.angular_momentum[axis], expected.angular_momentum[axis]);
        near(&format!("{what}: angular momentum {axis}"), a, b, bound * scale * arm)?;
    }
    Ok(())
}

/// Mass, momentum and, if `angular`, angular momentum: points → nodes → points without a force.
pub fn transfer_keeps_totals<T, M, const D: usize>(
    scene: &Scene<D>,
    method: M,
    limits: (bool, f64),
) -> Check
where
    T: Precision,
    M: Method<T, D>,
{
    let mut solver = solver::<T, D, M>(scene, method);
    let points = solver.particle_totals();
    scatter(&mut solver, T::zero());
    same_totals(&solver, "nodes", (&solver.node_totals(), &points), limits)?;
    solver.advance(T::zero()).map_err(|e| e.to_string())?;
    same_totals(&solver, "points", (&solver.particle_totals(), &points), limits)
}

/// Mass, momentum and, if `angular`, angular momentum over whole steps under internal forces.
pub fn steps_keep_totals<T, M, const D: usize>(
    scene: &Scene<D>,
    method: M,
    (n_steps, dt): (usize, f64),
    limits: (bool, f64),
) -> Check
where
    T: Precision,
    M: Method<T, D>,
{
    let mut solver = solver::<T, D, M>(scene, method);
    let start = solver.particle_totals();
    for _ in 0..n_steps {
        solver.advance(T::lit(dt)).map_err(|e| e.to_string())?;
    }
    if solver.particles.velocity.iter().flatten().all(|v| *v == T::zero()) {
        return Err("nothing moves".into());
    }
    same_totals(&solver, "after the steps", (&solver.particle_totals(), &start), limits)
}

/// Without a force FLIP leaves every point's velocity as it is.
pub fn velocities_stay_without_force<M: Method<f64, 2>>(scene: &Scene<2>, method: M) -> Check {
    let mut solver = solver::<f64, 2, M>(scene, method);
    let before = solver.particles.velocity.clone();
    solver.advance(0.0).map_err(|e| e.to_string())?;
    for (v, old) in solver.particles.velocity.iter().zip(&before) {
        near("velocity", v[0], old[0], 0.0)?;
        near("velocity", v[1], old[1], 0.0)?;
    }
    Ok(())
}

/// v = a + G x, given with its gradient to every point, comes back from the nodes as it was.
pub fn affine_field_survives<M: Method<f64, 2>>(mut scene: Scene<2>, method: M) -> Check {
    let gradient = [[0.3, -0.7], [1.1, 0.4]];
    let field = |x: [f64; 2]| gradient.map(|g| 0.5 + g[0] * x[0] + g[1] * x[1]);
    for point in &mut scene.points {
        point.velocity = field(point.position);
        point.velocity_gradient = gradient;
    }
    let mut solver = solver::<f64, 2, M>(&scene, method);
    for _ in 0..3 {
        solver.advance(0.0).map_err(|e| e.to_string())?;
    }
    for (x, v) in solver.particles.position.iter().zip(&solver.particles.velocity) {
        for axis in 0..2 {
            near("velocity", v[axis], field(*x)[axis], 100.0 * f64::EPSILON)?;
        }
    }
    Ok(())
}

/// Σ of the nodes' quadrature mass = Σ m_p.
pub fn nodes_hold_the_mass<M: Method<f64, 2>>(scene: &Scene<2>, method: M) -> Check {
    let mut solver = solver::<f64, 2, M>(scene, method);
    scatter(&mut solver, 0.0);
    let expected: f64 = scene.points.iter().map(|point| point.mass).sum();
    let (sum, _) = node_sums(&solver, &solver.nodes.force);
    near("Σ m_I", sum[3], expected, 1e-13 * expected)
}

/// Internal forces cancel, relative to the sum of their sizes: Σ_I f_I = 0.
pub fn internal_forces_cancel<T, M, K, const D: usize>(
    solver: &mut Solver<T, D, M, K>,
    bound: f64,
) -> Check
where
    T: Precision,
    M: Method<T, D>,
    K: Material<T, D>,
{
    scatter(solver, T::zero());
    let (sum, size) = node_sums(solver, &solver.nodes.force);
    for axis in 0..D {
        if !(size[axis] > 0.0) {
            return Err("no force at all".into());
        }
        near(&format!("Σ f_{axis}"), sum[axis], 0.0, bound * T::UNIT * size[axis])?;
    }
    Ok(())
}

/// Nodes all of whose cells are full and two cells from every wall, where every shape function is
/// that of the interior.
pub fn interior_nodes<M: Method<f64, D>, const D: usize>(
    solver: &Solver<f64, D, M, Inviscid>,
) -> Vec<usize> {
    let (grid, cells) = (&solver.grid, &solver.cells);
    let classifies = <M::Quadrature as Quadrature<f64, D>>::CLASSIFIES;
    let full = |node: [usize; D], code: usize| {
        let mut rest = code;
        let shift = std::array::from_fn(|_| {
            let back = (rest % M::Shape::REACH) as i32;
            rest /= M::Shape::REACH;
            -back
        });
        let far = (0..D).all(|axis| {
            let at = node[axis] as i64 + i64::from(shift[axis]);
            grid.periodic[axis] || (at >= 2 && at < grid.n_cells[axis] as i64 - 2)
        });
        far && grid.neighbor(node, shift).is_some_and(|cell| {
            let slot = cells.slot_of[cell];
            slot != ABSENT && (!classifies || cells.kind[slot as usize] == CellKind::Internal)
        })
    };
    let codes = M::Shape::REACH.pow(D as u32);
    let interior = |&slot: &usize| {
        let node = grid.node_coordinates(solver.nodes.index[slot]);
        (0..codes).all(|code| full(node, code))
    };
    owned_nodes(solver).into_iter().filter(interior).collect()
}

/// −∇p V on every interior node, relative to the force p V/h of one cell on a node.
pub fn interior_force_is<M: Method<f64, D>, const D: usize>(
    scene: &Scene<D>,
    method: M,
    expected: [f64; D],
    bound: f64,
) -> Check {
    let mut solver = solver::<f64, D, M>(scene, method);
    scatter(&mut solver, 0.0);
    let pressure = solver.physics.equation_of_state.pressure(solver.particles.density[0], 0.0);
    let volume = solver.grid.cell_volume();
    let interior = interior_nodes(&solver);
    if interior.is_empty() {
        return Err("no interior node".into());
    }
    for slot in interior {
        for axis in 0..D {
            let size = pressure.abs() * volume / SPACING[axis];
            let (force, unit) = (solver.nodes.force[slot][axis], f64::EPSILON);
            near(&format!("f_{axis}"), force, expected[axis], bound * unit * size)?;
        }
    }
    Ok(())
}

/// The amplitude of u = U sin(k y) falls to e^{−ν k² t} = e^{−½} for ν = 0.2 m²/s, to 0.01:
/// the hat and the B-spline see a wave of 32 cells with 1 % to 2 % less gradient.
pub fn shear_wave_decays<M, K>(method: M, stress: K) -> Check
where
    M: Method<f64, 2>,
    K: Material<f64, 2>,
{
    let mut block = Block::<2>::full(3, Boundary::Periodic);
    (block.cells[1], block.fluid[1][1]) = (32, 32.0);
    let mut scene = block.scene();
    let k = std::f64::consts::TAU / (32.0 * SPACING[1]);
    for point in &mut scene.points {
        point.velocity[0] = 0.1 * (k * point.position[1]).sin();
    }
    let mut solver = Solver::new(&scene, method, stress).map_err(|e| e.to_string())?;
    let amplitude = |solver: &Solver<f64, 2, M, K>| {
        let p = &solver.particles;
        let pairs = p.position.iter().zip(&p.velocity);
        pairs.map(|(x, v)| v[0] * (k * x[1]).sin()).sum::<f64>()
    };
    let start = amplitude(&solver);
    let end_time = 0.5 / (0.2 * k * k);
    for _ in 0..400 {
        solver.advance(end_time / 400.0).map_err(|e| e.to_string())?;
    }
    near("amplitude", amplitude(&solver) / start, (-0.5_f64).exp(), 0.01)
}

/// In v = a + G x, given with its gradient to every point, ρ ← ρ/(1 + Δt tr G).
pub fn density_follows_affine_flow<M: Method<f64, 2>>(method: M) -> Check {
    let gradient = [[0.3, -0.7], [1.1, 0.4]];
    let block = Block { fluid: [[3.0, 6.0]; 2], ..Block::<2>::full(9, Boundary::Free) };
    let mut scene = Block { jitter: 0.4, ..block }.scene();
    for point in &mut scene.points {
        let x = point.position;
        point.velocity = gradient.map(|g| 0.5 + g[0] * x[0] + g[1] * x[1]);
        point.velocity_gradient = gradient;
    }
    let mut solver = solver::<f64, 2, M>(&scene, method);
    solver.advance(0.01).map_err(|e| e.to_string())?;
    let expected = DENSITY / (1.0 + 0.01 * 0.7);
    solver.particles.density.iter().try_for_each(|&density| near("ρ", density, expected, 1e-11))
}
