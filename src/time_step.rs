//! Limits of the explicit time step, each a function of its own; a step takes the smallest.
//!
//! Spacings in m, speeds in m/s, results in s. A limit whose cause is absent (zero speed, viscosity or
//! acceleration) is infinite. The acoustic limits are sharp or rigorous bounds for stress updated
//! first or modified-last; see [`worst_transfer_factor`] for the rest. The others are rules of thumb
//! that carry their customary factor.

use crate::Scalar;
use crate::shape::{AxisPosition, Row, ShapeFunction};

/// Sound waves in full cells integrated at their center: `Δt ≤ 2 / (c √(Σ 4/h_a²))`.
///
/// This is `h / (c √D)` in equal spacings, wherever the points lie. It follows from
/// [`acoustic_stiffness`] with the row stiffness 4 of the linear hat at a cell's center.
///
/// ```
/// use transpoint::time_step::acoustic_cell;
/// assert_eq!(acoustic_cell([0.02], 50.0), 0.0004);
/// ```
#[inline]
pub fn acoustic_cell<T: Scalar, const D: usize>(spacing: [T; D], sound_speed: T) -> T {
    acoustic_stiffness([T::lit(4.0); D], spacing, sound_speed)
}

/// Sound waves about one point: [`acoustic_stiffness`] with the row stiffnesses at that point.
///
/// The smallest value over all points bounds the step of any family with lumped node masses and
/// pressure stress. `width` is the family's [`ShapeFunction::WIDTH`], `sound_speed` that of the point.
#[inline]
pub fn acoustic_point<T: Scalar, const D: usize>(
    rows: &[Row<T>; D],
    spacing: [T; D],
    sound_speed: T,
    width: usize,
) -> T {
    let stiffness = std::array::from_fn(|axis| row_stiffness(&rows[axis], width));
    acoustic_stiffness(stiffness, spacing, sound_speed)
}

/// Sound waves for known row stiffnesses S, dimensionless: `Δt ≤ 2 / (c √(Σ S_a / h_a²))`.
///
/// ```text
/// K = Σ_p ρ c² V_p G_p G_pᵀ,  M = Σ_p m_p diag(N_ip),  G_p = (∇N_ip)_i
/// ω² ≤ max_p c² Σ_i |∇N_ip|² / N_ip = max_p c² Σ_a S_a / h_a²,   Δt = 2/ω
/// ```
///
/// The Rayleigh quotient of a sum of point matrices is at most the largest of one point's; tensor
/// products of rows with Σ N = 1 split into the axes.
#[inline]
pub fn acoustic_stiffness<T: Scalar, const D: usize>(
    stiffness: [T; D],
    spacing: [T; D],
    sound_speed: T,
) -> T {
    let sum = (0..D).fold(T::zero(), |sum, a| sum + stiffness[a] / (spacing[a] * spacing[a]));
    T::lit(2.0) / (sound_speed * sum.sqrt())
}

/// Stiffness of one row per mass, `S = Σ (dN)² / N`, dimensionless.
///
/// Functions that vanish together with their slope are left out; a slope without weight makes S
/// infinite, as for a point of the linear hat on a node.
#[inline]
pub fn row_stiffness<T: Scalar>(row: &Row<T>, width: usize) -> T {
    let mut stiffness = T::zero();
    for k in 0..width {
        let (weight, gradient) = (row.weight[k], row.gradient[k]);
        let underflown = weight == T::zero() && gradient.abs() <= T::default_epsilon();
        if !underflown {
            stiffness += gradient * gradient / weight;
        }
    }
    stiffness
}

/// Largest row stiffness of a family in a cell away from walls, at least 99.9 % of the supremum.
///
/// Infinite for [`Linear`](crate::shape::Linear), `4/l + 2/(2 − l)` for
/// [`Gimp`](crate::shape::Gimp), 6 for [`QuadraticBspline`](crate::shape::QuadraticBspline), 3.14
/// for [`CubicBspline`](crate::shape::CubicBspline). Scans the cell, denser towards its faces.
///
/// In a cell at a wall no such bound exists: where one function interpolates, the next one vanishes
/// with a finite slope, and S grows as degree over distance. Use [`acoustic_point`] there.
pub fn worst_row_stiffness<T: Scalar, S: ShapeFunction<T>>(shape: &S) -> T {
    const SAMPLES: usize = 1 << 16;
    let stiffness_at = |sample: usize| {
        let t = sample as f64 / SAMPLES as f64;
        let xi = T::lit(t * t * (3.0 - 2.0 * t));
        let at = AxisPosition { cell: 0, xi, n_cells: 1, periodic: true };
        row_stiffness(&shape.row(at), S::WIDTH)
    };
    (0..=SAMPLES).map(stiffness_at).fold(T::zero(), T::max)
}

