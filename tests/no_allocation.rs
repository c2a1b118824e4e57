//! A step allocates nothing once its buffers have grown.

#[expect(dead_code, reason = "this file uses a part of it")]
mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use common::parts::DT;
use common::scenes::{Block, Build, SPACING};
use rayon::ThreadPoolBuilder;
use transpoint::scene::{Boundary, InletProfile, InletSpec, Scene, Side, Supply};
use transpoint::variants::{Fill, FillMass, FillPoints, Rearrangement, Split, StressUpdate};
use transpoint::{Settings, Variant};

/// Counts the allocations of each thread.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    ALLOCATIONS.with(|count| count.set(count.get() + 1));
}

#[expect(unsafe_code, reason = "an allocator cannot be written without; it only counts")]
// SAFETY: every call is passed on to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A block that drifts through a periodic box without a force: cells empty and fill.
fn scene<const D: usize>() -> Scene<D> {
    let mut block = Block::<D>::full(8, Boundary::Periodic).random(5);
    (block.fluid, block.jitter, block.speed) = ([[1.0, 4.5]; D], 0.3, 0.0);
    block.compression = [0.0; 2];
    let mut scene = block.scene();
    for point in &mut scene.points {
        for axis in 0..D {
            point.velocity[axis] += 0.11 * SPACING[axis] / DT;
        }
    }
    scene
}

/// Allocations of a drifting block; the points must have been sorted meanwhile.
fn allocations<const D: usize>(variant: Variant, settings: &Settings) -> u64
where
    Scene<D>: Build<D>,
{
    let (allocations, n_sorts) = allocations_of(&scene::<D>(), variant, settings, 80);
    assert!(n_sorts > 10, "{}: nothing moves", variant.name());
    allocations
}

/// Allocations in 40 steps after the warm-up, and how often the points were sorted meanwhile.
fn allocations_of<const D: usize>(
    scene: &Scene<D>,
    variant: Variant,
    settings: &Settings,
    warm_up: usize,
) -> (u64, u64)
where
    Scene<D>: Build<D>,
{
    let mut simulation = scene.build(variant, settings);
    for _ in 0..warm_up {
        simulation.step(0.5 * DT).unwrap();
    }
    let n_sorts = simulation.counters().n_sorts;
    let before = ALLOCATIONS.get();
    for _ in 0..40 {
        simulation.step(0.5 * DT).unwrap();
    }
    let allocations = ALLOCATIONS.get() - before;
    (allocations, simulation.counters().n_sorts - n_sorts)
}

fn check<const D: usize>()
where
    Scene<D>: Build<D>,
{
    let orders = [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast];
    let found = ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| {
        let mut found = Vec::new();
        // Where fractures are filled the arrays of the points grow with the points.
        let fills = |variant: &Variant| {
            let rearrangement = variant.settings(&Settings::default()).rearrangement;
            rearrangement.is_some_and(|parts| parts.fill.is_some())
        };
        let variants = Variant::ALL.into_iter().filter(|variant| !fills(variant));
        for (variant, stress_update) in
            variants.flat_map(|variant| orders.map(|order| (variant, order)))
        {
            let settings = Settings { stress_update, ..Settings::default() };
            found.push((variant.name(), stress_update, allocations::<D>(variant, &settings)));
        }
        found
    });
    for (name, stress_update, allocations) in found {
        assert_eq!(allocations, 0, "{name}, {stress_update:?}");
    }
}

#[test]
fn the_counter_counts() {
    let before = ALLOCATIONS.get();
    let kept = std::hint::black_box(vec![1_u8; 10]);
    assert_eq!((ALLOCATIONS.get() - before, kept.len()), (1, 10));
}

#[test]
fn steps_of_every_variant_allocate_nothing_in_2d() {
    check::<2>();
}

#[test]
fn steps_of_every_variant_allocate_nothing_in_3d() {
    check::<3>();
}

/// A stream through a box: points come in and go out.
#[test]
fn inlets_and_outflows_allocate_nothing() {
    let cells = [8, 4];
    let spacing = [SPACING[0], SPACING[1]];
    let speed = 0.11 * SPACING[0] / DT;
    let fluid = [[2.0, 8.0], [0.0, 4.0]];
    let mut scene = Block { cells, fluid, ..Block::<2>::full(4, Boundary::Slip) }.scene();
    for point in &mut scene.points {
        point.velocity[0] = speed;
    }
    scene.boundaries[0][1] = Boundary::OUTFLOW;
    scene.inlets.push(InletSpec {
        axis: 0,
        side: Side::Lower,
        lower: [0.0; 2],
        upper: [0.0, 4.0 * spacing[1]],
        velocity: [speed, 0.0],
        profile: InletProfile::Uniform,
        hydrostatic: false,
        points_per_axis: 2,
        supply: Supply::Columns,
    });
    ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| {
        for (variant, supply) in [
            (Variant::TpmVp, Supply::Columns),
            (Variant::TpmVp, Supply::Flux),
            (Variant::Apic, Supply::Flux),
        ] {
            scene.inlets[0].supply = supply;
            let settings = Settings::default();
            let (found, n_sorts) = allocations_of(&scene, variant, &settings, 240);
            assert_eq!(found, 0, "{} {supply:?}", variant.name());
            assert!(n_sorts > 3, "{} {supply:?}: nothing moves", variant.name());
        }
    });
}

/// Fractures are looked for and their filling is refused; no point is large enough to be split.
#[test]
fn rearrangement_without_an_event_allocates_nothing() {
    let fill = Fill { points: FillPoints::Quarters, mass: FillMass::Budget(0.0) };
    let none = Rearrangement::default();
    let adding = Rearrangement { fill: Some(fill), most_points: Some(99), ..none };
    let splitting = Rearrangement { split: Some(Split::Stretch(99.0)), ..none };
    ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| {
        for (variant, rearrangement) in [(Variant::TpmVp, adding), (Variant::Mpm, splitting)] {
            let settings = Settings { rearrangement: Some(rearrangement), ..Settings::default() };
            assert_eq!(allocations::<2>(variant, &settings), 0, "{}", variant.name());
        }
    });
}
