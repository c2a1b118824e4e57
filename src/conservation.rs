//! Totals over points and over nodes, formed the same way so that each transfer can be compared.

use crate::Scalar;
use crate::cells::ABSENT;
use crate::material::Material;
use crate::method::Method;
use crate::shape::ShapeFunction;
use crate::simulation::Conserved;
use crate::solver::Solver;
use crate::step::ParticlesOf;
use crate::step::fuses_impulse;
use crate::transfer::Transfer;

impl<const D: usize> Conserved<D> {
    /// Nothing.
    pub fn zero() -> Self {
        Self {
            mass: 0.0,
            momentum: [0.0; D],
            angular_momentum: [0.0; 3],
            kinetic_energy: 0.0,
            internal_energy: 0.0,
        }
    }

    /// Adds a body of mass `mass` at `position` with momentum `momentum`.
    pub fn add(&mut self, mass: f64, position: [f64; D], momentum: [f64; D]) {
        self.mass += mass;
        let (mut x, mut p) = ([0.0; 3], [0.0; 3]);
        x[..D].copy_from_slice(&position);
        p[..D].copy_from_slice(&momentum);
        for axis in 0..D {
            self.momentum[axis] += momentum[axis];
            if mass > 0.0 {
                self.kinetic_energy += 0.5 * momentum[axis] * momentum[axis] / mass;
            }
        }
        for axis in 0..3 {
            let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
            self.angular_momentum[axis] += x[b] * p[c] - x[c] * p[b];
        }
    }
}

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Totals over the points, from their (nominal) masses.
    ///
    /// The angular momentum includes the points' affine fields: with the moments `B = C D` of
    /// \[Jiang2015\] a point holds `m Σ N (x − x_p) × C (x − x_p)` besides `m x_p × v_p`.
    pub fn particle_totals(&self) -> Conserved<D> {
        let p = &self.particles;
        let mut totals = Conserved::zero();
        for k in (0..p.len()).filter(|&k| self.is_present(k)) {
            self.add_conserved(p, k, &mut totals);
        }
        totals
    }

    /// Whether a point has not left through a free face.
    pub(crate) fn is_present(&self, point: usize) -> bool {
        self.particles.cell[point] != ABSENT
    }

    /// Adds point `k` of some points to totals; one that has left counts without its affine field.
    pub(crate) fn add_conserved(
        &self,
        p: &ParticlesOf<T, D, M, K>,
        k: usize,
        totals: &mut Conserved<D>,
    ) {
        let mass = p.mass[k].as_f64();
        let momentum = p.velocity[k].map(|v| mass * v.as_f64());
        totals.add(mass, p.position[k].map(Scalar::as_f64), momentum);
        totals.internal_energy += mass * K::energy(&p.state[k]).as_f64();
        if <M::Transfer as Transfer<T, D>>::AFFINE && p.cell[k] != ABSENT {
            self.add_affine(p, k, totals);
        }
    }

    fn add_affine(&self, p: &ParticlesOf<T, D, M, K>, k: usize, totals: &mut Conserved<D>) {
        let cell = self.grid.cell_coordinates(p.cell[k]);
        let shape = self.method.shape();
        let second_moment: [f64; D] = std::array::from_fn(|axis| {
            let row = shape.row(self.grid.axis_position(p.position[k], cell, axis));
            let (n, periodic) = (self.grid.n_cells[axis], self.grid.periodic[axis]);
            let at = self.grid.in_cells(p.position[k], axis).as_f64();
            let spacing = self.grid.spacing[axis].as_f64();
            (0..M::Shape::WIDTH)
                .map(|i| {
                    let node = shape.node_coordinate(cell[axis] + row.first + i, n, periodic);
                    row.weight[i].as_f64() * ((node.as_f64() - at) * spacing).powi(2)
                })
                .sum()
        });
        let entry = |row, axis| {
            <M::Transfer as Transfer<T, D>>::affine_entry(&p.affine[k], row, axis).as_f64()
        };
        let mass = p.mass[k].as_f64();
        for axis in 0..3 {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            if a < D && b < D {
                let spin = second_moment[a] * entry(b, a) - second_moment[b] * entry(a, b);
                totals.angular_momentum[axis] += mass * spin;
            }
        }
    }

    /// Mass on the nodes by the quadrature, kg. Periodic images count once.
    pub(crate) fn sampled_mass(&self) -> f64 {
        let rows =
            if fuses_impulse::<T, D, M>() { &self.nodes.transfer } else { &self.nodes.force };
        if !self.grid.periodic.contains(&true) {
            return rows.iter().map(|row| row[3].as_f64()).sum();
        }
        let masses = self.nodes.index.iter().zip(rows).filter(|(node, _)| {
            let at = self.grid.node_coordinates(**node);
            // Images of periodic nodes hold the same sum.
            (0..D).all(|a| !self.grid.periodic[a] || at[a] < self.grid.n_cells[a])
        });
        masses.map(|(_, row)| row[3].as_f64()).sum()
    }

    /// Totals over the nodes after points → grid: transfer mass and momentum.
    ///
    /// Periodic images count once.
    pub fn node_totals(&self) -> Conserved<D> {
        let mut totals = Conserved::zero();
        let shape = self.method.shape();
        for (slot, &node) in self.nodes.index.iter().enumerate() {
            let at = self.grid.node_coordinates(node);
            let image = (0..D).any(|a| self.grid.periodic[a] && at[a] >= self.grid.n_cells[a]);
            if image {
                continue;
            }
            let row = self.nodes.transfer[slot];
            let position = std::array::from_fn(|axis| {
                let (n, periodic) = (self.grid.n_cells[axis], self.grid.periodic[axis]);
                let coordinate = shape.node_coordinate(at[axis], n, periodic);
                (self.grid.origin[axis] + self.grid.spacing[axis] * coordinate).as_f64()
            });
            let momentum = std::array::from_fn(|axis| row[axis].as_f64());
            totals.add(row[3].as_f64(), position, momentum);
        }
        totals
    }
}
