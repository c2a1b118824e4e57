//! The von Neumann analysis of one step on a lattice of points in one dimension.
//!
//! With h = c = ρ₀ = 1, n points in every cell and a field of phase e^{iθ} from cell to cell, a step is a matrix on the
//! velocities v_p, the relative changes of density e_p and, with affine transfer, the gradients C_p of the points of one
//! cell:
//!
//! ```text
//! N̂_p = Σ_k N_k(x_p) e^{iθk},   Ĝ_p the same of dN_k/dx,   M̂_p of N_k (x_k − x_p)
//! v = Σ_p (N̂_p* v_p + M̂_p* C_p)/n,   a = Σ_p Ĝ_p* e_p/n,   e_p ← e_p − Δt Ĝ_p v⁺
//! ```
//!
//! What is printed here follows from the formulas of the methods alone and shares nothing with the solver but the shape
//! functions.

use nalgebra::{Complex, DMatrix, RowDVector};
use transpoint::formulation::{Formulation, PointDivergence};
use transpoint::variants::{Blend, Fields, ProjectionKind, StressUpdate, TransferKind};
use transpoint::{Settings, Variant};

use super::symbols::{Function, MIDDLE, fit, functions};

type C = Complex<f64>;
/// A quantity as a linear function of the state of a cell.
type Functional = RowDVector<C>;

/// Why there is no theory for a variant; what it has in common with others is covered by those.
pub(super) fn reason(variant: Variant) -> Option<&'static str> {
    let (parts, settings) = (variant.parts(), settings(variant, 1));
    let known = matches!(
        (parts.fields, parts.formulation),
        (
            Fields::Carried,
            Formulation::Standard | Formulation::VelocityPressure(PointDivergence::Constant),
        ) | (Fields::TransportPoints, _)
    );
    if settings.rearrangement.is_some() {
        Some("moves or adds points")
    } else if settings.dilation.is_some() {
        Some("averages the divergence over nodes")
    } else if settings.affine_density {
        Some("carries slopes of the density")
    } else if settings.density_diffusion.is_some() {
        Some("diffuses the density")
    } else if settings.pressure_limiter.is_some() {
        Some("a limiter is not linear")
    } else if !known {
        Some("fits in each cell")
    } else {
        None
    }
}

/// The settings with which a variant runs here, for n points in a cell.
pub(super) fn settings(variant: Variant, n_points: usize) -> Settings {
    variant.settings(&super::policy(n_points))
}

/// The largest amplification of a step over the waves of a periodic line of `n_cells`, per step.
pub(super) fn amplification(variant: Variant, n_points: usize, n_cells: usize, dt: f64) -> f64 {
    (0..=n_cells / 2)
        .map(|k| 2.0 * std::f64::consts::PI * k as f64 / n_cells as f64)
        .map(|theta| Wave::new(variant, n_points, theta).amplification(dt))
        .fold(0.0, f64::max)
}

/// The symbols of one wave.
struct Wave {
    variant: Variant,
    settings: Settings,
    n: usize,
    /// N̂_p, Ĝ_p and M̂_p, and Σ N (x_k − x_p)².
    value: Vec<C>,
    slope: Vec<C>,
    moment: Vec<C>,
    spread: Vec<f64>,
    /// What a node takes of each point, and a cell of each point.
    to_node: Vec<C>,
    to_cell: Vec<C>,
    /// Slope of the linear hats at the middle of a cell.
    of_cell: C,
    phase: C,
}

impl Wave {
    fn new(variant: Variant, n: usize, theta: f64) -> Self {
        let settings = settings(variant, n);
        let phase = |k: f64| C::from_polar(1.0, theta * k);
        let mut wave = Self {
            variant,
            settings,
            n,
            value: Vec::new(),
            slope: Vec::new(),
            moment: Vec::new(),
            spread: Vec::new(),
            to_node: Vec::new(),
            to_cell: vec![C::from(1.0 / n as f64); n],
            of_cell: phase(1.0) - phase(0.0),
            phase: phase(1.0),
        };
        for p in 0..n {
            let xi = (p as f64 + 0.5) / n as f64;
            let (mut value, mut slope, mut moment, mut spread) = (C::ZERO, C::ZERO, C::ZERO, 0.0);
            for Function { place, weight, gradient } in functions(variant, &settings, xi) {
                // The phase counts from the lower corner of the cell, whatever the family's nodes stand at.
                let turn = phase((place.0 as f64) - MIDDLE as f64);
                let distance = place.1 - (MIDDLE as f64 + xi);
                value += turn * weight;
                slope += turn * gradient;
                moment += turn * (weight * distance);
                spread += weight * distance * distance;
            }
            wave.value.push(value);
            wave.slope.push(slope);
            wave.moment.push(moment);
            wave.spread.push(spread);
        }
        wave.to_node = wave.value.iter().map(|value| value.conj() / n as f64).collect();
        if variant.parts().fields == Fields::TransportPoints {
            // Around a node and around a center a lattice is symmetric: its linear fit is the constant one.
            wave.to_node = fit(n, 0.0, settings.support, theta);
            wave.to_cell = fit(n, 0.5, settings.support, theta);
        }
        wave
    }

