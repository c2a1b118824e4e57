//! Faces: slip, no-slip, prescribed, periodic and free; and points that go through them.

use crate::common::near;
use crate::common::parts::{DT, FLIP, GIMP};
use crate::common::phases::{scatter, scheme, solver};
use crate::common::scenes::{Block, Build, SPACING};
use proptest::prelude::*;
use transpoint::error::StepError;
use transpoint::method::Method;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, Scene};
use transpoint::shape::{CubicBspline, Linear, QuadraticBspline, ShapeFunction};
use transpoint::{Settings, Variant};

const LID: [f64; 3] = [1.5, -0.25, 9.0];

/// A full box, disordered, with pressure: every node of a wall wants to move.
fn random_box(faces: [[Boundary; 2]; 2]) -> Scene<2> {
    let block = Block::<2>::full(5, Boundary::Slip).random(8);
    let mut scene = Block { compression: [0.01, 1e-3], ..block }.scene();
    scene.boundaries = faces;
    scene
}

/// Velocity and change of the nodes of the first axis' faces and elsewhere, corners left out.
struct Sides {
    walls: [Vec<[f64; 4]>; 2],
    inside: Vec<[f64; 4]>,
}

fn sides<M: Method<f64, 2>>(faces: [Boundary; 2], method: M) -> Sides {
    let mut solver = solver::<f64, 2, M>(&random_box([faces, [Boundary::Free; 2]]), method);
    scatter(&mut solver, DT);
    solver.update_grid(DT);
    let mut sides = Sides { walls: [vec![], vec![]], inside: vec![] };
    let (grid, shape) = (solver.grid, solver.method.shape());
    for (slot, &node) in solver.nodes.index.iter().enumerate() {
        let x = shape.node_coordinate(grid.node_coordinates(node)[0], 5, false);
        let (v, dv) = (solver.nodes.velocity[slot], solver.nodes.increment[slot]);
        let row = [v[0], v[1], dv[0], dv[1]];
        match x {
            0.0 => sides.walls[0].push(row),
            5.0 => sides.walls[1].push(row),
            // Ghost nodes carry nothing.
            _ if (0.0..5.0).contains(&x) => sides.inside.push(row),
            _ => {}
        }
    }
    sides
}

fn check_faces(method: impl Method<f64, 2>) {
    let Sides { walls: [slip, no_slip], inside } =
        sides([Boundary::Slip, Boundary::NoSlip], method);
    assert!(!slip.is_empty() && !no_slip.is_empty() && !inside.is_empty());
    let moves = |row: &[f64; 4]| row.iter().filter(|&&v| v != 0.0).count();
    assert!(inside.iter().filter(|row| row[3] != 0.0).all(|row| moves(row) == 4), "{inside:?}");
    for row in slip.iter().filter(|row| row[1] != 0.0) {
        assert!(row[0] == 0.0 && row[2] == 0.0 && row[3] != 0.0, "{row:?}");
    }
    assert!(slip.iter().any(|row| row[1] != 0.0));
    assert!(no_slip.iter().all(|row| *row == [0.0; 4]), "{no_slip:?}");
    let Sides { walls: [lid, free], .. } = sides([Boundary::Velocity(LID), Boundary::Free], method);
    assert!(lid.iter().all(|row| *row == [LID[0], LID[1], 0.0, 0.0]), "{lid:?}");
    assert!(free.iter().any(|row| moves(row) == 4), "{free:?}");
}

#[test]
fn faces_constrain_their_nodes_and_no_others() {
    check_faces(scheme(Linear, Carried, Particle, FLIP));
    check_faces(scheme(GIMP, Carried, Particle, FLIP));
    check_faces(scheme(QuadraticBspline, Carried, Particle, FLIP));
    check_faces(scheme(CubicBspline, Carried, Particle, FLIP));
}

#[test]
fn the_last_axis_decides_in_corners() {
    let (left, bottom) = (Boundary::Velocity([1.0, 2.0, 0.0]), Boundary::Velocity([3.0, 4.0, 0.0]));
    let scene = random_box([[left, Boundary::Slip], [bottom, Boundary::Slip]]);
    let mut solver = solver::<f64, 2, _>(&scene, scheme(Linear, Carried, Particle, FLIP));
    scatter(&mut solver, DT);
    solver.update_grid(DT);
    let at = |x: usize, y: usize| solver.nodes.velocity[x * 6 + y];
    assert_eq!((at(0, 0)[0], at(0, 0)[1]), (3.0, 4.0));
    assert_eq!((at(0, 5)[0], at(0, 5)[1]), (1.0, 0.0));
    assert_eq!((at(5, 0)[0], at(5, 0)[1]), (3.0, 4.0));
    assert_eq!((at(5, 5)[0], at(5, 5)[1]), (0.0, 0.0));
}

/// One point at `position` (cells of a box of six), moving at `velocity` (cells per step of 1 ms).
fn one_point(faces: Boundary, position: [f64; 2], velocity: [f64; 2]) -> Scene<2> {
    let mut scene = Block::<2>::full(6, faces).scene();
    scene.points.truncate(1);
    let point = &mut scene.points[0];
    for axis in 0..2 {
        point.position[axis] = position[axis] * SPACING[axis];
        point.velocity[axis] = velocity[axis] * SPACING[axis] / 1e-3;
    }
    scene
}

