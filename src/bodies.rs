//! Rigid bodies on the grid: the cells that they fill, the nodes that they hold, and the force on them.

use crate::Scalar;
use crate::error::InvalidInput;
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::nodes::{HeldNode, NO_BODY, Nodes};
use crate::scene::{BodySurface, Scene};
use crate::shape::ShapeFunction;
use crate::solver::Solver;

/// The bodies of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Bodies<T, const D: usize> {
    scene: Scene<D>,
    /// Dense number of a cell → the body that fills it, or [`NO_BODY`].
    body_of_cell: Vec<u32>,
    /// Force of the fluid on each body over the last step, N.
    pub forces: Vec<[f64; D]>,
    /// What the bodies take from each held node, m/s.
    taken: Vec<[T; D]>,
}

impl<T: Scalar, const D: usize> Bodies<T, D> {
    /// Checks the bodies of a scene and finds their cells; `None` where there are none.
    ///
    /// # Errors
    /// When a body is out of range or holds the center of no cell, or a point lies in one.
    pub fn new(scene: &Scene<D>, grid: &Grid<T, D>) -> Result<Option<Self>, InvalidInput> {
        if scene.bodies.is_empty() {
            return Ok(None);
        }
        let mut body_of_cell = vec![NO_BODY; grid.total_cells()];
        for (number, body) in scene.bodies.iter().enumerate() {
            let field = format!("bodies[{number}]");
            body.shape.check(&field)?;
            let mut any = false;
            for (cell, owner) in body_of_cell.iter_mut().enumerate() {
                let at = grid.cell_coordinates(cell as u32);
                let center = std::array::from_fn(|axis| {
                    scene.grid.origin[axis] + scene.grid.spacing[axis] * (at[axis] as f64 + 0.5)
                });
                if body.shape.level(center) < 0.0 {
                    *owner = number as u32;
                    any = true;
                }
            }
            if !any {
                let allowed = "a body that holds the center of a cell of the box";
                return Err(InvalidInput::new(field, format!("{:?}", body.shape), allowed));
            }
        }
        for (id, point) in scene.points.iter().enumerate() {
            let cell = grid.cell_of(point.position.map(T::lit));
            if cell.is_some_and(|cell| body_of_cell[cell as usize] != NO_BODY) {
                let field = format!("points[{id}].position");
                let value = format!("{:?}", point.position);
                return Err(InvalidInput::new(
                    field,
                    value,
                    "outside of the cells that bodies fill",
                ));
            }
        }
        Ok(Some(Self {
            forces: vec![[0.0; D]; scene.bodies.len()],
            scene: Scene { points: Vec::new(), ..scene.clone() },
            body_of_cell,
            taken: Vec::new(),
        }))
    }

    /// Whether each cell is filled, by dense numbers.
    pub fn solid(&self) -> Vec<bool> {
        self.body_of_cell.iter().map(|&body| body != NO_BODY).collect()
    }

    /// Lists the active nodes that lie in or on the cells of a body, `index` being slot → dense number.
    ///
    /// A node lies where its [`node_coordinate`](ShapeFunction::node_coordinate) says. Where bodies meet the
    /// first one holds it.
    pub fn list_nodes<S: ShapeFunction<T>>(
        &self,
        grid: &Grid<T, D>,
        shape: &S,
        index: &[u32],
        held: &mut Vec<HeldNode<T>>,
    ) {
        for (slot, &node) in index.iter().enumerate() {
            let at = grid.node_coordinates(node);
            // Both images of a node lie at the same place.
            let place: [f64; D] = std::array::from_fn(|axis| {
                let (n, periodic) = (grid.n_cells[axis], grid.periodic[axis]);
                let place = shape.node_coordinate(at[axis], n, periodic).as_f64();
                if periodic { place.rem_euclid(n as f64) } else { place }
            });
            let Some(body) = self.body_at(grid, place) else { continue };
            let spec = &self.scene.bodies[body as usize];
            let normal = match spec.surface {
                BodySurface::NoSlip => None,
                BodySurface::Slip => {
                    let position = std::array::from_fn(|axis| {
                        self.scene.grid.origin[axis] + self.scene.grid.spacing[axis] * place[axis]
                    });
                    Some(crate::math::widen(spec.shape.normal(position).map(T::lit)))
                }
            };
            // The force on a node that is stored twice counts once.
            let image = (0..D).any(|axis| grid.periodic[axis] && at[axis] >= grid.n_cells[axis]);
            let body = if image { NO_BODY } else { body };
            held.push(HeldNode { slot: slot as u32, velocity: [T::zero(); 4], normal, body });
        }
    }

