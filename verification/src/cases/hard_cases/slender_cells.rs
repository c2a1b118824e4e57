//! Hard case 14, `slender-cells`: cells that are not square, and a turned frame.
//!
//! Supports and volumes that take a cell for a square show in slender ones; a method that prefers an axis shows when
//! all is turned.
//!
//! - The standing wave of case `sine-wave` along x on 16 cells, 4 cells across it that are as wide, a quarter and an
//!   eighth of that, points displaced by up to 0.3 of their spacing along each axis, to T/4: error of the points'
//!   pressure over that on square cells.
//! - A small dam break, 5 by 6 cells of 2 x 2 points, with gravity along −y and, x and y exchanged, along −x, 50
//!   steps: largest difference of the places over a cell.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Settings};

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, worse};
use crate::case::{Outcome, Tier};
use crate::cases::free_surface::RELAXATION;
use crate::cases::lattice::{self, JITTER};
use crate::exact::sine_wave::StandingWave;
use crate::measure::norms::L2;

/// The wave of case `sine-wave`.
const WAVE: StandingWave =
    StandingWave { amplitude: 1e-6, length: 1.0, density: 1000.0, sound_speed: 50.0 };
/// Cells along and across the wave.
const CELLS: [usize; 2] = [16, 4];
/// Length over width of a cell, square ones first.
const RATIOS: [f64; 3] = [1.0, 4.0, 8.0];
/// Seed of the displacements.
const SEED: u64 = 20_261_114;
/// Cells of the column of water and of its box.
const COLUMN: ([usize; 2], [usize; 2]) = ([5, 6], [10, 8]);
/// g h/c².
const GRAVITY: f64 = 1e-3;
/// Steps of the dam break.
const STEPS: u64 = 50;

/// The run.
pub(super) const RUN: Run = Run {
    name: "slender-cells",
    spacing: 1.0 / CELLS[0] as f64,
    tier: Tier::Smoke,
    quantities: &["over-square", "turned", "over-square@4", "over-square@8", "error-square"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "slender-cells",
    run: RUN.name,
    criterion: "wave along cells 4 and 8 times as long as wide: error at most twice that of square ones; dam break in a \
                turned frame: same places to 10⁻¹² of a cell",
    goals: &[Goal::below("over-square", 2.0), Goal::below("turned", 1e-12)],
};

/// Error of the points' pressure at T/4, relative.
fn error(trial: &Trial<'_>, ratio: f64) -> Result<f64, Outcome> {
    let h = WAVE.length / CELLS[0] as f64;
    let spacing = [h, h / ratio];
    let point = |place: [f64; 2]| {
        let position = [place[0] * spacing[0], place[1] * spacing[1]];
        let mass = WAVE.density * 0.25 * spacing[0] * spacing[1];
        let velocity = [WAVE.velocity(position[0], 0.0), 0.0];
        let slope = WAVE.velocity_gradient(position[0], 0.0);
        let spec = PointSpec::new(position, velocity, WAVE.density, mass);
        PointSpec { velocity_gradient: [[slope, 0.0], [0.0; 2]], ..spec }
    };
    let scene = Scene::new(
        GridSpec { origin: [0.0; 2], spacing, cells: CELLS },
        [[Boundary::Slip; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: WAVE.density,
            sound_speed: WAVE.sound_speed,
        },
        lattice::positions(1.0, CELLS, JITTER, SEED).into_iter().map(point).collect(),
    );
    let mut simulation = trial.plane(&scene, &Trial::closed())?;
    let end = 0.25 * WAVE.period();
    let steps = (end / simulation.stable_dt(COURANT).dt).ceil();
    march(simulation.as_mut(), end / steps, steps as u64, |_, _| ())?;
    let mut norm = L2::default();
    simulation.visit_points(&mut |point| {
        let exact = WAVE.pressure(WAVE.material(point.position[0], end), end);
        norm.add((point.pressure - exact).powi(2), exact * exact, point.volume());
    });
    Ok(norm.error() / norm.exact())
}

/// A column of water in a corner, gravity along the axis `up`; the other frame has x and y exchanged.
fn column(up: usize) -> Scene<2> {
    let turn = |[x, y]: [f64; 2]| if up == 1 { [x, y] } else { [y, x] };
    let (column, cells) = COLUMN;
    let height = column[1] as f64;
    let point = |place: [f64; 2]| {
        let density = 1.0 + GRAVITY * (height - place[1]);
        PointSpec::new(turn(place), [0.0; 2], density, 0.25 * density)
    };
    let along = [Boundary::Slip; 2];
    let upwards = [Boundary::Slip, Boundary::Free];
    let mut scene = Scene::new(
        GridSpec {
            origin: [0.0; 2],
            spacing: [1.0; 2],
            cells: if up == 1 { cells } else { [cells[1], cells[0]] },
        },
        if up == 1 { [along, upwards] } else { [upwards, along] },
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        lattice::positions(1.0, column, 0.0, 0).into_iter().map(point).collect(),
    );
    scene.body_force[up] = -GRAVITY;
    scene
}

/// Places of the points of the column after the steps, as with gravity along −y.
fn places(trial: &Trial<'_>, settings: &Settings, up: usize) -> Result<Vec<[f64; 2]>, Outcome> {
    let mut simulation = trial.plane(&column(up), settings)?;
    let dt = simulation.stable_dt(COURANT).dt;
    march(simulation.as_mut(), dt, STEPS, |_, _| ())?;
    let points = simulation.observe().points;
    Ok(points.iter().map(|p| [p.position[1 - up], p.position[up]]).collect())
}

fn execute(trial: &Trial<'_>) -> Measured {
    let mut errors = Vec::new();
    for ratio in RATIOS {
        errors.push(error(trial, ratio)?);
    }
    let over = [1, 2].map(|k| errors[k] / errors[0]);
    let settings = trial.surface(2, 1.0, 1.0, RELAXATION);
    let (upright, turned) = (places(trial, &settings, 1)?, places(trial, &settings, 0)?);
    let mut most = if upright.len() == turned.len() { 0.0 } else { f64::INFINITY };
    for (a, b) in upright.iter().zip(&turned) {
        most = worse(most, (a[0] - b[0]).abs().max((a[1] - b[1]).abs()));
    }
    Ok(vec![worse(over[0], over[1]), most, over[0], over[1], errors[0]])
}
