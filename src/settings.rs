//! The parameters of methods: one policy for all variants.

use serde::{Deserialize, Serialize};

use crate::error::InvalidInput;
use crate::formulation::PointDivergence;

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
    /// Most leverage Λ of a moving-least-squares fit; absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leverage: Option<f64>,
    /// Length of a uGIMP particle, cells, `0 < l ≤ 1`.
    pub gimp_length: f64,
    /// Volume of points in boundary cells (mixed quadrature).
    pub point_volume: PointVolume,
    /// What a boundary cell is (mixed quadrature).
    pub boundary_criterion: BoundaryCriterion,
    /// Divergence at the points of `tpm-vp`.
    pub point_divergence: PointDivergence,
    /// Limiter of the pressure's slope within cells (velocity-pressure formulation); absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pressure_limiter: Option<PressureLimiter>,
    /// Bulk viscosity; absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bulk_viscosity: Option<BulkViscosity>,
    /// How the internal energy is updated, where the scene has one.
    pub energy_update: EnergyUpdate,
    /// Node velocities by a series for the inverse of the full mass matrix, as in XPIC and FMPM; absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub projection: Option<Projection>,
    /// Share f of the nodes' mean in the divergence of a point (volume-averaged F-bar), 0 to 1; absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dilation: Option<f64>,
    /// δ of the diffusion of density between cells (velocity-pressure formulation), above 0, at most 0.25;
    /// absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub density_diffusion: Option<f64>,
    /// Whether points carry the slope of their density too, and cells the mean of the points' linear fields.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub affine_density: bool,
    /// Points added, taken away, moved or split between steps; absent: off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rearrangement: Option<Rearrangement>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            stress_update: StressUpdate::Last,
            blend: Blend::PerStep(1.0),
            support: 1.0,
            positivity: None,
            leverage: None,
            gimp_length: 0.5,
            point_volume: PointVolume::Sphere,
            boundary_criterion: BoundaryCriterion::EmptyNeighbor,
            point_divergence: PointDivergence::VertexMean,
            pressure_limiter: None,
            bulk_viscosity: None,
            energy_update: EnergyUpdate::Strain,
            projection: None,
            dilation: None,
            density_diffusion: None,
            affine_density: false,
            rearrangement: None,
        }
    }
}

impl Settings {
    /// Checks every setting against its range.
    ///
    /// # Errors
    /// Names the first setting out of range, its value and what is allowed.
    pub fn check(&self) -> Result<(), InvalidInput> {
        let (blend, blend_allowed, blend_holds) = match self.blend {
            Blend::PerStep(share) => {
                (share, "a FLIP share from 0 to 1", (0.0..=1.0).contains(&share))
            }
            Blend::RelaxationTime(tau) => {
                (tau, "a positive relaxation time in s", tau.is_finite() && tau > 0.0)
            }
        };
        let theta = self.positivity.unwrap_or(0.0);
        let share = match self.boundary_criterion {
            BoundaryCriterion::EmptyNeighbor => 1.0,
            BoundaryCriterion::VolumeShare(share) => share,
        };
        let leverage = self.leverage.unwrap_or(1.0);
        let length = self.gimp_length;
        let (dilation, delta) =
            (self.dilation.unwrap_or(0.0), self.density_diffusion.unwrap_or(0.1));
        let BulkViscosity { linear, quadratic, .. } = self.bulk_viscosity.unwrap_or_default();
        let checks = [
            ("blend", blend, blend_allowed, blend_holds),
            (
                "support",
                self.support,
                "a half width of 0.75 to 4 cells",
                (0.75..=4.0).contains(&self.support),
            ),
            ("positivity", theta, "0 ≤ θ < 1", (0.0..1.0).contains(&theta)),
            (
                "boundary_criterion",
                share,
                "a share above 0, at most 1",
                share > 0.0 && share <= 1.0,
            ),
            ("leverage", leverage, "a positive number", leverage > 0.0),
            ("gimp_length", length, "0 < length ≤ 1 cell", length > 0.0 && length <= 1.0),
            ("dilation", dilation, "a share from 0 to 1", (0.0..=1.0).contains(&dilation)),
            ("density_diffusion", delta, "0 < δ ≤ 0.25", delta > 0.0 && delta <= 0.25),
            ("bulk_viscosity.linear", linear, "a number from 0 on", linear >= 0.0),
            ("bulk_viscosity.quadratic", quadratic, "a number from 0 on", quadratic >= 0.0),
        ];
        for (field, value, allowed, holds) in checks {
            if !(holds && value.is_finite()) {
                return Err(InvalidInput::new(format!("settings.{field}"), value, allowed));
            }
        }
        self.projection.map_or(Ok(()), |projection| projection.check())?;
        self.rearrangement.map_or(Ok(()), |rearrangement| rearrangement.check())
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

/// Bulk viscosity q = −ρ h D (C₁ c + C₂ h |D|) of compression, \[VonNeumann1950\], \[Landshoff1955\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BulkViscosity {
    /// C₁.
    pub linear: f64,
    /// C₂.
    pub quadratic: f64,
    /// Whether the linear term acts in expansion too: a rarefaction of a stiff fluid is as steep as a
    /// shock and rings as much.
    #[serde(default)]
    pub expansion: bool,
}

/// Node velocities by the first terms of a series for the inverse of the full mass matrix, which the points take
/// up whole; see [`ProjectionKind`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Projection {
    /// What the series is applied to.
    pub kind: ProjectionKind,
    /// Number of terms k; 1 is PIC.
    pub order: u32,
    /// Steps from one application to the next; in those between the blend of the settings holds.
    pub interval: u32,
}

