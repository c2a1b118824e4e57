//! Riemann problem of an ideal gas: Euler equations with energy.
//!
//! \[Toro2009\], Chapter 4. With A = 2/((γ+1)ρ), B = (γ−1)p/(γ+1) and the speed of sound
//! a = √(γp/ρ) of the side K, the pressure between the waves is the root of f_L + f_R + u_R − u_L,
//!
//! ```text
//! f_K(p*) = (p* − p) √(A / (p* + B))                      p* > p, shock
//!           2a/(γ−1) [(p*/p)^((γ−1)/2γ) − 1]              p* ≤ p, fan
//! u* = (u_L + u_R)/2 + (f_R − f_L)/2,   p = (γ − 1) ρ e
//! ```
//!
//! found by Newton's method inside a bracket that bisection tightens.

use super::riemann::{Wave, log_ratio};
use anyhow::{Result, ensure};

/// Density, velocity and pressure on one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Velocity u, m/s.
    pub velocity: f64,
    /// Pressure p, Pa.
    pub pressure: f64,
}

impl State {
    fn mirrored(self) -> Self {
        Self { velocity: -self.velocity, ..self }
    }
}

/// The shock tube of \[Sod1978\], left and right state, γ = 1.4: fan, contact, shock.
pub const SOD: [State; 2] = [
    State { density: 1.0, velocity: 0.0, pressure: 1.0 },
    State { density: 0.125, velocity: 0.0, pressure: 0.1 },
];

/// The 1-2-0-3 problem of \[Einfeldt1991\], γ = 1.4: two fans with nearly a vacuum between them.
pub const NEAR_VACUUM: [State; 2] = [
    State { density: 1.0, velocity: -2.0, pressure: 0.4 },
    State { density: 1.0, velocity: 2.0, pressure: 0.4 },
];

/// The solution of a Riemann problem, a function of x/t.
///
/// ```
/// use verification::exact::ideal_gas_riemann::{IdealGasRiemann, SOD};
/// let [left, right] = IdealGasRiemann::new(SOD[0], SOD[1], 1.4)?.star();
/// assert!((left.pressure - 0.30313).abs() < 5e-6);
/// assert!((left.density - 0.42632).abs() < 5e-6 && (right.density - 0.26557).abs() < 5e-6);
/// # Ok::<(), anyhow::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IdealGasRiemann {
    left: State,
    right: State,
    star: [State; 2],
    ratio: f64,
}

impl IdealGasRiemann {
    /// Solves for the star states; `ratio` is the ratio γ of the specific heats.
    ///
    /// # Errors
    ///
    /// If a density or pressure is not positive and finite, if a velocity is not finite, if γ is
    /// not above 1, or if the sides part so fast that a vacuum opens: at
    /// u_R − u_L ≥ 2(a_L + a_R)/(γ − 1), \[Toro2009\], Chapter 4.
    pub fn new(left: State, right: State, ratio: f64) -> Result<Self> {
        for (side, state) in [("left", left), ("right", right)] {
            for (name, value) in [("density", state.density), ("pressure", state.pressure)] {
                ensure!(
                    value.is_normal() && value > 0.0,
                    "{side} {name} is {value}; allowed: above 0, finite"
                );
            }
            ensure!(
                state.velocity.is_finite(),
                "{side} velocity is {}; allowed: finite",
                state.velocity
            );
        }
        ensure!(
            ratio > 1.0 && ratio.is_finite(),
            "ratio of specific heats is {ratio}; allowed: above 1, finite"
        );
        let gas = Gas { ratio };
        let approach = left.velocity - right.velocity;
        let limit = 2.0 / (ratio - 1.0) * (gas.sound_speed(left) + gas.sound_speed(right));
        ensure!(
            -approach < limit,
            "the sides part at {} m/s; allowed: below {limit} m/s, else a vacuum opens",
            -approach
        );
        let Some(pressure) = gas.star_pressure(left, right) else {
            anyhow::bail!("pressure between the waves is not a positive number (close to vacuum)");
        };
        let velocity = 0.5 * (left.velocity + right.velocity)
            + 0.5 * (gas.change(right, pressure).0 - gas.change(left, pressure).0);
        let star = [left, right].map(|outer| State {
            density: gas.star_density(outer, pressure),
            velocity,
            pressure,
        });
        ensure!(
            velocity.is_finite() && star.iter().all(|s| s.density.is_normal()),
            "density between the waves is not a positive number (close to vacuum)"
        );
        Ok(Self { left, right, star, ratio })
    }

    /// The states left and right of the contact; same velocity, same pressure.
    pub fn star(&self) -> [State; 2] {
        self.star
    }

    /// Internal energy per mass e = p / ((γ − 1) ρ) of a state, J/kg.
    pub fn internal_energy(&self, state: State) -> f64 {
        state.pressure / ((self.ratio - 1.0) * state.density)
    }

    /// The wave that runs into the left state, at u − a in a fan.
    pub fn left_wave(&self) -> Wave {
        self.gas().wave(self.left.mirrored(), self.star[0].mirrored()).mirrored()
    }

