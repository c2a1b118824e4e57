//! Steady flow in a square cavity with a moving lid: the velocities on its center lines of \[Ghia1982\].

use transpoint::InvalidInput;

use super::{Ascent, DataSet};

macro_rules! data_set {
    ($name:literal, $columns:expr) => {
        DataSet {
            path: concat!("lid-cavity/", $name, ".csv"),
            text: include_str!(concat!(
                env!("CARGO_MANIFEST_DIR"),
                "/../reference-data/lid-cavity/",
                $name,
                ".csv"
            )),
            columns: $columns,
            ascent: Ascent::Strict,
        }
    };
}

const VERTICAL: DataSet = data_set!(
    "ghia1982_u_vertical_centreline",
    &[
        "y/L [-]",
        "u/U Re=100 [-]",
        "u/U Re=400 [-]",
        "u/U Re=1000 [-]",
        "u/U Re=3200 [-]",
        "u/U Re=5000 [-]",
        "u/U Re=7500 [-]",
        "u/U Re=10000 [-]",
    ]
);
const HORIZONTAL: DataSet = data_set!(
    "ghia1982_v_horizontal_centreline",
    &[
        "x/L [-]",
        "v/U Re=100 [-]",
        "v/U Re=400 [-]",
        "v/U Re=1000 [-]",
        "v/U Re=3200 [-]",
        "v/U Re=5000 [-]",
        "v/U Re=7500 [-]",
        "v/U Re=10000 [-]",
    ]
);

/// Every data set of the cavity.
pub const ALL: [DataSet; 2] = [VERTICAL, HORIZONTAL];

/// One of the two lines through the center.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// u along x = L/2.
    Vertical,
    /// v along y = L/2.
    Horizontal,
}

/// Places along a line over L, without the walls, and velocities across it over U, at Re = 100.
///
/// # Errors
/// When the data set is damaged.
pub fn profile(line: Line) -> Result<Vec<(f64, f64)>, InvalidInput> {
    let set = match line {
        Line::Vertical => VERTICAL,
        Line::Horizontal => HORIZONTAL,
    };
    let points = set.read()?.series(set.columns[0], set.columns[1])?.points;
    Ok(points.into_iter().filter(|&(place, _)| place > 0.0 && place < 1.0).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The flux through a line is zero, by the trapezoidal rule over the places of the table.
    #[test]
    fn profiles_are_whole_and_carry_no_flux() {
        for (line, lid) in [(Line::Vertical, 1.0), (Line::Horizontal, 0.0)] {
            let mut points = profile(line).expect("a profile");
            assert_eq!(points.len(), 15);
            points.insert(0, (0.0, 0.0));
            points.push((1.0, lid));
            let flux: f64 = points
                .windows(2)
                .map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0))
                .sum();
            assert!(flux.abs() < 0.02, "{line:?}: {flux}");
        }
        for set in ALL {
            assert!(set.read().is_ok(), "{}", set.path);
        }
    }
}
