//! Mixed quadrature: which cells are full, and the volumes of the points of the others.

use crate::common::clouds::CloudData;
use crate::common::near;
use crate::common::parts::{DT, FLIP, MIXED, mls};
use crate::common::phases::{scheme, solver};
use crate::common::scenes::Block;
use transpoint::cells::{CellKind, Cells};
use transpoint::method::Method;
use transpoint::quadrature::{
    Gauss, Mixed, Quadrature, boxed_volume, classify, classify_by_volume, wetted_sites,
};
use transpoint::scene::{Boundary, PointSpec, Scene};
use transpoint::shape::{Linear, QuadraticBspline};
use transpoint::step::View;
use transpoint::variants::{PointVolume, StressUpdate};
use transpoint::{Observation, Settings, Simulation, Variant};

fn classified<const D: usize>(scene: &Scene<D>) -> CloudData<f64, D> {
    let mut data = CloudData::new(scene);
    classify(&data.grid, &mut data.cells);
    data
}

fn counts(cells: &Cells) -> [usize; 3] {
    let boundary = cells.kind.iter().filter(|&&kind| kind == CellKind::Boundary).count();
    let near_surface = cells.near_surface.iter().filter(|&&near| near).count();
    [cells.len(), boundary, near_surface]
}

#[test]
fn a_block_in_a_bigger_box_has_a_ring_of_boundary_cells() {
    let block = Block { fluid: [[3.0, 8.0]; 2], ..Block::<2>::full(10, Boundary::Slip) };
    let data = classified(&block.scene());
    // All cells but the middle one are in the ring or touch it.
    assert_eq!(counts(&data.cells), [25, 16, 24]);
    for (slot, &cell) in data.cells.index.iter().enumerate() {
        let inside = data.grid.cell_coordinates(cell).iter().all(|c| (4..=6).contains(c));
        assert_eq!(data.cells.kind[slot] == CellKind::Internal, inside, "cell {cell}");
    }
    let cube = Block { fluid: [[1.0, 6.0]; 3], ..Block::<3>::full(7, Boundary::Slip) };
    assert_eq!(counts(&classified(&cube.scene()).cells), [125, 125 - 27, 124]);
}

#[test]
fn walls_are_not_empty_cells() {
    let corner = Block { fluid: [[0.0, 5.0]; 2], ..Block::<2>::full(10, Boundary::Slip) };
    assert_eq!(counts(&classified(&corner.scene()).cells), [25, 9, 16]);
    let full = Block::<2>::full(4, Boundary::Slip);
    assert_eq!(counts(&classified(&full.scene()).cells), [16, 0, 0]);
}

#[test]
fn periodic_faces_show_the_cells_of_the_other_side() {
    let strip =
        Block { fluid: [[0.0, 5.0], [0.0, 6.0]], ..Block::<2>::full(6, Boundary::Periodic) };
    assert_eq!(counts(&classified(&strip.scene()).cells), [30, 12, 24]);
}

#[test]
fn diagonal_neighbours_count() {
    let mut scene = Block::<2>::full(7, Boundary::Slip).scene();
    let spacing = scene.grid.spacing;
    scene
        .points
        .retain(|point| (0..2).any(|axis| (point.position[axis] / spacing[axis]).floor() != 3.0));
    assert_eq!(counts(&classified(&scene).cells), [48, 8, 24]);
}

/// Volumes of the points of every cell, as samples.
fn volumes<const D: usize>(scene: &Scene<D>, point_volume: PointVolume) -> Vec<f64> {
    let data = CloudData::<f64, D>::new(scene);
    let (cloud, rule) = (data.cloud(), Mixed::new(point_volume));
    let mut found = vec![0.0; data.particles.len()];
    for slot in 0..data.cells.len() {
        let volumes = rule.point_volumes(&cloud, slot);
        for point in data.cells.points(slot) {
            let density = data.particles.density[point];
            let (volume, mass) = volumes.of(point, data.particles.mass[point], density);
            near("mass", mass, volume * density, 1e-15 * mass).unwrap();
            found[data.particles.id[point] as usize] = volume;
        }
    }
    found
}

/// A lattice of cubes: `n` points per axis in each cell of 0.1 m.
fn lattice<const D: usize>() -> Scene<D> {
    let mut scene = Block::<D>::full(4, Boundary::Periodic).scene();
    for point in &mut scene.points {
        for axis in 0..D {
            point.position[axis] *= 0.1 / scene.grid.spacing[axis];
        }
    }
    scene.grid.spacing = [0.1; D];
    scene
}

fn check_lattice<const D: usize>(share: f64) {
    let lattice_volume = 0.05_f64.powi(D as i32);
    for volume in volumes(&lattice::<D>(), PointVolume::Sphere) {
        near("sphere", volume, share * lattice_volume, 1e-13 * lattice_volume).unwrap();
    }
}

