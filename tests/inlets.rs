//! Inlets and outflows: uniform flow stays uniform, and what comes in and goes out is written down.

use crate::common::scenes::{Block, Build, DENSITY, SOUND_SPEED, SPACING};
use transpoint::scene::{
    Boundary, EquationOfStateSpec, GridSpec, InletProfile, InletSpec, Scene, Side, Supply,
};
use transpoint::variants::{Fill, FillMass, FillPoints, PointVolume, Rearrangement};
use transpoint::{Settings, Simulation, Variant};

/// Speed of the flow, m/s.
const SPEED: f64 = 2.0;
/// A step at Courant number 0.3 of the smallest cells.
const DT: f64 = 0.3 * 0.09 / SOUND_SPEED;

/// An inlet over a face, or over its lower cells along the last axis.
fn inlet<const D: usize>(
    cells: [usize; D],
    side: Side,
    supply: Supply,
    open: Option<usize>,
) -> InletSpec<D> {
    let mut upper: [f64; D] = std::array::from_fn(|axis| cells[axis] as f64 * SPACING[axis]);
    if let Some(open) = open {
        upper[D - 1] = open as f64 * SPACING[D - 1];
    }
    let mut velocity = [0.0; D];
    velocity[0] = if side == Side::Lower { SPEED } else { -SPEED };
    InletSpec {
        axis: 0,
        side,
        lower: [0.0; D],
        upper,
        velocity,
        profile: InletProfile::Uniform,
        hydrostatic: false,
        points_per_axis: 2,
        supply,
    }
}

/// A box between slip walls with an inlet on one side and an outflow on the other.
fn channel<const D: usize>(cells: [usize; D], inlet: InletSpec<D>) -> Scene<D> {
    let spacing = std::array::from_fn(|axis| SPACING[axis]);
    let mut boundaries = [[Boundary::Slip; 2]; D];
    boundaries[0][usize::from(inlet.side == Side::Lower)] = Boundary::OUTFLOW;
    let law = EquationOfStateSpec::WeaklyCompressible {
        reference_density: DENSITY,
        sound_speed: SOUND_SPEED,
    };
    let mut scene =
        Scene::new(GridSpec { origin: [0.0; D], spacing, cells }, boundaries, law, Vec::new());
    scene.inlets.push(inlet);
    scene
}

/// Fills the layers of cells that the inlet leaves free.
fn filled<const D: usize>(mut scene: Scene<D>) -> Scene<D> {
    let (cells, inlet) = (scene.grid.cells, scene.inlets[0]);
    let layers = if inlet.supply == Supply::Flux { 1.0 } else { 2.0 };
    let mut block = Block::<D>::full(4, Boundary::Slip);
    block.cells = cells;
    block.fluid = std::array::from_fn(|axis| [0.0, cells[axis] as f64]);
    if inlet.side == Side::Lower {
        block.fluid[0][0] = layers;
    } else {
        block.fluid[0][1] -= layers;
    }
    scene.points = block.scene().points;
    for point in &mut scene.points {
        point.velocity = inlet.velocity;
    }
    scene
}

fn supplies(variant: Variant) -> Vec<Supply> {
    let rebuilds = variant.name().starts_with("tpm");
    if rebuilds { vec![Supply::Flux, Supply::Columns] } else { vec![Supply::Flux] }
}

fn mass<const D: usize>(simulation: &dyn Simulation<D>) -> f64 {
    simulation.conserved().mass
}

/// Mass at the start, what came in and went out, and the mass now agree.
fn check_ledger<const D: usize>(simulation: &dyn Simulation<D>, start: f64, name: &str) {
    let ledger = simulation.ledger();
    let expected = start + ledger.entered().conserved.mass - ledger.left().conserved.mass;
    let found = mass(simulation);
    assert!((found / expected - 1.0).abs() < 1e-12, "{name}: {found} {expected}");
}

