//! What is simulated: plain data in SI units, independent of the method that solves it.

mod body;
mod central_force;
mod force_field;
mod inlet;

pub use body::{BodyShape, BodySpec, BodySurface};
pub use central_force::CentralForce;
pub use force_field::{Acceleration, ForceField};
pub use inlet::{InletProfile, InletSpec, Side, Supply};

use serde::{Deserialize, Serialize};

/// A box of equal cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridSpec<const D: usize> {
    /// Lower corner, m.
    #[serde(with = "axes")]
    pub origin: [f64; D],
    /// Cell size per axis, m.
    #[serde(with = "axes")]
    pub spacing: [f64; D],
    /// Cells per axis, at least one each.
    #[serde(with = "axes")]
    pub cells: [usize; D],
}

/// What holds on one face of the box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// Normal velocity zero.
    Slip,
    /// Velocity zero.
    NoSlip,
    /// Velocity prescribed, m/s; entries beyond the dimension are ignored.
    Velocity([f64; 3]),
    /// Joined with the opposite face, which must be periodic too.
    Periodic,
    /// Traction-free and open: points that cross it are removed and counted.
    Free,
    /// Open, with the velocity of the nodes next to it (zero gradient); points that cross it are removed
    /// and counted.
    Outflow {
        /// Taking sound out at the face; absent: off.
        #[serde(default)]
        relaxation: Option<Relaxation>,
    },
}

impl Boundary {
    /// Whether points may leave through the face.
    pub const fn is_open(self) -> bool {
        matches!(self, Self::Free | Self::Outflow { .. })
    }

    /// An outflow without relaxation.
    pub const OUTFLOW: Self = Self::Outflow { relaxation: None };
}

/// Relaxation of the points next to an outflow towards a state beyond it, which lets sound out
/// \[Poinsot1992\].
///
/// The invariant that sound carries in, u − p/(ρc) with the outward velocity u, decays to that of the
/// state beyond with a time constant; the one that leaves is kept.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Relaxation {
    /// Pressure beyond, Pa.
    pub pressure: f64,
    /// Outward velocity beyond, m/s; absent: that of the point itself.
    #[serde(default)]
    pub velocity: Option<f64>,
    /// Time constant, s.
    pub time: f64,
    /// Layers of cells in which it acts.
    pub layers: usize,
}

/// Pressure as a function of density.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum EquationOfStateSpec {
    /// p = c₀² (ρ − ρ₀), Eq. (35) of \[Song2020\].
    WeaklyCompressible {
        /// ρ₀, kg/m³.
        reference_density: f64,
        /// c₀, m/s.
        sound_speed: f64,
    },
    /// p = (ρ₀ c₀² / γ) ((ρ/ρ₀)^γ − 1), \[Cole1948\]; γ = 7 for water.
    Tait {
        /// ρ₀, kg/m³.
        reference_density: f64,
        /// c₀, m/s.
        sound_speed: f64,
        /// γ.
        exponent: f64,
    },
    /// p = (γ − 1) ρ e − γ p∞, \[Harlow1971\]; needs the energy equation.
    StiffenedGas {
        /// γ.
        ratio: f64,
        /// p∞, Pa.
        stiffness: f64,
    },
    /// p = (γ − 1) ρ e; needs the energy equation.
    IdealGas {
        /// γ.
        ratio: f64,
    },
}

/// One point: position m, velocity m/s, density kg/m³, (nominal) mass kg.
///
/// In 2D masses are per metre of depth, in 1D per square metre of cross-section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointSpec<const D: usize> {
    /// Position, m.
    #[serde(with = "axes")]
    pub position: [f64; D],
    /// Velocity, m/s.
    #[serde(with = "axes")]
    pub velocity: [f64; D],
    /// Density, kg/m³.
    pub density: f64,
    /// Mass, kg (nominal for methods whose points carry none).
    pub mass: f64,
    /// Velocity gradient `[i][j] = ∂v_i/∂x_j`, 1/s: the start of affine fields; others ignore it.
    #[serde(default = "zero_gradient", with = "axes2", skip_serializing_if = "is_zero")]
    pub velocity_gradient: [[f64; D]; D],
    /// Slope of the density, kg/m⁴: the start of affine densities, which take it from the points around where it is
    /// absent; others ignore it.
    #[serde(default, with = "optional_axes", skip_serializing_if = "Option::is_none")]
    pub density_slope: Option<[f64; D]>,
    /// Specific internal energy e, J/kg, for scenes with the energy equation.
    #[serde(default, skip_serializing_if = "is_zero_energy")]
    pub energy: f64,
}

