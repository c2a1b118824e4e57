//! The channel with the cylinder \[SchaeferTurek1996\]: lengths in m, velocities in m/s.

use transpoint::scene::{
    BodyShape, BodySpec, BodySurface, Boundary, EquationOfStateSpec, GridSpec, InletProfile,
    InletSpec, PointSpec, Relaxation, Side, Supply,
};
use transpoint::{InvalidInput, Scene};

use super::Parameters;

/// Height of the channel.
pub(super) const HEIGHT: f64 = 0.41;
/// Diameter of the cylinder, D.
pub(super) const DIAMETER: f64 = 0.1;
/// Its center; the lower left corner of the channel is the origin.
pub(super) const CENTER: [f64; 2] = [0.2, 0.2];
/// Mean velocity of the inflow, U.
pub(super) const SPEED: f64 = 1.0;
/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1.0;
/// c₀: about ten times the largest speed, which is 2 U beside the cylinder.
pub(super) const SOUND_SPEED: f64 = 20.0;
/// Length of the layers in which the outflow relaxes, m.
pub(super) const OUTFLOW_LAYER: f64 = DIAMETER;
/// Its time constant, s: a quarter of what sound takes through the layers and back, so that 2 % of it are left.
/// With too long a one the channel resounds: its quarter wave, 4 L/c₀, is as long as half a period of shedding
/// where L = 8 D.
pub(super) const OUTFLOW_TIME: f64 = 0.5 * OUTFLOW_LAYER / SOUND_SPEED;
/// The flow at the start leaves the cylinder at rest within this distance from its surface.
const START_LAYER: f64 = DIAMETER;

/// T = t U/D.
pub(super) fn scaled_time(time: f64) -> f64 {
    time * SPEED / DIAMETER
}

/// Kinematic viscosity, m²/s.
pub(super) fn viscosity(reynolds: f64) -> f64 {
    SPEED * DIAMETER / reynolds
}

/// Force per depth, N/m, over ½ ρ₀ U² D.
pub(super) fn coefficient(force: f64) -> f64 {
    force / (0.5 * DENSITY * SPEED * SPEED * DIAMETER)
}

/// The cylinder, a circle.
pub(super) const CIRCLE: BodyShape<2> = BodyShape::Ball { center: CENTER, radius: 0.5 * DIAMETER };

/// Cell size, m.
pub(super) fn spacing(cells_across: usize) -> f64 {
    HEIGHT / cells_across as f64
}

/// Stream function of the flow at the start: that of the parabola, brought to a constant on the cylinder by a
/// cubic blend, so that it has no divergence and stands still on every wall.
fn stream_function([x, y]: [f64; 2]) -> f64 {
    let parabola = |y: f64| {
        let s = y / HEIGHT;
        SPEED * HEIGHT * s * s * (3.0 - 2.0 * s)
    };
    let distance = CIRCLE.level([x, y]);
    let s = (distance / START_LAYER).clamp(0.0, 1.0);
    (parabola(y) - parabola(CENTER[1])) * s * s * (3.0 - 2.0 * s)
}

/// Velocity at the start, by central differences of the stream function.
pub(super) fn start_velocity([x, y]: [f64; 2]) -> [f64; 2] {
    const STEP: f64 = 1e-5 * DIAMETER;
    let slope = |a: f64, b: f64| (a - b) / (2.0 * STEP);
    [
        slope(stream_function([x, y + STEP]), stream_function([x, y - STEP])),
        -slope(stream_function([x + STEP, y]), stream_function([x - STEP, y])),
    ]
}

/// The center of the cell of a position.
pub(super) fn cell_center(position: [f64; 2], spacing: f64) -> [f64; 2] {
    position.map(|x| ((x / spacing).floor() + 0.5) * spacing)
}

/// The scene of a run.
///
/// # Errors
/// When a number of the parameters makes no scene.
pub(super) fn scene(parameters: &Parameters) -> Result<Scene<2>, InvalidInput> {
    let Parameters { cells_across, points_per_axis, length, reynolds, .. } = *parameters;
    let ranges = [
        ("cells_across", cells_across as f64, 4.0, 1000.0),
        ("points_per_axis", points_per_axis as f64, 1.0, 8.0),
        ("length", length, 4.0, 100.0),
        ("reynolds", reynolds, 1e-3, 1e3),
        ("radius", parameters.radius, 0.1 * DIAMETER, DIAMETER),
    ];
    for (field, value, least, most) in ranges {
        if !(least..=most).contains(&value) {
            return Err(InvalidInput::new(field, value, format!("{least} to {most}")));
        }
    }
    let h = spacing(cells_across);
    let columns = (length * DIAMETER / h).round() as usize;
    let viscosity = viscosity(reynolds);
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: DENSITY,
        sound_speed: SOUND_SPEED,
    };
    let layers = (OUTFLOW_LAYER / h).round() as usize;
    let relaxation = Relaxation { pressure: 0.0, velocity: None, time: OUTFLOW_TIME, layers };
    let outflow = Boundary::Outflow { relaxation: Some(relaxation) };
    let grid = GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [columns, cells_across] };
    let boundaries = [[Boundary::Slip, outflow], [Boundary::NoSlip; 2]];
    let mut scene = Scene::new(grid, boundaries, law, points(parameters, columns));
    scene.viscosity = Some(viscosity);
    scene.inlets.push(InletSpec {
        axis: 0,
        side: Side::Lower,
        lower: [0.0; 2],
        upper: [0.0, HEIGHT],
        velocity: [SPEED, 0.0],
        profile: InletProfile::Parabolic,
        hydrostatic: false,
        points_per_axis,
        supply: Supply::Flux,
    });
    scene.bodies.push(BodySpec { shape: parameters.shape(), surface: BodySurface::NoSlip });
    Ok(scene)
}

/// Points on a lattice in every cell but those of the inlet and of the cylinder, under the pressure of the
/// flow without a cylinder.
fn points(parameters: &Parameters, columns: usize) -> Vec<PointSpec<2>> {
    let Parameters { cells_across, points_per_axis, reynolds, .. } = *parameters;
    let h = spacing(cells_across);
    let pitch = h / points_per_axis as f64;
    let gradient = 12.0 * DENSITY * viscosity(reynolds) * SPEED / (HEIGHT * HEIGHT);
    let mut points = Vec::new();
    for column in points_per_axis..columns * points_per_axis {
        for row in 0..cells_across * points_per_axis {
            let position = [column, row].map(|index| (index as f64 + 0.5) * pitch);
            if parameters.shape().level(cell_center(position, h)) < 0.0 {
                continue;
            }
            let pressure = gradient * (columns as f64 * h - position[0]);
            let density = DENSITY + pressure / (SOUND_SPEED * SOUND_SPEED);
            let mass = density * pitch * pitch;
            points.push(PointSpec::new(position, start_velocity(position), density, mass));
        }
    }
    points
}
