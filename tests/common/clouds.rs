//! Sorted points without a solver, and what a reconstruction makes of them.

use transpoint::Scalar;
use transpoint::basis::Fit;
use transpoint::cells::Cells;
use transpoint::grid::Grid;
use transpoint::math::Value;
use transpoint::particles::Particles;
use transpoint::reconstruction::{Cloud, Reconstruction};
use transpoint::scene::Scene;

use super::{Check, Precision, Random, near};

/// Sorted points without a solver.
#[derive(Debug)]
pub struct CloudData<T, const D: usize> {
    pub grid: Grid<T, D>,
    pub cells: Cells,
    pub particles: Particles<T, D, (), ()>,
}

impl<T: Scalar, const D: usize> CloudData<T, D> {
    pub fn new(scene: &Scene<D>) -> Self {
        let grid = Grid::new(&scene.grid, &scene.boundaries, 1).unwrap();
        let mut particles = Particles::default();
        for (id, point) in scene.points.iter().enumerate() {
            let (position, velocity) = (point.position.map(T::lit), point.velocity.map(T::lit));
            let (density, mass) = (T::lit(point.density), T::lit(point.mass));
            particles.push(id as u32, position, velocity, density, mass);
            particles.cell[id] = grid.cell_of(position).unwrap();
        }
        let mut cells = Cells::new(&grid);
        cells.bin(&grid, &mut particles, &mut Particles::default());
        Self { grid, cells, particles }
    }

    pub fn cloud(&self) -> Cloud<'_, T, D> {
        Cloud {
            grid: &self.grid,
            cells: &self.cells,
            position: &self.particles.position,
            mass: &self.particles.mass,
            density: &self.particles.density,
        }
    }

    /// Offset of a point from a target in cells, through the nearest periodic image.
    pub fn offset(&self, point: usize, target: [f64; D]) -> [f64; D] {
        let position = self.particles.position[point];
        std::array::from_fn(|axis| {
            let offset = self.grid.in_cells(position, axis).as_f64() - target[axis];
            let n = self.grid.n_cells[axis] as f64;
            if self.grid.periodic[axis] { offset - n * (offset / n).round() } else { offset }
        })
    }

    /// Every cell's centre and every node of the cells, in cells; the cell where it is a centre.
    pub fn targets(&self) -> Vec<([f64; D], Option<[usize; D]>)> {
        let centers = self.cells.index.iter().map(|&cell| {
            let cell = self.grid.cell_coordinates(cell);
            (cell.map(|c| c as f64 + 0.5), Some(cell))
        });
        let counts = self.grid.n_cells.map(|n| n + 1);
        let nodes = (0..counts.iter().product::<usize>()).map(|index| {
            let mut rest = index;
            let node = counts.map(|n| (rest % n, rest /= n).0 as f64);
            (node, None)
        });
        centers.chain(nodes).collect()
    }
}

/// Cubic spline on [−1, 1], the weight of moving least squares along one axis.
pub fn weight(r: f64) -> f64 {
    match r.abs() {
        r if r <= 0.5 => 2.0 / 3.0 - 4.0 * r * r * (1.0 - r),
        r if r <= 1.0 => 4.0 / 3.0 * (1.0 - r).powi(3),
        _ => 0.0,
    }
}

/// A full polynomial of degree 0, 1 or 2 about a target, with values of order one.
#[derive(Clone, Copy, Debug)]
pub struct Polynomial<const D: usize> {
    pub value: f64,
    slope: [f64; D],
    curvature: [[f64; D]; D],
}

impl<const D: usize> Polynomial<D> {
    pub fn random(degree: usize, random: &mut Random) -> Self {
        let mut from = |least| if degree >= least { random.signed() } else { 0.0 };
        Self {
            value: from(0),
            slope: std::array::from_fn(|_| from(1)),
            curvature: std::array::from_fn(|_| std::array::from_fn(|_| from(2))),
        }
    }

    pub fn at(&self, x: [f64; D]) -> f64 {
        let mut sum = self.value;
        for i in 0..D {
            sum += self.slope[i] * x[i];
            for j in 0..D {
                sum += self.curvature[i][j] * x[i] * x[j];
            }
        }
        sum
    }
}

/// The value at every centre and node of a field that is a polynomial about it.
pub fn reproduces<T, R, const D: usize>(
    data: &CloudData<T, D>,
    reconstruction: &R,
    degree: usize,
    bound: f64,
) -> Check
where
    T: Precision,
    R: Reconstruction<T, D>,
{
    let cloud = data.cloud();
    let mut random = Random(7);
    for (target, cell) in data.targets() {
        let exact = Polynomial::random(degree, &mut random);
        let field = |point: usize| Value(T::lit(exact.at(data.offset(point, target))));
        let fit = match cell {
            Some(cell) => reconstruction.at_center(&cloud, cell, field),
            None => reconstruction.at_node(&cloud, target.map(T::lit), field),
        };
        let Fit::Regular(Value(found)) = fit else {
            return Err(format!("{fit:?} at {target:?}"));
        };
        near(&format!("at {target:?}"), found.as_f64(), exact.value, bound)?;
    }
    Ok(())
}
