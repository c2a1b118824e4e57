use super::*;
use crate::case::Outcome;

#[test]
fn every_ingredient_has_its_own_name_and_every_scene_is_plane() {
    let names: std::collections::BTreeSet<_> =
        INGREDIENTS.iter().map(|ingredient| ingredient.name).collect();
    assert_eq!(names.len(), INGREDIENTS.len());
    for name in SCENES {
        assert!(scene(name).is_some(), "{name}");
    }
}

/// An ingredient that cannot act leaves the error as it is; one that acts does not.
#[test]
fn idle_ingredients_change_nothing_and_others_do() {
    let (_, problem) = scene("taylor-green-inviscid").unwrap();
    let resolution = resolution_of(problem.levels()[0], POINTS);
    let error = |name: &str| {
        let ingredient = INGREDIENTS.iter().find(|other| other.name == name).unwrap();
        let mut runner = runner(problem, &resolution, ingredient).unwrap();
        runner.end *= 0.2;
        let marched = runner.march(problem, &resolution, COURANT, &Progress::silent());
        assert_eq!(marched.outcome, Outcome::Completed, "{name}");
        marched.errors[0]
    };
    let base = error("none");
    for name in ["viscosity", "energy", "single-precision"] {
        assert!((error(name) / base - 1.0).abs() < 1e-3, "{name}: {} {base}", error(name));
    }
    for name in ["carried-fields", "constant-fits", "relaxation", "projection"] {
        assert!((error(name) / base - 1.0).abs() > 1e-2, "{name}: {} {base}", error(name));
    }
}