    fn is_affine(&self) -> bool {
        self.variant.parts().transfer != TransferKind::Flip
    }

    /// Length of the state: v, e and, if affine, C of each point.
    fn length(&self) -> usize {
        if self.is_affine() { 3 * self.n } else { 2 * self.n }
    }

    fn entry(&self, k: usize) -> Functional {
        let mut unit = Functional::zeros(self.length());
        unit[k] = C::ONE;
        unit
    }

    fn sum(&self, first: usize, weights: impl Iterator<Item = C>) -> Functional {
        weights.enumerate().fold(Functional::zeros(self.length()), |sum, (p, weight)| {
            sum + self.entry(first + p) * weight
        })
    }

    /// Velocity of the node, given those of the points.
    fn node_velocity(&self, points: &[Functional]) -> Functional {
        let mut sum = Functional::zeros(self.length());
        for (velocity, &weight) in points.iter().zip(&self.to_node) {
            sum += velocity * weight;
        }
        if self.is_affine() {
            let weights = self.moment.iter().map(|moment| moment.conj() / self.n as f64);
            sum += self.sum(2 * self.n, weights);
        }
        sum
    }

    /// Acceleration of the node, given the changes of density of the points.
    fn acceleration(&self, density: &[Functional]) -> Functional {
        let mut sum = Functional::zeros(self.length());
        if self.by_cell() {
            for (change, &weight) in density.iter().zip(&self.to_cell) {
                sum += change * (weight * self.of_cell.conj());
            }
        } else {
            for (change, slope) in density.iter().zip(&self.slope) {
                sum += change * (slope.conj() / self.n as f64);
            }
        }
        sum
    }

    /// Whether pressure and divergence are those of cells; `tpm` has the pressure alone.
    fn by_cell(&self) -> bool {
        self.variant.parts().fields == Fields::TransportPoints
            || self.variant.parts().formulation != Formulation::Standard
    }

    /// Divergence at point `p` over the velocity of the node.
    fn divergence(&self, p: usize) -> C {
        let formulation = self.variant.parts().formulation;
        let kind = match formulation {
            Formulation::Standard => return self.slope[p],
            // A variant that leaves the rule to the settings has their default.
            Formulation::VelocityPressure(PointDivergence::VertexMean) => {
                self.settings.point_divergence
            }
            Formulation::VelocityPressure(kind) => kind,
        };
        let weights = kind.weights((p as f64 + 0.5) / self.n as f64);
        self.of_cell * (self.phase.conj() * weights[0] + weights[1] + self.phase * weights[2])
    }

    /// The matrix of one step, with or without the projection.
    fn step(&self, dt: f64, projects: bool) -> DMatrix<C> {
        let n = self.n;
        let mut velocity: Vec<_> = (0..n).map(|p| self.entry(p)).collect();
        let mut density: Vec<_> = (0..n).map(|p| self.entry(n + p)).collect();
        let strain = |density: &mut Vec<Functional>, node: &Functional| {
            for (p, change) in density.iter_mut().enumerate() {
                *change -= node * (self.divergence(p) * dt);
            }
        };
        let before = self.node_velocity(&velocity);
        if self.settings.stress_update == StressUpdate::First {
            strain(&mut density, &before);
        }
        let increment = self.acceleration(&density) * C::from(dt);
        let mut after = &before + &increment;
        let mut share = match self.settings.blend {
            Blend::PerStep(share) => share,
            Blend::RelaxationTime(time) => 1.0 - dt / time,
        };
        if let Some(projection) = self.settings.projection.filter(|_| projects) {
            let seen: C = self.to_node.iter().zip(&self.value).map(|(r, value)| r * value).sum();
            let first = match projection.kind {
                ProjectionKind::All | ProjectionKind::AllAndDensity => after.clone(),
                ProjectionKind::Velocity => before.clone(),
            };
            let (mut factor, mut rest) = (C::ZERO, C::ONE);
            for _ in 1..projection.order {
                rest *= C::ONE - seen;
                factor += rest;
            }
            after += first * factor;
            share = 0.0;
        }
        if self.is_affine() {
            share = 0.0;
        }
        for p in 0..n {
            let kept = &velocity[p] + &increment * self.value[p];
            velocity[p] = kept * C::from(share) + &after * (self.value[p] * (1.0 - share));
        }
        match self.settings.stress_update {
            StressUpdate::First => {}
            StressUpdate::Last => strain(&mut density, &after),
            StressUpdate::ModifiedLast => strain(&mut density, &self.node_velocity(&velocity)),
        }
        let mut rows = velocity;
        rows.extend(density);
        if self.is_affine() {
            rows.extend((0..n).map(|p| {
                let gradient = match self.variant.parts().transfer {
                    TransferKind::Apic => self.moment[p] / self.spread[p],
                    _ => self.slope[p],
                };
                &after * gradient
            }));
        }
        DMatrix::from_rows(&rows)
    }

