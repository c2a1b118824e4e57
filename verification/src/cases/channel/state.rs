//! Masses, energies and front of the water in the channel.

use transpoint::Simulation;

use super::scene::GRAVITY;

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
    /// Mass on the nodes less Σ m left of the plane, kg; not a number before the first step.
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
    /// Sums over the points of a simulation whose points have squares of a given edge, m.
    pub(super) fn of(simulation: &dyn Simulation<2>, edge: f64) -> Self {
        let mut state = Self {
            time: simulation.time(),
            left: simulation.ledger().left().conserved.mass,
            points: simulation.n_points(),
            ..Self::default()
        };
        let mut before = 0.0;
        simulation.visit_points(&mut |point| {
            let [x, y] = point.position;
            let mass = point.mass * share(x, edge);
            let square: f64 = point.velocity.iter().map(|v| v * v).sum();
            state.mass += mass;
            before += point.mass - mass;
            state.energies[0] += 0.5 * mass * square;
            state.energies[1] += mass * GRAVITY * y;
            state.front = state.front.max(x);
            state.speed = state.speed.max(square.sqrt());
        });
        let on_nodes = simulation.grid_mass();
        state.grid_mass = if on_nodes > 0.0 { on_nodes - before } else { f64::NAN };
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
