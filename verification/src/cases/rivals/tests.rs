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
    let names =
        |variant| fixed(variant).into_iter().map(|(name, _)| name).collect::<Vec<_>>().join(" ");
    assert_eq!(names(Variant::Mpm), "");
    assert_eq!(names(Variant::MpmUsf), "stress_update");
    assert_eq!(names(Variant::Fmpm4), "projection");
}

#[test]
fn every_variant_has_a_page_that_the_index_links() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/methods");
    let index = std::fs::read_to_string(folder.join("README.md")).unwrap();
    for name in Variant::ALL.map(Variant::name) {
        let page = std::fs::read_to_string(folder.join(format!("{name}.md"))).unwrap();
        assert!(page.starts_with(&format!("# {name}\n")), "{name}");
        assert!(index.contains(&format!("({name}.md)")), "{name}");
    }
}
