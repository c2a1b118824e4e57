//! One scene for every bench: a closed box full of points, moving gently between slip walls.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

/// Cell size, m.
pub const SPACING: f64 = 0.01;
/// ρ₀, kg/m³.
pub const REFERENCE_DENSITY: f64 = 1000.0;
/// c₀, m/s.
pub const SOUND_SPEED: f64 = 50.0;
/// Time step, s: a Courant number of 0.1.
pub const DT: f64 = 0.1 * SPACING / SOUND_SPEED;

/// How the points lie in their cells, and with that how often they have to be sorted again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// A lattice of points, jittered by at most 0.3 of their spacing: none is within a fifth of that spacing of
    /// a face of its cell, so that short runs need no sorting.
    Jittered,
    /// Points at random in their cells, at least 0.002 of a cell away from the walls: some point
    /// changes cell in nearly every step.
    Random,
}

/// A box of about `n_points` points, 2^D per cell, as near to a cube as whole cells allow.
pub fn scene<const D: usize>(n_points: usize, layout: Layout) -> Scene<D> {
    let n = ((n_points >> D) as f64).powf(1.0 / D as f64).round().max(4.0) as usize;
    scene_of_cells([n; D], layout)
}

/// A box of `cells` cells with 2^D points each.
pub fn scene_of_cells<const D: usize>(cells: [usize; D], layout: Layout) -> Scene<D> {
    scene_of_points(cells, 2, layout)
}

/// A box of `cells` cells with `per_axis` points along each axis of a cell.
pub fn scene_of_points<const D: usize>(
    cells: [usize; D],
    per_axis: usize,
    layout: Layout,
) -> Scene<D> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let n_cells: usize = cells.iter().product();
    let dimension = u32::try_from(D).expect("a small dimension");
    let (width, per_cell) = (1.0 / per_axis as f64, per_axis.pow(dimension));
    let volume = (SPACING * width).powi(dimension.cast_signed());
    let mut points = Vec::with_capacity(n_cells * per_cell);
    for c in 0..n_cells {
        for corner in 0..per_cell {
            let (mut rest, mut position) = (c, [0.0; D]);
            for a in (0..D).rev() {
                let (cell, u) = (rest % cells[a], random.unit());
                rest /= cells[a];
                let place = corner / per_axis.pow(a as u32) % per_axis;
                let inside = match layout {
                    Layout::Jittered => {
                        (0.5 + place as f64) * width + 0.3 * width * (2.0 * u - 1.0)
                    }
                    Layout::Random => 0.002 + 0.996 * u,
                };
                position[a] = (cell as f64 + inside) * SPACING;
            }
            points.push(point(position, cells, volume));
        }
    }
    Scene::new(
        GridSpec { origin: [0.0; D], spacing: [SPACING; D], cells },
        [[Boundary::Slip; 2]; D],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: REFERENCE_DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    )
}

/// A point of a standing wave: velocity zero through the walls, density a thousandth off at most.
fn point<const D: usize>(position: [f64; D], cells: [usize; D], volume: f64) -> PointSpec<D> {
    let phase: [f64; D] =
        std::array::from_fn(|a| std::f64::consts::PI * position[a] / (SPACING * cells[a] as f64));
    let velocity = std::array::from_fn(|a| {
        let others: f64 = (0..D).filter(|&b| b != a).map(|b| phase[b].cos()).product();
        0.1 * (1.0 + a as f64) * phase[a].sin() * others
    });
    let wave: f64 = phase.iter().map(|p| (2.0 * p).cos()).product();
    let density = REFERENCE_DENSITY * (1.0 + 1e-3 * wave);
    PointSpec::new(position, velocity, density, density * volume)
}

/// A small generator (SplitMix64): the same points on every machine, with no crate's version in between.
struct Random(u64);

impl Random {
    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
