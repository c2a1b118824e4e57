//! Reports and verdicts from records that were made up, so that every number is known.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use verification::case::{Case, Findings, Outcome, Row, RunSpec, Tier};
use verification::cases::sine_wave::SineWave;
use verification::cli::SelectionArguments;
use verification::convergence::{self, Order};
use verification::judge::{Check, Verdict};
use verification::machine::Manifest;
use verification::plan::Plan;
use verification::progress::Progress;
use verification::record::RunRecord;
use verification::report::table::{Cell, Table};
use verification::report::{self, Area, Artifact, Content, plot};
use verification::run::{self, Execution};

/// A record of a run of the sine wave whose error is `size` h^`order`.
fn record(spec: RunSpec, size: f64, order: f64) -> RunRecord {
    let instant = spec.label("instant").to_owned();
    let value = size * spec.spacing.powf(order);
    let rows = ["point-l2", "gauss-l2"].map(|norm| Row {
        quantity: format!("pressure@{instant}"),
        norm: norm.to_owned(),
        value,
        scale: 5.517,
    });
    RunRecord {
        spec,
        key: String::new(),
        outcome: Outcome::Completed,
        rows: rows.to_vec(),
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::from([("n_point_updates".to_owned(), 1_000_000)]),
        seconds: 0.5,
        manifest: Manifest::gather(1, 1),
    }
}

/// Records of the smoke tier: `tpm` as the paper claims, `tpm-vp` of order 2, all others of order
/// 0.1; the finest jittered run of `tpm-vp` has blown up.
fn records() -> Vec<RunRecord> {
    let of = |spec: RunSpec| match spec.variant.as_str() {
        "tpm" => record(spec, 10.0, 1.0),
        "tpm-vp" => record(spec, 60.0, 2.0),
        _ => record(spec, 0.5, 0.1),
    };
    let mut records: Vec<_> = SineWave.runs(Tier::Smoke).into_iter().map(of).collect();
    for record in &mut records {
        let spec = &record.spec;
        if spec.variant == "tpm-vp" && spec.layout == "jittered" && spec.spacing == 0.004 {
            let reason = "point 3 has a density that is not finite at t = 0.000002 s".to_owned();
            record.outcome = Outcome::BlownUp { step: 4, time: 2e-6, reason };
            for row in &mut record.rows {
                row.value = f64::NAN;
            }
        }
    }
    records
}

fn artifact(stem: &str) -> Content {
    let artifacts = SineWave.artifacts(&records());
    artifacts
        .into_iter()
        .find(|artifact| artifact.stem == stem)
        .unwrap_or_else(|| panic!("no artifact {stem}"))
        .content
}

#[test]
fn convergence_table_in_markdown() {
    let Content::Table(mut table) = artifact("sine_wave_convergence") else {
        panic!("not a table")
    };
    assert!(table.note.contains("stress_update") && table.note.contains("m²/s"));
    // The settings are the library's and may grow.
    table.note.clear();
    insta::assert_snapshot!(table.markdown());
}

#[test]
fn checks_follow_the_orders_and_a_blow_up_fails() {
    let checks = SineWave.checks(&records());
    let rows: Vec<_> = report::check_rows(&checks)
        .into_iter()
        .filter(|row| row[3].starts_with("order") || row[1] == "mpm")
        .map(|row| row.join(","))
        .collect();
    insta::assert_snapshot!(rows.join("\n"));
    assert_eq!(Verdict::of(&checks), Verdict::Fails);
    assert_eq!(Verdict::of(&[]), Verdict::Holds);
}

#[test]
fn a_blow_up_is_a_gap_in_the_curve() {
    let Content::Figure(figure) = artifact("fig09_sine_wave_pressure") else {
        panic!("not a figure")
    };
    let jittered = &figure.panels[1];
    let gap = jittered.curves.iter().find(|curve| curve.label.starts_with("tpm-vp"));
    let gap = gap.expect("a curve of tpm-vp");
    assert_eq!(gap.label, "tpm-vp (–)");
    assert_eq!(gap.points.iter().filter(|point| point.1.is_nan()).count(), 1);
    let svg = plot::svg(&figure).expect("drawn");
    for part in ["tpm (1.00)", "tpm-vp (2.00)", "mpm (0.10)", "cell size h, m", "Pa·m", "0.004"] {
        assert!(svg.contains(part), "{part}");
    }
    assert!(!svg.contains("NaN"));
    assert_eq!(svg, plot::svg(&figure).expect("drawn again"));
}

#[test]
fn checks_of_absent_methods_are_left_out() {
    let mut only_gimp = records();
    only_gimp.retain(|record| record.spec.variant == "gimp");
    let checks = SineWave.checks(&only_gimp);
    assert!(!checks.is_empty());
    assert!(checks.iter().all(|check| check.variant == "gimp"));
}

#[test]
fn markdown_and_csv_of_odd_cells() {
    let table = Table {
        columns: ["name", "value", "order", "count"].map(str::to_owned).to_vec(),
        rows: vec![
            vec![Cell::from("a|b"), Cell::Value(1.234_567e-5), Cell::Order(-0.001), Cell::Count(7)],
            vec![Cell::from("c,d"), Cell::Value(f64::NAN), Cell::Order(1.995), Cell::Count(0)],
        ],
        note: "A note.".to_owned(),
    };
    let csv = String::from_utf8(table.csv().expect("CSV")).expect("UTF-8");
    insta::assert_snapshot!(format!("{}\n{csv}", table.markdown()));
}

