//! The jet, the plate, and the box around them.

use serde::{Deserialize, Serialize};
use transpoint::Scene;
use transpoint::scene::{
    Boundary, EquationOfStateSpec, GridSpec, InletProfile, InletSpec, PointSpec, Side, Supply,
};

use super::Parameters;
use crate::cases::lattice::lattice;
use crate::exact::jet_on_plate::JetOnPlate;

/// Width b, m, speed U, m/s, and density ρ₀, kg/m³: the scales of everything.
pub(super) const JET: JetOnPlate = JetOnPlate { width: 0.1, speed: 1.0, density: 1000.0 };
/// c₀/U.
const SOUND: f64 = 10.0;
/// c₀, m/s.
pub(super) const SOUND_SPEED: f64 = SOUND * JET.speed;
/// Distance of the open faces from the axis, b.
pub(super) const REACH: usize = 4;
/// Points per cell and axis, as in the dense dam break.
pub(super) const POINTS_PER_AXIS: usize = 4;

/// T = t U/b at a time t in s.
pub(super) fn scaled_time(time: f64) -> f64 {
    time * JET.speed / JET.width
}

/// −p of the least pressure, ½ ρ U².
const LEAST_PRESSURE: f64 = 1.0;

/// What fills the box at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Start {
    /// The exact flow.
    Exact,
    /// The jet from the inlet almost to the plate, which it hits with the pressure ρ c₀ U.
    Blow,
}

/// The box: the plate is its lower face, the inlet lies in its upper face, the faces at the sides are
/// open. Of half a jet the left face is the plane of symmetry, a slip wall.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let Parameters { cells, whole, supply, .. } = *parameters;
    let h = JET.width / cells as f64;
    let sides = if whole { 2 } else { 1 };
    // The first column of the inlet is not part of the flow.
    let height = (parameters.distance * cells as f64).round() as usize + 1;
    let [left, opening] =
        [-(REACH as f64) * JET.width, -0.5 * JET.width].map(|x| if whole { x } else { 0.0 });
    let grid =
        GridSpec { origin: [left, 0.0], spacing: [h; 2], cells: [sides * REACH * cells, height] };
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: JET.density,
        sound_speed: SOUND_SPEED,
    };
    let layers = if supply == Supply::Columns { 2 } else { 1 };
    let d = h / POINTS_PER_AXIS as f64;
    let counts = [grid.cells[0], height - layers].map(|n| n * POINTS_PER_AXIS);
    let places = lattice(counts, d, 0.0, 0).into_iter().map(|[x, y]| [x + left, y]);
    let points = places.filter_map(|place| point(parameters.start, place, d, h)).collect();
    let side = if whole { Boundary::Free } else { Boundary::Slip };
    let mut scene = Scene::new(grid, [[side, Boundary::Free], [Boundary::Slip; 2]], law, points);
    scene.minimum_pressure = Some(-LEAST_PRESSURE * JET.stagnation_pressure());
    scene.inlets.push(InletSpec {
        axis: 1,
        side: Side::Upper,
        lower: [opening, 0.0],
        upper: [0.5 * JET.width, 0.0],
        velocity: [0.0, -JET.speed],
        profile: InletProfile::Uniform,
        hydrostatic: false,
        points_per_axis: POINTS_PER_AXIS,
        supply,
    });
    scene
}

/// The point at a place of the lattice with the spacing `d` in cells of size `h` (m), if the liquid is there
/// at the start.
fn point(start: Start, place: [f64; 2], d: f64, h: f64) -> Option<PointSpec<2>> {
    let [x, y] = place;
    if start == Start::Blow {
        let velocity = [0.0, -JET.speed];
        let inside = x.abs() < 0.5 * JET.width && y > h;
        return inside.then(|| PointSpec::new(place, velocity, JET.density, JET.density * d * d));
    }
    let flow = JET.at([x.abs(), y])?;
    let density = JET.density + flow.pressure / SOUND_SPEED.powi(2);
    let mirror = x.signum();
    let velocity = [mirror * flow.velocity[0], flow.velocity[1]];
    let mut point = PointSpec::new(place, velocity, density, density * d * d);
    let [[xx, xy], [yx, yy]] = flow.velocity_gradient;
    point.velocity_gradient = [[xx, mirror * xy], [mirror * yx, yy]];
    Some(point)
}
