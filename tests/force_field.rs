//! A field of force: at the nodes and the time of the step's start, its impulse, limits, errors, threads.

use crate::common::near;
use crate::common::phases::{scheme, solver, velocity_row};
use crate::common::scenes::{Block, Build, DENSITY, run};
use rayon::ThreadPoolBuilder;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{
    Boundary, CentralForce, EquationOfStateSpec, ForceField, GridSpec, PointSpec, Scene,
};
use transpoint::shape::Linear;
use transpoint::transfer::Pic;
use transpoint::{Settings, Variant};

const DT: f64 = 1e-3;
/// Those whose points are the samples, so that mass and momentum of points and nodes are the same.
const SUMMED: [Variant; 5] =
    [Variant::Pic, Variant::Mpm, Variant::Gimp, Variant::Bspline2, Variant::Apic];

/// The same everywhere, m/s².
fn tide(time: f64) -> [f64; 2] {
    [3.0 * (40.0 * time).cos(), -2.0 + 50.0 * time]
}

/// Linear in place, so that what nodes feel is what points would feel, m/s².
fn stretched([x, y]: [f64; 2], time: f64) -> [f64; 2] {
    let [a, b] = tide(time);
    [a + 4.0 * x - y, b + 2.0 * x - 3.0 * y]
}

/// One point in cells of 2 m × 0.5 m, without pressure and all but without sound.
fn lone(field: impl Fn([f64; 2], f64) -> [f64; 2] + Send + Sync + 'static) -> Scene<2> {
    let mut scene = Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [2.0, 0.5], cells: [6; 2] },
        [[Boundary::Slip; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 2.0, sound_speed: 1e-12 },
        vec![PointSpec::new([4.5, 1.25], [0.25, -0.125], 2.0, 0.5)],
    );
    scene.force_field = Some(ForceField::new("tide", field));
    scene
}

/// A block in the middle of a box that it does not fill.
fn block(field: impl Fn([f64; 2], f64) -> [f64; 2] + Send + Sync + 'static) -> Scene<2> {
    let mut block = Block::<2>::full(12, Boundary::Free);
    (block.fluid, block.jitter) = ([[4.0, 8.0]; 2], 0.3);
    let mut scene = block.scene();
    scene.force_field = Some(ForceField::new("field", field));
    scene
}

#[test]
fn nodes_with_mass_get_the_acceleration_of_their_place_and_time() {
    let scene = lone(|[x, y], t| [x, y + 8.0 * t]);
    let mut solver = solver::<f64, 2, _>(&scene, scheme(Linear, Carried, Particle, Pic));
    solver.nodes.velocity.fill(velocity_row([1.0, 2.0]));
    solver.nodes.force = vec![[0.0, 0.0, 0.0, 0.5]; 4];
    solver.nodes.force[1] = [0.0; 4];
    solver.nodes.transfer = solver.nodes.force.clone();
    solver.time = 0.5;
    solver.update_grid(0.25);
    let found: Vec<_> = solver.nodes.increment.iter().map(|row| [row[0], row[1]]).collect();
    // Nodes at x = 4, 6 and y = 1, 1½: ¼ (x, y + 4).
    assert_eq!(found, [[1.0, 1.25], [0.0, 0.0], [1.5, 1.25], [1.5, 1.375]]);
    let ends: Vec<_> = solver.nodes.velocity.iter().map(|row| [row[0], row[1], row[3]]).collect();
    assert_eq!(ends, [[2.0, 3.25, 3.25], [1.0, 2.0, 2.0], [2.5, 3.25, 3.25], [2.5, 3.375, 3.375]]);
}