/// Share 1/√2 of the acoustic limit that stress updated last (USL) or PIC keep at worst.
///
/// With b in `[0, 1]` the eigenvalue of the lumped inverse times the consistent mass matrix, a mode
/// of frequency ω is stable for `(ω Δt)² < 4/b` with stress updated first or modified-last,
/// `4/(2 − b)` updated last, `2 (1 + b)` with PIC. The worst is b = 0: one centered point per cell.
#[inline]
pub fn worst_transfer_factor<T: Scalar>() -> T {
    T::lit(std::f64::consts::FRAC_1_SQRT_2)
}

/// Points cross at most one cell in a step: `Δt ≤ min h_a / |v|`, after \[Courant1928\].
#[inline]
pub fn advective<T: Scalar, const D: usize>(spacing: [T; D], max_speed: T) -> T {
    spacing.into_iter().fold(T::one() / T::zero(), |dt, h| dt.min(h / max_speed.abs()))
}

/// Viscous diffusion, kinematic viscosity ν in m²/s: `Δt ≤ 1 / (4 ν Σ 1/h_a²)`.
///
/// This is `0.25 h² / (D ν)` in equal spacings, half the von Neumann limit of the explicit step on
/// linear elements with lumped mass, and in 2D the `0.125 h²/ν` of \[Morris1997\].
#[inline]
pub fn viscous<T: Scalar, const D: usize>(spacing: [T; D], viscosity: T) -> T {
    let sum = spacing.into_iter().fold(T::zero(), |sum, h| sum + T::one() / (h * h));
    T::one() / (T::lit(4.0) * viscosity * sum)
}

/// Acceleration of a body force in m/s²: `Δt ≤ min 0.25 √(h_a / |g_a|)`, \[Morris1997\].
#[inline]
pub fn body_force<T: Scalar, const D: usize>(spacing: [T; D], acceleration: [T; D]) -> T {
    (0..D).fold(T::one() / T::zero(), |dt, axis| {
        dt.min(T::lit(0.25) * (spacing[axis] / acceleration[axis].abs()).sqrt())
    })
}

