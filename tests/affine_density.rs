//! Points that carry the slope of their density: linear fields, how slopes turn and grow, what is refused.

use crate::common::near;
use crate::common::scenes::{Block, Build, DENSITY, SOUND_SPEED, SPACING};
use proptest::prelude::*;
use transpoint::scene::{Boundary, Scene};
use transpoint::{Settings, Variant};

/// A step so short that nothing else happens.
const INSTANT: f64 = 1e-12;

/// A closed box of cells with displaced points whose density is linear.
fn tilted_box<const D: usize>(jitter: f64, tilt: [f64; D]) -> Scene<D> {
    let mut block = Block::<D>::full(6, Boundary::Slip);
    block.jitter = jitter;
    let mut scene = block.scene();
    for point in &mut scene.points {
        let along = (0..D).map(|axis| tilt[axis] * point.position[axis] / SPACING[axis]);
        point.density = DENSITY * (1.0 + along.sum::<f64>());
    }
    scene
}

fn start_slopes_are_those_of<const D: usize>(
    tilt: [f64; D],
    jitter: f64,
) -> Result<(), TestCaseError>
where
    Scene<D>: Build<D>,
{
    let scene = tilted_box(jitter, tilt);
    let simulation = scene.build(Variant::TpmAffine, &Settings::default());
    for point in simulation.observe().points {
        for axis in 0..D {
            let exact = DENSITY * tilt[axis] / SPACING[axis];
            let found = point.density_slope[axis];
            near("slope", found, exact, 1e-11 * DENSITY / SPACING[axis])
                .map_err(TestCaseError::fail)?;
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Least squares over the points around find the slope of a linear density to round-off, at walls too.
    #[test]
    fn a_linear_density_has_its_slope(tilt in [-1e-2..1e-2, -1e-2..1e-2, -1e-2..1e-2_f64], jitter in 0.0..0.4) {
        start_slopes_are_those_of([tilt[0]], jitter)?;
        start_slopes_are_those_of([tilt[0], tilt[1]], jitter)?;
        start_slopes_are_those_of(tilt, jitter)?;
    }
}

/// A uniform velocity gradient L strains density and slope as the formulas say: ρ ← ρ/(1 + Δt tr L),
/// s ← (s − Δt Lᵀ s)/(1 + Δt tr L). Away from walls, where the velocity is prescribed.
#[test]
fn slopes_turn_and_grow_with_the_flow() {
    const L: [[f64; 2]; 2] = [[0.3, -0.7], [0.2, 0.1]];
    const DT: f64 = 1e-9;
    let mut block = Block::<2>::full(8, Boundary::Slip);
    block.jitter = 0.3;
    let mut scene = block.scene();
    let middle = [4.0 * SPACING[0], 4.0 * SPACING[1]];
    let slope = [3.0, -5.0];
    for point in &mut scene.points {
        let from = [point.position[0] - middle[0], point.position[1] - middle[1]];
        point.velocity = [0, 1].map(|i| L[i][0] * from[0] + L[i][1] * from[1]);
        point.density_slope = Some(slope);
    }
    let mut simulation = scene.build(Variant::TpmAffine, &Settings::default());
    simulation.step(DT).unwrap();
    let growth = 1.0 / (1.0 + DT * (L[0][0] + L[1][1]));
    let mut n_inside = 0;
    for point in simulation.observe().points {
        let is_inside = (0..2).all(|a| (point.position[a] / SPACING[a] - 4.0).abs() < 2.0);
        if !is_inside {
            continue;
        }
        n_inside += 1;
        for axis in 0..2 {
            let turned = L[0][axis] * slope[0] + L[1][axis] * slope[1];
            let exact = (slope[axis] - DT * turned) * growth;
            // A hundred-thousandth of the change, which is Δt times the slope: the slopes of a uniform density push, which
            // adds of the order Δt².
            near("slope", point.density_slope[axis], exact, 1e-14).unwrap();
        }
    }
    assert!(n_inside > 40);
}

/// Cells have the density of the linear fields of their points, whatever the layout: they push every point by its slope.
#[test]
fn a_linear_density_pushes_by_its_slope() {
    const TILT: [f64; 2] = [1e-3, -2e-3];
    let scene = tilted_box(0.4, TILT);
    let mut simulation = scene.build(Variant::TpmAffine, &Settings::default());
    let dt = 1e-6;
    simulation.step(dt).unwrap();
    let mut n_inside = 0;
    for point in simulation.observe().points {
        if (0..2).any(|a| (point.position[a] / SPACING[a] - 3.0).abs() > 2.0) {
            continue;
        }
        n_inside += 1;
        for axis in 0..2 {
            let slope = DENSITY * TILT[axis] / SPACING[axis];
            let exact = -dt * SOUND_SPEED.powi(2) * slope / point.density;
            // 1/ρ is interpolated from the nodes: off by the square of the tilt.
            near("velocity", point.velocity[axis], exact, 2e-6 * exact.abs()).unwrap();
        }
    }
    assert!(n_inside > 40);
}

#[test]
fn other_divergences_are_refused() {
    let settings = Settings { affine_density: true, ..Settings::default() };
    for variant in [Variant::Mpm, Variant::TpmVp, Variant::TpmVpConstant, Variant::Tpm] {
        let scene = Block::<2>::full(4, Boundary::Slip).scene();
        let error = variant.build_2d(&scene, &settings).err().unwrap();
        assert_eq!(error.field, "settings.affine_density");
    }
}

/// A slope that is not a number is refused, and the message names the point.
#[test]
fn slopes_of_a_scene_are_checked() {
    let mut scene = Block::<2>::full(4, Boundary::Slip).scene();
    scene.points[7].density_slope = Some([0.0, f64::NAN]);
    let error = Variant::TpmAffine.build_2d(&scene, &Settings::default()).err().unwrap();
    assert_eq!(error.field, "points[7].density_slope");
}

/// In a scene file a slope may be left out or null; one of the wrong length is refused.
#[test]
fn slopes_in_scene_files() {
    let mut scene = Block::<2>::full(4, Boundary::Slip).scene();
    let read = |text: &str| serde_json::from_str::<Scene<2>>(text);
    let text = serde_json::to_string(&scene).unwrap();
    assert!(!text.contains("density_slope"));
    assert_eq!(read(&text).unwrap(), scene);
    let with = |slope: &str| text.replacen("\"mass\"", &format!("{slope},\"mass\""), 1);
    assert_eq!(read(&with("\"density_slope\":null")).unwrap(), scene);
    scene.points[0].density_slope = Some([0.5, -2.0]);
    assert_eq!(read(&with("\"density_slope\":[0.5,-2.0]")).unwrap(), scene);
    assert_eq!(read(&serde_json::to_string(&scene).unwrap()).unwrap(), scene);
    let error = read(&with("\"density_slope\":[0.5]")).unwrap_err().to_string();
    assert!(error.contains("expected 2 entries, found 1"), "{error}");
}

/// A uniform fluid at rest keeps zero slopes and its density.
#[test]
fn a_uniform_fluid_stays_uniform() {
    let scene = tilted_box::<3>(0.4, [0.0; 3]);
    let mut simulation = scene.build(Variant::CellAdjointAffine, &Settings::default());
    for _ in 0..9 {
        simulation.step(INSTANT).unwrap();
    }
    for point in simulation.observe().points {
        near("density", point.density, DENSITY, 1e-12 * DENSITY).unwrap();
        for slope in point.density_slope {
            near("slope", slope, 0.0, 1e-9 * DENSITY).unwrap();
        }
    }
}
