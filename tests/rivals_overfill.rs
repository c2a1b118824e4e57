//! Points pushed out of nodes that hold more volume than there is room, \[Baumgarten2023\].

use crate::common::near;
use crate::common::parts::FLIP;
use crate::common::phases::{scheme, solver};
use crate::common::scenes::{Block, SPACING};
use transpoint::Solver;
use transpoint::material::Inviscid;
use transpoint::method::Scheme;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::Boundary;
use transpoint::shape::QuadraticBspline;
use transpoint::transfer::Flip;
use transpoint::variants::{Overfill, Rearrangement};

type Splines = Solver<f64, 2, Scheme<QuadraticBspline, Carried, Particle, Flip>, Inviscid>;

const CELLS: usize = 8;

/// A periodic box of points whose volume is `swell` times their room, squeezed towards the middle of a cell.
fn squeezed(squeeze: f64, swell: f64) -> Splines {
    let mut scene = Block::<2>::full(CELLS, Boundary::Periodic).scene();
    let place = |cells: f64, axis: usize| cells * SPACING[axis];
    for point in &mut scene.points {
        let offset: [f64; 2] =
            std::array::from_fn(|axis| point.position[axis] / SPACING[axis] - 4.5);
        let distance = offset[0].hypot(offset[1]);
        let share = 1.0 - squeeze * (1.0 - distance / 3.0).max(0.0);
        point.position = std::array::from_fn(|axis| place(4.5 + share * offset[axis], axis));
        point.density /= swell;
    }
    let method = scheme(QuadraticBspline, Carried, Particle, FLIP);
    let mut solver: Splines = solver(&scene, method);
    let overfill = Some(Overfill { interval: 1 });
    solver.set_rearrangement(Some(Rearrangement { overfill, ..Rearrangement::default() })).unwrap();
    solver
}

/// Uniform quadratic B-spline and its slope.
fn spline(x: f64) -> [f64; 2] {
    match x.abs() {
        a if a < 0.5 => [0.75 - a * a, -2.0 * x],
        a if a < 1.5 => [0.5 * (1.5 - a).powi(2), -(1.5 - a) * x.signum()],
        _ => [0.0; 2],
    }
}

/// N and ∇N, 1/m, of a node, which stands in the middle of a cell, at a position.
fn function(node: usize, position: [f64; 2]) -> (f64, [f64; 2]) {
    let middle = [node / CELLS, node % CELLS].map(|index| index as f64 + 0.5);
    let [x, y]: [[f64; 2]; 2] = std::array::from_fn(|axis| {
        let (offset, n) = (position[axis] / SPACING[axis] - middle[axis], CELLS as f64);
        spline(offset - n * (offset / n).round())
    });
    (x[0] * y[0], [x[1] * y[0] / SPACING[0], x[0] * y[1] / SPACING[1]])
}

fn volumes(solver: &Splines) -> Vec<f64> {
    let p = &solver.particles;
    (0..p.len()).map(|k| p.mass[k] / p.density[k]).collect()
}

/// E_I = (Σ_p N V_p − V)₊ of every node.
fn excesses(solver: &Splines) -> Vec<f64> {
    let (position, volumes) = (&solver.particles.position, volumes(solver));
    let held = |node: usize| {
        let parts = position.iter().zip(&volumes);
        parts.map(|(&position, volume)| volume * function(node, position).0).sum::<f64>()
    };
    let room = SPACING[0] * SPACING[1];
    (0..CELLS * CELLS).map(|node| (held(node) - room).max(0.0)).collect()
}

/// Σ_I E_I² over the square of a cell's volume.
fn excess(solver: &Splines) -> f64 {
    let room = SPACING[0] * SPACING[1];
    excesses(solver).iter().map(|excess| (excess / room).powi(2)).sum()
}

