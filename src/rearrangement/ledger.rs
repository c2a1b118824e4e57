//! What rearrangement did to mass, momentum and energy.

use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::simulation::Conserved;
use crate::solver::Solver;
use crate::step::ParticlesOf;

/// What is done to points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// Points put into numerical fractures.
    Fill,
    /// The points of a cell replaced by fewer.
    Reduce,
    /// Points pushed apart.
    Shift,
    /// Points split.
    Split,
}

impl EventKind {
    /// Every kind, in the order in which a step takes them.
    pub const ALL: [Self; 4] = [Self::Fill, Self::Reduce, Self::Shift, Self::Split];
}

/// Totals over some points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals<const D: usize> {
    /// Mass, momentum, angular momentum, kinetic and internal energy.
    pub conserved: Conserved<D>,
    /// −Σ m b·x with the acceleration b of the scene, and Σ ½ m Ω² |x − x_c|² of a central force, J.
    pub potential_energy: f64,
    /// Σ m ∫ p/ρ² dρ, J; zero for laws with an internal energy.
    pub compression_energy: f64,
}

impl<const D: usize> Totals<D> {
    /// Nothing.
    pub fn zero() -> Self {
        Self { conserved: Conserved::zero(), potential_energy: 0.0, compression_energy: 0.0 }
    }

    /// `self + factor · other`, entry by entry.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let (a, b) = (&self.conserved, &other.conserved);
        let sum = |a: f64, b: f64| a + factor * b;
        Self {
            conserved: Conserved {
                mass: sum(a.mass, b.mass),
                momentum: std::array::from_fn(|axis| sum(a.momentum[axis], b.momentum[axis])),
                angular_momentum: std::array::from_fn(|axis| {
                    sum(a.angular_momentum[axis], b.angular_momentum[axis])
                }),
                kinetic_energy: sum(a.kinetic_energy, b.kinetic_energy),
                internal_energy: sum(a.internal_energy, b.internal_energy),
            },
            potential_energy: sum(self.potential_energy, other.potential_energy),
            compression_energy: sum(self.compression_energy, other.compression_energy),
        }
    }
}

/// All that one kind of rearrangement did in one step.
///
/// The totals are those of the points that were touched. All other points are the same before and
/// after, so that the difference is exact for the whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event<const D: usize> {
    /// Time at the end of the step, s.
    pub time: f64,
    /// What was done.
    pub kind: EventKind,
    /// Cells filled or reduced, or cells of the points that were shifted or split.
    pub n_cells: u64,
    /// Points that are new.
    pub n_added: u64,
    /// Points that are gone.
    pub n_removed: u64,
    /// Totals of the touched points before.
    pub before: Totals<D>,
    /// Totals of the touched points after.
    pub after: Totals<D>,
}

impl<const D: usize> Event<D> {
    /// Nothing done yet.
    pub(super) fn new(time: f64, kind: EventKind) -> Self {
        let zero = Totals::zero();
        Self { time, kind, n_cells: 0, n_added: 0, n_removed: 0, before: zero, after: zero }
    }

    /// What the event added to the totals.
    pub fn change(&self) -> Totals<D> {
        self.after.plus(-1.0, &self.before)
    }
}

/// Sums over the events of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventSum<const D: usize> {
    /// Number of events, that is of steps with one.
    pub n_events: u64,
    /// Σ of their cells.
    pub n_cells: u64,
    /// Σ of the new points.
    pub n_added: u64,
    /// Σ of the points that are gone.
    pub n_removed: u64,
    /// Σ of what they added to the totals.
    pub change: Totals<D>,
}

/// Every rearrangement since the start, and what came in and went out.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger<const D: usize> {
    events: Vec<Event<D>>,
    entered: Totals<D>,
    left: Totals<D>,
}

impl<const D: usize> Default for Ledger<D> {
    fn default() -> Self {
        Self { events: Vec::new(), entered: Totals::zero(), left: Totals::zero() }
    }
}

impl<const D: usize> Ledger<D> {
    /// The events, in order of time.
    pub fn events(&self) -> &[Event<D>] {
        &self.events
    }

    /// What came in through inlets.
    pub fn entered(&self) -> &Totals<D> {
        &self.entered
    }

    /// What went out through open faces, or back into inlets.
    pub fn left(&self) -> &Totals<D> {
        &self.left
    }

    /// Adds what has come in.
    pub(crate) fn enter(&mut self, totals: &Totals<D>) {
        self.entered = self.entered.plus(1.0, totals);
    }

    /// Adds what has gone out.
    pub(crate) fn leave(&mut self, totals: &Totals<D>) {
        self.left = self.left.plus(1.0, totals);
    }

    /// Sums over the events of a kind.
    pub fn sum(&self, kind: EventKind) -> EventSum<D> {
        let change = Totals::zero();
        let mut sum = EventSum { n_events: 0, n_cells: 0, n_added: 0, n_removed: 0, change };
        for event in self.events.iter().filter(|event| event.kind == kind) {
            sum.n_events += 1;
            sum.n_cells += event.n_cells;
            sum.n_added += event.n_added;
            sum.n_removed += event.n_removed;
            sum.change = sum.change.plus(1.0, &event.change());
        }
        sum
    }

    /// Keeps an event that touched any cell.
    pub(super) fn record(&mut self, event: Event<D>) {
        if event.n_cells > 0 {
            self.events.push(event);
        }
    }
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Adds one of `particles` to totals.
    pub(crate) fn add_totals(
        &self,
        particles: &ParticlesOf<T, D, M, K>,
        point: usize,
        totals: &mut Totals<D>,
    ) {
        self.add_conserved(particles, point, &mut totals.conserved);
        let physics = &self.physics;
        let mass = particles.mass[point].as_f64();
        for axis in 0..D {
            let height = physics.body_force[axis] * particles.position[point][axis];
            totals.potential_energy -= mass * height.as_f64();
        }
        if let Some(central) = &physics.central_force {
            totals.potential_energy += mass * central.potential(particles.position[point]).as_f64();
        }
        let energy = physics.equation_of_state.compression_energy(particles.density[point]);
        totals.compression_energy += mass * energy.as_f64();
    }

    /// Totals over all points, with the energies that rearrangement may change.
    pub fn full_totals(&self) -> Totals<D> {
        let mut totals = Totals::zero();
        for point in (0..self.particles.len()).filter(|&k| self.is_present(k)) {
            self.add_totals(&self.particles, point, &mut totals);
        }
        totals
    }
}
