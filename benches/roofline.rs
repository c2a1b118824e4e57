//! How near each step comes to what the machine can do: CSV on standard output, no verdict.
//!
//! Bandwidth is that of the STREAM triad, arithmetic that of independent four-wide products and sums
//! (`fused` in one instruction, `separate` in two, as the kernels do for the sake of equal bits). Bytes are
//! those of the points' and nodes' arrays that a step must read and write at least once per phase;
//! operations are counted by hand from the plain kernels, all four lanes of a row included.

#[expect(dead_code, reason = "each bench takes a part of it")]
mod generic;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod timing;

use std::hint::black_box;

use fearless_simd::{Level, Simd, dispatch, f64x4, prelude::*};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use plain::Stepper;
use plain::apic_quadratic_2d::Apic2;
use plain::apic_quadratic_3d::Apic3;
use plain::mpm_linear_2d::Mpm2;
use plain::mpm_linear_3d::Mpm3;
use plain::scene::{DT, Layout, scene};
use plain::tpm_linear::Tpm2;
use timing::{in_turns, short, wall_time};

/// What one step of a scheme costs at least, per point.
struct Cost {
    bytes: f64,
    operations: f64,
}

/// What the machine can do: bytes/s, and operations/s without and with fused multiply-add.
struct Machine {
    bandwidth: f64,
    separate: f64,
    fused: f64,
}

/// Largest rate of `work` units of work done by `run`.
fn rate(work: f64, mut run: impl FnMut()) -> f64 {
    let [shortest, _] = in_turns(20, wall_time, &mut run, || ());
    work / shortest
}

/// a = b + s c over 3 arrays of 64 MiB in all; 24 bytes per element as STREAM counts them.
fn triad(n_threads: usize) -> f64 {
    let n = (64 << 20) / 24;
    let (mut a, b, c) = (vec![0.0; n], vec![1.0; n], vec![2.0_f64; n]);
    let chunk = n.div_ceil(n_threads);
    rate(24.0 * n as f64, || {
        let scale = black_box(3.0);
        let parts = a.par_chunks_mut(chunk).zip(b.par_chunks(chunk)).zip(c.par_chunks(chunk));
        parts.for_each(|((a, b), c)| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + scale * c;
            }
        });
        black_box(&mut a);
    })
}

/// Twelve independent chains of x ← x m + d, long enough to hide the latency of either form.
#[expect(clippy::inline_always, reason = "takes the caller's instruction set")]
#[inline(always)]
fn chains<S: Simd>(simd: S, n: u32, fused: bool) -> f64 {
    let mut x = [f64x4::splat(simd, black_box(1.0)); 12];
    let m = f64x4::splat(simd, black_box(0.999));
    let d = f64x4::splat(simd, black_box(1e-3));
    for _ in 0..n {
        for x in &mut x {
            *x = if fused { x.mul_add(m, d) } else { *x * m + d };
        }
    }
    x.iter().map(|x| x.reduce_sum()).sum()
}

fn arithmetic(n_threads: usize, fused: bool) -> f64 {
    let (n, level) = (200_000, Level::new());
    rate(96.0 * f64::from(n) * n_threads as f64, || {
        (0..n_threads).into_par_iter().for_each(|_| {
            black_box(dispatch!(level, simd => chains(simd, n, fused)));
        });
    })
}

/// Bytes of the arrays that a step streams, with `per_cell` points per cell and node.
///
/// Scatter reads each point's state; gather reads its position and writes its state; the grid is
/// written, updated and read once each.
fn bytes(state: usize, per_cell: usize, node: usize) -> f64 {
    3.0 * state as f64 + 4.0 * node as f64 / per_cell as f64
}

