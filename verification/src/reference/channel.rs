//! Inflow into an empty channel: volume-of-fluid runs \[Roenby2016\] of the two channels of §4.4 of
//! \[Song2020\], 2 m and 60 mm long.

use transpoint::InvalidInput;

use super::{Ascent, DataSet, Series, Table};

macro_rules! data_set {
    ($name:literal, $columns:expr, $ascent:expr) => {
        DataSet {
            path: concat!("channel/", $name, ".csv"),
            text: include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"),
                "/../reference-data/channel/",
                $name,
                ".csv"
            )),
            columns: $columns,
            ascent: $ascent,
        }
    };
}

const MASS: &[&str] =
    &["t [s]", "mass [kg/m]", "mass_in [kg/m]", "kinetic_energy [J/m]", "potential_energy [J/m]"];
const TOP: &[&str] = &["t [s]", "x [m]", "y_top [m]", "depth_integral [m]"];
const OUTLINE: &[&str] = &["t [s]", "line [-]", "x [m]", "y [m]"];

/// Every data set of the channels.
pub const ALL: [DataSet; 9] = [
    VofSpacing::Millimeters10.mass(),
    VofSpacing::Millimeters5.mass(),
    VofSpacing::Millimeters10.top(),
    VofSpacing::Millimeters5.top(),
    VofFilm::FullNoSlip.data_set(),
    VofFilm::FullNoSlipFine.data_set(),
    VofFilm::FullSlip.data_set(),
    VofFilm::HalfNoSlip.data_set(),
    VofFilm::FullSlipWeightless.data_set(),
];

/// Size of the cells of a volume-of-fluid run of the long channel: 0.4 m/s through 0.1 m, slip bed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VofSpacing {
    /// 10 mm.
    Millimeters10,
    /// 5 mm.
    Millimeters5,
}

impl VofSpacing {
    const fn mass(self) -> DataSet {
        match self {
            Self::Millimeters10 => data_set!("vof_steady_h100_sl_10mm_mass", MASS, Ascent::Strict),
            Self::Millimeters5 => data_set!("vof_steady_h100_sl_5mm_mass", MASS, Ascent::Strict),
        }
    }

    const fn top(self) -> DataSet {
        match self {
            Self::Millimeters10 => data_set!("vof_steady_h100_sl_10mm_top", TOP, Ascent::Weak),
            Self::Millimeters5 => data_set!("vof_steady_h100_sl_5mm_top", TOP, Ascent::Weak),
        }
    }
}

/// What a volume-of-fluid run of the long channel recorded over time, in the order of its columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VofTotal {
    /// Mass of water in the channel, kg per metre of depth.
    Mass,
    /// Mass of water let in, kg per metre of depth.
    MassIn,
    /// Kinetic energy of the water, J per metre of depth.
    KineticEnergy,
    /// Potential energy of the water, J per metre of depth.
    PotentialEnergy,
}

/// A total over time, s.
///
/// # Errors
/// When the data set is damaged.
pub fn total(spacing: VofSpacing, quantity: VofTotal) -> Result<Series, InvalidInput> {
    spacing.mass().read()?.series(MASS[0], MASS[1 + quantity as usize])
}

/// A column of water of a volume-of-fluid run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterColumn {
    /// Where it stands, m.
    pub x: f64,
    /// Highest water, m.
    pub top: f64,
    /// Integral of the volume fraction over the height, m.
    pub depth: f64,
}

/// The columns of water at an instant, one of 0.5, 1, 1.5, 2, 3 and 4 s, x ascending.
///
/// # Errors
/// When the run has none at that instant, or the data set is damaged.
pub fn surface(spacing: VofSpacing, instant: f64) -> Result<Vec<WaterColumn>, InvalidInput> {
    let rows = rows_at(&spacing.top().read()?, instant)?;
    Ok(rows.iter().map(|row| WaterColumn { x: row[1], top: row[2], depth: row[3] }).collect())
}

/// A volume-of-fluid run of the short channel, 0.05 m/s at a Reynolds number of 500 on its height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VofFilm {
    /// Inlet over the full height, no-slip bed; cells of 0.25 mm.
    FullNoSlip,
    /// The same; cells of 0.125 mm.
    FullNoSlipFine,
    /// Inlet over the full height, slip bed; cells of 0.25 mm.
    FullSlip,
    /// Inlet over the lower half, no-slip bed; cells of 0.25 mm.
    HalfNoSlip,
    /// Inlet over the full height, slip bed, no gravity; cells of 0.25 mm.
    FullSlipWeightless,
}

impl VofFilm {
    const fn data_set(self) -> DataSet {
        match self {
            Self::FullNoSlip => {
                data_set!("vof_re500_full_g98_ns_0p25mm_outline", OUTLINE, Ascent::Weak)
            }
            Self::FullNoSlipFine => {
                data_set!("vof_re500_full_g98_ns_0p125mm_outline", OUTLINE, Ascent::Weak)
            }
            Self::FullSlip => {
                data_set!("vof_re500_full_g98_sl_0p25mm_outline", OUTLINE, Ascent::Weak)
            }
            Self::HalfNoSlip => {
                data_set!("vof_re500_half_g98_ns_0p25mm_outline", OUTLINE, Ascent::Weak)
            }
            Self::FullSlipWeightless => {
                data_set!("vof_re500_full_g0_sl_0p25mm_outline", OUTLINE, Ascent::Weak)
            }
        }
    }
}

/// The surface at an instant, one of 0.05, 0.1 and 0.17 s: places x, y, m, from the bed or the end of the
/// channel back to the inlet, where the volume fraction is ½. Each run has a single line.
///
/// # Errors
/// When the run has none at that instant, or the data set is damaged.
pub fn outline(film: VofFilm, instant: f64) -> Result<Vec<[f64; 2]>, InvalidInput> {
    let rows = rows_at(&film.data_set().read()?, instant)?;
    Ok(rows.iter().map(|row| [row[2], row[3]]).collect())
}

/// The rows of an instant.
fn rows_at(table: &Table, instant: f64) -> Result<Vec<Vec<f64>>, InvalidInput> {
    let rows: Vec<_> = table.rows.iter().filter(|row| row[0] == instant).cloned().collect();
    if rows.is_empty() {
        let mut instants: Vec<f64> = table.rows.iter().map(|row| row[0]).collect();
        instants.dedup();
        return Err(InvalidInput::new("instant", instant, format!("one of {instants:?}")));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests;
