//! Dam break: pressure on the far wall \[Zhou1999\], fronts of collapsing columns
//! \[MartinMoyce1952\] \[KoshizukaOka1996\], and a volume-of-fluid run \[Roenby2016\].
//!
//! Times have no dimension, with the height h₀ and the base l₀ of the column:
//!
//! ```text
//! T = t √(h₀ g)/l₀
//! ```
//!
//! Two geometries share this formula and nothing else. The column of \[Zhou1999\] and of the
//! volume-of-fluid run lies, h₀ = 0.6 m and l₀ = 2 h₀, so T = ½ t √(g/h₀). The columns of the front
//! experiments stand, base a and height 2a (n² = 2 in \[MartinMoyce1952\]), so T = t √(2g/a); they
//! are compared with a run of such a column, not with the tank of the paper.

use transpoint::InvalidInput;

use super::{Ascent, DataSet, Series};
pub use vof::{VofQuantity, VofSpacing, outline, vof};

const TIME: &str = "T = t*sqrt(h0*g)/l0 [-]";
const TIME_BY_HEIGHT: &str = "T_paper = t*sqrt(H*g/L0^2) [-]";

macro_rules! data_set {
    ($name:literal, $columns:expr, $ascent:expr) => {
        DataSet {
            path: concat!("dam-break/", $name, ".csv"),
            text: include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"),
                "/../reference-data/dam-break/",
                $name,
                ".csv"
            )),
            columns: $columns,
            ascent: $ascent,
        }
    };
}

mod vof;

const ZHOU: DataSet = data_set!(
    "zhou1999_p160",
    &["T = t*sqrt(g/H) [-]", TIME_BY_HEIGHT, "P = p/(rho*g*H) [-]"],
    Ascent::Strict
);
const FRONT: &[&str] = &["T = t*sqrt(2g/a) [-]", "Z = x/a [-]"];
const MARTIN_MOYCE_1125: DataSet =
    data_set!("martin_moyce1952_front_n2_a1125", FRONT, Ascent::Strict);
const MARTIN_MOYCE_2250: DataSet =
    data_set!("martin_moyce1952_front_n2_a2250", FRONT, Ascent::Strict);
const KOSHIZUKA_OKA: DataSet =
    data_set!("koshizuka_oka1996_front", &["T = t*sqrt(2g/L) [-]", "Z = x/L [-]"], Ascent::Strict);

/// Every data set of the dam break.
pub const ALL: [DataSet; 10] = [
    ZHOU,
    MARTIN_MOYCE_1125,
    MARTIN_MOYCE_2250,
    KOSHIZUKA_OKA,
    VofSpacing::Millimeters20.curves(),
    VofSpacing::Millimeters10.curves(),
    VofSpacing::Millimeters20.fronts_heights(),
    VofSpacing::Millimeters10.fronts_heights(),
    VofSpacing::Millimeters20.outline(),
    VofSpacing::Millimeters10.outline(),
];

/// Pressure P = p/(ρ g h₀) on the far wall, over a disc of 90 mm centred 160 mm above the floor,
/// against T \[Zhou1999\]; before the impact, T < 1.2, the record is noise of ±0.16.
///
/// # Errors
/// When the data set is damaged.
pub fn pressure_160() -> Result<Series, InvalidInput> {
    ZHOU.read()?.series(TIME_BY_HEIGHT, "P = p/(rho*g*H) [-]")
}

/// Front Z of a column of base a = 1.125 in against T, see [`scaled_front`] \[MartinMoyce1952\].
///
/// # Errors
/// When the data set is damaged.
pub fn front_martin_moyce_1125() -> Result<Series, InvalidInput> {
    MARTIN_MOYCE_1125.read()?.series(FRONT[0], FRONT[1])
}

/// Front Z of a column of base a = 2.25 in against T, see [`scaled_front`] \[MartinMoyce1952\].
///
/// # Errors
/// When the data set is damaged.
pub fn front_martin_moyce_2250() -> Result<Series, InvalidInput> {
    MARTIN_MOYCE_2250.read()?.series(FRONT[0], FRONT[1])
}

/// Front Z of a column of base a = 0.146 m against T, see [`scaled_front`] \[KoshizukaOka1996\].
///
/// # Errors
/// When the data set is damaged.
pub fn front_koshizuka_oka() -> Result<Series, InvalidInput> {
    KOSHIZUKA_OKA.read()?.series(KOSHIZUKA_OKA.columns[0], KOSHIZUKA_OKA.columns[1])
}

/// T and Z of a front at `position` x, m from the wall, at `time` t, s, under `gravity` g, m/s²,
/// for a column of base a, m, and height 2a:
///
/// ```text
/// T = t √(2 g/a),   Z = x/a
/// ```
pub fn scaled_front(position: f64, time: f64, gravity: f64, base: f64) -> (f64, f64) {
    (scaled_time(time, gravity, base, 2.0 * base), position / base)
}

/// T = t √(h₀ g)/l₀ at `time` t, s, under `gravity` g, m/s², for a column of `base` l₀ and `height`
/// h₀, m.
pub fn scaled_time(time: f64, gravity: f64, base: f64, height: f64) -> f64 {
    time * (height * gravity).sqrt() / base
}

#[cfg(test)]
mod tests;