/// v = Δt Σ b(t_n), x − x₀ = Δt Σ v: a uniform field moves a block and does not press it.
#[test]
fn a_uniform_field_moves_a_block_as_its_sum_says() {
    let scene = block(|_, t| tide(t));
    for variant in [&SUMMED[..], &[Variant::TpmVpQuadratic]].concat() {
        let found = run(&scene, variant, &Settings::default(), (40, DT)).observe();
        let (mut v, mut moved) = ([0.0; 2], [0.0; 2]);
        for step in 0..40 {
            for axis in 0..2 {
                v[axis] += DT * tide(f64::from(step) * DT)[axis];
                moved[axis] += DT * v[axis];
            }
        }
        for (point, start) in found.points.iter().zip(&scene.points) {
            for axis in 0..2 {
                let path = point.position[axis] - start.position[axis];
                // Round-off of 40 steps, and of fits where a cut cell has few points.
                near(variant.name(), point.velocity[axis], v[axis], 1e-10).unwrap();
                near(variant.name(), path, moved[axis], 1e-11).unwrap();
            }
            near(variant.name(), point.density / DENSITY, 1.0, 1e-10).unwrap();
        }
    }
}

/// Mass stays, and momentum changes by Σ Δt Σ m b(x, t_n), of a field that is linear in place.
#[test]
fn momentum_changes_by_the_impulse_of_the_field() {
    let scene = block(stretched);
    for variant in SUMMED {
        let mut simulation = scene.build(variant, &Settings::default());
        let start = simulation.conserved();
        let mut impulse = start.momentum;
        for _ in 0..30 {
            let time = simulation.time();
            simulation.visit_points(&mut |point| {
                let b = stretched(point.position, time);
                for axis in 0..2 {
                    impulse[axis] += DT * point.mass * b[axis];
                }
            });
            simulation.step(DT).unwrap();
        }
        let end = simulation.conserved();
        near(variant.name(), end.mass, start.mass, 1e-12 * start.mass).unwrap();
        for (found, expected) in end.momentum.into_iter().zip(impulse) {
            // The impulse is of the order of 0.1 m/s times the mass.
            near(variant.name(), found, expected, 1e-12 * start.mass).unwrap();
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let mut scene = Block::<2>::full(64, Boundary::Slip).random(3).scene();
    scene.force_field = Some(ForceField::new("stretched", stretched));
    let on = |n_threads| {
        let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| run(&scene, Variant::Mpm, &Settings::default(), (4, DT)).observe())
    };
    assert!(on(1) == on(2));
}

/// A field −Ω² (x − x_c) and a central force are the same numbers.
#[test]
fn a_field_does_what_a_central_force_does() {
    let force = CentralForce { center: [0.6, 0.72], rate: 3.0 };
    let field =
        block(move |place, _| std::array::from_fn(|axis| 9.0 * (force.center[axis] - place[axis])));
    let mut central = field.clone();
    (central.force_field, central.central_force) = (None, Some(force));
    let end =
        |scene: &Scene<2>| run(scene, Variant::Apic, &Settings::default(), (20, DT)).observe();
    assert!(end(&field) == end(&central));
}

#[test]
fn it_limits_the_time_step() {
    // 0.25 √(h/b) with b = (2, 1).
    let scene = lone(|_, _| [2.0, 1.0]);
    let limit = scene.build(Variant::Mpm, &Settings::default()).stable_dt(1.0);
    assert_eq!((limit.dt, limit.limit), (0.25 * 0.5_f64.sqrt(), "body-force"));
}

#[test]
fn what_is_not_finite_is_refused_and_only_copies_are_equal() {
    let scene = lone(|[x, _], _| [1.0 / (x - 4.5), 0.0]);
    let built = Variant::Mpm.build_2d(&scene, &Settings::default());
    let error = built.err().map(|error| error.to_string()).unwrap_or_default();
    let expected =
        "force_field: `tide` with [inf, 0.0] is not allowed; finite at points[0], in m/s²";
    assert_eq!(error, expected);
    assert_eq!(
        format!("{:?}", scene.force_field.as_ref().unwrap()),
        "ForceField { name: \"tide\", .. }"
    );
    assert_eq!(scene, scene.clone());
    assert_ne!(scene, lone(|[x, _], _| [1.0 / (x - 4.5), 0.0]));
}
