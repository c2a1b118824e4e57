//! The tube, its run, and the measures taken on the way and at the end.

use std::time::Instant;

use anyhow::Result;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::{Conserved, PointState};
use transpoint::{Observation, Scene};

use super::{INTERFACE, Parameters, RATIO};
use crate::case::{self, Findings, Outcome, Row};
use crate::cases::lattice::lattice;
use crate::cases::march::{counters, march_watching};
use crate::exact::ideal_gas_riemann::{IdealGasRiemann, SOD, State};
use crate::measure::profile::Profile;
use crate::number::decade_above;
use crate::progress::Progress;

/// Drifts below this are round-off and are given by their decade.
const ROUND_OFF: f64 = 1e-9;

/// A field of the gas.
pub(super) struct Field {
    /// Name of the quantity.
    pub(super) name: &'static str,
    /// For axes.
    pub(super) unit: &'static str,
    of_point: fn(&PointState<1>) -> f64,
    /// Exact value.
    pub(super) of_state: fn(State) -> f64,
}

/// The fields measured; `energy` is the specific internal energy e = p/((γ − 1) ρ).
pub(super) static FIELDS: [Field; 4] = [
    Field {
        name: "density",
        unit: "kg/m³",
        of_point: |point| point.density,
        of_state: |state| state.density,
    },
    Field {
        name: "velocity",
        unit: "m/s",
        of_point: |point| point.velocity[0],
        of_state: |state| state.velocity,
    },
    Field {
        name: "pressure",
        unit: "Pa",
        of_point: |point| point.pressure,
        of_state: |state| state.pressure,
    },
    Field {
        name: "energy",
        unit: "J/kg",
        of_point: |point| point.energy,
        of_state: specific_energy,
    },
];

/// e = p/((γ − 1) ρ), J/kg.
fn specific_energy(state: State) -> f64 {
    state.pressure / ((RATIO - 1.0) * state.density)
}

/// The rows of a run that has no values.
pub(super) fn missing_rows() -> Vec<Row> {
    let errors = FIELDS.iter().map(|field| Row::missing(field.name, "l1"));
    errors
        .chain([
            Row::missing("total-energy", "drift"),
            Row::missing("mass", "drift"),
            Row::missing("volume", "drift"),
        ])
        .collect()
}

/// The exact solution, a function of (x − 0.5 m)/t.
///
/// # Errors
/// Never for the states of this case.
pub(super) fn exact() -> Result<IdealGasRiemann> {
    IdealGasRiemann::new(SOD[0], SOD[1], RATIO)
}

/// The tube and its points at rest.
pub(super) fn scene(parameters: &Parameters) -> Scene<1> {
    let h = 1.0 / parameters.cells as f64;
    let spacing = h / parameters.points_per_cell as f64;
    let n_points = parameters.cells * parameters.points_per_cell;
    let place = |position: [f64; 1]| {
        let state = SOD[usize::from(position[0] >= INTERFACE)];
        let point = PointSpec::new(position, [0.0], state.density, state.density * spacing);
        PointSpec { energy: specific_energy(state), ..point }
    };
    let positions = lattice([n_points], spacing, parameters.jitter, parameters.seed);
    let scene = Scene::new(
        GridSpec { origin: [0.0], spacing: [h], cells: [parameters.cells] },
        [[Boundary::Slip; 2]],
        EquationOfStateSpec::IdealGas { ratio: RATIO },
        positions.into_iter().map(place).collect(),
    );
    Scene { energy: true, ..scene }
}

/// Largest relative changes of the totals so far.
#[derive(Clone, Copy, Default)]
pub(super) struct Drift {
    pub(super) energy: f64,
    pub(super) mass: f64,
}

impl Drift {
    fn add(&mut self, start: &Conserved<1>, now: &Conserved<1>) {
        let energy = |totals: &Conserved<1>| totals.kinetic_energy + totals.internal_energy;
        let worst = |so_far: f64, now: f64, start: f64| {
            let change = ((now - start) / start).abs();
            if change.is_nan() || change > so_far { change } else { so_far }
        };
        self.energy = worst(self.energy, energy(now), energy(start));
        self.mass = worst(self.mass, now.mass, start.mass);
    }
}

/// Builds, steps and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let scene = scene(parameters);
    let mut simulation = match parameters.variant.build_1d(&scene, &parameters.settings) {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing_rows()),
    };
    let (start, mut drift) = (simulation.conserved(), Drift::default());
    let clock = Instant::now();
    let steps = parameters.steps;
    let outcome = march_watching(
        simulation.as_mut(),
        parameters.dt,
        0..steps,
        (progress, steps),
        |simulation| {
            drift.add(&start, &simulation.conserved());
        },
    );
    let seconds = clock.elapsed().as_secs_f64();
    let counters = counters(simulation.as_ref());
    let (rows, profiles) = if outcome == Outcome::Completed {
        match measure(&scene.grid, &simulation.observe(), drift) {
            Ok(measured) => measured,
            Err(error) => return Findings::not_built(&error, missing_rows()),
        }
    } else {
        (missing_rows(), Vec::new())
    };
    Findings { outcome, rows, profiles, rasters: Vec::new(), counters, seconds }
}

/// All rows, and every field averaged over cells.
///
/// Errors are means over the points weighted by their volumes, times the length of 1 m.
///
/// # Errors
/// When the grid has no cells.
pub(super) fn measure(
    grid: &GridSpec<1>,
    state: &Observation<1>,
    drift: Drift,
) -> Result<(Vec<Row>, Vec<case::Profile>)> {
    let solution = exact()?;
    let positions: Vec<[f64; 1]> = state.points.iter().map(|point| point.position).collect();
    let volumes: Vec<f64> = state.points.iter().map(PointState::volume).collect();
    let (mut rows, mut profiles) = (Vec::new(), Vec::new());
    for field in &FIELDS {
        let at = |x: f64| (field.of_state)(solution.at((x - INTERFACE) / state.time));
        let of = |values: Vec<f64>| Profile::new(grid, 0, &positions, &values, &volumes);
        let measured = of(state.points.iter().map(field.of_point).collect())?;
        let exact = of(positions.iter().map(|x| at(x[0])).collect())?;
        rows.push(Row {
            quantity: field.name.to_owned(),
            norm: "l1".to_owned(),
            value: measured.l1(at),
            scale: exact.l1(|_| 0.0),
        });
        let columns = measured.columns().iter().map(|column| (column.position, column.value));
        profiles.push(case::Profile::new(field.name, columns));
    }
    let volume: f64 = volumes.iter().sum();
    for (quantity, drift) in
        [("total-energy", drift.energy), ("mass", drift.mass), ("volume", (volume - 1.0).abs())]
    {
        rows.push(Row {
            quantity: quantity.to_owned(),
            norm: "drift".to_owned(),
            value: if drift < ROUND_OFF { decade_above(drift) } else { drift },
            scale: 1.0,
        });
    }
    Ok((rows, profiles))
}
