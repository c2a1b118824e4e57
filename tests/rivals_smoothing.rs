//! Lengths that the flow stretches, and divergence and density that are smoothed.

use crate::common::near;
use crate::common::parts::{DT, FLIP};
use crate::common::phases::{STATE, gather, scatter, scheme, solver, velocity_row};
use crate::common::scenes::{Block, DENSITY, SOUND_SPEED, SPACING, run};
use transpoint::material::Inviscid;
use transpoint::method::Scheme;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::Boundary;
use transpoint::shape::{ConvectedGimp, Corrected, DualDomain, QuadraticBspline, ShapeFunction};
use transpoint::transfer::Flip;
use transpoint::variants::{Rearrangement, Split};
use transpoint::{Scene, Settings, Solver, Variant};

type Mpm<S> = Scheme<S, Carried, Particle, Flip>;

fn mpm<S>(shape: S) -> Mpm<S> {
    scheme(shape, Carried, Particle, FLIP)
}

/// A lattice at rest pressure in v = (a x, b y), in a box with free faces; a and b in 1/s.
fn expanding(cells: usize, rate: [f64; 2]) -> Scene<2> {
    let mut scene = Block::<2>::full(cells, Boundary::Free).scene();
    for point in &mut scene.points {
        point.velocity = [rate[0] * point.position[0], rate[1] * point.position[1]];
    }
    scene
}

/// Whether a position is so many cells from every face that the lattice looks the same all around.
fn is_inside<const D: usize>(position: [f64; D], cells: usize, margin: f64) -> bool {
    let range = margin..=cells as f64 - margin;
    (0..D).all(|axis| range.contains(&(position[axis] / SPACING[axis])))
}

type Stretched = Solver<f64, 2, Mpm<ConvectedGimp<f64>>, Inviscid>;

fn inside_lengths(solver: &Stretched, cells: usize) -> Vec<[f64; 2]> {
    let p = &solver.particles;
    let inside = (0..p.len()).filter(|&k| is_inside(p.position[k], cells, 3.0));
    inside.map(|k| p.length[k]).collect()
}

/// l ← l (1 + Δt L) along each axis by itself, from the lengths of quarters of a cell.
#[test]
fn boxes_stretch_with_the_flow() {
    let (rate, dt) = ([20.0, -7.0], 1e-3);
    let mut solver: Stretched = solver(&expanding(8, rate), mpm(ConvectedGimp::default()));
    solver.advance(dt).unwrap();
    let lengths = inside_lengths(&solver, 8);
    assert!(lengths.len() >= 9);
    for axis in 0..2 {
        let exact = 0.5 * SPACING[axis] * (1.0 + dt * rate[axis]);
        // A gradient of velocities of up to 20 m/s over 0.1 m, times the step: 0.2 ε times a few.
        let bound = 4.0 * f64::EPSILON * SPACING[axis];
        for length in &lengths {
            near("length", length[axis], exact, bound).unwrap();
        }
    }
    assert_eq!(solver.counters.n_lengths_limited, 0);
}

/// Boxes stay within a cell and above a sixteenth of one, and each length that is kept there is counted.
#[test]
fn lengths_at_their_bounds_are_counted() {
    for (start, rate, limit) in [(0.999, 20.0, 1.0), (0.0626, -20.0, 1.0 / 16.0)] {
        let scene = expanding(8, [rate, 0.0]);
        let mut solver: Stretched = solver(&scene, mpm(ConvectedGimp::default()));
        solver.particles.length.fill([start * SPACING[0], 0.5 * SPACING[1]]);
        solver.advance(1e-3).unwrap();
        assert!(inside_lengths(&solver, 8).iter().all(|length| length[0] == limit * SPACING[0]));
        let lengths = &solver.particles.length;
        let limited = lengths.iter().filter(|length| length[0] == limit * SPACING[0]).count();
        assert_eq!(solver.counters.n_lengths_limited, limited as u64);
        assert!(lengths.iter().all(|length| length[1] == 0.5 * SPACING[1]));
    }
}

/// In a uniform stream no length changes, at surfaces too, where functions leave out nodes without fluid.
fn lengths_stay_in_a_stream<S: ShapeFunction<f64> + 'static>(shape: S) {
    let block = Block::<2> { fluid: [[3.0, 6.0]; 2], ..Block::full(9, Boundary::Free) };
    let mut scene = block.scene();
    scene.points.iter_mut().for_each(|point| point.velocity = [1.0, -2.0]);
    let mut solver = solver::<f64, 2, _>(&scene, mpm(shape));
    let split = Some(Split::Stretch(1.5));
    solver.set_rearrangement(Some(Rearrangement { split, ..Rearrangement::default() })).unwrap();
    solver.advance(1e-3).unwrap();
    for length in &solver.particles.length {
        for axis in 0..2 {
            near("length", length[axis], 0.5 * SPACING[axis], 4.0 * f64::EPSILON * SPACING[axis])
                .unwrap();
        }
    }
}

#[test]
fn lengths_stay_in_a_stream_at_surfaces() {
    lengths_stay_in_a_stream(ConvectedGimp::default());
    lengths_stay_in_a_stream(Corrected::default());
    lengths_stay_in_a_stream(DualDomain::default());
}

