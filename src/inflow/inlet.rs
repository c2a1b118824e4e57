//! An inlet on a grid: its cells, its nodes, and the rows in which points come in.

use crate::Scalar;
use crate::equation_of_state::EquationOfState;
use crate::error::InvalidInput;
use crate::grid::Grid;
use crate::math::widen;
use crate::nodes::{HeldNode, NO_BODY};
use crate::scene::{Boundary, InletSpec, Scene, Side};
use crate::shape::ShapeFunction;

/// How far an opening may lie beside the faces of cells, cells.
const ALIGNED: f64 = 1e-6;

/// A row of points along the face's axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<T, const D: usize> {
    /// Place in the opening, m; the entry of the face's axis is not used.
    pub position: [T; D],
    /// Inward velocity, m/s.
    pub speed: T,
    /// Distance that the row has come since its last point, m.
    pub advance: T,
}

/// An inlet with what follows from the grid.
#[derive(Clone, Debug)]
pub(crate) struct Inlet<T, const D: usize> {
    pub spec: InletSpec<D>,
    /// Dense numbers of the cells of the first column within the opening, ascending.
    pub cells: Vec<u32>,
    /// The cell behind each of them, where [`Supply::Columns`](crate::scene::Supply) adds points.
    pub next_cells: Vec<u32>,
    /// Mass that flows into each of these, kg/s.
    pub rates: Vec<T>,
    /// Mass that has flowed into each and is not in a point yet, kg.
    pub debts: Vec<T>,
    pub rows: Vec<Row<T, D>>,
    /// Distance of points along each axis, m.
    pub pitch: [T; D],
    /// Place of the face, m, and the inward direction.
    face: T,
    inward: T,
    reference_density: f64,
    body_force: [f64; D],
    law: EquationOfState<f64>,
}

impl<T: Scalar, const D: usize> Inlet<T, D> {
    /// Checks and resolves inlet `number` of a scene.
    ///
    /// # Errors
    /// When a number is out of range, the opening does not consist of cells of the box, the face is open or
    /// periodic, or fewer than three cells lie behind it.
    pub fn new(scene: &Scene<D>, number: usize, grid: &Grid<T, D>) -> Result<Self, InvalidInput> {
        let spec = scene.inlets[number];
        let field = format!("inlets[{number}]");
        spec.check(&field)?;
        let face = scene.boundaries[spec.axis][usize::from(spec.side == Side::Upper)];
        if face == Boundary::Periodic || face.is_open() {
            let allowed = "a wall: slip, no-slip or a prescribed velocity";
            let name = format!("boundaries[{}]", spec.axis);
            return Err(InvalidInput::new(name, format!("{face:?} behind {field}"), allowed));
        }
        if grid.n_cells[spec.axis] < 3 {
            let name = format!("grid.cells[{}]", spec.axis);
            return Err(InvalidInput::new(
                name,
                grid.n_cells[spec.axis],
                "at least 3 behind an inlet",
            ));
        }
        let law = EquationOfState::<f64>::new(&scene.equation_of_state)?;
        if law.uses_energy() || scene.energy {
            return Err(InvalidInput::new(
                field,
                "present",
                "absent where the scene has an energy equation",
            ));
        }
        let (first, end) = opening(&spec, scene, &field)?;
        let edge = if spec.side == Side::Lower { 0 } else { grid.n_cells[spec.axis] };
        let origin = scene.grid.origin[spec.axis] + scene.grid.spacing[spec.axis] * edge as f64;
        let mut inlet = Self {
            spec,
            cells: Vec::new(),
            next_cells: Vec::new(),
            rates: Vec::new(),
            debts: Vec::new(),
            rows: Vec::new(),
            pitch: grid.spacing.map(|h| h / T::from_index(spec.points_per_axis)),
            face: T::lit(origin),
            inward: if spec.side == Side::Lower { T::one() } else { -T::one() },
            reference_density: law.density(0.0, 0.0),
            body_force: scene.body_force,
            law,
        };
        inlet.list_cells(grid, first, end);
        inlet.list_rows(grid, first, end);
        Ok(inlet)
    }

