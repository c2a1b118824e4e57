//! One run: steps, samples, and what is kept of them.

use transpoint::{InvalidInput, Simulation};

use super::Parameters;
use super::scene::{
    CRITICAL_DEPTH, DENSITY, GRAVITY, columns_to_brink, discharge, layers_below, scaled_time, scene,
};
use super::stream::{Stream, at_face};
use crate::case::{Findings, Profile, Row};
use crate::cases::cell_means;
use crate::cases::march::{counters, march_until};
use crate::cases::series::{mean, noise, running_mean};
use crate::progress::Progress;

/// T between samples.
const INTERVAL: f64 = 0.05;
/// Length of the window of means at the end, T.
pub(super) const WINDOW: f64 = 12.0;
/// Width of running means, T.
pub(super) const SMOOTH: f64 = 1.0;
/// The flow is steady when the running mean of the ratio stays this close to the mean.
const STEADY: f64 = 0.02;
/// Distances upstream of the brink at which depths are rows, y_c.
pub(super) const STATIONS: [usize; 5] = [1, 2, 3, 4, 5];
/// The one of them at which the pressure on the bed is sampled.
const PRESSURE_STATION: usize = 3;
/// Mean kinetic energy over g y_c at which a run counts as blown up.
const MOST_ENERGY: f64 = 10.0;
/// Ends of the scale of pressures in pictures, ρ₀ g y_c.
const PRESSURES: [f64; 2] = [0.0, 1.0];

/// What was sampled of a run; depths over y_c, discharges over q.
#[derive(Clone, Debug)]
struct Recording {
    cells: usize,
    end: f64,
    /// Histories over T.
    brink: Vec<(f64, f64)>,
    top: Vec<(f64, f64)>,
    discharge: Vec<(f64, f64)>,
    /// Pressure on the bed over ρ₀ g y_c.
    bed: Vec<(f64, f64)>,
    mass: Vec<(f64, f64)>,
    /// Mass that had come in.
    entered: Vec<(f64, f64)>,
    /// Sums over the samples of the window by columns: depths, discharges, tops and bottoms.
    depths: Vec<f64>,
    discharges: Vec<f64>,
    tops: Vec<f64>,
    bottoms: Vec<f64>,
    samples: u32,
}

impl Recording {
    const fn empty(parameters: &Parameters) -> Self {
        Self {
            cells: parameters.cells,
            end: parameters.end,
            brink: Vec::new(),
            top: Vec::new(),
            discharge: Vec::new(),
            bed: Vec::new(),
            mass: Vec::new(),
            entered: Vec::new(),
            depths: Vec::new(),
            discharges: Vec::new(),
            tops: Vec::new(),
            bottoms: Vec::new(),
            samples: 0,
        }
    }

    fn from(&self) -> f64 {
        self.end - WINDOW
    }

