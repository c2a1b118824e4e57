//! Errors, dispersion and isotropy of one run.

use std::sync::{Arc, Mutex, PoisonError};

use transpoint::simulation::PointState;
use transpoint::{Observation, Scene};

use super::scene::{BUMP, CENTER, DENSITY, SOUND_SPEED};
use super::{Parameters, study};
use crate::case::{Profile, Row};
use crate::exact::acoustic::PlanePulse;
use crate::exact::acoustic_radial::RadialPulse;
use crate::measure::samples::{AtCenters, Sample, at_centers, at_points, l2};

/// Rows of every run: quantity and norm.
const ERRORS: [(&str, &str); 4] = [
    ("pressure", "point-l2"),
    ("pressure", "gauss-l2"),
    ("velocity", "point-l2"),
    ("velocity", "gauss-l2"),
];
/// Further rows in 1D.
const PULSE: [(&str, &str); 2] = [("lag", "cells"), ("loss", "relative")];
/// Further errors in 2D, on four sectors each.
const ON_SECTORS: [(&str, &str); 2] =
    [("pressure-on-axes", "gauss-l2"), ("pressure-on-diagonals", "gauss-l2")];
/// Places of the ring with further rows in 2D.
const RING: [&str; 2] = ["crest", "trough"];
/// Those rows.
const ANGULAR: [&str; 3] = ["anisotropy", "axis-less-diagonal", "scatter"];

/// Sectors of the plane: multiples of 4 about the axes, 2 more about the diagonals.
const SECTORS: usize = 16;
/// Half width of a ring of points, m.
const RING_HALF_WIDTH: f64 = 0.02;
/// Steps of the tabulated radial solution from 0 to the corner of the box.
const TABLE_STEPS: usize = 2000;
/// One point in so many is kept in a profile; a prime, so that all places in a cell come up.
const THINNING: usize = 29;

/// What a run shows.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) rows: Vec<Row>,
    pub(super) profiles: Vec<Profile>,
    pub(super) n_fallbacks: u64,
    pub(super) n_empty: u64,
}

/// Quantities and norms of a study.
fn names(study: &str) -> Vec<(String, String)> {
    let mut names: Vec<(String, String)> = Vec::new();
    let further = if study == "1d" { PULSE } else { ON_SECTORS };
    for (quantity, norm) in ERRORS.into_iter().chain(further) {
        names.push((format!("{quantity}@{study}"), norm.to_owned()));
    }
    if study == "2d" {
        for place in RING {
            names.extend(ANGULAR.map(|what| (format!("{what}@{place}"), "relative".to_owned())));
        }
    }
    names
}

/// The rows of a run that has no values.
pub(super) fn missing_rows(study: &str) -> Vec<Row> {
    names(study).into_iter().map(|(quantity, norm)| Row::missing(quantity, norm)).collect()
}

/// Values and scales in the order of the names.
fn rows(study: &str, values: impl IntoIterator<Item = (f64, f64)>) -> Vec<Row> {
    let row = |((quantity, norm), (value, scale))| Row { quantity, norm, value, scale };
    names(study).into_iter().zip(values).map(row).collect()
}

/// Pressure and the components of the velocity.
fn values<const D: usize>(point: &PointState<D>) -> [f64; 3] {
    let mut values = [point.pressure, 0.0, 0.0];
    values[1..=D].copy_from_slice(&point.velocity);
    values
}

type Samples<const D: usize> = (Vec<Sample<D, 3>>, AtCenters<D, 3>);

/// Samples with the four errors that both studies have.
fn errors<const D: usize>(
    scene: &Scene<D>,
    state: &Observation<D>,
    exact: impl Fn([f64; D]) -> [f64; 3],
) -> (Samples<D>, Vec<(f64, f64)>) {
    let points = at_points(state, values, &exact);
    let centers = at_centers(scene, state, values, &exact);
    let mut errors = Vec::new();
    for fields in [0..1, 1..3] {
        for samples in [&points, &centers.samples] {
            let norm = l2(samples, &fields);
            errors.push((norm.error(), norm.exact()));
        }
    }
    ((points, centers), errors)
}

/// Times of pressure and velocity: the velocity stands half a step back (ADR 0006).
fn times(parameters: &Parameters, time: f64) -> [f64; 2] {
    [time, time - 0.5 * parameters.dt]
}

