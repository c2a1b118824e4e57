//! Set-up, stepping and measurement of one run.

use std::time::Instant;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::variants::StressUpdate;
use transpoint::{InvalidInput, Observation, Scene, Simulation};

use super::Parameters;
use crate::case::{Findings, Outcome, Row};
use crate::cases::lattice;
use crate::cases::march::{counters, march};
use crate::exact::sine_wave::StandingWave;
use crate::measure::cell_centers;
use crate::measure::norms::L2;
use crate::progress::Progress;

const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
const DENSITY: f64 = 1000.0;
const SOUND_SPEED: f64 = 50.0;

/// Quantities and norms of every run.
const ROWS: [(&str, &str); 4] = [
    ("pressure", "point-l2"),
    ("pressure", "gauss-l2"),
    ("velocity", "point-l2"),
    ("velocity", "gauss-l2"),
];

/// The rows of a run that has no values.
pub(super) fn missing_rows(instant: &str) -> Vec<Row> {
    ROWS.iter()
        .map(|(quantity, norm)| Row::missing(format!("{quantity}@{instant}"), *norm))
        .collect()
}

/// One run, ready to be built and stepped.
pub(super) struct Run<'a> {
    pub(super) parameters: &'a Parameters,
    pub(super) instant: &'a str,
    pub(super) progress: &'a Progress,
}

impl Run<'_> {
    /// Builds, steps and measures.
    pub(super) fn execute<const D: usize>(
        &self,
        build: impl FnOnce(&Scene<D>) -> Result<Box<dyn Simulation<D>>, InvalidInput>,
    ) -> Findings {
        let scene = scene::<D>(self.parameters);
        let mut simulation = match build(&scene) {
            Ok(simulation) => simulation,
            Err(error) => return Findings::not_built(&error, missing_rows(self.instant)),
        };
        let start = Instant::now();
        let Parameters { dt, steps, .. } = *self.parameters;
        let outcome = march(simulation.as_mut(), dt, 0..steps, (self.progress, steps));
        let seconds = start.elapsed().as_secs_f64();

        let mut counters = counters(simulation.as_ref());
        let rows = if outcome == Outcome::Completed {
            let measured = measure(self.parameters, &scene, &simulation.observe(), self.instant);
            counters.insert("n_measure_fallbacks".to_owned(), measured.n_fallbacks);
            counters.insert("n_measure_empty".to_owned(), measured.n_empty);
            measured.rows
        } else {
            missing_rows(self.instant)
        };
        Findings { outcome, rows, profiles: Vec::new(), rasters: Vec::new(), counters, seconds }
    }
}

pub(super) fn wave(parameters: &Parameters) -> StandingWave {
    StandingWave {
        amplitude: parameters.amplitude,
        length: LENGTH,
        density: DENSITY,
        sound_speed: SOUND_SPEED,
    }
}

/// The box and its points. The lattice and its displacements are laid out in the frame of the wave
/// (along it, then across), so that runs along different axes differ by a permutation alone.
pub(super) fn scene<const D: usize>(parameters: &Parameters) -> Scene<D> {
    let h = parameters.spacing;
    let wave = wave(parameters);
    let mut cells = [parameters.width_cells; D];
    cells[parameters.axis] = (LENGTH / h).round() as usize;
    let frame: [usize; D] = std::array::from_fn(|axis| (axis + D - parameters.axis) % D);

    let mass = DENSITY * power(0.5 * h, D);
    let counts: [usize; D] = std::array::from_fn(|i| cells[(i + parameters.axis) % D]);
    let mut points = Vec::new();
    for along in lattice::positions(h, counts, parameters.jitter, parameters.seed) {
        let mut velocity = [0.0; D];
        velocity[parameters.axis] = wave.velocity(along[0], 0.0);
        let mut velocity_gradient = [[0.0; D]; D];
        velocity_gradient[parameters.axis][parameters.axis] = wave.velocity_gradient(along[0], 0.0);
        let position = frame.map(|i| along[i]);
        let point = PointSpec::new(position, velocity, DENSITY, mass);
        points.push(PointSpec { velocity_gradient, ..point });
    }
    Scene::new(
        GridSpec { origin: [0.0; D], spacing: [h; D], cells },
        [[Boundary::Slip; 2]; D],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    )
}

