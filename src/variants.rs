//! The named recipes: the only place where the generic solver becomes concrete.

use serde::{Deserialize, Serialize};

use crate::error::InvalidInput;
use crate::scene::Scene;
use crate::simulation::Simulation;

/// Parameters shared by every variant: one policy for all methods, printed with each table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// When the density (and with it the stress) is updated within a step.
    pub stress_update: StressUpdate,
    /// Share of FLIP in the velocity update of variants that blend PIC and FLIP.
    pub blend: Blend,
    /// Half width of the moving-least-squares support, cells.
    pub support: f64,
    /// θ of the positivity limiter of moving least squares; absent: off.
    pub positivity: Option<f64>,
    /// Length of a uGIMP particle, cells, `0 < l ≤ 1`.
    pub gimp_length: f64,
    /// Volume of points in boundary cells (mixed quadrature).
    pub point_volume: PointVolume,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            stress_update: StressUpdate::Last,
            blend: Blend::PerStep(1.0),
            support: 1.0,
            positivity: None,
            gimp_length: 0.5,
            point_volume: PointVolume::Sphere,
        }
    }
}

/// When density and stress are updated: USF, USL or MUSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StressUpdate {
    /// Before the forces, from the velocity at the start of the step (USF).
    First,
    /// At the end, from the advanced node velocity (USL).
    Last,
    /// At the end, from node velocities rebuilt from the advanced points (MUSL).
    ModifiedLast,
}

/// How much of the FLIP update a step keeps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Blend {
    /// The same share α in every step: 1 is FLIP, 0 is PIC.
    PerStep(f64),
    /// α = max(0, 1 − Δt/τ) with a relaxation time τ in s, so that the damping per second does not depend on
    /// the step.
    RelaxationTime(f64),
}

/// Volume given to a point of a boundary cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointVolume {
    /// Circle or sphere of half the distance to the nearest point, Eqs. (26)-(27) of \[Song2020\].
    Sphere,
    /// Carried volume m/ρ, at most the cell's volume over its number of points.
    CarriedCapped,
    /// Cell volume times its fill fraction min(1, Σ m/ρ / V), shared in proportion to the carried volumes.
    VolumeFraction,
}

/// A named method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variant {
    /// Transport point method as printed.
    Tpm,
    /// TPM with the velocity-pressure formulation, divergence interpolated from cell centres.
    TpmVp,
    /// Classic MPM: linear hat, FLIP.
    Mpm,
    /// uGIMP, FLIP.
    Gimp,
    /// Quadratic B-spline MPM, FLIP.
    Bspline2,
    /// Cubic B-spline MPM, FLIP.
    Bspline3,
    /// Quadratic B-spline MPM with affine transfer.
    Apic,
    /// Linear MPM with the velocity-pressure formulation.
    MpmVp,
}

impl Variant {
    /// Every variant, in the order of tables and legends.
    pub const ALL: [Self; 8] = [
        Self::Tpm,
        Self::TpmVp,
        Self::Mpm,
        Self::Gimp,
        Self::Bspline2,
        Self::Bspline3,
        Self::Apic,
        Self::MpmVp,
    ];

    /// Identifier in command lines, tables and file names.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tpm => "tpm",
            Self::TpmVp => "tpm-vp",
            Self::Mpm => "mpm",
            Self::Gimp => "gimp",
            Self::Bspline2 => "bspline2",
            Self::Bspline3 => "bspline3",
            Self::Apic => "apic",
            Self::MpmVp => "mpm-vp",
        }
    }

    /// One-line description with its source key.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Tpm => "transport point method as printed [Song2020]",
            Self::TpmVp => "TPM, velocity-pressure, divergence interpolated from cell centres",
            Self::Mpm => "material point method, linear hat, FLIP [Sulsky1994]",
            Self::Gimp => "uniform generalized interpolation MPM, FLIP [Bardenhagen2004]",
            Self::Bspline2 => "quadratic B-spline MPM, FLIP [Steffen2008]",
            Self::Bspline3 => "cubic B-spline MPM, FLIP [Steffen2008]",
            Self::Apic => "quadratic B-spline MPM, affine transfer [Jiang2015]",
            Self::MpmVp => "linear MPM, velocity-pressure formulation [Chen2018]",
        }
    }

    /// Finds a variant by its name.
    ///
    /// # Errors
    /// Names the value found and the names allowed.
    pub fn parse(name: &str) -> Result<Self, InvalidInput> {
        Self::ALL.into_iter().find(|variant| variant.name() == name).ok_or_else(|| {
            let allowed: Vec<_> = Self::ALL.iter().map(|variant| variant.name()).collect();
            InvalidInput::new("variant", name, format!("one of {}", allowed.join(", ")))
        })
    }

    /// Builds a 1D simulation in `f64`.
    ///
    /// # Errors
    /// When the scene or a setting is out of range, or the combination is ill-posed.
    pub fn build_1d(
        self,
        _scene: &Scene<1>,
        _settings: &Settings,
    ) -> Result<Box<dyn Simulation<1>>, InvalidInput> {
        Err(InvalidInput::new("variant", self.name(), "under construction"))
    }

    /// Builds a 2D simulation in `f64`.
    ///
    /// # Errors
    /// As [`Variant::build_1d`].
    pub fn build_2d(
        self,
        _scene: &Scene<2>,
        _settings: &Settings,
    ) -> Result<Box<dyn Simulation<2>>, InvalidInput> {
        Err(InvalidInput::new("variant", self.name(), "under construction"))
    }

    /// Builds a 3D simulation in `f64`.
    ///
    /// # Errors
    /// As [`Variant::build_1d`].
    pub fn build_3d(
        self,
        _scene: &Scene<3>,
        _settings: &Settings,
    ) -> Result<Box<dyn Simulation<3>>, InvalidInput> {
        Err(InvalidInput::new("variant", self.name(), "under construction"))
    }
}
