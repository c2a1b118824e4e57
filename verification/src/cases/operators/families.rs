//! Which operators there are and what is measured of each.

use super::cloud::{REGIONS, Region};
use crate::case::Row;

/// Operators that are compared with each other, and the quantities measured.
pub(super) struct Family {
    pub(super) operators: &'static [&'static str],
    pub(super) quantities: &'static [&'static str],
}

/// Every operator.
pub(super) const FAMILIES: [Family; 5] = [
    Family {
        operators: &["linear", "gimp", "bspline2", "bspline3"],
        quantities: &["value", "gradient"],
    },
    Family {
        operators: &[
            "pic-linear",
            "pic-gimp",
            "pic-bspline2",
            "pic-bspline3",
            "apic-linear",
            "apic-bspline2",
            "apic-bspline3",
        ],
        quantities: &["value"],
    },
    Family { operators: &["carried"], quantities: &["center"] },
    Family {
        operators: &["shepard", "mls1-r1", "mls1-r1.5", "mls1-r2", "mls2-r1.5", "mls2-r2"],
        quantities: &["center", "node", "gradient"],
    },
    Family {
        operators: &["div-constant", "div-linear", "div-quadratic", "div-vertex-mean"],
        quantities: &["divergence"],
    },
];

/// Quantities of an operator in each region, with their full names.
pub(super) fn quantities(operator: &str) -> impl Iterator<Item = (&'static str, Region, String)> {
    let family = FAMILIES.iter().find(|family| family.operators.contains(&operator));
    let quantities = family.map_or(&[][..], |family| family.quantities);
    quantities.iter().flat_map(|&quantity| {
        REGIONS.map(|(region, name)| (quantity, region, format!("{quantity}@{name}")))
    })
}

/// The rows of a run that has no values.
pub(super) fn missing_rows(operator: &str) -> Vec<Row> {
    let norms = quantities(operator)
        .flat_map(|(_, _, name)| ["l2", "max"].map(|norm| Row::missing(name.clone(), norm)));
    norms.chain(["exact-constant", "exact-linear"].map(|name| Row::missing(name, "max"))).collect()
}
