//! One run: steps, outlines and pictures at the instants of the paper.

use std::time::Instant;

use transpoint::scene::GridSpec;
use transpoint::{InvalidInput, Simulation};

use super::Parameters;
use super::outline::Region;
use super::scene::{DENSITY, DOMAIN, Flow, GRAVITY, scene};
use crate::case::{Findings, Outcome, Profile, Raster, Row};
use crate::cases::fluid_cells::FluidCells;
use crate::cases::free_surface::{COURANT, STEPS_PER_TIME_STEP};
use crate::cases::march::counters;
use crate::progress::Progress;
use crate::reference::channel::{VofFilm, outline};

/// Instants of the figure, s \[Song2020\].
pub(super) const INSTANTS: [f64; 3] = [0.05, 0.1, 0.17];
/// Edge of the squares in which areas are counted, m: a quarter of a cell of 0.25 mm, the same for all.
pub(super) const SQUARE: f64 = 6.25e-5;

/// Name of a picture, line or quantity at an instant.
pub(super) fn picture(what: &str, instant: f64) -> String {
    format!("{what}@{instant}")
}

/// The wet part of a volume-of-fluid run; dry if the data set is damaged, which its own test tells.
pub(super) fn vof(film: VofFilm, instant: f64) -> Region {
    Region::of_outline(&outline(film, instant).unwrap_or_default(), SQUARE)
}

/// Rows of an instant, not numbers where there is no region.
fn rows_at(flow: Flow, instant: f64, region: Option<&Region>) -> Vec<Row> {
    let row = |norm: &str, value: f64| Row {
        quantity: picture("outline", instant),
        norm: norm.to_owned(),
        value,
        scale: f64::NAN,
    };
    let of = |measure: &dyn Fn(&Region) -> f64| region.map_or(f64::NAN, measure);
    let mut rows = vec![row("reach", of(&Region::front))];
    for (film, suffix) in [(Some(flow.film()), ""), (flow.fine_film(), "-fine")] {
        let Some(film) = film else { continue };
        let vof = vof(film, instant);
        let area = vof.area();
        let name = |norm: &str| format!("{norm}{suffix}");
        rows.push(row(&name("difference"), of(&|region| region.difference(&vof) / area)));
        rows.push(row(&name("front"), of(&|region| region.front() / vof.front())));
        rows.push(row(&name("area"), of(&|region| region.area() / area)));
    }
    rows
}

/// Builds, steps and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let scene = scene(parameters);
    let built = parameters.variant.build_2d(&scene, &parameters.settings);
    let result = built.and_then(|simulation| {
        let mut run =
            Run { parameters, simulation, regions: Vec::new(), rasters: Vec::new(), seconds: 0.0 };
        let outcome = run.go(&scene.grid, progress)?;
        Ok((run, outcome))
    });
    match result {
        Ok((run, outcome)) => run.findings(outcome),
        Err(error) => Findings::not_built(&error, rows(parameters, f64::NAN, &[])),
    }
}

/// All rows.
pub(super) fn rows(parameters: &Parameters, end: f64, regions: &[(f64, Region)]) -> Vec<Row> {
    // `max` would hide what is not a number.
    let missing = if end >= parameters.end { 0.0 } else { parameters.end - end };
    let row = |norm: &str, value: f64| Row {
        quantity: "run".to_owned(),
        norm: norm.to_owned(),
        value,
        scale: f64::NAN,
    };
    let mut rows = vec![row("end", end), row("unfinished", missing)];
    for instant in INSTANTS.into_iter().filter(|&instant| instant <= parameters.end) {
        let region = regions.iter().find(|(at, _)| *at == instant).map(|(_, region)| region);
        rows.extend(rows_at(parameters.flow, instant, region));
    }
    rows
}

/// A run in progress.
struct Run<'a> {
    parameters: &'a Parameters,
    simulation: Box<dyn Simulation<2>>,
    regions: Vec<(f64, Region)>,
    rasters: Vec<Raster>,
    seconds: f64,
}

impl Run<'_> {
    /// Steps to the end and looks at the instants.
    fn go(&mut self, grid: &GridSpec<2>, progress: &Progress) -> Result<Outcome, InvalidInput> {
        let mut dt = self.simulation.stable_dt(COURANT).dt;
        let steps = (self.parameters.end / dt).ceil() as u64;
        let mut instants = INSTANTS.into_iter().filter(|&at| at <= self.parameters.end);
        let mut next = instants.next();
        let mut step = 0;
        while self.simulation.time() < self.parameters.end {
            let start = Instant::now();
            if step % STEPS_PER_TIME_STEP == 0 {
                dt = self.simulation.stable_dt(COURANT).dt;
            }
            let stepped = self.simulation.step(dt);
            self.seconds += start.elapsed().as_secs_f64();
            if let Err(error) = stepped {
                let (time, reason) = (self.simulation.time(), error.to_string());
                return Ok(Outcome::BlownUp { step, time, reason });
            }
            step += 1;
            progress.advance(step, steps.max(step));
            if let Some(instant) = next.filter(|&instant| self.simulation.time() >= instant) {
                self.look(grid, instant)?;
                next = instants.next();
            }
        }
        Ok(Outcome::Completed)
    }

    fn look(&mut self, grid: &GridSpec<2>, instant: f64) -> Result<(), InvalidInput> {
        let edge = self.parameters.spacing / self.parameters.points_per_axis as f64;
        let cells = FluidCells::of(grid, edge, self.simulation.as_ref());
        self.regions.push((instant, Region::of_cells(&cells, SQUARE)));
        let most = DENSITY * GRAVITY * DOMAIN[1];
        self.rasters.push(cells.pressure(picture("pressure", instant), 1, [0.0, most])?);
        Ok(())
    }

    fn findings(self, outcome: Outcome) -> Findings {
        let end = self.simulation.time();
        let top = |(instant, region): &(f64, Region)| {
            Profile::new(picture("top", *instant), region.tops())
        };
        Findings {
            outcome,
            rows: rows(self.parameters, end, &self.regions),
            profiles: self.regions.iter().map(top).collect(),
            rasters: self.rasters,
            counters: counters(self.simulation.as_ref()),
            seconds: self.seconds,
        }
    }
}
