//! Gate: instructions of one step of each workload, counted by callgrind, against committed baselines.
//!
//! `cargo instructions [--require] [--update] [--variants]`. Each workload runs twice on one thread,
//! with k and with 2k steps; the difference leaves out the set-up. A count off its baseline by more than
//! 2 % fails, in either direction: a gain is a new baseline. What is counted is the baseline instruction
//! set, so that the counts do not depend on the processor; they hold for one compiler, and under others
//! are reported only. Without valgrind nothing is measured; `--require` makes that a failure. `--variants`
//! counts every named method instead, in one and two dimensions, and prints a table; with `--update` it writes
//! `variants.csv`, which the study of speed against error takes in.

#[path = "../generic.rs"]
mod generic;
#[path = "../plain/mod.rs"]
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;

mod baseline;
mod count;
mod variants;
mod workloads;

use std::process::ExitCode;

use baseline::{Baselines, Key};

/// Largest deviation from a baseline.
const TOLERANCE: f64 = 0.02;
/// Steps of the shorter run of a workload.
const STEPS: u32 = 2;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |flag: &str| arguments.iter().any(|argument| argument == flag);
    if let Some(at) = arguments.iter().position(|argument| argument == "--workload") {
        let n_steps = arguments.get(at + 2).and_then(|n| n.parse().ok());
        return match (arguments.get(at + 1), n_steps) {
            (Some(name), Some(n_steps))
                if workloads::run(name, n_steps) || variants::run(name, n_steps) =>
            {
                ExitCode::SUCCESS
            }
            _ => ExitCode::from(2),
        };
    }
    if !count::available() {
        eprintln!("valgrind is not installed: no instruction was counted, nothing is checked");
        return ExitCode::from(u8::from(has("--require")));
    }
    let sound = if has("--variants") {
        key().and_then(|key| variants::report(&key, has("--update"))).map(|()| true)
    } else {
        check(has("--update"))
    };
    match sound {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// What the counts of this build hold for.
fn key() -> Result<Key, String> {
    Ok(Key { toolchain: count::toolchain()?, level: workloads::level() })
}

/// Counts every workload; true if all are within tolerance.
fn check(update: bool) -> Result<bool, String> {
    let key = key()?;
    let mut baselines = Baselines::read()?;
    let mut sound = true;
    println!("{}, {}", key.toolchain, key.level);
    println!(
        "{:20} {:>12} {:>10} {:>12} {:>9}",
        "workload", "per step", "per point", "baseline", "change"
    );
    for name in workloads::NAMES {
        let counted = count::per_step(name, STEPS)?;
        let known = baselines.find(name, &key);
        let change = known.map(|known| counted / known - 1.0);
        println!(
            "{name:20} {counted:12.0} {:10.1} {:>12} {:>9}",
            counted / workloads::n_points(name) as f64,
            known.map_or("none".into(), |known| format!("{known:.0}")),
            change.map_or("-".into(), |change| format!("{:+.2} %", 100.0 * change)),
        );
        if update {
            baselines.set(name, &key, counted);
        } else if change.is_some_and(|change| change.abs() > TOLERANCE) {
            eprintln!("FAILED {name}: instructions changed by more than 2 %");
            sound = false;
        }
    }
    if update {
        baselines.write()?;
        println!("baselines written");
    } else if !baselines.knows(&key) {
        println!("no baselines for this compiler and instruction set: reported only");
    }
    Ok(sound)
}