impl<const D: usize> PointSpec<D> {
    /// A point without a velocity gradient and without internal energy.
    pub fn new(position: [f64; D], velocity: [f64; D], density: f64, mass: f64) -> Self {
        let velocity_gradient = zero_gradient();
        let density_slope = None;
        Self { position, velocity, density, mass, velocity_gradient, density_slope, energy: 0.0 }
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero_energy(energy: &f64) -> bool {
    *energy == 0.0
}

fn zero_gradient<const D: usize>() -> [[f64; D]; D] {
    [[0.0; D]; D]
}

fn is_zero<const D: usize>(gradient: &[[f64; D]; D]) -> bool {
    gradient.iter().flatten().all(|&g| g == 0.0)
}

/// Everything a simulation starts from. What it does not list is not stored and not computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene<const D: usize> {
    /// The background grid.
    pub grid: GridSpec<D>,
    /// Lower and upper face of each axis.
    #[serde(with = "axes")]
    pub boundaries: [[Boundary; 2]; D],
    /// Pressure law.
    pub equation_of_state: EquationOfStateSpec,
    /// Acceleration, m/s².
    #[serde(with = "axes")]
    pub body_force: [f64; D],
    /// Acceleration towards a point, in proportion to the distance, besides `body_force`; absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub central_force: Option<CentralForce<D>>,
    /// Acceleration as a function of place and time, besides both; absent: none. Scene files have none.
    #[serde(skip_deserializing, skip_serializing_if = "Option::is_none")]
    pub force_field: Option<ForceField<D>>,
    /// Kinematic viscosity ν, m²/s; absent: inviscid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscosity: Option<f64>,
    /// Shear modulus G of a linear elastic solid, Pa, in place of a viscosity; absent: a fluid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<f64>,
    /// Whether the energy equation is solved, Eq. (34) of \[Song2020\].
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub energy: bool,
    /// Pressure below which a point's density is raised to that of this pressure, Pa; absent: no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minimum_pressure: Option<f64>,
    /// The points.
    pub points: Vec<PointSpec<D>>,
    /// Openings through which fluid enters.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub inlets: Vec<InletSpec<D>>,
    /// Rigid bodies.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodySpec<D>>,
}

impl<const D: usize> Scene<D> {
    /// A scene of a barotropic inviscid fluid without body force, inlets or bodies.
    pub fn new(
        grid: GridSpec<D>,
        boundaries: [[Boundary; 2]; D],
        equation_of_state: EquationOfStateSpec,
        points: Vec<PointSpec<D>>,
    ) -> Self {
        Self {
            grid,
            boundaries,
            equation_of_state,
            body_force: [0.0; D],
            central_force: None,
            force_field: None,
            viscosity: None,
            shear_modulus: None,
            energy: false,
            minimum_pressure: None,
            points,
            inlets: Vec::new(),
            bodies: Vec::new(),
        }
    }
}

/// Fixed-length arrays in scene files, checked for their length.
mod axes {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer, V: Serialize, const D: usize>(
        values: &[V; D],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        values.as_slice().serialize(serializer)
    }

    pub fn deserialize<'de, S: Deserializer<'de>, V: Deserialize<'de>, const D: usize>(
        deserializer: S,
    ) -> Result<[V; D], S::Error> {
        let values = Vec::<V>::deserialize(deserializer)?;
        let found = values.len();
        values
            .try_into()
            .map_err(|_| S::Error::custom(format!("expected {D} entries, found {found}")))
    }
}

/// Vectors in scene files that may be left out.
mod optional_axes {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[expect(clippy::ref_option, reason = "serde's signature")]
    pub fn serialize<S: Serializer, const D: usize>(
        values: &Option<[f64; D]>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        values.as_ref().map(<[f64; D]>::as_slice).serialize(serializer)
    }

    pub fn deserialize<'de, S: Deserializer<'de>, const D: usize>(
        deserializer: S,
    ) -> Result<Option<[f64; D]>, S::Error> {
        let Some(values) = Option::<Vec<f64>>::deserialize(deserializer)? else { return Ok(None) };
        let found = values.len();
        let fixed = values.try_into();
        fixed
            .map(Some)
            .map_err(|_| S::Error::custom(format!("expected {D} entries, found {found}")))
    }
}

/// Square matrices in scene files, as rows.
mod axes2 {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer, const D: usize>(
        rows: &[[f64; D]; D],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(rows.iter().map(<[f64; D]>::as_slice))
    }

    pub fn deserialize<'de, S: Deserializer<'de>, const D: usize>(
        deserializer: S,
    ) -> Result<[[f64; D]; D], S::Error> {
        let rows = Vec::<Vec<f64>>::deserialize(deserializer)?;
        let fixed: Vec<[f64; D]> = rows
            .into_iter()
            .map(|row| {
                let found = row.len();
                row.try_into()
                    .map_err(|_| S::Error::custom(format!("expected rows of {D}, found {found}")))
            })
            .collect::<Result<_, _>>()?;
        let found = fixed.len();
        fixed.try_into().map_err(|_| S::Error::custom(format!("expected {D} rows, found {found}")))
    }
}
