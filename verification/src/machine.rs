//! Facts about program, compiler and machine, for the manifests of runs.

use std::process::Command;

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

/// Where and with what a run was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// Version of the harness.
    pub version: String,
    /// Commit of the working folder, with `+` if files differ from it; `unknown` without git.
    pub commit: String,
    /// Compiler of the harness.
    pub rustc: String,
    /// CPU model.
    pub cpu: String,
    /// Threads that a run could use.
    pub threads_per_run: usize,
    /// Runs at the same time.
    pub workers: usize,
    /// Command line.
    pub command: String,
    /// Wall time of the run with set-up and measurement, s.
    pub total_seconds: f64,
}

impl Manifest {
    /// The facts that hold for all runs of this process.
    pub fn gather(workers: usize, threads_per_run: usize) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: commit(),
            rustc: env!("VERIFY_RUSTC_VERSION").to_owned(),
            cpu: cpu_model(),
            threads_per_run,
            workers,
            command: command_line(),
            total_seconds: 0.0,
        }
    }
}

/// Hash of the bytes of this executable: a rebuilt solver never reuses old results.
///
/// # Errors
/// When the executable cannot be read.
pub fn fingerprint() -> Result<String> {
    let path = std::env::current_exe().context("cannot find this executable")?;
    let bytes = std::fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(blake3::hash(&bytes).to_hex().to_string())
}

/// Threads that this machine offers.
pub fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

fn command_line() -> String {
    let mut words = std::env::args_os();
    let program = words.next().map(std::path::PathBuf::from);
    let name = program.as_deref().and_then(std::path::Path::file_name).unwrap_or_default();
    let mut line = name.to_string_lossy().into_owned();
    for word in words {
        line.push(' ');
        line.push_str(&word.to_string_lossy());
    }
    line
}

fn commit() -> String {
    let Some(hash) = git(&["rev-parse", "--short=12", "HEAD"]) else {
        return "unknown".to_owned();
    };
    let changed = git(&["status", "--porcelain"]).is_none_or(|text| !text.is_empty());
    if changed { hash + "+" } else { hash }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

fn cpu_model() -> String {
    let facts = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    facts
        .lines()
        .find(|line| line.starts_with("model name"))
        .and_then(|line| line.split_once(':'))
        .map_or_else(|| std::env::consts::ARCH.to_owned(), |(_, name)| name.trim().to_owned())
}
