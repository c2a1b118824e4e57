//! Real runs of the smallest size: records, skipping, verdicts, and the same bytes every time.

mod common;

use std::collections::BTreeMap;
use std::path::Path;

use common::{code, stderr, stdout, verify_in};

const SMALL: &[&str] = &["--case", "sine-wave", "--variant", "gimp", "--level", "0"];

/// Every file below a folder with its bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in next.read_dir().expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("below").display().to_string();
                found.insert(name, std::fs::read(&path).expect("a file"));
            }
        }
    }
    found
}

fn run_summary(out: &Path, options: &[&str]) -> (u64, u64) {
    let options = [SMALL, &["--quiet", "--format", "json"], options].concat();
    let output = verify_in(out, "run", &options);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).is_empty(), "quiet means quiet: {}", stderr(&output));
    let summary: serde_json::Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    (summary["executed"].as_u64().expect("a count"), summary["skipped"].as_u64().expect("a count"))
}

#[test]
fn finished_runs_are_skipped_unless_forced_or_damaged() {
    let out = tempfile::tempdir().expect("a folder");
    let (n, skipped) = run_summary(out.path(), &[]);
    assert!(n >= 4 && skipped == 0);
    assert_eq!(run_summary(out.path(), &[]), (0, n));
    assert_eq!(run_summary(out.path(), &["--force"]), (n, 0));

    let runs = out.path().join("runs").join("sine-wave");
    let record = runs.join("gimp_regular_x_2d_5us_convergence_level0.json");
    assert!(record.with_extension("csv").exists());
    std::fs::write(&record, "{ \"spec\"").expect("a file");
    let output = verify_in(out.path(), "check", SMALL);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("gimp_regular_x_2d_5us_convergence_level0.json"));
    assert_eq!(run_summary(out.path(), &[]), (1, n - 1));
}

#[test]
fn a_record_names_its_origin() {
    let out = tempfile::tempdir().expect("a folder");
    run_summary(out.path(), &[]);
    let path = out.path().join("runs/sine-wave/gimp_jittered_x_2d_5us_convergence_level0.json");
    let text = std::fs::read_to_string(path).expect("a record");
    let record: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(record["outcome"]["status"], "completed");
    assert_eq!(record["counters"]["n_steps"], 10);
    for fact in ["version", "commit", "rustc", "cpu", "command"] {
        assert!(record["manifest"][fact].as_str().is_some_and(|text| !text.is_empty()), "{fact}");
    }
    assert!(record["manifest"]["rustc"].as_str().expect("text").starts_with("rustc "));
}

#[test]
fn missing_records_are_named_and_not_judged() {
    let out = tempfile::tempdir().expect("a folder");
    run_summary(out.path(), &[]);
    let output = verify_in(out.path(), "check", &["--variant", "gimp"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("records are missing"), "{}", stderr(&output));
    let output = verify_in(out.path(), "report", &["--variant", "gimp"]);
    assert_eq!(code(&output), 0);
    assert!(stderr(&output).contains("records are missing"), "{}", stderr(&output));
}

#[test]
fn checks_that_hold_exit_0_and_a_failed_one_exits_1() {
    let out = tempfile::tempdir().expect("a folder");
    run_summary(out.path(), &[]);
    let output = verify_in(out.path(), "check", &[SMALL, &["--format", "json"]].concat());
    assert_eq!(code(&output), 0, "{}", stdout(&output));
    let checks: serde_json::Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    assert_eq!(checks[0]["verdict"], "pass");

    // One level has no order of convergence, so the checks of linear MPM must fail.
    let one_level = ["--case", "sine-wave", "--variant", "mpm", "--level", "0"];
    assert_eq!(code(&verify_in(out.path(), "run", &one_level)), 0);
    let output = verify_in(out.path(), "check", &one_level);
    assert_eq!(code(&output), 1, "{}", stdout(&output));
    assert!(stdout(&output).contains("fail"));
}

#[test]
fn the_report_is_a_function_of_the_records_and_not_of_threads() {
    let out = tempfile::tempdir().expect("a folder");
    run_summary(out.path(), &["--threads", "1"]);
    assert_eq!(code(&verify_in(out.path(), "report", SMALL)), 0);
    let accuracy = out.path().join("accuracy");
    let first = files(&accuracy);
    for name in [
        "README.md",
        "checks.csv",
        "orders.csv",
        "events.csv",
        "errors/sine-wave.csv",
        "figures/fig09_sine_wave_pressure.svg",
        "figures/fig09_sine_wave_pressure.png",
        "tables/sine_wave_convergence.csv",
        "tables/sine_wave_convergence.md",
    ] {
        assert!(first.contains_key(name), "{name} is missing");
    }
    assert!(out.path().join("timing/runs.csv").exists());

    std::fs::remove_dir_all(&accuracy).expect("removed");
    run_summary(out.path(), &["--force", "--threads", "3"]);
    assert_eq!(code(&verify_in(out.path(), "report", SMALL)), 0);
    assert_eq!(files(&accuracy), first);
}

#[test]
fn headers_that_others_rely_on() {
    let out = tempfile::tempdir().expect("a folder");
    run_summary(out.path(), &[]);
    assert_eq!(code(&verify_in(out.path(), "report", SMALL)), 0);
    for (name, header) in [
        ("checks.csv", "case,variant,layout,check,measured,lower,upper,verdict"),
        ("orders.csv", "case,variant,layout,quantity,norm,order,order_last,levels"),
    ] {
        let text = std::fs::read_to_string(out.path().join("accuracy").join(name)).expect("CSV");
        assert_eq!(text.lines().next(), Some(header));
    }
}

/// On some cases only: tests are compiled with few optimizations, and continuous integration runs the whole tier with
/// the command that users have.
#[test]
fn the_bare_command_runs_reports_and_checks() {
    let out = tempfile::tempdir().expect("a folder");
    let folder = out.path().to_str().expect("a name in Unicode");
    let cases = ["--case", "sine-wave", "--case", "poiseuille", "--case", "loaded-column"];
    let command = ["--tier", "smoke", "--out", folder, "--quiet"];
    let output = common::verify(&[&command[..], &cases].concat());
    assert_eq!(code(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(stdout(&output).contains(" 0 failed"), "{}", stdout(&output));
    let page = std::fs::read_to_string(out.path().join("accuracy/README.md")).expect("a page");
    for part in ["fig09_sine_wave_pressure.svg", "sine_wave_convergence.csv", "| pass |"] {
        assert!(page.contains(part), "{part}");
    }
}