/// Oscillation about the center of a central force, rate Ω in 1/s: `Δt ≤ 2/Ω`.
///
/// A step gives a point the new velocity first and then moves it with that, `v' = v − Δt Ω² x` and
/// `x' = x + Δt v'`. The matrix of the step has determinant 1 and trace `2 − (Ω Δt)²`, so that its
/// eigenvalues lie on the unit circle up to there.
#[inline]
pub fn central_force<T: Scalar>(rate: T) -> T {
    T::lit(2.0) / rate
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{CubicBspline, Gimp, Linear, QuadraticBspline};

    #[track_caller]
    fn assert_near(found: f64, exact: f64, relative: f64) {
        assert!((found / exact - 1.0).abs() <= relative, "{found} is not {exact}");
    }

    fn rows_at<S: ShapeFunction<f64>, const D: usize>(shape: S, xi: [f64; D]) -> [Row<f64>; D] {
        xi.map(|xi| shape.row(AxisPosition { cell: 3, xi, n_cells: 8, periodic: false }))
    }

    /// Worst row stiffness, and Courant numbers Δt c/h in 1D, 2D and 3D to three digits.
    #[test]
    fn worst_row_stiffness_gives_the_known_courant_numbers() {
        let found: [(f64, f64, [f64; 3]); 5] = [
            (worst_row_stiffness(&Gimp { length: 0.25 }), 120.0 / 7.0, [0.483, 0.342, 0.279]),
            (worst_row_stiffness(&Gimp { length: 0.5 }), 28.0 / 3.0, [0.655, 0.463, 0.378]),
            (worst_row_stiffness(&Gimp { length: 1.0 }), 6.0, [0.816, 0.577, 0.471]),
            (worst_row_stiffness(&QuadraticBspline), 6.0, [0.816, 0.577, 0.471]),
            (worst_row_stiffness(&CubicBspline), 3.1368, [1.13, 0.798, 0.652]),
        ];
        for (stiffness, exact, [one, two, three]) in found {
            assert_near(stiffness, exact, 1e-4);
            assert_near(acoustic_stiffness([stiffness; 1], [1.0], 1.0), one, 2e-3);
            assert_near(acoustic_stiffness([stiffness; 2], [1.0; 2], 1.0), two, 2e-3);
            assert_near(acoustic_stiffness([stiffness; 3], [1.0; 3], 1.0), three, 2e-3);
        }
        assert_eq!(worst_row_stiffness::<f64, _>(&Linear), f64::INFINITY);
    }

    #[test]
    fn worst_row_stiffness_survives_single_precision() {
        assert_near(worst_row_stiffness::<f32, _>(&Gimp { length: 0.25 }).into(), 17.142, 1e-3);
        assert_near(worst_row_stiffness::<f32, _>(&QuadraticBspline).into(), 6.0, 1e-3);
        assert_near(worst_row_stiffness::<f32, _>(&CubicBspline).into(), 3.1368, 1e-3);
    }

    #[test]
    fn cell_limit_is_the_point_limit_at_the_center_of_linear_cells() {
        let spacing = [0.1, 0.2, 0.4];
        let by_point = acoustic_point(&rows_at(Linear, [0.5; 3]), spacing, 50.0, 2);
        assert_near(acoustic_cell(spacing, 50.0), by_point, 1e-15);
        assert_near(acoustic_cell([0.1; 3], 50.0), 0.1 / (50.0 * 3.0_f64.sqrt()), 1e-15);
        assert_near(acoustic_cell([1e9, 0.2, 1e9], 50.0), 0.2 / 50.0, 1e-15);
    }

    #[test]
    fn point_limit_adds_the_axes() {
        // Linear hat: S = 1/(ξ (1 − ξ)), here 16/3 and 4.
        let dt = acoustic_point(&rows_at(Linear, [0.25, 0.5]), [0.5, 2.0], 10.0, 2);
        assert_near(dt, 0.2 / (64.0_f64 / 3.0 + 1.0).sqrt(), 1e-15);
        assert_eq!(acoustic_point(&rows_at(Linear, [0.0]), [1.0], 10.0, 2), 0.0);
    }

    #[test]
    fn functions_that_underflow_do_not_limit_the_step() {
        for xi in [0.0, 1e-30_f32, 1e-22] {
            let at = AxisPosition { cell: 3, xi, n_cells: 8, periodic: false };
            assert!(row_stiffness(&QuadraticBspline.row(at), 3) < 8.0);
            assert!(row_stiffness(&CubicBspline.row(at), 4) < 4.0);
        }
    }

    /// On a wall the second function vanishes with the slope p of its degree: S grows as p/ξ.
    #[test]
    fn row_stiffness_is_unbounded_at_walls() {
        let at = |xi| AxisPosition { cell: 0, xi, n_cells: 8, periodic: false };
        assert_near(row_stiffness(&QuadraticBspline.row(at(1e-6)), 3), 2e6, 1e-5);
        assert_near(row_stiffness(&CubicBspline.row(at(1e-6)), 4), 3e6, 1e-5);
        assert_near(row_stiffness(&Gimp { length: 0.5 }.row(at(1e-6)), 3), 1e6, 1e-5);
    }

    #[test]
    fn other_limits_have_their_printed_values() {
        assert_eq!(advective([0.2, 0.1], -4.0), 0.025);
        assert_near(viscous([0.1], 1e-3), 0.25 * 0.01 / 1e-3, 1e-15);
        assert_near(viscous([0.1; 2], 1e-3), 0.125 * 0.01 / 1e-3, 1e-15);
        assert_near(viscous([0.1, 1e9], 1e-3), viscous([0.1], 1e-3), 1e-15);
        assert_near(body_force([0.4, 0.09], [0.0, -9.0]), 0.025, 1e-15);
        assert_near(worst_transfer_factor::<f64>().powi(2), 0.5, 1e-15);
        assert_eq!(central_force(0.5), 4.0);
    }

    #[test]
    fn absent_causes_do_not_limit_the_step() {
        let (spacing, never) = ([0.1, 0.2], f64::INFINITY);
        assert_eq!(acoustic_cell(spacing, 0.0), never);
        assert_eq!(advective(spacing, 0.0), never);
        assert_eq!(viscous(spacing, 0.0), never);
        assert_eq!(body_force(spacing, [0.0; 2]), never);
        assert_eq!(central_force(0.0), never);
    }
}
