//! Rigid bodies, and sound at outflows.

use crate::common::scenes::{Block, Build, DENSITY, SOUND_SPEED, SPACING};
use transpoint::scene::{
    BodyShape, BodySpec, BodySurface, Boundary, EquationOfStateSpec, GridSpec, PointSpec,
    Relaxation, Scene,
};
use transpoint::variants::{Blend, Rearrangement, Shift};
use transpoint::{Settings, Variant};

const DT: f64 = 0.2 * 0.09 / SOUND_SPEED;

/// A periodic box with a body in its middle and disordered fluid around it.
fn around<const D: usize>(shape: BodyShape<D>, surface: BodySurface, seed: u64) -> Scene<D> {
    let mut scene = Block::<D>::full(6, Boundary::Periodic).random(seed).scene();
    let spacing = scene.grid.spacing;
    scene.points.retain(|point| {
        let center =
            std::array::from_fn(|a| ((point.position[a] / spacing[a]).floor() + 0.5) * spacing[a]);
        shape.level(center) >= 0.0
    });
    scene.bodies.push(BodySpec { shape, surface });
    scene
}

fn ball<const D: usize>() -> BodyShape<D> {
    let center = std::array::from_fn(|axis| 3.0 * SPACING[axis]);
    BodyShape::Ball { center, radius: 0.16 }
}

/// The force is what the fluid loses: Σ m v changes by −F Δt.
fn check_balance<const D: usize>(shape: BodyShape<D>)
where
    Scene<D>: Build<D>,
{
    let variants = [Variant::Mpm, Variant::Gimp, Variant::Bspline2, Variant::Apic, Variant::MpmVp];
    for variant in variants {
        for (surface, blend) in [
            (BodySurface::NoSlip, 1.0),
            (BodySurface::Slip, 1.0),
            (BodySurface::NoSlip, 0.6),
            (BodySurface::Slip, 0.0),
        ] {
            let settings = Settings { blend: Blend::PerStep(blend), ..Settings::default() };
            let mut simulation = around(shape, surface, 7).build(variant, &settings);
            let mut largest = 0.0_f64;
            for _ in 0..5 {
                let before = simulation.conserved();
                simulation.step(DT).unwrap();
                let after = simulation.conserved();
                for axis in 0..D {
                    let change = after.momentum[axis] - before.momentum[axis];
                    let impulse = simulation.body_forces()[0][axis] * DT;
                    largest = largest.max(impulse.abs());
                    let error = (change + impulse).abs() / before.mass;
                    assert!(
                        error < 1e-13,
                        "{} {surface:?} {blend}: {change} {impulse}",
                        variant.name()
                    );
                }
            }
            assert!(largest > 1e-3, "{} {surface:?}: no force", variant.name());
        }
    }
}

#[test]
fn the_force_is_the_momentum_that_the_fluid_loses_in_2d() {
    check_balance::<2>(ball());
    check_balance::<2>(BodyShape::Box { lower: [0.2, 0.24], upper: [0.4, 0.48] });
}

#[test]
fn the_force_is_the_momentum_that_the_fluid_loses_in_3d() {
    check_balance::<3>(ball());
}

/// Fluid under hydrostatic pressure presses on a body with the weight of what it displaces: with points on a
/// lattice every rule integrates a linear pressure exactly.
#[test]
fn a_body_in_water_at_rest_is_lifted_by_the_weight_of_its_volume() {
    let gravity = 0.5;
    let h = 0.05;
    let cells = [16, 20];
    let shape = BodyShape::Box { lower: [0.3, 0.3], upper: [0.5, 0.5] };
    let surface = 0.8;
    let mut points = Vec::new();
    for i in 0..2 * cells[0] {
        for j in 0..2 * (surface / h) as usize {
            let position = [(i as f64 + 0.5) * 0.5 * h, (j as f64 + 0.5) * 0.5 * h];
            let density = DENSITY * (1.0 + gravity * (surface - position[1]) / SOUND_SPEED.powi(2));
            if shape.level(position) > 0.0 {
                points.push(PointSpec::new(position, [0.0; 2], density, density * 0.25 * h * h));
            }
        }
    }
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: DENSITY,
        sound_speed: SOUND_SPEED,
    };
    let grid = GridSpec { origin: [0.0; 2], spacing: [h; 2], cells };
    let mut scene = Scene::new(grid, [[Boundary::Slip; 2]; 2], law, points);
    scene.body_force = [0.0, -gravity];
    scene.bodies.push(BodySpec { shape, surface: BodySurface::Slip });
    // Wider functions spread the pressure to nodes beyond the body.
    for variant in [Variant::Mpm, Variant::MpmVp, Variant::TpmVpQuadratic] {
        let mut simulation = scene.build(variant, &Settings::default());
        simulation.step(1e-6).unwrap();
        let force = simulation.body_forces()[0];
        let lift = DENSITY * gravity * 0.2 * 0.2;
        // The water is denser than ρ₀ by gH/c² at most.
        assert!((force[1] / lift - 1.0).abs() < 4e-3, "{}: {force:?} {lift}", variant.name());
        assert!(force[0].abs() < 1e-9 * lift, "{}: {force:?}", variant.name());
    }
}

