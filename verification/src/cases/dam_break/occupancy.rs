//! What the cells hold: kinds, numerical fractures and pictures of them.

use transpoint::grid::Grid;
use transpoint::rearrangement::{Survey, survey};
use transpoint::scene::GridSpec;
use transpoint::{InvalidInput, Scene, Simulation};

use super::scene::UP;
use crate::case::Raster;

/// Kinds of cells in pictures, in the order of their codes; an empty cell has none.
pub(super) const KINDS: [&str; 4] = ["internal", "boundary", "possibly full", "fracture"];
/// Ends of the scale of pressures in pictures, Pa.
const PRESSURES: [f64; 2] = [0.0, 6000.0];

/// Points and pressures of all cells at an instant.
pub(super) struct Occupancy<const D: usize> {
    spec: GridSpec<D>,
    counts: Vec<u32>,
    /// Σ p of the points, Pa.
    pressures: Vec<f64>,
    /// Dense numbers of the cells with points, ascending.
    occupied: Vec<u32>,
    survey: Survey,
}

impl<const D: usize> Occupancy<D> {
    /// Counts the points of a simulation.
    ///
    /// # Errors
    /// When the scene has no valid grid.
    pub(super) fn of(
        scene: &Scene<D>,
        simulation: &dyn Simulation<D>,
    ) -> Result<Self, InvalidInput> {
        let spec = scene.grid.clone();
        let cells: usize = spec.cells.iter().product();
        let (mut counts, mut pressures) = (vec![0; cells], vec![0.0; cells]);
        simulation.visit_points(&mut |point| {
            let cell = (0..D).fold(0, |cell, axis| {
                let place = (point.position[axis] / spec.spacing[axis]) as usize;
                cell * spec.cells[axis] + place.min(spec.cells[axis] - 1)
            });
            counts[cell] += 1;
            pressures[cell] += point.pressure;
        });
        let occupied: Vec<u32> =
            (0..cells).filter(|&cell| counts[cell] > 0).map(|cell| cell as u32).collect();
        let survey = survey(&Grid::<f64, D>::new(&spec, &scene.boundaries, 1)?, &occupied);
        Ok(Self { spec, counts, pressures, occupied, survey })
    }

    /// Dense numbers of the cells that are empty although the fluid fills them.
    pub(super) fn fractures(&self) -> &[u32] {
        &self.survey.fractures
    }

    /// Most points in a cell.
    pub(super) fn most_points(&self) -> u32 {
        self.counts.iter().copied().max().unwrap_or(0)
    }

    /// Mean pressure of the points of each cell, over the depth in 3D.
    ///
    /// # Errors
    /// When the grid makes no picture.
    pub(super) fn pressure(&self, name: String) -> Result<Raster, InvalidInput> {
        let columns = self.columns();
        let mut sums = vec![(0_u32, 0.0); columns[0] * columns[1]];
        for (cell, (count, pressure)) in self.counts.iter().zip(&self.pressures).enumerate() {
            let sum = &mut sums[self.pixel(cell)];
            *sum = (sum.0 + count, sum.1 + pressure);
        }
        let mean = |&(count, sum): &(u32, f64)| (count > 0).then(|| sum / f64::from(count));
        let values: Vec<_> = sums.iter().map(mean).collect();
        Raster::field(name, columns, [0.0; 2], self.spacing(), PRESSURES, &values)
    }

    /// Kind of each cell; in 3D that of the last layer.
    ///
    /// # Errors
    /// When the grid makes no picture.
    pub(super) fn kinds(&self, name: String) -> Result<Raster, InvalidInput> {
        let columns = self.columns();
        let mut kinds = vec![None; columns[0] * columns[1]];
        let mut mark = |cell: u32, kind: u8| kinds[self.pixel(cell as usize)] = Some(kind);
        for (&cell, &internal) in self.occupied.iter().zip(&self.survey.internal) {
            mark(cell, u8::from(!internal));
        }
        self.survey.possibly_full.iter().for_each(|&cell| mark(cell, 2));
        self.survey.fractures.iter().for_each(|&cell| mark(cell, 3));
        Raster::classes(name, columns, [0.0; 2], self.spacing(), KINDS.len() as u8, &kinds)
    }

    fn columns(&self) -> [usize; 2] {
        [self.spec.cells[0], self.spec.cells[UP]]
    }

    fn spacing(&self) -> [f64; 2] {
        [self.spec.spacing[0], self.spec.spacing[UP]]
    }

    /// Place of a cell in a picture.
    fn pixel(&self, cell: usize) -> usize {
        let across: usize = self.spec.cells[UP + 1..].iter().product();
        let [columns, rows] = self.columns();
        let place = cell / across;
        (place % rows) * columns + place / rows
    }
}
