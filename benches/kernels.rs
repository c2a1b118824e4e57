//! Kernels within the phases: rows of shape functions, moving least squares, sorting. One thread.

#[expect(dead_code, reason = "each bench takes a part of it")]
mod generic;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod plain;
#[expect(dead_code, reason = "each bench takes a part of it")]
mod timing;

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};

use plain::row::Row;
use plain::scene::{DT, Layout, scene};
use plain::tpm_linear::Tpm2;
use plain::{Points, Stepper};
use transpoint::Solver;
use transpoint::shape::{
    AxisPosition, CubicBspline, Gimp, Linear, QuadraticBspline, ShapeFunction,
};
use transpoint::step::{View, node_velocity, rebuild_centers};

/// A thousand rows in an interior cell.
fn rows(criterion: &mut Criterion) {
    fn generic(shape: &impl ShapeFunction<f64>, xi: &[f64]) -> f64 {
        let row = |&xi: &f64| {
            let row = shape.row(AxisPosition { cell: 5, xi, n_cells: 10, periodic: false });
            row.weight[0] * row.gradient[1] + row.weight[2] * row.gradient[0]
        };
        xi.iter().map(row).sum()
    }
    let xi: Vec<f64> = (0..1000).map(|k| f64::from(k) / 1000.0).collect();
    let mut group = criterion.benchmark_group("rows");
    group.throughput(Throughput::Elements(1000));
    group.bench_function("linear", |b| b.iter(|| generic(&Linear, black_box(&xi))));
    let gimp = Gimp { length: 0.5 };
    group.bench_function("gimp", |b| b.iter(|| generic(&gimp, black_box(&xi))));
    group.bench_function("bspline3", |b| b.iter(|| generic(&CubicBspline, black_box(&xi))));
    group.bench_function("bspline2", |b| b.iter(|| generic(&QuadraticBspline, black_box(&xi))));
    group.bench_function("bspline2-plain", |b| {
        b.iter(|| {
            let row = |&xi: &f64| {
                let row = Row::new(5.0 + xi, 5, 10, 1.0, 1.0);
                row.value[0] * row.slope[1] + row.value[2] * row.slope[0]
            };
            black_box(&xi).iter().map(row).sum::<f64>()
        });
    });
    group.finish();
}

/// The reconstructions of a TPM step: density at the centres; density and momentum at the nodes.
fn moving_least_squares(criterion: &mut Criterion) {
    let square = scene::<2>(30_000, Layout::Jittered);
    let (mut generic, mut plain) = (generic::tpm(&square).0, Tpm2::<f64>::new(&square));
    generic.advance(DT).expect("a sound scene");
    plain.step(DT);
    let Solver { method, physics, grid, cells, particles, columns, nodes, centers, .. } =
        &mut generic;
    let view = View { method, physics, grid, cells, particles, columns };
    let mut group = criterion.benchmark_group("moving-least-squares-2d");
    group.throughput(Throughput::Elements(square.points.len() as u64));
    group.bench_function("centers", |b| b.iter(|| rebuild_centers(&view, centers)));
    group.bench_function("centers-plain", |b| b.iter(|| plain.rebuild_centers()));
    group.bench_function("nodes", |b| {
        b.iter(|| node_velocity(&view, &nodes.index, &nodes.transfer, &mut nodes.velocity));
    });
    group.bench_function("nodes-plain", |b| b.iter(|| plain.update_nodes(DT)));
    group.finish();
}

/// Sorting after a step in which few points have changed cell.
fn sort(criterion: &mut Criterion) {
    let square = scene::<2>(30_000, Layout::Random);
    let mut moved = generic::mpm::<f64, 2>(&square).0;
    // Until some point has changed cell and waits to be sorted.
    while moved.counters.n_sorts < 3 {
        moved.advance(DT).expect("a sound scene");
    }
    while moved.particles.cell.is_sorted() {
        moved.advance(DT).expect("a sound scene");
    }
    let mut group = criterion.benchmark_group("sort-2d");
    group.throughput(Throughput::Elements(square.points.len() as u64));
    group.bench_function("generic", |b| {
        let fresh = || moved.clone();
        b.iter_batched_ref(fresh, Solver::bin_particles, BatchSize::LargeInput);
    });
    let mut points = Points::<f64, 2>::new(&square, false);
    group.bench_function("plain", |b| b.iter(|| points.sort()));
    group.finish();
}

fn kernels(criterion: &mut Criterion) {
    // Everything below runs on this thread.
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("set once");
    rows(criterion);
    moving_least_squares(criterion);
    sort(criterion);
}

fn configured() -> Criterion {
    let (warm_up, measurement) = if timing::short() { (50, 200) } else { (500, 2000) };
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(warm_up))
        .measurement_time(Duration::from_millis(measurement))
}

criterion_group! { name = benches; config = configured(); targets = kernels }
criterion_main!(benches);
