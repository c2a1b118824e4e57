//! The channel that ends, and the box around it.

use transpoint::Scene;
use transpoint::scene::{
    BodyShape, BodySpec, BodySurface, Boundary, EquationOfStateSpec, GridSpec, InletProfile,
    InletSpec, PointSpec, Side, Supply,
};

use super::Parameters;
use crate::cases::lattice::lattice;

/// Critical depth y_c, m.
pub(super) const CRITICAL_DEPTH: f64 = 0.1;
/// g, m/s².
pub(super) const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// c₀ over the speed √(g y_c) at the critical depth.
const SOUND: f64 = 10.0;
/// Length of the bed from the plane of the inlet to the brink, y_c.
pub(super) const LENGTH: usize = 6;
/// What lies beyond the brink, below and above the bed, half y_c.
const BEYOND: usize = 6;
const BELOW: usize = 3;
const ABOVE: usize = 4;
/// −p of the least pressure, ρ₀ g y_c.
const LEAST_PRESSURE: f64 = 1.0;
/// Points per cell and axis.
pub(super) const POINTS_PER_AXIS: usize = 2;

/// Speed √(g y_c) at the critical depth, m/s.
pub(super) fn critical_speed() -> f64 {
    (GRAVITY * CRITICAL_DEPTH).sqrt()
}

/// Discharge per width q = √(g y_c³), m²/s.
pub(super) fn discharge() -> f64 {
    critical_speed() * CRITICAL_DEPTH
}

/// c₀, m/s.
pub(super) fn sound_speed() -> f64 {
    SOUND * critical_speed()
}

/// T = t √(g/y_c) at a time t in s.
pub(super) fn scaled_time(time: f64) -> f64 {
    time * critical_speed() / CRITICAL_DEPTH
}

/// Columns of cells from the left face to the brink: one belongs to the inlet.
pub(super) const fn columns_to_brink(cells: usize) -> usize {
    1 + LENGTH * cells
}

/// Layers of cells below the bed.
pub(super) const fn layers_below(cells: usize) -> usize {
    BELOW * cells / 2
}

/// The stream as it comes in fills the channel to the brink at the start. Beyond the brink it falls and
/// leaves through the lower or the right face.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let Parameters { cells, inlet_cells, .. } = *parameters;
    let h = CRITICAL_DEPTH / cells as f64;
    let (brink, bed) = (columns_to_brink(cells), layers_below(cells));
    let depth = inlet_cells as f64 * h;
    let speed = discharge() / depth;
    let grid = GridSpec {
        origin: [0.0; 2],
        spacing: [h; 2],
        cells: [brink + BEYOND * cells / 2, bed + ABOVE * cells / 2],
    };
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: DENSITY,
        sound_speed: sound_speed(),
    };
    let [edge, floor] = [brink, bed].map(|n| n as f64 * h);
    let inlet = InletSpec {
        axis: 0,
        side: Side::Lower,
        lower: [0.0, floor],
        upper: [0.0, floor + depth],
        velocity: [speed, 0.0],
        profile: InletProfile::Uniform,
        hydrostatic: true,
        points_per_axis: POINTS_PER_AXIS,
        supply: Supply::Flux,
    };
    let force = [0.0, -GRAVITY];
    let d = h / POINTS_PER_AXIS as f64;
    let counts = [brink - 1, inlet_cells].map(|n| n * POINTS_PER_AXIS);
    let place = |position: [f64; 2]| {
        let position = [position[0] + h, position[1] + floor];
        let pressure = inlet.pressure_at(position, DENSITY, force);
        let density = DENSITY + pressure / sound_speed().powi(2);
        PointSpec::new(position, [speed, 0.0], density, density * d * d)
    };
    let points = lattice(counts, d, 0.0, 0).into_iter().map(place).collect();
    let boundaries = [[Boundary::Slip, Boundary::Free], [Boundary::Free, Boundary::Slip]];
    let mut scene = Scene::new(grid, boundaries, law, points);
    scene.body_force = force;
    scene.minimum_pressure = Some(-LEAST_PRESSURE * DENSITY * GRAVITY * CRITICAL_DEPTH);
    scene.inlets.push(inlet);
    scene.bodies.push(BodySpec {
        // It reaches beyond the box, so that no other face of it matters.
        shape: BodyShape::Box { lower: [-edge, -floor], upper: [edge, floor] },
        surface: BodySurface::Slip,
    });
    scene
}
