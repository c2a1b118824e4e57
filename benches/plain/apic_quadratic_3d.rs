//! Affine particle-in-cell in 3D on quadratic B-splines with open knots at the walls.
//!
//! Momentum and the impulse of the pressure share one four-wide row per node, since an affine transfer
//! needs no acceleration. Each point's stencil is factored: a node costs two four-wide products.

#![expect(clippy::inline_always, reason = "kernels must take the caller's instruction set")]

use std::ops::Range;

use fearless_simd::{Simd, prelude::*};

use super::row::Row;
use super::{Points, PointsMut, Real};

scheme!(Apic3, 3, [T; 4], 2, true, "The 3D scheme.");

impl<T: Real> Apic3<T> {
    #[inline(always)]
    fn scatter_layers<S: Simd>(
        simd: S,
        points: &Points<T, 3>,
        layers: Range<usize>,
        dt: T,
        nodes: &mut [[T; 4]],
    ) {
        let [_, ny, nz] = points.cells;
        for i in layers.clone() {
            for j in 0..ny {
                for k in 0..nz {
                    let first = ((i - layers.start) * (ny + 2) + j) * (nz + 2) + k;
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
        [i, j, k]: [usize; 3],
        dt: T,
        nodes: &mut [[T; 4]],
    ) {
        let [nx, ny, nz] = points.cells;
        let (h, per_h) = (points.spacing, T::one() / points.spacing);
        let four = |values: [T; 4]| T::Four::load_array(simd, values);
        let splat = |value: T| T::Four::splat(simd, value);
        let [x, y, z] = points.position[p];
        let rx = Row::new(x, i, nx, h, per_h);
        let ry = Row::new(y, j, ny, h, per_h);
        let rz = Row::new(z, k, nz, h, per_h);
        let (m, density, v, c) =
            (points.mass[p], points.density[p], points.velocity[p], points.affine[p]);
        let impulse = dt * m / density * points.pressure(density);
        let mass = splat(m);
        let column = |b: usize| mass * four([c[0][b], c[1][b], c[2][b], T::zero()]);
        let (cx, cy, cz) = (column(0), column(1), column(2));
        let at_point = mass * four([v[0], v[1], v[2], T::one()]);
        let along_z: [T::Four<S>; 3] = std::array::from_fn(|k| {
            let push = [T::zero(), T::zero(), impulse * rz.slope[k], T::zero()];
            cz * splat(rz.moment[k]) + four(push)
        });
        let weight_z = rz.value.map(splat);
        for i in 0..3 {
            let in_x = at_point * splat(rx.value[i]) + cx * splat(rx.moment[i]);
            let (push_x, push_y) = (impulse * rx.slope[i], impulse * rx.value[i]);
            let cy = cy * splat(rx.value[i]);
            for j in 0..3 {
                let push = [push_x * ry.value[j], push_y * ry.slope[j], T::zero(), T::zero()];
                let row = in_x * splat(ry.value[j]) + cy * splat(ry.moment[j]) + four(push);
                let weight = splat(rx.value[i] * ry.value[j]);
                let first = (i * (ny + 2) + j) * (nz + 2);
                let nodes = &mut nodes[first..first + 3];
                for k in 0..3 {
                    let add = row * weight_z[k] + along_z[k] * weight;
                    (T::Four::load_array_ref(simd, &nodes[k]) + add).store_array(&mut nodes[k]);
                }
            }
        }
    }

    /// Node rows (v⁺, v⁺_z): the last lane serves the gradient along z.
    pub fn update_grid(&mut self, _dt: T) {
        let [nx, ny, nz] = self.points.cells.map(|n| n + 2);
        for (i, layer) in self.nodes.chunks_exact_mut(ny * nz).enumerate() {
            for (j, line) in layer.chunks_exact_mut(nz).enumerate() {
                let free = |wall| if wall { T::zero() } else { T::one() };
                let (free_x, free_y) = (free(i == 0 || i == nx - 1), free(j == 0 || j == ny - 1));
                for row in &mut *line {
                    let per_mass = if row[3] > T::zero() { row[3].recip() } else { T::zero() };
                    let z = row[2] * per_mass;
                    *row = [row[0] * per_mass * free_x, row[1] * per_mass * free_y, z, z];
                }
                for k in [0, nz - 1] {
                    line[k][2] = T::zero();
                    line[k][3] = T::zero();
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
        nodes: &[[T; 4]],
    ) -> bool {
        let [_, ny, nz] = points.cells;
        let mut moved = false;
        for i in layers {
            for j in 0..ny {
                for k in 0..nz {
                    let nodes = &nodes[(i * (ny + 2) + j) * (nz + 2) + k..];
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
        [i, j, k]: [usize; 3],
        dt: T,
        nodes: &[[T; 4]],
    ) -> bool {
        let [nx, ny, nz] = points.cells;
        let (h, per_h) = (points.spacing, T::one() / points.spacing);
        let splat = |value: T| T::Four::splat(simd, value);
        let zero = splat(T::zero());
        let mut moved = false;
        let x = &mut points.position[p];
        let rx = Row::new(x[0], i, nx, h, per_h);
        let ry = Row::new(x[1], j, ny, h, per_h);
        let rz = Row::new(x[2], k, nz, h, per_h);
        // Sums of N v (with N_z' v_z in the last lane) and of N (x_i − x_p) v along each axis.
        let (mut v, mut bx, mut by, mut bz, mut divergence) = (zero, zero, zero, zero, T::zero());
        let value_z: [T::Four<S>; 3] = std::array::from_fn(|k| {
            T::Four::load_array(simd, [rz.value[k], rz.value[k], rz.value[k], rz.slope[k]])
        });
        let moment_z = rz.moment.map(splat);
        for i in 0..3 {
            let (mut vi, mut byi, mut bzi, mut slope_y) = (zero, zero, zero, T::zero());
            for j in 0..3 {
                let first = (i * (ny + 2) + j) * (nz + 2);
                let nodes = &nodes[first..first + 3];
                let row: [T::Four<S>; 3] =
                    std::array::from_fn(|k| T::Four::load_array_ref(simd, &nodes[k]));
                let vij = row[0] * value_z[0] + row[1] * value_z[1] + row[2] * value_z[2];
                let bij = row[0] * moment_z[0] + row[1] * moment_z[1] + row[2] * moment_z[2];
                slope_y += ry.slope[j] * vij.as_array()[1];
                vi += vij * splat(ry.value[j]);
                byi += vij * splat(ry.moment[j]);
                bzi += bij * splat(ry.value[j]);
            }
            divergence += rx.slope[i] * vi.as_array()[0] + rx.value[i] * slope_y;
            v += vi * splat(rx.value[i]);
            bx += vi * splat(rx.moment[i]);
            by += byi * splat(rx.value[i]);
            bz += bzi * splat(rx.value[i]);
        }
        let v = v.to_array();
        let (bx, by, bz) = (
            (bx * splat(rx.per_second)).to_array(),
            (by * splat(ry.per_second)).to_array(),
            (bz * splat(rz.per_second)).to_array(),
        );
        let cell = [i, j, k];
        for a in 0..3 {
            points.velocity[p][a] = v[a];
            points.affine[p][a] = [bx[a], by[a], bz[a]];
            x[a] += dt * v[a];
            let xi = x[a] * per_h - T::index(cell[a]);
            moved |= xi < T::zero() || xi >= T::one();
        }
        points.density[p] /= T::one() + dt * (divergence + v[3]);
        moved
    }
}
