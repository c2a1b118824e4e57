//! Cells that the surface cuts off almost wholly do not shorten the stable time step where mass and force
//! enter the nodes by the same rule.

use crate::common::Random;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::variants::PointVolume;
use transpoint::{Scene, Settings, Variant};

const N_CELLS: usize = 12;
const H: f64 = 0.1;
const SOUND_SPEED: f64 = 10.0;
const DRIFT: f64 = 0.5;

/// A block of 7 x 7 cells of disordered points that drifts through a periodic box.
fn drifting_block(seed: u64) -> Scene<2> {
    let mut random = Random(seed);
    let mut points = Vec::new();
    for i in 0..14 {
        for j in 0..14 {
            let at = |k: usize, random: &mut Random| {
                H * (2.5 + 0.5 * (k as f64 + 0.5 + 0.45 * random.signed()))
            };
            let position = [at(i, &mut random), at(j, &mut random)];
            let density = 1000.0 * (1.0 + 1e-3 * random.signed());
            points.push(PointSpec::new(position, [DRIFT, 0.3 * DRIFT], density, 250.0 * H * H));
        }
    }
    let grid = GridSpec { origin: [0.0; 2], spacing: [H; 2], cells: [N_CELLS; 2] };
    let water = EquationOfStateSpec::WeaklyCompressible {
        reference_density: 1000.0,
        sound_speed: SOUND_SPEED,
    };
    Scene::new(grid, [[Boundary::Periodic; 2]; 2], water, points)
}

/// Kinetic energy after `steps` steps over that at the start; `None` for a burst.
fn kinetic_energy(
    variant: Variant,
    point_volume: PointVolume,
    courant: f64,
    steps: u64,
) -> Option<f64> {
    let settings = Settings { point_volume, ..Settings::default() };
    let mut simulation = variant.build_2d(&drifting_block(7), &settings).unwrap();
    let start = simulation.conserved().kinetic_energy;
    let dt = simulation.stable_dt(courant).dt;
    for _ in 0..steps {
        simulation.step(dt).ok()?;
    }
    Some(simulation.conserved().kinetic_energy / start)
}

#[test]
fn one_sample_per_cut_cell_keeps_the_time_step_of_full_cells() {
    for variant in [Variant::TpmVpConstant, Variant::TpmVpQuadratic] {
        for courant in [0.25, 0.5] {
            let ratio = kinetic_energy(variant, PointVolume::CellCenter, courant, 1000);
            let ratio = ratio.expect("burst");
            assert!((ratio - 1.0).abs() < 0.02, "{variant:?} at {courant}: {ratio}");
        }
    }
}

/// What the rule is for: with a sample at each point the same runs burst.
#[test]
fn samples_at_the_points_burst_at_small_cuts() {
    for point_volume in
        [PointVolume::Sphere, PointVolume::CarriedCapped, PointVolume::VolumeFraction]
    {
        let ratio = kinetic_energy(Variant::TpmVpConstant, point_volume, 0.25, 1000);
        assert!(ratio.is_none_or(|ratio| !(ratio < 2.0)), "{point_volume:?}: {ratio:?}");
    }
}
