//! Which cells the surface cuts, and where in them the fluid is.

use super::plane::{Plane, normal};
use super::{Quadrature, Samples};
use crate::Scalar;
use crate::cells::{ABSENT, CellKind, Cells};
use crate::grid::{Grid, shift_of};
use crate::material::Material;
use crate::math::dot;
use crate::method::Method;
use crate::parallel::for_each_block;
use crate::reconstruction::{Cloud, Neighborhood};
use crate::step::{CELL_GRAIN, Center, StateOf, View};

/// Tells boundary cells from internal ones: a boundary cell has an empty cell among its neighbours.
///
/// Diagonal neighbours count (8 in 2D, 26 in 3D). What lies outside the box or in a body is not an empty cell.
/// A cell is near the surface when it or a neighbour is a boundary cell.
pub fn classify<T: Scalar, const D: usize>(grid: &Grid<T, D>, cells: &mut Cells) {
    for slot in 0..cells.len() {
        let cell = grid.cell_coordinates(cells.index[slot]);
        let full = grid.all_around(cell, |found| !cells.is_vacant(found));
        cells.kind[slot] = if full { CellKind::Internal } else { CellKind::Boundary };
    }
    // Cells next to empty ones are boundary cells themselves: these are few, and mark those around.
    cells.near_surface.fill(false);
    for slot in (0..cells.len()).filter(|&slot| cells.kind[slot] == CellKind::Boundary) {
        for found in grid.around(grid.cell_coordinates(cells.index[slot])) {
            if let Some(near) = cells.near_surface.get_mut(cells.slot_of[found] as usize) {
                *near = true;
            }
        }
    }
}

/// The rival criterion of Sect. 2.3 of \[Song2020\]: a cell is a boundary cell while Σ m/ρ < β V.
///
/// `kind` of the cells behind `cloud` is what changes; it has to be found anew in every step.
pub fn classify_by_volume<T: Scalar, const D: usize>(
    cloud: &Cloud<'_, T, D>,
    least_share: T,
    kind: &mut Vec<CellKind>,
) {
    let least = least_share * cloud.grid.cell_volume();
    kind.clear();
    kind.extend((0..cloud.cells.len()).map(|slot| {
        let carried = cloud.cells.points(slot).map(|p| cloud.mass[p] / cloud.density[p]);
        let volume = carried.fold(T::zero(), |sum, volume| sum + volume);
        if volume < least { CellKind::Boundary } else { CellKind::Internal }
    }));
}

/// A cell is near the surface when it or a neighbour is a boundary cell or empty, whatever tells boundary
/// cells from internal ones.
pub fn mark_near_surface<T: Scalar, const D: usize>(grid: &Grid<T, D>, cells: &mut Cells) {
    for slot in 0..cells.len() {
        let cell = grid.cell_coordinates(cells.index[slot]);
        cells.near_surface[slot] = !grid.all_around(cell, |found| {
            let kind = cells.kind.get(cells.slot_of[found] as usize);
            kind == Some(&CellKind::Internal) || cells.is_solid(found)
        });
    }
}

/// Volume of fluid in an active cell, m³: the carried volume of each point fills a box about its position,
/// `edge` cells wide, and a cell holds what lies in it.
///
/// All boxes have the size that points had at the start: sizes that follow the volumes would make a slab of
/// points in 3D differ from the same points in 2D.
///
/// What of a box lies in cells without points, or beyond a wall, counts in the point's own cell, so that the
/// sum over all active cells is the carried volume. It changes continuously
/// as points cross faces between such cells.
pub fn boxed_volume<T: Scalar, const D: usize>(cloud: &Cloud<'_, T, D>, edge: T, slot: usize) -> T {
    let Cloud { grid, cells, .. } = *cloud;
    let cell = grid.cell_coordinates(cells.index[slot]);
    let own = cells.points(slot);
    let center = cell.map(|c| T::from_index(c) + T::lit(0.5));
    let mut active = [false; 27];
    for (code, active) in active.iter_mut().enumerate().take(3_usize.pow(D as u32)) {
        let found = grid.neighbor(cell, shift_of(code));
        *active = found.is_some_and(|found| cells.slot_of[found] != ABSENT);
    }
    let mut volume = T::zero();
    cloud.visit(Neighborhood::of_cells_around(grid, cell), center, |point, offset| {
        if !own.contains(&point) {
            let inside = offset.map(|x| share_at(x, edge, T::zero()));
            if inside.iter().all(|&share| share > T::zero()) {
                let carried = cloud.mass[point] / cloud.density[point];
                volume += inside.iter().fold(carried, |product, &share| product * share);
            }
            return;
        }
        let carried = cloud.mass[point] / cloud.density[point];
        let share = shares(offset, edge);
        let mut elsewhere = T::zero();
        for code in
            (0..3_usize.pow(D as u32)).filter(|&code| active[code] && code != own_code::<D>())
        {
            let mut rest = code;
            let mut product = T::one();
            for along in &share {
                product *= along[rest % 3];
                rest /= 3;
            }
            elsewhere += product;
        }
        volume += carried * (T::one() - elsewhere);
    });
    volume
}

