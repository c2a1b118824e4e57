//! A force towards a point: at the nodes, on a lone point, in limits and errors.

use crate::common::near;
use crate::common::phases::{scheme, solver, velocity_row};
use crate::common::scenes::Build;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, CentralForce, EquationOfStateSpec, GridSpec, PointSpec, Scene};
use transpoint::shape::Linear;
use transpoint::transfer::Pic;
use transpoint::{Settings, Variant};

const FORCE: CentralForce<2> = CentralForce { center: [5.0, 1.5], rate: 2.0 };

/// One point in cells of 2 m × 0.5 m, without pressure and all but without sound.
fn scene() -> Scene<2> {
    let mut scene = Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [2.0, 0.5], cells: [6; 2] },
        [[Boundary::Slip; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 2.0, sound_speed: 1e-12 },
        vec![PointSpec::new([4.5, 1.25], [0.25, -0.125], 2.0, 0.5)],
    );
    scene.central_force = Some(FORCE);
    scene
}

#[test]
fn nodes_with_mass_get_the_acceleration_of_their_place() {
    let mut solver = solver::<f64, 2, _>(&scene(), scheme(Linear, Carried, Particle, Pic));
    solver.nodes.velocity.fill(velocity_row([1.0, 2.0]));
    solver.nodes.force = vec![[0.0, 0.0, 0.0, 0.5]; 4];
    solver.nodes.force[1] = [0.0; 4];
    solver.nodes.transfer = solver.nodes.force.clone();
    solver.update_grid(0.25);
    let found: Vec<_> = solver.nodes.increment.iter().map(|row| [row[0], row[1]]).collect();
    // Nodes at x = 4, 6 and y = 1, 1½: ¼ · 4 (x_c − x).
    assert_eq!(found, [[1.0, 0.5], [0.0, 0.0], [-1.0, 0.5], [-1.0, 0.0]]);
    let ends: Vec<_> = solver.nodes.velocity.iter().map(|row| [row[0], row[1], row[3]]).collect();
    assert_eq!(ends, [[2.0, 2.5, 2.5], [1.0, 2.0, 2.0], [0.0, 2.5, 2.5], [0.0, 2.0, 2.0]]);
}

/// v' = v − Δt Ω² (x − x_c), x' = x + Δt v': nothing else acts on a lone point.
#[test]
fn a_lone_point_follows_the_recursion_of_the_oscillator() {
    let dt = 0.01;
    for variant in [Variant::Pic, Variant::Mpm, Variant::Gimp, Variant::Bspline2, Variant::Apic] {
        let scene = scene();
        let mut simulation = scene.build(variant, &Settings::default());
        let (mut x, mut v) = (scene.points[0].position, scene.points[0].velocity);
        for _ in 0..400 {
            simulation.step(dt).unwrap();
            for axis in 0..2 {
                v[axis] -= dt * 4.0 * (x[axis] - FORCE.center[axis]);
                x[axis] += dt * v[axis];
            }
        }
        let found = simulation.observe().points[0];
        for axis in 0..2 {
            // 400 steps, each off by a few units in the last place of numbers up to 4.
            near(variant.name(), found.position[axis], x[axis], 1e-11).unwrap();
            near(variant.name(), found.velocity[axis], v[axis], 1e-11).unwrap();
        }
    }
}

#[test]
fn it_limits_the_time_step() {
    // 0.25 √(h/b) with b = (2, 1) at the point, and 2/Ω.
    let mut scene = scene();
    let limit = |scene: &Scene<2>| scene.build(Variant::Mpm, &Settings::default()).stable_dt(1.0);
    assert_eq!((limit(&scene).dt, limit(&scene).limit), (0.25 * 0.5_f64.sqrt(), "body-force"));
    scene.points[0].position = FORCE.center;
    scene.points[0].velocity = [0.0; 2];
    assert_eq!((limit(&scene).dt, limit(&scene).limit), (1.0, "central-force"));
}

#[test]
fn what_it_cannot_go_with_is_refused() {
    let refused = |change: &dyn Fn(&mut Scene<2>)| {
        let mut scene = scene();
        change(&mut scene);
        let built = Variant::Mpm.build_2d(&scene, &Settings::default());
        built.err().map(|error| error.to_string()).unwrap_or_default()
    };
    let force = |center, rate| Some(CentralForce { center, rate });
    assert_eq!(
        refused(&|scene| scene.central_force = force([0.0; 2], 0.0)),
        "central_force.rate: 0 is not allowed; a positive number in 1/s, or no central force"
    );
    assert_eq!(
        refused(&|scene| scene.central_force = force([0.0, f64::NAN], 1.0)),
        "central_force.center[1]: NaN is not allowed; finite, in m"
    );
    let periodic = refused(&|scene| scene.boundaries[0] = [Boundary::Periodic; 2]);
    assert!(periodic.starts_with("central_force: present is not allowed"), "{periodic}");
    assert_eq!(refused(&|_| ()), "");
}
