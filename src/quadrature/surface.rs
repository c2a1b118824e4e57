//! Which cells the surface cuts, and where in them the fluid is.

use super::plane::{Plane, normal};
use super::{Quadrature, Samples};
use crate::Scalar;
use crate::cells::{ABSENT, CellKind, Cells};
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::for_each_block;
use crate::reconstruction::Cloud;
use crate::step::{CELL_GRAIN, Center, StateOf, View};

/// Tells boundary cells from internal ones: a boundary cell has an empty cell among its neighbours.
///
/// Diagonal neighbours count (8 in 2D, 26 in 3D). What lies outside the box is not an empty cell.
/// A cell is near the surface when it or a neighbour is a boundary cell.
pub fn classify<T: Scalar, const D: usize>(grid: &Grid<T, D>, cells: &mut Cells) {
    for slot in 0..cells.len() {
        let cell = grid.cell_coordinates(cells.index[slot]);
        let empty = any_neighbor(grid, cell, |found| cells.slot_of[found] == ABSENT);
        cells.kind[slot] = if empty { CellKind::Boundary } else { CellKind::Internal };
    }
    mark_near_surface(grid, cells);
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

/// A cell is near the surface when it or a neighbour is a boundary cell or empty.
pub fn mark_near_surface<T: Scalar, const D: usize>(grid: &Grid<T, D>, cells: &mut Cells) {
    for slot in 0..cells.len() {
        let cell = grid.cell_coordinates(cells.index[slot]);
        cells.near_surface[slot] = any_neighbor(grid, cell, |found| {
            let neighbor = cells.slot_of[found];
            neighbor == ABSENT || cells.kind[neighbor as usize] == CellKind::Boundary
        });
    }
}

/// Whether a cell or one of its neighbours within the box meets a condition.
fn any_neighbor<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    condition: impl Fn(usize) -> bool,
) -> bool {
    (0..3_usize.pow(D as u32)).any(|code| {
        let mut rest = code;
        let shift = std::array::from_fn(|_| {
            let step = (rest % 3) as i32 - 1;
            rest /= 3;
            step
        });
        grid.neighbor(cell, shift).is_some_and(&condition)
    })
}

/// Places of the cells' samples, m: cell centres, and in boundary cells the centroid of the part that a
/// plane cuts off, whose normal follows from the fluid's share of the cells around
/// (\[ParkerYoungs1992\], \[ScardovelliZaleski2000\]).
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
    let rule = view.method.quadrature();
    if rule.samples(CellKind::Boundary) != Samples::Wetted {
        return;
    }
    sites.resize(centers.len(), [T::zero(); D]);
    let (grid, cells) = (view.grid, view.cells);
    let per_volume = T::one() / grid.cell_volume();
    for_each_block(
        centers.len(),
        CELL_GRAIN,
        sites.as_mut_slice(),
        &|slots, part: &mut [[T; D]]| {
            for (slot, site) in slots.zip(part) {
                let cell = grid.cell_coordinates(cells.index[slot]);
                let fraction = |shift| {
                    let slot = cells.slot_of[grid.neighbor(cell, shift)?];
                    let wet = slot != ABSENT;
                    Some(if wet { centers[slot as usize].volume * per_volume } else { T::zero() })
                };
                let inside = match cells.kind[slot] {
                    CellKind::Internal => None,
                    CellKind::Boundary => normal(fraction).map(|normal| {
                        Plane::of_fraction(normal, centers[slot].volume * per_volume)
                            .wetted()
                            .centroid
                    }),
                };
                for axis in 0..D {
                    let along = inside.map_or(T::lit(0.5), |centroid| centroid[axis]);
                    let place = T::from_index(cell[axis]) + along;
                    site[axis] = grid.origin[axis] + grid.spacing[axis] * place;
                }
            }
        },
    );
}