/// Averages of a constant are that constant: F-bar changes nothing inside, and something at the faces, where the
/// divergence is not constant. The mean is taken over points up to 3 cells away, whose nodes see points up to 3 cells
/// from them.
#[test]
fn averaged_dilation_keeps_a_constant_divergence() {
    let scene = expanding(14, [3.0, -1.0]);
    let [plain, averaged] = [Variant::Bspline2, Variant::Bspline2Fbar]
        .map(|variant| run(&scene, variant, &Settings::default(), (1, 1e-3)).observe());
    let (mut n_inside, mut differs) = (0, false);
    for (a, b) in plain.points.iter().zip(&averaged.points) {
        if is_inside(a.position, 14, 6.0) {
            n_inside += 1;
            near("ρ", a.density, DENSITY / (1.0 + 1e-3 * 2.0), 1e-12 * DENSITY).unwrap();
            near("ρ̄", b.density, a.density, 4.0 * f64::EPSILON * DENSITY).unwrap();
        }
        differs |= (a.density - b.density).abs() > 1e-6 * DENSITY;
    }
    assert!(n_inside >= 16 && differs);
}

/// Nodes at ± U, and two points per cell: D = ± U/h in turns, U/h at one point of a cell and −U/h at the other. The
/// weighted sum over the points of a node is zero, so that D̄ = (1 − f) D, and ρ = ρ₀/(1 + Δt D̄): with f = 0.99 the
/// spread is a hundredth.
#[test]
fn averaged_dilation_takes_a_checkerboard_out() {
    let scene = Block::<1>::full(6, Boundary::Periodic).scene();
    for share in [0.0, 0.5, 0.99, 1.0] {
        let settings = Settings { dilation: Some(share), ..Settings::default() };
        let mut solver = solver::<f64, 1, _>(&scene, mpm(QuadraticBspline));
        solver.set_smoothing(&settings).unwrap();
        scatter(&mut solver, 0.0);
        let sign = |index: usize| if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        for slot in 0..solver.nodes.len() {
            let node = solver.nodes.index[slot] as usize;
            solver.nodes.velocity[slot] = velocity_row([SPACING[0] * sign(node)]);
        }
        gather(&mut solver, STATE, 1e-3).unwrap();
        for k in 0..solver.particles.len() {
            let in_cells = solver.particles.position[k][0] / SPACING[0];
            let (cell, lower) = (in_cells as usize, in_cells.fract() < 0.5);
            // Node `cell + 1` stands in the middle of the cell; the slopes there are −¾, ½, ¼.
            let divergence = sign(cell + 1) * if lower { 1.0 } else { -1.0 };
            let exact = DENSITY / (1.0 + 1e-3 * (1.0 - share) * divergence);
            near("ρ", solver.particles.density[k], exact, 4.0 * f64::EPSILON * DENSITY).unwrap();
        }
    }
}

/// ρ of `variant` after a step from rest, by identifier.
fn densities(scene: &Scene<1>, variant: Variant, dt: f64) -> Vec<f64> {
    let points = run(scene, variant, &Settings::default(), (1, dt)).observe().points;
    points.iter().map(|point| point.density).collect()
}

/// δ of `tpm-vp2-diffusion`.
const DELTA: f64 = 0.1;

/// In a column with ρ = ρ₀ (1 + q (n/2 − x/h)), q = g h/c², the slope is that of ρ₀. The term takes that of the mean
/// of two cells, off by no more than q n/2: over two faces and a step at Courant number C the density changes by
/// δ C q² n. Without the hydrostatic term the change at the ends would be δ C q, 1e5 times as much.
#[test]
fn density_diffusion_leaves_a_tank_at_rest() {
    let (n, q) = (12, 1e-6);
    let mut scene = Block::<1>::full(n, Boundary::Slip).scene();
    scene.body_force = [-q * SOUND_SPEED * SOUND_SPEED / SPACING[0]];
    for point in &mut scene.points {
        let rise = 1.0 + q * (0.5 * n as f64 - point.position[0] / SPACING[0]);
        (point.density, point.mass) = (point.density * rise, point.mass * rise);
    }
    let courant = SOUND_SPEED * DT / SPACING[0];
    let bound = DELTA * courant * q * q * n as f64 + 8.0 * f64::EPSILON;
    let [plain, smooth] = [Variant::TpmVpQuadratic, Variant::TpmVpDiffusion]
        .map(|variant| densities(&scene, variant, DT));
    for (a, b) in plain.into_iter().zip(smooth) {
        near("ρ", b, a, bound * DENSITY).unwrap();
    }
}

/// From rest, the first step changes the densities of a wave by −δ C (2 − 2 cos kh) of it and no more than (kh)²
/// of that less, for the fits and the functions that spread it over a cell.
#[test]
fn density_diffusion_damps_a_wave() {
    let cells = 16;
    let mut scene = Block::<1>::full(cells, Boundary::Periodic).scene();
    let phase = std::f64::consts::TAU / cells as f64;
    let shape: Vec<f64> =
        scene.points.iter().map(|p| (phase * p.position[0] / SPACING[0]).cos()).collect();
    for (point, shape) in scene.points.iter_mut().zip(&shape) {
        (point.density, point.mass) =
            (point.density * (1.0 + 1e-4 * shape), point.mass * (1.0 + 1e-4 * shape));
    }
    let amplitude = |densities: &[f64]| {
        let parts = densities.iter().zip(&shape).map(|(density, shape)| density * shape);
        parts.sum::<f64>() / (0.5 * shape.len() as f64) / (1e-4 * DENSITY)
    };
    let dt = 0.1 * DT;
    let [plain, smooth] = [Variant::TpmVpQuadratic, Variant::TpmVpDiffusion]
        .map(|variant| amplitude(&densities(&scene, variant, dt)));
    let courant = SOUND_SPEED * dt / SPACING[0];
    let exact = DELTA * courant * (2.0 - 2.0 * phase.cos());
    near("decay", plain - smooth, exact * (1.0 - 0.5 * phase * phase), 0.5 * exact * phase * phase)
        .unwrap();
}
