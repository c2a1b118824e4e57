//! The points: a structure of arrays kept in cell order.

use crate::Scalar;
use crate::math::Field;
use crate::parallel::{Split, for_each_block};

/// Points per task when arrays are permuted or copied.
pub const POINT_GRAIN: usize = 16_384;

/// State of all points; `A` is the affine velocity field and `S` the state of the material, both `()` when absent.
///
/// All arrays but `length` and `density_slope` have the same length. An absent ingredient is an array of `()`, which takes no memory.
#[derive(Clone, Debug)]
pub struct Particles<T, const D: usize, A, S> {
    /// Identifier given at creation.
    pub id: Vec<u32>,
    /// Dense number of the cell that holds the point.
    pub cell: Vec<u32>,
    /// Position, m.
    pub position: Vec<[T; D]>,
    /// Velocity, m/s.
    pub velocity: Vec<[T; D]>,
    /// Density, kg/m³.
    pub density: Vec<T>,
    /// Mass, kg; nominal for methods whose points carry none.
    pub mass: Vec<T>,
    /// Affine velocity field, 1/s.
    pub affine: Vec<A>,
    /// What the material carries besides density: stress, internal energy.
    pub state: Vec<S>,
    /// Lengths along the axes, m, that the flow stretches; empty unless points are split by them or the shape
    /// functions depend on them.
    pub length: Vec<[T; D]>,
    /// Slope of the density, kg/m⁴; empty unless density is affine.
    pub density_slope: Vec<[T; D]>,
}

impl<T, const D: usize, A, S> Default for Particles<T, D, A, S> {
    fn default() -> Self {
        Self {
            id: Vec::new(),
            cell: Vec::new(),
            position: Vec::new(),
            velocity: Vec::new(),
            density: Vec::new(),
            mass: Vec::new(),
            affine: Vec::new(),
            state: Vec::new(),
            length: Vec::new(),
            density_slope: Vec::new(),
        }
    }
}

impl<T: Scalar, const D: usize, A: Field<T>, S: Field<T>> Particles<T, D, A, S> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Appends a point at rest relative to its affine field, with an empty state of the material.
    pub fn push(&mut self, id: u32, position: [T; D], velocity: [T; D], density: T, mass: T) {
        self.id.push(id);
        self.cell.push(0);
        self.position.push(position);
        self.velocity.push(velocity);
        self.density.push(density);
        self.mass.push(mass);
        self.affine.push(A::default());
        self.state.push(S::default());
    }

    /// Bytes that one point takes, without its lengths.
    pub fn bytes_per_point() -> usize {
        2 * size_of::<u32>()
            + 2 * size_of::<[T; D]>()
            + 2 * size_of::<T>()
            + size_of::<A>()
            + size_of::<S>()
    }

    /// Becomes the points of `source` named by `order`, in that order.
    ///
    /// No memory is allocated once the arrays have held this many points.
    pub fn gather_from(&mut self, source: &Self, order: &[u32]) {
        permute(&mut self.id, &source.id, order);
        permute(&mut self.cell, &source.cell, order);
        permute(&mut self.position, &source.position, order);
        permute(&mut self.velocity, &source.velocity, order);
        permute(&mut self.density, &source.density, order);
        permute(&mut self.mass, &source.mass, order);
        permute(&mut self.affine, &source.affine, order);
        permute(&mut self.state, &source.state, order);
        permute(&mut self.length, &source.length, order);
        permute(&mut self.density_slope, &source.density_slope, order);
    }

    /// Moves all points of another set to the end of this one.
    pub fn append(&mut self, other: &mut Self) {
        self.id.append(&mut other.id);
        self.cell.append(&mut other.cell);
        self.position.append(&mut other.position);
        self.velocity.append(&mut other.velocity);
        self.density.append(&mut other.density);
        self.mass.append(&mut other.mass);
        self.affine.append(&mut other.affine);
        self.state.append(&mut other.state);
        self.length.append(&mut other.length);
        self.density_slope.append(&mut other.density_slope);
    }

    /// Drops all points but the first `n`.
    pub fn truncate(&mut self, n: usize) {
        self.id.truncate(n);
        self.cell.truncate(n);
        self.position.truncate(n);
        self.velocity.truncate(n);
        self.density.truncate(n);
        self.mass.truncate(n);
        self.affine.truncate(n);
        self.state.truncate(n);
        self.length.truncate(n);
        self.density_slope.truncate(n);
    }

    /// A range of the points, every array cut to the same length.
    #[inline(always)]
    pub fn part(&self, range: std::ops::Range<usize>) -> ParticlesRef<'_, T, D, A, S> {
        ParticlesRef {
            position: &self.position[range.clone()],
            velocity: &self.velocity[range.clone()],
            density: &self.density[range.clone()],
            mass: &self.mass[range.clone()],
            affine: &self.affine[range.clone()],
            state: &self.state[range],
        }
    }

    /// All fields that a step changes, as one view that can be cut at a point, and the lengths.
    pub fn view(&mut self) -> (ParticlesMut<'_, T, D, A, S>, &[[T; D]]) {
        let points = ParticlesMut {
            cell: &mut self.cell,
            position: &mut self.position,
            velocity: &mut self.velocity,
            density: &mut self.density,
            affine: &mut self.affine,
            state: &mut self.state,
            id: &self.id,
        };
        (points, &self.length)
    }
}

