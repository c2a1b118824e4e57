//! Whole steps: generic beside plain, 2D and 3D, `f32` and `f64`, one and two threads, 10⁵ and 10⁶ points.
//!
//! `TRANSPOINT_BENCH=short` takes 3·10⁴ points and short samples.

#[expect(dead_code, reason = "each bench takes a part of it")]
mod generic;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod timing;

use std::time::{Duration, Instant};

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rayon::{ThreadPool, ThreadPoolBuilder};

use plain::Stepper;
use plain::apic_quadratic_2d::Apic2;
use plain::apic_quadratic_3d::Apic3;
use plain::mpm_linear_2d::Mpm2;
use plain::mpm_linear_3d::Mpm3;
use plain::scene::{DT, Layout, scene};
use plain::tpm_linear::Tpm2;

/// One row of the table: which scheme, how many points, on which threads.
struct Bench<'a> {
    criterion: &'a mut Criterion,
    n_points: usize,
    pool: &'a ThreadPool,
}

impl Bench<'_> {
    /// Times a step of each.
    fn run<const D: usize>(
        &mut self,
        name: &str,
        mut generic: impl Stepper<D> + Send,
        mut plain: impl Stepper<D> + Send,
    ) {
        let n = self.n_points;
        let threads = self.pool.current_num_threads();
        let mut group = self.criterion.benchmark_group(format!("{name}/{n}/{threads}-threads"));
        group.throughput(Throughput::Elements(generic.points().mass.len() as u64));
        group.sampling_mode(SamplingMode::Flat);
        let pool = self.pool;
        group.bench_function("generic", |bencher| {
            bencher.iter_custom(|n| pool.install(|| time_of(n, || generic.step(DT))));
        });
        group.bench_function("plain", |bencher| {
            bencher.iter_custom(|n| pool.install(|| time_of(n, || plain.step(DT))));
        });
        group.finish();
    }

    fn all(&mut self) {
        let square = scene::<2>(self.n_points, Layout::Jittered);
        self.run("apic-2d-f64", generic::apic::<f64, 2>(&square), Apic2::<f64>::new(&square));
        self.run("apic-2d-f32", generic::apic::<f32, 2>(&square), Apic2::<f32>::new(&square));
        self.run("mpm-2d-f64", generic::mpm::<f64, 2>(&square), Mpm2::<f64>::new(&square));
        self.run("mpm-2d-f32", generic::mpm::<f32, 2>(&square), Mpm2::<f32>::new(&square));
        self.run("tpm-2d-f64", generic::tpm(&square), Tpm2::<f64>::new(&square));
        drop(square);
        let cube = scene::<3>(self.n_points, Layout::Jittered);
        self.run("apic-3d-f64", generic::apic::<f64, 3>(&cube), Apic3::<f64>::new(&cube));
        self.run("apic-3d-f32", generic::apic::<f32, 3>(&cube), Apic3::<f32>::new(&cube));
        self.run("mpm-3d-f64", generic::mpm::<f64, 3>(&cube), Mpm3::<f64>::new(&cube));
        self.run("mpm-3d-f32", generic::mpm::<f32, 3>(&cube), Mpm3::<f32>::new(&cube));
    }
}

/// Time of `n` runs.
fn time_of(n: u64, mut run: impl FnMut()) -> Duration {
    let start = Instant::now();
    for _ in 0..n {
        run();
    }
    start.elapsed()
}

fn steps(criterion: &mut Criterion) {
    let sizes: &[usize] = if timing::short() { &[30_000] } else { &[100_000, 1_000_000] };
    for &n_points in sizes {
        for n_threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().expect("threads");
            Bench { criterion, n_points, pool: &pool }.all();
        }
    }
}

/// Ten samples in two seconds, or a fifth of one in the short form.
fn configured() -> Criterion {
    let (warm_up, measurement) = if timing::short() { (50, 200) } else { (500, 2000) };
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(warm_up))
        .measurement_time(Duration::from_millis(measurement))
}

criterion_group! { name = benches; config = configured(); targets = steps }
criterion_main!(benches);
