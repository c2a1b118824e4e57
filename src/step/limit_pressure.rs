//! Limiters of the pressure's slope in a cell, acting across cells.

use nalgebra::{Cholesky, SMatrix, SVector};

use super::{CELL_GRAIN, ParticlesOf, Physics};
use crate::Scalar;
use crate::cells::{ABSENT, Cells};
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::{fold_blocks, for_each_block};
use crate::settings::PressureLimiter;

/// Volume-weighted means over the points of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellMean<T, const D: usize> {
    /// Pressure of the law, Pa.
    pub pressure: T,
    /// Center of volume, cells from the box's lower corner.
    pub center: [T; D],
}

/// A face neighbour: where it lies from the cell's center of volume, cells, and by how much its
/// pressure is higher, Pa.
type Neighbor<T, const D: usize> = ([T; D], T);

/// Replaces the pressures of a cell's points by a limited linear profile about the cell's mean.
///
/// ```text
/// p_p = p_c + G_c · (x_p − x_c),   ρ_p = ρ(p_p)
/// ```
///
/// p_c and x_c are volume-weighted means, so the cell's mean pressure stays. The slope G_c is found from
/// the means of the face neighbours that hold points; towards a wall or a surface it vanishes.
/// Returns the number of cells whose slope the limiter reduced.
pub fn limit_pressure<T, const D: usize, M, K>(
    limiter: PressureLimiter,
    physics: &Physics<T, D, K>,
    (grid, cells): (&Grid<T, D>, &Cells),
    means: &mut Vec<CellMean<T, D>>,
    particles: &mut ParticlesOf<T, D, M, K>,
) -> u64
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let empty = CellMean { pressure: T::zero(), center: [T::zero(); D] };
    means.resize(cells.len(), empty);
    let p = &*particles;
    for_each_block(cells.len(), CELL_GRAIN, means.as_mut_slice(), &|slots, part: &mut [_]| {
        for (slot, mean) in slots.zip(part) {
            *mean = mean_of::<T, D, M, K>(physics, grid, p, cells.points(slot));
        }
    });
    let ParticlesOf::<T, D, M, K> { position, density, state, .. } = particles;
    let law = &physics.equation_of_state;
    let first = &cells.first;
    let work = |slots: std::ops::Range<usize>, part: &mut [T]| {
        let begin = first[slots.start] as usize;
        let mut n_limited = 0;
        for slot in slots {
            let mean = means[slot];
            let points = cells.points(slot);
            let around = neighbors(grid, cells, means, slot);
            let offset = |point: usize| {
                std::array::from_fn(|a| grid.in_cells(position[point], a) - mean.center[a])
            };
            let (slope, limited) = match limiter {
                PressureLimiter::PerAxis => per_axis(&around),
                PressureLimiter::BarthJespersen => {
                    barth_jespersen(&around, points.clone().map(offset))
                }
            };
            n_limited += u64::from(limited);
            for point in points {
                let pressure = mean.pressure + crate::math::dot(slope, offset(point));
                part[point - begin] = law.density(pressure, K::energy(&state[point]));
            }
        }
        n_limited
    };
    let cut = |slot: usize| first[slot] as usize;
    fold_blocks(cells.len(), CELL_GRAIN, density.as_mut_slice(), &cut, &work, &|a, b| a + b)
}

fn mean_of<T, const D: usize, M, K>(
    physics: &Physics<T, D, K>,
    grid: &Grid<T, D>,
    p: &ParticlesOf<T, D, M, K>,
    points: std::ops::Range<usize>,
) -> CellMean<T, D>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let (mut total, mut pressure, mut center) = (T::zero(), T::zero(), [T::zero(); D]);
    for point in points {
        let volume = p.mass[point] / p.density[point];
        total += volume;
        let energy = K::energy(&p.state[point]);
        pressure += volume * physics.equation_of_state.pressure(p.density[point], energy);
        for axis in 0..D {
            center[axis] += volume * grid.in_cells(p.position[point], axis);
        }
    }
    CellMean { pressure: pressure / total, center: center.map(|sum| sum / total) }
}

/// The neighbours across the lower and the upper face of each axis, where they hold points.
fn neighbors<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cells: &Cells,
    means: &[CellMean<T, D>],
    slot: usize,
) -> [[Option<Neighbor<T, D>>; 2]; D] {
    let cell = grid.cell_coordinates(cells.index[slot]);
    let own = means[slot];
    std::array::from_fn(|axis| {
        [-1, 1].map(|step| {
            let mut shift = [0; D];
            shift[axis] = step;
            let other = cells.slot_of[grid.neighbor(cell, shift)?];
            if other == ABSENT {
                return None;
            }
            let mean = means[other as usize];
            let mut offset: [T; D] = std::array::from_fn(|a| mean.center[a] - own.center[a]);
            // Over a periodic face the neighbour stands at the other end of the box.
            let length = T::from_index(grid.n_cells[axis]);
            let half = T::lit(0.5) * length;
            if offset[axis] > half {
                offset[axis] -= length;
            } else if offset[axis] < -half {
                offset[axis] += length;
            }
            Some((offset, mean.pressure - own.pressure))
        })
    })
}

/// Monotonized central slope, Pa per cell, and whether it differs from the central one.
fn per_axis<T: Scalar, const D: usize>(
    around: &[[Option<Neighbor<T, D>>; 2]; D],
) -> ([T; D], bool) {
    let two = T::lit(2.0);
    let mut limited = false;
    let slope = std::array::from_fn(|axis| {
        let [Some((below, fall)), Some((above, rise))] = around[axis] else {
            limited = true;
            return T::zero();
        };
        let (back, ahead) = (fall / below[axis], rise / above[axis]);
        let central = (rise - fall) / (above[axis] - below[axis]);
        let least = central.abs().min(two * back.abs()).min(two * ahead.abs());
        let agree = back * ahead > T::zero() && above[axis] > T::zero() && below[axis] < T::zero();
        let chosen = if agree { least * central.signum() } else { T::zero() };
        limited |= chosen != central;
        chosen
    });
    (slope, limited)
}

/// Least-squares slope, Pa per cell, scaled so that no point leaves the range of the means, and
/// whether it had to be.
fn barth_jespersen<T: Scalar, const D: usize>(
    around: &[[Option<Neighbor<T, D>>; 2]; D],
    points: impl Iterator<Item = [T; D]>,
) -> ([T; D], bool) {
    let mut matrix = SMatrix::<T, D, D>::zeros();
    let mut right = SVector::<T, D>::zeros();
    let (mut lowest, mut highest) = (T::zero(), T::zero());
    for (axis, faces) in around.iter().enumerate() {
        if faces.iter().all(Option::is_none) {
            matrix[(axis, axis)] += T::one();
        }
        for (offset, rise) in faces.iter().flatten() {
            let offset = SVector::from(*offset);
            matrix += offset * offset.transpose();
            right += offset * *rise;
            lowest = lowest.min(*rise);
            highest = highest.max(*rise);
        }
    }
    let Some(factor) = Cholesky::new(matrix) else {
        return ([T::zero(); D], true);
    };
    let slope: [T; D] = factor.solve(&right).into();
    let mut share = T::one();
    for offset in points {
        let change = crate::math::dot(slope, offset);
        if change > highest {
            share = share.min(highest / change);
        } else if change < lowest {
            share = share.min(lowest / change);
        }
    }
    (slope.map(|component| component * share), share < T::one())
}
