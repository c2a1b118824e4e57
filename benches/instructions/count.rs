//! Counting instructions with callgrind.

use std::process::{Command, Stdio};

/// Whether valgrind can be run.
pub fn available() -> bool {
    let version = Command::new("valgrind").arg("--version").stdout(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// The compiler, as `rustc 1.2.3 (hash date)`.
pub fn toolchain() -> Result<String, String> {
    let rustc = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    let output = Command::new(&rustc).arg("--version").output();
    let output = output.map_err(|error| format!("{rustc}: {error}"))?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Instructions of one step of a workload, from a run of `n_steps` and one of twice as many.
pub fn per_step(workload: &str, n_steps: u32) -> Result<f64, String> {
    let few = instructions(workload, n_steps)?;
    let many = instructions(workload, 2 * n_steps)?;
    Ok((many - few) / f64::from(n_steps))
}

fn instructions(workload: &str, n_steps: u32) -> Result<f64, String> {
    let this = std::env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(this)
        .args(["--workload", workload, &n_steps.to_string()])
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .map_err(|error| format!("valgrind: {error}"))?;
    let report = String::from_utf8_lossy(&output.stderr);
    let count = report
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .and_then(|(_, count)| count.trim().parse().ok());
    count.filter(|_| output.status.success()).ok_or_else(|| format!("{workload}: {report}"))
}