    /// Spectral radius of a step; with a projection in every k-th step the k-th root of that of k steps.
    fn amplification(&self, dt: f64) -> f64 {
        let interval = self.settings.projection.map_or(1, |projection| projection.interval);
        let mut matrix = self.step(dt, true);
        for _ in 1..interval {
            matrix = self.step(dt, false) * matrix;
        }
        let radius = spectral_radius(matrix);
        radius.powf(1.0 / f64::from(interval))
    }
}

/// Squarings of a matrix for its spectral radius: a defective eigenvalue 1 is then off by 2⁻¹⁶.
const SQUARINGS: i32 = 20;

/// Spectral radius by the norm of a high power, `‖Aⁿ‖^(1/n)` with n = 2^k: unlike an iteration for eigenvalues it always
/// ends.
fn spectral_radius(mut matrix: DMatrix<C>) -> f64 {
    let mut logarithm = 0.0;
    for k in 0..SQUARINGS {
        let norm = matrix.norm();
        if !(norm > 0.0) {
            return 0.0;
        }
        logarithm += norm.ln() * 0.5_f64.powi(k);
        matrix /= C::from(norm);
        matrix = &matrix * &matrix;
    }
    logarithm.exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limit(variant: Variant, n_points: usize) -> f64 {
        let (mut stable, mut unstable) = (0.0, 4.0);
        while unstable - stable > 1e-6 {
            let dt = 0.5 * (stable + unstable);
            // A defective eigenvalue 1 is off by 2⁻¹⁶.
            if amplification(variant, n_points, 96, dt) < 1.0 + 5e-5 {
                stable = dt;
            } else {
                unstable = dt;
            }
        }
        stable
    }

    #[track_caller]
    fn assert_limit(variant: Variant, n_points: usize, exact: f64) {
        let found = limit(variant, n_points);
        assert!((found / exact - 1.0).abs() < 2e-3, "{found} is not {exact}");
    }

    /// Two points on linear hats: ω² = 4 s and b = 1 − 3 s/4 with s = sin²(θ/2).
    #[test]
    fn linear_hats_have_the_limits_of_the_formulas() {
        // (ω Δt)² < 4/(2 − b) is least at s = 1.
        assert_limit(Variant::Mpm, 2, (4.0 / 7.0_f64).sqrt());
        // (ω Δt)² b < 4 is least at s = 2/3.
        assert_limit(Variant::MpmMusl, 2, 3.0_f64.sqrt());
        assert_limit(Variant::MpmUsf, 2, 3.0_f64.sqrt());
        // One point, at the middle: b = 1 − s, so that 4 s Δt² < 4/(1 + s).
        assert_limit(Variant::Mpm, 1, 0.5_f64.sqrt());
    }

    /// With the divergence and the pressure of cells, hats at a single point are those of `mpm`.
    #[test]
    fn one_point_per_cell_has_the_pressure_of_its_cell() {
        for dt in [0.3, 0.7, 0.9] {
            let [one, other] = [Variant::Mpm, Variant::MpmVp].map(|v| amplification(v, 1, 24, dt));
            assert!((one - other).abs() < 1e-9);
        }
    }

    #[test]
    fn a_step_of_no_time_changes_no_flip_velocity() {
        for variant in Variant::ALL.into_iter().filter(|&variant| reason(variant).is_none()) {
            let found = amplification(variant, 2, 24, 0.0);
            assert!((found - 1.0).abs() < 5e-5, "{variant:?} {found}");
        }
    }
}