#[test]
fn points_cross_periodic_faces_and_come_in_opposite() {
    for variant in Variant::ALL {
        let scene = one_point(Boundary::Periodic, [5.75, 0.25], [0.5, -0.5]);
        let mut simulation = scene.build(variant, &Settings::default());
        simulation.step(1e-3).unwrap();
        let point = simulation.observe().points[0];
        for (axis, expected) in [0.25, 5.75].into_iter().enumerate() {
            let found = point.position[axis] / SPACING[axis];
            near(variant.name(), found, expected, 1e-14).unwrap();
        }
        simulation.step(1e-3).unwrap();
        assert_eq!(simulation.counters().n_points_removed, 0);
    }
}

#[test]
fn points_that_leave_through_free_faces_are_removed_and_counted() {
    for variant in Variant::ALL {
        let mut scene = one_point(Boundary::Free, [5.75, 3.5], [0.5, 0.0]);
        let staying = one_point(Boundary::Free, [2.5, 2.5], [0.25, 0.0]).points[0];
        scene.points.push(staying);
        let mut simulation = scene.build(variant, &Settings::default());
        simulation.step(1e-3).unwrap();
        let name = variant.name();
        for _ in 0..2 {
            let ids: Vec<_> = simulation.observe().points.iter().map(|point| point.id).collect();
            assert_eq!((simulation.n_points(), ids), (1, vec![1]), "{name}");
            assert_eq!(simulation.counters().n_points_removed, 1, "{name}");
            near(name, simulation.conserved().mass, staying.mass, 0.0).unwrap();
            simulation.step(1e-3).unwrap();
        }
    }
}

#[test]
fn an_empty_box_can_be_stepped() {
    for variant in Variant::ALL {
        let scene = one_point(Boundary::Free, [5.75, 3.5], [0.5, 0.0]);
        let mut simulation = scene.build(variant, &Settings::default());
        for _ in 0..3 {
            simulation.step(1e-3).unwrap();
        }
        assert_eq!(simulation.n_points(), 0, "{}", variant.name());
    }
}

/// In the corner cell, squeezed against one wall and drawn from the other without any divergence:
/// the step is long enough to pass the first wall.
#[test]
fn a_point_through_a_wall_ends_the_run() {
    let scene = one_point(Boundary::Slip, [0.5, 0.5], [-1.5, 1.5]);
    let mut solver = solver::<f64, 2, _>(&scene, scheme(Linear, Carried, Particle, FLIP));
    let error = solver.advance(1e-3).unwrap_err();
    let StepError::LeftDomain { id: 0, position, time: 0.0 } = &error else {
        panic!("{error}");
    };
    near("x", position[0] / SPACING[0], -0.25, 1e-14).unwrap();
    near("y", position[1] / SPACING[1], 1.25, 1e-14).unwrap();
}

/// Walls hold a fluid that is pressed against them.
#[test]
fn closed_walls_keep_every_point_inside() {
    for variant in Variant::ALL {
        let mut scene = random_box([[Boundary::Slip, Boundary::NoSlip]; 2]);
        scene.body_force = [3.0, -9.81];
        let mut simulation = scene.build(variant, &Settings::default());
        for _ in 0..50 {
            simulation.step(DT).unwrap();
        }
        assert_eq!(simulation.n_points(), scene.points.len(), "{}", variant.name());
    }
}

proptest! {
    #![proptest_config(crate::common::parts::cases(256))]

    /// Also where a coordinate rounds to the face itself, in boxes whose length is not exact.
    #[test]
    fn periodic_faces_lose_no_point_to_round_off(
        cells in 3_usize..40,
        spacing in prop::sample::select(vec![0.1, 0.7, 1.0 / 3.0, 0.012]),
        ulps in -3_i32..=3,
        upper in any::<bool>(),
    ) {
        let mut scene = Block::<1>::full(4, Boundary::Periodic).scene();
        (scene.grid.cells, scene.grid.spacing) = ([cells], [spacing]);
        scene.points.truncate(1);
        let method = scheme(Linear, Carried, Particle, FLIP);
        let mut solver = solver::<f64, 1, _>(&scene, method);
        // The point is set down next to the face by the step's motion from half a cell away.
        let length = cells as f64 * spacing;
        let (start, face) = if upper { (length - 0.5 * spacing, length) } else { (0.5 * spacing, 0.0) };
        let target = face + f64::from(ulps) * f64::EPSILON * length;
        solver.particles.position[0] = [start];
        solver.particles.cell[0] = solver.grid.cell_of([start]).unwrap();
        solver.particles.velocity[0] = [target - start];
        for _ in 0..2 {
            let outcome = solver.advance(1.0);
            prop_assert!(outcome.is_ok(), "{:?} at {:e}", outcome, solver.particles.position[0][0]);
            solver.particles.velocity[0] = [0.0];
        }
    }
}
