//! Gate: the generic step may take at most 1.5 times as long as the plain kernel of the same scheme,
//! and TPM at most 6 times as long as linear MPM.
//!
//! Linear MPM in 2D does not reach 1.5 yet and has limits of its own, a quarter above what was measured when
//! they were set. They are there to be lowered.
//!
//! Both run in turns in one process; the shortest thread CPU time counts. What else the machine does can only
//! lengthen a time, so a row above its limit is measured further, up to `MAX_BATCHES` times as long, before it
//! is judged. Exit code 1 on failure.

#[expect(dead_code, reason = "each bench takes a part of it")]
mod generic;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;
mod timing;

use plain::Stepper;
use plain::apic_quadratic_2d::Apic2;
use plain::apic_quadratic_3d::Apic3;
use plain::mpm_linear_2d::Mpm2;
use plain::mpm_linear_3d::Mpm3;
use plain::scene::{DT, Layout, scene};
use plain::tpm_linear::Tpm2;
use timing::{in_turns, short, thread_time, wall_time};

/// Largest ratio that passes; the target is 1.3. Affine transfers were measured at 1.0 to 1.1, TPM at 1.2.
const LIMIT: f64 = 1.5;
/// Schemes that miss it, with the largest ratio that passes. Linear MPM in 2D: with four nodes per point the generic
/// bookkeeping of a point weighs as much as its sums (measured 1.5 to 1.6; more on a busy machine). In 3D it takes
/// 1.25 times as long.
const PROVISIONAL: [(&str, f64); 2] = [("mpm-2d-f64", 2.0), ("mpm-2d-f64-sorting", 2.0)];

/// Largest ratio of a scheme that passes.
fn limit_of(name: &str) -> f64 {
    PROVISIONAL.iter().find(|(scheme, _)| *scheme == name).map_or(LIMIT, |(_, limit)| *limit)
}
/// Largest cost of TPM in units of linear MPM, both generic, per point and step in 2D.
const TPM_LIMIT: f64 = 6.0;

struct Row {
    name: &'static str,
    generic: f64,
    plain: f64,
    bytes: usize,
}

/// Most batches of repetitions for a row that exceeds its limit. The shortest times of all batches count, for
/// both kernels alike, so that a ratio that is too large stays so however often it is measured.
const MAX_BATCHES: usize = 10;

/// Times one step of each in turns, again while the ratio exceeds its limit.
fn row<const D: usize>(
    name: &'static str,
    n_points: usize,
    mut generic: impl Stepper<D>,
    mut plain: impl Stepper<D>,
) -> Row {
    let batch = if short() { 60 } else { 200 };
    let [mut g, mut p] = [f64::INFINITY; 2];
    let mut repetitions = 0;
    while repetitions == 0 || (g > limit_of(name) * p && repetitions < MAX_BATCHES * batch) {
        let times = in_turns(batch, thread_time, || generic.step(DT), || plain.step(DT));
        (g, p) = (g.min(times[0]), p.min(times[1]));
        repetitions += batch;
    }
    let per_point = 1e9 / n_points as f64;
    let row = Row {
        name,
        generic: g * per_point,
        plain: p * per_point,
        bytes: generic.bytes_per_point(),
    };
    println!(
        "{:24} {:8} {:10.1} {:10.1} {:7.2} {:6} {:6} {:6} {:6}",
        row.name,
        n_points,
        row.generic,
        row.plain,
        row.generic / row.plain,
        row.bytes,
        repetitions,
        generic.n_sorts(),
        plain.n_sorts(),
    );
    row
}

fn rows() -> Vec<Row> {
    let (quiet, sorting) = (Layout::Jittered, Layout::Random);
    let n = 30_000;
    let (square, cube) = (scene::<2>(n, quiet), scene::<3>(n, quiet));
    let (n2, n3) = (square.points.len(), cube.points.len());
    let mut rows = vec![
        row("apic-3d-f64", n3, generic::apic::<f64, 3>(&cube), Apic3::<f64>::new(&cube)),
        row("apic-3d-f32", n3, generic::apic::<f32, 3>(&cube), Apic3::<f32>::new(&cube)),
        row("apic-2d-f64", n2, generic::apic::<f64, 2>(&square), Apic2::<f64>::new(&square)),
        row("apic-2d-f32", n2, generic::apic::<f32, 2>(&square), Apic2::<f32>::new(&square)),
        row("mpm-3d-f64", n3, generic::mpm::<f64, 3>(&cube), Mpm3::<f64>::new(&cube)),
        row("mpm-2d-f64", n2, generic::mpm::<f64, 2>(&square), Mpm2::<f64>::new(&square)),
        row("tpm-2d-f64", n2, generic::tpm(&square), Tpm2::<f64>::new(&square)),
    ];
    let (square, cube) = (scene::<2>(n, sorting), scene::<3>(n, sorting));
    rows.extend([
        row("apic-3d-f64-sorting", n3, generic::apic::<f64, 3>(&cube), Apic3::<f64>::new(&cube)),
        row("mpm-2d-f64-sorting", n2, generic::mpm::<f64, 2>(&square), Mpm2::<f64>::new(&square)),
    ]);
    rows
}

/// Speed-up of the generic 3D APIC step on two threads, by the wall clock: reported only.
fn report_threads() {
    if std::thread::available_parallelism().map_or(1, usize::from) < 2 {
        println!("two threads: not measured, one processor only");
        return;
    }
    let scene = scene::<3>(100_000, Layout::Jittered);
    let time = |n_threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().expect("threads");
        pool.install(|| {
            let mut generic = generic::apic::<f64, 3>(&scene);
            let mut plain = Apic3::<f64>::new(&scene);
            in_turns(15, wall_time, || generic.step(DT), || plain.step(DT))
        })
    };
    let (one, two) = (time(1), time(2));
    println!(
        "two threads, apic-3d-f64, wall: generic {:.2} times as fast as one, plain {:.2}",
        one[0] / two[0],
        one[1] / two[1]
    );
}

fn main() {
    println!(
        "ns per point and step on one thread (shortest), bytes per point, steps of each, sorts"
    );
    println!(
        "{:24} {:>8} {:>10} {:>10} {:>7} {:>6} {:>6} {:>13}",
        "scheme", "points", "generic", "plain", "ratio", "bytes", "steps", "sorts (g, p)"
    );
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let rows = pool.install(rows);
    report_threads();
    let mut failures: Vec<String> = rows
        .iter()
        .map(|row| (row.name, row.generic / row.plain, limit_of(row.name)))
        .filter(|(_, ratio, limit)| ratio > limit)
        .map(|(name, ratio, limit)| format!("{name}: ratio {ratio:.2} exceeds {limit}"))
        .collect();
    let of = |name| rows.iter().find(|row| row.name == name).map_or(f64::NAN, |row| row.generic);
    let tpm = of("tpm-2d-f64") / of("mpm-2d-f64");
    println!("tpm-2d-f64 costs {tpm:.2} times mpm-2d-f64 (generic; at most {TPM_LIMIT})");
    if tpm > TPM_LIMIT {
        failures.push(format!("tpm-2d-f64: {tpm:.2} times mpm-2d-f64 exceeds {TPM_LIMIT}"));
    }
    for failure in &failures {
        eprintln!("FAILED {failure}");
    }
    std::process::exit(i32::from(!failures.is_empty()));
}
