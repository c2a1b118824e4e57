//! Results do not depend on the instruction set: baseline and best of this machine give the same bits.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Settings, Variant, limit_to_baseline};

/// A closed box of three cells per axis with 2^D disordered points in each.
fn scene<const D: usize>() -> Scene<D> {
    let cells = [3; D];
    let points = (0..cells.iter().product::<usize>() << D).map(|k| {
        let (mut cell, corner) = (k >> D, k % (1 << D));
        let position = std::array::from_fn(|axis| {
            let along = cell % 3;
            cell /= 3;
            let half = 0.25 + 0.5 * f64::from(u8::from(corner >> axis & 1 == 1));
            let wobble = 0.1 * (1.7 * k as f64 + 2.3 * axis as f64).sin();
            0.1 * (along as f64 + half + wobble)
        });
        let velocity = std::array::from_fn(|axis| 0.1 * (0.3 * k as f64 + axis as f64).sin());
        let density = 1000.0 + (0.7 * k as f64).cos();
        let mass = density * 0.05_f64.powi(i32::try_from(D).expect("a small dimension"));
        PointSpec::new(position, velocity, density, mass)
    });
    Scene::new(
        GridSpec { origin: [0.0; D], spacing: [0.1; D], cells },
        [[Boundary::Slip; 2]; D],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1000.0, sound_speed: 50.0 },
        points.collect(),
    )
}

/// All variants in one test, for the limit holds for the whole process.
#[test]
fn baseline_and_best_instruction_set_give_the_same_bits() {
    for variant in Variant::ALL {
        let run = |limited| {
            limit_to_baseline(limited);
            let mut square = variant.build_2d(&scene(), &Settings::default()).unwrap();
            let mut cube = variant.build_3d(&scene(), &Settings::default()).unwrap();
            for _ in 0..10 {
                square.step(1e-4).unwrap();
                cube.step(1e-4).unwrap();
            }
            (square.observe(), cube.observe())
        };
        assert_eq!(run(true), run(false), "{}", variant.name());
    }
}
