//! The material point method in 2D on linear hats: FLIP, stress updated last.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use std::ops::Range;

use fearless_simd::{Simd, prelude::*};

use super::{Points, PointsMut, Real};

scheme!(Mpm2, 2, [[T; 4]; 2], 1, false, "The 2D scheme: nodes (momentum, mass, 0), (force, 0, 0).");

/// The two functions of one axis at local coordinate `xi`.
#[inline(always)]
pub fn hats<T: Real>(x: T, cell: usize, per_spacing: T) -> [T; 2] {
    let xi = x * per_spacing - T::index(cell);
    [T::one() - xi, xi]
}

impl<T: Real> Mpm2<T> {
    #[inline(always)]
    fn scatter_layers<S: Simd>(
        simd: S,
        points: &Points<T, 2>,
        layers: Range<usize>,
        dt: T,
        nodes: &mut [[[T; 4]; 2]],
    ) {
        let ny = points.cells[1];
        for i in layers.clone() {
            for j in 0..ny {
                let first = (i - layers.start) * (ny + 1) + j;
                for p in points.of_cell(i * ny + j) {
                    Self::scatter(simd, points, p, [i, j], dt, &mut nodes[first..]);
                }
            }
        }
    }

    #[inline(always)]
    fn scatter<S: Simd>(
        simd: S,
        points: &Points<T, 2>,
        p: usize,
        cell: [usize; 2],
        dt: T,
        nodes: &mut [[[T; 4]; 2]],
    ) {
        let ny = points.cells[1];
        let (per_h, o) = (T::one() / points.spacing, T::zero());
        let splat = |value: T| T::Four::splat(simd, value);
        let x = points.position[p];
        let [rx, ry] = [0, 1].map(|a| hats(x[a], cell[a], per_h));
        let (m, density, v) = (points.mass[p], points.density[p], points.velocity[p]);
        let push = dt * m / density * points.pressure(density);
        let slope = [-push * per_h, push * per_h];
        let momentum = splat(m) * T::Four::load_array(simd, [v[0], v[1], T::one(), o]);
        let weight_y = ry.map(splat);
        let factor_y = [0, 1].map(|j| T::Four::load_array(simd, [ry[j], slope[j], o, o]));
        for i in 0..2 {
            let row = momentum * splat(rx[i]);
            let force = T::Four::load_array(simd, [slope[i], rx[i], o, o]);
            let nodes = &mut nodes[i * (ny + 1)..i * (ny + 1) + 2];
            for j in 0..2 {
                let [sum, impulse] = &mut nodes[j];
                (T::Four::load_array_ref(simd, sum) + row * weight_y[j]).store_array(sum);
                (T::Four::load_array_ref(simd, impulse) + force * factor_y[j]).store_array(impulse);
            }
        }
    }

    /// Nodes (v⁺, Δt a); the second row is spent.
    pub fn update_grid(&mut self, _dt: T) {
        let [nx, ny] = self.points.cells.map(|n| n + 1);
        let free = |wall| if wall { T::zero() } else { T::one() };
        for (i, line) in self.nodes.chunks_exact_mut(ny).enumerate() {
            for (j, [sum, impulse]) in line.iter_mut().enumerate() {
                let per_mass = if sum[2] > T::zero() { sum[2].recip() } else { T::zero() };
                let free = [free(i == 0 || i == nx - 1), free(j == 0 || j == ny - 1)];
                for a in 0..2 {
                    let change = impulse[a] * per_mass * free[a];
                    sum[a] = sum[a] * per_mass * free[a] + change;
                    sum[2 + a] = change;
                }
            }
        }
    }

    #[inline(always)]
    fn gather_layers<S: Simd>(
        simd: S,
        points: PointsMut<T, 2>,
        layers: Range<usize>,
        dt: T,
        nodes: &[[[T; 4]; 2]],
    ) -> bool {
        gather_layers2(simd, points, layers, dt, nodes, |node| &node[0])
    }
}

/// The 2D gather from nodes (v⁺, Δt a), which the transport point method shares.
#[inline(always)]
pub fn gather_layers2<S: Simd, T: Real, N>(
    simd: S,
    mut points: PointsMut<T, 2>,
    layers: Range<usize>,
    dt: T,
    nodes: &[N],
    row: impl Fn(&N) -> &[T; 4],
) -> bool {
    let ny = points.cells[1];
    let per_h = T::one() / points.spacing;
    let splat = |value: T| T::Four::splat(simd, value);
    let mut moved = false;
    for i in layers {
        for j in 0..ny {
            let first = i * (ny + 1) + j;
            let at = |n: usize| T::Four::load_array_ref(simd, row(&nodes[n]));
            let corner = [[at(first), at(first + 1)], [at(first + ny + 1), at(first + ny + 2)]];
            for p in points.of_cell(i * ny + j) {
                let x = points.position[p];
                let (rx, ry) = (hats(x[0], i, per_h), hats(x[1], j, per_h));
                let along_y = |i: usize| corner[i][0] * splat(ry[0]) + corner[i][1] * splat(ry[1]);
                let (low, high) = (along_y(0), along_y(1));
                let slope_x = (high + low * splat(-T::one())).to_array()[0];
                let at_y = |j: usize| {
                    corner[0][j].as_array()[1] * rx[0] + corner[1][j].as_array()[1] * rx[1]
                };
                let divergence = (slope_x + (at_y(1) - at_y(0))) * per_h;
                let sum = (low * splat(rx[0]) + high * splat(rx[1])).to_array();
                let (motion, change) = ([sum[0], sum[1]], [sum[2], sum[3]]);
                moved |= points.advance(p, [i, j], motion, change, divergence, dt);
            }
        }
    }
    moved
}
