//! Masses, energies and front of the water in the channel.

use transpoint::Simulation;
use transpoint::simulation::PointState;

use super::Parameters;
use super::scene::{DOMAIN, GRAVITY};

/// Names of the columns of [`State::values`].
pub(super) const COLUMNS: [&str; 7] =
    ["mass", "grid-mass", "kinetic", "potential", "front", "left", "points"];

/// What is summed over the points beyond the inlet plane at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct State {
    /// Time, s.
    pub(super) time: f64,
    /// Σ m, kg.
    pub(super) mass: f64,
    /// Mass on the nodes less that of the inlet's column, kg; not a number before the first step.
    pub(super) grid_mass: f64,
    /// Kinetic and potential energy, J.
    pub(super) energies: [f64; 2],
    /// Largest x, m.
    pub(super) front: f64,
    /// Mass that has left by now, kg.
    pub(super) left: f64,
    /// Largest speed, m/s.
    pub(super) speed: f64,
    /// Number of points, those of the inlet too.
    pub(super) points: usize,
}

impl State {
    /// Sums over the points of a simulation.
    pub(super) fn of(simulation: &dyn Simulation<2>, parameters: &Parameters) -> Self {
        let mut state = Self {
            time: simulation.time(),
            left: simulation.ledger().left().conserved.mass,
            points: simulation.n_points(),
            ..Self::default()
        };
        let mut column = Column::new(parameters);
        simulation.visit_points(&mut |point| {
            let [x, y] = point.position;
            let mass = point.mass * share(x, parameters.edge());
            let square: f64 = point.velocity.iter().map(|v| v * v).sum();
            state.mass += mass;
            column.add(point, point.mass - mass);
            state.energies[0] += 0.5 * mass * square;
            state.energies[1] += mass * GRAVITY * y;
            state.front = state.front.max(x);
            state.speed = state.speed.max(square.sqrt());
        });
        let on_nodes = simulation.grid_mass();
        state.grid_mass = if on_nodes > 0.0 { on_nodes - column.mass() } else { f64::NAN };
        state
    }

    /// Kinetic and potential energy, J.
    pub(super) const fn energy(&self) -> f64 {
        self.energies[0] + self.energies[1]
    }

    /// Everything but time and speed, in the order of [`COLUMNS`].
    pub(super) const fn values(&self) -> [f64; COLUMNS.len()] {
        let [kinetic, potential] = self.energies;
        let points = self.points as f64;
        [self.mass, self.grid_mass, kinetic, potential, self.front, self.left, points]
    }
}

/// The part of a square about x that lies beyond the plane x = 0: a lattice that slides in brings its mass
/// evenly, not a column of points at a time.
pub(super) fn share(x: f64, edge: f64) -> f64 {
    (x / edge + 0.5).clamp(0.0, 1.0)
}

/// The column of cells left of the inlet plane, as the quadrature sees it.
struct Column {
    spacing: f64,
    /// Whether full cells have one sample for all of their volume.
    has_full_cells: bool,
    /// Number of points of the cells of this column and of the next, from the bed.
    counts: Vec<[u32; 2]>,
    /// Σ ρ of the points and Σ m of their parts left of the plane, kg.
    sums: Vec<[f64; 2]>,
}

impl Column {
    fn new(parameters: &Parameters) -> Self {
        let rows = (DOMAIN[1] / parameters.spacing).round() as usize;
        Self {
            spacing: parameters.spacing,
            has_full_cells: parameters.settings.rearrangement.is_some(),
            counts: vec![[0; 2]; rows],
            sums: vec![[0.0; 2]; rows],
        }
    }

    /// Takes a point into account, `left` being the mass of its part left of the plane.
    fn add(&mut self, point: &PointState<2>, left: f64) {
        let [x, y] = point.position;
        if x >= self.spacing {
            return;
        }
        let row = ((y / self.spacing) as usize).min(self.counts.len() - 1);
        self.sums[row][1] += left;
        self.counts[row][usize::from(x >= 0.0)] += 1;
        if x < 0.0 {
            self.sums[row][0] += point.density;
        }
    }

    /// Mass on the nodes from this column, kg: all of a cell without an empty neighbour, else the points'.
    fn mass(&self) -> f64 {
        let last = self.counts.len() - 1;
        let cell = |row: usize| {
            let around = &self.counts[row.saturating_sub(1)..=(row + 1).min(last)];
            let full = around.iter().flatten().all(|&count| count > 0);
            let [densities, left] = self.sums[row];
            if full && self.has_full_cells {
                densities / f64::from(self.counts[row][0]) * self.spacing * self.spacing
            } else {
                left
            }
        };
        (0..=last).map(cell).sum()
    }
}
