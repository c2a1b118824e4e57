//! The solver: a method on a scene, one step at a time.

use crate::Scalar;
use crate::affine_density::AffineDensity;
use crate::bodies::Bodies;
use crate::cells::{ABSENT, Binned, Cells};
use crate::equation_of_state::EquationOfState;
use crate::error::{InvalidInput, StepError};
use crate::formulation::Formulation;
use crate::grid::Grid;
use crate::inflow::InflowOf;
use crate::material::Material;
use crate::method::Method;
use crate::nodes::Nodes;
use crate::particles::Particles;
use crate::quadrature::{
    Quadrature, balance, balances, classify, classify_by_volume, mark_near_surface, wetted_sites,
};
use crate::rearrangement::{Ledger, RearrangerOf};
use crate::reconstruction::Columns;
use crate::scene::{ForceField, Scene};
use crate::scene_check::{
    box_edge, check_energy_update, check_material, check_points, check_samples, linear_law,
    minimum_density,
};
use crate::settings::PressureLimiter;
use crate::shape::ShapeFunction;
use crate::smoothing::SmootherOf;
use crate::step::{
    AffineOf, CellMean, CellSamples, Center, Central, FieldAt, GridState, NodeForces, ParticlesOf,
    Pass, Physics, ScatterParts, StateOf, StateSource, View, add_acceleration, constrain,
    divergence, fuses_impulse, gather_columns, grid_to_particles, increment_energy, limit_pressure,
    node_velocity, particles_to_grid, rebuild_centers, update_grid,
};
use crate::telemetry::Counters;
use crate::transfer::Transfer;
use crate::variants::StressUpdate;

