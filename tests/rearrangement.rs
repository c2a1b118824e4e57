//! Points that are added and taken away: where, with which fields, at what cost in mass and momentum.

use crate::common::near;
use crate::common::parts::{FLIP, MIXED, cases};
use crate::common::phases::{scheme, solver};
use crate::common::rearranging::{
    follows_linear, holed, ledger_is_right, linear, only_fill, transport,
};
use crate::common::scenes::{Block, DENSITY};
use proptest::prelude::*;
use transpoint::quadrature::Particle;
use transpoint::rearrangement::EventKind;
use transpoint::reconstruction::{Carried, MovingLeastSquares};
use transpoint::scene::Boundary;
use transpoint::shape::Linear;
use transpoint::variants::{FillMass, FillPoints, Rearrangement, Shift, Split};
use transpoint::{Settings, Variant, basis};

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

    /// Two fractures share donors: mass and momentum stay, and new points follow the linear fields.
    #[test]
    fn donated_mass_and_momentum_are_conserved(seed in any::<u64>(), quarters in any::<bool>()) {
        let points = if quarters { FillPoints::Quarters } else { FillPoints::Center };
        let scene = holed::<2>(seed, &[[3, 3], [4, 3], [0, 2]]);
        let mut solver = transport(&scene, only_fill(points, FillMass::Donated));
        let before = solver.full_totals().conserved.mass;
        let change = ledger_is_right(&mut solver);
        prop_assert!(change.conserved.mass.abs() < 1e-14 * before);
        // The velocities are of order one.
        prop_assert!(change.conserved.momentum.iter().all(|p| p.abs() < 1e-14 * before));
        prop_assert_eq!(solver.counters.n_fills_refused, 0);
        let p = &solver.particles;
        prop_assert!(p.mass.iter().all(|&mass| mass > 0.0));
        for k in 0..p.len() {
            let (density, velocity) = linear(p.position[k]);
            near("density", p.density[k], density, 1e-11 * DENSITY).map_err(TestCaseError::fail)?;
            // New points have the mean velocity of those that gave them mass.
            let bound = if (p.id[k] as usize) < scene.points.len() { 1e-11 } else { 0.1 };
            for axis in 0..2 {
                near("velocity", p.velocity[k][axis], velocity[axis], bound)
                    .map_err(TestCaseError::fail)?;
            }
        }
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
        (Variant::TpmVp, split(Split::Lone(0.2)), "split"),
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
    assert!(rebuilt.set_rearrangement(Some(split(Split::Stretch(1.0)))).is_ok());
}
