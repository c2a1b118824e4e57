//! Symmetries of every variant: a moved, mirrored, turned or rescaled scene moves alike.

use crate::common::Gap;
use crate::common::parts::DT;
use crate::common::scenes::{Block, Build, SOUND_SPEED, SPACING, run};
use transpoint::scene::{Boundary, EquationOfStateSpec, PointSpec, Scene};
use transpoint::simulation::PointState;
use transpoint::variants::PointVolume;
use transpoint::{Observation, Settings, Variant};

/// Round-off that ten steps may pile up, in cells, in c₀ and relative to ρ; 2e-14 was measured. Nodes at the edge of the
/// cloud hold little mass, and the hat's gradient takes their velocity in full.
const BOUND: f64 = 1e-13;

const STEPS: [usize; 2] = [1, 10];

/// A block that fell against a corner of the box: free surface, walls, disorder, motion, gravity.
fn dam<const D: usize>() -> Scene<D> {
    let mut block = Block::<D>::full(if D == 3 { 7 } else { 10 }, Boundary::Slip).random(42);
    block.fluid = [[0.0, 4.5]; D];
    block.jitter = 0.3;
    block.compression = [5e-3, 1e-3];
    let mut scene = block.scene();
    scene.body_force = std::array::from_fn(|axis| [0.3, -9.81, 1.7][axis]);
    scene
}

fn observe<const D: usize>(scene: &Scene<D>, variant: Variant, n_steps: usize) -> Observation<D>
where
    Scene<D>: Build<D>,
{
    run(scene, variant, &Settings::default(), (n_steps, DT)).observe()
}

/// Whether a variant fills fractures or pushes points apart of its own.
fn moves_points(variant: Variant) -> bool {
    let rearrangement = variant.settings(&Settings::default()).rearrangement;
    rearrangement.is_some_and(|parts| parts.fill.is_some() || parts.shift.is_some())
}

/// Runs every variant on a scene and on its image, and compares after mapping the image back.
fn check_image<const D: usize>(
    images: (&Scene<D>, &Scene<D>),
    bound: f64,
    back: impl Fn(PointState<D>, f64) -> PointState<D>,
) where
    Scene<D>: Build<D>,
{
    check_image_of(&Variant::ALL, images, bound, back);
}

/// The same for some variants.
fn check_image_of<const D: usize>(
    variants: &[Variant],
    (scene, image): (&Scene<D>, &Scene<D>),
    bound: f64,
    back: impl Fn(PointState<D>, f64) -> PointState<D>,
) where
    Scene<D>: Build<D>,
{
    for &variant in variants {
        for n_steps in STEPS {
            let reference = observe(scene, variant, n_steps);
            let mut found = observe(image, variant, n_steps);
            for point in &mut found.points {
                *point = back(*point, found.time);
            }
            let gap = Gap::between(&reference, &found, (SPACING[0], SOUND_SPEED));
            let largest = gap.largest();
            assert!(largest <= bound, "{} after {n_steps} steps: {gap:?}", variant.name());
        }
    }
}

/// Applies a map of positions, and one of vectors, to everything in a scene but its box.
fn map_points<const D: usize>(
    scene: &Scene<D>,
    position: impl Fn([f64; D]) -> [f64; D],
    vector: impl Fn([f64; D]) -> [f64; D],
) -> Scene<D> {
    let mut image = scene.clone();
    image.body_force = vector(scene.body_force);
    for point in &mut image.points {
        point.position = position(point.position);
        point.velocity = vector(point.velocity);
        // Each column is a vector; then the columns are exchanged like the entries of one.
        let g = point.velocity_gradient;
        let columns: [[f64; D]; D] =
            std::array::from_fn(|axis| vector(std::array::from_fn(|row| g[row][axis])));
        let rows: [[f64; D]; D] =
            std::array::from_fn(|row| vector(std::array::from_fn(|axis| columns[axis][row])));
        point.velocity_gradient = rows;
    }
    image
}

fn moved<const D: usize>(point: PointState<D>, shift: [f64; D]) -> PointState<D> {
    let position = std::array::from_fn(|axis| point.position[axis] - shift[axis]);
    PointState { position, ..point }
}

fn check_translation<const D: usize>()
where
    Scene<D>: Build<D>,
{
    let scene = dam::<D>();
    let shift = std::array::from_fn(|axis| [1.234_567, -3.3, 0.7][axis]);
    let add = |x: [f64; D]| std::array::from_fn(|axis| x[axis] + shift[axis]);
    let mut image = map_points(&scene, add, |v| v);
    image.grid.origin = shift;
    // Coordinates are rounded at 30 cells instead of 5.
    check_image((&scene, &image), 50.0 * BOUND, |point, _| moved(point, shift));
}

