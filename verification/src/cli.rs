//! The command line as typed. What it means is decided in [`crate::plan`].

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::case::Tier;

/// Verifies the solver against exact solutions and published results.
///
/// Without a command: run, report and check the paper tier. Exit code 0: every check holds; 1: a
/// check failed; 2: the request or the file system is at fault.
#[derive(Debug, Parser)]
#[command(name = "verify", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// Options of the bare command.
    #[command(flatten)]
    pub all: RunArguments,
}

/// Commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List cases, variants and runs, and which runs are on record
    List(ListArguments),
    /// Execute the runs that are not on record yet
    Run(RunArguments),
    /// Write figures and tables from the records
    Report(ReportArguments),
    /// Judge the records; exit code 1 if a check fails
    Check(CheckArguments),
    /// Measure speed against error: runs, timings, figures and tables
    WorkPrecision(WorkPrecisionArguments),
    /// Say which method, spacing and Courant number reached an error at the least cost
    Advise(AdviseArguments),
}

/// Which runs.
#[derive(Clone, Debug, Args)]
pub struct SelectionArguments {
    /// Only this case (may be repeated)
    #[arg(long, value_name = "NAME")]
    pub case: Vec<String>,
    /// Only this variant (may be repeated)
    #[arg(long, value_name = "NAME")]
    pub variant: Vec<String>,
    /// How much
    #[arg(long, value_enum, default_value_t = Tier::Paper)]
    pub tier: Tier,
    /// Only this level, 0 being the coarsest
    #[arg(long, value_name = "N")]
    pub level: Option<usize>,
    /// Folder for records and reports
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
}

/// Form of what is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Tables to read.
    Text,
    /// JSON to script against.
    Json,
}

/// Options of `list`.
#[derive(Debug, Args)]
pub struct ListArguments {
    /// Which runs.
    #[command(flatten)]
    pub selection: SelectionArguments,
    /// Form of the output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Options of `run`.
#[derive(Debug, Args)]
pub struct RunArguments {
    /// Which runs.
    #[command(flatten)]
    pub selection: SelectionArguments,
    /// Threads in total; results do not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Repeat runs that are on record
    #[arg(long)]
    pub force: bool,
    /// No progress on the standard error
    #[arg(long)]
    pub quiet: bool,
    /// Form of the summary
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Options of `report`.
#[derive(Debug, Args)]
pub struct ReportArguments {
    /// Which runs.
    #[command(flatten)]
    pub selection: SelectionArguments,
    /// Only errors on the standard error
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `check`.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Which runs.
    #[command(flatten)]
    pub selection: SelectionArguments,
    /// Form of the verdicts
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Only failed checks
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `work-precision`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "one for each switch of the command line")]
pub struct WorkPrecisionArguments {
    /// Only this problem (may be repeated)
    #[arg(long, value_name = "NAME")]
    pub case: Vec<String>,
    /// Only this variant (may be repeated)
    #[arg(long, value_name = "NAME")]
    pub variant: Vec<String>,
    /// Only this level, 0 being the coarsest
    #[arg(long, value_name = "N")]
    pub level: Option<usize>,
    /// Folder for records and reports
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Threads of the runs that give the errors; timings take one [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Repeat runs and timings that are on record
    #[arg(long)]
    pub force: bool,
    /// No timings: errors and machine-free costs only
    #[arg(long)]
    pub untimed: bool,
    /// No runs: figures and tables from what is on record
    #[arg(long, conflicts_with_all = ["force", "threads", "untimed"])]
    pub only_report: bool,
    /// No progress on the standard error
    #[arg(long)]
    pub quiet: bool,
}

impl WorkPrecisionArguments {
    /// The runs of the full study that are asked for.
    pub fn selection(&self) -> SelectionArguments {
        SelectionArguments {
            case: self.case.clone(),
            variant: self.variant.clone(),
            tier: Tier::Full,
            level: self.level,
            out: self.out.clone(),
        }
    }
}

/// Options of `advise`.
#[derive(Debug, Args)]
pub struct AdviseArguments {
    /// The problem
    #[arg(value_name = "CASE")]
    pub case: String,
    /// Relative error to reach, as a number or in per cent, e.g. 0.01 or 1%
    #[arg(long, value_name = "ERROR", value_parser = parse_error)]
    pub error: f64,
    /// Folder of the records
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Form of the output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// A relative error above 0 and at most 1, with or without a per cent sign.
fn parse_error(text: &str) -> Result<f64, String> {
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text.trim(), 1.0),
    };
    let allowed = "allowed: above 0 and at most 1, or above 0% and at most 100%";
    let value = number.trim().parse::<f64>().map_err(|_| allowed.to_owned())? * scale;
    if value > 0.0 && value <= 1.0 { Ok(value) } else { Err(allowed.to_owned()) }
}
