//! The short channel.

use serde::{Deserialize, Serialize};
use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, InletProfile, InletSpec, Side};

use super::Parameters;
use crate::reference::channel::VofFilm;

/// Length and height of the channel, m \[Song2020\].
pub(super) const DOMAIN: [f64; 2] = [0.06, 0.01];
/// Speed of the inlet, m/s.
pub(super) const SPEED: f64 = 0.05;
/// ν, m²/s: Re = 500 on the height.
const VISCOSITY: f64 = 1e-6;
/// g, m/s².
pub(super) const GRAVITY: f64 = 9.8;
/// ρ₀, kg/m³.
pub(super) const DENSITY: f64 = 1000.0;
/// c₀ = 10 √(g H), m/s, for the height H of the channel.
pub(super) const SOUND_SPEED: f64 = 3.13;
/// Least pressure, Pa: the same share of ρ₀ g H, 0.85, as in the dam break.
const MINIMUM_PRESSURE: f64 = -83.0;

/// What is assumed of inlet, gravity and bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Flow {
    /// Inlet over the full height, gravity, no-slip bed.
    FullNoslip,
    /// The same with a slip bed.
    FullSlip,
    /// Inlet over the lower half, gravity, no-slip bed.
    HalfNoslip,
    /// Inlet over the full height, no gravity, slip bed.
    FullSlipWeightless,
}

impl Flow {
    /// Every flow, that of the paper first.
    pub(super) const ALL: [Self; 4] =
        [Self::FullNoslip, Self::FullSlip, Self::HalfNoslip, Self::FullSlipWeightless];

    /// The value of the label `flow`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::FullNoslip => "full-noslip",
            Self::FullSlip => "full-slip",
            Self::HalfNoslip => "half-noslip",
            Self::FullSlipWeightless => "full-slip-weightless",
        }
    }

    /// The volume-of-fluid run of this flow on cells of 0.25 mm.
    pub(super) const fn film(self) -> VofFilm {
        match self {
            Self::FullNoslip => VofFilm::FullNoSlip,
            Self::FullSlip => VofFilm::FullSlip,
            Self::HalfNoslip => VofFilm::HalfNoSlip,
            Self::FullSlipWeightless => VofFilm::FullSlipWeightless,
        }
    }

    /// The one on cells of 0.125 mm, where there is one.
    pub(super) fn fine_film(self) -> Option<VofFilm> {
        (self == Self::FullNoslip).then_some(VofFilm::FullNoSlipFine)
    }
}

/// The empty channel; the column of cells left of x = 0 belongs to the inlet.
pub(super) fn scene(parameters: &Parameters) -> Scene<2> {
    let (h, flow) = (parameters.spacing, parameters.flow);
    let count = |length: f64| (length / h).round() as usize;
    let bed = match flow {
        Flow::FullNoslip | Flow::HalfNoslip => Boundary::NoSlip,
        Flow::FullSlip | Flow::FullSlipWeightless => Boundary::Slip,
    };
    let height = if flow == Flow::HalfNoslip { 0.5 * DOMAIN[1] } else { DOMAIN[1] };
    let gravity = if flow == Flow::FullSlipWeightless { 0.0 } else { GRAVITY };
    let mut scene = Scene::new(
        GridSpec {
            origin: [-h, 0.0],
            spacing: [h; 2],
            cells: [count(DOMAIN[0]) + 1, count(DOMAIN[1])],
        },
        [[Boundary::Slip, Boundary::Free], [bed, Boundary::Free]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        Vec::new(),
    );
    scene.body_force = [0.0, -gravity];
    scene.viscosity = Some(VISCOSITY);
    scene.minimum_pressure = Some(MINIMUM_PRESSURE);
    scene.inlets.push(InletSpec {
        axis: 0,
        side: Side::Lower,
        lower: [0.0; 2],
        upper: [0.0, height],
        velocity: [SPEED, 0.0],
        profile: InletProfile::Uniform,
        hydrostatic: true,
        points_per_axis: parameters.points_per_axis,
        supply: parameters.supply,
    });
    scene
}
