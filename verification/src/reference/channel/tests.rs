//! Every data set loads, and the numbers are those that its sidecar tells.

use std::collections::BTreeSet;
use std::path::Path;

use super::*;

const FILMS: [VofFilm; 5] = [
    VofFilm::FullNoSlip,
    VofFilm::FullNoSlipFine,
    VofFilm::FullSlip,
    VofFilm::HalfNoSlip,
    VofFilm::FullSlipWeightless,
];

fn front(film: VofFilm, instant: f64) -> f64 {
    let line = outline(film, instant).expect("an outline");
    line.iter().map(|place| place[0]).fold(0.0, f64::max)
}

#[test]
fn every_file_is_declared_and_loads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../reference-data/channel");
    let found: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "csv"))
        .filter_map(|path| Some(format!("channel/{}", path.file_name()?.to_string_lossy())))
        .collect();
    let declared: BTreeSet<String> = ALL.iter().map(|set| set.path.to_owned()).collect();
    assert_eq!(found, declared);
    for set in ALL {
        let table = set.read().unwrap_or_else(|error| panic!("{error}"));
        assert!(table.rows.len() >= 100, "{}", set.path);
    }
}

#[test]
fn headings_end_in_a_unit() {
    for column in ALL.iter().flat_map(|set| set.columns) {
        let (name, unit) = column.split_once(" [").expect("a unit");
        assert!(!name.is_empty());
        assert!(["-]", "s]", "m]", "kg/m]", "J/m]"].contains(&unit), "{column}");
    }
}

#[test]
fn a_changed_digit_is_refused() {
    let set = VofFilm::FullNoSlip.data_set();
    let text = set.text.replacen("0.009510", "0.009511", 1);
    assert_ne!(text, set.text);
    let set = DataSet { text: Box::leak(text.into_boxed_str()), ..set };
    let error = set.read().expect_err("refused");
    assert_eq!(error.field, "channel/vof_re500_full_g98_ns_0p25mm_outline.csv, SHA-256");
}

#[test]
fn the_mass_let_in_is_the_flux_of_the_inlet() {
    for spacing in [VofSpacing::Millimeters10, VofSpacing::Millimeters5] {
        let entered = total(spacing, VofTotal::MassIn).expect("the data");
        assert!(entered.points.iter().all(|&(t, mass)| (mass - 40.0 * t).abs() < 0.002 * mass));
        let mass = total(spacing, VofTotal::Mass).expect("the data");
        for (instant, expected) in [(2.0, 67.0), (3.0, 78.0), (4.0, 83.0)] {
            let near = mass.points.iter().find(|point| point.0 > instant - 0.012);
            let found = near.expect("an instant").1;
            assert!((found - expected).abs() < 1.0, "{found} {expected}");
        }
        let energy = total(spacing, VofTotal::PotentialEnergy).expect("the data");
        assert_eq!(energy.ordinate, "potential_energy [J/m]");
        assert!((17.0..19.0).contains(&energy.points.last().expect("a value").1));
    }
}

#[test]
fn columns_of_water_hold_the_mass() {
    for (spacing, width) in [(VofSpacing::Millimeters10, 0.01), (VofSpacing::Millimeters5, 0.005)] {
        let columns = surface(spacing, 2.0).expect("columns");
        assert!(columns.windows(2).all(|pair| pair[0].x < pair[1].x));
        let mass: f64 = columns.iter().map(|column| 1000.0 * width * column.depth).sum();
        assert!((mass - 67.3).abs() < 0.5, "{mass}");
    }
    let error = surface(VofSpacing::Millimeters10, 2.5).expect_err("refused").to_string();
    assert_eq!(error, "instant: 2.5 is not allowed; one of [0.5, 1.0, 1.5, 2.0, 3.0, 4.0]");
}

#[test]
fn outlines_run_from_the_front_to_the_inlet() {
    for film in FILMS {
        for instant in [0.05, 0.1, 0.17] {
            let line = outline(film, instant).expect("an outline");
            let (first, last) = (line[0], line[line.len() - 1]);
            assert!(first[1] <= 0.0003 && last[1] > 0.004, "{film:?} {instant}");
            let inside = |[x, y]: &[f64; 2]| (0.0..=0.06).contains(x) && (0.0..=0.01).contains(y);
            assert!(line.iter().all(inside));
        }
    }
    for (instant, coarse, fine) in
        [(0.05, 9.51e-3, 9.69e-3), (0.1, 28.0e-3, 28.5e-3), (0.17, 49.8e-3, 49.7e-3)]
    {
        assert!((front(VofFilm::FullNoSlip, instant) - coarse).abs() < 1e-4);
        assert!((front(VofFilm::FullNoSlipFine, instant) - fine).abs() < 1e-4);
    }
    // Without gravity the front is a plane that moves with the inlet.
    assert!((front(VofFilm::FullSlipWeightless, 0.17) - 8.5e-3).abs() < 1e-5);
}
