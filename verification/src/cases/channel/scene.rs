//! The channel, its inlet and its end.

use serde::{Deserialize, Serialize};
use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, InletProfile, InletSpec, Side};

use super::Parameters;

/// Length and height of the channel, m \[Song2020\].
pub(super) const DOMAIN: [f64; 2] = [2.0, 0.2];
/// g, m/s².
pub(super) const GRAVITY: f64 = 9.8;
/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// c₀, m/s: over ten times the largest speed, which is about √(2 g h_in + v₀²) = 1.5 m/s.
pub(super) const SOUND_SPEED: f64 = 20.0;
/// Least pressure, Pa.
const MINIMUM_PRESSURE: f64 = -5000.0;

/// What holds at the end of the channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Outlet {
    /// No traction.
    Free,
    /// The velocity of the nodes next to it.
    ZeroGradient,
}

/// The empty channel; the column of cells left of x = 0 belongs to the inlet.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let h = parameters.spacing;
    let count = |length: f64| (length / h).round() as usize;
    let end = match parameters.outlet {
        Outlet::Free => Boundary::Free,
        Outlet::ZeroGradient => Boundary::OUTFLOW,
    };
    let mut scene = Scene::new(
        GridSpec {
            origin: [-h, 0.0],
            spacing: [h; 2],
            cells: [count(DOMAIN[0]) + 1, count(DOMAIN[1])],
        },
        [[Boundary::Slip, end], [Boundary::Slip, Boundary::Free]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        Vec::new(),
    );
    scene.body_force = [0.0, -GRAVITY];
    scene.minimum_pressure = Some(MINIMUM_PRESSURE);
    scene.inlets.push(InletSpec {
        axis: 0,
        side: Side::Lower,
        lower: [0.0; 2],
        upper: [0.0, parameters.inlet_height],
        velocity: [parameters.speed, 0.0],
        profile: InletProfile::Uniform,
        hydrostatic: true,
        points_per_axis: parameters.points_per_axis,
        supply: parameters.supply,
    });
    scene
}