/// Measures a run in 1D.
pub(super) fn line(parameters: &Parameters, scene: &Scene<1>, state: &Observation<1>) -> Measured {
    let bump = crate::exact::acoustic::GaussianBump { period: Some(1.0), ..BUMP };
    let pulse = PlanePulse {
        initial: |x: f64| bump.value(x - CENTER),
        density: DENSITY,
        sound_speed: SOUND_SPEED,
    };
    let [time, earlier] = times(parameters, state.time);
    let exact = |[x]: [f64; 1]| [pulse.pressure(x, time), pulse.velocity(x, earlier), 0.0];
    let ((points, centers), mut values) = errors(scene, state, exact);
    let center = (CENTER + SOUND_SPEED * time).rem_euclid(1.0);
    let [loss, lag] = loss_and_lag(&points, center);
    values.extend([(lag * parameters.cells as f64, 1.0), (loss, 1.0)]);
    Measured {
        rows: rows(study(1), values),
        profiles: Vec::new(),
        n_fallbacks: centers.n_fallbacks,
        n_empty: centers.n_empty,
    }
}

/// Relative loss of amplitude, and lag in m, of the pulse that moves to the right.
///
/// Least squares over the points within half the distance of the two pulses:
/// minimize Σ V (p − α P(x − center + lag)/2)² over α = 1 − loss and the lag, by Gauss-Newton.
fn loss_and_lag(points: &[Sample<1, 3>], center: f64) -> [f64; 2] {
    let (mut share, mut lag) = (1.0, 0.0);
    for _ in 0..20 {
        let (mut normal, mut right) = ([[0.0; 2]; 2], [0.0; 2]);
        for sample in points.iter().filter(|sample| (sample.position[0] - center).abs() < 0.25) {
            let offset = sample.position[0] - center + lag;
            let shape = 0.5 * BUMP.value(offset);
            let slope = -2.0 * BUMP.decay * offset * share * shape;
            let residual = sample.values[0] - share * shape;
            for (i, a) in [shape, slope].into_iter().enumerate() {
                right[i] += a * residual * sample.volume;
                for (j, b) in [shape, slope].into_iter().enumerate() {
                    normal[i][j] += a * b * sample.volume;
                }
            }
        }
        let [[a, b], [c, d]] = normal;
        let determinant = a * d - b * c;
        share += (right[0] * d - b * right[1]) / determinant;
        lag += (a * right[1] - c * right[0]) / determinant;
    }
    [1.0 - share, lag]
}

/// Measures a run in 2D.
pub(super) fn plane(parameters: &Parameters, scene: &Scene<2>, state: &Observation<2>) -> Measured {
    let [time, earlier] = times(parameters, state.time);
    let solution = Radial::shared(time, earlier);
    let ((points, centers), mut values) =
        errors(scene, state, |position| solution.at(position.map(|x| x - CENTER)));
    for remainder in [0, 2] {
        let within = |sample: &&Sample<2, 3>| sector(sample.position) % 4 == remainder;
        let norm = l2(centers.samples.iter().filter(within), &(0..1));
        values.push((norm.error(), norm.exact()));
    }
    for [radius, pressure] in solution.crest_and_trough() {
        values.extend(around_ring(&points, radius, pressure.abs()).map(|value| (value, 1.0)));
    }
    let profile = || {
        let thinned = points.iter().step_by(THINNING);
        let pairs = thinned.map(|s| (distance(s.position), s.values[0]));
        Profile::new("pressure", pairs)
    };
    Measured {
        rows: rows(study(2), values),
        profiles: if parameters.profile { vec![profile()] } else { Vec::new() },
        n_fallbacks: centers.n_fallbacks,
        n_empty: centers.n_empty,
    }
}

fn distance(position: [f64; 2]) -> f64 {
    (position[0] - CENTER).hypot(position[1] - CENTER)
}

/// Sector of the plane around the center of the pulse; sector 0 is about the x axis.
fn sector(position: [f64; 2]) -> usize {
    let angle = (position[1] - CENTER).atan2(position[0] - CENTER) / std::f64::consts::TAU;
    (angle * SECTORS as f64).round().rem_euclid(SECTORS as f64) as usize
}

