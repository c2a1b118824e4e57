//! Drives the real binary: what it prints, what it writes and how it exits.

mod common;

use std::path::Path;
use std::process::Output;

use common::{code, stderr, stdout, verify};

fn assert_usage_error(output: &Output, parts: &[&str]) {
    assert_eq!(code(output), 2, "{}", stderr(output));
    for part in parts {
        assert!(stderr(output).contains(part), "no {part:?} in: {}", stderr(output));
    }
    assert!(stdout(output).is_empty());
}

fn is_empty(folder: &Path) -> bool {
    folder.read_dir().expect("a folder").next().is_none()
}

#[test]
fn help_of_every_command() {
    for command in [
        &["--help"][..],
        &["list", "--help"],
        &["run", "--help"],
        &["report", "--help"],
        &["check", "--help"],
        &["work-precision", "--help"],
        &["advise", "--help"],
    ] {
        let output = verify(command);
        assert_eq!(code(&output), 0);
        let name = format!("help_{}", command[0].trim_start_matches('-'));
        insta::assert_snapshot!(name, stdout(&output));
    }
}

#[test]
fn list_as_text_and_as_json() {
    let out = tempfile::tempdir().expect("a folder");
    let folder = out.path().to_str().expect("a name");
    let text = verify(&["list", "--out", folder]);
    assert_eq!(code(&text), 0);
    for part in ["sine-wave: ", "tpm, tpm-vp, mpm", "0 to 4", "tier paper, 0 on record"] {
        assert!(stdout(&text).contains(part), "{}", stdout(&text));
    }
    let json = verify(&["list", "--out", folder, "--format", "json", "--tier", "smoke"]);
    let listing: serde_json::Value = serde_json::from_str(&stdout(&json)).expect("JSON");
    let (cases, variants) = (&listing["cases"], &listing["variants"]);
    assert_eq!(cases[0]["case"], "sine-wave");
    assert_eq!(cases[0]["runs"][0]["on_record"], false);
    assert_eq!(variants[0]["variant"], "tpm");
    assert_eq!(variants[0]["kernel"], "linear");
    let fixes = |name: &str| {
        let mut all = variants.as_array().into_iter().flatten();
        all.find(|variant| variant["variant"] == name).map(|variant| &variant["fixes"])
    };
    assert_eq!(fixes("fmpm2").expect("listed")["projection"]["order"], 2);
    assert!(is_empty(out.path()), "listing writes nothing");
}

#[test]
fn unknown_names_list_the_names_allowed() {
    assert_usage_error(&verify(&["list", "--case", "nope"]), &["`nope`", "sine-wave"]);
    assert_usage_error(&verify(&["--case", "nope"]), &["`nope`", "sine-wave"]);
    let output = verify(&["run", "--variant", "tpmm"]);
    assert_usage_error(&output, &["`tpmm`", "tpm, tpm-vp", "bspline3"]);
    assert_usage_error(&verify(&["run", "--tier", "huge"]), &["smoke", "paper", "full"]);
    assert_usage_error(&verify(&["walk"]), &["walk"]);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let level_nine = ["run", "--case", "sine-wave", "--level", "9"];
    assert_usage_error(&verify(&level_nine), &["level 9", "0 to 4"]);
    assert_usage_error(&verify(&["run", "--level", "-1"]), &["-1"]);
    assert_usage_error(&verify(&["run", "--level", "fine"]), &["fine"]);
    assert_usage_error(&verify(&["run", "--threads", "0"]), &["1..=1024"]);
}

#[test]
fn an_output_that_is_not_a_folder_is_named_and_left_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("file");
    std::fs::write(&file, "kept").expect("a file");
    for out in [file.clone(), file.join("below")] {
        let name = out.to_str().expect("a name");
        for command in ["run", "report", "check"] {
            assert_usage_error(&verify(&[command, "--tier", "smoke", "--out", name]), &[]);
        }
        assert_usage_error(&verify(&["run", "--tier", "smoke", "--out", name]), &[name]);
    }
    assert_eq!(std::fs::read_to_string(&file).expect("the file"), "kept");
    assert_usage_error(&verify(&["run", "--out", "/proc/nowhere"]), &["/proc/nowhere"]);
}

#[test]
fn report_and_check_without_records_say_so_and_write_nothing() {
    let out = tempfile::tempdir().expect("a folder");
    let folder = out.path().to_str().expect("a name");
    for command in ["report", "check"] {
        let output = verify(&[command, "--out", folder]);
        assert_usage_error(&output, &["no records", folder, "verify run"]);
    }
    assert!(is_empty(out.path()));
}

#[test]
fn advice_needs_records_and_an_error_that_can_be_reached() {
    let out = tempfile::tempdir().expect("a folder");
    let folder = out.path().to_str().expect("a name");
    let advise =
        |error: &str| verify(&["advise", "advected-wave", "--error", error, "--out", folder]);
    assert_usage_error(&advise("1%"), &["no measured errors", "verify run"]);
    assert_usage_error(&advise("0"), &["--error", "above 0"]);
    assert_usage_error(&advise("110%"), &["--error", "at most 100%"]);
    assert_usage_error(&advise("small"), &["small", "above 0"]);
    let unknown = verify(&["advise", "nope", "--error", "1%", "--out", folder]);
    assert_usage_error(&unknown, &["`nope`", "advected-wave"]);
    assert!(is_empty(out.path()), "advice writes nothing");
}

/// The whole way of the study on a line of 16 cells: runs, a timing, pages, advice.
#[test]
fn speed_against_error_from_the_command_line() {
    let out = tempfile::tempdir().expect("a folder");
    let folder = out.path().to_str().expect("a name");
    let study =
        ["work-precision", "--case", "advected-wave", "--level", "0", "--quiet", "--out", folder];
    let output = verify(&study);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    for page in [
        "accuracy/work-precision/README.md",
        "accuracy/work-precision/instructions.md",
        "accuracy/work-precision/point_steps.md",
        "accuracy/work-precision/bytes.md",
        "timing/work-precision/README.md",
    ] {
        assert!(out.path().join(page).exists(), "{page}");
    }
    let again = verify(&study);
    assert!(stdout(&again).contains(" runs: 0 executed"), "{}", stdout(&again));
    let advice =
        verify(&["advise", "advected-wave", "--error", "10%", "--format", "json", "--out", folder]);
    assert_eq!(code(&advice), 0, "{}", stderr(&advice));
    let found: serde_json::Value = serde_json::from_str(&stdout(&advice)).expect("JSON");
    let runs = found.as_array().expect("a list");
    assert!(!runs.is_empty());
    assert!(runs.iter().all(|run| run["run"]["error"].as_f64().expect("a number") <= 0.1));
    let out_of_reach = verify(&["advise", "advected-wave", "--error", "1e-9", "--out", folder]);
    assert_eq!(code(&out_of_reach), 1);
    assert!(stdout(&out_of_reach).contains("no run of advected-wave reached"));
}