fn check_uniform<const D: usize>(cells: [usize; D])
where
    Scene<D>: Build<D>,
{
    let variants = [
        Variant::Tpm,
        Variant::TpmVpQuadratic,
        Variant::Mpm,
        Variant::Gimp,
        Variant::Bspline2,
        Variant::Apic,
        Variant::ConvectedGimp,
        Variant::Staggered,
        Variant::Tpic,
        Variant::MlsMpm,
        Variant::Fmpm4,
        Variant::SulskyGong,
    ];
    for variant in variants {
        for supply in supplies(variant) {
            for side in [Side::Lower, Side::Upper] {
                let name = format!("{} {supply:?} {side:?} {D}D", variant.name());
                let scene = filled(channel(cells, inlet(cells, side, supply, None)));
                let mut simulation = scene.build(variant, &Settings::default());
                let start = mass(simulation.as_ref());
                for step in 0..120 {
                    simulation
                        .step(DT)
                        .unwrap_or_else(|error| panic!("{name} step {step}: {error}"));
                }
                let counters = simulation.counters();
                assert!(counters.n_points_entered > 0 && counters.n_points_removed > 0, "{name}");
                for point in simulation.observe().points {
                    for axis in 0..D {
                        let error = point.velocity[axis] - scene.inlets[0].velocity[axis];
                        assert!(error.abs() < 1e-9, "{name}: {point:?}");
                    }
                    assert!(point.pressure.abs() < 1e-7, "{name}: {point:?}");
                }
                check_ledger(simulation.as_ref(), start, &name);
            }
        }
    }
}

#[test]
fn uniform_flow_stays_uniform_in_2d() {
    check_uniform([7, 4]);
}

#[test]
fn uniform_flow_stays_uniform_in_3d() {
    check_uniform([6, 3, 3]);
}

/// What has come into an empty channel is the flux to within one row of points.
#[test]
fn the_flux_is_that_of_the_opening() {
    let cells = [12, 8];
    let area = 3.0 * SPACING[1];
    for variant in [Variant::TpmVpQuadratic, Variant::TpmVpConstant, Variant::Mpm, Variant::Apic] {
        for supply in supplies(variant) {
            let scene = channel(cells, inlet(cells, Side::Lower, supply, Some(3)));
            let settings =
                Settings { point_volume: PointVolume::CellCenter, ..Settings::default() };
            let mut simulation = scene.build(variant, &settings);
            let start = mass(simulation.as_ref());
            let name = format!("{} {supply:?}", variant.name());
            for step in 0..60 {
                simulation.step(0.5 * DT).unwrap_or_else(|e| panic!("{name} step {step}: {e}"));
                let entered = simulation.ledger().entered().conserved.mass;
                let flux = DENSITY * SPEED * area * simulation.time();
                let row = DENSITY * area * 0.5 * SPACING[0];
                assert!(
                    entered <= flux + 1e-9 && entered > flux - 2.1 * row,
                    "{name}: {entered} {flux}"
                );
                check_ledger(simulation.as_ref(), start, &name);
            }
            assert!(simulation.counters().n_points_entered > 0, "{name}");
        }
    }
}

/// The first column stays what it is prescribed to be, whatever the flow does.
#[test]
fn the_first_column_is_prescribed() {
    let cells = [8, 6];
    for supply in [Supply::Flux, Supply::Columns] {
        let spec = InletSpec {
            profile: InletProfile::Parabolic,
            hydrostatic: true,
            ..inlet(cells, Side::Lower, supply, Some(3))
        };
        let mut scene = channel(cells, spec);
        scene.body_force = [0.0, -1.0];
        let settings = Settings { point_volume: PointVolume::CellCenter, ..Settings::default() };
        let mut simulation = scene.build(Variant::TpmVpQuadratic, &settings);
        for _ in 0..40 {
            simulation.step(0.5 * DT).unwrap();
        }
        let column: Vec<_> = simulation
            .observe()
            .points
            .into_iter()
            .filter(|point| point.position[0] < SPACING[0])
            .collect();
        // A row of the sliding lattice has one point or two in the column.
        assert!(column.len() >= 6, "{supply:?}: {}", column.len());
        for point in column {
            let velocity = spec.velocity_at(point.position);
            let pressure = spec.pressure_at(point.position, DENSITY, [0.0, -1.0]);
            assert!((point.velocity[0] - velocity[0]).abs() < 1e-12, "{supply:?} {point:?}");
            assert!((point.pressure - pressure).abs() < 1e-8, "{supply:?} {point:?}");
        }
    }
}

