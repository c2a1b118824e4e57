//! The largest Courant number of a method on a problem, by trial at the coarsest level.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use transpoint::Variant;

use super::execute::{Build, Runner};
use super::{COURANT, POINTS_PER_AXIS, resolution_of};
use crate::problems::Problem;
use crate::progress::Progress;

/// Courant numbers tried are multiples of this.
const INCREMENT: f64 = 0.1;
/// Most multiples and one.
const END: u64 = 32;
/// Error over that at the common Courant number beyond which a trial counts as unstable: growth shows as an error long
/// before it ends a run.
const MOST_ERROR: f64 = 2.0;

/// The largest multiple of 0.1 with which the coarsest run ends with at most twice the error of the common Courant
/// number, by bisection, stable ones being taken to lie below all others; found once per process. 0 where none does.
pub(super) fn largest_courant<const D: usize>(problem: &dyn Problem<D>, variant: Variant) -> f64
where
    Variant: Build<D>,
{
    static FOUND: Mutex<BTreeMap<(String, Variant), f64>> = Mutex::new(BTreeMap::new());
    let found = || FOUND.lock().unwrap_or_else(PoisonError::into_inner);
    let key = (problem.name().to_owned(), variant);
    if let Some(&known) = found().get(&key) {
        return known;
    }
    // Not under the lock: two workers that ask at once find the same number.
    let largest = bisect(problem, variant);
    found().insert(key, largest);
    largest
}

fn bisect<const D: usize>(problem: &dyn Problem<D>, variant: Variant) -> f64
where
    Variant: Build<D>,
{
    let resolution = resolution_of(problem.levels()[0], POINTS_PER_AXIS[0]);
    let error = |courant: f64| {
        let silent = Progress::silent();
        Runner::new(problem, variant, &resolution).map_or(f64::NAN, |mut runner| {
            runner.march(problem, &resolution, courant, &silent).errors[0]
        })
    };
    let common = error(COURANT);
    // Where the common number fails, any run that ends with an error below the answer itself is stable.
    let most = if common.is_finite() { MOST_ERROR * common } else { 1.0 };
    let (mut stable, mut unstable) = (0, END);
    while stable + 1 < unstable {
        let trial = u64::midpoint(stable, unstable);
        if error(INCREMENT * trial as f64) <= most {
            stable = trial;
        } else {
            unstable = trial;
        }
    }
    INCREMENT * stable as f64
}
