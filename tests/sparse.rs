//! The cost follows the fluid, not the box.

use crate::common::parts::DT;
use crate::common::scenes::{Block, Build, SPACING, run};
use transpoint::scene::{Boundary, Scene};
use transpoint::{Settings, Variant};

/// The same block in the corner of a box of `cells`, away from its far walls.
fn corner<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let mut block = Block::<D>::full(10, Boundary::Slip).random(31);
    (block.cells, block.fluid) = (cells, [[0.0, 3.5]; D]);
    (block.jitter, block.speed) = (0.3, 0.1);
    let mut scene = block.scene();
    scene.body_force = std::array::from_fn(|axis| [2.0, -9.81, 1.0][axis]);
    for point in &mut scene.points {
        for axis in 0..D {
            point.velocity[axis] += 0.03 * SPACING[axis] / DT;
        }
    }
    scene
}

fn check<const D: usize>(small: [usize; D], large: [usize; D])
where
    Scene<D>: Build<D>,
{
    let volume = |cells: [usize; D]| cells.iter().product::<usize>();
    assert!(volume(large) >= 100 * volume(small));
    for variant in Variant::ALL {
        let in_box = |cells| run(&corner(cells), variant, &Settings::default(), (20, DT));
        let (in_small, in_large) = (in_box(small), in_box(large));
        let name = variant.name();
        assert_eq!(in_small.counters(), in_large.counters(), "{name}");
        assert_eq!(in_small.observe(), in_large.observe(), "{name}");
        // PIC damps what would carry a point into another cell.
        let moves = in_small.counters().n_sorts > 2;
        assert!(moves || variant == Variant::Pic, "{name}: nothing moves");
    }
}

#[test]
fn a_hundred_times_larger_box_changes_neither_work_nor_bits_in_1d() {
    check([10], [1000]);
}

#[test]
fn a_hundred_times_larger_box_changes_neither_work_nor_bits_in_2d() {
    check([10, 9], [100, 90]);
}

#[test]
fn a_hundred_times_larger_box_changes_neither_work_nor_bits_in_3d() {
    check([9, 9, 9], [36, 45, 45]);
}
