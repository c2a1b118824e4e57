//! What of the paper's claim holds: statements, the numbers measured, and a verdict from them.

use super::results::{exact_variation, find, value};
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// A profile rings if the total variation of its cell means exceeds the exact one by this factor.
const RINGS: f64 = 1.1;
/// A method fails on disordered points if its L1 error is above this, Pa: the bound of the check.
const FAILS: f64 = 50.0;
/// Largest distance of a plateau's extremes from 550 Pa, Pa: the bounds of the checks.
const PLATEAU: f64 = 20.0;

/// What a statement says of each of its runs.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Says {
    Rings,
    DoesNotRing,
    KeepsThePlateau,
    FailsOnDisorder,
    BearsDisorder,
}

/// A statement about runs: method and dissipation.
struct Statement {
    text: &'static str,
    says: Says,
    runs: &'static [(&'static str, &'static str)],
}

/// The paper's claim first, then what was found to matter.
const STATEMENTS: [Statement; 11] = [
    Statement {
        text: "MPM (velocity-pressure, no limiter, no dissipation) rings [Song2020]",
        says: Says::Rings,
        runs: &[("mpm-vp", "flip"), ("mpm-vp-musl", "flip")],
    },
    Statement {
        text: "TPM under the same conditions does not [Song2020]",
        says: Says::DoesNotRing,
        runs: &[
            ("tpm", "flip"),
            ("tpm-vp0", "flip"),
            ("tpm-vp", "flip"),
            ("tpm-vp2", "flip"),
            ("tpm-vp0-musl", "flip"),
        ],
    },
    Statement {
        text: "A slope limiter in the cells removes the ringing",
        says: Says::DoesNotRing,
        runs: &[
            ("mpm-vp-bj", "flip"),
            ("mpm-vp-mc", "flip"),
            ("tpm-vp0-bj", "flip"),
            ("tpm-vp0-mc", "flip"),
        ],
    },
    Statement {
        text: "A relaxation towards PIC (τ = 2 h/c₀) leaves no ringing",
        says: Says::DoesNotRing,
        runs: &[
            ("tpm", "relaxed"),
            ("tpm-vp0", "relaxed"),
            ("tpm-vp", "relaxed"),
            ("tpm-vp2", "relaxed"),
            ("mpm-vp", "relaxed"),
        ],
    },
    Statement {
        text: "It keeps the plateau within 550 ± 20 Pa",
        says: Says::KeepsThePlateau,
        runs: &[
            ("tpm", "relaxed"),
            ("tpm-vp0", "relaxed"),
            ("tpm-vp", "relaxed"),
            ("tpm-vp2", "relaxed"),
            ("mpm-vp", "relaxed"),
        ],
    },
    Statement {
        text: "Bulk viscosity leaves no ringing",
        says: Says::DoesNotRing,
        runs: &[
            ("tpm", "viscous"),
            ("tpm-vp0", "viscous"),
            ("tpm-vp", "viscous"),
            ("tpm-vp2", "viscous"),
            ("mpm-vp", "viscous"),
        ],
    },
    Statement {
        text: "It keeps the plateau within 550 ± 20 Pa",
        says: Says::KeepsThePlateau,
        runs: &[
            ("tpm", "viscous"),
            ("tpm-vp0", "viscous"),
            ("tpm-vp", "viscous"),
            ("tpm-vp2", "viscous"),
            ("mpm-vp", "viscous"),
        ],
    },
    Statement {
        text: "On disordered points MPM without velocity-pressure fails, undamped",
        says: Says::FailsOnDisorder,
        runs: &[("mpm", "flip"), ("gimp", "flip"), ("bspline2", "flip"), ("apic", "affine")],
    },
    Statement {
        text: "Dissipation does not save it",
        says: Says::FailsOnDisorder,
        runs: &[
            ("mpm", "relaxed"),
            ("mpm", "viscous"),
            ("gimp", "relaxed"),
            ("bspline2", "relaxed"),
            ("apic", "viscous"),
        ],
    },
    Statement {
        text: "On disordered points TPM does not fail, undamped",
        says: Says::BearsDisorder,
        runs: &[("tpm", "flip"), ("tpm-vp0", "flip"), ("tpm-vp", "flip"), ("tpm-vp2", "flip")],
    },
    Statement {
        text: "Nor does MPM with velocity-pressure",
        says: Says::BearsDisorder,
        runs: &[("mpm-vp", "flip"), ("mpm-vp-musl", "flip")],
    },
];

