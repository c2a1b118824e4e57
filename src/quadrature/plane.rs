//! A unit box cut by a plane: how much of it is wetted, where, and which plane wets a given fraction.
//!
//! Positions are in cells from the lower corner of the box, so that cells of any shape are unit boxes; a
//! normal there is the gradient with respect to these positions.

use crate::Scalar;

/// The half space n·x ≤ d of the unit box `[0, 1]^D`, D = 1, 2 or 3.
///
/// ```
/// use transpoint::quadrature::Plane;
/// let corner = Plane { normal: [1.0, 1.0], offset: 0.5 }.wetted();
/// assert!((corner.fraction - 0.125_f64).abs() < 1e-15);
/// assert!((corner.centroid[0] - 1.0 / 6.0).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane<T, const D: usize> {
    /// n: points out of the wetted part; of any length and any signs.
    pub normal: [T; D],
    /// d.
    pub offset: T,
}

/// The wetted part of the unit box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wetted<T, const D: usize> {
    /// Volume V of the wetted part, 0 to 1.
    pub fraction: T,
    /// Its centroid; of an empty part the corner that is wetted first.
    pub centroid: [T; D],
    /// ∂V/∂d ≥ 0: the wetted area over the length of the normal.
    pub slope: T,
}

impl<T: Scalar, const D: usize> Plane<T, D> {
    /// Volume and centroid of the wetted part, the function of \[Scardovelli2000\] §3 and its moments.
    ///
    /// The published polynomials subtract nearly equal cubes where a component of the normal is small.
    /// Here the box is cut into slices across its axes, that of the smallest component first:
    ///
    /// ```text
    /// V_D(α; m₁ ≤ … ≤ m_D) = ∫₀¹ V_{D−1}(α − m₁ t; m₂ … m_D) dt,   V₁(α; m) = min(1, max(0, α/m))
    /// ```
    ///
    /// Between the levels at which a slice passes a corner, V and its moments are polynomials of degree
    /// three at most, which two Gauss points integrate exactly. No term is negative, so that fraction
    /// and centroid have the relative accuracy of α = d − min n·x, however small the fraction or a
    /// component is; no threshold is needed. The place t = (α − b)/m₁ of a slice at a corner level b is
    /// off by δ ≤ min(1, ε/m₁). The integrand is continuous there and its slope in t jumps by at most
    /// m₁/m_D, so that the error is at most m₁ δ²/m_D ≤ D ε for every m₁.
    ///
    /// A plane without normal wets all for d ≥ 0 and nothing for d < 0.
    pub fn wetted(&self) -> Wetted<T, D> {
        let frame = Frame::new(&self.normal);
        if !(frame.sum > T::zero()) {
            let fraction = if self.offset >= T::zero() { T::one() } else { T::zero() };
            return Wetted { fraction, centroid: [T::lit(0.5); D], slope: T::zero() };
        }
        let moments = slices(&frame.weights, 0, (self.offset - frame.lowest) / frame.sum);
        let fraction = moments.volume.min(T::one());
        let mut centroid = [T::zero(); D];
        for (&axis, &first) in frame.axes.iter().zip(&moments.first) {
            let along = if fraction > T::zero() { first / moments.volume } else { T::zero() };
            let is_turned = self.normal[axis] < T::zero();
            centroid[axis] = if is_turned { T::one() - along } else { along };
        }
        Wetted { fraction, centroid, slope: moments.slope / frame.sum }
    }

    /// The plane of this normal that wets a fraction of the box; fractions beyond 0 and 1 count as these.
    ///
    /// Up to one half, V is convex and `V^(1/D)` concave in α (Brunn and Minkowski), hence Newton's
    /// method on the latter ascends to the root from any lower bound. The bound from the k largest
    /// components, `V ≤ α^k / (k! m_{D−k+1} … m_D)`, is sharp near a corner, an edge and a face. Above one
    /// half the dry part is wetted instead. The normal must not be zero.
    pub fn of_fraction(normal: [T; D], fraction: T) -> Self {
        let frame = Frame::new(&normal);
        let half = T::lit(0.5);
        let level = if fraction <= half {
            level_of(&frame.weights, fraction.max(T::zero()))
        } else {
            T::one() - level_of(&frame.weights, (T::one() - fraction).max(T::zero()))
        };
        Self { normal, offset: level * frame.sum + frame.lowest }
    }
}

/// Newton steps, a fixed bound: from the lower bounds above, five have reached round-off in every case
/// tried (10⁵ random normals and fractions).
const NEWTON_STEPS: usize = 8;

/// α for a fraction of one half at most.
fn level_of<T: Scalar, const D: usize>(weights: &[T; D], fraction: T) -> T {
    if !(fraction > T::zero()) {
        return T::zero();
    }
    let (mut level, mut product) = (T::zero(), fraction);
    for k in 1..=D {
        product *= T::from_index(k) * weights[D - k];
        level = level.max(product.powf(T::one() / T::from_index(k)));
    }
    let power = T::one() / T::from_index(D);
    for _ in 0..NEWTON_STEPS {
        let moments = slices(weights, 0, level);
        let missing = (fraction / moments.volume).powf(power) - T::one();
        let step = missing * T::from_index(D) * moments.volume / moments.slope;
        // Not a number where the volume has underflown.
        if !(step > T::zero()) {
            break;
        }
        level += step;
    }
    level.min(T::lit(0.5))
}