#[test]
fn translation_of_the_origin_moves_the_result() {
    check_translation::<1>();
    check_translation::<2>();
    check_translation::<3>();
}

fn check_reflection<const D: usize>(axis: usize)
where
    Scene<D>: Build<D>,
{
    let scene = dam::<D>();
    let length = scene.grid.spacing[axis] * scene.grid.cells[axis] as f64;
    let with = |v: [f64; D], x: f64| {
        let mut v = v;
        v[axis] = x;
        v
    };
    let image = map_points(&scene, |x| with(x, length - x[axis]), |v| with(v, -v[axis]));
    check_image((&scene, &image), BOUND, |point, _| PointState {
        position: with(point.position, length - point.position[axis]),
        velocity: with(point.velocity, -point.velocity[axis]),
        ..point
    });
}

#[test]
fn reflection_mirrors_the_result() {
    check_reflection::<1>(0);
    check_reflection::<2>(0);
    check_reflection::<2>(1);
    check_reflection::<3>(2);
}

/// The image of axis `a` is axis `a + 1`, cyclically.
fn turned<A: Copy, const D: usize>(of: [A; D]) -> [A; D] {
    std::array::from_fn(|axis| of[(axis + D - 1) % D])
}

fn turned_back<A: Copy, const D: usize>(of: [A; D]) -> [A; D] {
    std::array::from_fn(|axis| of[(axis + 1) % D])
}

fn check_permutation<const D: usize>()
where
    Scene<D>: Build<D>,
{
    let mut scene = dam::<D>();
    scene.grid.cells[0] += 1;
    let mut image = map_points(&scene, turned, turned);
    image.grid.spacing = turned(scene.grid.spacing);
    image.grid.cells = turned(scene.grid.cells);
    check_image((&scene, &image), BOUND, |point, _| PointState {
        position: turned_back(point.position),
        velocity: turned_back(point.velocity),
        ..point
    });
}

#[test]
fn permutation_of_the_axes_permutes_the_result() {
    check_permutation::<2>();
    check_permutation::<3>();
}

/// Powers of two only change exponents, so that nothing may change but these.
fn check_units<const D: usize>()
where
    Scene<D>: Build<D>,
{
    let (length, time, density) = (8.0, 0.25, 4.0);
    let speed = length / time;
    let mut scene = dam::<D>();
    for viscosity in [None, Some(1e-3)] {
        scene.viscosity = viscosity;
        let mut image = map_points(&scene, |x| x.map(|x| x * length), |v| v.map(|v| v * speed));
        image.body_force = scene.body_force.map(|g| g * speed / time);
        image.viscosity = viscosity.map(|nu| nu * length * speed);
        image.grid.spacing = scene.grid.spacing.map(|h| h * length);
        for (point, original) in image.points.iter_mut().zip(&scene.points) {
            point.density = original.density * density;
            point.mass = original.mass * density * length.powi(D as i32);
            point.velocity_gradient = original.velocity_gradient.map(|row| row.map(|g| g / time));
        }
        let EquationOfStateSpec::WeaklyCompressible { reference_density, sound_speed } =
            &mut image.equation_of_state
        else {
            panic!("the scenes of the blocks are weakly compressible");
        };
        (*reference_density, *sound_speed) = (*reference_density * density, *sound_speed * speed);
        for variant in Variant::ALL {
            let settings = Settings::default();
            let reference = run(&scene, variant, &settings, (STEPS[1], DT)).observe();
            let found = run(&image, variant, &settings, (STEPS[1], DT * time)).observe();
            for (p, q) in reference.points.iter().zip(&found.points) {
                let name = variant.name();
                assert_eq!(p.position.map(|x| x * length), q.position, "{name}: position");
                assert_eq!(p.velocity.map(|v| v * speed), q.velocity, "{name}: velocity");
                assert_eq!(p.density * density, q.density, "{name}: density");
            }
        }
    }
}

#[test]
fn units_scaled_by_powers_of_two_change_no_bit() {
    check_units::<1>();
    check_units::<2>();
    check_units::<3>();
}

