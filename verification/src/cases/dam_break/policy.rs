//! The one policy of all runs, and the runs: every constant that could be chosen otherwise.

use transpoint::variants::{
    BoundaryCriterion, Fill, FillMass, FillPoints, Rearrangement, Split, StressUpdate,
};
use transpoint::{Settings, Variant};

use super::scene::{SOUND_SPEED, Shape};
use crate::case::Tier;
use crate::cases::free_surface::{self, FILL, RELAXATION};

/// Total energy over that at the start at which a run counts as blown up.
pub(super) const MOST_ENERGY: f64 = 2.0;
/// Most mass that fills create where they may, over that at the start.
const BUDGET: f64 = 0.02;
/// β of the rival criterion of boundary cells.
const LEAST_SHARE: f64 = 0.9;
/// N_m.
const MOST_POINTS: u32 = 4;
/// α of the splitting.
const SPLIT: f64 = 1.5;

/// How the settings of a run differ from the policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Difference {
    /// They do not.
    None,
    /// The method as printed: volumes of circles, no limiter, no blend.
    Printed,
    /// Fractures are filled.
    Fill,
    /// Fractures are filled and crowded cells reduced.
    FillReduce,
    /// Fractures are filled with four points each.
    FillQuarters,
    /// Fractures are filled with mass that is created within a budget.
    FillBudget,
    /// Fractures are filled; a boundary cell is one that its points fill to less than β.
    FillShare,
    /// Stress updated modified-last.
    ModifiedLast,
    /// The same, and points split by volume.
    SplitVolume,
    /// The same, and points split by stretch.
    SplitStretch,
}

impl Difference {
    /// The value of the label `run`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::None => "policy",
            Self::Printed => "printed",
            Self::Fill => "fill",
            Self::FillReduce => "fill-reduce",
            Self::FillQuarters => "fill-quarters",
            Self::FillBudget => "fill-budget",
            Self::FillShare => "fill-beta",
            Self::ModifiedLast => "musl",
            Self::SplitVolume => "split-volume",
            Self::SplitStretch => "split-stretch",
        }
    }

    fn rearrangement(self) -> Option<Rearrangement> {
        let fill = |fill| Rearrangement { fill: Some(fill), ..Rearrangement::default() };
        let filled = fill(FILL);
        let split = |split| Rearrangement { split: Some(split), ..Rearrangement::default() };
        match self {
            Self::Fill | Self::FillShare => Some(filled),
            Self::FillQuarters => Some(fill(Fill { points: FillPoints::Quarters, ..FILL })),
            Self::FillBudget => Some(fill(Fill { mass: FillMass::Budget(BUDGET), ..FILL })),
            Self::FillReduce => Some(Rearrangement { most_points: Some(MOST_POINTS), ..filled }),
            Self::SplitVolume => Some(split(Split::Volume(SPLIT))),
            Self::SplitStretch => Some(split(Split::Stretch(SPLIT))),
            Self::None | Self::Printed | Self::ModifiedLast => None,
        }
    }
}

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Name of resolution and points, the layout of the record.
    pub(super) layout: &'static str,
    pub(super) difference: Difference,
    pub(super) shape: Shape,
    /// Cell size, m.
    pub(super) spacing: f64,
    pub(super) points_per_axis: usize,
    /// T at the end; for the slab the number of steps.
    pub(super) end: f64,
    /// Whether frames of an animation are kept.
    pub(super) frames: bool,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

const fn dense(variant: Variant, difference: Difference) -> Run {
    Run {
        variant,
        layout: "dense",
        difference,
        shape: Shape::Plane,
        spacing: 0.02,
        points_per_axis: 4,
        end: 4.0,
        frames: false,
        tier: Tier::Paper,
    }
}

const fn coarse(variant: Variant, difference: Difference) -> Run {
    Run { layout: "coarse", points_per_axis: 1, ..dense(variant, difference) }
}

