//! What the transfers and the internal forces conserve, and up to which bound.

use crate::common::checks::{
    affine_field_survives, steps_keep_totals, transfer_keeps_totals, velocities_stay_without_force,
};
use crate::common::parts::{BLEND, DT, FLIP, GIMP, MIXED, block, cases, mls, setup};
use crate::common::phases::{scheme, solver};
use crate::common::scenes::{Block, SPACING};
use crate::common::{Gap, all};
use proptest::prelude::*;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::shape::{CubicBspline, Gimp, Linear, QuadraticBspline};
use transpoint::transfer::{Apic, Flip, Pic, Transfer};
use transpoint::variants::Blend;
use transpoint::{Observation, Scene, Simulation};

/// Points stay away from the nodes: next to one the hat has no stable step.
fn calm<const D: usize>(setup: (u64, bool)) -> Scene<D> {
    Block { jitter: 0.3, ..block::<D>(setup) }.scene()
}

/// Bounds in ε of Σ m |v|: sums over points and nodes are formed in `f64`, so in `f64` the order of
/// summation adds a few ε; in `f32` each node's own sum is rounded.
macro_rules! conservation {
    ($module:ident, $scalar:ty, $dimension:literal, $cases:literal, [$($scheme:expr),+]) => {
        mod $module {
            use super::*;

            proptest! {
                #![proptest_config(cases($cases))]

                #[test]
                fn transfers_keep_mass_and_momentum(setup in setup()) {
                    let (scene, limits) = (block::<$dimension>(setup).scene(), (false, 16.0));
                    $(transfer_keeps_totals::<$scalar, _, $dimension>(&scene, $scheme, limits)
                        .map_err(TestCaseError::fail)?;)+
                }

                #[test]
                fn steps_under_pressure_keep_mass_and_momentum(setup in setup()) {
                    let (scene, limits) = (calm::<$dimension>(setup), (false, 64.0));
                    $(steps_keep_totals::<$scalar, _, $dimension>(&scene, $scheme, (5, DT), limits)
                        .map_err(TestCaseError::fail)?;)+
                }
            }
        }
    };
}

conservation!(
    in_1d_f64,
    f64,
    1,
    32,
    [scheme(Linear, Carried, Particle, FLIP), scheme(CubicBspline, Carried, Particle, Apic)]
);
conservation!(
    in_2d_f64,
    f64,
    2,
    16,
    [
        scheme(Linear, Carried, Particle, FLIP),
        scheme(GIMP, Carried, Particle, BLEND),
        scheme(QuadraticBspline, Carried, Particle, Pic),
        scheme(CubicBspline, Carried, Particle, Apic)
    ]
);
conservation!(
    in_2d_f32,
    f32,
    2,
    16,
    [
        scheme(Gimp { length: 0.5_f32 }, Carried, Particle, BLEND),
        scheme(QuadraticBspline, Carried, Particle, Apic)
    ]
);
conservation!(
    in_3d_f64,
    f64,
    3,
    4,
    [scheme(Linear, Carried, Particle, FLIP), scheme(QuadraticBspline, Carried, Particle, Apic)]
);

proptest! {
    #![proptest_config(cases(8))]

    /// Every shape function keeps the moments `Σ N (x − x_p) = 0`, hence the spin of a point.
    #[test]
    fn affine_transfer_keeps_angular_momentum(seed in any::<u64>()) {
        let (plane, space) = (block::<2>((seed, false)).scene(), block::<3>((seed, false)).scene());
        let limits = (true, 16.0);
        all([
            transfer_keeps_totals::<f64, _, 2>(
                &plane, scheme(Linear, Carried, Particle, Apic), limits),
            transfer_keeps_totals::<f64, _, 2>(
                &plane, scheme(GIMP, Carried, Particle, Apic), limits),
            transfer_keeps_totals::<f64, _, 2>(
                &plane, scheme(QuadraticBspline, Carried, Particle, Apic), limits),
            transfer_keeps_totals::<f64, _, 2>(
                &plane, scheme(CubicBspline, Carried, Particle, Apic), limits),
            transfer_keeps_totals::<f64, _, 3>(
                &space, scheme(QuadraticBspline, Carried, Particle, Apic), limits),
        ]).map_err(TestCaseError::fail)?;
    }

    /// In motion only where the second moment of the weights is the same everywhere, as for B-splines
    /// away from walls; with the hat and uGIMP a point's spin changes as it moves through a cell.
    #[test]
    fn affine_bspline_steps_keep_angular_momentum(seed in any::<u64>()) {
        let (plane, space) = (calm::<2>((seed, false)), calm::<3>((seed, false)));
        let (steps, limits) = ((5, DT), (true, 64.0));
        all([
            steps_keep_totals::<f64, _, 2>(
                &plane, scheme(QuadraticBspline, Carried, Particle, Apic), steps, limits),
            steps_keep_totals::<f64, _, 2>(
                &plane, scheme(CubicBspline, Carried, Particle, Apic), steps, limits),
            steps_keep_totals::<f64, _, 3>(
                &space, scheme(QuadraticBspline, Carried, Particle, Apic), steps, limits),
        ]).map_err(TestCaseError::fail)?;
    }

}

/// Five steps of a blend.
fn observe(transfer: impl Transfer<f64, 2>) -> Observation<2> {
    let scene = block::<2>((4, true)).scene();
    let mut solver = solver::<f64, 2, _>(&scene, scheme(GIMP, Carried, Particle, transfer));
    for _ in 0..5 {
        solver.advance(DT).unwrap();
    }
    solver.observe()
}

#[test]
fn relaxation_time_is_the_constant_blend_of_its_step() {
    let tau = 20.0 * DT;
    let by_time = observe(Flip { blend: Blend::RelaxationTime(tau) });
    assert_eq!(by_time, observe(Flip { blend: Blend::PerStep(1.0 - DT / tau) }));
    assert_ne!(by_time, observe(FLIP));
}

#[test]
fn relaxation_time_below_the_step_is_pic() {
    let none = observe(Flip { blend: Blend::RelaxationTime(0.5 * DT) });
    assert_eq!(none, observe(Flip { blend: Blend::PerStep(0.0) }));
}

/// The force may be added to the momentum of the nodes or to their velocity.
#[test]
fn no_flip_is_pic() {
    let gap = Gap::between(
        &observe(Flip { blend: Blend::PerStep(0.0) }),
        &observe(Pic),
        (SPACING[0], 1.0),
    );
    assert!(gap.largest() < 1e-13, "{gap:?}");
}

#[test]
fn flip_keeps_velocities_that_nothing_changes() {
    let scene = block::<2>((8, true)).scene();
    velocities_stay_without_force(&scene, scheme(GIMP, Carried, Particle, FLIP)).unwrap();
    velocities_stay_without_force(&scene, scheme(Linear, mls(), MIXED, FLIP)).unwrap();
}

#[test]
fn affine_transfer_keeps_an_affine_field() {
    let scene = block::<2>((9, false)).scene();
    affine_field_survives(scene.clone(), scheme(QuadraticBspline, Carried, Particle, Apic))
        .unwrap();
    affine_field_survives(scene, scheme(Linear, Carried, Particle, Apic)).unwrap();
}
