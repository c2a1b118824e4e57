//! The transport point method in a full 2D box: moving least squares with a linear basis and a cubic
//! spline of half width one cell, one integration point at the centre of each cell, FLIP.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use rayon::prelude::*;
use transpoint::Scene;

use super::mpm_linear_2d::gather_layers2;
use super::{Points, Real, State, Stepper};

/// The 2D scheme.
pub struct Tpm2<T> {
    points: Points<T, 2>,
    /// Density and pressure of each cell.
    cells: Vec<[T; 2]>,
    /// (v⁺, Δt a) of each node.
    nodes: Vec<[T; 4]>,
    level: Level,
}

impl<T: Real> Tpm2<T> {
    /// Starts from a scene.
    pub fn new(scene: &Scene<2>) -> Self {
        Self::at_level(scene, Level::new())
    }

    /// Starts from a scene, to be run with a given instruction set.
    pub fn at_level(scene: &Scene<2>, level: Level) -> Self {
        let [nx, ny] = scene.grid.cells;
        Self {
            points: Points::new(scene, false),
            cells: vec![[T::zero(); 2]; nx * ny],
            nodes: vec![[T::zero(); 4]; (nx + 1) * (ny + 1)],
            level,
        }
    }

    /// Density at the centre of each cell, from the three by three cells around it.
    pub fn rebuild_centers(&mut self) {
        let Self { points, cells, level, .. } = self;
        let [nx, ny] = points.cells;
        each_line(cells, ny, &|i, line| {
            dispatch!(*level, simd => {
                for (j, cell) in line.iter_mut().enumerate() {
                    let at = [i, j].map(|c| T::index(c) + T::lit(0.5));
                    let rows = i.saturating_sub(1)..(i + 2).min(nx);
                    let columns = j.saturating_sub(1)..(j + 2).min(ny);
                    let [density] = fit(simd, points, at, rows, columns, |p| [points.density[p]]);
                    *cell = [density, points.pressure(density)];
                }
            });
        });
    }

    /// Nodes (v⁺, Δt a): mass and force by one point per cell, momentum by moving least squares from
    /// the two by two cells around.
    pub fn update_nodes(&mut self, dt: T) {
        let Self { points, cells, nodes, level } = self;
        let [nx, ny] = points.cells;
        let quarter = T::lit(0.25) * points.spacing * points.spacing;
        let half = T::lit(0.5) * points.spacing;
        each_line(nodes, ny + 1, &|i, line| {
            dispatch!(*level, simd => {
                let rows = i.saturating_sub(1)..(i + 1).min(nx);
                for (j, node) in line.iter_mut().enumerate() {
                    let columns = j.saturating_sub(1)..(j + 1).min(ny);
                    let (mut mass, mut force) = (T::zero(), [T::zero(); 2]);
                    for (ci, cj) in rows.clone().flat_map(|ci| columns.clone().map(move |cj| (ci, cj))) {
                        let [density, pressure] = cells[ci * ny + cj];
                        mass += density * quarter;
                        let push = pressure * half;
                        force[0] += if ci < i { push } else { -push };
                        force[1] += if cj < j { push } else { -push };
                    }
                    let at = [i, j].map(T::index);
                    let [density, u, v] = fit(simd, points, at, rows.clone(), columns, |p| {
                        let (density, [u, v]) = (points.density[p], points.velocity[p]);
                        [density, density * u, density * v]
                    });
                    *node = [u / density, v / density, dt * force[0] / mass, dt * force[1] / mass];
                    for (a, wall) in [i == 0 || i == nx, j == 0 || j == ny].into_iter().enumerate() {
                        if wall {
                            (node[a], node[2 + a]) = (T::zero(), T::zero());
                        }
                        node[a] += node[2 + a];
                    }
                }
            });
        });
    }

    /// Moves the points; true if any has left its cell.
    pub fn grid_to_particles(&mut self, dt: T) -> bool {
        let (level, nodes) = (self.level, &self.nodes);
        self.points.slabs(&|layers, points| {
            dispatch!(level, simd => gather_layers2(simd, points, layers, dt, nodes, |node| node))
        })
    }
}

impl<T: Real> Stepper<2> for Tpm2<T> {
    fn step(&mut self, dt: f64) {
        let dt = T::lit(dt);
        self.rebuild_centers();
        self.update_nodes(dt);
        if self.grid_to_particles(dt) {
            self.points.sort();
        }
    }