const fn smoke(variant: Variant, difference: Difference) -> Run {
    Run {
        layout: "small",
        spacing: 0.06,
        points_per_axis: 2,
        end: 2.0,
        tier: Tier::Smoke,
        ..dense(variant, difference)
    }
}

/// The run of a variant in the case `rivals`.
pub(super) const fn rival(variant: Variant, carried: bool) -> Run {
    let difference = if carried { Difference::ModifiedLast } else { Difference::None };
    Run { layout: "rivals", spacing: 0.04, ..smoke(variant, difference) }
}

const fn filmed(run: Run) -> Run {
    Run { frames: true, ..run }
}

/// Every run, the longest first.
pub(super) static RUNS: [Run; 19] = [
    Run {
        layout: "tank-3d",
        shape: Shape::Tank,
        points_per_axis: 2,
        end: 2.0,
        tier: Tier::Full,
        ..dense(Variant::TpmVpQuadratic, Difference::None)
    },
    filmed(dense(Variant::TpmVpQuadratic, Difference::None)),
    dense(Variant::TpmVpConstant, Difference::None),
    filmed(dense(Variant::GimpVp, Difference::ModifiedLast)),
    dense(Variant::GimpVp, Difference::None),
    dense(Variant::Tpm, Difference::Printed),
    filmed(coarse(Variant::TpmVpQuadratic, Difference::None)),
    filmed(coarse(Variant::TpmVpQuadratic, Difference::Fill)),
    coarse(Variant::TpmVpQuadratic, Difference::FillReduce),
    coarse(Variant::TpmVpQuadratic, Difference::FillQuarters),
    coarse(Variant::TpmVpQuadratic, Difference::FillBudget),
    coarse(Variant::TpmVpQuadratic, Difference::FillShare),
    coarse(Variant::MpmVp, Difference::None),
    coarse(Variant::MpmVp, Difference::ModifiedLast),
    coarse(Variant::MpmVp, Difference::SplitVolume),
    coarse(Variant::MpmVp, Difference::SplitStretch),
    Run {
        layout: "slab",
        shape: Shape::Slab,
        spacing: 0.04,
        points_per_axis: 2,
        end: 200.0,
        ..dense(Variant::TpmVpQuadratic, Difference::None)
    },
    smoke(Variant::TpmVpQuadratic, Difference::None),
    smoke(Variant::GimpVp, Difference::ModifiedLast),
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 5] = [
    Variant::TpmVpQuadratic,
    Variant::TpmVpConstant,
    Variant::GimpVp,
    Variant::Tpm,
    Variant::MpmVp,
];

/// Settings of a run.
pub(super) fn settings(run: &Run) -> Settings {
    if run.difference == Difference::Printed {
        return free_surface::printed(run.points_per_axis);
    }
    let modified = matches!(
        run.difference,
        Difference::ModifiedLast | Difference::SplitVolume | Difference::SplitStretch
    );
    Settings {
        stress_update: if modified { StressUpdate::ModifiedLast } else { StressUpdate::Last },
        boundary_criterion: match run.difference {
            Difference::FillShare => BoundaryCriterion::VolumeShare(LEAST_SHARE),
            _ => BoundaryCriterion::EmptyNeighbor,
        },
        rearrangement: run.difference.rearrangement(),
        ..free_surface::settings(run.points_per_axis, run.spacing, SOUND_SPEED, RELAXATION)
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "All runs but `printed`: {} `printed`: \
         FLIP, circles, no limiter. `fill`: {FILL:?}; `fill-reduce`: with N_m = {MOST_POINTS}; \
         `fill-quarters`: four points per fracture; `fill-budget`: mass created, at most {BUDGET} of that at \
         the start; `fill-beta`: a boundary cell is one that its points fill to less than β = {LEAST_SHARE}; \
         splitting: α = {SPLIT}. c₀ = 50 m/s, p ≥ −5000 Pa, hydrostatic at the start. A run whose \
         total energy exceeds {MOST_ENERGY} times that at the start has blown up.",
        free_surface::text("`musl` and the splitting runs")
    )
}