    fn add(&mut self, time: f64, stream: &Stream, entered: f64) {
        let brink = columns_to_brink(self.cells);
        let floor = layers_below(self.cells) as f64 * CRITICAL_DEPTH / self.cells as f64;
        let area = DENSITY * CRITICAL_DEPTH * CRITICAL_DEPTH;
        self.brink.push((time, at_face(&stream.depths, brink) / CRITICAL_DEPTH));
        self.top.push((time, (at_face(&stream.tops, brink) - floor) / CRITICAL_DEPTH));
        self.discharge.push((time, at_face(&stream.discharges, brink) / discharge()));
        let station = brink - PRESSURE_STATION * self.cells;
        let pressure = at_face(&stream.bed_pressures, station);
        self.bed.push((time, pressure / (DENSITY * GRAVITY * CRITICAL_DEPTH)));
        self.mass.push((time, stream.mass / area));
        self.entered.push((time, entered / area));
        if time < self.from() {
            return;
        }
        self.samples += 1;
        for (sums, values, scale, shift) in [
            (&mut self.depths, &stream.depths, CRITICAL_DEPTH, 0.0),
            (&mut self.discharges, &stream.discharges, discharge(), 0.0),
            (&mut self.tops, &stream.tops, CRITICAL_DEPTH, floor),
            (&mut self.bottoms, &stream.bottoms, CRITICAL_DEPTH, floor),
        ] {
            sums.resize(values.len(), 0.0);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += (value - shift) / scale;
            }
        }
    }

    fn of_window(&self, curve: &[(f64, f64)]) -> f64 {
        mean(curve, self.from(), self.end)
    }

    /// T from which on the running mean of the ratio is that of the end.
    fn steady_since(&self) -> f64 {
        let smooth = running_mean(&self.brink, SMOOTH);
        let settled = self.of_window(&self.brink);
        let last_off = smooth.iter().rposition(|point| (point.1 - settled).abs() > STEADY);
        let found = smooth.get(last_off.map_or(0, |last| last + 1));
        // Without a mean nothing is steady.
        found.filter(|_| settled.is_finite()).map_or(f64::NAN, |point| point.0)
    }

    /// Mean of sums over the samples of the window at a distance (cells) upstream of the brink.
    fn upstream(&self, sums: &[f64], cells: usize) -> f64 {
        let face = columns_to_brink(self.cells) - cells;
        if sums.len() > face { at_face(sums, face) / f64::from(self.samples) } else { f64::NAN }
    }

    /// Mass that came in per time over ρ₀ q.
    fn inflow(&self) -> f64 {
        let slope = |part: &[(f64, f64)]| match part {
            [first, .., last] => (last.1 - first.1) / (last.0 - first.0),
            _ => f64::NAN,
        };
        slope(crate::cases::series::within(&self.entered, self.from(), self.end))
    }

    /// All measures, in a fixed order; those of a run that ended early are not numbers.
    fn rows(&self) -> Vec<Row> {
        let ratio = self.of_window(&self.brink);
        let middle = self.end - 0.5 * WINDOW;
        let drift = mean(&self.brink, middle, self.end) - mean(&self.brink, self.from(), middle);
        let rms = |curve: &[(f64, f64)]| {
            noise(curve, &running_mean(curve, SMOOTH), self.from(), self.end)
        };
        // An early end leaves no mean to compare.
        let valid = if ratio.is_finite() { 1.0 } else { f64::NAN };
        let mut found = vec![
            ("brink".to_owned(), "depth", ratio),
            ("brink".to_owned(), "top", self.of_window(&self.top)),
            ("brink".to_owned(), "discharge", self.of_window(&self.discharge)),
            ("brink".to_owned(), "noise", rms(&self.brink)),
            ("brink".to_owned(), "drift", drift),
            ("bed-pressure".to_owned(), "mean", self.of_window(&self.bed)),
            ("bed-pressure".to_owned(), "noise", rms(&self.bed)),
            ("flow".to_owned(), "inflow", valid * self.inflow()),
            ("flow".to_owned(), "mass", self.of_window(&self.mass)),
            ("flow".to_owned(), "steady-since", self.steady_since()),
            ("run".to_owned(), "end", self.brink.last().map_or(f64::NAN, |point| point.0)),
        ];
        for station in STATIONS {
            let of = |sums: &[f64]| valid * self.upstream(sums, station * self.cells);
            found.push((format!("upstream-{station}"), "depth", of(&self.depths)));
            found.push((format!("upstream-{station}"), "discharge", of(&self.discharges)));
        }
        let row = |(quantity, norm, value): (String, &str, f64)| Row {
            quantity,
            norm: norm.to_owned(),
            value,
            scale: f64::NAN,
        };
        found.into_iter().map(row).collect()
    }

    fn profiles(&self) -> Vec<Profile> {
        let brink = columns_to_brink(self.cells) as f64;
        let by_columns = |name: &str, sums: &[f64]| {
            let place = |k: usize| (k as f64 + 0.5 - brink) / self.cells as f64;
            let points =
                sums.iter().enumerate().map(|(k, sum)| (place(k), sum / f64::from(self.samples)));
            Profile::new(name, points.collect::<Vec<_>>())
        };
        vec![
            by_columns("depth", &self.depths),
            by_columns("top", &self.tops),
            by_columns("bottom", &self.bottoms),
            by_columns("discharge", &self.discharges),
            Profile::new("brink-depth", self.brink.iter().copied()),
            Profile::new("brink-discharge", self.discharge.iter().copied()),
            Profile::new("bed-pressure", self.bed.iter().copied()),
            Profile::new("mass", self.mass.iter().copied()),
        ]
    }
}

/// Rows of a run that did not start.
pub(super) fn missing(parameters: &Parameters) -> Vec<Row> {
    Recording::empty(parameters).rows()
}

/// Runs and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    run(parameters, progress)
        .unwrap_or_else(|error| Findings::not_built(&error, missing(parameters)))
}

fn run(parameters: &Parameters, progress: &Progress) -> Result<Findings, InvalidInput> {
    let scene = scene(parameters);
    let mut simulation = parameters.variant.build_2d(&scene, &parameters.settings)?;
    let mut recording = Recording::empty(parameters);
    let mut next = 0.0;
    let watch = |simulation: &dyn Simulation<2>| {
        let time = scaled_time(simulation.time());
        if time < next {
            return None;
        }
        next += INTERVAL;
        let stream = Stream::of(&scene.grid, layers_below(parameters.cells), simulation);
        recording.add(time, &stream, simulation.ledger().entered().conserved.mass);
        // Not a number is too much.
        let bounded = stream.energy <= MOST_ENERGY * GRAVITY * CRITICAL_DEPTH;
        (!bounded).then(|| format!("mean kinetic energy above {MOST_ENERGY} g y_c"))
    };
    let end = parameters.end / scaled_time(1.0);
    let (outcome, seconds) = march_until(simulation.as_mut(), end, progress, watch);
    let scale = DENSITY * GRAVITY * CRITICAL_DEPTH;
    let picture =
        cell_means::pressure("pressure", &scene.grid, simulation.as_ref(), scale, PRESSURES)?;
    Ok(Findings {
        outcome,
        rows: recording.rows(),
        profiles: recording.profiles(),
        rasters: vec![picture],
        counters: counters(simulation.as_ref()),
        seconds,
    })
}