impl Projection {
    /// Most terms: the series is an alternating one, and loses its digits with many.
    pub const MAX_ORDER: u32 = 20;

    /// Checks both numbers against their ranges.
    ///
    /// # Errors
    /// Names the first one out of range, its value and what is allowed.
    pub fn check(&self) -> Result<(), InvalidInput> {
        let most = Self::MAX_ORDER;
        if !(1..=most).contains(&self.order) {
            let allowed = format!("1 to {most} terms");
            return Err(InvalidInput::new("settings.projection.order", self.order, allowed));
        }
        if self.interval == 0 {
            let allowed = "at least 1 step";
            return Err(InvalidInput::new("settings.projection.interval", self.interval, allowed));
        }
        Ok(())
    }
}

/// What a projection is applied to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ProjectionKind {
    /// The velocity before the forces; their change is added as it is: XPIC, \[Hammerquist2017\].
    Velocity,
    /// The velocity after the forces: FMPM, \[Nairn2021\].
    All,
    /// The same, and the density of the points away from the surface; methods that reconstruct fields.
    AllAndDensity,
}

/// How a point's internal energy changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EnergyUpdate {
    /// By the strain of the step, Eq. (34) of \[Song2020\].
    Strain,
    /// By the work that the nodes do on the point and the kinetic energy lost in the transfer, which
    /// keeps the total energy to round-off; FLIP and its blends, carried values, updated last.
    Work,
}

/// What is done to the points between steps, after \[Song2020\]; each part is off where absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Rearrangement {
    /// Points put into numerical fractures; methods that reconstruct fields.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<Fill>,
    /// N_m: an internal cell with more points gets new ones, 2 per axis; methods that reconstruct fields.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most_points: Option<u32>,
    /// Points pushed apart; methods that reconstruct fields.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift: Option<Shift>,
    /// Points split where they stand for too much fluid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub split: Option<Split>,
    /// Points pushed out of overfull nodes; methods with carried values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overfill: Option<Overfill>,
}

