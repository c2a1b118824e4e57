//! Set-up, stepping and measurement of one run.

use std::time::Instant;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;
use transpoint::{InvalidInput, Observation, Scene, Simulation};

use super::Parameters;
use crate::case::{Findings, Outcome, Row};
use crate::cases::lattice;
use crate::cases::march::{counters, march};
use crate::exact::elastic_bar::ElasticBar;
use crate::measure::samples::{Sample, at_centers, at_points, l2};
use crate::progress::Progress;

/// c₀, m/s: the speed of sound without shear modulus.
const SOUND_SPEED: f64 = 50.0;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// K, Pa.
const BULK_MODULUS: f64 = DENSITY * SOUND_SPEED * SOUND_SPEED;

/// The bar; its largest strain is V/c = 10⁻⁷.
pub(super) const BAR: ElasticBar = ElasticBar {
    amplitude: 1e-7 * std::f64::consts::SQRT_2 * SOUND_SPEED,
    mode: 2,
    length: 1.0,
    density: DENSITY,
    bulk_modulus: BULK_MODULUS,
    shear_modulus: 0.75 * BULK_MODULUS,
};

const INSTANTS: [&str; 2] = ["T/4", "T"];
const QUANTITIES: [&str; 3] = ["pressure", "deviatoric", "velocity"];
const NORMS: [&str; 2] = ["point-l2", "gauss-l2"];
/// Further rows at T.
const MODE: [(&str, &str); 2] = [("phase@T", "relative"), ("loss@T", "relative")];

/// The rows of a run that has no values.
pub(super) fn missing_rows() -> Vec<Row> {
    let errors = INSTANTS.into_iter().flat_map(|instant| {
        QUANTITIES.into_iter().flat_map(move |quantity| {
            NORMS.map(|norm| Row::missing(format!("{quantity}@{instant}"), norm))
        })
    });
    errors.chain(MODE.map(|(quantity, norm)| Row::missing(quantity, norm))).collect()
}

/// Builds, steps and measures at both instants.
pub(super) fn execute(
    parameters: &Parameters,
    progress: &Progress,
    build: impl FnOnce(&Scene<1>) -> Result<Box<dyn Simulation<1>>, InvalidInput>,
) -> Findings {
    let scene = scene(parameters);
    let mut simulation = match build(&scene) {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing_rows()),
    };
    let (quarter, total) = (parameters.quarter, 4 * parameters.quarter);
    let (mut values, mut outcome, mut seconds) = (Vec::new(), Outcome::Completed, 0.0);
    for steps in [0..quarter, quarter..total] {
        let start = Instant::now();
        outcome = march(simulation.as_mut(), parameters.dt, steps, (progress, total));
        seconds += start.elapsed().as_secs_f64();
        if outcome != Outcome::Completed {
            break;
        }
        values.extend(errors(parameters, &scene, &simulation.observe()));
    }
    if outcome == Outcome::Completed {
        values.extend(phase_and_loss(parameters, &simulation.observe()).map(|value| (value, 1.0)));
    }
    // What was measured before a blow-up stands.
    let mut rows = missing_rows();
    for (row, (value, scale)) in rows.iter_mut().zip(values) {
        (row.value, row.scale) = (value, scale);
    }
    let counters = counters(simulation.as_ref());
    Findings { outcome, rows, profiles: Vec::new(), rasters: Vec::new(), counters, seconds }
}

/// The undeformed bar, its velocity half a step back.
pub(super) fn scene(parameters: &Parameters) -> Scene<1> {
    let h = BAR.length / parameters.cells as f64;
    let before = -0.5 * parameters.dt;
    let points = lattice::positions(h, [parameters.cells], parameters.jitter, parameters.seed)
        .into_iter()
        .map(|[x]| {
            let k = BAR.wave_number();
            let slope = k * BAR.velocity(0.5 * std::f64::consts::PI / k, before) * (k * x).cos();
            let velocity = [BAR.velocity(x, before)];
            let point = PointSpec::new([x], velocity, DENSITY, DENSITY * 0.5 * h);
            PointSpec { velocity_gradient: [[slope]], ..point }
        })
        .collect();
    let mut scene = Scene::new(
        GridSpec { origin: [0.0], spacing: [h], cells: [parameters.cells] },
        [[Boundary::Slip; 2]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    );
    scene.shear_modulus = Some(BAR.shear_modulus);
    scene
}

fn values(point: &PointState<1>) -> [f64; 3] {
    [point.pressure, point.stress[0][0], point.velocity[0]]
}

fn exact(parameters: &Parameters, [x]: [f64; 1], time: f64) -> [f64; 3] {
    let velocity = BAR.velocity(x, time - 0.5 * parameters.dt);
    [BAR.pressure(x, time), BAR.deviatoric_axial(x, time), velocity]
}

/// Errors with their scales, by quantity and norm.
pub(super) fn errors(
    parameters: &Parameters,
    scene: &Scene<1>,
    state: &Observation<1>,
) -> Vec<(f64, f64)> {
    let exact = |position| exact(parameters, position, state.time);
    let points = at_points(state, values, exact);
    let centers = at_centers(scene, state, values, exact).samples;
    let norm = |samples: &[Sample<1, 3>], field: usize| {
        let norm = l2(samples, &(field..field + 1));
        (norm.error(), norm.exact())
    };
    (0..3).flat_map(|field| [norm(&points, field), norm(&centers, field)]).collect()
}

/// Relative error of the frequency and relative loss of amplitude after a whole period.
///
/// The velocity is A cos(ω't − ωΔt/2) times the mode, the axial stress A sin(ω't) times its own, each by
/// its projection: A and ω't − 2π follow up to second order in the latter.
pub(super) fn phase_and_loss(parameters: &Parameters, state: &Observation<1>) -> [f64; 2] {
    let k = BAR.wave_number();
    let (mut stress, mut velocity, mut norms) = (0.0, 0.0, [0.0; 2]);
    for point in &state.points {
        let (sine, cosine) = (k * point.position[0]).sin_cos();
        let volume = point.volume();
        stress += (point.stress[0][0] - point.pressure) * cosine * volume;
        velocity += point.velocity[0] * sine * volume;
        norms[0] += cosine * cosine * volume;
        norms[1] += sine * sine * volume;
    }
    let sine = stress / norms[0] / (BAR.modulus() * BAR.amplitude / BAR.wave_speed());
    let half_step = 0.5 * BAR.angular_frequency() * parameters.dt;
    // cos(φ − δ) = cos φ cos δ + sin φ sin δ with δ half a step.
    let turned = velocity / norms[1] / BAR.amplitude;
    let cosine = (turned - sine * half_step.sin()) / half_step.cos();
    [sine.atan2(cosine) / std::f64::consts::TAU, 1.0 - sine.hypot(cosine)]
}
