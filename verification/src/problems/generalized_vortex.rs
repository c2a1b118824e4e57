//! Problem `generalized-vortex`: an annulus of fluid, free all around, that a force turns and shears by a radian.
//!
//! 0.75 m ≤ R ≤ 1.25 m, to the time T/2 at which [`GeneralizedVortex`] has turned by G = 1 rad in the middle and not at
//! all at the rims: there the fluid is at rest, and the shear is 6. T = π s, so that the largest velocity is 1 m/s;
//! c₀ = 10 m/s. The motion is made by a field of force, \[Kamojjala2015\] has it for solids; it needs no pressure, so
//! every pressure is an error, and the answer is exact for a compressible fluid.
//!
//! The points are those of a jittered lattice between the rims. The error of the radius is that of √⟨R²⟩, over its value
//! at the start: points that are thrown out of their circles.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, ForceField, GridSpec, PointSpec};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::generalized_vortex::GeneralizedVortex;

const VORTEX: GeneralizedVortex =
    GeneralizedVortex { inner: 0.75, outer: 1.25, angle: 1.0, half_period: std::f64::consts::PI };
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀, m/s.
const SOUND_SPEED: f64 = 10.0;
/// Half of the box, widths of the annulus.
const HALF: usize = 3;

/// The problem `generalized-vortex`.
#[derive(Clone, Copy, Debug)]
pub struct TurnedAnnulus;

/// R_o − R_i, m.
fn width() -> f64 {
    VORTEX.outer - VORTEX.inner
}

/// From the middle of the box, whose lower corner is the origin, m.
fn place(position: [f64; 2]) -> [f64; 2] {
    position.map(|x| x - HALF as f64 * width())
}

fn points(resolution: &Resolution) -> Vec<PointSpec<2>> {
    let per_width = resolution.cells * resolution.points_per_axis;
    let spacing = width() / per_width as f64;
    let counts = [2 * HALF * per_width; 2];
    let is_fluid = |&[x, y]: &[f64; 2]| (VORTEX.inner..VORTEX.outer).contains(&x.hypot(y));
    lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
        .into_iter()
        .filter(|&position| is_fluid(&place(position)))
        .map(|position| PointSpec {
            velocity_gradient: VORTEX.velocity_gradient(place(position), 0.0),
            ..PointSpec::new(
                position,
                VORTEX.velocity(place(position), 0.0),
                DENSITY,
                DENSITY * spacing * spacing,
            )
        })
        .collect()
}

/// Σ m R² and Σ m.
fn moment(masses_and_places: impl Iterator<Item = (f64, [f64; 2])>) -> [f64; 2] {
    masses_and_places
        .fold([0.0; 2], |[moment, mass], (m, [x, y])| [moment + m * (x * x + y * y), mass + m])
}

impl Problem<2> for TurnedAnnulus {
    fn name(&self) -> &'static str {
        "generalized-vortex"
    }

    fn about(&self) -> &'static str {
        "annulus of fluid, free all around, turned and sheared by a field of force (exact, without pressure \
         [Kamojjala2015])"
    }

    fn levels(&self) -> &'static [usize] {
        &[4, 6, 8, 12]
    }

    fn spacing(&self, cells: usize) -> f64 {
        width() / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "velocity", norm: "rms-over-largest" },
            ErrorKind { quantity: "pressure", norm: "rms-over-dynamic" },
            ErrorKind { quantity: "radius", norm: "rms-over-start" },
        ]
    }

    fn has_free_surface(&self) -> bool {
        true
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((0.8, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let h = self.spacing(resolution.cells);
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [2 * HALF * resolution.cells; 2] },
            [[Boundary::Free; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            points(resolution),
        );
        let acceleration = |position, time| VORTEX.acceleration(place(position), time);
        scene.force_field = Some(ForceField::new(self.name(), acceleration));
        let relaxation = free_surface::INFLOW_RELAXATION;
        let settings =
            free_surface::settings(resolution.points_per_axis, h, SOUND_SPEED, relaxation);
        SetUp { scene, settings, end: 0.5 * VORTEX.half_period }
    }

    fn gauge(&self, resolution: &Resolution) -> Box<dyn Gauge<2>> {
        let points = points(resolution);
        let [moment, mass] = moment(points.iter().map(|point| (point.mass, place(point.position))));
        Box::new(Errors { square: moment / mass })
    }
}

struct Errors {
    /// ⟨R²⟩ at the start, m².
    square: f64,
}

impl Gauge<2> for Errors {
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let (time, velocity_time) = (end.simulation.time(), end.velocity_time());
        let points = end.simulation.observe().points;
        let (mut volume, mut velocity, mut pressure) = (0.0, 0.0, 0.0);
        for point in &points {
            let [x, y] = place(point.position);
            let radius = x.hypot(y);
            // Where the point was, or will be, at the time of its velocity.
            let back = VORTEX.turned(radius, velocity_time) - VORTEX.turned(radius, time);
            let (sine, cosine) = back.sin_cos();
            let then = [x * cosine - y * sine, x * sine + y * cosine];
            let [u, v] = VORTEX.velocity(then, velocity_time);
            let error = (point.velocity[0] - u).powi(2) + (point.velocity[1] - v).powi(2);
            volume += point.volume();
            velocity += point.volume() * error;
            pressure += point.volume() * point.pressure.powi(2);
        }
        let [moment, mass] = moment(points.iter().map(|point| (point.mass, place(point.position))));
        let largest = VORTEX.largest_speed();
        vec![
            (velocity / volume).sqrt() / largest,
            (pressure / volume).sqrt() / (DENSITY * largest * largest),
            ((moment / mass / self.square).sqrt() - 1.0).abs(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of the text above.
    #[test]
    fn the_annulus_is_as_described() {
        let resolution = Resolution { cells: 8, points_per_axis: 2, jitter: 0.3, seed: 1 };
        let set_up = TurnedAnnulus.set_up(&resolution);
        let mass: f64 = set_up.scene.points.iter().map(|point| point.mass).sum();
        assert!((mass / DENSITY / std::f64::consts::PI - 1.0).abs() < 0.01, "{mass}");
        assert!((VORTEX.largest_speed() - 1.0).abs() < 0.02, "{}", VORTEX.largest_speed());
        assert_eq!(VORTEX.turned(1.0, set_up.end), 1.0);
        let steepest = VORTEX.profile_slope(1.0 - 0.5 / 12.0_f64.sqrt());
        assert!((6.0..6.5).contains(&steepest), "{steepest}");
    }

    #[test]
    fn a_scene_with_a_field_of_force_is_not_written() {
        let resolution = Resolution { cells: 4, points_per_axis: 2, jitter: 0.0, seed: 1 };
        let mut scene = TurnedAnnulus.set_up(&resolution).scene;
        let error = serde_json::to_string(&scene).expect_err("a function").to_string();
        assert!(error.contains("generalized-vortex"), "{error}");
        scene.force_field = None;
        let text = serde_json::to_string(&scene).expect("plain data");
        assert_eq!(serde_json::from_str::<Scene<2>>(&text).expect("a scene"), scene);
    }
}
