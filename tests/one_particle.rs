//! Each phase with one particle and numbers worked out by hand; what a phase must not read is NaN.
//!
//! Cells of 2 m × 0.5 m, the point at ξ = (¼, ½) of cell (1, 1): all numbers are exact.

use crate::common::phases::{
    MOTION, STATE, VELOCITY, gather, scatter, scheme, solver, velocity_row,
};
use crate::common::scenes::{Block, Build};
use crate::common::{Random, near};
use transpoint::cells::ABSENT;
use transpoint::error::StepError;
use transpoint::material::Inviscid;
use transpoint::math::Tensor;
use transpoint::method::Scheme;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec, Scene};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::transfer::{Apic, Flip, Pic, Transfer};
use transpoint::variants::Blend;
use transpoint::{Settings, Solver, Variant};

const NAN: [f64; 4] = [f64::NAN; 4];
const HALF_FLIP: Flip = Flip { blend: Blend::PerStep(0.5) };

/// Where the point's four nodes are, m.
const NODES: [[f64; 2]; 4] = [[2.0, 0.5], [2.0, 1.0], [4.0, 0.5], [4.0, 1.0]];

/// p = 9 · (4 − 2) = 18 Pa in a volume of 2/4 m².
fn scene() -> Scene<2> {
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [2.0, 0.5], cells: [3; 2] },
        [[Boundary::Slip; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 2.0, sound_speed: 3.0 },
        vec![PointSpec {
            velocity_gradient: [[2.0, -1.0], [0.5, 4.0]],
            ..PointSpec::new([2.5, 0.75], [1.0, -3.0], 4.0, 2.0)
        }],
    )
}

type One<X> = Solver<f64, 2, Scheme<Linear, Carried, Particle, X>, Inviscid>;

/// The point with every node row NaN.
fn one_point<X: Transfer<f64, 2>>(transfer: X) -> One<X> {
    let mut solver = solver(&scene(), scheme(Linear, Carried, Particle, transfer));
    let nodes = &mut solver.nodes;
    nodes.rebuilt = vec![NAN; 4];
    for rows in [&mut nodes.transfer, &mut nodes.force, &mut nodes.velocity, &mut nodes.increment] {
        assert_eq!(rows.len(), 4);
        rows.fill(NAN);
    }
    solver
}

#[test]
fn bin_sorts_points_and_drops_absent_ones_without_reading_their_state() {
    let mut scene = scene();
    let point = scene.points[0];
    let at = |x, y| PointSpec { position: [x, y], ..point };
    scene.points = vec![at(5.0, 1.2), at(0.5, 0.2), at(5.5, 1.3), at(2.5, 0.7)];
    let mut solver = solver::<f64, 2, _>(&scene, scheme(Linear, Carried, Particle, HALF_FLIP));
    assert_eq!(solver.particles.id, [1, 3, 0, 2]);
    assert_eq!(solver.particles.cell, [0, 4, 8, 8]);
    let particles = &mut solver.particles;
    particles.cell = vec![7, ABSENT, 7, 2];
    particles.position.fill([f64::NAN; 2]);
    particles.velocity.fill([f64::NAN; 2]);
    particles.density.fill(f64::NAN);
    particles.mass.fill(f64::NAN);
    solver.bin_particles();
    assert_eq!(solver.particles.id, [2, 1, 0]);
    assert_eq!((&solver.cells.index[..], &solver.cells.first[..]), (&[2, 7][..], &[0, 1, 3][..]));
    // Nodes 2, 3 of rows 0, 1 and nodes 1, 2 of rows 2, 3; four to a row.
    assert_eq!(solver.nodes.index, [2, 3, 6, 7, 9, 10, 13, 14]);
    assert_eq!(solver.counters.n_sorts, 2);
}

#[test]
fn points_in_order_are_not_sorted_again() {
    let mut solver = one_point(HALF_FLIP);
    assert_eq!(solver.counters.n_sorts, 1);
    solver.bin_particles();
    assert_eq!(solver.counters.n_sorts, 1);
}

