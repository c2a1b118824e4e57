//! Points in the unit square, sorted by the library.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use transpoint::cells::Cells;
use transpoint::grid::Grid;
use transpoint::particles::Particles;
use transpoint::reconstruction::Cloud;
use transpoint::scene::{Boundary, GridSpec};

/// Largest displacement of a jittered point along each axis, point spacings.
pub(super) const JITTER: f64 = 0.3;

/// Where a cell or node lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Region {
    /// At least two cells away from every wall.
    Interior,
    /// In a cell at a wall, or on the wall.
    Wall,
    /// In between: not measured.
    Neither,
}

/// Regions measured, with their names.
pub(super) const REGIONS: [(Region, &str); 2] =
    [(Region::Interior, "interior"), (Region::Wall, "wall")];

impl Region {
    /// Of a cell or node, given the largest index along an axis.
    pub(super) fn of(index: [usize; 2], last: usize) -> Self {
        if index.iter().any(|&i| i == 0 || i == last) {
            Self::Wall
        } else if index.iter().all(|&i| i >= 2 && i + 2 <= last) {
            Self::Interior
        } else {
            Self::Neither
        }
    }
}

/// The grid of `n` by `n` cells on the unit square; all faces are walls.
pub(super) fn grid_spec(n: usize) -> GridSpec<2> {
    GridSpec { origin: [0.0; 2], spacing: [1.0 / n as f64; 2], cells: [n; 2] }
}

/// The grid with the nodes of a shape function that stores `extra` nodes more than cells.
pub(super) fn grid(n: usize, extra: usize) -> Grid<f64, 2> {
    Grid::new(&grid_spec(n), &BOUNDARIES, extra)
        .expect("the unit square in n by n cells is a valid grid")
}

/// Traction-free faces: no velocity is prescribed.
pub(super) const BOUNDARIES: [[Boundary; 2]; 2] = [[Boundary::Free; 2]; 2];

/// Positions of 4 points per cell on average.
///
/// `regular`: a lattice; `jittered`: the same displaced; `random`: one point anywhere in each cell,
/// the rest anywhere in the square.
pub(super) fn positions(layout: &str, n: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut random = Pcg64::seed_from_u64(seed);
    let mut unit = || (random.next_u64() >> 11) as f64 * 2f64.powi(-53);
    let (cells, lattice) = (n * n, 2 * n);
    if layout == "random" {
        let owned = (0..cells).map(|c| [(c / n) as f64, (c % n) as f64]);
        let mut all: Vec<[f64; 2]> =
            owned.map(|corner| corner.map(|x| (x + unit()) / n as f64)).collect();
        all.extend((0..3 * cells).map(|_| [unit(), unit()]));
        return all;
    }
    let jitter = if layout == "jittered" { JITTER } else { 0.0 };
    (0..lattice * lattice)
        .map(|k| {
            [k / lattice, k % lattice]
                .map(|i| (i as f64 + 0.5 + jitter * (2.0 * unit() - 1.0)) / lattice as f64)
        })
        .collect()
}

/// The points in cell order with what a search needs.
pub(super) struct Sorted {
    pub(super) grid: Grid<f64, 2>,
    pub(super) cells: Cells,
    pub(super) particles: Particles<f64, 2, (), ()>,
}

impl Sorted {
    /// Sorts points of unit density and equal masses.
    pub(super) fn new(grid: Grid<f64, 2>, positions: &[[f64; 2]]) -> Self {
        let mut particles = Particles::default();
        let mass = 1.0 / positions.len() as f64;
        for (id, &position) in positions.iter().enumerate() {
            particles.push(id as u32, position, [0.0; 2], 1.0, mass);
            particles.cell[id] = grid.cell_of(position).unwrap_or(transpoint::cells::ABSENT);
        }
        let mut cells = Cells::new(&grid);
        cells.bin(&grid, &mut particles, &mut Particles::default());
        Self { grid, cells, particles }
    }

    /// As the library searches it.
    pub(super) fn cloud(&self) -> Cloud<'_, f64, 2> {
        Cloud {
            grid: &self.grid,
            cells: &self.cells,
            position: &self.particles.position,
            mass: &self.particles.mass,
            density: &self.particles.density,
        }
    }
}
