//! Points that are added, taken away, moved or split: where, with which fields, at what cost in mass,
//! momentum and energy.

mod common;

use common::parts::{DT, FLIP, MIXED, cases, mls};
use common::phases::{scheme, solver};
use common::scenes::{Block, DENSITY, run};
use common::{Check, near};
use proptest::prelude::*;
use rayon::ThreadPoolBuilder;
use transpoint::cells::ABSENT;
use transpoint::material::Inviscid;
use transpoint::method::Method;
use transpoint::quadrature::Particle;
use transpoint::rearrangement::{EventKind, Totals};
use transpoint::reconstruction::{Carried, MovingLeastSquares};
use transpoint::scene::{Boundary, EquationOfStateSpec, Scene};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::transfer::Apic;
use transpoint::variants::{Fill, FillMass, FillPoints, Rearrangement, Shift, Split};
use transpoint::{Settings, Solver, Variant, basis};

fn only_fill(points: FillPoints, mass: FillMass) -> Rearrangement {
    Rearrangement { fill: Some(Fill { points, mass }), ..Rearrangement::default() }
}

/// A transport point method with linear fields and its solver.
fn transport<const D: usize>(
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
fn holed<const D: usize>(seed: u64, holes: &[[usize; D]]) -> Scene<D> {
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
fn linear<const D: usize>(x: [f64; D]) -> (f64, [f64; D]) {
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
fn follows_linear<const D: usize, M: Method<f64, D>>(
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

fn same_totals<const D: usize>(found: &Totals<D>, expected: &Totals<D>, bound: f64) -> Check {
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
fn ledger_is_right<const D: usize, M: Method<f64, D>>(
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

#[test]
fn only_fractures_are_filled_and_with_linear_fields_exactly() {
    for points in [FillPoints::Center, FillPoints::Quarters] {
        let mut one = transport(&holed::<1>(3, &[[3]]), only_fill(points, FillMass::Created));
        let bay = [[3, 3], [4, 3], [0, 1], [6, 3], [2, 5], [3, 5], [2, 6], [3, 6]];
        let mut two = transport(&holed::<2>(3, &bay), only_fill(points, FillMass::Created));
        let hole = [[3; 3], [0, 3, 3], [0, 6, 2]];
        let mut three = transport(&holed::<3>(3, &hole), only_fill(points, FillMass::Created));
        for _ in 0..2 {
            ledger_is_right(&mut one);
            ledger_is_right(&mut two);
            ledger_is_right(&mut three);
        }
        let per_axis = if points == FillPoints::Center { 1 } else { 2_u64 };
        assert_eq!(one.counters.n_points_filled, per_axis);
        assert_eq!(two.counters.n_points_filled, 4 * per_axis.pow(2));
        assert_eq!(three.counters.n_points_filled, 3 * per_axis.pow(3));
        assert_eq!(two.counters.n_fracture_cells, 4);
        follows_linear(&one).unwrap();
        follows_linear(&two).unwrap();
        follows_linear(&three).unwrap();
        let first_new = holed::<2>(3, &bay).points.len() as u32;
        assert!(two.particles.id.contains(&first_new));
    }
}

#[test]
fn new_points_stand_for_the_cell() {
    let full = holed::<2>(5, &[]);
    let mut solver =
        transport(&holed::<2>(5, &[[3, 3]]), only_fill(FillPoints::Quarters, FillMass::Created));
    let change = ledger_is_right(&mut solver);
    let cell = full.grid.spacing[0] * full.grid.spacing[1];
    let center: [f64; 2] = std::array::from_fn(|axis| 3.5 * full.grid.spacing[axis]);
    near("mass", change.conserved.mass, linear(center).0 * cell, 1e-11).unwrap();
    let event = solver.ledger.events()[0];
    assert_eq!((event.kind, event.n_cells, event.n_added), (EventKind::Fill, 1, 4));
}

proptest! {
    #![proptest_config(cases(24))]

    /// Two fractures share donors: the total stays, and so do the linear fields.
    #[test]
    fn donated_mass_is_conserved(seed in any::<u64>(), quarters in any::<bool>()) {
        let points = if quarters { FillPoints::Quarters } else { FillPoints::Center };
        let scene = holed::<2>(seed, &[[3, 3], [4, 3], [0, 2]]);
        let mut solver = transport(&scene, only_fill(points, FillMass::Donated));
        let before = solver.full_totals().conserved.mass;
        let change = ledger_is_right(&mut solver);
        prop_assert!(change.conserved.mass.abs() < 1e-15 * before * 10.0);
        prop_assert_eq!(solver.counters.n_fills_refused, 0);
        prop_assert!(solver.particles.mass.iter().all(|&mass| mass > 0.0));
        follows_linear(&solver).map_err(TestCaseError::fail)?;
    }

    /// Eight points of random mass and velocity per cell become four.
    #[test]
    fn reduced_cells_keep_mass_and_momentum(seed in any::<u64>()) {
        let mut block = Block::<2>::full(6, Boundary::Slip).random(seed);
        (block.per_axis, block.fluid) = (3, [[0.0, 4.0]; 2]);
        let mut scene = block.scene();
        for (k, point) in scene.points.iter_mut().enumerate() {
            point.mass *= 1.0 + 0.3 * (k as f64).sin();
        }
        let settings = Rearrangement { most_points: Some(8), ..Rearrangement::default() };
        let mut solver = transport(&scene, settings);
        let before = solver.full_totals();
        let change = ledger_is_right(&mut solver);
        let bound = 1e-14 * before.conserved.mass;
        prop_assert!(solver.counters.n_cells_reduced >= 4);
        prop_assert!(change.conserved.mass.abs() < bound);
        prop_assert!(change.conserved.momentum.iter().all(|p| p.abs() < bound));
        let n_reduced = solver.counters.n_cells_reduced;
        solver.rearrange();
        prop_assert_eq!(solver.counters.n_cells_reduced, n_reduced);
    }
}

#[test]
fn reduced_cells_keep_linear_fields() {
    let mut scene = holed::<2>(8, &[]);
    // At equal masses the shift of the velocity, which keeps the momentum, is not zero; here it is.
    let points: Vec<_> = scene.points.clone();
    for point in points {
        scene.points.push(point);
    }
    for point in &mut scene.points {
        (point.density, point.velocity) = (DENSITY, [0.4, -0.2]);
    }
    let settings = Rearrangement { most_points: Some(4), ..Rearrangement::default() };
    let mut solver = transport(&scene, settings);
    ledger_is_right(&mut solver);
    assert_eq!(solver.counters.n_cells_reduced, 49);
    for k in 0..solver.particles.len() {
        near("density", solver.particles.density[k], DENSITY, 1e-11 * DENSITY).unwrap();
        near("velocity", solver.particles.velocity[k][0], 0.4, 1e-12).unwrap();
    }
}

#[test]
fn the_budget_refuses_what_is_beyond_it() {
    let holes = [[1, 1], [3, 3], [5, 5]];
    let scene = holed::<2>(4, &holes);
    // Each cell holds 1/46 of what there is.
    for (share, filled) in [(0.0, 0), (0.01, 0), (0.03, 1), (0.05, 2), (0.07, 3)] {
        let settings = only_fill(FillPoints::Quarters, FillMass::Budget(share));
        let mut solver = transport(&scene, settings);
        let before = solver.full_totals().conserved.mass;
        let change = ledger_is_right(&mut solver);
        let counters = solver.counters;
        assert_eq!((counters.n_points_filled, counters.n_fills_refused), (4 * filled, 3 - filled));
        assert!(change.conserved.mass <= share * before);
        solver.rearrange();
        assert_eq!(solver.counters.n_points_filled, 4 * filled, "the budget is for the whole run");
    }
}

#[test]
fn what_a_method_cannot_honour_is_refused() {
    let scene = holed::<2>(4, &[]);
    let fill = only_fill(FillPoints::Center, FillMass::Created);
    let none = Rearrangement::default();
    let reduce = |n| Rearrangement { most_points: Some(n), ..none };
    let shift =
        |strength, interval| Rearrangement { shift: Some(Shift { strength, interval }), ..none };
    let split = |split| Rearrangement { split: Some(split), ..none };
    let budget = |share| only_fill(FillPoints::Center, FillMass::Budget(share));
    for (variant, rearrangement, field) in [
        (Variant::Mpm, fill, "fill"),
        (Variant::Apic, reduce(8), "most_points"),
        (Variant::Gimp, shift(0.1, 1), "shift"),
        (Variant::Tpm, split(Split::Volume(1.0)), "split"),
        (Variant::TpmVp, reduce(3), "most_points"),
        (Variant::TpmVp, reduce(0), "most_points"),
        (Variant::TpmVp, shift(1.1, 1), "shift.strength"),
        (Variant::TpmVp, shift(f64::NAN, 1), "shift.strength"),
        (Variant::TpmVp, shift(0.1, 0), "shift.interval"),
        (Variant::TpmVp, budget(-0.1), "fill.mass"),
        (Variant::TpmVp, budget(f64::INFINITY), "fill.mass"),
        (Variant::Mpm, split(Split::Stretch(0.1)), "split"),
        (Variant::Mpm, split(Split::Volume(f64::NAN)), "split"),
    ] {
        let settings = Settings { rearrangement: Some(rearrangement), ..Settings::default() };
        let error = variant.build_2d(&scene, &settings).err().unwrap();
        assert_eq!(error.field, format!("settings.rearrangement.{field}"), "{}", variant.name());
    }
    // Recipes made by hand pass the same check.
    let mut carried = solver::<f64, 2, _>(&scene, scheme(Linear, Carried, Particle, FLIP));
    assert!(carried.set_rearrangement(Some(fill)).is_err());
    let fit = MovingLeastSquares::<basis::Quadratic, f64>::new(1.5);
    let mut rebuilt = solver::<f64, 2, _>(&scene, scheme(Linear, fit, MIXED, FLIP));
    assert!(rebuilt.set_rearrangement(Some(fill)).is_ok());
    assert!(rebuilt.set_rearrangement(Some(split(Split::Stretch(1.0)))).is_err());
}

/// Least distance of two points, m.
fn least_distance<const D: usize, M: Method<f64, D>>(solver: &Solver<f64, D, M, Inviscid>) -> f64 {
    let p = &solver.particles.position;
    let mut least = f64::INFINITY;
    for a in 0..p.len() {
        for b in 0..a {
            let squared: f64 = (0..D).map(|axis| (p[a][axis] - p[b][axis]).powi(2)).sum();
            least = least.min(squared.sqrt());
        }
    }
    least
}

fn only_shift(strength: f64, interval: u32) -> Rearrangement {
    Rearrangement { shift: Some(Shift { strength, interval }), ..Rearrangement::default() }
}

#[test]
fn shifted_points_keep_linear_fields_and_move_apart() {
    fn check<const D: usize>()
    where
        basis::Linear: basis::PolynomialBasis<f64, D>,
    {
        let scene = holed::<D>(12, &[]);
        let mut solver = transport(&scene, only_shift(0.1, 1));
        let before = (solver.particles.position.clone(), solver.particles.id.clone());
        let least = least_distance(&solver);
        ledger_is_right(&mut solver);
        assert_eq!(solver.ledger.events().len(), 1);
        let n_shifted = solver.counters.n_points_shifted;
        assert!(n_shifted > solver.particles.len() as u64 / 2, "{n_shifted}");
        let smallest = scene.grid.spacing.into_iter().fold(1.0, f64::min);
        for (k, id) in solver.particles.id.iter().enumerate() {
            let old = before.0[before.1.iter().position(|other| other == id).unwrap()];
            let new = solver.particles.position[k];
            let squared: f64 = (0..D).map(|axis| (new[axis] - old[axis]).powi(2)).sum();
            assert!(squared.sqrt() <= 0.05 * smallest * (1.0 + 1e-12));
        }
        assert!(least_distance(&solver) > least);
        for _ in 0..10 {
            solver.rearrange();
        }
        follows_linear(&solver).unwrap();
        assert!(least_distance(&solver) > 1.2 * least);
    }
    check::<1>();
    check::<2>();
    check::<3>();
}

/// Points of cells next to an empty one stay; periodic faces count as any other place.
#[test]
fn points_near_the_surface_stay() {
    let hole = [[3, 3]];
    let mut solver = transport(&holed::<2>(12, &hole), only_shift(0.5, 1));
    let position_of = |solver: &Solver<f64, 2, _, Inviscid>| {
        let p = &solver.particles;
        let mut all: Vec<_> = (0..p.len()).map(|k| (p.id[k], p.cell[k], p.position[k])).collect();
        all.sort_by_key(|&(id, ..)| id);
        all
    };
    let before = position_of(&solver);
    solver.rearrange();
    let near = |cell: u32| (2..5).contains(&(cell / 7)) && (2..5).contains(&(cell % 7));
    let mut n_moved = 0;
    for (old, new) in before.iter().zip(&position_of(&solver)) {
        assert!(!near(old.1) || old.2 == new.2);
        n_moved += u64::from(old.2 != new.2);
    }
    assert_eq!(n_moved, solver.counters.n_points_shifted);

    let mut scene = Block { jitter: 0.45, ..Block::<2>::full(5, Boundary::Periodic) }.scene();
    for point in &mut scene.points {
        point.velocity = [0.3, -0.1];
    }
    let mut solver = transport(&scene, only_shift(0.5, 3));
    for n_events in [0, 0, 1, 1, 1, 2] {
        solver.rearrange();
        assert_eq!(solver.ledger.events().len(), n_events);
    }
    assert!(solver.counters.n_points_shifted > 100);
    assert!(solver.particles.velocity.iter().all(|v| (v[0] - 0.3).abs() < 1e-12));
}

/// A solver with carried values whose points are split.
fn carried<const D: usize>(
    scene: &Scene<D>,
    split: Split,
) -> Solver<f64, D, impl Method<f64, D>, Inviscid> {
    let mut solver = solver(scene, scheme(QuadraticBspline, Carried, Particle, Apic));
    let settings = Rearrangement { split: Some(split), ..Rearrangement::default() };
    solver.set_rearrangement(Some(settings)).unwrap();
    solver
}

proptest! {
    #![proptest_config(cases(8))]

    /// Large points next to walls and in the middle, with affine fields.
    #[test]
    fn splitting_changes_no_total_but_that_of_the_spin(seed in any::<u64>()) {
        let mut block = Block::<2>::full(5, Boundary::Slip).random(seed);
        block.per_axis = 1;
        let mut scene = block.scene();
        scene.body_force = [0.3, -9.81];
        for split in [Split::Volume(0.8), Split::Stretch(0.8)] {
            let mut solver = carried(&scene, split);
            let n = solver.particles.len();
            let mass = solver.full_totals().conserved.mass;
            let mut change = ledger_is_right(&mut solver);
            let factor = if split == Split::Volume(0.8) { 4 } else { 2 };
            prop_assert_eq!(solver.particles.len(), factor * n);
            prop_assert_eq!(solver.counters.n_points_split, n as u64);
            // The affine fields' share depends on where in its cell a point is.
            change.conserved.angular_momentum = [0.0; 3];
            same_totals(&change, &Totals::zero(), 1e-13 * mass).map_err(TestCaseError::fail)?;
            let rest = ledger_is_right(&mut solver);
            prop_assert!(split == Split::Stretch(0.8) || rest == Totals::zero());
        }
    }
}

/// Without affine fields angular momentum stays as well.
#[test]
fn splitting_keeps_angular_momentum() {
    for split in [Split::Volume(0.4), Split::Stretch(0.4)] {
        let mut block = Block::<3>::full(4, Boundary::Slip).random(3);
        block.fluid = [[0.0, 3.0]; 3];
        let mut solver = solver(&block.scene(), scheme(Linear, Carried, Particle, FLIP));
        let settings = Rearrangement { split: Some(split), ..Rearrangement::default() };
        solver.set_rearrangement(Some(settings)).unwrap();
        let mass = solver.full_totals().conserved.mass;
        let change = ledger_is_right(&mut solver);
        same_totals(&change, &Totals::zero(), 1e-13 * mass).unwrap();
        assert!(solver.counters.n_points_split > 0);
    }
}

/// A block that is stretched at constant rate: every time its length doubles, so do the points.
#[test]
fn a_uniform_stretch_doubles_the_points() {
    let mut block = Block::<2>::full(4, Boundary::Free);
    (block.cells, block.fluid) = ([40, 6], [[16.0, 24.0], [2.0, 4.0]]);
    let mut scene = block.scene();
    let middle = 20.0 * scene.grid.spacing[0];
    for point in &mut scene.points {
        point.velocity = [point.position[0] - middle, 0.0];
        point.velocity_gradient = [[1.0, 0.0], [0.0, 0.0]];
    }
    // Soft, so that nothing but the initial motion acts.
    scene.equation_of_state =
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1000.0, sound_speed: 1e-6 };
    let counts = [Split::Stretch(0.75), Split::Volume(10.0)].map(|split| {
        let mut solver = carried(&scene, split);
        let mut counts = vec![solver.particles.len()];
        // Lengths start at half a cell; x = x₀ (1 + t) passes 1.5 half-way, and 3 at the end.
        for _ in 0..240 {
            solver.advance(0.01).unwrap();
            if counts.last() != Some(&solver.particles.len()) {
                counts.push(solver.particles.len());
            }
        }
        counts
    });
    let n = scene.points.len();
    assert_eq!(counts[0].last(), Some(&(4 * n)), "{:?}", counts[0]);
    assert_eq!(counts[1], [n]);
}

/// Everything at once on both kinds of methods, in a dam that breaks.
#[test]
fn threads_change_no_bit() {
    let mut block = Block::<2>::full(40, Boundary::Slip).random(77);
    (block.fluid, block.jitter, block.speed) = ([[0.0, 30.5], [0.0, 25.5]], 0.45, 1.0);
    let mut scene = block.scene();
    scene.body_force = [1.0, -9.81];
    scene.points.retain(|point| {
        let cell = [0, 1].map(|axis| (point.position[axis] / scene.grid.spacing[axis]) as usize);
        cell[0] % 9 != 4 || cell[1] % 7 != 3
    });
    let transport = Rearrangement {
        fill: Some(Fill { points: FillPoints::Quarters, mass: FillMass::Donated }),
        most_points: Some(4),
        shift: Some(Shift { strength: 0.1, interval: 2 }),
        split: None,
    };
    let stretch = Rearrangement { split: Some(Split::Stretch(0.52)), ..Rearrangement::default() };
    for (variant, rearrangement) in
        [(Variant::TpmVp, transport), (Variant::Tpm, transport), (Variant::Mpm, stretch)]
    {
        let settings = Settings {
            rearrangement: Some(rearrangement),
            positivity: Some(0.8),
            ..Settings::default()
        };
        let result = |n_threads| {
            let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
            pool.install(|| {
                let simulation = run(&scene, variant, &settings, (8, 0.3 * DT));
                (simulation.observe(), simulation.counters(), simulation.ledger().clone())
            })
        };
        let reference = result(1);
        let n = reference.1;
        if variant == Variant::Mpm {
            assert!(n.n_points_split > 0, "{n:?}");
        } else {
            assert!(n.n_points_filled > 0 && n.n_cells_reduced > 0 && n.n_points_shifted > 0);
        }
        for n_threads in [1, 2, 7] {
            assert!(result(n_threads) == reference, "{} on {n_threads}", variant.name());
        }
    }
}
