//! Affine particle-in-cell in 2D on quadratic B-splines with open knots at the walls.
//!
//! Momentum and the impulse of the pressure share one four-wide row per node, since an affine transfer
//! needs no acceleration. Each point's stencil is factored: a node costs two four-wide products.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use std::ops::Range;

use fearless_simd::{Simd, prelude::*};

use super::row::Row;
use super::{Points, PointsMut, Real};

scheme!(Apic2, 2, [T; 4], 2, true, "The 2D scheme.");

impl<T: Real> Apic2<T> {
    #[inline(always)]
    fn scatter_layers<S: Simd>(
        simd: S,
        points: &Points<T, 2>,
        layers: Range<usize>,
        dt: T,
        nodes: &mut [[T; 4]],
    ) {
        let ny = points.cells[1];
        for i in layers.clone() {
            for j in 0..ny {
                let first = (i - layers.start) * (ny + 2) + j;
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
        [i, j]: [usize; 2],
        dt: T,
        nodes: &mut [[T; 4]],
    ) {
        let [nx, ny] = points.cells;
        let (h, per_h) = (points.spacing, T::one() / points.spacing);
        let four = |values: [T; 4]| T::Four::load_array(simd, values);
        let splat = |value: T| T::Four::splat(simd, value);
        let o = T::zero();
        let [x, y] = points.position[p];
        let rx = Row::new(x, i, nx, h, per_h);
        let ry = Row::new(y, j, ny, h, per_h);
        let (m, density, v, c) =
            (points.mass[p], points.density[p], points.velocity[p], points.affine[p]);
        let impulse = dt * m / density * points.pressure(density);
        let mass = splat(m);
        let cx = mass * four([c[0][0], c[1][0], o, o]);
        let cy = mass * four([c[0][1], c[1][1], o, o]);
        let at_point = mass * four([v[0], v[1], T::one(), o]);
        let weight_y = ry.value.map(splat);
        let along_y: [T::Four<S>; 3] = std::array::from_fn(|j| {
            cy * splat(ry.moment[j]) + four([o, impulse * ry.slope[j], o, o])
        });
        for i in 0..3 {
            let weight = splat(rx.value[i]);
            let push = four([impulse * rx.slope[i], o, o, o]);
            let row = at_point * weight + cx * splat(rx.moment[i]) + push;
            let nodes = &mut nodes[i * (ny + 2)..i * (ny + 2) + 3];
            for j in 0..3 {
                let add = row * weight_y[j] + along_y[j] * weight;
                (T::Four::load_array_ref(simd, &nodes[j]) + add).store_array(&mut nodes[j]);
            }
        }
    }

    /// Node rows (v⁺, v⁺): the second pair serves the first moments along y.
    pub fn update_grid(&mut self, _dt: T) {
        let [nx, ny] = self.points.cells.map(|n| n + 2);
        for (i, line) in self.nodes.chunks_exact_mut(ny).enumerate() {
            let free_x = if i == 0 || i == nx - 1 { T::zero() } else { T::one() };
            for row in &mut *line {
                let per_mass = if row[2] > T::zero() { row[2].recip() } else { T::zero() };
                let (u, v) = (row[0] * per_mass * free_x, row[1] * per_mass);
                *row = [u, v, u, v];
            }
            for j in [0, ny - 1] {
                line[j][1] = T::zero();
                line[j][3] = T::zero();
            }
        }
    }

    #[inline(always)]
    fn gather_layers<S: Simd>(
        simd: S,
        mut points: PointsMut<T, 2>,
        layers: Range<usize>,
        dt: T,
        nodes: &[[T; 4]],
    ) -> bool {
        let ny = points.cells[1];
        let mut moved = false;
        for i in layers {
            for j in 0..ny {
                let nodes = &nodes[i * (ny + 2) + j..];
                for p in points.of_cell(i * ny + j) {
                    moved |= Self::gather(simd, &mut points, p, [i, j], dt, nodes);
                }
            }
        }
        moved
    }

    #[inline(always)]
    fn gather<S: Simd>(
        simd: S,
        points: &mut PointsMut<T, 2>,
        p: usize,
        [i, j]: [usize; 2],
        dt: T,
        nodes: &[[T; 4]],
    ) -> bool {
        let [nx, ny] = points.cells;
        let (h, per_h) = (points.spacing, T::one() / points.spacing);
        let splat = |value: T| T::Four::splat(simd, value);
        let mut moved = false;
        let x = &mut points.position[p];
        let rx = Row::new(x[0], i, nx, h, per_h);
        let ry = Row::new(x[1], j, ny, h, per_h);
        let factors: [T::Four<S>; 3] = std::array::from_fn(|j| {
            let (n, b) = (ry.value[j], ry.moment[j]);
            T::Four::load_array(simd, [n, n, b, b])
        });
        // Sums of (N v, N (y_i − y_p) v) and of N (x_i − x_p) v.
        let (mut sum, mut bx, mut divergence) = (splat(T::zero()), splat(T::zero()), T::zero());
        for i in 0..3 {
            let nodes = &nodes[i * (ny + 2)..i * (ny + 2) + 3];
            let row: [T::Four<S>; 3] =
                std::array::from_fn(|j| T::Four::load_array_ref(simd, &nodes[j]));
            let line = row[0] * factors[0] + row[1] * factors[1] + row[2] * factors[2];
            let slope =
                ry.slope[0] * nodes[0][1] + ry.slope[1] * nodes[1][1] + ry.slope[2] * nodes[2][1];
            divergence += rx.slope[i] * line.as_array()[0] + rx.value[i] * slope;
            sum += line * splat(rx.value[i]);
            bx += line * splat(rx.moment[i]);
        }
        let (sum, bx) = (sum.to_array(), bx.to_array());
        let cell = [i, j];
        for a in 0..2 {
            points.velocity[p][a] = sum[a];
            points.affine[p][a] = [bx[a] * rx.per_second, sum[2 + a] * ry.per_second];
            x[a] += dt * sum[a];
            let xi = x[a] * per_h - T::index(cell[a]);
            moved |= xi < T::zero() || xi >= T::one();
        }
        points.density[p] /= T::one() + dt * divergence;
        moved
    }
}
