//! The volume-of-fluid run in the tank of \[Zhou1999\], without the gate \[Roenby2016\].

use transpoint::InvalidInput;

use super::{Ascent, DataSet, Series, TIME};

const CURVES: &[&str] = &[
    "t [s]",
    TIME,
    "p160/(rho*g*h0) [-]",
    "p90mm/(rho*g*h0) [-]",
    "p120/(rho*g*h0) [-]",
    "p060/(rho*g*h0) [-]",
    "p020/(rho*g*h0) [-]",
    "alpha160 [-]",
    "water_area [m2]",
    "kinetic_energy [J/m]",
    "potential_energy [J/m]",
    "E/E0 [-]",
];
const FRONTS_HEIGHTS: &[&str] = &[
    "t [s]",
    TIME,
    "front_floor [m]",
    "front_any [m]",
    "front_depth10mm [m]",
    "Hint_x2.228 [m]",
    "Htop_x2.228 [m]",
    "Hint_x2.2333 [m]",
    "Htop_x2.2333 [m]",
    "Hint_x2.725 [m]",
    "Htop_x2.725 [m]",
    "runup_right [m]",
    "height_left [m]",
];
const OUTLINE: &[&str] = &[TIME, "line [-]", "x [m]", "y [m]"];

/// Size of the cells of a volume-of-fluid run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VofSpacing {
    /// 20 mm.
    Millimeters20,
    /// 10 mm.
    Millimeters10,
}

impl VofSpacing {
    pub(super) const fn curves(self) -> DataSet {
        match self {
            Self::Millimeters20 => data_set!("vof_curves_20mm", CURVES, Ascent::Strict),
            Self::Millimeters10 => data_set!("vof_curves_10mm", CURVES, Ascent::Strict),
        }
    }

    pub(super) const fn fronts_heights(self) -> DataSet {
        match self {
            Self::Millimeters20 => {
                data_set!("vof_fronts_heights_20mm", FRONTS_HEIGHTS, Ascent::Strict)
            }
            Self::Millimeters10 => {
                data_set!("vof_fronts_heights_10mm", FRONTS_HEIGHTS, Ascent::Strict)
            }
        }
    }

    pub(super) const fn outline(self) -> DataSet {
        match self {
            Self::Millimeters20 => data_set!("vof_outline_20mm", OUTLINE, Ascent::Weak),
            Self::Millimeters10 => data_set!("vof_outline_10mm", OUTLINE, Ascent::Weak),
        }
    }
}

/// What a volume-of-fluid run recorded against T, in the order of the columns of its files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VofQuantity {
    /// p/(ρ g h₀) on the far wall at 160 mm.
    Pressure160,
    /// p/(ρ g h₀) on the far wall, mean over the disc of 90 mm centred at 160 mm.
    PressureDisc,
    /// p/(ρ g h₀) on the far wall at 120 mm.
    Pressure120,
    /// p/(ρ g h₀) on the far wall at 60 mm.
    Pressure60,
    /// p/(ρ g h₀) on the far wall at 20 mm.
    Pressure20,
    /// Volume fraction of water on the far wall at 160 mm.
    Fraction160,
    /// Area of water, m².
    WaterArea,
    /// Kinetic energy of the water, J per metre of depth.
    KineticEnergy,
    /// Potential energy of the water, J per metre of depth.
    PotentialEnergy,
    /// Kinetic and potential energy over that at the start.
    EnergyRatio,
    /// Front on the floor, m.
    FrontFloor,
    /// Front at any height, m.
    FrontAny,
    /// Front where the water is 10 mm deep, to a cell, m.
    FrontDepth10,
    /// Integral of the volume fraction over the height at x = 2.228 m, m.
    Depth2228,
    /// Highest place of the surface at x = 2.228 m, m.
    Top2228,
    /// Integral of the volume fraction over the height at x = 2.2333 m, m.
    Depth2233,
    /// Highest place of the surface at x = 2.2333 m, m.
    Top2233,
    /// Integral of the volume fraction over the height at x = 2.725 m, m.
    Depth2725,
    /// Highest place of the surface at x = 2.725 m, m.
    Top2725,
    /// Highest water on the far wall, m.
    RunUp,
    /// Height of the water on the wall behind the column, m.
    HeightLeft,
}

impl VofQuantity {
    /// Heading of its column.
    fn heading(self) -> &'static str {
        let index = self as usize;
        let fronts = Self::FrontFloor as usize;
        // Two columns of time stand first in both files.
        if index < fronts { CURVES[2 + index] } else { FRONTS_HEIGHTS[2 + index - fronts] }
    }
}

/// A quantity against T, at the steps of the run or every 0.02.
///
/// # Errors
/// When the data set is damaged.
pub fn vof(spacing: VofSpacing, quantity: VofQuantity) -> Result<Series, InvalidInput> {
    let heading = quantity.heading();
    let set = if CURVES.contains(&heading) { spacing.curves() } else { spacing.fronts_heights() };
    set.read()?.series(TIME, heading)
}

/// The lines x, y, m, along which the volume fraction is ½ at an instant T, one of 1.0, 2.0, 2.4,
/// 2.8, 3.0 and 3.4; the longest stands first.
///
/// # Errors
/// When the run has no outline at that instant, or the data set is damaged.
pub fn outline(spacing: VofSpacing, instant: f64) -> Result<Vec<Vec<[f64; 2]>>, InvalidInput> {
    let table = spacing.outline().read()?;
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut number = f64::NAN;
    for row in table.rows.iter().filter(|row| row[0] == instant) {
        if row[1] != number {
            number = row[1];
            lines.push(Vec::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push([row[2], row[3]]);
        }
    }
    if lines.is_empty() {
        let mut instants: Vec<f64> = table.rows.iter().map(|row| row[0]).collect();
        instants.dedup();
        return Err(InvalidInput::new("instant", instant, format!("one of {instants:?}")));
    }
    Ok(lines)
}