/// Pressure errors of the points near a radius, relative to `scale`: root mean square over the
/// sectors of the sector means less their mean; mean over the four axes less that over the four
/// diagonals; root mean square of the points about the mean of their sector.
fn around_ring(points: &[Sample<2, 3>], radius: f64, scale: f64) -> [f64; 3] {
    let mut sectors: [Vec<f64>; SECTORS] = std::array::from_fn(|_| Vec::new());
    for sample in points {
        if (distance(sample.position) - radius).abs() < RING_HALF_WIDTH {
            let error = (sample.values[0] - sample.exact[0]) / scale;
            sectors[sector(sample.position)].push(error);
        }
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let means = sectors.each_ref().map(|errors| mean(errors));
    let total = mean(&means);
    let anisotropy = mean(&means.map(|of_sector| (of_sector - total).powi(2))).sqrt();
    let every_fourth =
        |first: usize| mean(&means.iter().skip(first).step_by(4).copied().collect::<Vec<_>>());
    let squares: Vec<f64> = (sectors.iter().zip(means))
        .flat_map(|(errors, of_sector)| errors.iter().map(move |e| (e - of_sector).powi(2)))
        .collect();
    [anisotropy, every_fourth(0) - every_fourth(2), mean(&squares).sqrt()]
}

/// The radial solution at one time, tabulated: a quadrature per point would take longer than the run.
pub(super) struct Radial {
    step: f64,
    /// Pressure and radial velocity.
    table: Vec<[f64; 2]>,
}

impl Radial {
    /// Pressure at `time` and velocity at `earlier`, s.
    pub(super) fn new(time: f64, earlier: f64) -> Self {
        let pulse = RadialPulse {
            amplitude: BUMP.amplitude,
            decay: BUMP.decay,
            density: DENSITY,
            sound_speed: SOUND_SPEED,
        };
        let step = CENTER * std::f64::consts::SQRT_2 / TABLE_STEPS as f64;
        // Cubic interpolation needs a step more on either side.
        let radii = (0..TABLE_STEPS + 4).map(|i| (i as f64 - 1.0) * step);
        let row = |r: f64| [pulse.pressure(r, time), pulse.velocity(r, earlier)];
        Self { step, table: radii.map(row).collect() }
    }

    /// The same, formed once for all runs that end at these times: it takes longer than most of them.
    fn shared(time: f64, earlier: f64) -> Arc<Self> {
        static FORMED: Mutex<Vec<([f64; 2], Arc<Radial>)>> = Mutex::new(Vec::new());
        let mut formed = FORMED.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, solution)) = formed.iter().find(|(times, _)| *times == [time, earlier]) {
            return Arc::clone(solution);
        }
        let solution = Arc::new(Self::new(time, earlier));
        formed.push(([time, earlier], Arc::clone(&solution)));
        solution
    }

    /// Pressure and radial velocity, relative error of the interpolation 10⁻¹⁰.
    pub(super) fn along(&self, radius: f64) -> [f64; 2] {
        let place = radius / self.step;
        let first = (place as usize).min(TABLE_STEPS);
        let t = place - first as f64;
        let weights = [
            -t * (t - 1.0) * (t - 2.0) / 6.0,
            (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0,
            (t + 1.0) * t * (t - 1.0) / 6.0,
        ];
        let row = |field: usize| (0..4).map(|i| weights[i] * self.table[first + i][field]).sum();
        [row(0), row(1)]
    }

    /// Pressure and velocity at an offset from the center.
    pub(super) fn at(&self, offset: [f64; 2]) -> [f64; 3] {
        let radius = offset[0].hypot(offset[1]);
        let [pressure, velocity] = self.along(radius);
        let [x, y] = offset.map(|d| if radius > 0.0 { velocity * d / radius } else { 0.0 });
        [pressure, x, y]
    }

    /// Radius (m) and pressure (Pa) where the pressure is largest and where it is smallest.
    pub(super) fn crest_and_trough(&self) -> [[f64; 2]; 2] {
        let inner = || (1..=TABLE_STEPS).map(|i| [(i as f64 - 1.0) * self.step, self.table[i][0]]);
        let crest = inner().fold([0.0, f64::NEG_INFINITY], |a, b| if b[1] > a[1] { b } else { a });
        let trough = inner().fold([0.0, f64::INFINITY], |a, b| if b[1] < a[1] { b } else { a });
        [crest, trough]
    }
}