/// Touching circles leave 21.5 % of a square lattice uncovered, spheres 47.6 % of a cubic one.
#[test]
fn spheres_of_a_lattice_touch_each_other() {
    use std::f64::consts::{FRAC_PI_4, FRAC_PI_6};
    check_lattice::<1>(1.0);
    check_lattice::<2>(FRAC_PI_4);
    check_lattice::<3>(FRAC_PI_6);
    assert!((1.0 - FRAC_PI_4 - 0.215).abs() < 1e-3 && (1.0 - FRAC_PI_6 - 0.476).abs() < 1e-3);
}

#[test]
fn a_point_alone_gets_the_circle_in_its_cell() {
    let mut scene = lattice::<2>();
    scene.points.truncate(1);
    let [volume] = volumes(&scene, PointVolume::Sphere)[..] else { panic!() };
    near("circle", volume, std::f64::consts::FRAC_PI_4 * 0.01, 1e-16).unwrap();
}

#[test]
fn capped_volumes_are_carried_up_to_the_cells_share() {
    let mut scene = lattice::<2>();
    let share = 0.01 / 4.0;
    for (id, point) in scene.points.iter_mut().enumerate() {
        point.mass = point.density * share * [0.5, 1.5][id % 2];
    }
    for (id, volume) in volumes(&scene, PointVolume::CarriedCapped).into_iter().enumerate() {
        near("capped", volume, share * [0.5, 1.0][id % 2], 1e-17).unwrap();
    }
}

#[test]
fn shared_volumes_fill_a_cell_at_most_once() {
    let mut scene = lattice::<2>();
    let share = 0.01 / 4.0;
    for point in &mut scene.points {
        // Cells of the left half hold twice their volume, the others half of it.
        point.mass = point.density * share * if point.position[0] < 0.2 { 2.0 } else { 0.5 };
    }
    let found = volumes(&scene, PointVolume::VolumeFraction);
    for (point, volume) in scene.points.iter().zip(found) {
        let expected = share * if point.position[0] < 0.2 { 1.0 } else { 0.5 };
        near("shared", volume, expected, 1e-17).unwrap();
    }
}

fn observe(scene: &Scene<2>, method: impl Method<f64, 2>) -> Observation<2> {
    let mut solver = solver::<f64, 2, _>(scene, method);
    for _ in 0..10 {
        solver.advance(DT).unwrap();
    }
    solver.observe()
}

#[test]
fn gauss_and_mixed_quadrature_are_the_same_bits_in_a_full_box() {
    for faces in [Boundary::Slip, Boundary::Periodic] {
        let scene = Block { jitter: 0.3, ..Block::<2>::full(6, faces).random(12) }.scene();
        let gauss = observe(&scene, scheme(Linear, mls(), Gauss, FLIP));
        assert_eq!(gauss, observe(&scene, scheme(Linear, mls(), MIXED, FLIP)));
    }
}

/// The counterexample: with a free surface they differ.
#[test]
fn gauss_and_mixed_quadrature_differ_at_a_free_surface() {
    let block = Block { fluid: [[0.0, 3.5]; 2], ..Block::<2>::full(6, Boundary::Slip).random(12) };
    let scene = block.scene();
    let gauss = observe(&scene, scheme(QuadraticBspline, mls(), Gauss, FLIP));
    assert_ne!(gauss, observe(&scene, scheme(QuadraticBspline, mls(), MIXED, FLIP)));
}

/// The rival criterion looks at volumes only: a full cell under the surface is internal, one from which
/// half of the points are gone is not.
#[test]
fn cells_filled_to_a_share_are_internal() {
    let mut scene =
        Block { fluid: [[0.0, 5.0]; 2], ..Block::<2>::full(10, Boundary::Slip) }.scene();
    for point in &mut scene.points {
        // The carried volume of a point is a quarter of a cell.
        point.mass = point.density * 0.25 * scene.grid.spacing[0] * scene.grid.spacing[1];
    }
    let spacing = scene.grid.spacing;
    let in_cell = |point: &PointSpec<2>| {
        (0..2).all(|axis| (point.position[axis] / spacing[axis]).floor() == 2.0)
    };
    let victims: Vec<_> = (0..scene.points.len()).filter(|&p| in_cell(&scene.points[p])).collect();
    for &victim in victims[..2].iter().rev() {
        scene.points.remove(victim);
    }
    let data = CloudData::<f64, 2>::new(&scene);
    for (share, expected) in [(0.9, 1), (0.5, 0), (0.4, 0)] {
        let mut kind = Vec::new();
        classify_by_volume(&data.cloud(), share * (1.0 - 1e-12), &mut kind);
        let boundary = kind.iter().filter(|&&kind| kind == CellKind::Boundary).count();
        assert_eq!((kind.len(), boundary), (25, expected), "share {share}");
    }
}

