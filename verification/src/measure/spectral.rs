//! Growth per step of a linearised map: its Jacobian by differences, its spectral radius by powers.

use nalgebra::DMatrix;

/// Base distance of the differences: a power of two, so that perturbed inputs are exact.
///
/// The truncation error is 576 a₉ ε⁸ = 3·10⁻¹⁷ a₉, with a₉ the ninth Taylor coefficient (10⁴ where
/// points barely determine a fit), and the round-off of an output near 1 is 10⁻¹⁶/ε = 3·10⁻¹⁴.
const EPSILON: f64 = 1.0 / 256.0;

/// Weights of f(kε) − f(−kε), k = 1…4, in the eighth-order central difference of f′(0) ε.
const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];

/// Squarings of the matrix: the power 2⁵⁰ leaves ln(10³)/2⁵⁰ = 6·10⁻¹⁵ of a transient growth of
/// 10³.
const SQUARINGS: u32 = 50;

/// Number of the squaring that measures the kind of growth: N = 2¹⁶.
const DOUBLING: u32 = 16;

/// Pivots of the range below this share of the largest are round-off of the Jacobian.
const NEGLIGIBLE: f64 = 1e-12;

/// Relative change of the exponent between two squarings at which it counts as converged.
const CONVERGED: f64 = 1e-4;

/// The Jacobian of `map` at `base`, one column per input, by central differences of eighth order.
///
/// `map` writes as many numbers as it is given.
///
/// # Errors
/// The first error of the map.
pub fn jacobian<E>(
    base: &[f64],
    mut map: impl FnMut(&[f64], &mut [f64]) -> Result<(), E>,
) -> Result<DMatrix<f64>, E> {
    let n = base.len();
    let mut matrix = DMatrix::zeros(n, n);
    let mut input = base.to_vec();
    let (mut ahead, mut behind) = (vec![0.0; n], vec![0.0; n]);
    for (j, mut column) in matrix.column_iter_mut().enumerate() {
        for (k, weight) in WEIGHTS.iter().enumerate() {
            let distance = (k + 1) as f64 * EPSILON;
            input[j] = base[j] + distance;
            map(&input, &mut ahead)?;
            input[j] = base[j] - distance;
            map(&input, &mut behind)?;
            for ((entry, ahead), behind) in column.iter_mut().zip(&ahead).zip(&behind) {
                *entry += (ahead - behind) * (weight / EPSILON);
            }
        }
        input[j] = base[j];
    }
    Ok(matrix)
}

/// How the powers of a matrix grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// ln ρ(A); minus infinity for a nilpotent matrix.
    pub log_radius: f64,
    /// log₂ ‖A^(2N)‖/‖Aᴺ‖ at N = 2¹⁶: 0 if the powers stay bounded, 1 if they grow linearly (a
    /// defective eigenvalue of modulus 1), N (ρ − 1)/ln 2 if they grow exponentially.
    pub doubling: f64,
}

impl Spectrum {
    /// Growth per step ρ(A) − 1.
    pub fn growth(&self) -> f64 {
        self.log_radius.exp_m1()
    }
}

/// ln ρ(A) by Gelfand's formula, ρ(A) = lim ‖Aᴺ‖^(1/N), with N = 2⁵⁰ by repeated squaring.
///
/// ```text
/// A^(2N) = (Aᴺ)²,   ln ‖A^(2N)‖ = 2 ln ‖Aᴺ‖ + ln ‖(Aᴺ/‖Aᴺ‖)²‖
/// ```
///
/// The value is an upper bound for every N, it falls as N doubles, and a large transient κ or a
/// defective eigenvalue adds only ln(κ N)/N. Rounding in the squaring of Aᴺ changes the result by
/// 1/N of a unit in the last place, so that the first squarings decide. Once ln ρ changes by less than
/// 10⁻⁴ of itself the squaring ends early: a fast growth is known to that share only. Errors
/// δ in the entries of A itself move a defective eigenvalue by √δ, which [`Spectrum::doubling`]
/// tells apart.
///
/// ```
/// use nalgebra::dmatrix;
/// use verification::measure::spectral::spectrum;
/// let rotation_and_stretch = dmatrix![0.0, -2.0; 2.0, 0.0];
/// assert!((spectrum(&rotation_and_stretch).growth() - 1.0).abs() < 1e-5);
/// ```
pub fn spectrum(matrix: &DMatrix<f64>) -> Spectrum {
    if matrix.iter().any(|entry| !entry.is_finite()) {
        return Spectrum { log_radius: f64::NAN, doubling: f64::NAN };
    }
    let mut power = without_null_space(matrix);
    let norm = power.norm();
    let nilpotent = Spectrum { log_radius: f64::NEG_INFINITY, doubling: f64::NEG_INFINITY };
    if norm == 0.0 {
        return nilpotent;
    }
    power /= norm;
    let mut square = power.clone();
    let mut log_norm = norm.ln();
    let mut exponent = 1.0;
    let mut doubling = f64::NAN;
    for squaring in 0..SQUARINGS {
        power.mul_to(&power, &mut square);
        let norm = square.norm();
        if norm == 0.0 {
            return nilpotent;
        }
        std::mem::swap(&mut power, &mut square);
        power /= norm;
        let before = log_norm;
        log_norm = 2.0 * before + norm.ln();
        if squaring <= DOUBLING {
            doubling = (log_norm - before) / std::f64::consts::LN_2;
        }
        let change = (0.5 * log_norm - before).abs();
        exponent *= 2.0;
        if squaring > DOUBLING && change <= CONVERGED * before.abs() {
            break;
        }
    }
    Spectrum { log_radius: log_norm / exponent, doubling }
}

