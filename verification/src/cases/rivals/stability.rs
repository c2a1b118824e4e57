//! Where the variants are stable: measured, and by theory.

use transpoint::formulation::Formulation;
use transpoint::shape::{
    ConvectedGimp, Corrected, CubicBspline, DualDomain, Gimp, LeastSquares, Linear,
    QuadraticBspline, Staggered,
};
use transpoint::time_step::worst_row_stiffness;
use transpoint::variants::{Fields, Kernel, Parts};
use transpoint::{Settings, Variant};

use super::courant;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// The largest stable Courant number over points per cell and disorder; no rows unless it was mapped.
pub(super) fn stability(records: &[RunRecord]) -> Table {
    let (points, jitters) = courant::MAP;
    let layouts: Vec<String> = points
        .into_iter()
        .flat_map(|points| jitters.map(|jitter| courant::layout(points, jitter)))
        .collect();
    let mut columns = vec!["variant".to_owned(), "bound".to_owned()];
    columns.extend(layouts.iter().map(|layout| format!("{layout} points")));
    let found = |variant: Variant, layout: &str| {
        let of = |record: &&RunRecord| {
            record.spec.variant == variant.name() && record.spec.label("points") == layout
        };
        let row = records.iter().find(of)?.row("courant", "largest-stable")?;
        Some(Cell::Decimal(row.value))
    };
    let row = |variant: Variant| {
        let cells: Option<Vec<Cell>> =
            layouts.iter().map(|layout| found(variant, layout)).collect();
        let mut row = vec![Cell::from(variant.name()), Cell::Decimal(bound(variant))];
        row.extend(cells?);
        Some(row)
    };
    Table {
        columns,
        rows: Variant::ALL.into_iter().filter_map(row).collect(),
        note: "Over h/(c √D), to 0.1, by bisection up to 3.1: noise of 10⁻⁹ c in a periodic box of 12 by 12 cells, 1000 \
               steps, velocities at most doubled. The layouts are points per cell and their largest displacement in point \
               spacings. The bound holds for any layout where the stress is updated first or modified-last; updated last \
               it is up to √2 smaller, and PIC and affine transfers damp what would grow, which is why they reach more."
            .to_owned(),
    }
}

/// The Courant number that is stable whatever the places of the points; zero where none is.
pub(super) fn bound(variant: Variant) -> f64 {
    let Parts { kernel, fields, formulation, .. } = variant.parts();
    if formulation != Formulation::Standard || fields != Fields::Carried {
        return 1.0;
    }
    let length = variant.settings(&Settings::default()).gimp_length;
    let stiffness: f64 = match kernel {
        Kernel::Linear => worst_row_stiffness(&Linear),
        Kernel::Gimp => worst_row_stiffness(&Gimp { length }),
        Kernel::ConvectedGimp => worst_row_stiffness(&ConvectedGimp::default()),
        Kernel::QuadraticBspline => worst_row_stiffness(&QuadraticBspline),
        Kernel::CubicBspline => worst_row_stiffness(&CubicBspline),
        Kernel::DualDomain => worst_row_stiffness(&DualDomain::default()),
        Kernel::Staggered => worst_row_stiffness(&Staggered),
        Kernel::Corrected => worst_row_stiffness(&Corrected::default()),
        Kernel::LeastSquares => worst_row_stiffness(&LeastSquares(QuadraticBspline)),
    };
    2.0 / stiffness.sqrt()
}
