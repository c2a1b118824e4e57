//! The commands: each takes a plan and returns a verdict.

mod study;

use std::collections::BTreeMap;
use std::io::Write;

use anyhow::{Context, Result, bail};
use serde::Serialize;
use transpoint::Variant;
use transpoint::formulation::Formulation;
use transpoint::variants::{Fields, Kernel, Parts, TransferKind};

use crate::cases::{self, rivals};
use crate::cli::{
    Arguments, CheckArguments, Command, Format, ListArguments, ReportArguments, RunArguments,
};
use crate::judge::{Check, Verdict, tally};
use crate::plan::Plan;
use crate::progress::say;
use crate::report::{self, table};
use crate::run::{self, Execution, Summary};

/// Does what the command line asks for.
///
/// # Errors
/// When the request is not possible or a file cannot be read or written.
pub fn execute(arguments: Arguments) -> Result<Verdict> {
    match arguments.command {
        None => all(&arguments.all),
        Some(Command::List(list_arguments)) => list(&list_arguments),
        Some(Command::Run(run_arguments)) => run(&run_arguments),
        Some(Command::Report(report_arguments)) => report(&report_arguments),
        Some(Command::Check(check_arguments)) => check(&check_arguments),
        Some(Command::WorkPrecision(study_arguments)) => study::work_precision(&study_arguments),
        Some(Command::Advise(advise_arguments)) => study::advise(&advise_arguments),
    }
}

fn all(arguments: &RunArguments) -> Result<Verdict> {
    let plan = Plan::new(&arguments.selection, &cases::ALL)?;
    let summary = execute_runs(&plan, arguments)?;
    if arguments.format == Format::Text {
        print_text(&summary_text(&summary))?;
    }
    let found = plan.find_records()?;
    report::write(&plan, &found.records)?;
    let checks = report::checks(&plan, &found.records);
    print_checks(&checks, arguments.format, arguments.quiet)?;
    Ok(Verdict::of(&checks))
}

fn run(arguments: &RunArguments) -> Result<Verdict> {
    let plan = Plan::new(&arguments.selection, &cases::ALL)?;
    let summary = execute_runs(&plan, arguments)?;
    match arguments.format {
        Format::Text => print_text(&summary_text(&summary))?,
        Format::Json => print_json(&summary)?,
    }
    Ok(Verdict::Holds)
}

fn execute_runs(plan: &Plan, arguments: &RunArguments) -> Result<Summary> {
    let execution = Execution {
        threads: arguments.threads.map(usize::from),
        force: arguments.force,
        quiet: arguments.quiet,
    };
    run::execute(plan, execution)
}

fn report(arguments: &ReportArguments) -> Result<Verdict> {
    let plan = Plan::new(&arguments.selection, &cases::ALL)?;
    let found = plan.find_records()?;
    plan.prepare_out()?;
    report::write(&plan, &found.records)?;
    if !arguments.quiet {
        if let Some(shortfall) = found.shortfall(&plan.out) {
            say(&format!("warning: {shortfall}"));
        }
        say(&format!("wrote {}", plan.out.join("accuracy").join("README.md").display()));
    }
    Ok(Verdict::Holds)
}

fn check(arguments: &CheckArguments) -> Result<Verdict> {
    let plan = Plan::new(&arguments.selection, &cases::ALL)?;
    let found = plan.find_records()?;
    if let Some(shortfall) = found.shortfall(&plan.out) {
        bail!(shortfall);
    }
    let checks = report::checks(&plan, &found.records);
    print_checks(&checks, arguments.format, arguments.quiet)?;
    Ok(Verdict::of(&checks))
}

#[derive(Serialize)]
struct ListedRun {
    variant: String,
    layout: String,
    level: usize,
    run: String,
    on_record: bool,
}

#[derive(Serialize)]
struct ListedVariant {
    variant: &'static str,
    about: &'static str,
    kernel: Kernel,
    nodes_per_axis: usize,
    fields: Fields,
    transfer: TransferKind,
    formulation: Formulation,
    fixes: BTreeMap<String, serde_json::Value>,
    page: String,
}