fn report<const D: usize>(
    name: &str,
    machine: &Machine,
    n_threads: usize,
    cost: &Cost,
    mut generic: impl Stepper<D>,
    mut plain: impl Stepper<D>,
) {
    let n = generic.points().mass.len() as f64;
    let repetitions = if short() { 10 } else { 40 };
    let times = in_turns(repetitions, wall_time, || generic.step(DT), || plain.step(DT));
    let floor = (cost.bytes / machine.bandwidth).max(cost.operations / machine.separate);
    for (kind, time) in ["generic", "plain"].into_iter().zip(times) {
        let per_point = time / n;
        println!(
            "{name},{kind},{n_threads},{n},{:.2},{:.0},{:.0},{:.3},{:.3},{:.3}",
            1e9 * per_point,
            cost.bytes,
            cost.operations,
            cost.bytes / machine.bandwidth / per_point,
            cost.operations / machine.separate / per_point,
            floor / per_point,
        );
    }
}

fn steps(machine: &Machine, n_threads: usize) {
    let n_points = if short() { 30_000 } else { 1_000_000 };
    let square = scene::<2>(n_points, Layout::Jittered);
    let cube = scene::<3>(n_points, Layout::Jittered);
    // Rows: 3 axes × 17. Scatter: 9 lines × 36 + 27 nodes × 16 + set-up 60. Gather: 27 × 16, 9 × 26, 3 × 36.
    let cost = Cost { bytes: bytes(136, 8, 32), operations: 2.0 * 51.0 + 816.0 + 774.0 + 60.0 };
    let plain = Apic3::<f64>::new(&cube);
    report("apic-3d-f64", machine, n_threads, &cost, generic::apic::<f64, 3>(&cube), plain);
    // Rows: 3 × 2. Scatter: 4 lines × 7 + 8 nodes × 16 + 15. Gather: 8 × 16, 4 × 22, update 16.
    let cost = Cost { bytes: bytes(64, 8, 64), operations: 12.0 + 171.0 + 232.0 };
    let plain = Mpm3::<f64>::new(&cube);
    report("mpm-3d-f64", machine, n_threads, &cost, generic::mpm::<f64, 3>(&cube), plain);
    // Rows: 2 × 17. Scatter: 3 lines × 16 + 9 nodes × 16 + set-up 50. Gather: 9 × 10, 3 × 22, update 20.
    let cost = Cost { bytes: bytes(80, 4, 32), operations: 68.0 + 242.0 + 176.0 };
    let plain = Apic2::<f64>::new(&square);
    report("apic-2d-f64", machine, n_threads, &cost, generic::apic::<f64, 2>(&square), plain);
    // Rows: 2 × 2. Scatter: 2 lines × 5 + 4 nodes × 16 + 12. Gather: 44, update 12.
    let cost = Cost { bytes: bytes(48, 4, 64), operations: 8.0 + 86.0 + 56.0 };
    let plain = Mpm2::<f64>::new(&square);
    report("mpm-2d-f64", machine, n_threads, &cost, generic::mpm::<f64, 2>(&square), plain);
    // Each point is visited by 9 centres (43 operations) and 4 nodes (55); gather as linear MPM.
    let cost = Cost { bytes: bytes(48, 4, 48), operations: 9.0 * 43.0 + 4.0 * 55.0 + 60.0 };
    let plain = Tpm2::<f64>::new(&square);
    report("tpm-2d-f64", machine, n_threads, &cost, generic::tpm(&square), plain);
}

fn main() {
    for n_threads in [1, 2] {
        let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().expect("threads");
        pool.install(|| {
            let machine = Machine {
                bandwidth: triad(n_threads),
                separate: arithmetic(n_threads, false),
                fused: arithmetic(n_threads, true),
            };
            println!("threads,triad GB/s,separate Gflop/s,fused Gflop/s");
            let [bandwidth, separate, fused] =
                [machine.bandwidth, machine.separate, machine.fused].map(|rate| rate / 1e9);
            println!("{n_threads},{bandwidth:.1},{separate:.1},{fused:.1}");
            println!(
                "scheme,kind,threads,points,ns per point and step,bytes,operations,\
                 of bandwidth,of arithmetic,of roofline"
            );
            steps(&machine, n_threads);
        });
    }
}
