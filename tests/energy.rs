//! The energy equation: exact totals where they are promised, and Eq. (34) by hand.

use crate::common::gas::{ENERGY, RATIO, gas};
use crate::common::near;
use crate::common::parts::{DT, setup};
use crate::common::phases::scheme;
use crate::common::scenes::{Block, Build, DENSITY, run};
use proptest::prelude::*;
use transpoint::material::General;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, EquationOfStateSpec};
use transpoint::shape::QuadraticBspline;
use transpoint::transfer::Apic;
use transpoint::variants::{Blend, BulkViscosity, EnergyUpdate, StressUpdate};
use transpoint::{Scene, Settings, Solver, Variant};

/// Largest relative change of the total energy over some steps.
fn drift<const D: usize>(scene: &Scene<D>, variant: Variant, settings: &Settings) -> f64
where
    Scene<D>: Build<D>,
{
    let total = |steps| {
        let sum = run(scene, variant, settings, (steps, 0.2 * DT)).conserved();
        sum.kinetic_energy + sum.internal_energy
    };
    let start = total(0);
    [1, 12].into_iter().map(|steps| (total(steps) / start - 1.0).abs()).fold(0.0, f64::max)
}

fn working(blend: f64) -> Settings {
    let bulk_viscosity = Some(BulkViscosity { linear: 0.2, quadratic: 1.5, expansion: false });
    let energy_update = EnergyUpdate::Work;
    Settings { energy_update, blend: Blend::PerStep(blend), bulk_viscosity, ..Settings::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn work_keeps_the_total_energy(at in setup(), blend in 0.0..=1.0_f64) {
        for variant in [Variant::Mpm, Variant::Gimp, Variant::Bspline2] {
            let settings = working(blend);
            let found = [
                drift(&gas::<1>(at), variant, &settings),
                drift(&gas::<2>(at), variant, &settings),
            ];
            prop_assert!(found.iter().all(|&d| d < 1e-12), "{}: {found:?}", variant.name());
        }
    }
}

#[test]
fn work_keeps_the_total_energy_in_3d_and_with_viscosity() {
    let mut scene = gas::<3>((7, true));
    assert!(drift(&scene, Variant::Gimp, &working(1.0)) < 1e-12);
    scene.viscosity = Some(1e-2);
    assert!(drift(&scene, Variant::Gimp, &working(1.0)) < 1e-12);
}

/// The check above can fail: by the strain alone the total drifts.
#[test]
fn strain_does_not_keep_the_total_energy() {
    let settings = Settings { energy_update: EnergyUpdate::Strain, ..working(1.0) };
    assert!(drift(&gas::<2>((7, true)), Variant::Gimp, &settings) > 1e-9);
}

/// A lone affine point with D = 0.5 + 0.25: Δe = −½ (1/ρ + 1/ρ') p Δt D, ρ' = ρ/(1 + Δt D).
#[test]
fn strain_is_the_printed_update() {
    let mut scene = Block::<2>::full(9, Boundary::Free).scene();
    scene.points.truncate(1);
    scene.points[0].position = [0.43, 0.52];
    scene.points[0].velocity_gradient = [[0.5, 3.0], [-1.0, 0.25]];
    scene.points[0].energy = ENERGY;
    scene.equation_of_state = EquationOfStateSpec::IdealGas { ratio: RATIO };
    scene.energy = true;
    let material = General {
        deviatoric: None,
        energy: Some(EnergyUpdate::Strain),
        bulk_viscosity: None,
        cell_size: 0.1,
    };
    let method = scheme(QuadraticBspline, Carried, Particle, Apic);
    let mut solver = Solver::<f64, 2, _, _>::new(&scene, method, material).unwrap();
    // So short that the pressure does not change the gradient noticeably.
    let dt = 1e-9;
    solver.advance(dt).unwrap();
    let strain = dt * 0.75;
    let pressure = (RATIO - 1.0) * DENSITY * ENERGY;
    let volume = 0.5 * (1.0 / DENSITY + (1.0 + strain) / DENSITY);
    let change = solver.particles.state[0].energy - ENERGY;
    near("Δe", change, -volume * pressure * strain, 1e-4 * (pressure / DENSITY * strain)).unwrap();
}

/// Adiabatic compression of a uniform gas: e ρ^{1−γ} stays up to the order of the time step.
#[test]
fn a_uniform_gas_follows_its_adiabat() {
    let mut scene = Block::<1>::full(6, Boundary::Free).scene();
    for point in &mut scene.points {
        (point.velocity, point.energy) = ([-0.4 * point.position[0]], ENERGY);
        point.velocity_gradient = [[-0.4]];
    }
    scene.equation_of_state = EquationOfStateSpec::IdealGas { ratio: RATIO };
    scene.energy = true;
    let middle = |settings: &Settings, variant, steps: usize| {
        let dt = 8e-3 / steps as f64;
        let points = run(&scene, variant, settings, (steps, dt)).observe().points;
        let p = points[points.len() / 2];
        (p.energy / ENERGY) * (p.density / DENSITY).powf(1.0 - RATIO) - 1.0
    };
    let strain = Settings::default();
    let work = Settings { energy_update: EnergyUpdate::Work, ..strain };
    for (settings, variant) in
        [(strain, Variant::Mpm), (work, Variant::Mpm), (strain, Variant::TpmVp)]
    {
        let [coarse, fine] = [40, 80].map(|steps| middle(&settings, variant, steps));
        let name = variant.name();
        assert!(coarse.abs() < 1e-4, "{name}: {coarse:e}");
        assert!((coarse / fine - 2.0).abs() < 0.2, "{name}: {coarse:e} and {fine:e}");
    }
}

#[test]
fn what_cannot_be_kept_is_refused() {
    let scene = gas::<2>((3, true));
    let settings = working(1.0);
    let musl = Settings { stress_update: StressUpdate::ModifiedLast, ..settings };
    for (variant, settings) in [
        (Variant::Apic, settings),
        (Variant::Tpm, settings),
        (Variant::MpmVp, settings),
        (Variant::Mpm, musl),
    ] {
        let error = variant.build_2d(&scene, &settings).err().unwrap();
        assert_eq!(error.field, "settings.energy_update", "{}", variant.name());
    }
    let mut cold = scene.clone();
    cold.energy = false;
    assert_eq!(Variant::Mpm.build_2d(&cold, &settings).err().unwrap().field, "energy");
    let mut broken = scene;
    broken.points[3].energy = f64::NAN;
    let error = Variant::Mpm.build_2d(&broken, &settings).err().unwrap();
    assert_eq!(error.field, "points[3].energy");
}
