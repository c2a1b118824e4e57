//! The page that links every figure and table with its verdicts.

use super::{Area, Artifact, CHECK_COLUMNS, Content, EVENT_COLUMNS, check_rows, table};
use crate::judge::{Check, tally};

/// What the page says about one case.
#[derive(Clone, Debug)]
pub struct Chapter {
    /// Name of the case.
    pub name: &'static str,
    /// Its line of description.
    pub about: &'static str,
    /// Its figures and tables.
    pub artifacts: Vec<Artifact>,
    /// Its verdicts.
    pub checks: Vec<Check>,
}

/// Renders the page as Markdown.
pub fn render(chapters: &[Chapter], events: &[Vec<String>]) -> String {
    let mut parts = vec![
        "# Accuracy\n\nWritten by `verify report` from the records of runs; do not edit. \
         Numbers of all cases: [checks.csv](checks.csv), [orders.csv](orders.csv), \
         [events.csv](events.csv).\n"
            .to_owned(),
    ];
    for Chapter { name, about, artifacts, checks } in chapters {
        parts.push(format!(
            "\n## {name}\n\n{about}.\n\nChecks: {} of {} hold. \
             All errors: [errors/{name}.csv](errors/{name}.csv).\n",
            tally(checks)[0],
            checks.len(),
        ));
        let shown = |artifact: &&Artifact| artifact.area == Area::Accuracy;
        for artifact in artifacts.iter().filter(shown) {
            parts.push(format!("\n### {}\n\n{}", artifact.title, embed(artifact)));
        }
        if !checks.is_empty() {
            parts.push("\n### Checks\n\n".to_owned());
            let rows = check_rows(checks).into_iter().map(|row| row[1..].to_vec());
            parts.push(table::markdown(&CHECK_COLUMNS[1..], rows));
            parts.push(reasons(checks));
        }
    }
    if !events.is_empty() {
        parts.push("\n## Runs that did not complete\n\n".to_owned());
        parts.push(table::markdown(&EVENT_COLUMNS, events.iter().cloned()));
    }
    parts.concat()
}

/// Why goals are missed, each reason once.
fn reasons(checks: &[Check]) -> String {
    let mut reasons: Vec<&str> = Vec::new();
    for check in checks.iter().filter(|check| check.verdict() == "miss") {
        reasons.extend(check.miss.filter(|reason| !reasons.contains(reason)));
    }
    if reasons.is_empty() {
        return String::new();
    }
    let lines: Vec<String> = reasons.iter().map(|reason| format!("- {reason}\n")).collect();
    format!("\nWhat is known of the goals that are missed:\n\n{}", lines.concat())
}

/// An artifact as it stands on a page in the folder that holds it.
pub fn embed(artifact: &Artifact) -> String {
    let stem = &artifact.stem;
    match &artifact.content {
        Content::Figure(_) | Content::Maps(_) | Content::Bars(_) => {
            format!("![{}](figures/{stem}.svg)\n\n[PNG](figures/{stem}.png)\n", artifact.title)
        }
        Content::Animation(animation) => {
            format!("![{}](animations/{stem}.png)\n\n{}\n", artifact.title, animation.note)
        }
        Content::Profiles(_) => format!("[CSV](profiles/{stem}.csv)\n"),
        Content::Table(table) => {
            format!("{}\n[CSV](tables/{stem}.csv)\n", table.markdown())
        }
    }
}
