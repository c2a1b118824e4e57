//! The column of one offset, and what both studies measure.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::sudden_load::PERIODS;
use super::{Parameters, Study};
use crate::exact::hydrostatic_column::HydrostaticColumn;
use crate::exact::loaded_column::LoadedColumn;

/// h, m.
pub(super) const SPACING: f64 = 0.05;
/// g, m/s².
const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// Cells across.
const WIDTH: usize = 4;
/// Empty cells above the highest column.
const AIR: usize = 1;
/// Spacing of the points, cells.
const POINT_SPACING: f64 = 0.5;

/// g H/c² of the highest column.
const fn compression(study: Study) -> f64 {
    match study {
        Study::Hydrostatic | Study::Settled => 1e-3,
        Study::SuddenLoad => 1e-4,
    }
}

/// The column of one offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setup {
    /// H, m.
    pub(super) height: f64,
    /// c, m/s.
    pub(super) sound_speed: f64,
    /// Steps in all.
    pub(super) steps: u64,
    /// Time step, s: at most that of the Courant number, a whole number of them in a period of the wave.
    pub(super) dt: f64,
}

impl Setup {
    /// With θ between 0 and 1.
    pub(super) fn new(parameters: &Parameters, theta: f64) -> Self {
        let highest = (parameters.cells + 1) as f64 * SPACING;
        let sound_speed = (GRAVITY * highest / compression(parameters.study)).sqrt();
        let height = (parameters.cells as f64 + theta) * SPACING;
        let largest = parameters.courant * full_cell_step(sound_speed);
        let duration = parameters.duration * height / sound_speed;
        // A whole number for each period of the wave.
        let periods = PERIODS as f64;
        let steps = (duration / periods / largest).ceil() * periods;
        Self { height, sound_speed, steps: steps as u64, dt: duration / steps }
    }

    /// Time step of a Courant number in full cells, s.
    pub(super) fn stable_step(&self, courant: f64) -> f64 {
        courant * full_cell_step(self.sound_speed)
    }

    /// √(gH), m/s.
    pub(super) fn speed(&self) -> f64 {
        (GRAVITY * self.height).sqrt()
    }

    /// ρ₀ g H, Pa.
    pub(super) fn static_pressure(&self) -> f64 {
        DENSITY * GRAVITY * self.height
    }

    /// The equilibrium.
    pub(super) fn at_rest(&self) -> HydrostaticColumn {
        HydrostaticColumn {
            height: self.height,
            gravity: GRAVITY,
            density: DENSITY,
            sound_speed: self.sound_speed,
        }
    }

    /// The wave.
    pub(super) fn loaded(&self) -> LoadedColumn {
        LoadedColumn {
            height: self.height,
            gravity: GRAVITY,
            density: DENSITY,
            sound_speed: self.sound_speed,
        }
    }

    /// Lower and upper end of each row of points, m, from the floor up.
    ///
    /// What is left below the lattice joins the lowest row if it is thinner than half of one.
    pub(super) fn rows(&self) -> Vec<[f64; 2]> {
        let thickness = POINT_SPACING * SPACING;
        let n_rows = (self.height / thickness).round() as usize;
        let top = |row: usize| self.height - (n_rows - 1 - row) as f64 * thickness;
        (0..n_rows).map(|row| [if row == 0 { 0.0 } else { top(row - 1) }, top(row)]).collect()
    }

    /// Grid, boundaries and points.
    pub(super) fn scene(&self, parameters: &Parameters) -> Scene<2> {
        let column = self.at_rest();
        let across = POINT_SPACING * SPACING;
        let n_across = (WIDTH as f64 / POINT_SPACING).round() as usize;
        let mut points = Vec::new();
        for k in 0..n_across {
            for [lower, upper] in self.rows() {
                let middle = 0.5 * (lower + upper);
                let (density, mass) = match parameters.study {
                    Study::Hydrostatic | Study::Settled => {
                        (column.density(middle), column.mass(lower, upper))
                    }
                    Study::SuddenLoad => (DENSITY, DENSITY * (upper - lower)),
                };
                let position = [(k as f64 + 0.5) * across, middle];
                points.push(PointSpec::new(position, [0.0; 2], density, mass * across));
            }
        }
        let cells = [WIDTH, parameters.cells + 1 + AIR];
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [SPACING; 2], cells },
            [[Boundary::Periodic; 2], [Boundary::Slip, Boundary::Free]],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: self.sound_speed,
            },
            points,
        );
        scene.body_force = [0.0, -GRAVITY];
        scene
    }
}

/// Limit of the time step in full cells h/(c√2), s.
fn full_cell_step(sound_speed: f64) -> f64 {
    SPACING / (sound_speed * std::f64::consts::SQRT_2)
}

/// Mean pressure and mean exact pressure over the points of the lowest cells, Pa.
pub(super) fn base(state: &Observation<2>, exact: impl Fn(f64) -> f64) -> [f64; 2] {
    let is_base = |point: &&PointState<2>| point.position[1] < SPACING;
    let (mut count, mut sums) = (0.0, [0.0; 2]);
    for point in state.points.iter().filter(is_base) {
        count += 1.0;
        sums[0] += point.pressure;
        sums[1] += exact(point.position[1]);
    }
    sums.map(|sum| sum / count)
}