/// By identifier: −(Σ_I E_I² / Σ_q |g_q|²) g_p with g_p = 2 V_p Σ_I E_I ∇N_I.
fn expected_shift(solver: &Splines) -> Vec<[f64; 2]> {
    let (p, volumes, excesses) = (&solver.particles, volumes(solver), excesses(solver));
    let slope = |k: usize| {
        let mut slope = [0.0; 2];
        for (node, excess) in excesses.iter().enumerate() {
            let gradient = function(node, p.position[k]).1;
            for axis in 0..2 {
                slope[axis] += 2.0 * volumes[k] * excess * gradient[axis];
            }
        }
        slope
    };
    let mut slopes = vec![[0.0; 2]; p.len()];
    (0..p.len()).for_each(|k| slopes[p.id[k] as usize] = slope(k));
    let squares: f64 = slopes.iter().flatten().map(|g| g * g).sum();
    let scale = excesses.iter().map(|excess| excess * excess).sum::<f64>() / squares;
    slopes.into_iter().map(|slope| slope.map(|g| -scale * g)).collect()
}

/// How far points are from `before`, by identifier.
fn shift(solver: &Splines, before: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let p = &solver.particles;
    let mut found = vec![[0.0; 2]; p.len()];
    for k in 0..p.len() {
        let id = p.id[k] as usize;
        found[id] = std::array::from_fn(|axis| {
            let length = CELLS as f64 * SPACING[axis];
            let moved = p.position[k][axis] - before[id][axis];
            moved - length * (moved / length).round()
        });
    }
    found
}

fn positions(solver: &Splines) -> Vec<[f64; 2]> {
    let p = &solver.particles;
    let mut found = vec![[0.0; 2]; p.len()];
    (0..p.len()).for_each(|k| found[p.id[k] as usize] = p.position[k]);
    found
}

/// The step is the published one, and takes more than half of the sum of squares away: for a sum of squares of
/// linear functions with one curvature it takes three quarters.
#[test]
fn overfull_nodes_lose_volume() {
    for squeeze in [0.1, 0.2, 0.4] {
        let mut solver = squeezed(squeeze, 1.0);
        let (before, places) = (excess(&solver), positions(&solver));
        let expected = expected_shift(&solver);
        let (mass, n_points) = (solver.particle_totals().mass, solver.particles.len());
        solver.rearrange();
        for (found, exact) in shift(&solver, &places).into_iter().zip(expected) {
            for axis in 0..2 {
                // Excesses are differences: 10 % of a volume known to a few ε.
                near("shift", found[axis], exact[axis], 1e-13 * SPACING[axis]).unwrap();
            }
        }
        let after = excess(&solver);
        assert!(before > 1e-3 && after < 0.5 * before, "{before} {after}");
        assert!(solver.counters.n_points_shifted > 0);
        // Points change places in the sum.
        near("mass", solver.particle_totals().mass, mass, 1e-14 * mass).unwrap();
        assert_eq!(solver.particles.len(), n_points);
    }
}

/// Fluid that is a little too much everywhere has nowhere to go: its slope vanishes, but the excess does not, and
/// their quotient must not throw points about.
#[test]
fn overfill_of_all_nodes_does_not_grow() {
    for (squeeze, swell) in [(1e-2, 1.001), (1e-2, 1.01), (1e-3, 1.01), (1e-6, 1.001)] {
        let mut solver = squeezed(squeeze, swell);
        let (before, places) = (excess(&solver), positions(&solver));
        solver.rearrange();
        let most = shift(&solver, &places).into_iter().flatten().fold(0.0, f64::max);
        let (after, most) = (excess(&solver), most / SPACING[0]);
        let what = format!("{squeeze} {swell}: {before:e} -> {after:e}, {most:e} cells");
        assert!(after <= before, "{what}");
    }
}

/// A lattice fills every node to round-off, E ~ ε V, and the step is in proportion to E.
#[test]
fn overfill_leaves_a_lattice_as_it_is() {
    for swell in [0.999, 1.0, 1.001] {
        let mut solver = squeezed(0.0, swell);
        let places = positions(&solver);
        solver.rearrange();
        for shift in shift(&solver, &places).into_iter().flatten() {
            near("shift", shift, 0.0, 1e-14 * SPACING[0]).unwrap();
        }
    }
}
