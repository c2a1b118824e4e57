//! A smooth field without symmetry about the box, for studies without time.

use std::f64::consts::TAU;

/// Wave numbers and phases: f = sin(k x + a) cos(k y + b) with k = 2π.
const PHASES: [f64; 2] = [0.3, -0.5];

/// Value of the field at a place, place in box lengths.
///
/// ```
/// use verification::exact::smooth_field::{gradient, value};
/// let (x, d) = ([0.2, 0.7], 1e-6);
/// let slope = (value([x[0] + d, x[1]]) - value([x[0] - d, x[1]])) / (2.0 * d);
/// assert!((slope - gradient(x)[0]).abs() < 1e-8);
/// ```
pub fn value(x: [f64; 2]) -> f64 {
    let [a, b] = angles(x);
    a.sin() * b.cos()
}

/// Its gradient.
pub fn gradient(x: [f64; 2]) -> [f64; 2] {
    let [a, b] = angles(x);
    [TAU * a.cos() * b.cos(), -TAU * a.sin() * b.sin()]
}

/// A velocity field (f, ∂f/∂y / 2π) that is neither free of divergence nor of rotation.
pub fn velocity(x: [f64; 2]) -> [f64; 2] {
    [value(x), gradient(x)[1] / TAU]
}

/// Divergence of [`velocity`]: ∂f/∂x + ∂²f/∂y²/2π.
pub fn divergence(x: [f64; 2]) -> f64 {
    gradient(x)[0] - TAU * value(x)
}

fn angles(x: [f64; 2]) -> [f64; 2] {
    [TAU * x[0] + PHASES[0], TAU * x[1] + PHASES[1]]
}
