//! The page that links every figure and table with its verdicts.

use super::{Area, Artifact, CHECK_COLUMNS, Content, EVENT_COLUMNS, check_rows, table};
use crate::judge::Check;

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
    let mut text = String::from(
        "# Accuracy\n\nWritten by `verify report` from the records of runs; do not edit. \
         Numbers of all cases: [checks.csv](checks.csv), [orders.csv](orders.csv), \
         [events.csv](events.csv).\n",
    );
    for chapter in chapters {
        let failed = chapter.checks.iter().filter(|check| !check.holds()).count();
        text += &format!("\n## {}\n\n{}.\n\n", chapter.name, chapter.about);
        text += &format!(
            "Checks: {} of {} hold. All errors: [errors/{}.csv](errors/{}.csv).\n",
            chapter.checks.len() - failed,
            chapter.checks.len(),
            chapter.name,
            chapter.name
        );
        let shown = |artifact: &&Artifact| artifact.area == Area::Accuracy;
        for artifact in chapter.artifacts.iter().filter(shown) {
            text += &format!("\n### {}\n\n{}", artifact.title, embed(artifact));
        }
        if !chapter.checks.is_empty() {
            text += "\n### Checks\n\n";
            text += &table::markdown(
                &CHECK_COLUMNS[1..],
                check_rows(&chapter.checks).into_iter().map(|row| row[1..].to_vec()),
            );
        }
    }
    if !events.is_empty() {
        text += "\n## Runs that did not complete\n\n";
        text += &table::markdown(&EVENT_COLUMNS, events.iter().cloned());
    }
    text
}

fn embed(artifact: &Artifact) -> String {
    let stem = &artifact.stem;
    match &artifact.content {
        Content::Figure(_) => {
            format!("![{}](figures/{stem}.svg)\n\n[PNG](figures/{stem}.png)\n", artifact.title)
        }
        Content::Table(table) => {
            format!("{}\n[CSV](tables/{stem}.csv)\n", table.markdown())
        }
    }
}
