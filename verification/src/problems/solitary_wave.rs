//! Problem `solitary-wave`: a solitary wave of a fifth of the depth runs six depths along a tank.
//!
//! h = 1 m, ε = a/h = 0.2, c₀ = 10 √(g (h + a)), slip walls eight depths from the crest at the start and at the end. The
//! answer is that of [`SolitaryWave`], of third order: what it leaves out is 0.3 % of ρ g h, 2 % of the wave's pressure,
//! and a weakly compressible wave is off by about (c/c₀)² = 1 %.
//!
//! The points are those of a jittered lattice over the depth at rest, stretched upwards to the surface, with the mass
//! of their stretched boxes. Height and place of the wave found are those of the wave that fits the velocities of the
//! points best,
//!
//! ```text
//! β, x_c:   Σ m |v − β u(x − x_c, y)|² → min
//! ```
//!
//! with u of the exact wave: no surface is needed. The error of the amplitude is |β − 1|, that of the celerity
//! |x_c − c t|/(c t).

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::solitary_wave::SolitaryWave;
use crate::measure::norms::L2;

const WAVE: SolitaryWave = SolitaryWave { depth: 1.0, height: 0.2, gravity: 9.81, density: 1000.0 };
/// From the crest to the walls at the start and at the end, depths.
const MARGIN: usize = 8;
/// Path, depths.
const PATH: usize = 6;
/// Room above the water at rest, depths.
const AIR: f64 = 0.5;
/// c₀/√(g (h + a)).
const STIFFNESS: f64 = 10.0;
/// Farthest place of the wave found from the exact one, depths, and passes of the search.
const SEARCH: (f64, usize) = (2.0, 40);

/// The problem `solitary-wave`.
#[derive(Clone, Copy, Debug)]
pub struct RunningWave;

fn sound_speed() -> f64 {
    STIFFNESS * (WAVE.gravity * WAVE.depth * (1.0 + WAVE.height)).sqrt()
}

/// Place of the crest, m.
fn crest(time: f64) -> f64 {
    MARGIN as f64 * WAVE.depth + WAVE.celerity() * time
}

impl Problem<2> for RunningWave {
    fn name(&self) -> &'static str {
        "solitary-wave"
    }

    fn about(&self) -> &'static str {
        "solitary wave of a fifth of the depth over six depths (third order in its height [Grimshaw1971])"
    }

    fn levels(&self) -> &'static [usize] {
        &[4, 5, 6, 8]
    }

    fn spacing(&self, cells: usize) -> f64 {
        WAVE.depth / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "velocity", norm: "relative-l2" },
            ErrorKind { quantity: "amplitude", norm: "relative" },
            ErrorKind { quantity: "celerity", norm: "relative" },
        ]
    }

    fn has_free_surface(&self) -> bool {
        true
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let long = (2 * MARGIN + PATH) * cells;
        let counts = [long * per_axis, cells * per_axis];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|[x, y]| {
                let from_crest = x - crest(0.0);
                let stretch = WAVE.surface(from_crest) / WAVE.depth;
                let place = [from_crest, y * stretch];
                let density = WAVE.density + WAVE.pressure(place) / sound_speed().powi(2);
                PointSpec::new(
                    [x, place[1]],
                    WAVE.velocity(place),
                    density,
                    density * spacing * spacing * stretch,
                )
            })
            .collect();
        let high = cells + (AIR * cells as f64).ceil() as usize;
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [long, high] },
            [[Boundary::Slip; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: WAVE.density,
                sound_speed: sound_speed(),
            },
            points,
        );
        scene.body_force = [0.0, -WAVE.gravity];
        let relaxation = free_surface::INFLOW_RELAXATION;
        let settings = free_surface::settings(per_axis, h, sound_speed(), relaxation);
        SetUp { scene, settings, end: PATH as f64 * WAVE.depth / WAVE.celerity() }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Fit)
    }
}

struct Fit;

/// Σ m v·u and Σ m |u|² with the wave's crest at a place, m.
fn products(points: &[PointState<2>], crest: f64) -> [f64; 2] {
    points.iter().fold([0.0; 2], |[product, square], point| {
        let [u, v] = WAVE.velocity([point.position[0] - crest, point.position[1]]);
        let along = u * point.velocity[0] + v * point.velocity[1];
        [product + point.mass * along, square + point.mass * (u * u + v * v)]
    })
}

/// The place of the crest that fits best, m, by the golden section.
fn best(points: &[PointState<2>], near: f64) -> f64 {
    let fit = |crest: f64| {
        let [product, square] = products(points, crest);
        product / square.sqrt()
    };
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let reach = SEARCH.0 * WAVE.depth;
    let (mut lower, mut upper) = (near - reach, near + reach);
    for _ in 0..SEARCH.1 {
        let inner = [upper - golden * (upper - lower), lower + golden * (upper - lower)];
        if fit(inner[0]) > fit(inner[1]) {
            upper = inner[1];
        } else {
            lower = inner[0];
        }
    }
    0.5 * (lower + upper)
}

impl Gauge<2> for Fit {
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let time = end.velocity_time();
        let mut points = end.simulation.observe().points;
        for point in &mut points {
            // The velocity is that of another instant: the point is taken to where it was then.
            for axis in 0..2 {
                point.position[axis] += (time - end.simulation.time()) * point.velocity[axis];
            }
        }
        let exact = crest(time);
        let mut velocity = L2::default();
        for point in &points {
            let [u, v] = WAVE.velocity([point.position[0] - exact, point.position[1]]);
            let error = (point.velocity[0] - u).powi(2) + (point.velocity[1] - v).powi(2);
            velocity.add(error, u * u + v * v, point.volume());
        }
        let found = best(&points, exact);
        let [product, square] = products(&points, found);
        vec![
            velocity.error() / velocity.exact(),
            (product / square - 1.0).abs(),
            ((found - exact) / (WAVE.celerity() * time)).abs(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problems::Problem;
    use transpoint::Variant;

    /// At the start the fit finds the wave that is there.
    #[test]
    fn the_fit_finds_the_wave_and_its_place() {
        let resolution = Resolution { cells: 4, points_per_axis: 2, jitter: 0.3, seed: 1 };
        let set_up = RunningWave.set_up(&resolution);
        let built = Variant::Mpm.build_2d(&set_up.scene, &set_up.settings);
        let points = built.expect("a simulation").observe().points;
        let found = best(&points, crest(0.0) + 0.3);
        assert!((found - crest(0.0)).abs() < 1e-6, "{found}");
        let [product, square] = products(&points, found);
        assert!((product / square - 1.0).abs() < 1e-9);
    }
}
