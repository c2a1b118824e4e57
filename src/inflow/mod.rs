//! Fluid that comes in through the inlets of a scene, at the end of each step.

mod columns;
mod inlet;

pub(crate) use inlet::Inlet;

use crate::Scalar;
use crate::cells::ABSENT;
use crate::error::InvalidInput;
use crate::material::Material;
use crate::method::Method;
use crate::particles::Particles;
use crate::rearrangement::Totals;
use crate::reconstruction::Reconstruction;
use crate::scene::{Scene, Supply};
use crate::solver::Solver;
use crate::step::{AffineOf, ParticlesOf, StateOf};
use crate::transfer::Transfer;

/// The inlets, and the points that are about to come in; `A` and `S` as in [`Particles`].
#[derive(Clone, Debug)]
pub(crate) struct Inflow<T, const D: usize, A, S> {
    pub inlets: Vec<Inlet<T, D>>,
    fresh: Particles<T, D, A, S>,
    /// Places taken or left free while a cell is topped up: distance and code.
    places: Vec<(T, usize)>,
}

/// The inflow of a method.
pub(crate) type InflowOf<T, const D: usize, M, K> =
    Inflow<T, D, AffineOf<T, D, M>, StateOf<T, D, K>>;

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Sets up the inlets of a scene and fills their columns; points of the scene are there already.
    ///
    /// # Errors
    /// When an inlet is out of range, or new points would need fields that the method does not rebuild.
    pub(crate) fn open_inlets(&mut self, scene: &Scene<D>) -> Result<(), InvalidInput> {
        if scene.inlets.is_empty() {
            return Ok(());
        }
        let mut inlets = Vec::with_capacity(scene.inlets.len());
        for (number, spec) in scene.inlets.iter().enumerate() {
            let rebuilds = <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES;
            if spec.supply == Supply::Columns && !rebuilds {
                let field = format!("inlets[{number}].supply");
                let allowed = "`flux`, or a method that reconstructs fields";
                return Err(InvalidInput::new(field, "`columns`", allowed));
            }
            inlets.push(Inlet::new(scene, number, &self.grid)?);
        }
        let mut fresh = Particles::default();
        for inlet in &inlets {
            let layers = match inlet.spec.supply {
                Supply::Columns => 2,
                Supply::Flux => 1,
            };
            self.fill_layers(inlet, layers, &mut fresh);
        }
        self.particles.append(&mut fresh);
        self.inflow = Some(Box::new(Inflow { inlets, fresh, places: Vec::new() }));
        Ok(())
    }

    /// Makes the lattice of an inlet in the first layers of cells behind its face.
    fn fill_layers(
        &mut self,
        inlet: &Inlet<T, D>,
        layers: usize,
        fresh: &mut ParticlesOf<T, D, M, K>,
    ) {
        let per_cell = inlet.spec.points_per_axis;
        let pitch = inlet.pitch[inlet.spec.axis];
        for row in &inlet.rows {
            for k in 0..layers * per_cell {
                let position = inlet.place(row, pitch * (T::from_index(k) + T::lit(0.5)));
                self.push_prescribed(inlet, position, fresh);
            }
        }
    }

    fn points_in(&self, cell: u32) -> std::ops::Range<usize> {
        let slot = self.cells.slot_of[cell as usize];
        if slot == ABSENT { 0..0 } else { self.cells.points(slot as usize) }
    }

    /// Lets in what has flowed in during a step; points are sorted before and after.
    pub(crate) fn feed(&mut self, dt: T) {
        let Some(mut inflow) = self.inflow.take() else { return };
        let returned = self.counters.n_points_returned;
        for number in 0..inflow.inlets.len() {
            if inflow.inlets[number].spec.supply == Supply::Flux {
                self.prescribe(&inflow.inlets[number]);
                self.push_rows(&mut inflow, number, dt);
                continue;
            }
            // A constant condition: methods that cannot have columns need not compile them.
            if <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES {
                self.feed_columns(&mut inflow, number, dt);
            }
        }
        let mut entered = Totals::zero();
        for point in 0..inflow.fresh.len() {
            self.add_totals(&inflow.fresh, point, &mut entered);
        }
        self.ledger.enter(&entered);
        self.counters.n_points_entered += inflow.fresh.len() as u64;
        if !inflow.fresh.is_empty() || self.counters.n_points_returned > returned {
            self.particles.append(&mut inflow.fresh);
            self.append_lengths();
            self.bin_particles();
        }
        self.inflow = Some(inflow);
    }

    /// Gives the points of an inlet's first column the prescribed velocity and density.
    fn prescribe(&mut self, inlet: &Inlet<T, D>) {
        for &cell in &inlet.cells {
            for point in self.points_in(cell) {
                self.prescribe_point(inlet, point);
            }
        }
    }

    fn prescribe_point(&mut self, inlet: &Inlet<T, D>, point: usize) {
        let p = &mut self.particles;
        let position = p.position[point];
        p.velocity[point] = inlet.velocity_at(position);
        p.density[point] = inlet.density_at(position);
        if let Some(slope) = p.density_slope.get_mut(point) {
            *slope = inlet.density_slope_at(position);
        }
        p.affine[point] = <M::Transfer as Transfer<T, D>>::affine_of(inlet.gradient_at(position));
    }

    /// Adds a point to every row that has come a point's distance since its last one.
    fn push_rows(&mut self, inflow: &mut InflowOf<T, D, M, K>, number: usize, dt: T) {
        let Inflow { inlets, fresh, .. } = inflow;
        let inlet = &mut inlets[number];
        let pitch = inlet.pitch[inlet.spec.axis];
        for index in 0..inlet.rows.len() {
            let mut row = inlet.rows[index];
            row.advance += dt * row.speed;
            while row.advance >= pitch {
                row.advance -= pitch;
                let position = inlet.place(&row, T::lit(0.5) * pitch + row.advance);
                self.push_prescribed(inlet, position, fresh);
            }
            inlet.rows[index] = row;
        }
    }

    /// Appends a point with the prescribed values.
    fn push_prescribed(
        &mut self,
        inlet: &Inlet<T, D>,
        position: [T; D],
        target: &mut ParticlesOf<T, D, M, K>,
    ) {
        let density = inlet.density_at(position);
        let mass = density * inlet.point_volume();
        target.push(self.next_id, position, inlet.velocity_at(position), density, mass);
        self.next_id += 1;
        let point = target.len() - 1;
        target.cell[point] = self.grid.cell_of(position).unwrap_or(ABSENT);
        target.affine[point] =
            <M::Transfer as Transfer<T, D>>::affine_of(inlet.gradient_at(position));
        target.state[point] = self.physics.material.initial(T::zero());
        if !self.particles.length.is_empty() {
            target.length.push(inlet.pitch);
        }
        if self.affine_density.is_some() {
            target.density_slope.push(inlet.density_slope_at(position));
        }
    }
}
