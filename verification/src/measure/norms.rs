//! Error norms.

/// Σ e² V and Σ q² V, summed in the order of the samples.
///
/// With particles as samples and V = m/ρ this is Eq. (40) of \[Song2020\] (`point-l2`); with cell
/// centres and cell volumes it is Eq. (41) (`gauss-l2`). The unit is that of the field times
/// m^(D/2).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct L2 {
    error: f64,
    exact: f64,
}

impl L2 {
    /// Adds a sample: squared error, squared exact value, volume m^D.
    pub fn add(&mut self, error_squared: f64, exact_squared: f64, volume: f64) {
        self.error += error_squared * volume;
        self.exact += exact_squared * volume;
    }

    /// √(Σ e² V).
    pub fn error(&self) -> f64 {
        self.error.sqrt()
    }

    /// √(Σ q² V) of the exact field, for relative errors.
    pub fn exact(&self) -> f64 {
        self.exact.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn midpoint_samples_of_a_sine_give_its_mean_square() {
        let n = 64;
        let mut norm = L2::default();
        for i in 0..n {
            let x = (f64::from(i) + 0.5) / f64::from(n);
            norm.add((0.1 * (TAU * x).sin()).powi(2), (TAU * x).sin().powi(2), 1.0 / f64::from(n));
        }
        assert!((norm.exact() - 0.5f64.sqrt()).abs() < 1e-14);
        assert!((norm.error() - 0.1 * 0.5f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn constant_error_on_a_known_area() {
        let mut norm = L2::default();
        for _ in 0..40 {
            norm.add(9.0, 16.0, 0.1 / 40.0);
        }
        assert!((norm.error() - 3.0 * 0.1f64.sqrt()).abs() < 1e-14);
        assert!((norm.exact() - 4.0 * 0.1f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn a_value_that_is_not_a_number_is_not_hidden() {
        let mut norm = L2::default();
        norm.add(f64::NAN, 1.0, 1.0);
        norm.add(0.0, 1.0, 1.0);
        assert!(norm.error().is_nan());
    }
}
