//! Riemann problem of the weakly compressible fluid: Euler equations with a constant speed of
//! sound.
//!
//! ```text
//! ρ_t + (ρu)_x = 0,   (ρu)_t + (ρu² + p)_x = 0,   p = c₀² (ρ − ρ₀)
//! ```
//!
//! The pressure law is Eq. (35) of \[Song2020\]. Each of the two waves is a shock or a centered fan.
//! With d = ln(ρ*/ρ_K) on the side K, the Rankine-Hugoniot conditions and the Riemann invariants
//! u ± c₀ ln ρ (\[LeVeque2002\]) give
//!
//! ```text
//! u* = u_L − c₀ φ(d_L) = u_R + c₀ φ(d_R),   φ(d) = d           d ≤ 0, fan
//!                                           φ(d) = 2 sinh(d/2)  d > 0, shock
//! ```
//!
//! φ is increasing and convex, so that Newton's method from an upper bound falls to the one root
//! monotonically. There is always a root: this fluid has no vacuum at any finite velocity, only a
//! density too small for a number.

use super::riemann::{Wave, log_ratio};
use anyhow::{Result, ensure};

/// Density and velocity on one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Velocity u, m/s.
    pub velocity: f64,
}

impl State {
    fn mirrored(self) -> Self {
        Self { density: self.density, velocity: -self.velocity }
    }
}

/// The solution of a Riemann problem, a function of x/t.
///
/// ```
/// use verification::exact::isothermal_riemann::{IsothermalRiemann, State};
/// // \[Song2020\], Section 4.2: 1000 Pa against 100 Pa, ρ₀ = 1000 kg/m³, c₀ = 50 m/s.
/// let at_rest = |pressure: f64| State { density: 1000.0 + pressure / 2500.0, velocity: 0.0 };
/// let exact = IsothermalRiemann::new(at_rest(1000.0), at_rest(100.0), 50.0, 1000.0)?;
/// assert!((exact.pressure(exact.star()) - 549.95951).abs() < 1e-5);
/// assert_eq!(exact.at(-51.0), at_rest(1000.0));
/// # Ok::<(), anyhow::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IsothermalRiemann {
    left: State,
    right: State,
    star: State,
    sound_speed: f64,
    reference_density: f64,
}

impl IsothermalRiemann {
    /// Solves for the star state; sound speed c₀ in m/s, reference density ρ₀ in kg/m³.
    ///
    /// # Errors
    ///
    /// If a density, c₀ or ρ₀ is not positive and finite, if a velocity is not finite, or if the
    /// star density is below the smallest number of full precision (vacuum) or too large for one.
    pub fn new(
        left: State,
        right: State,
        sound_speed: f64,
        reference_density: f64,
    ) -> Result<Self> {
        for (name, value) in [
            ("left density", left.density),
            ("right density", right.density),
            ("sound speed", sound_speed),
            ("reference density", reference_density),
        ] {
            ensure!(
                value > 0.0 && value.is_finite(),
                "{name} is {value}; allowed: above 0, finite"
            );
        }
        let approach = (left.velocity - right.velocity) / sound_speed;
        ensure!(
            approach.is_finite(),
            "velocities are {} and {}; allowed: a finite difference",
            left.velocity,
            right.velocity
        );
        let gap = log_ratio(left.density, right.density);
        let d = star_log_ratio(gap, approach);
        let star = State {
            density: left.density * d.exp(),
            velocity: 0.5 * (left.velocity + right.velocity)
                + 0.5 * sound_speed * (phi(d + gap) - phi(d)),
        };
        ensure!(
            star.density.is_normal() && star.velocity.is_finite(),
            "star density is {:e}, star velocity {:e}; allowed: a normal number (no vacuum)",
            star.density,
            star.velocity
        );
        Ok(Self { left, right, star, sound_speed, reference_density })
    }

    /// The state between the two waves.
    pub fn star(&self) -> State {
        self.star
    }

    /// Pressure c₀² (ρ − ρ₀) of a state, Eq. (35) of \[Song2020\], Pa.
    pub fn pressure(&self, state: State) -> f64 {
        self.sound_speed.powi(2) * (state.density - self.reference_density)
    }

    /// The wave that runs into the left state, at u − c₀ in a fan.
    pub fn left_wave(&self) -> Wave {
        self.wave(self.left.mirrored(), self.star.mirrored()).mirrored()
    }

    /// The wave that runs into the right state, at u + c₀ in a fan.
    pub fn right_wave(&self) -> Wave {
        self.wave(self.right, self.star)
    }

    /// The state on the ray x/t (m/s) from the interface; ±∞ at t = 0. Behind a shock on its ray.
    pub fn at(&self, x_over_t: f64) -> State {
        if x_over_t < self.star.velocity {
            self.sample(self.left.mirrored(), self.star.mirrored(), -x_over_t).mirrored()
        } else {
            self.sample(self.right, self.star, x_over_t)
        }
    }

    /// The wave from `star` that runs to the right into `outer`.
    fn wave(&self, outer: State, star: State) -> Wave {
        let c = self.sound_speed;
        if star.density > outer.density {
            // Mass balance: s = (ρ*u* − ρu) / (ρ* − ρ) = u + c √(ρ*/ρ).
            Wave::Shock { speed: outer.velocity + c * (star.density / outer.density).sqrt() }
        } else {
            Wave::Fan { head: outer.velocity + c, tail: star.velocity + c }
        }
    }

    /// The state on a ray to the right of the star velocity.
    fn sample(&self, outer: State, star: State, ray: f64) -> State {
        let c = self.sound_speed;
        match self.wave(outer, star) {
            Wave::Shock { speed } if ray > speed => outer,
            Wave::Fan { head, .. } if ray >= head => outer,
            Wave::Fan { tail, .. } if ray > tail => {
                // u + c = x/t and u − c ln ρ as in the outer state.
                let velocity = ray - c;
                let density = outer.density * ((velocity - outer.velocity) / c).exp();
                State { density, velocity }
            }
            _ => star,
        }
    }
}

/// φ(d): change of velocity over a wave in sound speeds.
fn phi(d: f64) -> f64 {
    if d > 0.0 { 2.0 * (0.5 * d).sinh() } else { d }
}

/// d_L = ln(ρ*/ρ_L) from φ(d) + φ(d + gap) = approach.
fn star_log_ratio(gap: f64, approach: f64) -> f64 {
    let slope = |d: f64| if d > 0.0 { (0.5 * d).cosh() } else { 1.0 };
    // Two upper bounds of the root: φ(d) ≥ d; and φ(s) ≥ 2 sinh(s/2) from the denser state on.
    let fans = 0.5 * (approach - gap);
    let shocks = (-gap).max(0.0) + 2.0 * (0.25 * approach.max(0.0)).asinh();
    let mut d = fans.min(shocks);
    // Every step is a decrease; far away by 1 at least, and |d| < 2000.
    for _ in 0..4000 {
        let residual = phi(d) + phi(d + gap) - approach;
        let next = d - residual / (slope(d) + slope(d + gap));
        if !(next < d) {
            break;
        }
        d = next;
    }
    d
}

#[cfg(test)]
mod tests;
