//! An acceleration as a function of place and time.

use std::fmt;
use std::sync::Arc;

use serde::ser::Error;
use serde::{Serialize, Serializer};

/// b(x, t) in m/s² of a position, m, and a time, s.
pub type Acceleration<const D: usize> = dyn Fn([f64; D], f64) -> [f64; D] + Send + Sync;

/// The acceleration b(x, t), besides that of the uniform body force: what makes a motion that is chosen
/// beforehand a solution \[Roache1998\].
///
/// It acts at the nodes, at their (Greville) abscissae, and at the time of the start of a step. Where a face
/// is periodic it has to be so too. It is asked by several threads at once, so the result has to depend on
/// place and time alone. It has no potential energy.
///
/// ```
/// use transpoint::scene::ForceField;
///
/// let tide = ForceField::new("tide", |[x, _]: [f64; 2], t: f64| [0.1 * x * t.cos(), 0.0]);
/// assert_eq!(tide.at([2.0, 5.0], 0.0), [0.2, 0.0]);
/// ```
#[derive(Clone)]
pub struct ForceField<const D: usize> {
    name: Arc<str>,
    acceleration: Arc<Acceleration<D>>,
}

impl<const D: usize> ForceField<D> {
    /// A field with a name, which errors and debug output show.
    pub fn new(
        name: &str,
        acceleration: impl Fn([f64; D], f64) -> [f64; D] + Send + Sync + 'static,
    ) -> Self {
        Self { name: Arc::from(name), acceleration: Arc::new(acceleration) }
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// b at a position, m, and a time, s; in m/s².
    pub fn at(&self, position: [f64; D], time: f64) -> [f64; D] {
        (self.acceleration)(position, time)
    }
}

impl<const D: usize> fmt::Debug for ForceField<D> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("ForceField").field("name", &self.name).finish_non_exhaustive()
    }
}

/// Two fields are equal if they are copies of one: functions cannot be compared.
impl<const D: usize> PartialEq for ForceField<D> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.acceleration, &other.acceleration)
    }
}

/// Refuses: a function cannot be written to a scene file, and a scene without it would be another one.
impl<const D: usize> Serialize for ForceField<D> {
    fn serialize<S: Serializer>(&self, _: S) -> Result<S::Ok, S::Error> {
        Err(S::Error::custom(format!("the field of force `{}` is a function", self.name)))
    }
}
