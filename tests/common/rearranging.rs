//! Solvers that rearrange their points, fields that must stay, and the ledger's sums.

use transpoint::cells::ABSENT;
use transpoint::material::Inviscid;
use transpoint::method::Method;
use transpoint::rearrangement::Totals;
use transpoint::scene::{Boundary, Scene};
use transpoint::shape::Linear;
use transpoint::variants::{Fill, FillMass, FillPoints, Rearrangement};
use transpoint::{Solver, basis};

use super::parts::{FLIP, MIXED, mls};
use super::phases::{scheme, solver};
use super::scenes::{Block, DENSITY};
use super::{Check, near};

/// Rearrangement that only fills.
pub fn only_fill(points: FillPoints, mass: FillMass) -> Rearrangement {
    Rearrangement { fill: Some(Fill { points, mass }), ..Rearrangement::default() }
}

/// A transport point method with linear fields and its solver.
pub fn transport<const D: usize>(
    scene: &Scene<D>,
    rearrangement: Rearrangement,
) -> Solver<f64, D, impl Method<f64, D>, Inviscid>
where
    basis::Linear: basis::PolynomialBasis<f64, D>,
{
    let mut solver = solver(scene, scheme(Linear, mls(), MIXED, FLIP));
    solver.set_rearrangement(Some(rearrangement)).unwrap();
    solver
}

/// A box of 7 cells per axis full of points, without those of the cells named; ρ and ρv are linear.
pub fn holed<const D: usize>(seed: u64, holes: &[[usize; D]]) -> Scene<D> {
    let mut scene =
        Block { jitter: 0.3, ..Block::<D>::full(7, Boundary::Slip).random(seed) }.scene();
    let spacing = scene.grid.spacing;
    scene.points.retain(|point| {
        let cell: [usize; D] =
            std::array::from_fn(|axis| (point.position[axis] / spacing[axis]) as usize);
        !holes.contains(&cell)
    });
    for point in &mut scene.points {
        let (density, velocity) = linear(point.position);
        (point.density, point.velocity) = (density, velocity);
    }
    scene
}

/// Density and velocity (ρv)/ρ of fields with linear ρ and ρv.
pub fn linear<const D: usize>(x: [f64; D]) -> (f64, [f64; D]) {
    let along =
        |slope: f64| x.iter().enumerate().map(move |(axis, x)| slope * (axis as f64 - 0.7) * x);
    let density = DENSITY * (1.0 + along(0.05).sum::<f64>());
    let velocity = std::array::from_fn(|axis| {
        let momentum = DENSITY * (0.3 + along(0.9 + axis as f64).sum::<f64>());
        momentum / density
    });
    (density, velocity)
}

/// Every point has the linear fields at its place.
pub fn follows_linear<const D: usize, M: Method<f64, D>>(
    solver: &Solver<f64, D, M, Inviscid>,
) -> Check {
    let p = &solver.particles;
    for k in 0..p.len() {
        let (density, velocity) = linear(p.position[k]);
        near("density", p.density[k], density, 1e-11 * DENSITY)?;
        for axis in 0..D {
            near("velocity", p.velocity[k][axis], velocity[axis], 1e-11)?;
        }
    }
    Ok(())
}

/// Totals agree entry by entry.
pub fn same_totals<const D: usize>(found: &Totals<D>, expected: &Totals<D>, bound: f64) -> Check {
    let (a, b) = (found.conserved, expected.conserved);
    near("mass", a.mass, b.mass, bound)?;
    near("kinetic", a.kinetic_energy, b.kinetic_energy, bound)?;
    near("internal", a.internal_energy, b.internal_energy, bound)?;
    near("potential", found.potential_energy, expected.potential_energy, bound)?;
    near("compression", found.compression_energy, expected.compression_energy, bound)?;
    for axis in 0..D {
        near("momentum", a.momentum[axis], b.momentum[axis], bound)?;
    }
    for axis in 0..3 {
        near("angular", a.angular_momentum[axis], b.angular_momentum[axis], bound)?;
    }
    Ok(())
}

/// What the ledger says of the change of totals is what has changed.
pub fn ledger_is_right<const D: usize, M: Method<f64, D>>(
    solver: &mut Solver<f64, D, M, Inviscid>,
) -> Totals<D> {
    let before = solver.full_totals();
    let (n_before, n_events) = (solver.particles.len(), solver.ledger.events().len());
    solver.rearrange();
    let after = solver.full_totals();
    let (mut sum, mut n) = (before, n_before as u64);
    for event in &solver.ledger.events()[n_events..] {
        sum = sum.plus(1.0, &event.change());
        n = n + event.n_added - event.n_removed;
    }
    same_totals(&after, &sum, 1e-12 * (before.conserved.mass + 1.0)).unwrap();
    assert_eq!(n, solver.particles.len() as u64);
    assert!(solver.particles.cell.iter().all(|&cell| cell != ABSENT));
    let mut ids = solver.particles.id.clone();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), solver.particles.len(), "an identifier stands twice");
    after.plus(-1.0, &before)
}