impl ListedVariant {
    fn of(variant: Variant) -> Self {
        let Parts { kernel, fields, transfer, formulation, .. } = variant.parts();
        Self {
            variant: variant.name(),
            about: variant.about(),
            kernel,
            nodes_per_axis: kernel.width(),
            fields,
            transfer,
            formulation,
            fixes: rivals::fixed(variant).into_iter().collect(),
            page: format!("docs/methods/{}.md", variant.name()),
        }
    }
}

/// What can be run: the methods of the library, and the cases.
#[derive(Serialize)]
struct Listing {
    variants: Vec<ListedVariant>,
    cases: Vec<ListedCase>,
}

#[derive(Serialize)]
struct ListedCase {
    case: &'static str,
    about: &'static str,
    variants: Vec<&'static str>,
    levels: usize,
    runs: Vec<ListedRun>,
}

fn list(arguments: &ListArguments) -> Result<Verdict> {
    let plan = Plan::new(&arguments.selection, &cases::ALL)?;
    let store = plan.store();
    let mut listed = Vec::new();
    for case in &plan.cases {
        let mut runs = Vec::new();
        for planned in plan.runs.iter().filter(|planned| planned.spec.case == case.name()) {
            runs.push(ListedRun {
                variant: planned.spec.variant.clone(),
                layout: planned.spec.layout.clone(),
                level: planned.spec.level,
                run: planned.spec.slug(),
                on_record: store.path(&planned.spec).exists(),
            });
        }
        listed.push(ListedCase {
            case: case.name(),
            about: case.about(),
            variants: case.variants(),
            levels: case.levels(),
            runs,
        });
    }
    match arguments.format {
        Format::Text => print_text(&list_text(&listed, &plan))?,
        Format::Json => print_json(&Listing {
            variants: Variant::ALL.map(ListedVariant::of).into_iter().collect(),
            cases: listed,
        })?,
    }
    Ok(Verdict::Holds)
}

fn list_text(listed: &[ListedCase], plan: &Plan) -> String {
    let describe = |case: &ListedCase| {
        format!(
            "{}: {}\n  variants: {}\n  levels:   0 to {}\n  \
             runs:     {} in tier {}, {} on record in {}\n",
            case.case,
            case.about,
            case.variants.join(", "),
            case.levels.saturating_sub(1),
            case.runs.len(),
            plan.tier.name(),
            case.runs.iter().filter(|run| run.on_record).count(),
            plan.out.display()
        )
    };
    listed.iter().map(describe).collect::<Vec<_>>().join("\n")
}

fn summary_text(summary: &Summary) -> String {
    let mut lines = vec![format!(
        "{} runs: {} executed, {} on record",
        summary.selected, summary.executed, summary.skipped
    )];
    if !summary.not_completed.is_empty() {
        lines.push(format!("{} did not complete:", summary.not_completed.len()));
        lines.extend(summary.not_completed.iter().map(|line| format!("  {line}")));
    }
    lines.join("\n") + "\n"
}

fn print_checks(checks: &[Check], format: Format, only_failed: bool) -> Result<()> {
    if format == Format::Json {
        return print_json(&report::judged(checks));
    }
    let shown: Vec<_> =
        checks.iter().filter(|check| !only_failed || check.fails()).cloned().collect();
    let [passed, missed, failed] = tally(checks);
    let known = if missed > 0 { format!("{missed} missed as known, ") } else { String::new() };
    let summary = format!("{} checks: {passed} passed, {known}{failed} failed\n", checks.len());
    let table = if shown.is_empty() {
        String::new()
    } else {
        table::terminal(&report::CHECK_COLUMNS, report::check_rows(&shown).into_iter()) + "\n"
    };
    print_text(&(table + &summary))
}

fn print_json(value: &impl Serialize) -> Result<()> {
    print_text(&(serde_json::to_string_pretty(value)? + "\n"))
}

/// Writes to the standard output; a reader that has left is not an error.
fn print_text(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to the standard output")
        }
        _ => Ok(()),
    }
}