    /// The first body with a cell at a place in cells; faces belong to both of their cells.
    fn body_at(&self, grid: &Grid<T, D>, place: [f64; D]) -> Option<u32> {
        let mut found = NO_BODY;
        for code in 0..1_usize << D {
            let mut index = Some(0);
            for axis in 0..D {
                let upper = (code >> axis) & 1 == 1;
                let cell = if upper { place[axis].floor() } else { place[axis].ceil() - 1.0 };
                let n = grid.n_cells[axis] as f64;
                let inside = if grid.periodic[axis] { cell.rem_euclid(n) } else { cell };
                index = index
                    .filter(|_| inside >= 0.0 && inside < n)
                    .map(|index| index * grid.n_cells[axis] + inside as usize);
            }
            found = found.min(index.map_or(NO_BODY, |index| self.body_of_cell[index]));
        }
        (found != NO_BODY).then_some(found)
    }

    /// Starts a step: node velocities before anything holds them.
    pub fn note_start(&mut self, held: &[HeldNode<T>], velocity: &[[T; 4]]) {
        self.taken.clear();
        self.taken
            .extend(held.iter().map(|node| crate::math::narrow(velocity[node.slot as usize])));
    }

    /// What holding the nodes at the start of the step takes from the points: the part of the velocity that
    /// is not FLIP's.
    pub fn note_held(&mut self, held: &[HeldNode<T>], velocity: &[[T; 4]], flip_share: T) {
        for (node, taken) in held.iter().zip(&mut self.taken) {
            for axis in 0..D {
                let lost = taken[axis] - velocity[node.slot as usize][axis];
                taken[axis] = (T::one() - flip_share) * lost;
            }
        }
    }

    /// Adds (`sign` = 1) or subtracts the change of velocity in the step.
    pub fn note_increment(&mut self, held: &[HeldNode<T>], increment: &[[T; 4]], sign: T) {
        for (node, taken) in held.iter().zip(&mut self.taken) {
            for axis in 0..D {
                taken[axis] += sign * increment[node.slot as usize][axis];
            }
        }
    }

    /// Ends a step: the momentum that the bodies took over the time step, from the nodes' masses.
    pub fn sum_forces(&mut self, held: &[HeldNode<T>], masses: &[[T; 4]], dt: T) {
        self.forces.fill([0.0; D]);
        for (node, taken) in held.iter().zip(&self.taken) {
            if let Some(force) = self.forces.get_mut(node.body as usize) {
                let scale = masses[node.slot as usize][3] / dt;
                for axis in 0..D {
                    force[axis] += (scale * taken[axis]).as_f64();
                }
            }
        }
    }
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Puts the bodies of a scene on the grid.
    ///
    /// # Errors
    /// As [`Bodies::new`].
    pub(crate) fn place_bodies(&mut self, scene: &Scene<D>) -> Result<(), InvalidInput> {
        if let Some(bodies) = Bodies::new(scene, &self.grid)? {
            self.cells.solid = bodies.solid();
            self.bodies = Some(Box::new(bodies));
        }
        Ok(())
    }

    /// Lists the nodes that inlets and bodies hold, after the active nodes have changed.
    pub(crate) fn list_held_nodes(&mut self) {
        let (grid, shape) = (&self.grid, self.method.shape());
        let Nodes { index, held, .. } = &mut self.nodes;
        held.clear();
        for inlet in self.inflow.iter().flat_map(|inflow| &inflow.inlets) {
            inlet.list_nodes(grid, &shape, index, held);
        }
        if let Some(bodies) = &self.bodies {
            bodies.list_nodes(grid, &shape, index, held);
        }
    }
}