/// A flat surface at 0.4 of a cell: the sample stands at 0.2 of it, and in the middle of full cells.
#[test]
fn samples_of_cut_cells_stand_at_the_centroid_of_the_wet_part() {
    let block = Block { fluid: [[0.0, 6.0], [0.0, 4.0]], ..Block::<2>::full(6, Boundary::Slip) };
    let mut scene = block.scene();
    let spacing = scene.grid.spacing;
    for point in &mut scene.points {
        let top = point.position[1] > 3.0 * spacing[1];
        point.mass = point.density * 0.25 * spacing[0] * spacing[1] * if top { 0.4 } else { 1.0 };
    }
    let method = scheme(Linear, mls(), Mixed::new(PointVolume::Plane), FLIP);
    let mut solver = solver::<f64, 2, _>(&scene, method);
    solver.particles_to_grid(DT);
    let view = View {
        method: &solver.method,
        physics: &solver.physics,
        grid: &solver.grid,
        cells: &solver.cells,
        particles: &solver.particles,
        columns: &solver.columns,
    };
    let mut sites = Vec::new();
    wetted_sites(&view, &solver.centers, &mut sites);
    assert_eq!(sites.len(), 24);
    for (site, &cell) in sites.iter().zip(&solver.cells.index) {
        let at = solver.grid.cell_coordinates(cell);
        let along = [at[0] as f64 + 0.5, at[1] as f64 + if at[1] == 3 { 0.2 } else { 0.5 }];
        for axis in 0..2 {
            near("site", site[axis] / spacing[axis], along[axis], 1e-12).unwrap();
        }
    }
}

/// Boxes that are cut at faces of cells with points, and whole elsewhere, add up to what they were.
fn check_sum_of_boxes<const D: usize>(faces: Boundary) {
    let block =
        Block { fluid: [[0.0, 4.0]; D], jitter: 0.4, ..Block::<D>::full(6, faces) }.random(3);
    let data = CloudData::<f64, D>::new(&block.scene());
    let boxes: f64 = (0..data.cells.len()).map(|slot| boxed_volume(&data.cloud(), 0.5, slot)).sum();
    let carried: f64 =
        data.particles.mass.iter().zip(&data.particles.density).map(|(m, rho)| m / rho).sum();
    near("sum", boxes, carried, 1e-13 * carried).unwrap();
}

#[test]
fn boxes_add_up_to_the_carried_volume() {
    for faces in [Boundary::Slip, Boundary::Periodic] {
        check_sum_of_boxes::<1>(faces);
        check_sum_of_boxes::<2>(faces);
        check_sum_of_boxes::<3>(faces);
    }
}

/// A lattice whose top row ends at a surface: the cells hold what the surface leaves them, but what
/// reaches into a cell without points counts below.
#[test]
fn boxes_of_a_lattice_end_at_its_surface() {
    let full = Block { fluid: [[0.0, 6.0], [0.0, 4.0]], ..Block::<2>::full(6, Boundary::Slip) };
    for (shift, top, below) in [(0.1, 0.0, 1.1), (0.4, 0.4, 1.0), (0.6, 0.6, 1.0), (0.9, 0.9, 1.0)]
    {
        let mut scene = full.scene();
        let spacing = scene.grid.spacing;
        for point in &mut scene.points {
            point.mass = point.density * 0.25 * spacing[0] * spacing[1];
            point.position[1] += shift * spacing[1];
        }
        let data = CloudData::<f64, 2>::new(&scene);
        for (slot, &cell) in data.cells.index.iter().enumerate() {
            let expected = match data.grid.cell_coordinates(cell)[1] {
                4 => top,
                3 => below,
                // The lattice has left the floor, at last all of the lowest cell.
                0 => 1.0 - shift,
                1 if shift == 0.9 => 1.1,
                _ => 1.0,
            };
            let found = boxed_volume(&data.cloud(), 0.5, slot) / (spacing[0] * spacing[1]);
            near("volume", found, expected, 1e-12).unwrap();
        }
    }
}

/// With the stress updated first, the strain is taken before the step has its planes.
#[test]
fn planes_need_the_samples_of_the_step() {
    let scene = Block { fluid: [[0.0, 4.0]; 2], ..Block::<2>::full(6, Boundary::Slip) }.scene();
    let settings = |stress_update| Settings {
        point_volume: PointVolume::Plane,
        stress_update,
        ..Settings::default()
    };
    let refused = Variant::TpmVp.build_2d(&scene, &settings(StressUpdate::First)).err().unwrap();
    assert_eq!(refused.field, "settings.stress_update");
    for allowed in [StressUpdate::Last, StressUpdate::ModifiedLast] {
        let mut simulation = Variant::TpmVp.build_2d(&scene, &settings(allowed)).unwrap();
        simulation.step(DT).unwrap();
    }
}
