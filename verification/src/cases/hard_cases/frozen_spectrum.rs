//! Hard case 3, `frozen-spectrum`: disturbances that grow in every step.
//!
//! One step from a state of rest, at points out of order that stay in place, is a map whose spectral radius says
//! whether some disturbance grows, however slowly; see case `spectral`, whose steps and measures these are. Three
//! kinds of layouts at the Courant number 0.5: `1d`, 12 periodic cells, points displaced by up to 0.9 of their
//! spacing, 20 seeds; `2d`, 4 by 4 periodic cells, displaced by up to 0.5, 6 seeds, since a matrix costs a hundred
//! times as much; `surface`, a floor and 10 cells of water below a free surface at every twentieth of a cell,
//! displaced by up to 0.9, with the policy of free surfaces.
//!
//! The map is that of velocity and density, and of the affine fields that points carry besides. Points are not
//! rearranged, since they are to stay. What is done in every n-th step makes n steps the map, and their growth is
//! shared out among them.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Settings};

use super::list::{Goal, HardCase, Run};
use super::trial::{Built, COURANT, Measured, Trial, refused, worse};
use crate::case::{Outcome, Tier};
use crate::cases::free_surface::RELAXATION;
use crate::cases::lattice::lattice;
use crate::cases::spectral::{Step, full_box, of_one_period};

/// Cells and displacement, point spacings, in one and in two dimensions.
const LAYOUTS: [(usize, f64); 2] = [(12, 0.9), (4, 0.5)];
/// Seeds in one dimension.
const SEEDS: u64 = 20;
/// Seeds in two dimensions.
const SEEDS_2D: u64 = 6;
/// Seeds are this plus a number.
const SEED: u64 = 20_261_102;
/// Rows of points below the surface, cells of the box with the surface.
const SURFACE: (usize, usize) = (20, 14);
/// Distance of the differences over that of `spectral`: kinks of second order, as those of volumes that are cut off
/// or of lengths that are stretched, then count as little as round-off, 2·10⁻¹¹ at most.
const SHARE: f64 = 1.0 / 64.0;
/// Growth per step that counts as none.
const NEUTRAL: f64 = 1e-10;

/// The run.
pub(super) const RUN: Run = Run {
    name: "frozen-spectrum",
    spacing: 1.0,
    tier: Tier::Full,
    quantities: &["growth", "growth-1d", "growth-2d", "growth-surface"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "frozen-spectrum",
    run: RUN.name,
    criterion: "growth per step of the linearized solver on disordered points, in 1D, 2D and below a free surface: at \
                most 10⁻¹⁰",
    goals: &[Goal::below("growth", NEUTRAL)],
};

fn execute(trial: &Trial<'_>) -> Measured {
    let settings = Trial::closed();
    let line = |scene: &Scene<1>, settings: &Settings| trial.builder.line(scene, settings);
    let plane = |scene: &Scene<2>, settings: &Settings| trial.builder.plane(scene, settings);
    let (mut in_1d, mut in_2d, mut below_surface) = (0.0, 0.0, 0.0);
    for seed in SEED..SEED + SEEDS {
        let scene = full_box::<1>(LAYOUTS[0].0, LAYOUTS[0].1, seed);
        in_1d = worse(in_1d, growth(trial, scene, &settings, &line)?);
    }
    for seed in SEED..SEED + SEEDS_2D {
        let scene = full_box::<2>(LAYOUTS[1].0, LAYOUTS[1].1, seed);
        in_2d = worse(in_2d, growth(trial, scene, &settings, &plane)?);
    }
    let settings = trial.surface(2, 1.0, 1.0, RELAXATION);
    for seed in 0..SEEDS {
        let found = growth(trial, with_surface(seed), &settings, &line)?;
        below_surface = worse(below_surface, found);
    }
    let growths = [in_1d, in_2d, below_surface];
    Ok([growths.into_iter().fold(0.0, worse)].into_iter().chain(growths).collect())
}

/// ρ(A) − 1 of one layout.
fn growth<const D: usize>(
    trial: &Trial<'_>,
    scene: Scene<D>,
    settings: &Settings,
    build: &dyn Fn(&Scene<D>, &Settings) -> Built<D>,
) -> Result<f64, Outcome> {
    let period = trial.variant.settings(settings).projection.map_or(1, |filter| filter.interval);
    let in_place = |scene: &Scene<D>, settings: &Settings| {
        let mut simulation = build(scene, settings)?;
        simulation.set_rearrangement(None)?;
        Ok(simulation)
    };
    let dt = COURANT / (D as f64).sqrt();
    let step = Step { variant: trial.variant, settings, build: &in_place, scene, dt, period };
    let of_period = |growth: f64| (growth.ln_1p() / f64::from(period)).exp_m1();
    of_one_period(step, SHARE)
        .map(|(found, _)| of_period(found.growth()))
        .map_err(|reason| refused(&reason))
}

/// A column on a floor whose surface is `seed` twentieths of a cell above a face.
fn with_surface(seed: u64) -> Scene<1> {
    let (rows, cells) = SURFACE;
    let shift = seed as f64 / SEEDS as f64;
    let jitter = LAYOUTS[0].1;
    let point = |place: [f64; 1]| {
        // The lowest point stays above the floor.
        PointSpec::new([(place[0] + shift).max(0.01)], [0.0], 1.0, 0.5)
    };
    Scene::new(
        GridSpec { origin: [0.0], spacing: [1.0], cells: [cells] },
        [[Boundary::Slip, Boundary::Free]],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        lattice([rows], 0.5, jitter, SEED + seed).into_iter().map(point).collect(),
    )
}
