//! One run: steps, samples, and what is kept of them.

use transpoint::{InvalidInput, Simulation};

use super::Parameters;
use super::plate::{Plate, asymmetry, places, relative_l2};
use super::scene::{JET, REACH, scaled_time, scene};
use crate::case::{Findings, Profile, Raster, Row};
use crate::cases::march::{counters, march_until};
use crate::cases::series::{mean, noise, running_mean};
use crate::progress::Progress;

/// T between samples.
const INTERVAL: f64 = 0.02;
/// T at the end, and from when on means are taken.
pub(super) const END: f64 = 12.0;
pub(super) const FROM: f64 = 6.0;
/// Width of running means, T.
pub(super) const SMOOTH: f64 = 1.0;
/// The flow is steady when the running mean of the force stays this close to the mean, ρ U² b.
const STEADY: f64 = 0.02;
/// Reach of the norm of the pressure, b.
const NORM_REACH: f64 = 3.0;
/// Mean kinetic energy over ½ U² at which a run counts as blown up.
pub(super) const MOST_ENERGY: f64 = 4.0;
/// Ends of the scale of pressures in pictures, ½ ρ U².
const PRESSURES: [f64; 2] = [-0.2, 1.2];

/// What was sampled of a run.
#[derive(Clone, Debug, Default)]
struct Recording {
    /// Histories over T: force by the pressure and by the momentum over ρ U² b, pressure at the stagnation
    /// point over ½ ρ U², mass over ρ b².
    force: Vec<(f64, f64)>,
    momentum: Vec<(f64, f64)>,
    stagnation: Vec<(f64, f64)>,
    mass: Vec<(f64, f64)>,
    /// Sums over the samples from [`FROM`] on: pressures on the plate, and samples without points.
    pressures: Vec<f64>,
    dry: Vec<u32>,
    samples: u32,
    /// Mass that had come in at the first and last of these, kg/m, with T.
    entered: Option<[(f64, f64); 2]>,
}

impl Recording {
    fn add(&mut self, time: f64, plate: &Plate, spacing: f64, entered: f64, sides: f64) {
        let axis = if sides == 1.0 { plate.pressures.len() / 2 } else { 0 };
        let around = [axis, axis.saturating_sub(usize::from(sides == 1.0))];
        let stagnation = 0.5 * around.iter().map(|&k| plate.pressures[k]).sum::<f64>();
        self.force.push((time, sides * plate.force(spacing) / JET.force()));
        self.momentum.push((time, sides * plate.momentum / JET.force()));
        self.stagnation.push((time, stagnation / JET.stagnation_pressure()));
        self.mass.push((time, sides * plate.mass / (JET.density * JET.width * JET.width)));
        if time < FROM {
            return;
        }
        self.pressures.resize(plate.pressures.len(), 0.0);
        self.dry.resize(plate.pressures.len(), 0);
        for (sum, pressure) in self.pressures.iter_mut().zip(&plate.pressures) {
            *sum += pressure;
        }
        for (dry, &count) in self.dry.iter_mut().zip(&plate.counts) {
            *dry += u32::from(count == 0);
        }
        self.samples += 1;
        let now = (time, sides * entered);
        self.entered = Some([self.entered.map_or(now, |entered| entered[0]), now]);
    }

    /// Mean pressures on the plate, Pa.
    fn mean_pressures(&self) -> Vec<f64> {
        self.pressures.iter().map(|sum| sum / f64::from(self.samples)).collect()
    }

    /// T from which on the running mean of the force is that of the end.
    fn steady_since(&self) -> f64 {
        let smooth = running_mean(&self.force, SMOOTH);
        let settled = mean(&self.force, FROM, END);
        let last_off = smooth.iter().rposition(|point| (point.1 - settled).abs() > STEADY);
        let found = smooth.get(last_off.map_or(0, |last| last + 1));
        // Without a mean nothing is steady.
        found.filter(|_| settled.is_finite()).map_or(f64::NAN, |point| point.0)
    }

    /// Mass that came in per time over ρ U b.
    fn inflow(&self) -> f64 {
        self.entered.map_or(f64::NAN, |[first, last]| {
            let time = (last.0 - first.0) * JET.width / JET.speed;
            (last.1 - first.1) / time / (JET.density * JET.speed * JET.width)
        })
    }

    /// Share of the samples of cells on the plate within b of the axis that had no points.
    fn dry_share(&self, places: &[f64]) -> f64 {
        let near = self.dry.iter().zip(places).filter(|(_, x)| x.abs() < JET.width);
        let (cells, dry) = near.fold((0, 0), |sum, (&dry, _)| (sum.0 + 1, sum.1 + dry));
        f64::from(dry) / f64::from(self.samples * cells)
    }

