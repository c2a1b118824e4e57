//! What of the points' velocities no field on the grid holds.

use transpoint::scene::GridSpec;

/// Most steps of the conjugate gradients; a mass matrix of multilinear functions takes some tens, a nearly
/// singular one some hundreds.
const MOST_STEPS: usize = 2000;
/// Residual over that at the start at which they end: its square is the share of energy that is left.
const ENOUGH: f64 = 1e-10;

/// Nodal weights of a point: node and value of its multilinear function.
type Weights = [(usize, f64); 4];

/// Velocities of points beside the multilinear fields of a plane grid \[Gritton2017\].
#[derive(Clone, Debug)]
pub struct NullSpace {
    n_nodes: usize,
    weights: Vec<Weights>,
    masses: Vec<f64>,
}

impl NullSpace {
    /// Points at places (m) of a grid, with masses in kg.
    pub fn new(grid: &GridSpec<2>, points: impl IntoIterator<Item = ([f64; 2], f64)>) -> Self {
        let (weights, masses) =
            points.into_iter().map(|(place, mass)| (weights(grid, place), mass)).unzip();
        Self { n_nodes: grid.cells.iter().map(|n| n + 1).product(), weights, masses }
    }

    /// Share of Σ m v² that is left of velocities when the best nodal values are taken off:
    ///
    /// ```text
    /// min_a Σ_p m_p |v_p − Σ_I N_I(x_p) a_I|² / Σ_p m_p |v_p|²
    /// ```
    ///
    /// Conjugate gradients on the normal equations from zero, which find the least values of nodes that the
    /// points do not determine.
    pub fn share(&self, velocities: &[[f64; 2]]) -> f64 {
        let (mut left, mut total) = (0.0, 0.0);
        for axis in 0..2 {
            let field: Vec<f64> = velocities.iter().map(|v| v[axis]).collect();
            let nodes = self.fit(&field);
            for ((value, fit), mass) in field.iter().zip(self.at_points(&nodes)).zip(&self.masses) {
                left += mass * (value - fit).powi(2);
                total += mass * value * value;
            }
        }
        left / total
    }

    /// Values at the points of nodal values.
    fn at_points<'a>(&'a self, nodes: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.weights.iter().map(|row| row.iter().map(|&(node, weight)| weight * nodes[node]).sum())
    }

    /// Σ_p m N v.
    fn to_nodes(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut nodes = vec![0.0; self.n_nodes];
        for ((row, mass), value) in self.weights.iter().zip(&self.masses).zip(values) {
            for &(node, weight) in row {
                nodes[node] += weight * mass * value;
            }
        }
        nodes
    }

    fn fit(&self, field: &[f64]) -> Vec<f64> {
        let mut residual = self.to_nodes(field.iter().copied());
        let mut direction = residual.clone();
        let mut nodes = vec![0.0; self.n_nodes];
        let mut square = dot(&residual, &residual);
        let enough = ENOUGH * ENOUGH * square;
        for _ in 0..MOST_STEPS {
            if !(square > enough) {
                break;
            }
            let image = self.to_nodes(self.at_points(&direction));
            let length = square / dot(&direction, &image);
            for k in 0..nodes.len() {
                nodes[k] += length * direction[k];
                residual[k] -= length * image[k];
            }
            let before = std::mem::replace(&mut square, dot(&residual, &residual));
            for (along, residual) in direction.iter_mut().zip(&residual) {
                *along = residual + square / before * *along;
            }
        }
        nodes
    }
}

fn weights(grid: &GridSpec<2>, place: [f64; 2]) -> Weights {
    let along: [(usize, f64); 2] = std::array::from_fn(|axis| {
        let at = (place[axis] - grid.origin[axis]) / grid.spacing[axis];
        // Conversion from `f64` saturates.
        let cell = (at.floor() as usize).min(grid.cells[axis] - 1);
        (cell, at - cell as f64)
    });
    std::array::from_fn(|corner| {
        let ends = [corner / 2, corner % 2];
        let weight = |axis: usize| {
            let xi = along[axis].1;
            if ends[axis] == 1 { xi } else { 1.0 - xi }
        };
        let node = (along[0].0 + ends[0]) * (grid.cells[1] + 1) + along[1].0 + ends[1];
        (node, weight(0) * weight(1))
    })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::lattice;

    const CELLS: [usize; 2] = [5, 4];

    fn cloud() -> (NullSpace, Vec<[f64; 2]>) {
        let grid = GridSpec { origin: [0.0; 2], spacing: [0.5; 2], cells: CELLS };
        let places = lattice::positions(0.5, CELLS, 0.4, 5);
        let points: Vec<_> = places.iter().map(|&place| (place, 1.0 + place[0])).collect();
        (NullSpace::new(&grid, points), places)
    }

    #[test]
    fn a_field_of_the_grid_leaves_nothing() {
        let (space, places) = cloud();
        let linear: Vec<_> = places.iter().map(|[x, y]| [1.0 + x - 3.0 * y, 2.0 * y]).collect();
        assert!(space.share(&linear) < 1e-18);
        // Any nodal values, the checkerboard included.
        let nodes: Vec<f64> = (0..30_i32).map(|k| f64::from(k % 7) * (-1_f64).powi(k)).collect();
        let field: Vec<_> = space.at_points(&nodes).map(|value| [value, -value]).collect();
        assert!(space.share(&field) < 1e-16, "{}", space.share(&field));
    }

    #[test]
    fn noise_leaves_the_share_of_what_is_not_determined() {
        let (space, places) = cloud();
        // Alternating from point to point in each cell: orthogonal to constants, hardly held by the grid.
        let noise: Vec<_> = (0..places.len())
            .map(|k| if (k / 8 + k) % 2 == 0 { [1.0, 0.0] } else { [-1.0, 0.0] })
            .collect();
        let share = space.share(&noise);
        assert!(share > 0.5 && share < 1.0, "{share}");
    }

    #[test]
    fn nodes_without_points_do_no_harm() {
        let grid = GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [9, 9] };
        let space = NullSpace::new(&grid, [([0.5, 0.5], 1.0), ([7.0, 8.0], 2.0)]);
        assert!(space.share(&[[1.0, 2.0], [-1.0, 0.5]]) < 1e-18);
        // Two velocities at one place: their mean is all that a field can give.
        let space = NullSpace::new(&grid, [([0.5, 0.5], 1.0), ([0.5, 0.5], 1.0)]);
        assert!((space.share(&[[1.0, 0.0], [-1.0, 0.0]]) - 1.0).abs() < 1e-12);
    }
}