    /// Layer of cells `depth` behind the face.
    fn layer(&self, grid: &Grid<T, D>, depth: usize) -> usize {
        match self.spec.side {
            Side::Lower => depth,
            Side::Upper => grid.n_cells[self.spec.axis] - 1 - depth,
        }
    }

    fn list_cells(&mut self, grid: &Grid<T, D>, first: [usize; D], end: [usize; D]) {
        for_each_index(first, end, self.spec.axis, |index| {
            let at = |depth| {
                let mut cell = index;
                cell[self.spec.axis] = self.layer(grid, depth);
                (0..D).fold(0, |dense, axis| dense * grid.n_cells[axis] + cell[axis]) as u32
            };
            let (cell, next) = (at(0), at(1));
            self.cells.push(cell);
            self.next_cells.push(next);
        });
        self.debts.resize(self.cells.len(), T::zero());
        self.rates.resize(self.cells.len(), T::zero());
    }

    fn list_rows(&mut self, grid: &Grid<T, D>, first: [usize; D], end: [usize; D]) {
        let per_cell = self.spec.points_per_axis;
        let axis = self.spec.axis;
        let scaled = |index: [usize; D]| index.map(|n| n * per_cell);
        // The part of the face that a row stands for.
        let area = self.point_volume() / self.pitch[axis];
        for_each_index(scaled(first), scaled(end), axis, |index| {
            let position = std::array::from_fn(|axis| {
                let half = T::lit(0.5);
                grid.origin[axis] + self.pitch[axis] * (T::from_index(index[axis]) + half)
            });
            let speed = self.velocity_at(position)[axis] * self.inward;
            self.rows.push(Row { position, speed, advance: T::zero() });
            // Ascending numbers of cells: the same order as that of the cells themselves.
            let place = (0..D).filter(|&other| other != axis).fold(0, |place, other| {
                place * (end[other] - first[other]) + index[other] / per_cell - first[other]
            });
            let density = self.density_at(position);
            self.rates[place] += density * speed * area;
        });
    }

    /// The place at a distance (m) behind the face in a row.
    pub fn place(&self, row: &Row<T, D>, distance: T) -> [T; D] {
        let mut position = row.position;
        position[self.spec.axis] = self.face + self.inward * distance;
        position
    }

    /// Distance behind the face, m.
    fn distance(&self, position: [T; D]) -> T {
        (position[self.spec.axis] - self.face) * self.inward
    }

    /// Place `code` of the lattice of a cell, `points_per_axis` along each axis.
    pub fn place_in_cell(&self, grid: &Grid<T, D>, cell: u32, code: usize) -> [T; D] {
        let (at, per_cell) = (grid.cell_coordinates(cell), self.spec.points_per_axis);
        let mut rest = code;
        let mut position = [T::zero(); D];
        for axis in (0..D).rev() {
            let index = at[axis] * per_cell + rest % per_cell;
            rest /= per_cell;
            position[axis] =
                grid.origin[axis] + self.pitch[axis] * (T::from_index(index) + T::lit(0.5));
        }
        position
    }

    /// Points of a full cell.
    pub fn points_per_cell(&self) -> usize {
        self.spec.points_per_axis.pow(D as u32)
    }

    /// Prescribed velocity, m/s.
    pub fn velocity_at(&self, position: [T; D]) -> [T; D] {
        self.spec.velocity_at(position.map(Scalar::as_f64)).map(T::lit)
    }

    /// Gradient of the prescribed velocity, 1/s.
    pub fn gradient_at(&self, position: [T; D]) -> [[T; D]; D] {
        self.spec.gradient_at(position.map(Scalar::as_f64)).map(|row| row.map(T::lit))
    }

    /// Prescribed density, kg/m³.
    pub fn density_at(&self, position: [T; D]) -> T {
        let position = position.map(Scalar::as_f64);
        let pressure = self.spec.pressure_at(position, self.reference_density, self.body_force);
        T::lit(self.law.density(pressure, 0.0))
    }

