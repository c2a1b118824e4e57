//! The strip, its run, and the measures taken at the end.

use std::time::Instant;

use anyhow::Result;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::{DENSITY, INTERFACE, PRESSURES, Parameters, ROUND_OFF, SOUND_SPEED, WIDTH_CELLS};
use crate::case::{self, Findings, Outcome, Row};
use crate::cases::lattice::lattice;
use crate::cases::march::{counters, march};
use crate::exact::isothermal_riemann::{IsothermalRiemann, State};
use crate::measure::profile::Profile;
use crate::progress::Progress;

/// Half width of the middle of the plateau, m: away from the fronts, which stand 0.25 m off.
const PLATEAU: f64 = 0.2;

/// Measures of the pressure, in the order of [`pressure_measures`].
const MEASURES: [&str; 11] = [
    "l1",
    "l2",
    "overshoot",
    "undershoot",
    "plateau-min",
    "plateau-max",
    "tv-cells",
    "tv-points",
    "front-width-left",
    "front-width-right",
    "n-outside",
];

/// Quantity and norm of every row.
fn row_names() -> impl Iterator<Item = (&'static str, &'static str)> {
    MEASURES.into_iter().map(|norm| ("pressure", norm)).chain([("velocity", "l1")])
}

/// The rows of a run that has no values.
pub(super) fn missing_rows() -> Vec<Row> {
    row_names().map(|(quantity, norm)| Row::missing(quantity, norm)).collect()
}

/// Density at a pressure, kg/m³.
fn density(pressure: f64) -> f64 {
    DENSITY + pressure / SOUND_SPEED.powi(2)
}

/// The exact solution, a function of (x − 0.5 m)/t.
///
/// # Errors
/// Never for the pressures of this case.
pub(super) fn exact() -> Result<IsothermalRiemann> {
    let at_rest = |pressure| State { density: density(pressure), velocity: 0.0 };
    let [left, right] = PRESSURES.map(at_rest);
    IsothermalRiemann::new(left, right, SOUND_SPEED, DENSITY)
}

/// The strip and its points at rest.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let h = 1.0 / parameters.cells as f64;
    let counts = [2 * parameters.cells, 2 * WIDTH_CELLS];
    let place = |position: [f64; 2]| {
        let density = density(PRESSURES[usize::from(position[0] >= INTERFACE)]);
        PointSpec::new(position, [0.0; 2], density, density * 0.25 * h * h)
    };
    let positions = lattice(counts, 0.5 * h, parameters.jitter, parameters.seed);
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [parameters.cells, WIDTH_CELLS] },
        [[Boundary::Slip; 2], [Boundary::Periodic; 2]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        positions.into_iter().map(place).collect(),
    )
}

/// Builds, steps and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let scene = scene(parameters);
    let built = parameters.variant.build_2d(&scene, &parameters.settings);
    let mut simulation = match built {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing_rows()),
    };
    let start = Instant::now();
    let steps = parameters.steps;
    let outcome = march(simulation.as_mut(), parameters.dt, 0..steps, (progress, steps));
    let seconds = start.elapsed().as_secs_f64();
    let counters = counters(simulation.as_ref());
    let (rows, profiles) = if outcome == Outcome::Completed {
        match measure(&scene.grid, &simulation.observe()) {
            Ok((rows, profile)) => (rows, vec![profile]),
            Err(error) => return Findings::not_built(&error, missing_rows()),
        }
    } else {
        (missing_rows(), Vec::new())
    };
    Findings { outcome, rows, profiles, rasters: Vec::new(), counters, seconds }
}

/// All rows, and the pressure averaged over columns of cells.
///
/// The velocity stands half a step from the pressure, 1/2500 of the run; that moves the fronts by
/// a tenth of a cell and is left in.
///
/// # Errors
/// When the grid has no cells.
pub(super) fn measure(
    grid: &GridSpec<2>,
    state: &Observation<2>,
) -> Result<(Vec<Row>, case::Profile)> {
    let solution = exact()?;
    let at = |x: f64| solution.at((x - INTERFACE) / state.time);
    let positions: Vec<[f64; 2]> = state.points.iter().map(|point| point.position).collect();
    let volumes: Vec<f64> = state.points.iter().map(PointState::volume).collect();
    let profile = |values: Vec<f64>| Profile::new(grid, 0, &positions, &values, &volumes);
    let pressure_at = |x: f64| solution.pressure(at(x));
    let velocity_at = |x: f64| at(x).velocity;

    let pressure = profile(state.points.iter().map(|point| point.pressure).collect())?;
    let velocity = profile(state.points.iter().map(|point| point.velocity[0]).collect())?;
    let star = solution.pressure(solution.star());
    // The exact field at the same points, measured in the same way, gives the scales.
    let exact_pressure = profile(positions.iter().map(|x| pressure_at(x[0])).collect())?;
    let exact_velocity = profile(positions.iter().map(|x| velocity_at(x[0])).collect())?;

    let mut values = pressure_measures(&pressure, star, pressure_at).to_vec();
    values.push(velocity.l1(velocity_at));
    let mut scales = pressure_measures(&exact_pressure, star, |_| 0.0).to_vec();
    scales.push(exact_velocity.l1(|_| 0.0));
    let rows = row_names().zip(values).zip(scales).map(|(((quantity, norm), value), scale)| Row {
        quantity: quantity.to_owned(),
        norm: norm.to_owned(),
        value,
        scale,
    });
    let columns = pressure.columns().iter().map(|column| (column.position, column.value));
    Ok((rows.collect(), case::Profile::new("pressure", columns)))
}

/// Every measure of the pressure; errors are those against `reference`.
fn pressure_measures(
    profile: &Profile,
    star: f64,
    reference: impl Fn(f64) -> f64,
) -> [f64; MEASURES.len()] {
    let [left, right] = PRESSURES;
    let jump = left - right;
    // A part of round-off would change with the machine.
    let excess = |share: f64| if share * jump <= ROUND_OFF { 0.0 } else { share * jump };
    let plateau = profile.within(INTERFACE - PLATEAU, INTERFACE + PLATEAU).limits();
    let width = |near: f64, from: f64, to: f64| {
        profile.front(near, from, to).map_or(f64::NAN, |front| front.width)
    };
    [
        profile.l1(&reference),
        profile.l2(&reference),
        excess(profile.overshoot(right, left)),
        excess(profile.undershoot(right, left)),
        plateau[0],
        plateau[1],
        profile.total_variation_cells(),
        profile.total_variation_points(),
        width(INTERFACE - 0.25, left, star),
        width(INTERFACE + 0.25, star, right),
        profile.n_outside(right, left, ROUND_OFF) as f64,
    ]
}