/// A case of two runs, of which the second blows up; counts how often it is executed.
struct Fragile;

static EXECUTED: AtomicU64 = AtomicU64::new(0);

impl Case for Fragile {
    fn name(&self) -> &'static str {
        "fragile"
    }
    fn about(&self) -> &'static str {
        "a case for tests"
    }
    fn variants(&self) -> Vec<&'static str> {
        vec!["sound", "fragile"]
    }
    fn levels(&self) -> usize {
        1
    }
    fn policy(&self) -> String {
        String::new()
    }
    fn runs(&self, _tier: Tier) -> Vec<RunSpec> {
        let spec = |variant: &str| RunSpec {
            case: "fragile".to_owned(),
            variant: variant.to_owned(),
            layout: "none".to_owned(),
            labels: BTreeMap::new(),
            level: 0,
            spacing: 1.0,
            parameters: serde_json::Value::Null,
        };
        self.variants().into_iter().map(spec).collect()
    }
    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        EXECUTED.fetch_add(1, Ordering::Relaxed);
        progress.advance(1, 1);
        let blown_up = Outcome::BlownUp { step: 7, time: 0.5, reason: "a, \"reason\"".to_owned() };
        let sound = spec.variant == "sound";
        Findings {
            outcome: if sound { Outcome::Completed } else { blown_up },
            rows: vec![Row {
                quantity: "error".to_owned(),
                norm: "max".to_owned(),
                value: if sound { 0.25 } else { f64::NAN },
                scale: f64::NAN,
            }],
            profiles: Vec::new(),
            rasters: Vec::new(),
            counters: BTreeMap::new(),
            seconds: 0.0,
        }
    }
    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        let check = |record: &RunRecord| Check {
            case: "fragile".to_owned(),
            variant: record.spec.variant.clone(),
            layout: "none".to_owned(),
            check: "error".to_owned(),
            measured: record.rows[0].value,
            lower: None,
            upper: Some(0.25),
            miss: None,
        };
        records.iter().map(check).collect()
    }
    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        convergence::orders(records)
    }
    fn artifacts(&self, _records: &[RunRecord]) -> Vec<Artifact> {
        let table = Table { columns: vec!["a".to_owned()], rows: Vec::new(), note: String::new() };
        vec![Artifact {
            stem: "empty".to_owned(),
            title: "Empty".to_owned(),
            area: Area::Accuracy,
            content: Content::Table(table),
        }]
    }
}

fn plan(out: &Path) -> Plan {
    let selection = SelectionArguments {
        case: Vec::new(),
        variant: Vec::new(),
        tier: Tier::Paper,
        level: None,
        out: out.to_owned(),
    };
    Plan::new(&selection, &[&Fragile]).expect("a plan")
}

#[test]
fn a_run_that_blows_up_is_a_result_on_record() {
    let out = tempfile::tempdir().expect("a folder");
    let plan = plan(out.path());
    let execution = Execution { threads: Some(1), force: false, quiet: true };
    let summary = run::execute(&plan, execution).expect("executed");
    assert_eq!((summary.executed, summary.skipped), (2, 0));
    assert_eq!(
        summary.not_completed,
        ["fragile fragile_none_level0: blew up in step 8: a, \"reason\""]
    );
    let again = run::execute(&plan, execution).expect("executed");
    assert_eq!((again.executed, again.skipped), (0, 2));
    assert_eq!(EXECUTED.load(Ordering::Relaxed), 2);

    let found = plan.find_records().expect("records");
    assert_eq!(found.shortfall(out.path()), None);
    report::write(&plan, &found.records).expect("written");
    let read = |name: &str| std::fs::read_to_string(out.path().join("accuracy").join(name));
    assert_eq!(
        read("events.csv").expect("events"),
        "case,variant,layout,run,event,step,reason\n\
         fragile,fragile,none,fragile_none_level0,blown-up,8,\"a, \"\"reason\"\"\"\n"
    );
    assert_eq!(
        read("checks.csv").expect("checks"),
        "case,variant,layout,check,measured,lower,upper,verdict\n\
         fragile,sound,none,error,0.250000,,0.25,pass\n\
         fragile,fragile,none,error,NaN,,0.25,fail\n"
    );
    assert_eq!(
        read("orders.csv").expect("orders"),
        "case,variant,layout,quantity,norm,order,order_last,levels\n\
         fragile,sound,none,error,max,NaN,NaN,1\n\
         fragile,fragile,none,error,max,NaN,NaN,1\n"
    );
    insta::assert_snapshot!(read("README.md").expect("a page"));
}

#[test]
fn checks_are_closed_intervals_and_refuse_what_is_not_finite() {
    let check = |measured: f64, lower: Option<f64>, upper: Option<f64>| Check {
        case: String::new(),
        variant: String::new(),
        layout: String::new(),
        check: String::new(),
        measured,
        lower,
        upper,
        miss: None,
    };
    assert!(check(1.0, Some(1.0), Some(1.0)).holds());
    assert!(check(-5.0, None, Some(0.3)).holds());
    assert!(!check(1.79, Some(1.8), None).holds());
    assert!(!check(f64::NAN, None, None).holds());
    assert!(!check(f64::INFINITY, Some(0.0), None).holds());
}
