//! The phases of a step: generic beside plain, one thread.

#[expect(dead_code, reason = "each bench takes a part of it")]
mod generic;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod timing;

use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};

use plain::Stepper;
use plain::apic_quadratic_2d::Apic2;
use plain::apic_quadratic_3d::Apic3;
use plain::mpm_linear_2d::Mpm2;
use plain::mpm_linear_3d::Mpm3;
use plain::scene::{DT, Layout, scene};
use transpoint::step::Pass;

const PASS: Pass = Pass { velocity: true, state: true, motion: true };

/// Benches the three phases of a generic solver and of a plain kernel. The gathers run with Δt = 0,
/// so that they can be repeated.
macro_rules! phases {
    ($criterion:expr, $name:literal, $n_points:expr, $generic:expr, $plain:expr) => {{
        let (mut generic, mut plain) = ($generic.0, $plain);
        generic.advance(DT).expect("a sound scene");
        plain.step(DT);
        let mut group = $criterion.benchmark_group(concat!($name, "/particles-to-grid"));
        group.throughput(Throughput::Elements($n_points as u64));
        group.bench_function("generic", |b| b.iter(|| generic.particles_to_grid(DT)));
        group.bench_function("plain", |b| b.iter(|| plain.particles_to_grid(DT)));
        group.finish();
        let mut group = $criterion.benchmark_group(concat!($name, "/update-grid"));
        group.throughput(Throughput::Elements($n_points as u64));
        group.bench_function("generic", |b| {
            let start = generic.nodes.clone();
            let prepared = || start.clone();
            b.iter_batched(
                prepared,
                |nodes| {
                    generic.nodes = nodes;
                    generic.update_grid(DT);
                },
                BatchSize::LargeInput,
            );
        });
        group.bench_function("plain", |b| {
            let start = plain.nodes().to_vec();
            let prepared = || start.clone();
            b.iter_batched(
                prepared,
                |nodes| {
                    plain.set_nodes(nodes);
                    plain.update_grid(DT);
                },
                BatchSize::LargeInput,
            );
        });
        group.finish();
        generic.particles_to_grid(DT);
        generic.update_grid(DT);
        plain.particles_to_grid(DT);
        plain.update_grid(DT);
        let mut group = $criterion.benchmark_group(concat!($name, "/grid-to-particles"));
        group.throughput(Throughput::Elements($n_points as u64));
        group.bench_function("generic", |b| b.iter(|| generic.grid_to_particles(0.0, PASS)));
        group.bench_function("plain", |b| b.iter(|| plain.grid_to_particles(0.0)));
        group.finish();
    }};
}

fn phases(criterion: &mut Criterion) {
    let n_points = if timing::short() { 30_000 } else { 100_000 };
    // Everything below runs on this thread.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("set once");
    let square = scene::<2>(n_points, Layout::Jittered);
    let n = square.points.len();
    let apic = generic::apic::<f64, 2>(&square);
    phases!(criterion, "apic-2d-f64", n, apic, Apic2::<f64>::new(&square));
    let mpm = generic::mpm::<f64, 2>(&square);
    phases!(criterion, "mpm-2d-f64", n, mpm, Mpm2::<f64>::new(&square));
    let cube = scene::<3>(n_points, Layout::Jittered);
    let n = cube.points.len();
    let apic = generic::apic::<f64, 3>(&cube);
    phases!(criterion, "apic-3d-f64", n, apic, Apic3::<f64>::new(&cube));
    let mpm = generic::mpm::<f64, 3>(&cube);
    phases!(criterion, "mpm-3d-f64", n, mpm, Mpm3::<f64>::new(&cube));
}

fn configured() -> Criterion {
    let (warm_up, measurement) = if timing::short() { (50, 200) } else { (500, 2000) };
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(warm_up))
        .measurement_time(Duration::from_millis(measurement))
}

criterion_group! { name = benches; config = configured(); targets = phases }
criterion_main!(benches);
