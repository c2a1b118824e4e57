//! Solitary wave on water of constant depth, of third order in its height, \[Grimshaw1971\].
//!
//! With lengths over the depth h, velocities over √(gh), ε = a/h, s = sech αX, t = tanh αX, X = x − ct and the height z
//! above the bed, in the form of \[LeeSkjelbreiaRaichlen1982\]:
//!
//! ```text
//! α² = ¾ ε (1 − ⅝ ε + 71/128 ε²)²,   c² = 1 + ε − ε²/20 − 3ε³/70
//! η = 1 + ε s² − ¾ ε² s² t² + ε³ (⅝ s² t² − 101/80 s⁴ t²)
//! u = ε s² − ε² (−¼ s² + s⁴ + z² (3/2 s² − 9/4 s⁴)) − ε³ (19/40 s² + ⅕ s⁴ − 6/5 s⁶
//!     + z² (−3/2 s² − 15/4 s⁴ + 15/2 s⁶) + z⁴ (−⅜ s² + 45/16 s⁴ − 45/16 s⁶))
//! v = √(3ε) z t (ε s² − ε² (⅜ s² + 2 s⁴ + z² (½ s² − 3/2 s⁴)) − ε³ (49/640 s² − 17/20 s⁴ − 18/5 s⁶
//!     + z² (−13/16 s² − 25/16 s⁴ + 15/2 s⁶) + z⁴ (−3/40 s² + 9/8 s⁴ − 27/16 s⁶)))
//! ```
//!
//! Pressure by the equation of Bernoulli in the frame that moves along. What is left out is of order ε⁴.

/// A wave that runs towards larger x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolitaryWave {
    /// Depth h of the water at rest, m.
    pub depth: f64,
    /// Height of the crest above it over the depth, ε.
    pub height: f64,
    /// Acceleration downwards g, m/s².
    pub gravity: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
}

impl SolitaryWave {
    /// √(gh), m/s.
    fn scale(&self) -> f64 {
        (self.gravity * self.depth).sqrt()
    }

    /// c, m/s.
    pub fn celerity(&self) -> f64 {
        let e = self.height;
        self.scale() * (1.0 + e - e * e / 20.0 - 3.0 * e.powi(3) / 70.0).sqrt()
    }

    /// s² and t at a distance from the crest, m.
    fn shape(&self, from_crest: f64) -> [f64; 2] {
        let e = self.height;
        let decay = (0.75 * e).sqrt() * (1.0 - 0.625 * e + 71.0 / 128.0 * e * e);
        let argument = decay * from_crest / self.depth;
        [argument.cosh().powi(-2), argument.tanh()]
    }

    /// Height of the surface above the bed, m.
    pub fn surface(&self, from_crest: f64) -> f64 {
        let ([s2, t], e) = (self.shape(from_crest), self.height);
        let second = 0.75 * s2 * t * t;
        let third = (0.625 - 101.0 / 80.0 * s2) * s2 * t * t;
        self.depth * (1.0 + e * s2 - e * e * second + e.powi(3) * third)
    }

    /// Velocity, m/s, at a distance from the crest and a height above the bed, m.
    pub fn velocity(&self, [from_crest, above_bed]: [f64; 2]) -> [f64; 2] {
        let ([s2, t], e) = (self.shape(from_crest), self.height);
        let (s4, s6) = (s2 * s2, s2 * s2 * s2);
        let z = above_bed / self.depth;
        let z2 = z * z;
        let polynomial =
            |constant: f64, square: f64, fourth: f64| constant + z2 * (square + z2 * fourth);
        let second = polynomial(s4 - 0.25 * s2, 1.5 * s2 - 2.25 * s4, 0.0);
        let third = polynomial(
            0.475 * s2 + 0.2 * s4 - 1.2 * s6,
            7.5 * s6 - 3.75 * s4 - 1.5 * s2,
            2.8125 * (s4 - s6) - 0.375 * s2,
        );
        let along = e * s2 - e * e * second - e.powi(3) * third;
        let second = polynomial(0.375 * s2 + 2.0 * s4, 0.5 * s2 - 1.5 * s4, 0.0);
        let third = polynomial(
            49.0 / 640.0 * s2 - 0.85 * s4 - 3.6 * s6,
            7.5 * s6 - 1.5625 * s4 - 0.8125 * s2,
            1.125 * s4 - 0.075 * s2 - 1.6875 * s6,
        );
        let up = (3.0 * e).sqrt() * z * t * (e * s2 - e * e * second - e.powi(3) * third);
        [self.scale() * along, self.scale() * up]
    }

    /// Pressure, Pa.
    pub fn pressure(&self, place: [f64; 2]) -> f64 {
        let [u, v] = self.velocity(place);
        let c = self.celerity();
        let dynamic = 0.5 * (c * c - (u - c).powi(2) - v * v);
        self.density * (self.gravity * (self.depth - place[1]) + dynamic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(height: f64) -> SolitaryWave {
        SolitaryWave { depth: 1.0, height, gravity: 1.0, density: 1.0 }
    }

    /// Largest divergence, rotation, flux through the surface and pressure on it.
    fn residuals(wave: &SolitaryWave) -> [f64; 4] {
        let step = 1e-4;
        let mut largest = [0.0_f64; 4];
        for i in -40..=40 {
            let x = f64::from(i) / 10.0 * (0.75 * wave.height).sqrt().recip();
            for z in [0.2, 0.6, 1.0] {
                let along = |field: usize| {
                    let moved = |by: f64| wave.velocity([x + by, z])[field];
                    (moved(step) - moved(-step)) / (2.0 * step)
                };
                let up = |field: usize| {
                    let moved = |by: f64| wave.velocity([x, z + by])[field];
                    (moved(step) - moved(-step)) / (2.0 * step)
                };
                largest[0] = largest[0].max((along(0) + up(1)).abs());
                largest[1] = largest[1].max((along(1) - up(0)).abs());
            }
            let surface = wave.surface(x);
            let slope = (wave.surface(x + step) - wave.surface(x - step)) / (2.0 * step);
            let [u, v] = wave.velocity([x, surface]);
            largest[2] = largest[2].max(((u - wave.celerity()) * slope - v).abs());
            largest[3] = largest[3].max(wave.pressure([x, surface]).abs());
        }
        largest
    }

    /// Halving ε takes each to a sixteenth: what is left out is of order ε⁴.
    #[test]
    fn it_solves_the_equations_of_water_waves_to_third_order() {
        let (high, low) = (residuals(&wave(0.1)), residuals(&wave(0.05)));
        for (high, low) in high.into_iter().zip(low) {
            assert!(high < 5e-4 && low > 0.0, "{high} {low}");
            assert!((high / low).log2() > 3.9, "{high} {low}");
        }
    }

    #[test]
    fn its_crest_is_as_high_as_it_says_and_runs_as_waves_do() {
        let wave = SolitaryWave { depth: 2.0, height: 0.2, gravity: 9.81, density: 1000.0 };
        assert_eq!(wave.surface(0.0), 2.4);
        assert!((wave.surface(100.0) - 2.0).abs() < 1e-9);
        let first = (9.81_f64 * 2.4).sqrt();
        assert!((wave.celerity() / first - 1.0).abs() < 0.002, "{}", wave.celerity());
        let rest = wave.pressure([100.0, 0.5]);
        assert!((rest / (1000.0 * 9.81 * 1.5) - 1.0).abs() < 1e-9, "{rest}");
    }
}
