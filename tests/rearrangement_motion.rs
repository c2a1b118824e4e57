//! Points that are moved and split, and all of rearrangement on several threads.

use crate::common::parts::{DT, FLIP, cases};
use crate::common::phases::{scheme, solver};
use crate::common::rearranging::{follows_linear, holed, ledger_is_right, same_totals, transport};
use crate::common::scenes::{Block, run};
use proptest::prelude::*;
use rayon::ThreadPoolBuilder;
use transpoint::material::Inviscid;
use transpoint::method::Method;
use transpoint::quadrature::Particle;
use transpoint::rearrangement::Totals;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, EquationOfStateSpec, Scene};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::transfer::Apic;
use transpoint::variants::{Fill, FillMass, FillPoints, Rearrangement, Shift, Split};
use transpoint::{Settings, Solver, Variant, basis};

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

/// A film of single points that is stretched at constant rate: no gap opens, and no cell fills with points. Points
/// that are not alone, two rows of two in a cell, are left as they are.
#[test]
fn lone_points_are_split_before_a_gap_opens() {
    let film = |per_axis: usize| {
        let mut block = Block::<2>::full(4, Boundary::Free);
        (block.cells, block.fluid, block.per_axis) =
            ([44, 5], [[18.0, 26.0], [2.0, 3.0]], per_axis);
        let mut scene = block.scene();
        for point in &mut scene.points {
            point.velocity = [point.position[0] - 22.0 * scene.grid.spacing[0], 0.0];
        }
        scene.equation_of_state = EquationOfStateSpec::WeaklyCompressible {
            reference_density: 1000.0,
            sound_speed: 1e-6,
        };
        scene
    };
    let stretched = |scene: &Scene<2>, split| {
        let rearrangement = Rearrangement { split, ..Rearrangement::default() };
        let mut solver = transport(scene, rearrangement);
        let mass = solver.full_totals().conserved.mass;
        for _ in 0..100 {
            solver.advance(0.01).unwrap();
        }
        assert!((solver.full_totals().conserved.mass / mass - 1.0).abs() < 1e-13);
        let mut points: Vec<_> =
            solver.particles.position.iter().map(|x| x[0] / scene.grid.spacing[0]).collect();
        points.sort_by(f64::total_cmp);
        let gap = points.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        (points.len(), gap)
    };
    let single = film(1);
    let (n, gap) = stretched(&single, None);
    assert!(n == 8 && gap > 1.9, "{n} points, {gap}");
    let (n, gap) = stretched(&single, Some(Split::Lone(1.0)));
    assert!(n > 8 && n <= 32 && gap < 1.6, "{n} points, {gap}");
    let square = film(2);
    assert_eq!(stretched(&square, Some(Split::Lone(2.5))).0, square.points.len());
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
        split: Some(Split::Stretch(0.51)),
        overfill: None,
    };
    let stretch = Rearrangement { split: Some(Split::Stretch(0.51)), ..Rearrangement::default() };
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
                let simulation = run(&scene, variant, &settings, (10, 0.5 * DT));
                (simulation.observe(), simulation.counters(), simulation.ledger().clone())
            })
        };
        let reference = result(1);
        let n = reference.1;
        if variant == Variant::Mpm {
            assert!(n.n_points_split > 0, "{n:?}");
        } else {
            assert!(n.n_points_filled > 0 && n.n_cells_reduced > 0 && n.n_points_shifted > 0);
            assert!(n.n_points_split > 0, "{n:?}");
        }
        for n_threads in [1, 2, 7] {
            assert!(result(n_threads) == reference, "{} on {n_threads}", variant.name());
        }
    }
}
