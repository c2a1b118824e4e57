//! Flow past a cylinder in a channel: the bounds that \[SchaeferTurek1996\] give for the benchmarks 2D-1
//! (Re = 20, steady) and 2D-2 (Re = 100, periodic).

use transpoint::InvalidInput;

use super::{Ascent, DataSet};

macro_rules! data_set {
    ($name:literal, $columns:expr) => {
        DataSet {
            path: concat!("cylinder/", $name, ".csv"),
            text: include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"),
                "/../reference-data/cylinder/",
                $name,
                ".csv"
            )),
            columns: $columns,
            ascent: Ascent::Strict,
        }
    };
}

const STEADY: DataSet = data_set!(
    "schaefer_turek1996_2d1",
    &["Re [-]", "C_D lower [-]", "C_D upper [-]", "C_L lower [-]", "C_L upper [-]"]
);
const PERIODIC: DataSet = data_set!(
    "schaefer_turek1996_2d2",
    &[
        "Re [-]",
        "C_D max lower [-]",
        "C_D max upper [-]",
        "C_L max lower [-]",
        "C_L max upper [-]",
        "St lower [-]",
        "St upper [-]",
    ]
);

/// Every data set of the cylinder.
pub const ALL: [DataSet; 2] = [STEADY, PERIODIC];

/// What bounds are given for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// C_D = F/(½ ρ U² D) of the steady flow.
    SteadyDrag,
    /// C_L of the steady flow.
    SteadyLift,
    /// Largest C_D of the periodic flow.
    LargestDrag,
    /// Largest C_L of the periodic flow.
    LargestLift,
    /// St = f D/U.
    Strouhal,
}

/// Lower and upper bound of a quantity, U being the mean velocity of the inflow.
///
/// # Errors
/// When the data set is damaged.
pub fn band(quantity: Quantity) -> Result<[f64; 2], InvalidInput> {
    let (set, first) = match quantity {
        Quantity::SteadyDrag => (STEADY, 1),
        Quantity::SteadyLift => (STEADY, 3),
        Quantity::LargestDrag => (PERIODIC, 1),
        Quantity::LargestLift => (PERIODIC, 3),
        Quantity::Strouhal => (PERIODIC, 5),
    };
    let table = set.read()?;
    let mut bounds = [0.0; 2];
    for (bound, column) in bounds.iter_mut().zip([first, first + 1]) {
        let series = table.series(set.columns[0], set.columns[column])?;
        let missing = || InvalidInput::new(set.path, "no values", "a line of bounds");
        *bound = series.points.first().ok_or_else(missing)?.1;
    }
    Ok(bounds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_whole_and_hold_the_values_computed_since() {
        // Values of later computations, see the file beside the data.
        for (quantity, value) in
            [(Quantity::SteadyDrag, 5.579_535), (Quantity::SteadyLift, 0.010_619)]
        {
            let [lower, upper] = band(quantity).expect("a band");
            assert!(lower < value && value < upper, "{quantity:?}");
        }
        for quantity in [Quantity::LargestDrag, Quantity::LargestLift, Quantity::Strouhal] {
            let [lower, upper] = band(quantity).expect("a band");
            assert!(0.0 < lower && lower < upper && upper < 1.1 * lower, "{quantity:?}");
        }
    }
}
