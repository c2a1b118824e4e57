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
mod tests {
    use super::*;

    fn state(density: f64, velocity: f64) -> State {
        State { density, velocity }
    }

    /// Fan and shock, both mirrored, two shocks, two fans, nothing, strong ones, near vacuum.
    fn problems() -> Vec<IsothermalRiemann> {
        [
            (state(1000.4, 0.0), state(1000.04, 0.0)),
            (state(1000.04, 0.3), state(1000.4, 0.3)),
            (state(1000.0, 3.0), state(1001.0, -1.0)),
            (state(1000.0, -3.0), state(1001.0, 1.0)),
            (state(998.0, 2.0), state(998.0, 2.0)),
            (state(5000.0, 10.0), state(1.0, -20.0)),
            (state(1.0, 400.0), state(3.0, -300.0)),
            (state(2.0, -200.0), state(1.0, 300.0)),
        ]
        .map(|(left, right)| IsothermalRiemann::new(left, right, 50.0, 1000.0).unwrap())
        .to_vec()
    }

    #[test]
    fn problem_of_the_paper() {
        let at_rest = |pressure: f64| state(1000.0 + pressure / 2500.0, 0.0);
        let exact = IsothermalRiemann::new(at_rest(1000.0), at_rest(100.0), 50.0, 1000.0).unwrap();
        let star = exact.star();
        assert!((exact.pressure(star) - 549.95951).abs() < 5e-6, "{}", exact.pressure(star));
        assert!((star.velocity - 0.008_998_02).abs() < 5e-9, "{}", star.velocity);
        let place = |speed: f64| 0.5 + speed * 5e-3;
        assert!((place(exact.left_wave().head()) - 0.25).abs() < 1e-12);
        assert!((place(exact.left_wave().tail()) - 0.250_045).abs() < 5e-7);
        assert!((place(exact.right_wave().head()) - 0.750_022).abs() < 5e-7);
        assert!(!exact.left_wave().is_shock() && exact.right_wave().is_shock());
    }

    #[test]
    fn shocks_satisfy_the_jump_conditions_and_are_compressive() {
        let mut n_shocks = 0;
        for exact in problems() {
            let star = exact.star();
            for (wave, outer, sign) in
                [(exact.left_wave(), exact.left, -1.0), (exact.right_wave(), exact.right, 1.0)]
            {
                let Wave::Shock { speed } = wave else { continue };
                n_shocks += 1;
                let (a, b) = (star.velocity - speed, outer.velocity - speed);
                let mass = star.density * a - outer.density * b;
                let momentum = star.density * a * a - outer.density * b * b + exact.pressure(star)
                    - exact.pressure(outer);
                let scale = star.density * 50.0;
                assert!(mass.abs() < 1e-13 * scale, "{exact:?}: {mass}");
                let scale = scale * (50.0 + b.abs());
                assert!(momentum.abs() < 1e-13 * scale, "{exact:?}: {momentum}");
                assert!(sign * (speed - outer.velocity) > 50.0);
                assert!(sign * (speed - star.velocity) < 50.0);
            }
        }
        assert_eq!(n_shocks, 7);
    }

    #[test]
    fn fans_solve_the_equations_and_keep_the_riemann_invariant() {
        for exact in problems() {
            for (wave, outer, sign) in
                [(exact.left_wave(), exact.left, -1.0), (exact.right_wave(), exact.right, 1.0)]
            {
                let Wave::Fan { head, tail } = wave else { continue };
                if head == tail {
                    continue;
                }
                for i in 1..10 {
                    let ray = tail + (head - tail) * f64::from(i) / 10.0;
                    let here = exact.at(ray);
                    assert!((here.velocity + sign * 50.0 - ray).abs() < 1e-12 * head.abs());
                    let invariant = |s: State| s.velocity - sign * 50.0 * s.density.ln();
                    assert!((invariant(here) - invariant(outer)).abs() < 1e-10);
                    // Self-similar: −ξ q' + f' = 0.
                    let d = 1e-3 * (head - tail);
                    let (a, b) = (exact.at(ray - d), exact.at(ray + d));
                    let mass = |s: State| s.density * (s.velocity - ray);
                    let slope = (mass(b) - mass(a)) / (2.0 * d);
                    assert!(slope.abs() < 1e-4 * here.density, "{exact:?} {ray}: {slope}");
                    let force =
                        |s: State| s.density * s.velocity * (s.velocity - ray) + exact.pressure(s);
                    let slope = (force(b) - force(a)) / (2.0 * d);
                    let scale = here.density * (50.0 + here.velocity.abs());
                    assert!(slope.abs() < 1e-4 * scale, "{exact:?} {ray}: {slope}");
                }
                // Continuous at both edges.
                assert!((exact.at(head).density - outer.density).abs() < 1e-12 * outer.density);
                let inside = exact.at(tail + 1e-9 * (head - tail));
                let star = exact.star();
                assert!((inside.density / star.density - 1.0).abs() < 1e-7);
                assert!((inside.velocity - star.velocity).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn far_states_are_the_given_ones_and_a_uniform_state_stays() {
        for exact in problems() {
            assert_eq!(exact.at(f64::NEG_INFINITY), exact.left);
            assert_eq!(exact.at(f64::INFINITY), exact.right);
            assert_eq!(exact.at(exact.star().velocity), exact.star());
        }
        let uniform = problems()[4];
        for ray in [-100.0, 1.0, 2.0, 3.0, 100.0] {
            assert_eq!(uniform.at(ray), state(998.0, 2.0));
        }
    }

    #[test]
    fn bad_input_and_vacuum_are_refused() {
        let good = state(1000.0, 0.0);
        for bad in [state(0.0, 0.0), state(-1.0, 0.0), state(f64::NAN, 0.0), state(1.0, f64::NAN)] {
            assert!(IsothermalRiemann::new(bad, good, 50.0, 1000.0).is_err(), "{bad:?}");
            assert!(IsothermalRiemann::new(good, bad, 50.0, 1000.0).is_err(), "{bad:?}");
        }
        assert!(IsothermalRiemann::new(good, good, 0.0, 1000.0).is_err());
        assert!(IsothermalRiemann::new(good, good, 50.0, f64::INFINITY).is_err());
        let apart = |u: f64| IsothermalRiemann::new(state(1.0, -u), state(1.0, u), 1.0, 1.0);
        assert!(apart(700.0).is_ok());
        assert!(apart(710.0).is_err());
        assert!(apart(-1e150).is_ok());
        assert!(apart(-1e300).is_err());
    }
}