#[test]
fn cells_of_a_body_are_not_empty_neighbors() {
    // Full of fluid but for the body: no cell is cut by a surface, so that cell centers are the samples.
    let mut simulation =
        around::<2>(ball(), BodySurface::NoSlip, 3).build(Variant::Tpm, &Settings::default());
    simulation.step(DT).unwrap();
    let counters = simulation.counters();
    assert_eq!(counters.n_samples, counters.n_cell_updates);
}

#[test]
fn points_that_are_pushed_apart_stay_outside_of_bodies() {
    let shift = Some(Shift { strength: 1.0, interval: 1 });
    let rearrangement = Some(Rearrangement { shift, ..Rearrangement::default() });
    let settings = Settings { rearrangement, ..Settings::default() };
    let scene = around::<2>(ball(), BodySurface::NoSlip, 11);
    let spacing = scene.grid.spacing;
    let mut simulation = scene.build(Variant::TpmVpQuadratic, &settings);
    for _ in 0..5 {
        simulation.step(DT).unwrap();
        simulation.visit_points(&mut |point| {
            let center = std::array::from_fn(|axis| {
                ((point.position[axis] / spacing[axis]).floor() + 0.5) * spacing[axis]
            });
            assert!(ball::<2>().level(center) >= 0.0, "{point:?}");
        });
    }
    assert!(simulation.counters().n_points_shifted > 0);
}

#[test]
fn bad_bodies_are_refused_by_name() {
    let field = |shape: BodyShape<2>| {
        let mut scene = Block::<2>::full(6, Boundary::Slip).scene();
        scene.points.truncate(4);
        scene.bodies.push(BodySpec { shape, surface: BodySurface::Slip });
        scene.bodies[0].surface = BodySurface::NoSlip;
        Variant::Mpm.build_2d(&scene, &Settings::default()).err().map(|error| error.field)
    };
    assert_eq!(field(ball()), None);
    let at = |center| BodyShape::Ball { center, radius: 0.2 };
    assert_eq!(
        field(BodyShape::Ball { center: [0.3; 2], radius: -1.0 }).as_deref(),
        Some("bodies[0].shape.radius")
    );
    assert_eq!(field(at([9.0; 2])).as_deref(), Some("bodies[0]"));
    assert_eq!(field(at([0.0; 2])).as_deref(), Some("points[0].position"));
}

/// A pressure pulse that runs to the upper end of a tube of still water, and its largest pressure after it
/// should have left.
fn echo(face: Boundary) -> f64 {
    let (n, h) = (80, 0.05);
    let pulse = |x: f64| 1e-4 * (-((x - 2.0) / 0.3_f64).powi(2)).exp();
    let points = (0..2 * n)
        .map(|k| {
            let x = (f64::from(k) + 0.5) * 0.5 * h;
            let density = DENSITY * (1.0 + pulse(x));
            PointSpec::new([x], [SOUND_SPEED * pulse(x)], density, density * 0.5 * h)
        })
        .collect();
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: DENSITY,
        sound_speed: SOUND_SPEED,
    };
    let grid = GridSpec { origin: [0.0], spacing: [h], cells: [n as usize] };
    let scene = Scene::new(grid, [[Boundary::Slip, face]], law, points);
    let mut simulation = scene.build(Variant::MpmVp, &Settings::default());
    while simulation.time() < 0.35 {
        simulation.step(0.5 * h / SOUND_SPEED).unwrap();
    }
    let scale = DENSITY * SOUND_SPEED.powi(2) * 1e-4;
    let largest = |most: f64, p: f64| most.max(p.abs());
    simulation.observe().points.iter().map(|point| point.pressure).fold(0.0, largest) / scale
}

#[test]
fn a_relaxed_outflow_lets_sound_out() {
    let relaxation = Relaxation { pressure: 0.0, velocity: Some(0.0), time: 0.02, layers: 8 };
    let relaxed = echo(Boundary::Outflow { relaxation: Some(relaxation) });
    let (plain, free) = (echo(Boundary::OUTFLOW), echo(Boundary::Free));
    assert!(free > 0.8, "a free face sends all of it back: {free}");
    assert!(relaxed < 0.1, "{relaxed}, without relaxation {plain}, free {free}");
}

#[test]
fn a_relaxation_out_of_range_is_refused() {
    let mut scene = Block::<2>::full(6, Boundary::Slip).scene();
    let relaxation = Relaxation { pressure: 0.0, velocity: None, time: 0.0, layers: 1 };
    scene.boundaries[1][1] = Boundary::Outflow { relaxation: Some(relaxation) };
    let error = Variant::Mpm.build_2d(&scene, &Settings::default()).err().map(|error| error.field);
    assert_eq!(error.as_deref(), Some("boundaries[1].relaxation"));
}
