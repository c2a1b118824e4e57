//! Helpers of the integration tests.
#![allow(dead_code, reason = "each test binary uses its own share")]

use std::path::Path;
use std::process::{Command, Output};

/// Runs the binary with these arguments, without a terminal.
pub fn verify(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .env_remove("CLICOLOR_FORCE")
        .output()
        .expect("the binary starts")
}

/// Runs a command of the binary on a selection with an output folder.
pub fn verify_in(out: &Path, command: &str, selection: &[&str]) -> Output {
    let out = out.to_str().expect("a name in Unicode");
    verify(&[&[command, "--out", out, "--tier", "smoke"], selection].concat())
}

/// Exit code.
pub fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error as text.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