/// A simulation with all its types known.
#[derive(Clone, Debug)]
pub struct Solver<T, const D: usize, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// The recipe.
    pub method: M,
    /// What the scene prescribes.
    pub physics: Physics<T, D, K>,
    /// Acceleration as a function of place and time, besides that of `physics`.
    pub force_field: Option<ForceField<D>>,
    /// The background grid.
    pub grid: Grid<T, D>,
    /// The points, sorted by cell at the start of each step.
    pub particles: ParticlesOf<T, D, M, K>,
    /// Cells that hold points.
    pub cells: Cells,
    /// Nodes that the points touch.
    pub nodes: Nodes<T>,
    /// Fields of the active cells, where the method uses them.
    pub centers: Vec<Center<T, StateOf<T, D, K>>>,
    /// Work and events since the start.
    pub counters: Counters,
    /// Time, s.
    pub time: f64,
    /// Limiter of the pressure's slope in a cell; `None`: off.
    pub pressure_limiter: Option<PressureLimiter>,
    /// What rearrangement did.
    pub ledger: Ledger<D>,
    pub(crate) rearranger: Option<Box<RearrangerOf<T, D, M, K>>>,
    pub(crate) survey_is_stale: bool,
    pub(crate) inflow: Option<Box<InflowOf<T, D, M, K>>>,
    pub(crate) bodies: Option<Box<Bodies<T, D>>>,
    pub(crate) smoother: Option<Box<SmootherOf<T, D, M>>>,
    pub(crate) affine_density: Option<Box<AffineDensity<T, D>>>,
    /// Number of the next new point.
    pub(crate) next_id: u32,
    /// Mass by the quadrature of the last step, where points were sorted since, kg.
    pub(crate) grid_mass_before: f64,
    /// What fits read of the points, as they were when it was last brought up to date.
    pub columns: Columns<T>,
    means: Vec<CellMean<T, D>>,
    pub(crate) sites: Vec<[T; D]>,
    volumes: Vec<T>,
    spare: Particles<T, D, AffineOf<T, D, M>, StateOf<T, D, K>>,
    pub(crate) divergence: Vec<T>,
    pub(crate) strain_is_rebuilt: bool,
    takes_all: bool,
    pub(crate) stretched: Vec<[T; D]>,
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Sets up a method on a scene.
    ///
    /// # Errors
    /// When the grid, the boundaries, the pressure law or a point is out of range.
    pub fn new(scene: &Scene<D>, method: M, material: K) -> Result<Self, InvalidInput> {
        let grid = Grid::new(&scene.grid, &scene.boundaries, M::Shape::EXTRA)?;
        let equation_of_state = EquationOfState::new(&scene.equation_of_state)?;
        let mut particles = ParticlesOf::<T, D, M, K>::default();
        check_points(scene, &grid)?;
        for (id, point) in scene.points.iter().enumerate() {
            let position = point.position.map(T::lit);
            let velocity = point.velocity.map(T::lit);
            particles.push(
                id as u32,
                position,
                velocity,
                T::lit(point.density),
                T::lit(point.mass),
            );
            particles.cell[id] = grid.cell_of(position).unwrap_or(ABSENT);
            let gradient = point.velocity_gradient.map(|row| row.map(T::lit));
            particles.affine[id] = <M::Transfer as Transfer<T, D>>::affine_of(gradient);
            particles.state[id] = material.initial(T::lit(point.energy));
        }
        check_material(scene)?;
        check_energy_update::<T, D, M, K>(&method, &material)?;
        check_samples::<T, D, M>(&method)?;
        let physics = Physics {
            equation_of_state,
            linear: linear_law::<T, D, K>(&equation_of_state)?,
            material,
            minimum_density: minimum_density(scene, &equation_of_state)?,
            box_edge: box_edge(scene, &grid),
            body_force: scene.body_force.map(T::lit),
            central_force: scene.central_force.as_ref().map(Central::new),
            boundaries: scene.boundaries,
        };
        let mut solver = Self {
            method,
            physics,
            force_field: scene.force_field.clone(),
            cells: Cells::new(&grid),
            nodes: Nodes::new(&grid),
            grid,
            particles,
            centers: Vec::new(),
            counters: Counters::default(),
            time: 0.0,
            pressure_limiter: None,
            ledger: Ledger::default(),
            rearranger: None,
            survey_is_stale: true,
            inflow: None,
            bodies: None,
            smoother: None,
            affine_density: None,
            next_id: scene.points.len() as u32,
            grid_mass_before: 0.0,
            columns: Columns::default(),
            means: Vec::new(),
            sites: Vec::new(),
            volumes: Vec::new(),
            spare: Particles::default(),
            divergence: Vec::new(),
            strain_is_rebuilt: false,
            takes_all: false,
            stretched: Vec::new(),
        };
        solver.open_inlets(scene)?;
        solver.place_bodies(scene)?;
        solver.set_lengths(false);
        solver.bin_particles();
        Ok(solver)
    }

    /// Advances by `dt` seconds.
    ///
    /// # Errors
    /// When a point fails; the solver must not be stepped again then.
    pub fn advance(&mut self, dt: T) -> Result<(), StepError> {
        self.bin_particles();
        self.count_work();
        self.limit_pressure();
        self.filter_density();
        match self.method.stress_update() {
            StressUpdate::First => {
                self.strain_from_points();
                self.grid_to_particles(dt, Pass { state: true, ..Pass::default() })?;
                self.particles_to_grid(dt);
                self.update_grid(dt);
                let pass = Pass { velocity: true, state: false, motion: true };
                self.grid_to_particles(dt, pass)?;
            }
            StressUpdate::Last => {
                self.particles_to_grid(dt);
                self.update_grid(dt);
                self.strain_from_nodes();
                let pass = Pass { velocity: true, state: true, motion: true };
                self.grid_to_particles(dt, pass)?;
            }
            StressUpdate::ModifiedLast => {
                self.particles_to_grid(dt);
                self.update_grid(dt);
                self.grid_to_particles(dt, Pass { velocity: true, ..Pass::default() })?;
                self.strain_from_points();
                let pass = Pass { velocity: false, state: true, motion: true };
                self.grid_to_particles(dt, pass)?;
            }
        }
        self.relax_outflows(dt);
        self.time += dt.as_f64();
        if self.sorts_twice() {
            // Sorting renumbers the nodes, and with them what the quadrature left there.
            self.grid_mass_before = self.sampled_mass();
            self.bin_particles();
            self.feed(dt);
            self.rearrange();
        }
        Ok(())
    }

    /// Whether points are sorted at the end of a step too, because some come in or are rearranged.
    pub(crate) fn sorts_twice(&self) -> bool {
        self.rearranger.is_some() || self.inflow.is_some()
    }

    /// Everything that a phase may read.
    pub(crate) fn as_view(&self) -> View<'_, T, D, M, K> {
        let Self { method, physics, grid, cells, particles, columns, .. } = self;
        View { method, physics, grid, cells, particles, columns }
    }

    /// Points → cells: sorts the points and numbers the cells and nodes that they touch.
    pub fn bin_particles(&mut self) {
        let Self { grid, cells, nodes, particles, spare, .. } = self;
        let binned = cells.bin(grid, particles, spare);
        self.counters.n_sorts += u64::from(binned != Binned::Unchanged);
        if binned == Binned::NewCells {
            self.survey_is_stale = true;
            nodes.activate(grid, &self.method.shape(), cells, &self.physics.boundaries);
            self.list_held_nodes();
        }
        if <M::Quadrature as Quadrature<T, D>>::CLASSIFIES {
            self.classify(binned == Binned::NewCells);
        }
    }

    /// Tells boundary cells from internal ones, where that may have changed.
    fn classify(&mut self, new_cells: bool) {
        let Some(least_share) = self.method.quadrature().least_share() else {
            if new_cells {
                classify(&self.grid, &mut self.cells);
            }
            return;
        };
        let mut kind = std::mem::take(&mut self.cells.kind);
        classify_by_volume(&self.as_view().cloud(), least_share, &mut kind);
        self.cells.kind = kind;
        mark_near_surface(&self.grid, &mut self.cells);
    }

    fn count_work(&mut self) {
        self.counters.n_steps += 1;
        self.counters.n_point_updates += self.particles.len() as u64;
        self.counters.n_cell_updates += self.cells.len() as u64;
        self.counters.n_node_updates += self.nodes.len() as u64;
    }

    /// Limits the slope of the pressure in every cell, where a limiter is set.
    pub fn limit_pressure(&mut self) {
        let Some(limiter) = self.pressure_limiter else { return };
        let Self { physics, grid, cells, particles, means, .. } = self;
        self.counters.n_pressure_limited +=
            limit_pressure::<T, D, M, K>(limiter, physics, (grid, cells), means, particles);
    }

    fn uses_cells(&self) -> bool {
        matches!(self.method.formulation(), Formulation::VelocityPressure(_))
    }

    /// Points → cells: the fields of the active cells, and where their samples lie.
    pub(crate) fn rebuild_cells(&mut self) {
        gather_columns::<T, D, M, K>(&self.particles, &mut self.columns);
        let Self { method, physics, grid, cells, particles, columns, .. } = self;
        let view = View { method, physics, grid, cells, particles, columns };
        let (centers, sites) = (&mut self.centers, &mut self.sites);
        centers.resize(cells.len(), Center::default());
        self.counters = self.counters.sum(rebuild_centers(&view, centers));
        wetted_sites(&view, centers, sites);
        if balances(method) {
            self.volumes.clear();
            self.volumes.extend(centers.iter().map(|center| center.volume));
            self.counters = self.counters.sum(balance(&view, &self.volumes, centers));
        }
    }

    /// Samples → nodes: mass, momentum, force; then the velocity at the start of the step.
    pub fn particles_to_grid(&mut self, dt: T) {
        if <M::Quadrature as Quadrature<T, D>>::USES_CENTERS || self.uses_cells() {
            self.rebuild_cells();
        } else {
            gather_columns::<T, D, M, K>(&self.particles, &mut self.columns);
        }
        let Self { method, physics, grid, cells, particles, columns, .. } = self;
        let view = View { method, physics, grid, cells, particles, columns };
        let (nodes, centers, sites) = (&mut self.nodes, &mut self.centers, &mut self.sites);
        let mut counters = Counters::default();
        let samples = CellSamples { centers, sites };
        counters = counters.sum(particles_to_grid(&view, samples, (ScatterParts::All, dt), nodes));
        let Nodes { index, transfer, velocity, .. } = nodes;
        counters = counters.sum(node_velocity(&view, index, transfer, velocity));
        self.counters = self.counters.sum(counters);
    }

    /// Nodes → nodes: the velocity at the end of the step.
    pub fn update_grid(&mut self, dt: T) {
        let Self { method, physics, force_field, grid, nodes, time, .. } = self;
        let Nodes { index, velocity, increment, transfer, force, walls, held, .. } = nodes;
        let mut bodies = self.bodies.as_mut();
        let (forces, masses) = if fuses_impulse::<T, D, M>() {
            (NodeForces::Fused(transfer), &*transfer)
        } else {
            (NodeForces::Separate(force), &*force)
        };
        let fixed = (walls.as_slice(), held.as_slice());
        if let Some(bodies) = &mut bodies {
            bodies.note_start(held, velocity);
        }
        constrain(fixed, &physics.boundaries, velocity, None);
        if let Some(bodies) = &mut bodies {
            let share = <M::Transfer as Transfer<T, D>>::flip_share(&method.transfer(), dt);
            bodies.note_held(held, velocity, share);
        }
        update_grid(dt, physics.body_force, forces, (velocity, increment));
        let place = (&*grid, &method.shape());
        if let Some(central) = &physics.central_force {
            let rows = (index.as_slice(), velocity.as_mut_slice(), increment.as_mut_slice());
            add_acceleration(dt, central, place, masses, rows);
        }
        if let Some(field) = force_field {
            let rows = (index.as_slice(), velocity.as_mut_slice(), increment.as_mut_slice());
            add_acceleration(dt, &FieldAt { field, time: *time }, place, masses, rows);
        }
        if let Some(bodies) = &mut bodies {
            bodies.note_increment(held, increment, T::one());
        }
        constrain(fixed, &physics.boundaries, velocity, Some(increment));
        if let Some(bodies) = &mut bodies {
            bodies.note_increment(held, increment, -T::one());
            bodies.sum_forces(held, masses, dt);
        }
        if physics.material.wants_work() {
            increment_energy::<T, D>(increment);
        }
        self.takes_all = self.project_velocity();
    }

    /// The state update takes its strain from the velocity at the end of the step (USL).
    pub fn strain_from_nodes(&mut self) {
        self.strain_is_rebuilt = false;
        self.update_divergence();
    }

    /// The state update takes its strain from node velocities rebuilt from the points as they are:
    /// before the forces (USF) or after them (MUSL).
    pub fn strain_from_points(&mut self) {
        let mut rebuilt = std::mem::take(&mut self.nodes.rebuilt);
        self.transfer_velocity(&mut rebuilt);
        let fixed = (self.nodes.walls.as_slice(), self.nodes.held.as_slice());
        constrain(fixed, &self.physics.boundaries, &mut rebuilt, None);
        self.nodes.rebuilt = rebuilt;
        self.strain_is_rebuilt = true;
        self.update_divergence();
    }

    /// One divergence per cell, where the formulation asks for it.
    fn update_divergence(&mut self) {
        if !self.uses_cells() {
            self.average_dilation();
            return;
        }
        let Self { method, grid, cells, nodes, sites, divergence: values, .. } = self;
        let velocity = if self.strain_is_rebuilt { &nodes.rebuilt } else { &nodes.velocity };
        values.resize(cells.len(), T::zero());
        divergence((grid, cells, &method.shape()), (&nodes.rows, sites), velocity, values);
        self.diffuse_density();
    }

    /// Nodes and cells → points.
    ///
    /// # Errors
    /// When a point fails.
    pub fn grid_to_particles(&mut self, dt: T, pass: Pass) -> Result<(), StepError> {
        if pass.motion {
            self.stretch_lengths(dt);
        }
        if pass.state {
            self.strain_slopes(dt);
        }
        let Self { method, physics, grid, cells, particles, nodes, divergence, .. } = self;
        let rebuilt = self.strain_is_rebuilt;
        let velocity = if rebuilt { &nodes.rebuilt } else { &nodes.velocity };
        let smooth = self.smoother.as_ref().map_or(&[][..], |kept| &kept.divergence);
        let at_points = self.affine_density.as_ref().map_or(smooth, |kept| &kept.divergence);
        let source = StateSource { velocity, is_end_velocity: !rebuilt, divergence, at_points };
        let Nodes { rows, velocity, increment, .. } = &*nodes;
        let flip_share = if self.takes_all { T::zero() } else { method.transfer().flip_share(dt) };
        let (points, length) = particles.view();
        let state = GridState {
            method,
            physics,
            grid,
            cells,
            length,
            flip_share,
            rows,
            velocity,
            increment,
            source,
        };
        let outcome = grid_to_particles(&state, pass, dt, points);
        if pass.motion {
            self.take_lengths();
        }
        self.counters.n_points_removed += outcome.n_removed;
        if outcome.n_removed > 0 {
            self.let_out();
        }
        self.counters.n_pressure_cutoffs += outcome.n_raised;
        if K::ANY_LAW && pass.state {
            let viscous = |state: &&StateOf<T, D, K>| K::viscous_pressure(state) != T::zero();
            let count = self.particles.state.iter().filter(viscous).count();
            self.counters.n_viscous_pressures += count as u64;
        }
        outcome.failure.map_or(Ok(()), |(point, failure)| Err(self.describe(point, failure)))
    }
}
