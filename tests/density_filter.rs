//! Differences of density that no fit sees are taken off by the filter, and fields that fits see stay.

use crate::common::near;
use crate::common::scenes::{Block, Build, DENSITY, SPACING};
use transpoint::scene::{Boundary, Scene};
use transpoint::variants::{Projection, ProjectionKind};
use transpoint::{Settings, Variant};

/// A step so short that nothing else happens.
const INSTANT: f64 = 1e-12;

/// Densities by identifier after a step of no duration with the filter.
fn filtered<const D: usize>(scene: &Scene<D>, order: u32) -> Vec<f64>
where
    Scene<D>: Build<D>,
{
    let filter = Projection { kind: ProjectionKind::AllAndDensity, order, interval: 1 };
    let settings = Settings { projection: Some(filter), ..Settings::default() };
    let mut simulation = scene.build(Variant::TpmVpQuadratic, &settings);
    simulation.step(INSTANT).unwrap();
    assert_eq!(simulation.counters().n_projections, 1);
    simulation.observe().points.iter().map(|point| point.density).collect()
}

/// A closed box with displaced points, whose densities are `field` of the place in cells and of the point's number.
fn box_with<const D: usize>(jitter: f64, field: impl Fn([f64; D], usize) -> f64) -> Scene<D> {
    let mut block = Block::<D>::full(6, Boundary::Slip);
    block.jitter = jitter;
    let mut scene = block.scene();
    for (k, point) in scene.points.iter_mut().enumerate() {
        let place = std::array::from_fn(|axis| point.position[axis] / SPACING[axis]);
        point.density = DENSITY * (1.0 + field(place, k));
    }
    scene
}

/// Every other of the points of a lattice has more: fits at centers see the mean, but in cells at walls, which have
/// neighbours on one side only. Less than a hundredth is left.
#[test]
fn what_alternates_from_point_to_point_vanishes() {
    let scene = box_with::<2>(0.0, |_, k| if (k + k / 12) % 2 == 0 { 1e-3 } else { -1e-3 });
    for density in filtered(&scene, 3) {
        near("density", density, DENSITY, 1e-5 * DENSITY).unwrap();
    }
}

/// Cells know one or two numbers of their four points: of noise in the densities a quarter at least is gone.
#[test]
fn noise_is_damped() {
    let noise = |k: usize| 1e-3 * ((k * k) as f64 * 0.77).sin();
    let rms = |densities: &[f64]| {
        let squares = densities.iter().map(|density| (density / DENSITY - 1.0).powi(2));
        (squares.sum::<f64>() / densities.len() as f64).sqrt()
    };
    let scene = box_with::<2>(0.3, |_, k| noise(k));
    let before: Vec<_> = scene.points.iter().map(|point| point.density).collect();
    let share = rms(&filtered(&scene, 3)) / rms(&before);
    assert!(share < 0.75, "{share}");
}

/// Linear fits and B-splines that continue linearly beyond walls keep a slope to round-off.
#[test]
fn a_linear_field_stays() {
    fn check<const D: usize>()
    where
        Scene<D>: Build<D>,
    {
        for slope in [1e-3, 1e-5] {
            let scene = box_with::<D>(0.3, |place, _| slope * place.iter().sum::<f64>());
            for (k, density) in filtered(&scene, 3).into_iter().enumerate() {
                let exact = scene.points[k].density;
                near("density", density, exact, 1e-13 * DENSITY).unwrap();
            }
        }
    }
    check::<1>();
    check::<2>();
    check::<3>();
}

/// Near a free surface fits have too few neighbours: densities stay as they are.
#[test]
fn points_at_a_surface_keep_theirs() {
    let mut block = Block::<2>::full(8, Boundary::Free);
    block.fluid = [[1.0, 3.0], [1.0, 3.0]];
    let mut scene = block.scene();
    for (k, point) in scene.points.iter_mut().enumerate() {
        point.density = DENSITY * (1.0 + 1e-6 * (k as f64).sin());
    }
    for (k, density) in filtered(&scene, 3).into_iter().enumerate() {
        near("density", density, scene.points[k].density, 1e-9 * DENSITY).unwrap();
    }
}

#[test]
fn carried_fields_are_refused() {
    let filter = Projection { kind: ProjectionKind::AllAndDensity, order: 2, interval: 1 };
    let settings = Settings { projection: Some(filter), ..Settings::default() };
    let error = Variant::Mpm.build_2d(&Block::full(4, Boundary::Slip).scene(), &settings).err();
    assert_eq!(error.unwrap().field, "settings.projection.kind");
}