    /// Slope of the prescribed density, kg/m⁴, by differences over a point's spacing.
    pub fn density_slope_at(&self, position: [T; D]) -> [T; D] {
        std::array::from_fn(|axis| {
            let (mut before, mut after) = (position, position);
            before[axis] -= T::lit(0.5) * self.pitch[axis];
            after[axis] += T::lit(0.5) * self.pitch[axis];
            (self.density_at(after) - self.density_at(before)) / self.pitch[axis]
        })
    }

    /// Volume of a point, m³.
    pub fn point_volume(&self) -> T {
        self.pitch.iter().fold(T::one(), |volume, &pitch| volume * pitch)
    }

    /// Lists the active nodes of the first column of cells, `index` being slot → dense number: those of the
    /// opening have the prescribed velocity, the others are a slip wall.
    ///
    /// A node lies where its [`node_coordinate`](ShapeFunction::node_coordinate) says.
    pub fn list_nodes<S: ShapeFunction<T>>(
        &self,
        grid: &Grid<T, D>,
        shape: &S,
        index: &[u32],
        held: &mut Vec<HeldNode<T>>,
    ) {
        let axis = self.spec.axis;
        for (slot, &node) in index.iter().enumerate() {
            let at = grid.node_coordinates(node);
            let position = std::array::from_fn(|axis| {
                let (n, periodic) = (grid.n_cells[axis], grid.periodic[axis]);
                let place = shape.node_coordinate(at[axis], n, periodic);
                grid.origin[axis] + grid.spacing[axis] * place
            });
            if self.distance(position) > grid.spacing[axis] * T::lit(1.0 + ALIGNED) {
                continue;
            }
            let (velocity, normal) = if self.is_in_opening(grid, position) {
                (widen(self.velocity_at(position)), None)
            } else {
                let unit = std::array::from_fn(|a| if a == axis { T::one() } else { T::zero() });
                ([T::zero(); 4], Some(widen::<T, D>(unit)))
            };
            held.push(HeldNode { slot: slot as u32, velocity, normal, body: NO_BODY });
        }
    }

    /// Whether a position lies in the opening, seen along the face's axis; its edge counts.
    fn is_in_opening(&self, grid: &Grid<T, D>, position: [T; D]) -> bool {
        (0..D).filter(|&axis| axis != self.spec.axis).all(|axis| {
            let slack = ALIGNED * grid.spacing[axis].as_f64();
            let at = position[axis].as_f64();
            at >= self.spec.lower[axis] - slack && at <= self.spec.upper[axis] + slack
        })
    }
}

/// First and one past last cell of the opening along each axis but the face's.
fn opening<const D: usize>(
    spec: &InletSpec<D>,
    scene: &Scene<D>,
    field: &str,
) -> Result<([usize; D], [usize; D]), InvalidInput> {
    let (mut first, mut end) = ([0; D], [1; D]);
    for axis in (0..D).filter(|&axis| axis != spec.axis) {
        for (name, corner, index) in
            [("lower", &spec.lower, &mut first), ("upper", &spec.upper, &mut end)]
        {
            let place = (corner[axis] - scene.grid.origin[axis]) / scene.grid.spacing[axis];
            let whole = place.round();
            if !((place - whole).abs() <= ALIGNED
                && whole >= 0.0
                && whole <= scene.grid.cells[axis] as f64)
            {
                let name = format!("{field}.{name}[{axis}]");
                return Err(InvalidInput::new(
                    name,
                    corner[axis],
                    "a face between cells of the box, in m",
                ));
            }
            index[axis] = whole as usize;
        }
    }
    Ok((first, end))
}

/// Visits the indices of a box in ascending order of dense numbers; the entry of one axis stays.
fn for_each_index<const D: usize>(
    first: [usize; D],
    end: [usize; D],
    fixed: usize,
    mut visit: impl FnMut([usize; D]),
) {
    let size = |axis: usize| if axis == fixed { 1 } else { end[axis] - first[axis] };
    let total: usize = (0..D).map(size).product();
    for code in 0..total {
        let mut rest = code;
        let mut index = first;
        for axis in (0..D).rev() {
            index[axis] += rest % size(axis);
            rest /= size(axis);
        }
        visit(index);
    }
}