/// Beyond the opening the column is a wall: water thrown at it does not get in.
#[test]
fn the_rest_of_the_column_is_a_wall() {
    let cells = [8, 6];
    let mut scene = channel(cells, inlet(cells, Side::Lower, Supply::Flux, Some(2)));
    let block =
        Block { cells, fluid: [[1.0, 4.0], [3.0, 6.0]], ..Block::<2>::full(4, Boundary::Slip) };
    scene.points = block.scene().points;
    for point in &mut scene.points {
        point.velocity = [-SPEED, 0.0];
    }
    let mut simulation = scene.build(Variant::Apic, &Settings::default());
    for _ in 0..60 {
        simulation.step(0.5 * DT).unwrap();
    }
    let points = simulation.observe().points;
    let beyond =
        points.iter().filter(|p| p.position[0] < SPACING[0] && p.position[1] > 2.5 * SPACING[1]);
    assert_eq!(beyond.count(), 0);
}

#[test]
fn results_do_not_depend_on_threads_and_rearrangement_goes_on() {
    let cells = [12, 8];
    let fill = Fill { points: FillPoints::Center, mass: FillMass::Donated };
    let rearrangement =
        Rearrangement { fill: Some(fill), most_points: Some(8), ..Rearrangement::default() };
    let settings = Settings {
        point_volume: PointVolume::CellCenter,
        rearrangement: Some(rearrangement),
        ..Settings::default()
    };
    let run = |threads: usize, supply| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| {
            let mut scene = channel(cells, inlet(cells, Side::Lower, supply, Some(4)));
            scene.body_force = [0.0, -1.0];
            let mut simulation = scene.build(Variant::TpmVpQuadratic, &settings);
            for _ in 0..150 {
                simulation.step(0.5 * DT).unwrap();
            }
            let points = simulation.observe().points;
            let mut ids: Vec<u32> = points.iter().map(|point| point.id).collect();
            ids.dedup();
            assert_eq!(ids.len(), points.len(), "identifiers are unique");
            format!("{points:?} {:?}", simulation.counters())
        })
    };
    for supply in [Supply::Flux, Supply::Columns] {
        let one = run(1, supply);
        assert_eq!(one, run(2, supply));
        assert_eq!(one, run(7, supply));
    }
}

#[test]
fn bad_inlets_are_refused_by_name() {
    let cells = [8, 6];
    let good = inlet(cells, Side::Lower, Supply::Flux, Some(3));
    let field = |change: &dyn Fn(&mut Scene<2>), variant: Variant| {
        let mut scene = channel(cells, good);
        change(&mut scene);
        variant.build_2d(&scene, &Settings::default()).err().map(|error| error.field)
    };
    let refused = |change: &dyn Fn(&mut Scene<2>), expected: &str| {
        assert_eq!(field(change, Variant::Mpm).as_deref(), Some(expected));
    };
    assert_eq!(field(&|_| {}, Variant::Mpm), None);
    refused(&|scene| scene.inlets[0].axis = 2, "inlets[0].axis");
    refused(&|scene| scene.inlets[0].upper[1] += 0.3 * SPACING[1], "inlets[0].upper[1]");
    refused(&|scene| scene.inlets[0].lower[1] = -SPACING[1], "inlets[0].lower[1]");
    refused(&|scene| scene.boundaries[0][0] = Boundary::Free, "boundaries[0]");
    refused(&|scene| scene.grid.cells[0] = 2, "grid.cells[0]");
    refused(&|scene| scene.inlets[0].supply = Supply::Columns, "inlets[0].supply");
    let columns = |scene: &mut Scene<2>| scene.inlets[0].supply = Supply::Columns;
    assert_eq!(field(&columns, Variant::TpmVp), None);
    refused(&|scene| scene.energy = true, "inlets[0]");
}
