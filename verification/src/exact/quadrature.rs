//! Integrals by composite Gauss-Legendre quadrature.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Nodes per panel.
const N_NODES: usize = 16;

/// Node and weight on [0, 1].
static RULE: LazyLock<[(f64, f64); N_NODES]> = LazyLock::new(rule);

/// Equal panels with 16 nodes each: exact for polynomials of degree 31 per panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panels {
    start: f64,
    width: f64,
    count: u32,
}

impl Panels {
    /// At least `n_panels` panels on `[start, end]`, at most 10⁷.
    pub(super) fn new(start: f64, end: f64, n_panels: f64) -> Self {
        let count = n_panels.ceil().clamp(1.0, 1e7) as u32;
        Self { start, width: (end - start) / f64::from(count), count }
    }

    /// ∫ f.
    pub(super) fn integrate(&self, f: impl Fn(f64) -> f64) -> f64 {
        let mut sum = 0.0;
        for panel in 0..self.count {
            let part: f64 = RULE
                .iter()
                .map(|&(node, weight)| {
                    weight * f(self.start + self.width * (f64::from(panel) + node))
                })
                .sum();
            sum += part;
        }
        sum * self.width
    }
}

/// Nodes and weights on [0, 1]: zeros of the Legendre polynomial by Newton's method.
fn rule() -> [(f64, f64); N_NODES] {
    std::array::from_fn(|i| {
        let mut x = (PI * (i as f64 + 0.75) / (N_NODES as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let value;
            (value, slope) = legendre(x);
            x -= value / slope;
        }
        (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// The Legendre polynomial of degree [`N_NODES`] and its derivative.
fn legendre(x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for degree in 2..=N_NODES {
        let n = degree as f64;
        (previous, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * previous) / n);
    }
    (value, N_NODES as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_degree_31_are_exact() {
        let panel = Panels::new(0.0, 1.0, 1.0);
        for degree in 0..32 {
            let found = panel.integrate(|x| x.powi(degree));
            assert!((found * f64::from(degree + 1) - 1.0).abs() < 1e-14, "{degree}");
        }
        assert!((panel.integrate(|x| x.powi(40)) * 41.0 - 1.0).abs() > 1e-14);
    }

    #[test]
    fn eight_radians_of_phase_per_panel_are_enough() {
        let panels = Panels::new(0.0, 80.0, 10.0);
        assert!((panels.integrate(f64::cos) - 80.0f64.sin()).abs() < 1e-13);
    }
}
