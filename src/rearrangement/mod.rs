//! Points added, taken away, moved and split between steps, after \[Song2020\].
//!
//! All parts take their fields from the points as they are before, so that no order matters.

mod fill;
mod fracture;
mod ledger;
mod overfill;
mod reduce;
mod shift;
mod split;

pub use fracture::{Survey, survey};
pub use ledger::{Event, EventKind, EventSum, Ledger, Totals};

use crate::Scalar;
use crate::affine_density::slope_among;
use crate::error::InvalidInput;
use crate::material::Material;
use crate::math::{Field, Value, Vector};
use crate::method::Method;
use crate::particles::Particles;
use crate::reconstruction::Reconstruction;
use crate::scene_check::check_rearrangement;
use crate::settings::{Rearrangement, Split};
use crate::solver::Solver;
use crate::step::{AffineOf, StateOf, View};
use crate::telemetry::Counters;

/// What rearrangement keeps from step to step; `A` and `S` as in [`Particles`].
#[derive(Clone, Debug)]
pub struct Rearranger<T, const D: usize, A, S> {
    settings: Rearrangement,
    survey: Survey,
    fresh: Particles<T, D, A, S>,
    moved: Vec<shift::Moved<T, D, S>>,
    room: Option<overfill::Room<T, D, A>>,
    n_steps: u32,
    next_id: u32,
    initial_mass: f64,
    created_mass: f64,
}

/// The rearranger of a method.
pub type RearrangerOf<T, const D: usize, M, K> =
    Rearranger<T, D, AffineOf<T, D, M>, StateOf<T, D, K>>;

impl<T: Scalar, const D: usize, A: Field<T>, S: Field<T>> Rearranger<T, D, A, S> {
    /// Drops new points from number `start` on, whose identifiers are free again.
    fn take_back(&mut self, start: usize) {
        self.next_id -= (self.fresh.len() - start) as u32;
        self.fresh.truncate(start);
    }
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Sets what is done to the points at the end of each step from now on.
    ///
    /// # Errors
    /// When a setting is out of range, or the method cannot honour it: new and moved points need fields
    /// by reconstruction, the shift by overfill carried values.
    pub fn set_rearrangement(
        &mut self,
        settings: Option<Rearrangement>,
    ) -> Result<(), InvalidInput> {
        if let Some(settings) = &settings {
            check_rearrangement::<T, D, M>(settings)?;
        }
        self.rearranger = None;
        let split = settings.and_then(|settings| settings.split);
        self.set_lengths(matches!(split, Some(Split::Stretch(_) | Split::Lone(_))));
        let Some(settings) = settings else { return Ok(()) };
        let p = &self.particles;
        self.rearranger = Some(Box::new(Rearranger {
            settings,
            survey: Survey::new(&self.grid),
            fresh: Particles::default(),
            moved: Vec::new(),
            room: settings.overfill.map(|_| overfill::Room::new(&self.grid, &self.method.shape())),
            n_steps: 0,
            next_id: self.next_id,
            initial_mass: p.mass.iter().map(|mass| mass.as_f64()).sum(),
            created_mass: 0.0,
        }));
        self.survey_is_stale = true;
        Ok(())
    }

    /// Adds, takes away, moves and splits points, as far as that was set; points stay sorted.
    pub fn rearrange(&mut self) {
        if self.cells.is_empty() {
            return;
        }
        let Some(mut kept) = self.rearranger.take() else { return };
        kept.next_id = self.next_id;
        let Rearrangement { fill, most_points, shift, split, overfill } = kept.settings;
        // Constant conditions: what a method cannot have need not be compiled for it.
        if <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES {
            if let Some(split) = split {
                self.split(split, &mut kept);
            }
            self.look_around(&mut kept);
            if let Some(fill) = fill {
                self.fill(fill, &mut kept);
                self.look_around(&mut kept);
            }
            if let Some(most_points) = most_points {
                self.reduce(most_points, &mut kept);
            }
            if let Some(shift) = shift {
                kept.n_steps += 1;
                if kept.n_steps == shift.interval {
                    kept.n_steps = 0;
                    self.shift(shift, &mut kept);
                    self.look_around(&mut kept);
                }
            }
        } else {
            if let Some(overfill) = overfill
                && self.counters.n_steps.is_multiple_of(u64::from(overfill.interval))
            {
                self.shift_overfill(&mut kept);
            }
            if let Some(split) = split {
                self.split(split, &mut kept);
            }
        }
        self.next_id = kept.next_id;
        self.rearranger = Some(kept);
    }

    /// Brings the survey up to date, if cells have filled or emptied since.
    fn look_around(&mut self, kept: &mut RearrangerOf<T, D, M, K>) {
        let wanted = kept.settings.fill.is_some() || kept.settings.shift.is_some();
        if self.survey_is_stale && wanted {
            let cells = &self.cells;
            kept.survey.update(&self.grid, &cells.index, |cell| !cells.is_vacant(cell));
            self.survey_is_stale = false;
        }
    }

    /// Takes over the new points, drops those marked for it, and writes down what was done.
    fn finish(&mut self, event: Event<D>, kept: &mut RearrangerOf<T, D, M, K>) {
        if event.n_cells > 0 {
            self.particles.append(&mut kept.fresh);
            self.append_lengths();
            self.bin_particles();
            self.ledger.record(event);
        }
    }
}

/// Fields of a point at a place where there was none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fields<T, const D: usize, A, S> {
    pub density: T,
    pub velocity: [T; D],
    pub affine: A,
    pub state: S,
    /// Slope of the density, kg/m⁴, where points carry one.
    pub density_slope: Option<[T; D]>,
}

pub(crate) type FieldsOf<T, const D: usize, M, K> =
    Fields<T, D, AffineOf<T, D, M>, StateOf<T, D, K>>;

/// Fields at a target in cells: density, velocity (ρv)/ρ, affine field and state of the material.
///
/// `None` where there are no points or where they give no positive density. One function for all uses,
/// since its kernels are large.
#[inline(never)]
pub(crate) fn fields_at<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    reconstruction: &M::Reconstruction,
    target: [T; D],
    counters: &mut Counters,
) -> Option<FieldsOf<T, D, M, K>>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let p = view.particles;
    let cloud = view.cloud();
    let momentum = |point: usize| Vector(p.velocity[point].map(|v| v * p.density[point]));
    let fit =
        reconstruction.at_node(&cloud, target, |point| (momentum(point), Value(p.density[point])));
    counters.count_fit(&fit);
    let (Vector(momentum), Value(density)) = fit.value()?;
    if !(density.is_finite() && density > T::zero()) {
        return None;
    }
    let velocity = momentum.map(|component| component / density);
    let affine = other_field(<AffineOf<T, D, M> as Field<T>>::COMPONENTS, || {
        let fit = reconstruction.at_node(&cloud, target, |point| p.affine[point]);
        counters.count_fit(&fit);
        fit.value()
    })?;
    let state = other_field(<StateOf<T, D, K> as Field<T>>::COMPONENTS, || {
        let fit = reconstruction.at_node(&cloud, target, |point| p.state[point]);
        counters.count_fit(&fit);
        fit.value()
    })?;
    let density = density.max(view.physics.minimum_density);
    let is_affine = !p.density_slope.is_empty();
    let density_slope = is_affine.then(|| slope_among(&cloud, target));
    Some(Fields { density, velocity, affine, state, density_slope })
}

/// A field that a method or material may lack.
fn other_field<F: Default>(n_components: usize, fit: impl FnOnce() -> Option<F>) -> Option<F> {
    if n_components == 0 { Some(F::default()) } else { fit() }
}
