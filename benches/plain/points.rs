//! Points as a structure of arrays in the order of their cells.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use transpoint::Scene;
use transpoint::scene::EquationOfStateSpec;

use super::{Real, SLAB};
use std::ops::Range;

/// Points sorted by cell; the last axis is contiguous.
pub struct Points<T, const D: usize> {
    pub position: Vec<[T; D]>,
    pub velocity: Vec<[T; D]>,
    pub density: Vec<T>,
    pub mass: Vec<T>,
    /// Empty unless the scheme transfers affine velocities.
    pub affine: Vec<[[T; D]; D]>,
    pub id: Vec<u32>,
    /// First point of each cell, and the number of points.
    pub start: Vec<u32>,
    /// Cells per axis.
    pub cells: [usize; D],
    /// Cell size, m.
    pub spacing: T,
    /// ρ₀ in kg/m³ and c₀² in m²/s².
    pub equation_of_state: [T; 2],
    /// Number of sorts so far.
    pub n_sorts: u64,
    scratch: Scratch<T, D>,
}

#[derive(Default)]
struct Scratch<T, const D: usize> {
    cell: Vec<u32>,
    order: Vec<u32>,
    vector: Vec<[T; D]>,
    scalar: Vec<T>,
    matrix: Vec<[[T; D]; D]>,
    id: Vec<u32>,
}

/// The points in order of their identifiers.
#[derive(Clone, Debug, PartialEq)]
pub struct State<const D: usize> {
    pub position: Vec<[f64; D]>,
    pub velocity: Vec<[f64; D]>,
    pub density: Vec<f64>,
    pub mass: Vec<f64>,
}

/// What a step changes in a run of points, `first` being the index of its first point.
pub struct PointsMut<'a, T, const D: usize> {
    pub first: usize,
    /// Cells per axis, their first points (absolute), and their size.
    pub cells: [usize; D],
    pub start: &'a [u32],
    pub spacing: T,
    pub position: &'a mut [[T; D]],
    pub velocity: &'a mut [[T; D]],
    pub density: &'a mut [T],
    pub affine: &'a mut [[[T; D]; D]],
}

impl<T: Real, const D: usize> Points<T, D> {
    /// The points of a scene; its grid must start at the origin and have cubic cells.
    pub fn new(scene: &Scene<D>, affine: bool) -> Self {
        let EquationOfStateSpec::WeaklyCompressible { reference_density, sound_speed } =
            scene.equation_of_state
        else {
            panic!("the plain kernels know the weakly compressible law only");
        };
        let n = scene.points.len();
        let mut points = Self {
            position: scene.points.iter().map(|p| p.position.map(T::lit)).collect(),
            velocity: scene.points.iter().map(|p| p.velocity.map(T::lit)).collect(),
            density: scene.points.iter().map(|p| T::lit(p.density)).collect(),
            mass: scene.points.iter().map(|p| T::lit(p.mass)).collect(),
            affine: vec![[[T::zero(); D]; D]; if affine { n } else { 0 }],
            id: (0..n as u32).collect(),
            start: vec![0; scene.grid.cells.iter().product::<usize>() + 1],
            cells: scene.grid.cells,
            spacing: T::lit(scene.grid.spacing[0]),
            equation_of_state: [T::lit(reference_density), T::lit(sound_speed * sound_speed)],
            n_sorts: 0,
            scratch: Scratch::default(),
        };
        points.sort();
        points
    }

    /// p = c₀² (ρ − ρ₀), Pa.
    #[inline(always)]
    pub fn pressure(&self, density: T) -> T {
        self.equation_of_state[1] * (density - self.equation_of_state[0])
    }

    /// Bytes that each point carries.
    pub fn bytes_per_point(&self) -> usize {
        let affine = if self.affine.is_empty() { 0 } else { size_of::<[[T; D]; D]>() };
        2 * size_of::<[T; D]>() + 2 * size_of::<T>() + affine + size_of::<u32>()
    }

    /// The points of cell `c`.
    #[inline(always)]
    pub fn of_cell(&self, c: usize) -> Range<usize> {
        self.start[c] as usize..self.start[c + 1] as usize
    }

    /// Sorts the points by cell: a stable counting sort.
    pub fn sort(&mut self) {
        self.n_sorts += 1;
        let per_spacing = T::one() / self.spacing;
        let Scratch { cell, order, .. } = &mut self.scratch;
        cell.clear();
        self.start.fill(0);
        for x in &self.position {
            let c = (0..D).fold(0, |c, a| c * self.cells[a] + (x[a] * per_spacing).whole());
            cell.push(c as u32);
            self.start[c + 1] += 1;
        }
        for c in 1..self.start.len() {
            self.start[c] += self.start[c - 1];
        }
        order.resize(cell.len(), 0);
        // `start` serves as the running slot of each cell and is put right afterwards.
        for (p, &c) in cell.iter().enumerate() {
            let slot = &mut self.start[c as usize];
            order[*slot as usize] = p as u32;
            *slot += 1;
        }
        let n_cells = self.start.len() - 1;
        self.start.copy_within(..n_cells, 1);
        self.start[0] = 0;
        self.permute();
    }

