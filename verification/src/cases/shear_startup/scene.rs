//! Set-up, stepping and measurement of one run.

use std::time::Instant;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{InvalidInput, Observation, Scene, Simulation};

use super::Parameters;
use crate::case::{Findings, Outcome, Profile, Row};
use crate::cases::lattice;
use crate::cases::march::{counters, march};
use crate::exact::shear::{Couette, Poiseuille};
use crate::measure::samples::{Sample, at_centers, at_points, l2};
use crate::progress::Progress;

/// H, m.
pub(super) const HEIGHT: f64 = 1.0;
/// ν, m²/s.
pub(super) const VISCOSITY: f64 = 1.0;
/// U, m/s: the velocity of the moving wall and the largest of the steady Poiseuille flow.
pub(super) const VELOCITY: f64 = 1.0;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀, m/s.
const SOUND_SPEED: f64 = 20.0;
/// Cells along the flow.
const LENGTH_CELLS: usize = 4;
/// One point in so many is kept in a profile.
const THINNING: usize = 5;

/// Quantity and norm of each row of an instant.
const ROWS: [(&str, &str); 3] =
    [("velocity", "point-l2"), ("velocity", "gauss-l2"), ("middle", "point-l2")];

/// Body force per mass of a flow, m/s².
fn acceleration(flow: &str) -> f64 {
    if flow == "poiseuille" { 8.0 * VISCOSITY * VELOCITY / (HEIGHT * HEIGHT) } else { 0.0 }
}

/// Exact velocity of a flow at the height y (m) and the time t (s), m/s.
pub(super) fn exact(flow: &str, position: f64, time: f64) -> f64 {
    if flow == "poiseuille" {
        let acceleration = acceleration(flow);
        Poiseuille { height: HEIGHT, viscosity: VISCOSITY, acceleration }.velocity(position, time)
    } else {
        Couette { height: HEIGHT, viscosity: VISCOSITY, wall_velocity: VELOCITY }
            .velocity(position, time)
    }
}

fn rows_of(flow: &str, instant: &str, values: [(f64, f64); 3]) -> Vec<Row> {
    let row = |((quantity, norm), (value, scale)): (&(&str, &str), (f64, f64))| Row {
        quantity: format!("{quantity}@{flow}-{instant}"),
        norm: (*norm).to_owned(),
        value,
        scale,
    };
    ROWS.iter().zip(values).map(row).collect()
}

/// The rows of a run that has no values.
pub(super) fn missing_rows(parameters: &Parameters) -> Vec<Row> {
    let missing = [(f64::NAN, f64::NAN); 3];
    let instants = parameters.instants.iter();
    instants.flat_map(|(name, _)| rows_of(&parameters.flow, name, missing)).collect()
}

/// Builds, steps and measures at every instant.
pub(super) fn execute(
    parameters: &Parameters,
    progress: &Progress,
    build: impl FnOnce(&Scene<2>) -> Result<Box<dyn Simulation<2>>, InvalidInput>,
) -> Findings {
    let scene = scene(parameters);
    let mut simulation = match build(&scene) {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing_rows(parameters)),
    };
    let total = parameters.instants.last().map_or(0, |(_, step)| *step);
    let (mut rows, mut profiles) = (Vec::new(), Vec::new());
    let (mut outcome, mut done, mut seconds) = (Outcome::Completed, 0, 0.0);
    for (name, step) in &parameters.instants {
        let start = Instant::now();
        outcome = march(simulation.as_mut(), parameters.dt, done..*step, (progress, total));
        seconds += start.elapsed().as_secs_f64();
        done = *step;
        if outcome != Outcome::Completed {
            break;
        }
        let state = simulation.observe();
        rows.extend(measure(parameters, &scene, &state, name));
        if parameters.profile {
            let points = state.points.iter().step_by(THINNING);
            let pairs = points.map(|point| (point.position[1], point.velocity[0]));
            profiles.push(Profile::new(format!("velocity@{name}"), pairs));
        }
    }
    // What was measured before a blow-up stands.
    rows.extend(missing_rows(parameters).into_iter().skip(rows.len()));
    Findings {
        outcome,
        rows,
        profiles,
        rasters: Vec::new(),
        counters: counters(simulation.as_ref()),
        seconds,
    }
}

/// The channel and its points.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let h = HEIGHT / parameters.cells as f64;
    let cells = [LENGTH_CELLS, parameters.cells];
    let flow = parameters.flow.as_str();
    let mass = DENSITY * 0.25 * h * h;
    let points = lattice::positions(h, cells, parameters.jitter, parameters.seed)
        .into_iter()
        .map(|position| {
            // Cells from the moving wall.
            let depth = (HEIGHT - position[1]) / h;
            let is_moving = flow == "couette-ramp" && depth < 1.0;
            let [u, slope] = if is_moving { [1.0 - depth, 1.0 / h] } else { [0.0; 2] };
            let velocity = [u * VELOCITY, 0.0];
            let velocity_gradient = [[0.0, slope * VELOCITY], [0.0; 2]];
            let point = PointSpec::new(position, velocity, DENSITY, mass);
            PointSpec { velocity_gradient, ..point }
        })
        .collect();
    let upper = if flow == "poiseuille" {
        Boundary::NoSlip
    } else {
        Boundary::Velocity([VELOCITY, 0.0, 0.0])
    };
    let mut scene = Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [h; 2], cells },
        [[Boundary::Periodic; 2], [Boundary::NoSlip, upper]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    );
    scene.viscosity = Some(VISCOSITY);
    scene.body_force = [acceleration(flow), 0.0];
    scene
}

/// Errors of the velocity on a channel of 1 m length.
pub(super) fn measure(
    parameters: &Parameters,
    scene: &Scene<2>,
    state: &Observation<2>,
    instant: &str,
) -> Vec<Row> {
    let field = |[_, y]: [f64; 2]| [exact(&parameters.flow, y, state.time), 0.0];
    let points = at_points(state, |point| point.velocity, field);
    let centers = at_centers(scene, state, |point| point.velocity, field).samples;
    let middle: Vec<Sample<2, 2>> = points
        .iter()
        .filter(|sample| (sample.position[1] - 0.5 * HEIGHT).abs() < 0.25 * HEIGHT)
        .copied()
        .collect();
    let length = LENGTH_CELLS as f64 * scene.grid.spacing[0];
    let values = [&points, &centers, &middle].map(|samples| {
        let norm = l2(samples, &(0..2));
        (norm.error() / length.sqrt(), norm.exact() / length.sqrt())
    });
    rows_of(&parameters.flow, instant, values)
}