/// Shares of a box that lie in a cell's left neighbour, in the cell and in its right neighbour, along each
/// axis; `offset` is that of the box from the cell's centre in cells.
#[inline(always)]
fn shares<T: Scalar, const D: usize>(offset: [T; D], edge: T) -> [[T; 3]; D] {
    offset.map(|x| [-T::one(), T::zero(), T::one()].map(|at| share_at(x, edge, at)))
}

/// Share of an interval about `x` that lies within half a cell of `at`.
#[inline(always)]
fn share_at<T: Scalar>(x: T, edge: T, at: T) -> T {
    let (half, reach) = (T::lit(0.5), T::lit(0.5) * edge);
    let (upper, lower) = ((x + reach).min(at + half), (x - reach).max(at - half));
    (upper - lower).max(T::zero()) / edge
}

/// The code of no shift.
const fn own_code<const D: usize>() -> usize {
    (3_usize.pow(D as u32) - 1) / 2
}

/// Places of the cells' samples, m: cell centres, and in boundary cells the centroid of the part that a
/// plane cuts off, whose normal follows from the fluid's share of the cells around
/// (\[ParkerYoungs1992\], \[Scardovelli2000\]).
///
/// Left empty where no cell of the rule is sampled so. `centers` are those of the step.
pub fn wetted_sites<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    centers: &[Center<T, StateOf<T, D, K>>],
    sites: &mut Vec<[T; D]>,
) where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    sites.clear();
    let is_balanced = match view.method.quadrature().samples(CellKind::Boundary) {
        Samples::Wetted => false,
        Samples::Balanced => true,
        Samples::Points | Samples::Center | Samples::Part => return,
    };
    sites.resize(centers.len(), [T::zero(); D]);
    let (grid, cells) = (view.grid, view.cells);
    let volume = |slot: usize| centers[slot].volume;
    for_each_block(
        centers.len(),
        CELL_GRAIN,
        sites.as_mut_slice(),
        &|slots, part: &mut [[T; D]]| {
            for (slot, site) in slots.zip(part) {
                let cell = grid.cell_coordinates(cells.index[slot]);
                let part = WetPart::of(grid, cells, slot, volume);
                let inside = part.map_or([T::lit(0.5); D], |part| {
                    if is_balanced { part.balanced() } else { part.centroid() }
                });
                for axis in 0..D {
                    let place = T::from_index(cell[axis]) + inside[axis];
                    site[axis] = grid.origin[axis] + grid.spacing[axis] * place;
                }
            }
        },
    );
}

/// The part of a boundary cell that a plane cuts off.
#[derive(Clone, Copy, Debug)]
pub(super) struct WetPart<T, const D: usize> {
    /// Points out of the fluid.
    normal: [T; D],
    /// Volume of the fluid over that of the cell; above 1 where it holds that of an empty neighbour.
    fraction: T,
}

impl<T: Scalar, const D: usize> WetPart<T, D> {
    /// That of an active cell, given the volumes of fluid of all, m³; `None` in full cells, and where no side is wetter
    /// than the other.
    pub fn of(
        grid: &Grid<T, D>,
        cells: &Cells,
        slot: usize,
        volume: impl Fn(usize) -> T,
    ) -> Option<Self> {
        if cells.kind[slot] == CellKind::Internal {
            return None;
        }
        let cell = grid.cell_coordinates(cells.index[slot]);
        let per_volume = T::one() / grid.cell_volume();
        let share_at = |shift| {
            let found = grid.neighbor(cell, shift)?;
            if cells.is_solid(found) {
                return None;
            }
            let slot = cells.slot_of[found];
            Some(if slot == ABSENT { T::zero() } else { volume(slot as usize) * per_volume })
        };
        Some(Self { normal: normal(share_at)?, fraction: volume(slot) * per_volume })
    }

    /// Its centroid, cells from the lower corner.
    pub fn centroid(&self) -> [T; D] {
        Plane::of_fraction(self.normal, self.fraction).wetted().centroid
    }

    /// The same, of fluid that reaches into the empty neighbour too.
    pub fn whole_centroid(&self) -> [T; D] {
        let mut centroid = self.centroid();
        let length = dot(self.normal, self.normal).sqrt();
        let beyond = T::lit(0.5) * (self.fraction - T::one()).max(T::zero()) / length;
        for axis in 0..D {
            centroid[axis] += beyond * self.normal[axis];
        }
        centroid
    }
}