    fn permute(&mut self) {
        fn apply<V: Copy>(order: &[u32], values: &mut Vec<V>, scratch: &mut Vec<V>) {
            if !values.is_empty() {
                scratch.clear();
                scratch.extend(order.iter().map(|&p| values[p as usize]));
                std::mem::swap(values, scratch);
            }
        }
        let Scratch { order, vector, scalar, matrix, id, .. } = &mut self.scratch;
        apply(order, &mut self.position, vector);
        apply(order, &mut self.velocity, vector);
        apply(order, &mut self.density, scalar);
        apply(order, &mut self.mass, scalar);
        apply(order, &mut self.affine, matrix);
        apply(order, &mut self.id, id);
    }

    /// The points in order of their identifiers.
    pub fn state(&self) -> State<D> {
        let mut state = State {
            position: vec![[0.0; D]; self.id.len()],
            velocity: vec![[0.0; D]; self.id.len()],
            density: vec![0.0; self.id.len()],
            mass: vec![0.0; self.id.len()],
        };
        for (p, &id) in self.id.iter().enumerate() {
            let id = id as usize;
            state.position[id] = self.position[p].map(T::wide);
            state.velocity[id] = self.velocity[p].map(T::wide);
            state.density[id] = self.density[p].wide();
            state.mass[id] = self.mass[p].wide();
        }
        state
    }

    /// Calls `work(layers, points)` for each slab of cells; true if any call returned true.
    pub fn slabs(
        &mut self,
        work: &(impl Fn(Range<usize>, PointsMut<T, D>) -> bool + Sync),
    ) -> bool {
        let points = PointsMut {
            first: 0,
            cells: self.cells,
            start: &self.start,
            spacing: self.spacing,
            position: &mut self.position,
            velocity: &mut self.velocity,
            density: &mut self.density,
            affine: &mut self.affine,
        };
        points.slabs(0..self.cells[0], work)
    }
}

impl<T: Real, const D: usize> PointsMut<'_, T, D> {
    /// The points of cell `c`, as indices into this run.
    #[inline(always)]
    pub fn of_cell(&self, c: usize) -> Range<usize> {
        self.start[c] as usize - self.first..self.start[c + 1] as usize - self.first
    }

    /// FLIP: changes the velocity of point `p`, moves it and updates its density; true if it has left
    /// its cell.
    #[inline(always)]
    pub fn advance(
        &mut self,
        p: usize,
        cell: [usize; D],
        motion: [T; D],
        change: [T; D],
        divergence: T,
        dt: T,
    ) -> bool {
        let per_h = T::one() / self.spacing;
        let mut moved = false;
        for a in 0..D {
            self.velocity[p][a] += change[a];
            self.position[p][a] += dt * motion[a];
            let xi = self.position[p][a] * per_h - T::index(cell[a]);
            moved |= xi < T::zero() || xi >= T::one();
        }
        self.density[p] /= T::one() + dt * divergence;
        moved
    }

    /// Halves a range of layers down to slabs.
    fn slabs(
        self,
        layers: Range<usize>,
        work: &(impl Fn(Range<usize>, Self) -> bool + Sync),
    ) -> bool {
        if layers.len() <= SLAB {
            return work(layers, self);
        }
        let layer: usize = self.cells[1..].iter().product();
        let middle = layers.start + layers.len() / 2;
        let first = self.start[middle * layer] as usize;
        let (low, high) = self.split(first);
        let low = || low.slabs(layers.start..middle, work);
        let high = || high.slabs(middle..layers.end, work);
        let (low, high) =
            if rayon::current_num_threads() > 1 { rayon::join(low, high) } else { (low(), high()) };
        low | high
    }

    /// Splits in front of point `p`.
    fn split(self, p: usize) -> (Self, Self) {
        let Self { first, cells, start, spacing, .. } = self;
        let n = p - first;
        let (position, position_high) = self.position.split_at_mut(n);
        let (velocity, velocity_high) = self.velocity.split_at_mut(n);
        let (density, density_high) = self.density.split_at_mut(n);
        let (affine, affine_high) = self.affine.split_at_mut(n.min(self.affine.len()));
        let low = Self { first, cells, start, spacing, position, velocity, density, affine };
        let high = Self {
            first: p,
            cells,
            start,
            spacing,
            position: position_high,
            velocity: velocity_high,
            density: density_high,
            affine: affine_high,
        };
        (low, high)
    }
}

impl<const D: usize> State<D> {
    /// Σ m and Σ m v.
    pub fn totals(&self) -> (f64, [f64; D]) {
        let momentum = |a: usize| self.mass.iter().zip(&self.velocity).map(|(m, v)| m * v[a]).sum();
        (self.mass.iter().sum(), std::array::from_fn(momentum))
    }
}
