//! Every data set loads, and the numbers are those that its sidecar tells.

use std::collections::BTreeSet;
use std::path::Path;

use super::*;

fn greatest(series: &Series, from: f64) -> (f64, f64) {
    let later = series.points.iter().filter(|point| point.0 >= from);
    later.copied().max_by(|a, b| a.1.total_cmp(&b.1)).expect("a point")
}

#[test]
fn every_file_is_declared_and_loads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../reference-data/dam-break");
    let found: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "csv"))
        .filter_map(|path| Some(format!("dam-break/{}", path.file_name()?.to_string_lossy())))
        .collect();
    let declared: BTreeSet<String> = ALL.iter().map(|set| set.path.to_owned()).collect();
    assert_eq!(found, declared);
    for set in ALL {
        let table = set.read().unwrap_or_else(|error| panic!("{error}"));
        assert!(table.rows.len() >= 9, "{}", set.path);
    }
}

#[test]
fn headings_end_in_a_unit() {
    for column in ALL.iter().flat_map(|set| set.columns) {
        let (name, unit) = column.split_once(" [").expect("a unit");
        assert!(!name.is_empty());
        assert!(["-]", "s]", "m]", "m2]", "J/m]"].contains(&unit), "{column}");
    }
}

#[test]
fn a_changed_digit_is_refused() {
    let text = ZHOU.text.replacen("0.028", "0.029", 1);
    assert_ne!(text, ZHOU.text);
    let set = DataSet { text: Box::leak(text.into_boxed_str()), ..ZHOU };
    let error = set.read().expect_err("refused");
    assert_eq!(error.field, "dam-break/zhou1999_p160.csv, SHA-256");
}

#[test]
fn the_measured_pressure_has_the_known_features() {
    let pressure = pressure_160().expect("the data");
    assert_eq!(pressure.points.len(), 86);
    let half = |read: f64| read / 2.0;
    let before = pressure.points.iter().filter(|point| point.0 < half(2.4));
    assert!(before.fold(0.0, |most: f64, point| most.max(point.1.abs())) <= 0.165);
    let (time, second) = greatest(&pressure, half(5.0));
    assert!((half(5.8)..half(5.88)).contains(&time), "{time}");
    assert!((0.86..0.89).contains(&second), "{second}");
}

#[test]
fn fronts_begin_at_the_edge_of_the_column_and_agree() {
    let sets = [front_martin_moyce_1125(), front_martin_moyce_2250(), front_koshizuka_oka()];
    for front in sets.map(|set| set.expect("the data")) {
        // Near T = 1.2 all have been read, and lie within twice the largest uncertainty.
        let near = |point: &&(f64, f64)| (point.0 - 1.2).abs() < 0.06;
        let (_, position) = front.points.iter().find(near).expect("a point near T = 1.2");
        assert!((1.4..1.55).contains(position), "{}: {position}", front.path);
        assert!(front.points.windows(2).all(|pair| pair[0].1 < pair[1].1));
    }
}

#[test]
fn scales_of_both_geometries() {
    // A standing column: T = t √(2g/a).
    let (time, front) = scaled_front(0.292, 0.1, 9.81, 0.146);
    assert!((time - 0.1 * (2.0 * 9.81 / 0.146_f64).sqrt()).abs() < 1e-14);
    assert_eq!(front, 2.0);
    // The lying column of the paper: half of t √(g/h₀).
    let time = scaled_time(1.0, 9.81, 1.2, 0.6);
    assert!((time - 0.5 * (9.81 / 0.6_f64).sqrt()).abs() < 1e-14);
}

#[test]
fn the_volume_of_fluid_run_reads_by_quantity() {
    let fine = VofSpacing::Millimeters10;
    let of = |quantity| vof(fine, quantity).expect("the data");
    assert_eq!(of(VofQuantity::FrontFloor).points[0], (0.0, 1.2));
    assert_eq!(of(VofQuantity::HeightLeft).points[0], (0.0, 0.6));
    assert_eq!(of(VofQuantity::HeightLeft).ordinate, "height_left [m]");
    assert_eq!(of(VofQuantity::EnergyRatio).ordinate, "E/E0 [-]");
    let pressure = of(VofQuantity::Pressure160);
    let first = pressure.points.iter().find(|point| point.1 >= 0.1).expect("an impact");
    assert!((1.38..1.40).contains(&first.0), "{first:?}");
    // T of the file is the formula with g = 9.8 m/s².
    let (time, _) = of(VofQuantity::RunUp).points[200];
    assert!((scaled_time(1.97949, 9.8, 1.2, 0.6) - time).abs() < 1e-4);
}

#[test]
fn outlines_by_instant() {
    for spacing in [VofSpacing::Millimeters20, VofSpacing::Millimeters10] {
        for instant in [1.0, 2.0, 2.4, 2.8, 3.0, 3.4] {
            let lines = outline(spacing, instant).expect("an outline");
            let most = lines.iter().map(Vec::len).max();
            assert_eq!(Some(lines[0].len()), most);
            let inside = |[x, y]: &[f64; 2]| (0.0..=3.22).contains(x) && (0.0..=2.0).contains(y);
            assert!(lines.iter().flatten().all(inside));
        }
    }
    let error = outline(VofSpacing::Millimeters20, 2.5).expect_err("refused").to_string();
    assert_eq!(error, "instant: 2.5 is not allowed; one of [1.0, 2.0, 2.4, 2.8, 3.0, 3.4]");
}