fn permute<A: Copy + Send + Sync>(target: &mut Vec<A>, source: &[A], order: &[u32]) {
    let Some(&any) = source.first() else {
        target.clear();
        return;
    };
    target.resize(order.len(), any);
    if size_of::<A>() == 0 {
        return;
    }
    for_each_block(order.len(), POINT_GRAIN, target.as_mut_slice(), &|range, part: &mut [A]| {
        for (to, &from) in part.iter_mut().zip(&order[range]) {
            *to = source[from as usize];
        }
    });
}

/// Consecutive points to be read.
#[derive(Clone, Copy, Debug)]
pub struct ParticlesRef<'a, T, const D: usize, A, S> {
    /// Position, m.
    pub position: &'a [[T; D]],
    /// Velocity, m/s.
    pub velocity: &'a [[T; D]],
    /// Density, kg/m³.
    pub density: &'a [T],
    /// Mass, kg.
    pub mass: &'a [T],
    /// Affine velocity field, 1/s.
    pub affine: &'a [A],
    /// What the material carries besides density.
    pub state: &'a [S],
}

/// The changing fields of consecutive points.
#[derive(Debug)]
pub struct ParticlesMut<'a, T, const D: usize, A, S> {
    /// Cell of each point.
    pub cell: &'a mut [u32],
    /// Position, m.
    pub position: &'a mut [[T; D]],
    /// Velocity, m/s.
    pub velocity: &'a mut [[T; D]],
    /// Density, kg/m³.
    pub density: &'a mut [T],
    /// Affine velocity field, 1/s.
    pub affine: &'a mut [A],
    /// What the material carries besides density.
    pub state: &'a mut [S],
    /// Identifiers.
    pub id: &'a [u32],
}

impl<T, const D: usize, A, S> ParticlesMut<'_, T, D, A, S> {
    /// A range of these points, every array cut to the same length.
    #[inline(always)]
    pub fn part(&mut self, range: std::ops::Range<usize>) -> ParticlesMut<'_, T, D, A, S> {
        ParticlesMut {
            cell: &mut self.cell[range.clone()],
            position: &mut self.position[range.clone()],
            velocity: &mut self.velocity[range.clone()],
            density: &mut self.density[range.clone()],
            affine: &mut self.affine[range.clone()],
            state: &mut self.state[range.clone()],
            id: &self.id[range],
        }
    }
}

impl<T: Send + Sync, const D: usize, A: Send + Sync, S: Send + Sync> Split
    for ParticlesMut<'_, T, D, A, S>
{
    fn split(self, mid: usize) -> (Self, Self) {
        let (cell, cell_rest) = self.cell.split_at_mut(mid);
        let (position, position_rest) = self.position.split_at_mut(mid);
        let (velocity, velocity_rest) = self.velocity.split_at_mut(mid);
        let (density, density_rest) = self.density.split_at_mut(mid);
        let (affine, affine_rest) = self.affine.split_at_mut(mid);
        let (state, state_rest) = self.state.split_at_mut(mid);
        let (id, id_rest) = self.id.split_at(mid);
        (
            Self { cell, position, velocity, density, affine, state, id },
            Self {
                cell: cell_rest,
                position: position_rest,
                velocity: velocity_rest,
                density: density_rest,
                affine: affine_rest,
                state: state_rest,
                id: id_rest,
            },
        )
    }
}
