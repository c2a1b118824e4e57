//! Every work cited in the code has its entry in `docs/references.md`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Letters, the first a capital, then a year: `Song2020`.
fn is_key(text: &str) -> bool {
    let Some(split) = text.len().checked_sub(4).filter(|&split| text.is_char_boundary(split))
    else {
        return false;
    };
    let (name, year) = text.split_at(split);
    name.starts_with(|first: char| first.is_ascii_uppercase())
        && name.chars().all(|letter| letter.is_ascii_alphabetic())
        && year.chars().all(|digit| digit.is_ascii_digit())
}

/// Keys in brackets, `[Song2020]`, or escaped for rustdoc, `\[Song2020\]`.
fn keys(text: &str) -> impl Iterator<Item = &str> {
    text.split('[')
        .skip(1)
        .filter_map(|rest| rest.split(']').next())
        .map(|inside| inside.trim_end_matches('\\'))
        .filter(|inside| is_key(inside))
}

#[test]
fn keys_are_found_plain_and_escaped() {
    let text = r"Eq. (35) of \[Song2020\], see [`Row`] and [LancasterSalkauskas1981]; a[i] [2020].";
    assert_eq!(keys(text).collect::<Vec<_>>(), ["Song2020", "LancasterSalkauskas1981"]);
}

#[test]
fn every_cited_work_has_an_entry() {
    let references = fs::read_to_string(root().join("docs/references.md")).unwrap();
    let entries: Vec<_> =
        references.lines().filter(|line| line.starts_with("- **[")).flat_map(keys).collect();
    let unique: BTreeSet<_> = entries.iter().copied().collect();
    assert_eq!(entries.len(), unique.len(), "an entry stands twice");

    let mut files = Vec::new();
    for folder in ["src", "verification/src"] {
        rust_files(&root().join(folder), &mut files);
    }
    let mut missing = BTreeSet::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for key in keys(&text).filter(|key| !unique.contains(key)) {
            missing.insert(format!("{key} in {}", file.display()));
        }
    }
    assert!(missing.is_empty(), "not in docs/references.md: {missing:#?}");
}
