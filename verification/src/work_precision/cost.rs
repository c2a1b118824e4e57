//! The scales of cost.

use crate::report::Area;

/// What a run costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Accesses of the grid and of neighbours, the same on any machine.
    Touches,
    /// Instructions by counts of each method per point and step, the same on any machine.
    Instructions,
    /// Points times steps, the same on any machine.
    PointSteps,
    /// Bytes of the points' state read and written, the same on any machine.
    Bytes,
    /// Seconds of one core of this machine.
    Seconds,
}

impl Cost {
    /// Every scale, the one of the first page first.
    pub const ALL: [Self; 5] =
        [Self::Touches, Self::Instructions, Self::PointSteps, Self::Bytes, Self::Seconds];

    /// As on axes and in headings.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Touches => "touches of nodes and neighbours",
            Self::Instructions => "instructions",
            Self::PointSteps => "point-steps",
            Self::Bytes => "bytes of point state",
            Self::Seconds => "seconds of one core",
        }
    }

    /// As in names of files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Touches => "touches",
            Self::Instructions => "instructions",
            Self::PointSteps => "point_steps",
            Self::Bytes => "bytes",
            Self::Seconds => "seconds",
        }
    }

    /// The page of the scale in its folder.
    pub const fn page(self) -> &'static str {
        match self {
            Self::Touches | Self::Seconds => "README.md",
            Self::Instructions => "instructions.md",
            Self::PointSteps => "point_steps.md",
            Self::Bytes => "bytes.md",
        }
    }

    /// Where its page stands.
    pub const fn area(self) -> Area {
        match self {
            Self::Seconds => Area::Timing,
            _ => Area::Accuracy,
        }
    }

    /// The cost within which errors are compared, as a number and in words: round numbers that the sweeps span.
    pub(super) const fn budget(self) -> (f64, &'static str) {
        match self {
            Self::Touches => (1e8, "10⁸ touches"),
            Self::Instructions => (1e10, "10¹⁰ instructions"),
            Self::PointSteps => (1e7, "10⁷ point-steps"),
            Self::Bytes => (1e9, "10⁹ bytes of point state"),
            Self::Seconds => (1.0, "one second"),
        }
    }

    /// Whether each problem has a figure and a table of its front, besides the tables over all problems.
    pub(super) const fn shows_problems(self) -> bool {
        !matches!(self, Self::PointSteps | Self::Bytes)
    }

    /// What is counted and what is not.
    pub(super) const fn about(self) -> &'static str {
        match self {
            Self::Touches => {
                "A touch is a pair of a point, sample or fit with a node or point in its reach, each pass counted. What is \
                 done at each differs between methods and is not counted."
            }
            Self::Instructions => {
                "Instructions are those of one point and step times the points of every step. Those of one point and step \
                 are a snapshot of this code, `benches/instructions/variants.csv`: callgrind's count in a closed box full \
                 of jittered points, with the dimension and the points per axis of the run, with viscosity where the \
                 problem has it, with the stress updated modified-last where the method has it so, on one thread, for one \
                 compiler and the baseline instruction set. Not counted is what a problem adds to that: cut cells, limiters \
                 and relaxation at a free surface, bulk viscosity, forces, walls with friction, and the sorting of points \
                 that change their cell."
            }
            Self::PointSteps => {
                "A point-step is one point taken through one step. What a step costs is not counted, so that the scale \
                 favours methods that do much for each point."
            }
            Self::Bytes => {
                "Bytes are those of a point's state times two, once read and once written, times the points of every step. \
                 Not counted are the nodes and cells, the arrays of a step that do not outlast it, state that a method \
                 passes over more than once, and sorting."
            }
            Self::Seconds => "Seconds are those of one core of this machine.",
        }
    }
}
