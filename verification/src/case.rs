//! What a study provides: its runs, and what follows from their records.

mod raster;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::Variant;

use crate::convergence::Order;
use crate::judge::{Check, Miss};
use crate::number::nullable;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
pub use raster::Raster;

/// How much of a study is run. The code is the same, the levels differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, clap::ValueEnum)]
pub enum Tier {
    /// A minute in total, for continuous integration.
    Smoke,
    /// Every figure of the paper; the default.
    Paper,
    /// All studies at all levels.
    Full,
}

impl Tier {
    /// Identifier on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Smoke => "smoke",
            Self::Paper => "paper",
            Self::Full => "full",
        }
    }
}

/// One run of a study: everything that its result depends on, apart from the program itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSpec {
    /// Name of the case.
    pub case: String,
    /// Name of the method, usually of a [`transpoint::Variant`].
    pub variant: String,
    /// Arrangement of the points.
    pub layout: String,
    /// What else tells runs apart, e.g. `instant` or `axis`.
    pub labels: BTreeMap<String, String>,
    /// Resolution step, 0 being the coarsest.
    pub level: usize,
    /// Cell size h, m: the abscissa of convergence.
    pub spacing: f64,
    /// Parameters that only the case itself understands, settings of the solver included.
    pub parameters: serde_json::Value,
}

impl RunSpec {
    /// The label of that name, empty if there is none.
    pub fn label(&self, name: &str) -> &str {
        self.labels.get(name).map_or("", String::as_str)
    }

    /// Unique and stable name within the case, fit for a file: variant, layout, the values of the
    /// labels in the order of their names, and the level.
    pub fn slug(&self) -> String {
        let mut parts = vec![self.variant.clone(), self.layout.clone()];
        parts.extend(self.labels.values().cloned());
        parts.push(format!("level{}", self.level));
        parts.join("_").replace(['/', ' '], "-")
    }

    /// Content key: changes with the parameters and with the `fingerprint` of the program.
    ///
    /// # Errors
    /// When the parameters cannot be written as JSON.
    pub fn key(&self, fingerprint: &str) -> serde_json::Result<String> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(fingerprint.as_bytes());
        hasher.update(&serde_json::to_vec(self)?);
        Ok(hasher.finalize().to_hex().to_string())
    }
}

/// One measured number of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// What was measured; where a case has several instants, `quantity@instant`.
    pub quantity: String,
    /// How it was measured, e.g. `point-l2`.
    pub norm: String,
    /// The value; not a number where the run blew up.
    #[serde(with = "nullable")]
    pub value: f64,
    /// The same norm of the exact field, for relative errors.
    #[serde(with = "nullable")]
    pub scale: f64,
}

/// A sampled curve of a run: a profile in space or a history in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// What is sampled, unique within the run.
    pub name: String,
    /// Abscissae and values; a value that is not a number is a gap.
    pub points: Vec<(f64, Option<f64>)>,
}

impl Profile {
    /// From pairs whose values may not be numbers.
    pub fn new(name: impl Into<String>, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let gap = |(at, value): (f64, f64)| (at, value.is_finite().then_some(value));
        Self { name: name.into(), points: points.into_iter().map(gap).collect() }
    }

    /// Pairs, gaps as not a number.
    pub fn pairs(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|&(at, value)| (at, value.unwrap_or(f64::NAN))).collect()
    }
}

/// How a run ended. A blow-up is a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "status", deny_unknown_fields)]
pub enum Outcome {
    /// The run reached its end.
    Completed,
    /// The solver stopped.
    BlownUp {
        /// Steps completed before it.
        step: u64,
        /// Time at which it stopped, s.
        time: f64,
        /// Which point and which field, in the solver's words.
        reason: String,
    },
    /// The simulation could not be built.
    NotBuilt {
        /// Why, in the solver's words.
        reason: String,
    },
}

/// What a case returns for one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// How the run ended.
    pub outcome: Outcome,
    /// The measured numbers, in a fixed order. A run that blew up has the same rows, with values
    /// that are not numbers, so that it leaves a gap in every curve.
    pub rows: Vec<Row>,
    /// Sampled curves; none where the run blew up.
    pub profiles: Vec<Profile>,
    /// Fields and classifications on the cells of a plane grid; most runs have none.
    pub rasters: Vec<Raster>,
    /// Work and event counters by name.
    pub counters: BTreeMap<String, u64>,
    /// Wall time of the work itself, without set-up and measurement, s.
    pub seconds: f64,
}

impl Row {
    /// A row of a run that has no value for it.
    pub fn missing(quantity: impl Into<String>, norm: impl Into<String>) -> Self {
        Self { quantity: quantity.into(), norm: norm.into(), value: f64::NAN, scale: f64::NAN }
    }
}

impl Findings {
    /// Findings of a run that could not be set up; `rows` are those it would have had.
    pub fn not_built(reason: &impl ToString, rows: Vec<Row>) -> Self {
        Self {
            outcome: Outcome::NotBuilt { reason: reason.to_string() },
            rows,
            profiles: Vec::new(),
            rasters: Vec::new(),
            counters: BTreeMap::new(),
            seconds: 0.0,
        }
    }
}

/// A study. It knows no files, no clock but that of its own work, and no command line.
///
/// To add one: a file under `cases/` with a type that implements this trait, and a line in
/// [`crate::cases::ALL`].
pub trait Case: Sync {
    /// Identifier on command lines, in tables and in file names.
    fn name(&self) -> &'static str;

    /// One line: what is shown, and its source.
    fn about(&self) -> &'static str;

    /// Names of the methods compared, in the order of legends and tables; every variant of the library
    /// unless the case says otherwise.
    fn variants(&self) -> Vec<&'static str> {
        Variant::CORE.iter().map(|variant| variant.name()).collect()
    }

    /// Resolution steps; `--level` accepts `0..levels()`.
    fn levels(&self) -> usize;

    /// What the numbers below every table depend on: one line of settings.
    fn policy(&self) -> String;

    /// The runs of a tier, each with a different slug.
    fn runs(&self, tier: Tier) -> Vec<RunSpec>;

    /// Executes one run. The result must depend on `spec` alone, `seconds` apart.
    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings;

    /// Verdicts. A check whose runs are not among the records at all is left out; one whose runs
    /// blew up fails.
    fn checks(&self, records: &[RunRecord]) -> Vec<Check>;

    /// Goals that are known not to be met.
    fn misses(&self) -> &'static [Miss] {
        &[]
    }

    /// Observed orders of convergence.
    fn orders(&self, records: &[RunRecord]) -> Vec<Order>;

    /// Figures and tables, in the order of the page.
    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact>;
}
