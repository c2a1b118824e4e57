//! Cut cells with a balanced sample hold up a column at rest, and a lone point on a face does not strain its cell.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::variants::PointVolume;
use transpoint::{Scene, Settings, Variant};

const H: f64 = 0.1;
const GRAVITY: f64 = 10.0;
const DENSITY: f64 = 1000.0;
const SOUND_SPEED: f64 = 1000.0;
/// Full cells below the surface.
const DEEP: usize = 3;

/// Water at rest up to `offset` cells above the third face, rows of points half a cell apart from the surface down, each
/// with the density of its pressure. What does not fill a row at the floor joins the lowest one.
fn column(offset: f64) -> Scene<2> {
    let thickness = 0.5 * H;
    let height = (DEEP as f64 + offset) * H;
    let n_rows = (height / thickness).round() as usize;
    let mut points = Vec::new();
    for row in 0..n_rows {
        let upper = height - row as f64 * thickness;
        let lower = if row + 1 == n_rows { 0.0 } else { upper - thickness };
        let middle = 0.5 * (lower + upper);
        let density = DENSITY * (1.0 + GRAVITY * (height - middle) / SOUND_SPEED.powi(2));
        for k in 0..8 {
            let x = (f64::from(k) + 0.5) * thickness;
            let mass = density * (upper - lower) * thickness;
            points.push(PointSpec::new([x, middle], [0.0; 2], density, mass));
        }
    }
    let mut scene = Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [H; 2], cells: [4, DEEP + 3] },
        [[Boundary::Periodic; 2], [Boundary::Slip, Boundary::Free]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: DENSITY,
            sound_speed: SOUND_SPEED,
        },
        points,
    );
    scene.body_force = [0.0, -GRAVITY];
    scene
}

/// Largest change of velocity in the first step over that of a free fall.
fn first_change(point_volume: PointVolume, offset: f64) -> f64 {
    let settings = Settings { point_volume, ..Settings::default() };
    let mut simulation =
        Variant::TpmVpQuadratic.build_2d(&column(offset), &settings).expect("valid");
    let dt = simulation.stable_dt(0.5).dt;
    simulation.step(dt).expect("a step");
    let mut fastest: f64 = 0.0;
    simulation.visit_points(&mut |point| fastest = fastest.max(point.velocity[1].abs()));
    fastest / (GRAVITY * dt)
}

#[test]
fn balanced_samples_hold_up_a_column_wherever_its_surface_lies() {
    // At a quarter and three quarters of a cell the points lie on faces to the last bit.
    for twentieth in (1..20).filter(|twentieth| twentieth % 5 != 0) {
        let offset = f64::from(twentieth) / 20.0;
        // What is left is the compression by the water above, 4·10⁻⁶, which the weights of cells vary with.
        let balanced = first_change(PointVolume::Balanced, offset);
        assert!(balanced < 1e-4, "{offset}: {balanced}");
        // One row of points in the cut cell; two rows are half a cell deep in the mean, as if for the centre.
        if (0.25..0.75).contains(&offset) {
            let centered = first_change(PointVolume::CellCenter, offset);
            assert!(centered > 100.0 * balanced, "{offset}: {centered} and {balanced}");
        }
    }
}

#[test]
fn a_lone_point_on_a_face_does_not_strain_its_cell() {
    for place in [[3.0, 3.5], [3.5, 3.0], [3.0, 3.0]] {
        let point =
            PointSpec::new(place.map(|x| x * H), [0.3, 0.2], DENSITY, DENSITY * 0.25 * H * H);
        let scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [H; 2], cells: [8; 2] },
            [[Boundary::Free; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            vec![point],
        );
        let settings = Settings { point_volume: PointVolume::CellCenter, ..Settings::default() };
        for variant in [Variant::TpmVpQuadratic, Variant::TpmVpConstant, Variant::CellAdjoint] {
            let mut simulation = variant.build_2d(&scene, &settings).expect("valid");
            let dt = simulation.stable_dt(0.5).dt;
            for _ in 0..3 {
                simulation.step(dt).expect("a step");
            }
            simulation.visit_points(&mut |point| {
                assert!((point.density / DENSITY - 1.0).abs() < 1e-13, "{variant:?} {place:?}");
                assert!((point.velocity[0] - 0.3).abs() < 1e-12, "{variant:?} {place:?}");
            });
        }
    }
}