fn power(base: f64, exponent: usize) -> f64 {
    std::iter::repeat_n(base, exponent).product()
}

/// Times at which pressure and velocity are to be compared.
///
/// A step advances the velocity with the stress, and the density with the velocity, each with the
/// newest value of the other. In such a symplectic scheme the two stand half a step apart. With
/// the stress update last, the density after n steps is that of n Δt and the velocity that of
/// (n − ½) Δt; with the stress update first, the velocity is that of (n + ½) Δt. The start without
/// stagger fits both: pressure and hence acceleration are zero at t = 0, so that
/// v(±Δt/2) = v(0) up to (ω Δt)²/8 relative, 3·10⁻⁷ at most. Positions are those of n Δt, so that
/// the material point is found at that time and only its velocity is taken earlier or later.
pub(super) fn times(stress_update: StressUpdate, time: f64, dt: f64) -> (f64, f64) {
    match stress_update {
        StressUpdate::First => (time, time + 0.5 * dt),
        StressUpdate::Last | StressUpdate::ModifiedLast => (time, time - 0.5 * dt),
    }
}

/// Errors of a run with the counts of fallbacks in the measure itself.
pub(super) struct Measured {
    pub(super) rows: Vec<Row>,
    pub(super) n_fallbacks: u64,
    pub(super) n_empty: u64,
}

/// Errors of pressure and velocity by points, Eq. (40), and at cell centres, Eq. (41).
pub(super) fn measure<const D: usize>(
    parameters: &Parameters,
    scene: &Scene<D>,
    state: &Observation<D>,
    instant: &str,
) -> Measured {
    let wave = wave(parameters);
    let axis = parameters.axis;
    let h = parameters.spacing;
    let (pressure_time, velocity_time) =
        times(parameters.settings.stress_update, state.time, parameters.dt);
    let area = power(WIDTH / (parameters.width_cells as f64 * h), D - 1);
    let mut norms = [L2::default(); 4];
    let mut add = |first: usize, x: f64, pressure: f64, velocity: [f64; D], volume: f64| {
        let material = wave.material(x, state.time);
        let exact = wave.pressure(material, pressure_time);
        norms[first].add((pressure - exact).powi(2), exact * exact, volume * area);
        let exact = wave.velocity(material, velocity_time);
        let mut error = velocity;
        error[axis] -= exact;
        let error = error.iter().map(|e| e * e).sum();
        norms[first + 2].add(error, exact * exact, volume * area);
    };
    for point in &state.points {
        add(0, point.position[axis], point.pressure, point.velocity, point.volume());
    }

    let positions: Vec<_> = state.points.iter().map(|point| point.position).collect();
    // Density above ρ₀ rather than density: the same linear reconstruction with less round-off.
    let fields: Vec<[f64; 4]> = state
        .points
        .iter()
        .map(|point| {
            let mut field = [point.density - DENSITY, 0.0, 0.0, 0.0];
            for (momentum, velocity) in field[1..].iter_mut().zip(point.velocity) {
                *momentum = point.density * velocity;
            }
            field
        })
        .collect();
    let cells = cell_centers::reconstruct(&scene.grid, &scene.boundaries, &positions, &fields);
    for (center, [excess, momentum @ ..]) in &cells.samples {
        let pressure = SOUND_SPEED.powi(2) * excess;
        let velocity = std::array::from_fn(|axis| momentum[axis] / (DENSITY + excess));
        add(1, center[axis], pressure, velocity, power(h, D));
    }

    let rows = ROWS.iter().zip(norms).map(|((quantity, norm), l2)| Row {
        quantity: format!("{quantity}@{instant}"),
        norm: (*norm).to_owned(),
        value: l2.error(),
        scale: l2.exact(),
    });
    Measured { rows: rows.collect(), n_fallbacks: cells.n_fallbacks, n_empty: cells.n_empty }
}
