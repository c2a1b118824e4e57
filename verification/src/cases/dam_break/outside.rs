//! Outside truth under the names of this case: the experiment and the volume-of-fluid runs.

use super::measure::{of_heights, of_pressure};
use super::probe::PLACES;
use super::state::COLUMNS;
use crate::cases::series;
use crate::reference::dam_break::{VofQuantity, VofSpacing, pressure_160, vof};

/// Sizes of the cells of the volume-of-fluid runs with their names.
pub(super) const RUNS: [(VofSpacing, &str); 2] =
    [(VofSpacing::Millimeters20, "VOF 20 mm"), (VofSpacing::Millimeters10, "VOF 10 mm")];

/// The experiment at 160 mm, P over T; empty if the data set is damaged, which its own test tells.
pub(super) fn experiment() -> Vec<(f64, f64)> {
    pressure_160().map_or_else(|_| Vec::new(), |series| series.points)
}

/// A curve of a volume-of-fluid run by its name here; empty if it has none.
pub(super) fn curve(spacing: VofSpacing, name: &str) -> Vec<(f64, f64)> {
    let quantity = quantity(name);
    let series = quantity.and_then(|quantity| vof(spacing, quantity).ok());
    series.map_or_else(Vec::new, |series| series.points)
}

fn quantity(name: &str) -> Option<VofQuantity> {
    let pressures = [
        VofQuantity::Pressure160,
        VofQuantity::Pressure120,
        VofQuantity::Pressure60,
        VofQuantity::Pressure20,
        VofQuantity::PressureDisc,
    ];
    if let Some(place) = PLACES.iter().position(|place| *place == name) {
        return Some(pressures[place]);
    }
    let columns = [
        Some(VofQuantity::KineticEnergy),
        Some(VofQuantity::PotentialEnergy),
        None,
        None,
        None,
        None,
        Some(VofQuantity::FrontAny),
        Some(VofQuantity::Depth2228),
        Some(VofQuantity::Top2228),
        Some(VofQuantity::Depth2725),
        Some(VofQuantity::Top2725),
        Some(VofQuantity::RunUp),
        Some(VofQuantity::HeightLeft),
    ];
    COLUMNS.iter().position(|column| *column == name).and_then(|column| columns[column])
}

/// A measure of a volume-of-fluid run; not a number if it has none.
pub(super) fn measure(spacing: VofSpacing, quantity: &str, norm: &str) -> f64 {
    let found = |measures: Vec<(&str, f64)>| {
        measures.into_iter().find(|(name, _)| *name == norm).map_or(f64::NAN, |found| found.1)
    };
    match quantity.strip_prefix("p-") {
        // The record is coarser than the samples here: its noise is none.
        Some(_) if norm.starts_with("noise") => f64::NAN,
        Some(place) => found(of_pressure(&curve(spacing, place))),
        None if quantity == "energy" => dissipated(spacing, norm),
        None if quantity == "water" && norm == "wetting" => wetting(spacing),
        None if quantity == "water" => found(of_heights(|quantity| {
            vof(spacing, quantity).map_or_else(|_| Vec::new(), |series| series.points)
        })),
        None => f64::NAN,
    }
}

/// T at which the volume fraction at 160 mm exceeds 0.1.
fn wetting(spacing: VofSpacing) -> f64 {
    let fraction = vof(spacing, VofQuantity::Fraction160);
    fraction.map_or(f64::NAN, |series| series::first_above(&series.points, 0.0, 0.1))
}

fn dissipated(spacing: VofSpacing, norm: &str) -> f64 {
    let time = norm.strip_prefix("dissipated@").and_then(|time| time.parse().ok());
    let energy = vof(spacing, VofQuantity::EnergyRatio);
    match (time, energy) {
        (Some(time), Ok(energy)) => 1.0 - series::at(&energy.points, time),
        _ => f64::NAN,
    }
}

/// The same measures of the experiment, which has a pressure at 160 mm alone.
pub(super) fn measure_of_experiment(quantity: &str, norm: &str) -> f64 {
    if quantity != "p-disc" || norm.starts_with("noise") {
        return f64::NAN;
    }
    let measures = of_pressure(&experiment());
    measures.into_iter().find(|(name, _)| *name == norm).map_or(f64::NAN, |found| found.1)
}
