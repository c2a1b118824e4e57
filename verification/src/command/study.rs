//! The commands of the study of speed against error.

use anyhow::{Result, bail};

use super::{print_json, print_text, summary_text};
use crate::case::{Case, Tier};
use crate::cli::{AdviseArguments, Format, SelectionArguments, WorkPrecisionArguments};
use crate::judge::Verdict;
use crate::number;
use crate::progress::say;
use crate::report::table;
use crate::run::{self, Execution, Summary};
use crate::work_precision::{self, Advice, Study};

/// Makes the runs and the timings that are not on record, unless only the report is asked for, and writes it.
pub(super) fn work_precision(arguments: &WorkPrecisionArguments) -> Result<Verdict> {
    let selection = arguments.selection();
    if !arguments.only_report {
        measure(arguments, &selection)?;
    }
    let study = Study::read(&selection)?;
    study.write(&arguments.out)?;
    if !arguments.quiet {
        if let Some(shortfall) = &study.shortfall {
            say(&format!("warning: {shortfall}"));
        }
        let page = |area: &str| arguments.out.join(area).join("work-precision").join("README.md");
        say(&format!("wrote {}", page("accuracy").display()));
        if page("timing").exists() {
            say(&format!("wrote {}", page("timing").display()));
        }
    }
    Ok(Verdict::Holds)
}

/// Both phases of the study.
fn measure(arguments: &WorkPrecisionArguments, selection: &SelectionArguments) -> Result<()> {
    let errors = work_precision::error_plan(selection)?;
    let timings = work_precision::timing_plan(selection)?;
    let execution = Execution {
        threads: arguments.threads.map(usize::from),
        force: arguments.force,
        quiet: arguments.quiet,
    };
    let summary = run::execute(&errors, execution)?;
    print_text(&summary_text(&summary))?;
    if !arguments.untimed {
        // One worker with one thread: nothing of ours runs beside a timing.
        let summary = run::execute(&timings, Execution { threads: Some(1), ..execution })?;
        let Summary { executed, skipped, .. } = summary;
        print_text(&format!("timings: {executed} executed, {skipped} on record\n"))?;
    }
    Ok(())
}

/// Prints the cheapest runs that reached an error; exit code 1 if none did.
pub(super) fn advise(arguments: &AdviseArguments) -> Result<Verdict> {
    let selection = SelectionArguments {
        case: vec![arguments.case.clone()],
        variant: Vec::new(),
        tier: Tier::Full,
        level: None,
        out: arguments.out.clone(),
    };
    let study = Study::read(&selection)?;
    if let Some(shortfall) = &study.shortfall {
        say(&format!("warning: {shortfall}"));
    }
    let Some((benchmark, points)) = study.problems.first() else {
        bail!("no measured runs of {}", arguments.case);
    };
    let advice = work_precision::advise(points, arguments.error);
    match arguments.format {
        Format::Json => print_json(&advice)?,
        Format::Text if advice.is_empty() => {
            let least = points
                .iter()
                .filter(|point| point.error.is_finite())
                .min_by(|a, b| a.error.total_cmp(&b.error));
            let nearest = least.map_or_else(String::new, |point| {
                format!("; the least is {} by {}", number::significant(point.error), point.variant)
            });
            print_text(&format!(
                "no run of {} reached an error of {}{nearest}\n",
                benchmark.name(),
                arguments.error
            ))?;
        }
        Format::Text => print_text(&advice_text(benchmark.name(), arguments.error, &advice))?,
    }
    Ok(if advice.is_empty() { Verdict::Fails } else { Verdict::Holds })
}

fn advice_text(case: &str, error: f64, advice: &[Advice]) -> String {
    let unit = advice[0].cost_unit;
    let columns = ["variant", "spacing (m)", "points per cell", "Courant number", "error", unit];
    let row = |advice: &Advice| {
        vec![
            advice.run.variant.clone(),
            number::significant(advice.run.spacing),
            advice.run.points.clone(),
            number::order(advice.run.courant_number),
            number::scientific(advice.run.error),
            number::scientific(advice.cost),
        ]
    };
    let table = table::terminal(&columns, advice.iter().map(row));
    format!(
        "{case}: runs that reached a relative error of {error}, the cheapest of each method first\n{table}\n"
    )
}
