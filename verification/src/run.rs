//! Executes the runs of a plan that are not on record yet.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

use anyhow::{Context, Result, anyhow};
use serde::Serialize;

use crate::case::Outcome;
use crate::machine::{Manifest, available_threads, fingerprint};
use crate::plan::{Plan, Planned};
use crate::progress::{Progress, Reporter};
use crate::record::{RunRecord, Store};

/// How to execute.
#[derive(Clone, Copy, Debug)]
pub struct Execution {
    /// Threads in total; `None`: all that the machine has.
    pub threads: Option<usize>,
    /// Repeat runs that are on record.
    pub force: bool,
    /// No progress.
    pub quiet: bool,
}

/// What was done.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Runs selected.
    pub selected: usize,
    /// Runs executed now.
    pub executed: usize,
    /// Runs found on record.
    pub skipped: usize,
    /// Executed runs that did not complete, with the reason; a result, not an error.
    pub not_completed: Vec<String>,
}

/// Executes what is missing; each record is written as soon as its run has ended.
///
/// Several runs share the machine, one per worker; each has its own pool of threads, so that the
/// time of one run is not mixed with the work of another.
///
/// # Errors
/// When the output cannot be written or a worker stops.
pub fn execute(plan: &Plan, execution: Execution) -> Result<Summary> {
    plan.prepare_out()?;
    let store = plan.store();
    let fingerprint = fingerprint()?;
    let mut pending = Vec::new();
    for planned in &plan.runs {
        let key = planned.spec.key(&fingerprint)?;
        // A record that cannot be read is as good as none.
        let on_record = store.read(&planned.spec).ok().flatten();
        if execution.force || on_record.is_none_or(|record| record.key != key) {
            pending.push((planned, key));
        }
    }
    // The finest first, so that the last worker does not start the longest run.
    pending.sort_by(|a, b| a.0.spec.spacing.total_cmp(&b.0.spec.spacing));

    let reporter = Reporter::new(pending.len(), execution.quiet);
    let threads = execution.threads.unwrap_or_else(available_threads);
    let mut not_completed = work(&pending, threads, &store, &reporter)?;
    not_completed.sort();
    Ok(Summary {
        selected: plan.runs.len(),
        executed: pending.len(),
        skipped: plan.runs.len() - pending.len(),
        not_completed,
    })
}

/// Shares the runs out among workers; returns the runs that did not complete.
fn work(
    pending: &[(&Planned, String)],
    threads: usize,
    store: &Store,
    reporter: &Reporter,
) -> Result<Vec<String>> {
    let workers = threads.min(pending.len()).max(1);
    let threads_per_run = (threads / workers).max(1);
    let manifest = Manifest::gather(workers, threads_per_run);
    let next = AtomicUsize::new(0);
    let stop = AtomicBool::new(false);
    let worker = || -> Result<Vec<String>> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads_per_run)
            .build()
            .context("cannot start threads")?;
        let mut not_completed = Vec::new();
        while !stop.load(Ordering::Relaxed) {
            let Some((planned, key)) = pending.get(next.fetch_add(1, Ordering::Relaxed)) else {
                break;
            };
            let progress = reporter.start(&planned.name());
            let record = pool.install(|| one(planned, key, &manifest, &progress));
            drop(progress);
            let remark = remark(&record);
            reporter.finish(&planned.name(), &remark);
            if record.outcome != Outcome::Completed {
                not_completed.push(format!("{}: {remark}", planned.name()));
            }
            store.write(&record).inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
        }
        Ok(not_completed)
    };
    std::thread::scope(|scope| {
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(worker)).collect();
        let mut all = Vec::new();
        for handle in handles {
            all.extend(handle.join().map_err(|_| anyhow!("a run stopped the program"))??);
        }
        Ok(all)
    })
}

fn one(planned: &Planned, key: &str, manifest: &Manifest, progress: &Progress) -> RunRecord {
    let start = Instant::now();
    let findings = planned.case.execute(&planned.spec, progress);
    let total_seconds = start.elapsed().as_secs_f64();
    RunRecord {
        spec: planned.spec.clone(),
        key: key.to_owned(),
        outcome: findings.outcome,
        rows: findings.rows,
        profiles: findings.profiles,
        rasters: findings.rasters,
        counters: findings.counters,
        seconds: findings.seconds,
        manifest: Manifest { total_seconds, ..manifest.clone() },
    }
}

fn remark(record: &RunRecord) -> String {
    match &record.outcome {
        Outcome::Completed => format!("{:.2} s", record.manifest.total_seconds),
        Outcome::BlownUp { step, reason, .. } => format!("blew up in step {}: {reason}", step + 1),
        Outcome::NotBuilt { reason } => format!("not built: {reason}"),
    }
}
