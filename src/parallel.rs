//! Deterministic data parallelism: fixed blocks, disjoint mutable views, no atomics.
//!
//! Work is cut at places that depend on the data alone. Every task owns the part of the output that
//! it writes, so results are the same bits on any number of threads.

use std::ops::Range;

/// Mutable data that can be cut in two.
pub trait Split: Send + Sized {
    /// Cuts before element `mid`.
    fn split(self, mid: usize) -> (Self, Self);
}

impl<A: Send> Split for &mut [A] {
    fn split(self, mid: usize) -> (Self, Self) {
        self.split_at_mut(mid)
    }
}

impl Split for () {
    fn split(self, _mid: usize) -> (Self, Self) {
        ((), ())
    }
}

impl<A: Split, B: Split> Split for (A, B) {
    fn split(self, mid: usize) -> (Self, Self) {
        let (a, a_rest) = self.0.split(mid);
        let (b, b_rest) = self.1.split(mid);
        ((a, b), (a_rest, b_rest))
    }
}

/// Runs `work(unit range, its part of data)` over `0..n_units` in blocks of at most `grain` units.
///
/// `cut(u)` is the element of `data` at which unit `u` starts. Results are combined in the order of
/// units, so `combine` needs to be associative only.
pub fn fold_blocks<V, R, W, C, G>(
    n_units: usize,
    grain: usize,
    data: V,
    cut: &C,
    work: &W,
    combine: &G,
) -> R
where
    V: Split,
    R: Send,
    C: Fn(usize) -> usize + Sync,
    W: Fn(Range<usize>, V) -> R + Sync,
    G: Fn(R, R) -> R + Sync,
{
    let work: &Work<V, R> = work;
    if rayon::current_num_threads() == 1 {
        return work(0..n_units, data);
    }
    recurse(0..n_units, grain.max(1), data, &Steps { cut, work, combine })
}

type Work<'a, V, R> = dyn Fn(Range<usize>, V) -> R + Sync + 'a;

/// The steps of a loop behind pointers: the recursion is compiled once for each type of data and of result, not
/// once for every loop.
struct Steps<'a, V, R> {
    cut: &'a (dyn Fn(usize) -> usize + Sync),
    work: &'a Work<'a, V, R>,
    combine: &'a (dyn Fn(R, R) -> R + Sync),
}

fn recurse<V: Split, R: Send>(
    units: Range<usize>,
    grain: usize,
    data: V,
    steps: &Steps<'_, V, R>,
) -> R {
    if units.len() <= grain {
        return (steps.work)(units, data);
    }
    let mid = units.start + units.len() / 2;
    let (left, right) = data.split((steps.cut)(mid) - (steps.cut)(units.start));
    let (mut left, mut right) = (Half::Waiting(left), Half::Waiting(right));
    let mut first = || left.run(|data| recurse(units.start..mid, grain, data, steps));
    let mut second = || right.run(|data| recurse(mid..units.end, grain, data, steps));
    join(&mut first, &mut second);
    match (left, right) {
        (Half::Done(a), Half::Done(b)) => (steps.combine)(a, b),
        _ => unreachable!("both halves have run"),
    }
}

/// One of two halves, before and after.
enum Half<V, R> {
    Waiting(V),
    Running,
    Done(R),
}

impl<V, R> Half<V, R> {
    fn run(&mut self, work: impl FnOnce(V) -> R) {
        if let Self::Waiting(data) = std::mem::replace(self, Self::Running) {
            *self = Self::Done(work(data));
        }
    }
}

/// [`rayon::join`] without type parameters: it is compiled once, not once for every loop.
#[inline(never)]
fn join(left: &mut (dyn FnMut() + Send), right: &mut (dyn FnMut() + Send)) {
    rayon::join(left, right);
}

/// [`fold_blocks`] without a result, one element of `data` per unit.
pub fn for_each_block<V, W>(n_units: usize, grain: usize, data: V, work: &W)
where
    V: Split,
    W: Fn(Range<usize>, V) + Sync,
{
    fold_blocks(n_units, grain, data, &|unit| unit, work, &|(), ()| ());
}