#[test]
fn particles_to_grid_gives_mass_momentum_and_force() {
    let mut solver = one_point(HALF_FLIP);
    scatter(&mut solver, 0.0);
    // m N (v, 1) with N = ¾·½ and ¼·½; V p ∇N with V p = 9 Pa m².
    assert_eq!(
        solver.nodes.transfer.iter().map(|row| [row[0], row[1], row[3]]).collect::<Vec<_>>(),
        [[0.75, -2.25, 0.75], [0.75, -2.25, 0.75], [0.25, -0.75, 0.25], [0.25, -0.75, 0.25]]
    );
    assert_eq!(
        solver.nodes.force,
        [
            [-2.25, -13.5, 0.0, 0.75],
            [-2.25, 13.5, 0.0, 0.75],
            [2.25, -4.5, 0.0, 0.25],
            [2.25, 4.5, 0.0, 0.25]
        ]
    );
    for row in &solver.nodes.velocity {
        // Division by the mass as a product with its rounded inverse.
        near("v_x", row[0], 1.0, f64::EPSILON).unwrap();
        near("v_y", row[1], -3.0, 3.0 * f64::EPSILON).unwrap();
    }
}

#[test]
fn affine_particles_to_grid_adds_the_field_about_the_point() {
    let mut solver = one_point(Apic);
    assert_eq!(solver.particles.affine, [Tensor([[2.0, -1.0], [0.5, 4.0]])]);
    scatter(&mut solver, 0.0);
    // v + C (x_I − x_p) with x_I − x_p = (−½, ∓¼) and (3/2, ∓¼).
    let velocities = [[0.25, -4.25], [-0.25, -2.25], [4.25, -3.25], [3.75, -1.25]];
    let masses = [0.75, 0.75, 0.25, 0.25];
    for (row, (v, mass)) in solver.nodes.transfer.iter().zip(velocities.into_iter().zip(masses)) {
        assert_eq!([row[0], row[1], row[3]], [mass * v[0], mass * v[1], mass]);
    }
}

#[test]
fn update_grid_adds_acceleration_and_constrains_the_walls() {
    let mut solver = one_point(HALF_FLIP);
    solver.physics.body_force = [0.0, -8.0];
    // Points and transfer sums are spent.
    solver.particles.velocity[0] = [f64::NAN; 2];
    solver.particles.density[0] = f64::NAN;
    solver.nodes.velocity.fill(velocity_row([1.0, 2.0]));
    solver.nodes.force = vec![[3.0, -1.0, 0.0, 0.5], [0.0, 0.0, 0.0, 0.0], NAN, NAN];
    solver.nodes.force[2] = [1.0, 1.0, 0.0, 4.0];
    solver.nodes.force[3] = [0.0, 2.0, 0.0, 1.0];
    solver.update_grid(0.25);
    let found = |rows: &[[f64; 4]]| rows.iter().map(|row| [row[0], row[1]]).collect::<Vec<_>>();
    // ¼ (f/m + b); a node without mass keeps its velocity.
    let increments = [[1.5, -2.5], [0.0, 0.0], [0.0625, -1.9375], [0.0, -1.5]];
    assert_eq!(found(&solver.nodes.increment), increments);
    let velocities = increments.map(|[x, y]| [1.0 + x, 2.0 + y]);
    assert_eq!(found(&solver.nodes.velocity), velocities);
}

/// v = (1 + 2 x − y, 3 + ½ x + 4 y) and Δv = (½ x, y) on the nodes.
fn fill_nodes<X: Transfer<f64, 2>>(solver: &mut One<X>) {
    solver.nodes.velocity =
        NODES.map(|[x, y]| velocity_row([1.0 + 2.0 * x - y, 3.0 + 0.5 * x + 4.0 * y])).to_vec();
    if X::USES_INCREMENT {
        solver.nodes.increment = NODES.map(|[x, y]| [0.5 * x, y, 0.0, 0.0]).to_vec();
    }
    // Masses are not gathered.
    solver.particles.mass[0] = f64::NAN;
}

/// The nodes' velocity at the point.
const GATHERED: [f64; 2] = [5.25, 7.25];

#[test]
fn flip_blends_the_increment_with_the_gathered_velocity() {
    let mut solver = one_point(HALF_FLIP);
    fill_nodes(&mut solver);
    gather(&mut solver, VELOCITY, 0.125).unwrap();
    // ½ (v + Δv) + ½ v⁺ with Δv = (1.25, 0.75).
    assert_eq!(
        solver.particles.velocity,
        [[0.5 * (1.0 + 1.25 + 5.25), 0.5 * (-3.0 + 0.75 + 7.25)]]
    );
    assert_eq!((solver.particles.position[0], solver.particles.density[0]), ([2.5, 0.75], 4.0));
}

