//! The workloads: one step of each scheme, generic and plain, `f64`, one thread, no point changing cell.

use std::hint::black_box;

use fearless_simd::Level;

use crate::generic;
use crate::plain::Stepper;
use crate::plain::apic_quadratic_2d::Apic2;
use crate::plain::apic_quadratic_3d::Apic3;
use crate::plain::mpm_linear_2d::Mpm2;
use crate::plain::scene::{DT, Layout, scene_of_cells};
use crate::plain::tpm_linear::Tpm2;

/// Names, in the order of the table.
pub const NAMES: [&str; 9] = [
    "apic-2d",
    "apic-2d-viscous",
    "apic-3d",
    "mpm-2d",
    "tpm-2d",
    "apic-2d-plain",
    "apic-3d-plain",
    "mpm-2d-plain",
    "tpm-2d-plain",
];

const SQUARE: [usize; 2] = [32, 32];
const CUBE: [usize; 3] = [10, 10, 10];

/// Points of a workload.
pub fn n_points(name: &str) -> usize {
    if name.contains("3d") {
        8 * CUBE.iter().product::<usize>()
    } else {
        4 * SQUARE.iter().product::<usize>()
    }
}

/// Runs a workload; false if there is none of that name.
pub fn run(name: &str, n_steps: usize) -> bool {
    transpoint::limit_to_baseline(true);
    let level = Level::baseline();
    let square = || scene_of_cells(SQUARE, Layout::Jittered);
    let cube = || scene_of_cells(CUBE, Layout::Jittered);
    match name {
        "apic-2d" => steps(n_steps, generic::apic::<f64, 2>(&square())),
        "apic-2d-viscous" => steps(n_steps, generic::viscous_apic(&square())),
        "apic-3d" => steps(n_steps, generic::apic::<f64, 3>(&cube())),
        "mpm-2d" => steps(n_steps, generic::mpm::<f64, 2>(&square())),
        "tpm-2d" => steps(n_steps, generic::tpm(&square())),
        "apic-2d-plain" => steps(n_steps, Apic2::<f64>::at_level(&square(), level)),
        "apic-3d-plain" => steps(n_steps, Apic3::<f64>::at_level(&cube(), level)),
        "mpm-2d-plain" => steps(n_steps, Mpm2::<f64>::at_level(&square(), level)),
        "tpm-2d-plain" => steps(n_steps, Tpm2::<f64>::at_level(&square(), level)),
        _ => return false,
    }
    true
}

fn steps<const D: usize>(n_steps: usize, mut scheme: impl Stepper<D>) {
    // The first step, in which buffers take their size, is in both runs.
    for _ in 0..=n_steps {
        scheme.step(DT);
    }
    black_box(scheme.n_sorts());
}

/// The instruction set that is counted: the baseline, which is the same on every machine of its kind and
/// which callgrind can decode.
pub fn level() -> String {
    let level = format!("{:?}", Level::baseline());
    level.split('(').next().unwrap_or_default().to_lowercase()
}
