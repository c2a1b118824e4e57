//! Deliberately wrong parts: the checks of the suite pass the real part and flag its mutant.

mod wrong;

use crate::common::Check;
use crate::common::checks::{
    affine_field_survives, density_follows_affine_flow, interior_force_is, nodes_hold_the_mass,
    point_divergence_is_linear, shape_is_linear, shear_wave_decays, steps_keep_totals,
    transfer_keeps_totals, velocities_stay_without_force,
};
use crate::common::clouds::{CloudData, reproduces};
use crate::common::gas::energy_is_kept;
use crate::common::parts::{DT, FLIP, block, mls};
use crate::common::phases::scheme;
use crate::common::scenes::Block;
use transpoint::formulation::PointDivergence;
use transpoint::material::{Deviatoric, General};
use transpoint::quadrature::{Mixed, Particle};
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, Scene};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::transfer::{Apic, Transfer};
use transpoint::variants::{BulkViscosity, EnergyUpdate, PointVolume};
use wrong::{
    ALL_FULL, Affine, Antiviscous, DOUBLE, DroppedTerms, FLIPPED, Heatless, LOPSIDED, NO_WALLS,
    Overshoot, STEEP, Spline, TRANSPOSED, Tilted, UNSCALED, Wrong,
};

/// The real part must pass and the mutant must not.
fn flags(mutant: &str, [real, wrong]: [Check; 2]) {
    assert_eq!(real, Ok(()), "the real part in place of '{mutant}' fails");
    assert!(wrong.is_err(), "nothing flags '{mutant}'");
}

fn free_block() -> Scene<2> {
    block((4, false)).scene()
}

#[test]
fn spline_without_its_walls_is_flagged() {
    flags("no walls", [shape_is_linear(&QuadraticBspline), shape_is_linear(&Spline::<NO_WALLS>)]);
}

#[test]
fn steep_gradient_is_flagged() {
    flags("steep", [shape_is_linear(&QuadraticBspline), shape_is_linear(&Spline::<STEEP>)]);
    let real = density_follows_affine_flow(scheme(QuadraticBspline, Carried, Particle, Apic));
    let wrong = density_follows_affine_flow(scheme(Spline::<STEEP>, Carried, Particle, Apic));
    flags("steep", [real, wrong]);
}

#[test]
fn lopsided_weights_are_flagged() {
    let scene = free_block();
    flags(
        "lopsided",
        [
            transfer_keeps_totals::<f64, _, 2>(
                &scene,
                scheme(QuadraticBspline, Carried, Particle, Apic),
                (true, 16.0),
            ),
            transfer_keeps_totals::<f64, _, 2>(
                &scene,
                scheme(Spline::<LOPSIDED>, Carried, Particle, Apic),
                (true, 16.0),
            ),
        ],
    );
}

#[test]
fn reconstruction_without_linear_terms_is_flagged() {
    let data = CloudData::<f64, 2>::new(
        &Block { jitter: 0.25, ..Block::<2>::full(5, Boundary::Slip).random(1) }.scene(),
    );
    let check = |r| reproduces(&data, &r, 1, 1e-12);
    flags("dropped terms", [reproduces(&data, &mls(), 1, 1e-12), check(DroppedTerms)]);
}

fn keeps_affine_field(transfer: impl Transfer<f64, 2>) -> Check {
    affine_field_survives(free_block(), scheme(QuadraticBspline, Carried, Particle, transfer))
}

#[test]
fn wrong_affine_fields_are_flagged() {
    let real = keeps_affine_field(Apic);
    flags("sign flipped", [real.clone(), keeps_affine_field(Affine::<FLIPPED>)]);
    flags("transposed", [real.clone(), keeps_affine_field(Affine::<TRANSPOSED>)]);
    flags("wrong second moment", [real, keeps_affine_field(Affine::<UNSCALED>)]);
}

#[test]
fn spin_of_the_wrong_sign_is_flagged() {
    let (scene, limits) = (free_block(), (true, 64.0));
    flags(
        "spin transposed",
        [
            steps_keep_totals::<f64, _, 2>(
                &scene,
                scheme(QuadraticBspline, Carried, Particle, Apic),
                (3, DT),
                limits,
            ),
            steps_keep_totals::<f64, _, 2>(
                &scene,
                scheme(QuadraticBspline, Carried, Particle, Affine::<TRANSPOSED>),
                (3, DT),
                limits,
            ),
        ],
    );
}

#[test]
fn overshooting_flip_is_flagged() {
    let scene = free_block();
    flags(
        "overshoot",
        [
            velocities_stay_without_force(
                &scene,
                scheme(QuadraticBspline, Carried, Particle, FLIP),
            ),
            velocities_stay_without_force(
                &scene,
                scheme(QuadraticBspline, Carried, Particle, Overshoot),
            ),
        ],
    );
}

#[test]
fn wrong_volumes_are_flagged() {
    // Half of each cell at the surface is filled.
    let lattice = Block { fluid: [[2.0, 6.5]; 2], ..Block::<2>::full(9, Boundary::Free) };
    let scene = lattice.scene();
    let mixed = Mixed::new(PointVolume::CarriedCapped);
    let real = nodes_hold_the_mass(&scene, scheme(Linear, mls(), mixed, FLIP));
    let double = nodes_hold_the_mass(&scene, scheme(Linear, mls(), Wrong::<DOUBLE>, FLIP));
    let full = nodes_hold_the_mass(&scene, scheme(Linear, mls(), Wrong::<ALL_FULL>, FLIP));
    flags("points counted twice", [real.clone(), double]);
    flags("cut cells taken for full", [real, full]);
}

#[test]
fn stress_of_the_wrong_sign_is_flagged() {
    let method = scheme(QuadraticBspline, Carried, Particle, FLIP);
    flags(
        "stress of the wrong sign",
        [
            shear_wave_decays(method, Deviatoric::Newtonian { viscosity: 0.2 }),
            shear_wave_decays(method, Antiviscous),
        ],
    );
}

#[test]
fn lost_heat_of_the_transfer_is_flagged() {
    let real = General {
        deviatoric: None,
        energy: Some(EnergyUpdate::Work),
        bulk_viscosity: Some(BulkViscosity { linear: 0.2, quadratic: 1.5, expansion: false }),
        cell_size: 0.1,
    };
    flags("lost heat", [energy_is_kept(real), energy_is_kept(Heatless(real))]);
}

#[test]
fn point_divergence_that_bends_lines_is_flagged() {
    let real = |xi: f64| PointDivergence::Linear.weights(xi);
    let mirrored = |xi: f64| PointDivergence::Linear.weights(1.0 - xi);
    flags("mirrored", [point_divergence_is_linear(real), point_divergence_is_linear(mirrored)]);
}

#[test]
fn gradients_that_do_not_cancel_are_flagged() {
    let mut lattice = Block::<2>::full(9, Boundary::Slip);
    lattice.compression = [0.01, 0.0];
    let scene = lattice.scene();
    let force =
        |shape| interior_force_is(&scene, scheme(shape, Carried, Particle, FLIP), [0.0; 2], 64.0);
    let real = interior_force_is(&scene, scheme(Linear, Carried, Particle, FLIP), [0.0; 2], 64.0);
    flags("tilted", [real, force(Tilted)]);
}