/// In a periodic box at a speed of one cell per step: the points see the same grid in every step.
fn check_galilean<const D: usize>()
where
    Scene<D>: Build<D>,
{
    let block = Block { jitter: 0.3, ..Block::<D>::full(5, Boundary::Periodic).random(6) };
    let mut scene = Block { speed: 0.3, ..block }.scene();
    scene.points.retain(|point| point.position[0] < 4.0 * SPACING[0]);
    let boost: [f64; D] = std::array::from_fn(|axis| SPACING[axis] / DT);
    let mut image = scene.clone();
    for point in &mut image.points {
        point.velocity = std::array::from_fn(|axis| point.velocity[axis] + boost[axis]);
    }
    // The boost is 40 c₀: so much larger is the round-off.
    // Fills and pushes go through the cells in their order, which is another one behind the periodic face.
    let variants: Vec<_> = Variant::ALL.into_iter().filter(|&v| !moves_points(v)).collect();
    check_image_of(&variants, (&scene, &image), 100.0 * BOUND, |point, time| {
        let mut point = moved(point, boost.map(|v| v * time));
        for axis in 0..D {
            point.velocity[axis] -= boost[axis];
            let length = 5.0 * SPACING[axis];
            point.position[axis] = point.position[axis].rem_euclid(length);
        }
        point
    });
}

#[test]
fn galilean_shift_by_whole_cells_is_invisible() {
    check_galilean::<1>();
    check_galilean::<2>();
    check_galilean::<3>();
}

/// Appends a periodic axis of three cells with two layers of points in each.
fn extrude<const D: usize, const E: usize>(scene: &Scene<D>) -> Scene<E> {
    fn longer<A: Copy, const D: usize, const E: usize>(of: [A; D], last: A) -> [A; E] {
        std::array::from_fn(|axis| if axis < D { of[axis] } else { last })
    }
    let mut slab = Block::<E>::full(3, Boundary::Periodic).scene();
    slab.grid.spacing = longer(scene.grid.spacing, 0.07);
    slab.grid.cells = longer(scene.grid.cells, 3);
    slab.boundaries = longer(scene.boundaries, [Boundary::Periodic; 2]);
    slab.body_force = longer(scene.body_force, 0.0);
    slab.points = (0..6)
        .flat_map(|layer| scene.points.iter().map(move |point| (layer, point)))
        .map(|(layer, point)| PointSpec {
            position: longer(point.position, (f64::from(layer) + 0.5) * 0.035),
            velocity: longer(point.velocity, 0.0),
            density: point.density,
            mass: point.mass * 0.035,
            velocity_gradient: std::array::from_fn(|row| {
                if row < D { longer(point.velocity_gradient[row], 0.0) } else { [0.0; E] }
            }),
            density_slope: point.density_slope.map(|slope| longer(slope, 0.0)),
            energy: point.energy,
        })
        .collect();
    slab
}

/// Circles and spheres of boundary points fill different shares of space, so volumes are carried.
fn check_extrusion<const D: usize, const E: usize>()
where
    Scene<D>: Build<D>,
    Scene<E>: Build<E>,
{
    let scene = dam::<D>();
    let slab = extrude::<D, E>(&scene);
    for point_volume in [PointVolume::CarriedCapped, PointVolume::VolumeFraction] {
        let settings = Settings { point_volume, ..Settings::default() };
        // One factor for all displacements is found from sums over all nodes, which differ between dimensions;
        // points that are pushed apart have neighbors in the other layers too.
        let is_same = |v: &Variant| *v != Variant::Bspline2Overfill && !moves_points(*v);
        for variant in Variant::ALL.into_iter().filter(is_same) {
            let flat = run(&scene, variant, &settings, (STEPS[1], DT)).observe();
            let solid = run(&slab, variant, &settings, (STEPS[1], DT)).observe();
            for layer in solid.points.chunks(flat.points.len()) {
                for (p, q) in flat.points.iter().zip(layer) {
                    let mut gap = (p.density / q.density - 1.0).abs();
                    for axis in 0..D {
                        gap = gap.max((p.position[axis] - q.position[axis]).abs() / SPACING[axis]);
                        gap = gap.max((p.velocity[axis] - q.velocity[axis]).abs() / SOUND_SPEED);
                    }
                    gap = gap.max(q.velocity[D].abs() / SOUND_SPEED);
                    assert!(gap <= BOUND, "{}: {gap:e} at point {}", variant.name(), p.id);
                }
            }
        }
    }
}

#[test]
fn extruded_line_moves_like_the_line() {
    check_extrusion::<1, 2>();
}

#[test]
fn extruded_plane_moves_like_the_plane() {
    check_extrusion::<2, 3>();
}