    /// The wave that runs into the right state, at u + a in a fan.
    pub fn right_wave(&self) -> Wave {
        self.gas().wave(self.right, self.star[1])
    }

    /// Speed u* of the contact, m/s.
    pub fn contact(&self) -> f64 {
        self.star[0].velocity
    }

    /// The state on the ray x/t (m/s) from the interface; ±∞ at t = 0. Behind a shock on its ray.
    pub fn at(&self, x_over_t: f64) -> State {
        let gas = self.gas();
        if x_over_t < self.contact() {
            gas.sample(self.left.mirrored(), self.star[0].mirrored(), -x_over_t).mirrored()
        } else {
            gas.sample(self.right, self.star[1], x_over_t)
        }
    }

    fn gas(&self) -> Gas {
        Gas { ratio: self.ratio }
    }
}

/// One side of a problem, seen so that its wave runs to the right.
#[derive(Clone, Copy)]
struct Gas {
    ratio: f64,
}

impl Gas {
    /// a = √(γp/ρ), m/s.
    fn sound_speed(self, state: State) -> f64 {
        (self.ratio * state.pressure / state.density).sqrt()
    }

    /// f_K(p*) and its derivative: change of velocity over the wave.
    fn change(self, outer: State, pressure: f64) -> (f64, f64) {
        let g = self.ratio;
        if pressure > outer.pressure {
            let b = (g - 1.0) / (g + 1.0) * outer.pressure;
            let root = (2.0 / ((g + 1.0) * outer.density) / (pressure + b)).sqrt();
            let jump = pressure - outer.pressure;
            (jump * root, root * (1.0 - 0.5 * jump / (pressure + b)))
        } else {
            let (a, log) = (self.sound_speed(outer), log_ratio(pressure, outer.pressure));
            let change = 2.0 * a / (g - 1.0) * ((g - 1.0) / (2.0 * g) * log).exp_m1();
            let slope = (-(g + 1.0) / (2.0 * g) * log).exp() / (outer.density * a);
            (change, slope)
        }
    }

    /// p*: Newton's method, or bisection of ln p where a step leaves the bracket.
    fn star_pressure(self, left: State, right: State) -> Option<f64> {
        let excess = |pressure: f64| {
            let ((fl, dl), (fr, dr)) = (self.change(left, pressure), self.change(right, pressure));
            (fl + fr + right.velocity - left.velocity, dl + dr)
        };
        let mut low = left.pressure.min(right.pressure);
        while excess(low).0 > 0.0 {
            low *= 0.0625;
            if !low.is_normal() {
                return None;
            }
        }
        let mut high = left.pressure.max(right.pressure);
        while excess(high).0 < 0.0 {
            high *= 16.0;
            if !high.is_finite() {
                return None;
            }
        }
        let mut pressure = low.sqrt() * high.sqrt();
        for _ in 0..200 {
            let (value, slope) = excess(pressure);
            if value > 0.0 {
                high = pressure;
            } else {
                low = pressure;
            }
            let step = value / slope;
            let mut next = pressure - step;
            if !(next >= low && next <= high) {
                next = low.sqrt() * high.sqrt();
            }
            if (next - pressure).abs() <= 2.0 * f64::EPSILON * pressure {
                return Some(next);
            }
            pressure = next;
        }
        Some(pressure)
    }

    /// Density behind the wave, kg/m³: Hugoniot curve or isentrope.
    fn star_density(self, outer: State, pressure: f64) -> f64 {
        let strength = pressure / outer.pressure;
        if strength > 1.0 {
            let b = (self.ratio - 1.0) / (self.ratio + 1.0);
            outer.density * (strength + b) / (b * strength + 1.0)
        } else {
            outer.density * strength.powf(1.0 / self.ratio)
        }
    }

    fn wave(self, outer: State, star: State) -> Wave {
        let (g, a) = (self.ratio, self.sound_speed(outer));
        if star.pressure > outer.pressure {
            let strength = star.pressure / outer.pressure;
            let mach = ((g + 1.0) / (2.0 * g) * strength + (g - 1.0) / (2.0 * g)).sqrt();
            Wave::Shock { speed: outer.velocity + a * mach }
        } else {
            let tail = star.velocity + self.sound_speed(star);
            Wave::Fan { head: outer.velocity + a, tail }
        }
    }

    /// The state on a ray right of the contact; in a fan u + a = x/t and u − 2a/(γ−1) is constant.
    fn sample(self, outer: State, star: State, ray: f64) -> State {
        let (g, a) = (self.ratio, self.sound_speed(outer));
        match self.wave(outer, star) {
            Wave::Shock { speed } if ray > speed => outer,
            Wave::Fan { head, .. } if ray >= head => outer,
            Wave::Fan { tail, .. } if ray > tail => {
                let cooling = (2.0 + (g - 1.0) / a * (ray - outer.velocity)) / (g + 1.0);
                State {
                    density: outer.density * cooling.powf(2.0 / (g - 1.0)),
                    velocity: ray - a * cooling,
                    pressure: outer.pressure * cooling.powf(2.0 * g / (g - 1.0)),
                }
            }
            _ => star,
        }
    }
}

#[cfg(test)]
mod tests;
