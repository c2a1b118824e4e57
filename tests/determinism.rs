//! The same bits on any number of threads and in every run.

use crate::common::parts::DT;
use crate::common::scenes::{Block, Build, SOUND_SPEED, SPACING, run};
use crate::common::{Gap, Random};
use rayon::ThreadPoolBuilder;
use transpoint::scene::{Boundary, Scene};
use transpoint::telemetry::Counters;
use transpoint::{Observation, Settings, Variant};

/// A block with a free surface whose points cross half a cell or more in the run.
fn scene<const D: usize>(cells: usize, fluid: f64) -> Scene<D> {
    let mut block = Block::<D>::full(cells, Boundary::Slip).random(77);
    (block.fluid, block.jitter, block.speed) = ([[0.0, fluid]; D], 0.3, 0.2);
    let mut scene = block.scene();
    scene.body_force = std::array::from_fn(|axis| [1.0, -9.81, 0.5][axis]);
    for point in &mut scene.points {
        for axis in 0..D {
            point.velocity[axis] += 0.06 * SPACING[axis] / DT;
        }
    }
    scene
}

fn result<const D: usize>(
    scene: &Scene<D>,
    (variant, n_steps): (Variant, usize),
    n_threads: usize,
) -> (Observation<D>, Counters)
where
    Scene<D>: Build<D>,
{
    let pool = ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
    pool.install(|| {
        let simulation = run(scene, variant, &Settings::default(), (n_steps, DT));
        (simulation.observe(), simulation.counters())
    })
}

fn check_threads<const D: usize>(scene: &Scene<D>, n_steps: usize)
where
    Scene<D>: Build<D>,
{
    // As printed, without the limiters of fits, cut cells let the filtered transport points burst here.
    for variant in Variant::ALL.into_iter().filter(|&variant| variant != Variant::TpmVpFmpm) {
        let (reference, counters) = result(scene, (variant, n_steps), 1);
        assert!(counters.n_cell_updates >= 3000 * n_steps as u64, "too few cells to split");
        assert!(counters.n_sorts > 1, "no point changes its cell");
        for n_threads in [1, 2, 7] {
            let again = result(scene, (variant, n_steps), n_threads);
            let name = variant.name();
            assert!(again == (reference.clone(), counters), "{name} on {n_threads} threads");
        }
    }
}

#[test]
fn threads_change_no_bit_in_2d() {
    check_threads(&scene::<2>(64, 56.5), 8);
}

#[test]
fn threads_change_no_bit_in_3d() {
    check_threads(&scene::<3>(17, 14.5), 4);
}

/// Within a cell points are summed in the order in which they came, hence round-off.
#[test]
fn the_order_of_the_points_changes_no_more_than_round_off() {
    let scene = scene::<2>(12, 6.5);
    let mut order: Vec<usize> = (0..scene.points.len()).collect();
    let mut random = Random(5);
    for last in (1..order.len()).rev() {
        order.swap(last, (random.unit() * (last + 1) as f64) as usize);
    }
    let mut shuffled = scene.clone();
    shuffled.points = order.iter().map(|&id| scene.points[id]).collect();
    // As printed, without the limiters of fits, cut cells let the filtered transport points burst here.
    for variant in Variant::ALL.into_iter().filter(|&variant| variant != Variant::TpmVpFmpm) {
        let settings = Settings::default();
        let reference = run(&scene, variant, &settings, (3, DT)).observe();
        let mut found = run(&shuffled, variant, &settings, (3, DT)).observe();
        for point in &mut found.points {
            point.id = order[point.id as usize] as u32;
        }
        found.points.sort_by_key(|point| point.id);
        let gap = Gap::between(&reference, &found, (SPACING[0], SOUND_SPEED));
        assert!(gap.largest() < 1e-13, "{}: {gap:?}", variant.name());
    }
}
