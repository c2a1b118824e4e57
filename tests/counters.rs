//! Snapshots of the integer work counters: they catch a silent change of algorithm.
//!
//! After a deliberate change, `INSTA_UPDATE=always cargo test counters` rewrites them.

use std::fmt::Write;

use crate::common::parts::DT;
use crate::common::scenes::{Block, run};
use transpoint::scene::{Boundary, Scene};
use transpoint::{Settings, Variant};

/// One line per counter, one column per variant, after 20 steps.
fn table(scene: &Scene<2>, settings: &Settings) -> String {
    let runs = Variant::CORE.map(|variant| {
        (variant.name(), run(scene, variant, settings, (20, DT)).counters().entries())
    });
    let mut table = format!("{:22}", "");
    for (name, _) in &runs {
        write!(table, "{name:>18}").unwrap();
    }
    for line in 0..runs[0].1.len() {
        write!(table, "\n{:22}", runs[0].1[line].0).unwrap();
        for (_, entries) in &runs {
            write!(table, "{:>18}", entries[line].1).unwrap();
        }
    }
    table
}

#[test]
fn snapshot_of_a_dam_that_breaks() {
    let mut block = Block::<2>::full(12, Boundary::Slip).random(9);
    (block.fluid, block.jitter, block.speed) = ([[0.0, 5.5], [0.0, 6.0]], 0.49, 0.0);
    block.compression = [0.0; 2];
    let mut scene = block.scene();
    scene.body_force = [0.0, -9.81];
    for point in &mut scene.points {
        point.velocity[0] += 3.0;
    }
    let settings = Settings { positivity: Some(0.8), ..Settings::default() };
    insta::assert_snapshot!("dam", table(&scene, &settings));
}

#[test]
fn snapshot_of_a_full_box() {
    let scene = Block { jitter: 0.2, ..Block::<2>::full(8, Boundary::Periodic).random(9) }.scene();
    insta::assert_snapshot!("full_box", table(&scene, &Settings::default()));
}
