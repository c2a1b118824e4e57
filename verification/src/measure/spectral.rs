//! Growth per step of a linearised map: its Jacobian by differences, its spectral radius by powers.

use nalgebra::{DMatrix, DVector};

/// Half the base distance of the differences: a power of two, so that perturbed inputs are exact.
///
/// The truncation error is 576 a₉ ε⁸ = 8·10⁻¹⁵ a₉, with a₉ the ninth Taylor coefficient, and the
/// round-off of an output near 1 is 10⁻¹⁶/ε = 10⁻¹⁴.
const EPSILON: f64 = 1.0 / 128.0;

/// Weights of f(kε) − f(−kε), k = 1…4, in the eighth-order central difference of f′(0) ε.
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Squarings of the matrix: the power 2⁵⁰ leaves ln(10³)/2⁵⁰ = 6·10⁻¹⁵ of a transient growth of 10³.
const SQUARINGS: u32 = 50;

/// Relative change of the exponent between two squarings at which it counts as converged.
const CONVERGED: f64 = 1e-4;

/// The Jacobian of `map` at `base`, one column per input, by central differences of eighth order.
///
/// # Errors
/// The first error of the map.
pub fn jacobian<E>(
    base: &[f64],
    mut map: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
) -> Result<DMatrix<f64>, E> {
    let mut columns = Vec::with_capacity(base.len());
    let mut input = base.to_vec();
    for j in 0..base.len() {
        let mut column = DVector::zeros(0);
        for (k, weight) in WEIGHTS.iter().enumerate() {
            let distance = (k + 1) as f64 * EPSILON;
            input[j] = base[j] + distance;
            let ahead = DVector::from_vec(map(&input)?);
            input[j] = base[j] - distance;
            let difference = (ahead - DVector::from_vec(map(&input)?)) * (weight / EPSILON);
            column = if k == 0 { difference } else { column + difference };
        }
        input[j] = base[j];
        columns.push(column);
    }
    Ok(if columns.is_empty() { DMatrix::zeros(0, 0) } else { DMatrix::from_columns(&columns) })
}

/// ln ρ(A) by Gelfand's formula, ρ(A) = lim ‖Aᴺ‖^(1/N), with N = 2⁵⁰ by repeated squaring.
///
/// ```text
/// A^(2N) = (Aᴺ)²,   ln ‖A^(2N)‖ = 2 ln ‖Aᴺ‖ + ln ‖(Aᴺ/‖Aᴺ‖)²‖
/// ```
///
/// The value is an upper bound for every N, it falls as N doubles, and a defective eigenvalue or a large
/// transient adds only ln(N^(k−1) κ)/N. Rounding in the squaring of Aᴺ changes the result by 1/N of
/// a unit in the last place, so that the first squarings decide: a few 10⁻¹⁵ in all.
/// Minus infinity for a nilpotent matrix; not a number if an entry is not finite.
///
/// ```
/// use nalgebra::dmatrix;
/// use verification::measure::spectral::log_spectral_radius;
/// let rotation_and_stretch = dmatrix![0.0, -2.0; 2.0, 0.0];
/// assert!((log_spectral_radius(&rotation_and_stretch) - 2f64.ln()).abs() < 1e-14);
/// ```
pub fn log_spectral_radius(matrix: &DMatrix<f64>) -> f64 {
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return f64::NAN;
    }
    let norm = matrix.norm();
    if norm == 0.0 {
        return f64::NEG_INFINITY;
    }
    let mut power = matrix / norm;
    let mut square = power.clone();
    let mut log_norm = norm.ln();
    let mut exponent = 1.0;
    for _ in 0..SQUARINGS {
        power.mul_to(&power, &mut square);
        let norm = square.norm();
        if norm == 0.0 {
            return f64::NEG_INFINITY;
        }
        std::mem::swap(&mut power, &mut square);
        power /= norm;
        let before = log_norm / exponent;
        log_norm = 2.0 * log_norm + norm.ln();
        exponent *= 2.0;
        let change = (log_norm / exponent - before).abs();
        if change <= CONVERGED * before.abs() {
            break;
        }
    }
    log_norm / exponent
}

/// Growth per step ρ(A) − 1.
pub fn growth(matrix: &DMatrix<f64>) -> f64 {
    log_spectral_radius(matrix).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;
    use rand_core::{Rng, SeedableRng};
    use rand_pcg::Pcg64;

    fn random_matrix(n: usize, seed: u64) -> DMatrix<f64> {
        let mut random = Pcg64::seed_from_u64(seed);
        DMatrix::from_fn(n, n, |_, _| (random.next_u64() >> 11) as f64 * 2f64.powi(-52) - 1.0)
    }

    #[test]
    fn radius_of_known_matrices() {
        let triangular = dmatrix![0.5, 100.0, -3.0; 0.0, -0.9, 7.0; 0.0, 0.0, 0.25];
        assert!((log_spectral_radius(&triangular) - 0.9f64.ln()).abs() < 1e-4);
        let jordan = dmatrix![1.0, 1.0, 0.0; 0.0, 1.0, 1.0; 0.0, 0.0, 1.0];
        assert!(growth(&jordan).abs() < 1e-12, "{}", growth(&jordan));
        let nilpotent = dmatrix![0.0, 1.0; 0.0, 0.0];
        assert_eq!(log_spectral_radius(&nilpotent), f64::NEG_INFINITY);
        assert!(log_spectral_radius(&dmatrix![f64::NAN]).is_nan());
    }

    /// Growth of 10⁻⁹ per step, behind a transient growth by a factor of a thousand.
    #[test]
    fn weak_growth_is_found_behind_a_transient() {
        let weak = dmatrix![1.0 + 1e-9, 1e3; 0.0, 0.999];
        let found = growth(&weak);
        assert!((found / 1e-9 - 1.0).abs() < 1e-3, "{found}");
    }

    #[test]
    fn radius_is_the_largest_modulus_of_the_eigenvalues() {
        for seed in 0..8 {
            let matrix = random_matrix(24, seed);
            let largest =
                matrix.complex_eigenvalues().iter().map(|e| e.norm()).fold(0.0, f64::max);
            let found = log_spectral_radius(&matrix).exp();
            assert!((found / largest - 1.0).abs() < 1e-3, "{found} {largest}");
        }
    }

    #[test]
    fn jacobian_of_a_rational_map() {
        let map = |x: &[f64]| -> Result<Vec<f64>, ()> {
            Ok(vec![x[0] / (1.0 + 0.7 * x[1]), x[0] * x[0] + (2.0 * x[1]).sin()])
        };
        let found = jacobian(&[1.0, 0.0], map).unwrap();
        let exact = dmatrix![1.0, -0.7; 2.0, 2.0];
        assert!((&found - &exact).amax() < 5e-14, "{found}");
    }
}