    fn points(&self) -> State<2> {
        self.points.state()
    }

    fn bytes_per_point(&self) -> usize {
        self.points.bytes_per_point()
    }

    fn n_sorts(&self) -> u64 {
        self.points.n_sorts
    }
}

/// Calls `work(number, line)` for each line of `width` values.
fn each_line<V: Send>(values: &mut [V], width: usize, work: &(impl Fn(usize, &mut [V]) + Sync)) {
    if rayon::current_num_threads() > 1 {
        values.par_chunks_mut(width).enumerate().for_each(|(i, line)| work(i, line));
    } else {
        values.chunks_mut(width).enumerate().for_each(|(i, line)| work(i, line));
    }
}

/// Moving least squares with a linear basis at `at` (in cells), from the points of a block of cells.
///
/// Four points at a time; those that fill up the last four lie outside the support.
#[expect(
    clippy::redundant_closure_for_method_calls,
    reason = "a method by its path is not compiled for the caller's instruction set: 13 % slower"
)]
#[inline(always)]
fn fit<S: Simd, T: Real, const F: usize>(
    simd: S,
    points: &Points<T, 2>,
    at: [T; 2],
    rows: std::ops::Range<usize>,
    columns: std::ops::Range<usize>,
    fields: impl Fn(usize) -> [T; F],
) -> [T; F] {
    let four = |values: [T; 4]| T::Four::load_array(simd, values);
    let splat = |value: T| T::Four::splat(simd, value);
    let (ny, per_h) = (points.cells[1], T::one() / points.spacing);
    // Moments 1, x, y, xx, xy, yy of the weight; 1, x, y of the weight times each field.
    let (mut moments, mut sums) = ([splat(T::zero()); 6], [[splat(T::zero()); 3]; F]);
    for i in rows {
        let first = points.start[i * ny + columns.start] as usize;
        let end = points.start[i * ny + columns.end] as usize;
        for chunk in (first..end).step_by(4) {
            let q: [usize; 4] = std::array::from_fn(|l| (chunk + l).min(end - 1));
            let x = four(q.map(|p| points.position[p][0])) * splat(per_h) + splat(-at[0]);
            let y = four(q.map(|p| points.position[p][1])) * splat(per_h) + splat(-at[1]);
            let mut weight = spline::<S, T>(simd, x) * spline::<S, T>(simd, y);
            if chunk + 4 > end {
                let within = |l| if chunk + l < end { T::one() } else { T::zero() };
                weight *= four(std::array::from_fn(within));
            }
            let (wx, wy) = (weight * x, weight * y);
            let terms = [weight, wx, wy, wx * x, wx * y, wy * y];
            for (moment, term) in moments.iter_mut().zip(terms) {
                *moment += term;
            }
            let values = q.map(&fields);
            for f in 0..F {
                let value = four(values.map(|v| v[f]));
                for (sum, term) in sums[f].iter_mut().zip([weight, wx, wy]) {
                    *sum += term * value;
                }
            }
        }
    }
    let [m, mx, my, mxx, mxy, myy] = moments.map(|moment| moment.reduce_sum());
    let row = [mxx * myy - mxy * mxy, my * mxy - mx * myy, mx * mxy - my * mxx];
    let determinant = m * row[0] + mx * row[1] + my * row[2];
    let regular = determinant > T::lit(1e-6) * m * m * m;
    sums.map(|sum| {
        let sum = sum.map(|s| s.reduce_sum());
        if regular {
            (sum[0] * row[0] + sum[1] * row[1] + sum[2] * row[2]) / determinant
        } else {
            sum[0] / m
        }
    })
}

/// The cubic spline 2/3 − 4r² + 4r³ up to r = 1/2, 4/3 (1 − r)³ up to 1, as truncated powers.
#[inline(always)]
fn spline<S: Simd, T: Real>(simd: S, x: T::Four<S>) -> T::Four<S> {
    let splat = |value: T| T::Four::splat(simd, value);
    let minus_r = x.abs() * splat(-T::one());
    let outer = (minus_r + splat(T::one())).max(splat(T::zero()));
    let inner = (minus_r + splat(T::lit(0.5))).max(splat(T::zero()));
    let cube = |s: T::Four<S>| s * s * s;
    cube(outer) * splat(T::lit(4.0 / 3.0)) + cube(inner) * splat(T::lit(-16.0 / 3.0))
}
