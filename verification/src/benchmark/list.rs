//! The problems, and the methods that are compared on them.

use transpoint::Variant;

use super::{AnyProblem, Benchmark};
use crate::problems::{
    advected_wave, cavity, drop, generalized_vortex, gravity_wave, gresho, hydrostatic_tank,
    loaded_column, poiseuille, pressure_pulse, riemann_tube, solitary_wave, taylor_green,
};

/// The problems, in the order of the page.
pub static ALL: [Benchmark; 17] = [
    Benchmark(AnyProblem::Line(&advected_wave::AdvectedWave)),
    Benchmark(AnyProblem::Line(&riemann_tube::RiemannTube)),
    Benchmark(AnyProblem::Plane(&pressure_pulse::PressurePulse)),
    Benchmark(AnyProblem::Plane(&poiseuille::PoiseuilleStart)),
    Benchmark(AnyProblem::Plane(&taylor_green::RE_100)),
    Benchmark(AnyProblem::Plane(&taylor_green::RE_1000)),
    Benchmark(AnyProblem::Plane(&taylor_green::INVISCID)),
    Benchmark(AnyProblem::Plane(&gresho::GreshoVortex)),
    Benchmark(AnyProblem::Plane(&cavity::LidCavity)),
    Benchmark(AnyProblem::Line(&loaded_column::SuddenLoad)),
    Benchmark(AnyProblem::Plane(&hydrostatic_tank::LEVEL)),
    Benchmark(AnyProblem::Plane(&hydrostatic_tank::TILTED)),
    Benchmark(AnyProblem::Plane(&gravity_wave::StandingGravityWave)),
    Benchmark(AnyProblem::Plane(&solitary_wave::RunningWave)),
    Benchmark(AnyProblem::Plane(&drop::ELLIPTICAL)),
    Benchmark(AnyProblem::Plane(&drop::OSCILLATING)),
    Benchmark(AnyProblem::Plane(&generalized_vortex::TurnedAnnulus)),
];

/// The methods compared: those that every case compares, and of their rivals the ones that differ most.
pub const VARIANTS: [Variant; 20] = [
    Variant::Tpm,
    Variant::TpmVp,
    Variant::Mpm,
    Variant::Gimp,
    Variant::Bspline2,
    Variant::Bspline3,
    Variant::Apic,
    Variant::MpmVp,
    Variant::TpmVpQuadratic,
    Variant::TpmVpConstant,
    Variant::GimpVp,
    Variant::Fmpm4Periodic,
    Variant::Staggered,
    Variant::Bspline2Fbar,
    Variant::TpicFbar,
    Variant::TpmVpFmpm,
    Variant::TpmVpEven,
    Variant::CellAdjoint,
    Variant::TpmAffine,
    Variant::CellAdjointAffine,
];

/// Those of them that the bare command runs, at three levels.
pub(super) const SHOWN: [Variant; 8] = [
    Variant::Tpm,
    Variant::Mpm,
    Variant::Gimp,
    Variant::Bspline2,
    Variant::Apic,
    Variant::TpmVpQuadratic,
    Variant::TpmVpEven,
    Variant::CellAdjoint,
];
