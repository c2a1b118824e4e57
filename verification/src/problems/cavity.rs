//! Problem `cavity`: a square cavity whose lid moves, at Re = 100, against the table of \[Ghia1982\].
//!
//! L = 1 m, U = 1 m/s, c₀ = 10 m/s, no slip, to t = 12 L/U, when the flow no longer changes. The velocities are read at
//! the places of the table on the two lines through the center, walls left out, by a linear fit to the points within
//! a cell; the error is the root mean square over all 30 places, over U. The table itself is good to about 1.5 % of its
//! values.
//!
//! The cavity lies on its side: the lid is the face x = L and moves along y, so that the table's x and y change places.
//! The faces of the last axis decide on the corners, and at those ends of the lid the fluid is at rest; otherwise points
//! would be carried out through the wall that the lid runs into.
//!
//! The lid has its velocity from the start. Points know of it only if they start with what the nodes say: v falls from
//! U to zero within the cells at the lid, as otherwise no method with FLIP learns that the lid moves
//! (case `shear-startup`).

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::measure::cell_centers;
use crate::reference::lid_cavity::{self, Line};

/// L, m.
const LENGTH: f64 = 1.0;
/// U, m/s.
const LID: f64 = 1.0;
/// U L/ν.
const REYNOLDS: f64 = 100.0;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀, m/s.
const SOUND_SPEED: f64 = 10.0;
/// End, L/U.
const END: f64 = 12.0;

/// The problem `cavity`.
#[derive(Clone, Copy, Debug)]
pub struct LidCavity;

impl Problem<2> for LidCavity {
    fn name(&self) -> &'static str {
        "cavity"
    }

    fn about(&self) -> &'static str {
        "square cavity with a moving lid at Re = 100, steady profiles on the center lines (table of [Ghia1982])"
    }

    fn levels(&self) -> &'static [usize] {
        &[8, 12, 16, 20]
    }

    fn spacing(&self, cells: usize) -> f64 {
        LENGTH / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[ErrorKind { quantity: "velocity", norm: "rms-over-lid" }]
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let counts = [cells * per_axis; 2];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|position| {
                let share = (1.0 - (LENGTH - position[0]) / h).max(0.0);
                let slope = if share > 0.0 { LID / h } else { 0.0 };
                PointSpec {
                    velocity_gradient: [[0.0, 0.0], [slope, 0.0]],
                    ..PointSpec::new(
                        position,
                        [0.0, LID * share],
                        DENSITY,
                        DENSITY * spacing * spacing,
                    )
                }
            })
            .collect();
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [cells; 2] },
            [[Boundary::NoSlip, Boundary::Velocity([0.0, LID, 0.0])], [Boundary::NoSlip; 2]],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            points,
        );
        scene.viscosity = Some(LID * LENGTH / REYNOLDS);
        let settings = free_surface::printed(per_axis);
        SetUp { scene, settings, end: END * LENGTH / LID }
    }

    fn gauge(&self, resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Profiles { spacing: self.spacing(resolution.cells) })
    }
}

struct Profiles {
    /// Cell size, m.
    spacing: f64,
}

impl Gauge<2> for Profiles {
    /// Not a number where the table is damaged, which a test of its own would say.
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let points = end.simulation.observe().points;
        let positions: Vec<_> = points.iter().map(|point| point.position).collect();
        let velocities: Vec<_> = points.iter().map(|point| point.velocity).collect();
        let (mut count, mut squares) = (0.0, 0.0);
        // Turned: u along the vertical line of the table is v along the axis x.
        for (line, component) in [(Line::Vertical, 1), (Line::Horizontal, 0)] {
            for (along, value) in lid_cavity::profile(line).unwrap_or_default() {
                let mut place = [0.5 * LENGTH; 2];
                place[1 - component] = along * LENGTH;
                let found =
                    cell_centers::at(place, [self.spacing; 2], &positions, &velocities)[component];
                count += 1.0;
                squares += (found / LID - value).powi(2);
            }
        }
        vec![(squares / count).sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_is_what_the_nodes_of_the_lid_say() {
        let resolution = Resolution { cells: 8, points_per_axis: 2, jitter: 0.0, seed: 1 };
        let points = LidCavity.set_up(&resolution).scene.points;
        let fastest = points.iter().map(|point| point.velocity[1]).fold(0.0, f64::max);
        assert!((fastest - 0.75).abs() < 1e-12, "{fastest}");
        assert_eq!(points.iter().filter(|point| point.velocity[1] > 0.0).count(), 2 * 16);
    }
}
