//! The tank and the column of water in it, in two and three dimensions.

use serde::{Deserialize, Serialize};
use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::Parameters;
use crate::cases::lattice::lattice;

/// Length and height of the tank, m \[Song2020\].
const TANK: [f64; 2] = [3.22, 2.0];
/// Length l₀ and height h₀ of the column, m.
pub(super) const COLUMN: [f64; 2] = [1.2, 0.6];
/// Depth of tank and column in three dimensions, m.
const DEPTH: f64 = 0.3;
/// Cells across the slab.
const SLAB_CELLS: usize = 2;
/// g, m/s².
pub(super) const GRAVITY: f64 = 9.8;
/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// c₀, m/s.
pub(in crate::cases) const SOUND_SPEED: f64 = 50.0;
/// Least pressure, Pa.
const MINIMUM_PRESSURE: f64 = -5000.0;
/// The axis that points up.
pub(super) const UP: usize = 1;

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Shape {
    /// Two dimensions.
    Plane,
    /// Three dimensions between slip walls.
    Tank,
    /// The plane, and two periodic cells of it in three dimensions.
    Slab,
}

impl Shape {
    /// Cells across, and what holds on the faces there.
    fn across(self, spacing: f64) -> (usize, Boundary) {
        match self {
            Self::Slab => (SLAB_CELLS, Boundary::Periodic),
            Self::Tank | Self::Plane => ((DEPTH / spacing).round() as usize, Boundary::Slip),
        }
    }
}

/// Scale of pressures ρ₀ g h₀, Pa.
pub(super) const fn pressure_scale() -> f64 {
    DENSITY * GRAVITY * COLUMN[1]
}

/// T = t √(h₀ g)/l₀ at a time t in s.
pub(in crate::cases) fn scaled_time(time: f64) -> f64 {
    crate::reference::dam_break::scaled_time(time, GRAVITY, COLUMN[0], COLUMN[1])
}

/// The tank with its column at rest under hydrostatic pressure; the walls stand where cells end.
pub(super) fn scene<const D: usize>(parameters: &Parameters) -> Scene<D> {
    let h = parameters.spacing;
    let (across, side) = parameters.shape.across(h);
    let count = |length: f64| (length / h).round() as usize;
    let per_axis = |tank: [usize; 2]| -> [usize; D] {
        std::array::from_fn(|axis| tank.get(axis).copied().unwrap_or(across))
    };
    let mut boundaries = [[side; 2]; D];
    boundaries[0] = [Boundary::Slip; 2];
    boundaries[UP] = [Boundary::Slip, Boundary::Free];
    let d = h / parameters.points_per_axis as f64;
    let counts = per_axis(COLUMN.map(count)).map(|cells| cells * parameters.points_per_axis);
    let place = |position: [f64; D]| {
        let pressure = DENSITY * GRAVITY * (COLUMN[1] - position[UP]);
        let density = DENSITY + pressure / SOUND_SPEED.powi(2);
        PointSpec::new(position, [0.0; D], density, density * d.powi(D as i32))
    };
    let mut scene = Scene::new(
        GridSpec { origin: [0.0; D], spacing: [h; D], cells: per_axis(TANK.map(count)) },
        boundaries,
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        lattice(counts, d, 0.0, 0).into_iter().map(place).collect(),
    );
    scene.body_force[UP] = -GRAVITY;
    scene.minimum_pressure = Some(MINIMUM_PRESSURE);
    scene
}