#[test]
fn pic_and_apic_read_neither_the_old_velocity_nor_the_increment() {
    let mut pic = one_point(Pic);
    let mut apic = one_point(Apic);
    pic.particles.velocity[0] = [f64::NAN; 2];
    apic.particles.velocity[0] = [f64::NAN; 2];
    apic.particles.affine[0] = Tensor([[f64::NAN; 2]; 2]);
    fill_nodes(&mut pic);
    fill_nodes(&mut apic);
    gather(&mut pic, VELOCITY, 0.125).unwrap();
    gather(&mut apic, VELOCITY, 0.125).unwrap();
    assert_eq!((pic.particles.velocity[0], apic.particles.velocity[0]), (GATHERED, GATHERED));
    for (row, exact) in apic.particles.affine[0].0.iter().zip([[2.0, -1.0], [0.5, 4.0]]) {
        // D_p = (¾, 1/16) m²; ¾ has no exact inverse.
        near("C", row[0], exact[0], 4.0 * f64::EPSILON).unwrap();
        assert_eq!(row[1], exact[1]);
    }
}

#[test]
fn density_follows_the_divergence_at_the_point() {
    let mut solver = one_point(HALF_FLIP);
    fill_nodes(&mut solver);
    solver.nodes.increment.fill(NAN);
    gather(&mut solver, STATE, 0.125).unwrap();
    assert_eq!(solver.particles.density, [4.0 / (1.0 + 0.125 * 6.0)]);
    assert_eq!(
        (solver.particles.position[0], solver.particles.velocity[0]),
        ([2.5, 0.75], [1.0, -3.0])
    );
}

#[test]
fn motion_takes_the_gathered_velocity_and_finds_the_new_cell() {
    let mut solver = one_point(HALF_FLIP);
    fill_nodes(&mut solver);
    solver.nodes.increment.fill(NAN);
    gather(&mut solver, MOTION, 0.0625).unwrap();
    assert_eq!(solver.particles.position, [[2.5 + 5.25 / 16.0, 0.75 + 7.25 / 16.0]]);
    assert_eq!((solver.particles.cell[0], solver.counters.n_points_removed), (5, 0));
}

/// x_n = x_0 + n Δt v_0 + ½ n (n + 1) Δt² g wherever the point is in its cell, up to round-off.
#[test]
fn a_point_alone_falls_freely() {
    let mut random = Random(3);
    for variant in Variant::ALL {
        for _ in 0..5 {
            let mut scene = Block::<2>::full(12, Boundary::Free).scene();
            scene.body_force = [1.0, -9.81];
            scene.points.truncate(1);
            scene.points[0].position = std::array::from_fn(|_| 0.4 + 0.2 * random.unit());
            scene.points[0].velocity = [0.3, 1.0];
            let (start, dt, n) = (scene.points[0], 2e-3, 50.0);
            let mut simulation = scene.build(variant, &Settings::default());
            for _ in 0..50 {
                simulation.step(dt).unwrap();
            }
            let point = simulation.observe().points[0];
            for axis in 0..2 {
                let (v, g) = (start.velocity[axis], scene.body_force[axis]);
                let fall = n * dt * v + 0.5 * n * (n + 1.0) * dt * dt * g;
                near(variant.name(), point.position[axis], start.position[axis] + fall, 1e-14)
                    .unwrap();
                near(variant.name(), point.velocity[axis], v + n * dt * g, 1e-14).unwrap();
            }
            near(variant.name(), point.density, start.density, 1e-10).unwrap();
        }
    }
}

#[test]
fn a_velocity_that_is_not_finite_ends_the_run() {
    let mut solver = one_point(HALF_FLIP);
    solver.particles.velocity[0][1] = f64::NAN;
    let error = solver.advance(1e-3).unwrap_err();
    let StepError::NotFinite { id: 0, field: "velocity", time: 0.0 } = error else {
        panic!("{error}");
    };
}

#[test]
fn a_density_that_is_not_finite_ends_the_run() {
    let mut solver =
        solver::<f64, 2, _>(&scene(), scheme(QuadraticBspline, Carried, Particle, Pic));
    solver.particles.density[0] = f64::INFINITY;
    assert!(matches!(solver.advance(1e-3), Err(StepError::NotFinite { id: 0, .. })));
}