    /// All measures, in a fixed order; those of a run that ended early are not numbers.
    fn rows(&self, places: &[f64]) -> Vec<Row> {
        let whole = |curve: &[(f64, f64)]| mean(curve, FROM, END);
        let middle = 0.5 * (FROM + END);
        let drift = mean(&self.force, middle, END) - mean(&self.force, FROM, middle);
        let rms = |curve: &[(f64, f64)]| noise(curve, &running_mean(curve, SMOOTH), FROM, END);
        // An early end leaves no mean to compare.
        let valid = if whole(&self.force).is_finite() { 1.0 } else { f64::NAN };
        let pressures = self.mean_pressures();
        let norm = valid * relative_l2(places, &pressures, NORM_REACH * JET.width);
        let found = [
            ("force", "mean", whole(&self.force)),
            ("force", "error", (whole(&self.force) - 1.0).abs()),
            ("force", "noise", rms(&self.force)),
            ("force", "drift", drift),
            ("force-by-momentum", "mean", whole(&self.momentum)),
            ("stagnation", "mean", whole(&self.stagnation)),
            ("stagnation", "noise", rms(&self.stagnation)),
            ("wall-pressure", "relative-l2", norm),
            ("wall-pressure", "asymmetry", valid * asymmetry(places, &pressures)),
            ("wall-pressure", "dry-share", valid * self.dry_share(places)),
            ("flow", "steady-since", self.steady_since()),
            ("flow", "inflow", valid * self.inflow()),
            ("flow", "mass", whole(&self.mass)),
            ("run", "end", self.force.last().map_or(f64::NAN, |point| point.0)),
        ];
        let row = |(quantity, norm, value): (&str, &str, f64)| Row {
            quantity: quantity.to_owned(),
            norm: norm.to_owned(),
            value,
            scale: f64::NAN,
        };
        found.into_iter().map(row).collect()
    }

    fn profiles(&self, places: &[f64]) -> Vec<Profile> {
        let pressures = self.mean_pressures();
        let shown = places.iter().zip(&pressures);
        let scaled = shown.map(|(x, p)| (x / JET.width, p / JET.stagnation_pressure()));
        vec![
            Profile::new("wall-pressure", scaled),
            Profile::new("force", self.force.iter().copied()),
            Profile::new("force-by-momentum", self.momentum.iter().copied()),
            Profile::new("stagnation", self.stagnation.iter().copied()),
            Profile::new("mass", self.mass.iter().copied()),
        ]
    }
}

/// Rows of a run that did not start.
pub(super) fn missing() -> Vec<Row> {
    Recording::default().rows(&[])
}

/// Runs and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    run(parameters, progress).unwrap_or_else(|error| Findings::not_built(&error, missing()))
}

fn run(parameters: &Parameters, progress: &Progress) -> Result<Findings, InvalidInput> {
    let scene = scene(parameters);
    let mut simulation = parameters.variant.build_2d(&scene, &parameters.settings)?;
    let (grid, spacing) = (&scene.grid, scene.grid.spacing[0]);
    let sides = if parameters.whole { 1.0 } else { 2.0 };
    let mut recording = Recording::default();
    let mut next = 0.0;
    let end = parameters.end * JET.width / JET.speed;
    let watch = |simulation: &dyn Simulation<2>| {
        let time = scaled_time(simulation.time());
        if time < next {
            return None;
        }
        next += INTERVAL;
        let plate = Plate::of(grid, simulation);
        let entered = simulation.ledger().entered().conserved.mass;
        recording.add(time, &plate, spacing, entered, sides);
        let most = MOST_ENERGY * 0.5 * JET.speed * JET.speed;
        // Not a number is too much.
        let bounded = plate.energy <= most;
        (!bounded).then(|| format!("mean kinetic energy above {MOST_ENERGY} · ½ U²"))
    };
    let (outcome, seconds) = march_until(simulation.as_mut(), end, progress, watch);
    let places = places(grid);
    Ok(Findings {
        outcome,
        rows: recording.rows(&places),
        profiles: recording.profiles(&places),
        rasters: vec![picture(&scene, simulation.as_ref())?],
        counters: counters(simulation.as_ref()),
        seconds,
    })
}

/// Mean pressure of the points of each cell over ½ ρ U² at the end.
fn picture(
    scene: &transpoint::Scene<2>,
    simulation: &dyn Simulation<2>,
) -> Result<Raster, InvalidInput> {
    crate::cases::cell_means::pressure(
        "pressure",
        &scene.grid,
        simulation,
        JET.stagnation_pressure(),
        PRESSURES,
    )
}

const _: () = assert!(REACH as f64 >= NORM_REACH);
