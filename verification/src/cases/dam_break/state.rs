//! Energies, front and heights of the water.

use transpoint::Simulation;
use transpoint::scene::GridSpec;
use transpoint::simulation::PointState;

use super::scene::{DENSITY, GRAVITY, SOUND_SPEED, UP, scaled_time};
use crate::reference::dam_break::VofQuantity;

/// Places of the gauges of height, m.
const GAUGES: [f64; 2] = [2.228, 2.725];

/// Names of the columns of [`State::values`].
pub(super) const COLUMNS: [&str; 13] = [
    "kinetic",
    "potential",
    "compression",
    "mass",
    "grid-mass",
    "points",
    "front",
    "depth2228",
    "top2228",
    "depth2725",
    "top2725",
    "run-up",
    "left",
];

/// What is summed over all points at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct State {
    /// T.
    pub(super) time: f64,
    /// Kinetic, potential and compression energy, J (per metre of depth in 2D).
    pub(super) energies: [f64; 3],
    /// Nominal mass, kg.
    pub(super) mass: f64,
    /// Mass on the nodes, kg; zero before the first step.
    pub(super) grid_mass: f64,
    /// Number of points.
    pub(super) points: usize,
    /// Largest x, m.
    pub(super) front: f64,
    /// Volume in the column of cells of each gauge over its area, m.
    pub(super) depths: [f64; 2],
    /// Largest height in it, m.
    pub(super) tops: [f64; 2],
    /// Largest height in the last column of cells, m.
    pub(super) run_up: f64,
    /// Largest height in the first column of cells, m.
    pub(super) left: f64,
}

impl State {
    /// Sums over the points of a simulation on a grid.
    pub(super) fn of<const D: usize>(grid: &GridSpec<D>, simulation: &dyn Simulation<D>) -> Self {
        let mut state = Self {
            time: scaled_time(simulation.time()),
            grid_mass: simulation.grid_mass(),
            points: simulation.n_points(),
            ..Self::default()
        };
        let h = grid.spacing[0];
        let column = |x: f64| (x / h) as usize;
        let (gauges, last) = (GAUGES.map(column), grid.cells[0] - 1);
        // The area of a column of cells: its width times the depth of the tank.
        let depth: f64 =
            (UP + 1..D).map(|axis| grid.cells[axis] as f64 * grid.spacing[axis]).product();
        let area = h * depth;
        simulation.visit_points(&mut |point: &PointState<D>| {
            let y = point.position[UP];
            for (sum, energy) in state.energies.iter_mut().zip(energies(point)) {
                *sum += energy;
            }
            state.mass += point.mass;
            state.front = state.front.max(point.position[0]);
            let at = column(point.position[0]);
            if at == 0 {
                state.left = state.left.max(y);
            }
            if at >= last {
                state.run_up = state.run_up.max(y);
            }
            for (gauge, place) in gauges.into_iter().enumerate() {
                if at == place {
                    state.depths[gauge] += point.volume() / area;
                    state.tops[gauge] = state.tops[gauge].max(y);
                }
            }
        });
        state
    }

    /// Sum of the energies, J.
    pub(super) fn total(&self) -> f64 {
        self.energies.iter().sum()
    }

    /// What a volume-of-fluid run has recorded, too; not a number for anything but heights.
    pub(super) fn height(&self, quantity: VofQuantity) -> f64 {
        match quantity {
            VofQuantity::FrontAny => self.front,
            VofQuantity::Depth2228 => self.depths[0],
            VofQuantity::Top2228 => self.tops[0],
            VofQuantity::Depth2725 => self.depths[1],
            VofQuantity::Top2725 => self.tops[1],
            VofQuantity::RunUp => self.run_up,
            VofQuantity::HeightLeft => self.left,
            _ => f64::NAN,
        }
    }

    /// Everything but the time, in the order of [`COLUMNS`].
    pub(super) fn values(&self) -> [f64; COLUMNS.len()] {
        let [kinetic, potential, compression] = self.energies;
        [
            kinetic,
            potential,
            compression,
            self.mass,
            self.grid_mass,
            self.points as f64,
            self.front,
            self.depths[0],
            self.tops[0],
            self.depths[1],
            self.tops[1],
            self.run_up,
            self.left,
        ]
    }
}

/// Kinetic, potential and compression energy of a point, J; the last is m ∫ p/ρ² dρ from ρ₀.
fn energies<const D: usize>(point: &PointState<D>) -> [f64; 3] {
    let speed: f64 = point.velocity.iter().map(|v| v * v).sum();
    let ratio = point.density / DENSITY;
    let compression = SOUND_SPEED.powi(2) * (libm::log(ratio) + 1.0 / ratio - 1.0);
    [0.5 * speed, GRAVITY * point.position[UP], compression].map(|energy| point.mass * energy)
}
