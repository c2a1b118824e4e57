//! What every hard case works with: how simulations are built, stepped, and how they burst.

use transpoint::variants::{Blend, Fields, StressUpdate};
use transpoint::{InvalidInput, Scene, Settings, Simulation, StepError, Variant};

use crate::case::Outcome;
use crate::cases::free_surface::{self, STEPS_PER_TIME_STEP};

/// Share of the stable time step unless a hard case is about it.
pub(super) const COURANT: f64 = free_surface::COURANT;
/// Steps over those of a fluid at rest at which a run counts as burst: its points are too fast for their step.
const MOST_STEPS: f64 = 4.0;

/// What comes of building.
pub(super) type Built<const D: usize> = Result<Box<dyn Simulation<D>>, InvalidInput>;

/// Builds simulations: a variant of the library, or one that a test has spoilt.
pub(super) trait Builder: Sync {
    /// In one dimension.
    fn line(&self, scene: &Scene<1>, settings: &Settings) -> Built<1>;
    /// In two dimensions.
    fn plane(&self, scene: &Scene<2>, settings: &Settings) -> Built<2>;
}

impl Builder for Variant {
    fn line(&self, scene: &Scene<1>, settings: &Settings) -> Built<1> {
        self.build_1d(scene, settings)
    }

    fn plane(&self, scene: &Scene<2>, settings: &Settings) -> Built<2> {
        self.build_2d(scene, settings)
    }
}

/// What a run measures, in the order of its quantities.
pub(super) type Measured = Result<Vec<f64>, Outcome>;

/// A method on trial.
#[derive(Clone, Copy)]
pub(super) struct Trial<'a> {
    /// Its name, parts and settings.
    pub(super) variant: Variant,
    /// What builds it.
    pub(super) builder: &'a dyn Builder,
}

impl Trial<'_> {
    /// A simulation in one dimension.
    pub(super) fn line(
        &self,
        scene: &Scene<1>,
        settings: &Settings,
    ) -> Result<Box<dyn Simulation<1>>, Outcome> {
        self.builder.line(scene, settings).map_err(|error| refused(&error))
    }

    /// A simulation in two dimensions.
    pub(super) fn plane(
        &self,
        scene: &Scene<2>,
        settings: &Settings,
    ) -> Result<Box<dyn Simulation<2>>, Outcome> {
        self.builder.plane(scene, settings).map_err(|error| refused(&error))
    }

    /// Whether its points carry fields of their own.
    pub(super) fn carries(&self) -> bool {
        self.variant.parts().fields == Fields::Carried
    }

    /// The policy of closed scenes.
    pub(super) fn closed() -> Settings {
        Settings::default()
    }

    /// The policy of scenes with a free surface, see [`free_surface`]: carried fields go with the stress updated
    /// modified-last, as in `rivals`. Cells in m, speed of sound in m/s.
    pub(super) fn surface(
        &self,
        points_per_axis: usize,
        spacing: f64,
        sound_speed: f64,
        relaxation: f64,
    ) -> Settings {
        let settings = free_surface::settings(points_per_axis, spacing, sound_speed, relaxation);
        let stress_update =
            if self.carries() { StressUpdate::ModifiedLast } else { StressUpdate::Last };
        Settings { stress_update, ..settings }
    }

    /// The policy of closed scenes whose points leave their lattice for good: the limiters of free surfaces with FLIP
    /// alone, since a relaxation towards PIC would do as a viscosity and hide what is to be seen.
    pub(super) fn flow() -> Settings {
        let limited = free_surface::settings(2, 1.0, 1.0, free_surface::RELAXATION);
        Settings { blend: Blend::PerStep(1.0), ..limited }
    }

    /// When its density is updated, what it fixes included.
    pub(super) fn stress_update(&self, settings: &Settings) -> StressUpdate {
        self.variant.settings(settings).stress_update
    }
}

/// A simulation that could not be built.
pub(super) fn refused(reason: &impl ToString) -> Outcome {
    Outcome::NotBuilt { reason: reason.to_string() }
}

/// Takes `steps` steps of `dt` (s) and calls `watch` after each.
pub(super) fn march<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    dt: f64,
    steps: u64,
    mut watch: impl FnMut(u64, &dyn Simulation<D>),
) -> Result<(), Outcome> {
    for step in 1..=steps {
        if let Err(error) = simulation.step(dt) {
            return Err(burst(simulation, step - 1, &error));
        }
        watch(step, simulation);
    }
    Ok(())
}

/// Steps to the time `end` (s) with a time step that is found anew now and then, and calls `watch` after each.
pub(super) fn march_until<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    end: f64,
    mut watch: impl FnMut(&dyn Simulation<D>),
) -> Result<(), Outcome> {
    let mut dt = simulation.stable_dt(COURANT).dt;
    let most = (MOST_STEPS * end / dt).ceil() as u64;
    let mut step = 0;
    while simulation.time() < end {
        if step % STEPS_PER_TIME_STEP == 0 {
            dt = simulation.stable_dt(COURANT).dt;
        }
        if let Err(error) = simulation.step(dt) {
            return Err(burst(simulation, step, &error));
        }
        step += 1;
        if step > most {
            let reason =
                format!("speed of points: {MOST_STEPS} times the steps of a fluid at rest");
            return Err(Outcome::BlownUp { step, time: simulation.time(), reason });
        }
        watch(simulation);
    }
    Ok(())
}

/// The quantity that failed first, of which point, and where, then the solver's words.
fn burst<const D: usize>(simulation: &dyn Simulation<D>, step: u64, error: &StepError) -> Outcome {
    let (field, point) = match error {
        StepError::NotFinite { id, field, .. } => (*field, Some(*id)),
        StepError::NotPositive { id, .. } => ("density", Some(*id)),
        StepError::LeftDomain { id, .. } => ("position", Some(*id)),
        _ => ("state", None),
    };
    let mut place = None;
    simulation.visit_points(&mut |state| {
        if Some(state.id) == point {
            place = Some(state.position);
        }
    });
    let of = point.map_or_else(String::new, |id| format!(" of point {id}"));
    let at = place.map_or_else(String::new, |place| {
        let place = place.map(|x| format!("{x:.3}"));
        format!(" at ({}) m", place.join(", "))
    });
    Outcome::BlownUp { step, time: simulation.time(), reason: format!("{field}{of}{at}: {error}") }
}

/// Slope of the least-squares line through pairs.
pub(super) fn slope(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let mean = pairs.iter().fold([0.0; 2], |[a, b], (x, y)| [a + x / n, b + y / n]);
    let (mut above, mut below) = (0.0, 0.0);
    for (x, y) in pairs {
        above += (x - mean[0]) * (y - mean[1]);
        below += (x - mean[0]).powi(2);
    }
    above / below
}

/// The larger one; what is not a number counts as infinite.
pub(super) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}
