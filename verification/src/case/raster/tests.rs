//! Codes of fields and classes, and the way to the record and back.

use std::collections::BTreeMap;

use super::*;
use crate::case::{Outcome, RunSpec};
use crate::machine::Manifest;
use crate::record::RunRecord;

const GRID: ([usize; 2], [f64; 2], [f64; 2]) = ([3, 2], [0.5, -1.0], [0.1, 0.2]);

fn field(values: &[Option<f64>]) -> Result<Raster, InvalidInput> {
    let (cells, origin, spacing) = GRID;
    Raster::field("pressure", cells, origin, spacing, [0.0, 253.0], values)
}

#[test]
fn codes_of_a_field() {
    let values = [Some(-1e-9), Some(0.0), Some(252.0), Some(253.0), Some(1e300), Some(f64::NAN)];
    let raster = field(&values).expect("a raster");
    assert_eq!(raster.values, [1, 2, 254, 255, 255, 0]);
    assert_eq!(field(&[None; 6]).expect("a raster").values, [0; 6]);
    assert_eq!(raster.extent(), [3.0 * 0.1, 2.0 * 0.2]);
}

#[test]
fn what_does_not_fit_is_refused() {
    let error = field(&[None; 5]).expect_err("refused").to_string();
    assert_eq!(error, "raster pressure, values: 5 is not allowed; 6, one for each cell");
    let (cells, origin, spacing) = GRID;
    let build = |cells, spacing, bounds| {
        Raster::field("p", cells, origin, spacing, bounds, &[None; 6]).expect_err("refused").field
    };
    assert_eq!(build([0, 2], spacing, [0.0, 1.0]), "raster p, columns");
    assert_eq!(build([3, usize::MAX], spacing, [0.0, 1.0]), "raster p, rows");
    assert_eq!(build(cells, [0.1, 0.0], [0.0, 1.0]), "raster p, spacing");
    assert_eq!(build(cells, spacing, [1.0, 1.0]), "raster p, upper");
    assert_eq!(build(cells, spacing, [f64::NAN, 1.0]), "raster p, upper");
    let classes = [Some(0), Some(2), None, None, None, None];
    let error = Raster::classes("kind", cells, origin, spacing, 2, &classes).expect_err("refused");
    assert_eq!(error.to_string(), "raster kind, class: 2 is not allowed; below 2");
}

#[test]
fn a_record_holds_the_same_bytes_in_little_room() {
    let cells = [161, 75];
    let value = |i: usize| (i % 161 < 60).then_some(f64::from(u16::try_from(i).expect("small")));
    let values: Vec<_> = (0..161 * 75).map(value).collect();
    let bounds = [100.0, 12_000.0];
    let raster = Raster::field("p", cells, [0.0; 2], [0.02; 2], bounds, &values).expect("fits");
    let json = serde_json::to_string(&raster).expect("written");
    assert!(json.len() < 2000, "{}", json.len());
    assert_eq!(serde_json::from_str::<Raster>(&json).expect("read"), raster);
}

#[test]
fn classes_keep_their_number() {
    let (cells, origin, spacing) = GRID;
    let classes = [Some(0), Some(1), None, Some(2), Some(1), Some(0)];
    let raster = Raster::classes("kind", cells, origin, spacing, 3, &classes).expect("fits");
    assert_eq!(raster.values, [1, 2, 0, 3, 2, 1]);
    assert_eq!((raster.lower, raster.upper), (0.0, 3.0));
    let json = serde_json::to_string(&raster).expect("written");
    assert_eq!(serde_json::from_str::<Raster>(&json).expect("read"), raster);
}

#[test]
fn a_damaged_record_is_refused() {
    let json = serde_json::to_string(&field(&[Some(1.0); 6]).expect("fits")).expect("written");
    for damaged in [
        json.replace("\"rows\":2", "\"rows\":3"),
        json.replace("\"rows\":2", "\"rows\":1"),
        json.replace("\"rows\":2", "\"rows\":18446744073709551615"),
        json.replace("\"values\":\"", "\"values\":\"!"),
        json.replace("\"values\":\"", "\"values\":\"AAAA"),
        json.replace("\"name\"", "\"other\":1,\"name\""),
    ] {
        assert_ne!(damaged, json);
        assert!(serde_json::from_str::<Raster>(&damaged).is_err(), "{damaged}");
    }
}

#[test]
fn a_run_record_carries_rasters_and_says_nothing_without() {
    let spec = RunSpec {
        case: "made-up".to_owned(),
        variant: "tpm".to_owned(),
        layout: "regular".to_owned(),
        labels: BTreeMap::new(),
        level: 0,
        spacing: 0.1,
        parameters: serde_json::Value::Null,
    };
    let mut record = RunRecord {
        spec,
        key: String::new(),
        outcome: Outcome::Completed,
        rows: Vec::new(),
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: 0.5,
        manifest: Manifest::gather(1, 1),
    };
    let json = serde_json::to_string(&record).expect("written");
    assert!(!json.contains("rasters"));
    assert_eq!(serde_json::from_str::<RunRecord>(&json).expect("read"), record);
    record.rasters.push(field(&[Some(1.0); 6]).expect("fits"));
    let json = serde_json::to_string(&record).expect("written");
    let read: RunRecord = serde_json::from_str(&json).expect("read");
    assert_eq!(read, record);
    assert_eq!(read.raster("pressure"), Some(&record.rasters[0]));
    assert_eq!(read.raster("density"), None);
}
