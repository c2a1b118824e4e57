//! Sound simulations, spoilt in one way each.

use transpoint::rearrangement::Ledger;
use transpoint::simulation::{Conserved, PointState, StableTimeStep};
use transpoint::telemetry::Counters;
use transpoint::variants::Rearrangement;
use transpoint::{InvalidInput, Observation, Scene, Settings, Simulation, StepError, Variant};

use crate::cases::hard_cases::trial::{Builder, Built};

/// What is wrong.
#[derive(Clone, Copy, Debug)]
pub(super) enum Spoil {
    /// Velocities are off by up to so much, another number for each point and step, m/s.
    Noise(f64),
    /// Densities are shown times this, and pressures and volumes accordingly.
    Density(f64),
    /// Steps are longer than asked for by this factor.
    Step(f64),
    /// One point is not there.
    Lost,
    /// Places along x are off by so much, m.
    Skewed(f64),
}

/// Builds a variant and spoils it.
pub(super) struct Mutant {
    pub(super) variant: Variant,
    pub(super) spoil: Spoil,
}

impl Builder for Mutant {
    fn line(&self, scene: &Scene<1>, settings: &Settings) -> Built<1> {
        let inner = self.variant.build_1d(scene, settings)?;
        Ok(Box::new(Spoilt { inner, spoil: self.spoil, steps: 0, time: 0.0 }))
    }

    fn plane(&self, scene: &Scene<2>, settings: &Settings) -> Built<2> {
        let inner = self.variant.build_2d(scene, settings)?;
        Ok(Box::new(Spoilt { inner, spoil: self.spoil, steps: 0, time: 0.0 }))
    }
}

/// Builds a variant with other settings than those asked for.
pub(super) struct Respelt<F> {
    pub(super) variant: Variant,
    pub(super) change: F,
}

impl<F: Fn(&mut Settings) + Sync> Respelt<F> {
    fn settings(&self, settings: &Settings) -> Settings {
        let mut settings = *settings;
        (self.change)(&mut settings);
        settings
    }
}

impl<F: Fn(&mut Settings) + Sync> Builder for Respelt<F> {
    fn line(&self, scene: &Scene<1>, settings: &Settings) -> Built<1> {
        self.variant.build_1d(scene, &self.settings(settings))
    }

    fn plane(&self, scene: &Scene<2>, settings: &Settings) -> Built<2> {
        self.variant.build_2d(scene, &self.settings(settings))
    }
}

struct Spoilt<const D: usize> {
    inner: Box<dyn Simulation<D>>,
    spoil: Spoil,
    steps: u64,
    time: f64,
}

impl<const D: usize> Spoilt<D> {
    /// What is shown of a point; `None` of one that is lost.
    fn shown(&self, point: &PointState<D>) -> Option<PointState<D>> {
        let mut point = *point;
        match self.spoil {
            Spoil::Noise(size) => {
                // As good as random, and the same in each run.
                let phase = f64::from(point.id) * 12.9898 + self.steps as f64 * 78.233;
                point.velocity[0] += size * (phase.sin() * 43_758.545_3).fract();
            }
            Spoil::Density(factor) => {
                point.density *= factor;
                point.pressure *= factor;
            }
            Spoil::Skewed(distance) => point.position[0] += distance,
            Spoil::Lost if point.id == 0 => return None,
            Spoil::Lost | Spoil::Step(_) => (),
        }
        Some(point)
    }
}

impl<const D: usize> Simulation<D> for Spoilt<D> {
    fn step(&mut self, dt: f64) -> Result<(), StepError> {
        self.steps += 1;
        self.time += dt;
        let factor = if let Spoil::Step(factor) = self.spoil { factor } else { 1.0 };
        self.inner.step(factor * dt)
    }

    fn stable_dt(&self, courant: f64) -> StableTimeStep {
        self.inner.stable_dt(courant)
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn n_points(&self) -> usize {
        self.observe().points.len()
    }

    fn observe(&self) -> Observation<D> {
        let points = self.inner.observe().points;
        let points = points.iter().filter_map(|point| self.shown(point)).collect();
        Observation { time: self.time, points }
    }

    fn visit_points(&self, visit: &mut dyn FnMut(&PointState<D>)) {
        self.inner.visit_points(&mut |point| {
            if let Some(point) = self.shown(point) {
                visit(&point);
            }
        });
    }

    fn grid_mass(&self) -> f64 {
        self.inner.grid_mass()
    }

    fn conserved(&self) -> Conserved<D> {
        self.inner.conserved()
    }

    fn counters(&self) -> Counters {
        self.inner.counters()
    }

    fn ledger(&self) -> &Ledger<D> {
        self.inner.ledger()
    }

    fn body_forces(&self) -> &[[f64; D]] {
        self.inner.body_forces()
    }

    fn set_rearrangement(&mut self, settings: Option<Rearrangement>) -> Result<(), InvalidInput> {
        self.inner.set_rearrangement(settings)
    }

    fn bytes_per_point(&self) -> usize {
        self.inner.bytes_per_point()
    }
}