/// The box turned such that no component of the normal is negative, its axes in ascending order of them.
struct Frame<T, const D: usize> {
    /// m: components of the normal over their sum.
    weights: [T; D],
    /// Axis of the box of each.
    axes: [usize; D],
    /// Σ |nᵢ|.
    sum: T,
    /// Least n·x over the box.
    lowest: T,
}

impl<T: Scalar, const D: usize> Frame<T, D> {
    fn new(normal: &[T; D]) -> Self {
        let (mut sum, mut lowest) = (T::zero(), T::zero());
        for &n in normal {
            sum += n.abs();
            lowest += n.min(T::zero());
        }
        let mut axes: [usize; D] = std::array::from_fn(|axis| axis);
        for end in 1..D {
            for k in (1..=end).rev() {
                if normal[axes[k]].abs() < normal[axes[k - 1]].abs() {
                    axes.swap(k, k - 1);
                }
            }
        }
        Self { weights: axes.map(|axis| normal[axis].abs() / sum), axes, sum, lowest }
    }
}

/// Volume of a wetted part, its first moments along the sorted axes, and ∂V/∂α.
#[derive(Clone, Copy)]
struct Moments<T, const D: usize> {
    volume: T,
    first: [T; D],
    slope: T,
}

/// Place 1/√3 of the two Gauss points in [−1, 1].
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Moments over the axes from `axis` on, at the level α.
fn slices<T: Scalar, const D: usize>(weights: &[T; D], axis: usize, level: T) -> Moments<T, D> {
    let (zero, half) = (T::zero(), T::lit(0.5));
    let mut found = Moments { volume: zero, first: [zero; D], slope: zero };
    let weight = weights[axis];
    if axis + 1 == D {
        let length = (level / weight).max(zero).min(T::one());
        found.volume = length;
        found.first[axis] = half * length * length;
        found.slope = if level > zero && level < weight { T::one() / weight } else { zero };
        return found;
    }
    let (least, most) = (weights[axis + 1], weights[D - 1]);
    // Levels of the corners of a slice: of two axes 0, a, b and a + b; of one axis 0 and a.
    let full = if axis + 2 == D { most } else { least + most };
    // Places of these slices; beyond the last break slices are full, before the first empty.
    let place = |corner: T| {
        let above = level - corner;
        if above > zero { (above / weight).min(T::one()) } else { zero }
    };
    let ends = [place(zero), place(least), place(most), place(full), zero];
    for piece in ends.windows(2) {
        let radius = half * (piece[0] - piece[1]);
        if !(radius > zero) {
            continue;
        }
        let middle = half * (piece[0] + piece[1]);
        for side in [-GAUSS, GAUSS] {
            let at = middle + T::lit(side) * radius;
            let slice = slices(weights, axis + 1, level - weight * at);
            found.volume += radius * slice.volume;
            found.first[axis] += radius * at * slice.volume;
            for other in axis + 1..D {
                found.first[other] += radius * slice.first[other];
            }
            found.slope += radius * slice.slope;
        }
    }
    found
}

/// Normal of the surface in a cell from the wetted fractions around it; points out of the fluid.
///
/// Weighted central differences over the 3^D cells, \[ParkerYoungs1992\]: weights 1, 2, 1 along the other
/// axes. The components' absolute values add up to one; `None` where all differences cancel.
///
/// `fraction` gives the wetted fraction at a shift in cells, and `None` beyond a wall. There a cell has the
/// value of its mirror image, as if the surface met the wall at a right angle.
pub fn normal<T: Scalar, const D: usize>(
    fraction: impl Fn([i32; D]) -> Option<T>,
) -> Option<[T; D]> {
    let mut is_inside = [[false; 2]; D];
    for axis in 0..D {
        for (side, step) in [-1, 1].into_iter().enumerate() {
            let mut shift = [0; D];
            shift[axis] = step;
            is_inside[axis][side] = fraction(shift).is_some();
        }
    }
    let at = |shift: [i32; D]| {
        let mirrored = std::array::from_fn(|axis| {
            let side = usize::from(shift[axis] > 0);
            if is_inside[axis][side] { shift[axis] } else { 0 }
        });
        fraction(mirrored).unwrap_or(T::zero())
    };
    let mut normal = [T::zero(); D];
    for code in 0..3_usize.pow(D as u32) {
        let mut rest = code;
        let shift: [i32; D] = std::array::from_fn(|_| {
            let step = (rest % 3) as i32 - 1;
            rest /= 3;
            step
        });
        for axis in (0..D).filter(|&axis| shift[axis] == 1) {
            let mut opposite = shift;
            opposite[axis] = -1;
            // 2 for each other axis without a shift; equal fractions cancel exactly.
            let centered = (0..D).filter(|&other| shift[other] == 0).count();
            let weight = T::from_index(1 << centered);
            normal[axis] += weight * (at(opposite) - at(shift));
        }
    }
    let sum = normal.iter().fold(T::zero(), |sum, n| sum + n.abs());
    (sum > T::zero()).then(|| normal.map(|n| n / sum))
}
