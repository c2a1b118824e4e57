//! `verify`: parse, check, then work.

use std::process::ExitCode;

use clap::Parser;
use verification::cli::Arguments;
use verification::progress::say;

fn main() -> ExitCode {
    match verification::command::execute(Arguments::parse()) {
        Ok(verdict) => verdict.into(),
        Err(error) => {
            say(&format!("error: {error:#}"));
            ExitCode::from(2)
        }
    }
}