/// A smaller matrix with the same eigenvalues but for zeros: with A = Q B, Q an orthonormal basis
/// of the range, it is B Q. Steps that forget part of the state, as affine transfer does, shrink a
/// lot.
fn without_null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let factors = matrix.clone().col_piv_qr();
    let mut range = factors.r();
    let smallest = NEGLIGIBLE * range[(0, 0)].abs();
    let rank = (0..range.nrows()).take_while(|&k| range[(k, k)].abs() > smallest).count();
    if rank == matrix.nrows() || rank == 0 {
        return matrix.clone();
    }
    factors.p().inv_permute_columns(&mut range);
    // As (Qᵀ Bᵀ)ᵀ, which spares forming Q.
    let mut product = range.rows(0, rank).transpose();
    factors.q_tr_mul(&mut product);
    product.rows(0, rank).transpose()
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
        assert!((spectrum(&triangular).log_radius - 0.9f64.ln()).abs() < 1e-4);
        let rank_one = dmatrix![1.0, 2.0; 0.5, 1.0];
        assert!((spectrum(&rank_one).log_radius - 2f64.ln()).abs() < 1e-12);
        let nilpotent = dmatrix![0.0, 1.0; 0.0, 0.0];
        assert_eq!(spectrum(&nilpotent).log_radius, f64::NEG_INFINITY);
        assert!(spectrum(&dmatrix![f64::NAN]).log_radius.is_nan());
    }

    #[test]
    fn bounded_linear_and_exponential_growth_are_told_apart() {
        let (sine, cosine) = 0.3f64.sin_cos();
        let bounded = spectrum(&dmatrix![cosine, -sine; sine, cosine]);
        assert!(bounded.growth().abs() < 1e-13 && bounded.doubling.abs() < 1e-6, "{bounded:?}");
        let linear = spectrum(&dmatrix![1.0, 1.0; 0.0, 1.0]);
        assert!(linear.growth().abs() < 1e-12 && (linear.doubling - 1.0).abs() < 1e-6);
        // Growth of 10⁻⁹ per step behind a transient growth by a factor of a million.
        let weak = spectrum(&dmatrix![1.0 + 1e-9, 1e3; 0.0, 0.999]);
        assert!((weak.growth() / 1e-9 - 1.0).abs() < 1e-3, "{weak:?}");
        assert!((weak.doubling - 65536e-9 / 2f64.ln()).abs() < 1e-6, "{weak:?}");
    }

    #[test]
    fn radius_is_the_largest_modulus_of_the_eigenvalues() {
        for seed in 0..8 {
            let mut matrix = random_matrix(24, seed);
            if seed % 2 == 1 {
                // Rank 15 of 24.
                matrix = matrix.columns(0, 15) * random_matrix(15, seed + 100).resize(15, 24, 0.5);
            }
            let largest = matrix.complex_eigenvalues().iter().map(|e| e.norm()).fold(0.0, f64::max);
            let found = spectrum(&matrix).log_radius.exp();
            assert!((found / largest - 1.0).abs() < 1e-3, "{found} {largest}");
        }
    }

    #[test]
    fn jacobian_of_a_rational_map() {
        let map = |x: &[f64], out: &mut [f64]| -> Result<(), ()> {
            out.copy_from_slice(&[x[0] / (1.0 + 0.7 * x[1]), x[0] * x[0] + (2.0 * x[1]).sin()]);
            Ok(())
        };
        let found = jacobian(&[1.0, 0.0], map).unwrap();
        let exact = dmatrix![1.0, -0.7; 2.0, 2.0];
        assert!((&found - &exact).amax() < 2e-13, "{found}");
    }
}
