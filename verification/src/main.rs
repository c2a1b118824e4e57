//! `verify`: parse, check, then work.

use std::process::ExitCode;

use clap::Parser;
use verification::cli::Arguments;

fn main() -> ExitCode {
    match verification::command::execute(Arguments::parse()) {
        Ok(verdict) => verdict.into(),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
