//! Hard case 11, `single-points`: points that are alone, and films thinner than a cell.
//!
//! A splash comes down to these. There is nothing to fit, no cell is full, and a node next to which a point has just
//! arrived has hardly any mass. Three trials, with the policy of free surfaces:
//!
//! - a point falls from rest at 21 offsets within a cell, both along and across, through some 4 cells; its path is
//!   that of the time steps, y₀ − g Δt² n (n + 1)/2, to 10⁻¹² of the fall, and the stable time step does not
//!   collapse (`fall-inside` is without the first and the last offset, at which the point starts from a node);
//! - two points of one cell fly on side by side;
//! - a film of 0.3, 0.5, 1 and 2 h slides along a slip floor;
//!
//! the latter without gravity, so that the velocity stays to 10⁻¹⁰ over 200 steps.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, worse};
use crate::case::{Outcome, Tier};
use crate::cases::free_surface::RELAXATION;

/// Cells of the box along each axis, of size 1; ρ₀ and c are 1.
const CELLS: [usize; 2] = [8, 12];
/// Offsets of the point that falls.
const OFFSETS: usize = 21;
/// Steps of its fall.
const FALL: u64 = 60;
/// g h/c²: some 4 cells in those steps. With it g Δt² is h/400, and on its way from the offsets 0.3 and 0.75 a point
/// comes to lie on a face to the last bit.
const GRAVITY: f64 = 0.02;
/// Cell of the point at the start.
const START: [f64; 2] = [3.0, 9.0];
/// Steps of what flies or slides.
const STEPS: u64 = 200;
/// Its velocity over c.
const VELOCITY: [f64; 2] = [0.013, -0.021];
/// Thickness of the films over h.
const FILMS: [f64; 4] = [0.3, 0.5, 1.0, 2.0];

/// The run.
pub(super) const RUN: Run = Run {
    name: "single-points",
    spacing: 1.0,
    tier: Tier::Smoke,
    quantities: &["fall", "time-step", "pair", "film", "fall-inside"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "single-points",
    run: RUN.name,
    criterion: "a point falls at 21 offsets to 10⁻¹² of its path, the stable time step stays above 10⁻³ of the nominal one; \
                two points and films of 0.3 to 2 h keep their velocity to 10⁻¹⁰",
    goals: &[
        Goal::below("fall", 1e-12),
        Goal::above("time-step", 1e-3),
        Goal::below("pair", 1e-10),
        Goal::below("film", 1e-10),
    ],
};

fn scene(sides: Boundary, points: Vec<PointSpec<2>>) -> Scene<2> {
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: CELLS },
        [[sides; 2], [Boundary::Slip, Boundary::Free]],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        points,
    )
}

/// Error of the path over its length, and the least stable time step over that at the start.
fn fall(trial: &Trial<'_>, offset: usize) -> Result<[f64; 2], Outcome> {
    let along = offset as f64 / (OFFSETS - 1) as f64;
    // Different places along both axes; at the ends the point lies on faces.
    let start = [START[0] + 1.0 - along, START[1] + along];
    let mut scene = scene(Boundary::Slip, vec![PointSpec::new(start, [0.0; 2], 1.0, 0.25)]);
    scene.body_force = [0.0, -GRAVITY];
    let mut simulation = trial.plane(&scene, &trial.surface(2, 1.0, 1.0, RELAXATION))?;
    let nominal = simulation.stable_dt(COURANT).dt;
    let (mut error, mut least) = (0.0, 1.0_f64);
    let length = |n: u64| GRAVITY * nominal.powi(2) * 0.5 * (n * (n + 1)) as f64;
    march(simulation.as_mut(), nominal, FALL, |step, state| {
        let expected = start[1] - length(step);
        state.visit_points(&mut |point| {
            let [x, y] = point.position;
            error = worse(error, (x - start[0]).hypot(y - expected) / length(FALL));
        });
        least = least.min(state.stable_dt(COURANT).dt / nominal);
    })?;
    if simulation.n_points() != 1 {
        error = f64::INFINITY;
    }
    Ok([error, least])
}

/// Largest change of velocity of points that nothing acts upon, over their speed.
fn drift(
    trial: &Trial<'_>,
    velocity: [f64; 2],
    points: impl Iterator<Item = ([f64; 2], f64)>,
) -> Result<f64, Outcome> {
    let points: Vec<_> =
        points.map(|(place, mass)| PointSpec::new(place, velocity, 1.0, mass)).collect();
    let count = points.len();
    let scene = scene(Boundary::Periodic, points);
    let mut simulation = trial.plane(&scene, &trial.surface(2, 1.0, 1.0, RELAXATION))?;
    let dt = simulation.stable_dt(COURANT).dt;
    let speed = velocity[0].hypot(velocity[1]);
    let mut change = 0.0;
    march(simulation.as_mut(), dt, STEPS, |_, state: &dyn Simulation<2>| {
        state.visit_points(&mut |point| {
            let [u, v] = [0, 1].map(|axis| point.velocity[axis] - velocity[axis]);
            change = worse(change, u.hypot(v) / speed);
        });
    })?;
    Ok(if simulation.n_points() == count { change } else { f64::INFINITY })
}

/// Places and masses of the points of a film, two rows per cell or as thick as it is.
fn film(thickness: f64) -> impl Iterator<Item = ([f64; 2], f64)> {
    let rows = (2.0 * thickness).round().max(1.0) as usize;
    let height = thickness / rows as f64;
    (0..2 * CELLS[0] * rows).map(move |k| {
        let (column, row) = (k / rows, k % rows);
        ([0.5 * (column as f64 + 0.5), (row as f64 + 0.5) * height], 0.5 * height)
    })
}

fn execute(trial: &Trial<'_>) -> Measured {
    let (mut error, mut inside, mut least) = (0.0, 0.0, 1.0_f64);
    for offset in 0..OFFSETS {
        let [of_path, of_step] = fall(trial, offset)?;
        (error, least) = (worse(error, of_path), least.min(of_step));
        if offset > 0 && offset < OFFSETS - 1 {
            inside = worse(inside, of_path);
        }
    }
    let pair = [[3.3, 9.4], [3.6, 9.7]].map(|place| (place, 0.25));
    let pair = drift(trial, VELOCITY, pair.into_iter())?;
    let mut films = 0.0;
    for thickness in FILMS {
        films = worse(films, drift(trial, [VELOCITY[0], 0.0], film(thickness))?);
    }
    Ok(vec![error, least, pair, films, inside])
}