/// Statements whose runs are on record, with numbers and verdicts.
pub(super) fn table(records: &[RunRecord]) -> Table {
    let rows = STATEMENTS.iter().filter_map(|statement| {
        let found: Vec<Found> =
            statement.runs.iter().filter_map(|&run| Found::of(records, run)).collect();
        (!found.is_empty()).then(|| {
            let numbers: Vec<String> = found.iter().map(|run| run.text(statement.says)).collect();
            let holding = found.iter().filter(|run| run.agrees(statement.says)).count();
            let verdict = if holding == found.len() {
                "holds".to_owned()
            } else if holding == 0 {
                "does not hold".to_owned()
            } else {
                format!("holds for {holding} of {}", found.len())
            };
            vec![Cell::from(statement.text), Cell::Text(numbers.join("; ")), Cell::Text(verdict)]
        })
    });
    let columns = ["statement", "regular / jittered", "measured"].map(str::to_owned).to_vec();
    let note = format!(
        "Of ringing: total variation of the cell means over the exact 900 Pa; more than {RINGS} on \
         either layout counts as ringing. Of the plateau: extremes of the points with |x − 0.5 m| < 0.2 \
         m, Pa. Of disorder: L1 error of the pressure, Pa; more than {FAILS} counts as failure. That \
         failure is no ringing of fronts: the points of one cell scatter by as much where nothing has \
         happened yet. The verdicts are computed from the numbers. `tpm-vp` (vertex mean) is left out \
         of the figures, which it would overshoot."
    );
    Table { columns, rows: rows.collect(), note }
}

/// The two runs of a method, on the lattice and on disordered points.
struct Found {
    name: String,
    variation: [f64; 2],
    plateau: [[f64; 2]; 2],
    error: [f64; 2],
}

impl Found {
    fn of(records: &[RunRecord], (method, dissipation): (&str, &str)) -> Option<Self> {
        let regular = find(records, method, "regular", dissipation)?;
        let jittered = find(records, method, "jittered", dissipation)?;
        let of = |norm: &str| [regular, jittered].map(|record| value(record, "pressure", norm));
        Some(Self {
            name: format!("{method} {dissipation}"),
            variation: of("tv-cells").map(|variation| variation / exact_variation()),
            plateau: [of("plateau-min"), of("plateau-max")],
            error: of("l1"),
        })
    }

    /// A run that blew up rings and fails.
    fn agrees(&self, says: Says) -> bool {
        let calm = self.variation.iter().all(|&variation| variation <= RINGS);
        let level = |pressure: &f64| (pressure - 550.0).abs() <= PLATEAU;
        let bears = self.error[1] <= FAILS;
        match says {
            Says::Rings => !calm,
            Says::DoesNotRing => calm,
            Says::KeepsThePlateau => self.plateau.iter().flatten().all(level),
            Says::FailsOnDisorder => !bears,
            Says::BearsDisorder => bears,
        }
    }

    fn text(&self, says: Says) -> String {
        let name = &self.name;
        match says {
            Says::Rings | Says::DoesNotRing => {
                format!("{name} {:.2} / {:.2}", self.variation[0], self.variation[1])
            }
            Says::KeepsThePlateau => {
                let [low, high] = self.plateau;
                format!("{name} {:.0}…{:.0} / {:.0}…{:.0}", low[0], high[0], low[1], high[1])
            }
            Says::FailsOnDisorder | Says::BearsDisorder => {
                format!("{name} {:.1} / {:.1}", self.error[0], self.error[1])
            }
        }
    }
}
