//! The request, resolved: which runs of which cases, and where their records are.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::case::{Case, RunSpec, Tier};
use crate::cli::SelectionArguments;
use crate::record::{RunRecord, Store};

/// One run to make or to read.
#[derive(Clone)]
pub struct Planned {
    /// The case that knows how.
    pub case: &'static dyn Case,
    /// What exactly.
    pub spec: RunSpec,
}

impl Planned {
    /// Name for messages.
    pub fn name(&self) -> String {
        format!("{} {}", self.spec.case, self.spec.slug())
    }
}

/// A resolved selection.
#[derive(Clone)]
pub struct Plan {
    /// Cases selected, in the order of the registry.
    pub cases: Vec<&'static dyn Case>,
    /// Runs selected, in the order in which the cases list them.
    pub runs: Vec<Planned>,
    /// Tier.
    pub tier: Tier,
    /// Output folder.
    pub out: PathBuf,
}

/// Records found for a plan.
#[derive(Debug, Default)]
pub struct Found {
    /// In the order of the plan.
    pub records: Vec<RunRecord>,
    /// Names of runs without a record, or whose record is of other parameters.
    pub missing: Vec<String>,
}

impl Plan {
    /// Resolves a selection against a registry of cases.
    ///
    /// # Errors
    /// When a name or level does not exist (the message lists what does), nothing is selected, or
    /// the output folder is something else.
    pub fn new(selection: &SelectionArguments, registry: &[&'static dyn Case]) -> Result<Self> {
        let cases = select_cases(&selection.case, registry)?;
        check_variants(&selection.variant, &cases)?;
        if let Some(level) = selection.level {
            let levels = cases.iter().map(|case| case.levels()).max().unwrap_or(0);
            if level >= levels {
                let last = levels.saturating_sub(1);
                bail!("unknown level {level}; allowed: 0 to {last}");
            }
        }
        let wanted = |spec: &RunSpec| {
            (selection.variant.is_empty() || selection.variant.contains(&spec.variant))
                && selection.level.is_none_or(|level| spec.level == level)
        };
        let runs: Vec<Planned> = cases
            .iter()
            .flat_map(|&case| {
                case.runs(selection.tier).into_iter().map(move |spec| Planned { case, spec })
            })
            .filter(|planned| wanted(&planned.spec))
            .collect();
        if runs.is_empty() {
            bail!("no run of tier {} matches the selection", selection.tier.name());
        }
        if selection.out.exists() && !selection.out.is_dir() {
            bail!("--out {}: not a folder", selection.out.display());
        }
        Ok(Self { cases, runs, tier: selection.tier, out: selection.out.clone() })
    }

    /// Where records are kept.
    pub fn store(&self) -> Store {
        Store::new(&self.out)
    }

    /// Reads every record of the plan.
    ///
    /// # Errors
    /// When a file cannot be read or is not a record, or when there is none at all.
    pub fn find_records(&self) -> Result<Found> {
        let store = self.store();
        let mut found = Found::default();
        for planned in &self.runs {
            match store.read(&planned.spec)? {
                Some(record) if record.spec == planned.spec => found.records.push(record),
                _ => found.missing.push(planned.name()),
            }
        }
        if found.records.is_empty() {
            bail!(
                "no records of these runs in {}; make them with `verify run`",
                self.out.display()
            );
        }
        Ok(found)
    }

    /// Makes sure that the output folder exists and can be written.
    ///
    /// # Errors
    /// When not; names it.
    pub fn prepare_out(&self) -> Result<()> {
        let name = || format!("--out {}: cannot be written", self.out.display());
        std::fs::create_dir_all(&self.out).with_context(name)?;
        tempfile::Builder::new().prefix(".tmp-").tempfile_in(&self.out).with_context(name)?;
        Ok(())
    }
}

impl Found {
    /// A sentence on the missing records, with the first few; `None` if none is missing.
    pub fn shortfall(&self, out: &Path) -> Option<String> {
        let total = self.records.len() + self.missing.len();
        let first: Vec<_> = self.missing.iter().take(5).map(String::as_str).collect();
        let more = if self.missing.len() > first.len() { ", …" } else { "" };
        (!self.missing.is_empty()).then(|| {
            format!(
                "{} of {total} records are missing in {} ({}{more}); make them with `verify run`",
                self.missing.len(),
                out.display(),
                first.join(", "),
            )
        })
    }
}

fn select_cases(
    names: &[String],
    registry: &[&'static dyn Case],
) -> Result<Vec<&'static dyn Case>> {
    for name in names {
        if !registry.iter().any(|case| case.name() == name) {
            let allowed: Vec<_> = registry.iter().map(|case| case.name()).collect();
            bail!("unknown case `{name}`; allowed: {}", allowed.join(", "));
        }
    }
    let wanted = |case: &dyn Case| names.is_empty() || names.iter().any(|name| name == case.name());
    Ok(registry.iter().copied().filter(|&case| wanted(case)).collect())
}

fn check_variants(names: &[String], cases: &[&'static dyn Case]) -> Result<()> {
    let mut allowed: Vec<&str> = Vec::new();
    for name in cases.iter().flat_map(|case| case.variants()) {
        if !allowed.contains(&name) {
            allowed.push(name);
        }
    }
    for name in names {
        if !allowed.contains(&name.as_str()) {
            bail!("unknown variant `{name}`; allowed: {}", allowed.join(", "));
        }
    }
    Ok(())
}
