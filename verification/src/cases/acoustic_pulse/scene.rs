//! Set-up and stepping of one run.

use std::time::Instant;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{InvalidInput, Observation, Scene, Simulation};

use super::measure::{Measured, missing_rows};
use super::{Parameters, study};
use crate::case::{Findings, Outcome};
use crate::cases::lattice;
use crate::cases::march::{counters, march};
use crate::exact::acoustic::GaussianBump;
use crate::progress::Progress;

/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// c₀, m/s.
pub(super) const SOUND_SPEED: f64 = 50.0;
/// Center of the pulse on every axis, m.
pub(super) const CENTER: f64 = 0.5;
/// The initial pressure over the distance from the center. Nonlinearity changes the result by about
/// the compression of 10⁻⁶.
pub(super) const BUMP: GaussianBump = GaussianBump {
    amplitude: 1e-6 * DENSITY * SOUND_SPEED * SOUND_SPEED,
    decay: 200.0,
    center: 0.0,
    period: None,
};

/// Builds, steps and measures.
pub(super) fn execute<const D: usize>(
    parameters: &Parameters,
    progress: &Progress,
    measure: impl FnOnce(&Parameters, &Scene<D>, &Observation<D>) -> Measured,
    build: impl FnOnce(&Scene<D>) -> Result<Box<dyn Simulation<D>>, InvalidInput>,
) -> Findings {
    let scene = scene::<D>(parameters);
    let mut simulation = match build(&scene) {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing_rows(study(D))),
    };
    let Parameters { dt, steps, .. } = *parameters;
    let start = Instant::now();
    let outcome = march(simulation.as_mut(), dt, 0..steps, (progress, steps));
    let seconds = start.elapsed().as_secs_f64();
    let mut counters = counters(simulation.as_ref());
    let (mut rows, mut profiles) = (missing_rows(study(D)), Vec::new());
    if outcome == Outcome::Completed {
        let measured = measure(parameters, &scene, &simulation.observe());
        counters.insert("n_measure_fallbacks".to_owned(), measured.n_fallbacks);
        counters.insert("n_measure_empty".to_owned(), measured.n_empty);
        (rows, profiles) = (measured.rows, measured.profiles);
    }
    Findings { outcome, rows, profiles, rasters: Vec::new(), counters, seconds }
}

/// The periodic box with the bump at rest.
pub(super) fn scene<const D: usize>(parameters: &Parameters) -> Scene<D> {
    let h = 1.0 / parameters.cells as f64;
    let cells = [parameters.cells; D];
    let volume: f64 = std::iter::repeat_n(0.5 * h, D).product();
    // Half a step back, where the acceleration is that of t = 0 to second order.
    let impulse = 0.5 * parameters.dt / DENSITY;
    let points = lattice::positions(h, cells, parameters.jitter, parameters.seed)
        .into_iter()
        .map(|position| {
            let offset = position.map(|x| x - CENTER);
            let radius = offset.iter().map(|d| d * d).sum::<f64>().sqrt();
            let (pressure, decay) = (BUMP.value(radius), BUMP.decay);
            let density = DENSITY + pressure / (SOUND_SPEED * SOUND_SPEED);
            let velocity = offset.map(|d| impulse * -2.0 * decay * d * pressure);
            let mut velocity_gradient = [[0.0; D]; D];
            for (i, row) in velocity_gradient.iter_mut().enumerate() {
                for (j, slope) in row.iter_mut().enumerate() {
                    let unit = if i == j { 2.0 * decay } else { 0.0 };
                    let bend = 4.0 * decay * decay * offset[i] * offset[j] - unit;
                    *slope = impulse * bend * pressure;
                }
            }
            let point = PointSpec::new(position, velocity, density, density * volume);
            PointSpec { velocity_gradient, ..point }
        })
        .collect();
    Scene::new(
        GridSpec { origin: [0.0; D], spacing: [h; D], cells },
        [[Boundary::Periodic; 2]; D],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    )
}
