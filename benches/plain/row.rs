//! The quadratic B-splines of one axis.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use super::Real;

/// The three functions of one axis at a point.
pub struct Row<T> {
    /// N.
    pub value: [T; 3],
    /// dN/dx, 1/m.
    pub slope: [T; 3],
    /// N (x − p) of a node at x and the point at p, m.
    pub moment: [T; 3],
    /// 1 / Σ N (x − p)², 1/m².
    pub per_second: T,
}

impl<T: Real> Row<T> {
    /// The row of a point at `x` in cell `cell`.
    #[inline(always)]
    pub fn new(x: T, cell: usize, n_cells: usize, spacing: T, per_spacing: T) -> Self {
        let half = T::lit(0.5);
        let xi = x * per_spacing - T::index(cell);
        if cell == 0 || cell + 1 == n_cells {
            return Self::wall(xi, cell == 0, spacing, per_spacing);
        }
        let eta = T::one() - xi;
        let value = [half * eta * eta, half + xi * eta, half * xi * xi];
        let offset = -(half + xi) * spacing;
        Self {
            value,
            slope: [-eta * per_spacing, (eta - xi) * per_spacing, xi * per_spacing],
            moment: [
                value[0] * offset,
                value[1] * (offset + spacing),
                value[2] * (offset + spacing + spacing),
            ],
            per_second: T::lit(4.0) * per_spacing * per_spacing,
        }
    }

    /// The rows of the first and the last cell, which mirror each other.
    #[cold]
    fn wall(xi: T, lower: bool, spacing: T, per_spacing: T) -> Self {
        let (half, two) = (T::lit(0.5), T::lit(2.0));
        let s = if lower { xi } else { T::one() - xi };
        let value = [(T::one() - s) * (T::one() - s), s * (two - T::lit(1.5) * s), half * s * s];
        let slope = [two * (s - T::one()), two - T::lit(3.0) * s, s].map(|g| g * per_spacing);
        let offset = [-s, half - s, T::lit(1.5) - s].map(|d| d * spacing);
        let moment = std::array::from_fn(|k| value[k] * offset[k]);
        let second = (0..3).fold(T::zero(), |m, k| m + moment[k] * offset[k]);
        let per_second = T::one() / second;
        if lower {
            return Self { value, slope, moment, per_second };
        }
        let reversed = |v: [T; 3]| [v[2], v[1], v[0]];
        Self {
            value: reversed(value),
            slope: reversed(slope.map(|g| -g)),
            moment: reversed(moment.map(|d| -d)),
            per_second,
        }
    }
}
