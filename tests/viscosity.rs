//! Newtonian stress where a scene asks for it, and no byte of it elsewhere.

use crate::common::checks::shear_wave_decays;
use crate::common::near;
use crate::common::parts::{FLIP, MIXED, mls};
use crate::common::phases::{scatter, scheme};
use crate::common::scenes::{Block, Build, DENSITY};
use transpoint::material::{Deviatoric, Inviscid, Material};
use transpoint::math::Tensor;
use transpoint::particles::Particles;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::Boundary;
use transpoint::shape::Linear;
use transpoint::shape::QuadraticBspline;
use transpoint::transfer::{Apic, Transfer};
use transpoint::variants::{Fields, Kernel, TransferKind};
use transpoint::{Settings, Solver, Variant};

const VISCOSITY: f64 = 0.25;

/// An affine point gives its nodes its whole velocity field, whose gradient is then gathered.
fn stress_of(gradient: [[f64; 2]; 2]) -> ([[f64; 2]; 2], f64) {
    let mut scene = Block::<2>::full(9, Boundary::Free).scene();
    scene.points.truncate(1);
    scene.points[0].position = [0.43, 0.52];
    scene.points[0].velocity_gradient = gradient;
    let method = scheme(QuadraticBspline, Carried, Particle, Apic);
    let mut solver =
        Solver::new(&scene, method, Deviatoric::Newtonian { viscosity: VISCOSITY }).unwrap();
    solver.advance(0.0).unwrap();
    (solver.particles.state[0].0, solver.particles.density[0])
}

/// s = 2 ρ ν dev(sym L); the trace is taken in three dimensions.
#[test]
fn stress_is_that_of_the_velocity_gradient() {
    let shear = 0.8;
    let (found, density) = stress_of([[0.0, shear], [0.0, 0.0]]);
    let stress = density * VISCOSITY * shear;
    let squeeze = stress_of([[0.3, 0.0], [0.0, 0.6]]).0;
    let dynamic = DENSITY * VISCOSITY;
    for (found, exact) in [
        (found, [[0.0, stress], [stress, 0.0]]),
        (squeeze, [[dynamic * (0.6 - 0.6), 0.0], [0.0, dynamic * (1.2 - 0.6)]]),
    ] {
        for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
            near("stress", *found, *exact, 1e-12 * dynamic).unwrap();
        }
    }
}

#[test]
fn a_spinning_point_has_no_stress() {
    let (found, _) = stress_of([[0.0, -2.0], [2.0, 0.0]]);
    for entry in found.into_iter().flatten() {
        near("stress", entry, 0.0, 1e-12 * DENSITY * VISCOSITY).unwrap();
    }
}

/// f = −V s ∇N: a shear stress pulls the nodes above the point along, and those below back.
#[test]
fn a_stressed_point_pulls_its_nodes() {
    let mut scene = Block::<2>::full(3, Boundary::Free).scene();
    scene.points.truncate(1);
    scene.points[0].position = [0.15, 0.18];
    let method = scheme(Linear, Carried, Particle, FLIP);
    let mut solver =
        Solver::<f64, 2, _, _>::new(&scene, method, Deviatoric::Newtonian { viscosity: 1.0 })
            .unwrap();
    solver.particles.state[0] = Tensor([[0.0, 5.0], [5.0, 0.0]]);
    scatter(&mut solver, 0.0);
    let volume = scene.points[0].mass / DENSITY;
    // Weights ½ across; gradients ± 1/h.
    let (along_x, along_y) = (volume * 5.0 * 0.5 / 0.12, volume * 5.0 * 0.5 / 0.1);
    let signs = [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
    for (force, [x, y]) in solver.nodes.force.iter().zip(signs) {
        near("f_x", force[0], x * along_x, 1e-14 * along_x).unwrap();
        near("f_y", force[1], y * along_y, 1e-14 * along_y).unwrap();
    }
}

/// u = U sin(k y) e^{−ν k² t}; the lattice does not move across the shear.
#[test]
fn a_shear_wave_decays_at_the_viscous_rate() {
    shear_wave_decays(
        scheme(QuadraticBspline, Carried, Particle, FLIP),
        Deviatoric::Newtonian { viscosity: 0.2 },
    )
    .unwrap();
    shear_wave_decays(scheme(Linear, mls(), MIXED, FLIP), Deviatoric::Newtonian { viscosity: 0.2 })
        .unwrap();
}

#[test]
fn a_shear_wave_stays_without_viscosity() {
    let method = scheme(QuadraticBspline, Carried, Particle, FLIP);
    assert!(shear_wave_decays(method, Inviscid).is_err());
}

/// A point holds position, velocity, density, mass, identifier and cell; the affine field, the slope of the density and
/// the stress only where there are any.
#[test]
fn points_carry_what_their_scene_and_method_need() {
    fn check<const D: usize>()
    where
        transpoint::Scene<D>: Build<D>,
    {
        let scene = Block::<D>::full(4, Boundary::Periodic).scene();
        let mut viscous = scene.clone();
        viscous.viscosity = Some(1e-3);
        let (plain, tensor) = (8 + 16 * D + 16, 8 * D * D);
        for variant in Variant::ALL {
            let bytes = |scene: &transpoint::Scene<D>| {
                scene.build(variant, &Settings::default()).bytes_per_point()
            };
            let parts = variant.parts();
            let affine = if parts.transfer == TransferKind::Flip { 0 } else { tensor };
            let stretches = parts.kernel == Kernel::ConvectedGimp
                || matches!(
                    variant,
                    Variant::MpmSplit | Variant::CellAdjoint | Variant::CellAdjointAffine
                );
            let length = if stretches { 8 * D } else { 0 };
            let has_slope = matches!(variant, Variant::TpmAffine | Variant::CellAdjointAffine);
            let slope = if has_slope { 8 * D } else { 0 };
            // Rivals, and all in one dimension, have room for energy and viscous pressure beside stress.
            let has_own = parts.transfer != TransferKind::Tpic
                && matches!(parts.fields, Fields::Carried | Fields::TransportPoints);
            let unused = if has_own && D > 1 { 0 } else { 16 };
            let carried = plain + affine + length + slope;
            assert_eq!(bytes(&scene), carried, "{} in {D}D", variant.name());
            assert_eq!(bytes(&viscous), carried + tensor + unused, "{} in {D}D", variant.name());
        }
    }
    check::<1>();
    check::<2>();
    check::<3>();
}

#[test]
fn absent_ingredients_take_no_memory() {
    assert_eq!(size_of::<<Inviscid as Material<f64, 3>>::State>(), 0);
    assert_eq!(size_of::<<transpoint::transfer::Flip as Transfer<f64, 3>>::Affine>(), 0);
    assert_eq!(size_of::<<transpoint::transfer::Pic as Transfer<f64, 3>>::Affine>(), 0);
    assert_eq!((size_of::<Inviscid>(), size_of::<Particle>(), size_of::<Carried>()), (0, 0, 0));
    assert_eq!(Particles::<f32, 2, (), ()>::bytes_per_point(), 8 + 16 + 8);
    assert_eq!(Particles::<f64, 2, (), Tensor<f64, 2>>::bytes_per_point(), 8 + 32 + 16 + 32);
}