impl Rearrangement {
    /// Checks every part against its range.
    ///
    /// # Errors
    /// Names the first one out of range, its value and what is allowed.
    pub fn check(&self) -> Result<(), InvalidInput> {
        let budget = match self.fill {
            Some(Fill { mass: FillMass::Budget(share), .. }) => share,
            _ => 0.0,
        };
        let Shift { strength, interval } =
            self.shift.unwrap_or(Shift { strength: 1.0, interval: 1 });
        let ratio = match self.split {
            Some(split) => split.ratio(),
            None => 1.0,
        };
        let most_points = self.most_points.unwrap_or(1);
        let overfill = self.overfill.map_or(1, |overfill| overfill.interval);
        let checks = [
            ("fill.mass", budget, "a share of the initial mass from 0 on", budget >= 0.0),
            ("most_points", f64::from(most_points), "at least 1 point", most_points > 0),
            ("shift.strength", strength, "0 < strength ≤ 1", strength > 0.0 && strength <= 1.0),
            ("shift.interval", f64::from(interval), "at least 1 step", interval > 0),
            ("overfill.interval", f64::from(overfill), "at least 1 step", overfill > 0),
            ("split", ratio, "a ratio to the cell size of at least 0.25", ratio >= 0.25),
        ];
        for (field, value, allowed, holds) in checks {
            if !(holds && value.is_finite()) {
                let field = format!("settings.rearrangement.{field}");
                return Err(InvalidInput::new(field, value, allowed));
            }
        }
        Ok(())
    }
}

/// New points for a cell that is empty although the fluid fills it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// How many, and where.
    pub points: FillPoints,
    /// Where their nominal mass comes from.
    pub mass: FillMass,
}

/// Pattern of new points in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FillPoints {
    /// One at the centre.
    Center,
    /// Two per axis, at the quarter points.
    Quarters,
}

/// Where the nominal mass ρ V of new points comes from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FillMass {
    /// It is created without limit, as printed in \[Song2020\].
    Created,
    /// It is created as long as all that was created is at most this share of the initial mass; fills
    /// beyond that are refused and counted. Mass that leaves through free faces gives no credit.
    Budget(f64),
    /// The points of the cells around give it in proportion to their masses, each at most half of its
    /// own per fill, and change their velocities such that mass and momentum stay to round-off.
    Donated,
}

/// Pairs of points that are too close repel each other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shift {
    /// Largest displacement in halves of the smallest cell size.
    pub strength: f64,
    /// Steps from one application to the next.
    pub interval: u32,
}

/// Points are pushed out of nodes with more volume than room, after \[Baumgarten2023\].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Overfill {
    /// Steps from one application to the next.
    pub interval: u32,
}

/// When a point is split, by a ratio α to the cell size, after \[Ma2009\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Split {
    /// In two along every axis when its volume m/ρ exceeds α^D cells.
    Volume(f64),
    /// In two along the axis of greatest length when the length that it carries exceeds α cells. Lengths
    /// start as those of a piece of a cell with the point's volume, and the flow stretches them.
    Stretch(f64),
    /// The same, but only where the point is alone in a cell that is cut by the surface: a film or a jet stays
    /// connected, and the number of points within bounds. Lengths of such points are kept below 1.25 α cells, which
    /// `n_lengths_limited` counts: among others they may have been stretched without end.
    Lone(f64),
}

impl Split {
    /// α.
    pub const fn ratio(self) -> f64 {
        match self {
            Self::Volume(ratio) | Self::Stretch(ratio) | Self::Lone(ratio) => ratio,
        }
    }
}

/// Limiter of the pressure's slope in a cell, which replaces the pressures of the cell's points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PressureLimiter {
    /// Least-squares slope over the face neighbours, scaled so that no point leaves the range of the
    /// cell means of the cell and its face neighbours, \[BarthJespersen1989\].
    BarthJespersen,
    /// Monotonized central slope along each axis, \[VanLeer1977\].
    PerAxis,
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
    /// One sample at the cell's centre with the means of the cell's points and the volume of their boxes in the
    /// cell, see [`boxed_volume`](crate::quadrature::boxed_volume): mass and force enter the nodes in the same ratio however small the volume, so that the
    /// stable time step is that of full cells.
    CellCenter,
    /// The same in one sample at the centroid of the part of the cell that a plane cuts off.
    Plane,
    /// The same, but no sample nearer to a face than a quarter of a cell, and with the pressure of a fit that holds up a
    /// column at rest: ADR 0016.
    Balanced,
}

/// What tells a cell cut by the surface from one that is full.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryCriterion {
    /// A boundary cell has an empty cell among its neighbours.
    EmptyNeighbor,
    /// The carried volumes in a boundary cell fill less than this share β of it.
    VolumeShare(f64),
}
