//! The material point method in 3D on linear hats: FLIP, stress updated last.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use std::ops::Range;

use fearless_simd::{Simd, prelude::*};

use super::mpm_linear_2d::hats;
use super::{Points, PointsMut, Real};

scheme!(Mpm3, 3, [[T; 4]; 2], 1, false, "The 3D scheme: nodes (momentum, mass), (force, 0).");

impl<T: Real> Mpm3<T> {
    #[inline(always)]
    fn scatter_layers<S: Simd>(
        simd: S,
        points: &Points<T, 3>,
        layers: Range<usize>,
        dt: T,
        nodes: &mut [[[T; 4]; 2]],
    ) {
        let [_, ny, nz] = points.cells;
        for i in layers.clone() {
            for j in 0..ny {
                for k in 0..nz {
                    let first = ((i - layers.start) * (ny + 1) + j) * (nz + 1) + k;
                    for p in points.of_cell((i * ny + j) * nz + k) {
                        Self::scatter(simd, points, p, [i, j, k], dt, &mut nodes[first..]);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn scatter<S: Simd>(
        simd: S,
        points: &Points<T, 3>,
        p: usize,
        cell: [usize; 3],
        dt: T,
        nodes: &mut [[[T; 4]; 2]],
    ) {
        let [_, ny, nz] = points.cells;
        let (per_h, o) = (T::one() / points.spacing, T::zero());
        let splat = |value: T| T::Four::splat(simd, value);
        let x = points.position[p];
        let [rx, ry, rz] = [0, 1, 2].map(|a| hats(x[a], cell[a], per_h));
        let (m, density, v) = (points.mass[p], points.density[p], points.velocity[p]);
        let push = dt * m / density * points.pressure(density);
        let slope = [-push * per_h, push * per_h];
        let momentum = splat(m) * T::Four::load_array(simd, [v[0], v[1], v[2], T::one()]);
        let weight_z = rz.map(splat);
        let factor_z = [0, 1].map(|k| T::Four::load_array(simd, [rz[k], rz[k], slope[k], o]));
        for i in 0..2 {
            for j in 0..2 {
                let weight = rx[i] * ry[j];
                let row = momentum * splat(weight);
                let force =
                    T::Four::load_array(simd, [slope[i] * ry[j], rx[i] * slope[j], weight, o]);
                let first = (i * (ny + 1) + j) * (nz + 1);
                let nodes = &mut nodes[first..first + 2];
                for k in 0..2 {
                    let [sum, impulse] = &mut nodes[k];
                    (T::Four::load_array_ref(simd, sum) + row * weight_z[k]).store_array(sum);
                    (T::Four::load_array_ref(simd, impulse) + force * factor_z[k])
                        .store_array(impulse);
                }
            }
        }
    }

    /// Nodes (v⁺, v⁺_z), (Δt a, 0): the last lane serves the gradient along z.
    pub fn update_grid(&mut self, _dt: T) {
        let [nx, ny, nz] = self.points.cells.map(|n| n + 1);
        let free = |wall| if wall { T::zero() } else { T::one() };
        for (i, layer) in self.nodes.chunks_exact_mut(ny * nz).enumerate() {
            for (j, line) in layer.chunks_exact_mut(nz).enumerate() {
                let (free_x, free_y) = (free(i == 0 || i == nx - 1), free(j == 0 || j == ny - 1));
                for (k, [sum, impulse]) in line.iter_mut().enumerate() {
                    let free = [free_x, free_y, free(k == 0 || k == nz - 1)];
                    let per_mass = if sum[3] > T::zero() { sum[3].recip() } else { T::zero() };
                    for a in 0..3 {
                        impulse[a] = impulse[a] * per_mass * free[a];
                        sum[a] = sum[a] * per_mass * free[a] + impulse[a];
                    }
                    sum[3] = sum[2];
                }
            }
        }
    }

    #[inline(always)]
    fn gather_layers<S: Simd>(
        simd: S,
        mut points: PointsMut<T, 3>,
        layers: Range<usize>,
        dt: T,
        nodes: &[[[T; 4]; 2]],
    ) -> bool {
        let [_, ny, nz] = points.cells;
        let mut moved = false;
        for i in layers {
            for j in 0..ny {
                for k in 0..nz {
                    let nodes = &nodes[(i * (ny + 1) + j) * (nz + 1) + k..];
                    for p in points.of_cell((i * ny + j) * nz + k) {
                        moved |= Self::gather(simd, &mut points, p, [i, j, k], dt, nodes);
                    }
                }
            }
        }
        moved
    }

    #[inline(always)]
    fn gather<S: Simd>(
        simd: S,
        points: &mut PointsMut<T, 3>,
        p: usize,
        cell: [usize; 3],
        dt: T,
        nodes: &[[[T; 4]; 2]],
    ) -> bool {
        let [_, ny, nz] = points.cells;
        let per_h = T::one() / points.spacing;
        let splat = |value: T| T::Four::splat(simd, value);
        let load = |row: &[T; 4]| T::Four::load_array_ref(simd, row);
        let x = points.position[p];
        let [rx, ry, rz] = [0, 1, 2].map(|a| hats(x[a], cell[a], per_h));
        let slope = [-per_h, per_h];
        // Sums of N v⁺ (with N_z' v⁺_z in the last lane) and of N Δt a.
        let (mut v, mut increment, mut divergence) =
            (splat(T::zero()), splat(T::zero()), T::zero());
        let weight_z = rz.map(splat);
        let factor_z = [0, 1].map(|k| T::Four::load_array(simd, [rz[k], rz[k], rz[k], slope[k]]));
        for i in 0..2 {
            for j in 0..2 {
                let first = (i * (ny + 1) + j) * (nz + 1);
                let nodes = &nodes[first..first + 2];
                let line = load(&nodes[0][0]) * factor_z[0] + load(&nodes[1][0]) * factor_z[1];
                let step = load(&nodes[0][1]) * weight_z[0] + load(&nodes[1][1]) * weight_z[1];
                let weight = splat(rx[i] * ry[j]);
                v += line * weight;
                increment += step * weight;
                let [vx, vy, ..] = *line.as_array();
                divergence += slope[i] * ry[j] * vx + rx[i] * slope[j] * vy;
            }
        }
        let (v, increment) = (v.to_array(), increment.to_array());
        let motion = [v[0], v[1], v[2]];
        let change = [increment[0], increment[1], increment[2]];
        points.advance(p, cell, motion, change, divergence + v[3], dt)
    }
}
