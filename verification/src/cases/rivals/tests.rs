//! Every variant stands in the matrix; goals and scenes agree.

use super::*;

#[test]
fn every_variant_has_a_run_on_every_scene() {
    let runs = Rivals.runs(Tier::Paper);
    for variant in Variant::ALL {
        for scene in &SCENES {
            let of = |run: &&RunSpec| run.variant == variant.name() && run.layout == scene.name;
            assert_eq!(runs.iter().filter(of).count(), scene.levels, "{}", variant.name());
        }
    }
}

#[test]
fn no_record_gives_no_check() {
    assert!(Rivals.checks(&[]).is_empty());
}

#[test]
fn what_a_variant_fixes_is_listed() {
    assert_eq!(results::fixed(Variant::Mpm), "");
    assert_eq!(results::fixed(Variant::MpmUsf), "stress_update = \"first\"");
    assert!(results::fixed(Variant::Fmpm4).contains("projection"));
}
