//! Cells that are empty although the fluid fills them.

use crate::Scalar;
use crate::cells::Marks;
use crate::grid::Grid;

/// What the cells around the points are, in five steps (Fig. 6 of \[Song2020\]).
///
/// 1. Cells that hold points are known.
/// 2. The weight of a node is the number of its cells that hold points.
/// 3. An empty cell is possibly full if each of its nodes has a weight. It counts from here on.
/// 4. An empty cell is a numerical fracture if each of its nodes has the full weight, the number of
///    its cells that exist.
/// 5. A cell with an empty one around it is cut by the surface, any other is internal.
///
/// An internal cell that has become empty is a fracture, too. An empty cell in the very corner of the
/// box is none otherwise: the node in the corner has no other cell, and the fluid may have left it.
/// Only cells next to those with points are visited.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// Dense numbers of the empty cells that are possibly full, ascending.
    pub possibly_full: Vec<u32>,
    /// Dense numbers of the fractures, ascending.
    pub fractures: Vec<u32>,
    /// For each cell with points, in the order given: whether it is internal.
    pub internal: Vec<bool>,
    were_internal: Vec<u32>,
    marks: Marks,
}

impl Survey {
    /// Nothing known yet of the cells of a grid.
    pub fn new<T: Scalar, const D: usize>(grid: &Grid<T, D>) -> Self {
        Self { marks: Marks::new(grid.total_cells()), ..Self::default() }
    }

    /// Looks at the cells again. `occupied` lists those that hold points, `is_occupied` tells the same.
    pub fn update<T: Scalar, const D: usize>(
        &mut self,
        grid: &Grid<T, D>,
        occupied: &[u32],
        is_occupied: impl Fn(usize) -> bool,
    ) {
        let Self { possibly_full, fractures, internal, were_internal, marks } = self;
        fractures.clear();
        fractures.extend(were_internal.iter().filter(|&&cell| !is_occupied(cell as usize)));
        internal.clear();
        were_internal.clear();
        for &cell in occupied {
            let at = grid.cell_coordinates(cell);
            let full = grid.all_around(at, &is_occupied);
            if !full {
                for found in grid.around(at).filter(|&found| !is_occupied(found)) {
                    marks.set(found);
                }
            }
            internal.push(full);
            if full {
                were_internal.push(cell);
            }
        }
        possibly_full.clear();
        marks.drain(|cell| {
            let at = grid.cell_coordinates(cell);
            if corners::<D>().all(|corner| at_corner(grid, at, corner).any(&is_occupied)) {
                possibly_full.push(cell);
            }
        });
        let counts =
            |cell: usize| is_occupied(cell) || possibly_full.binary_search(&(cell as u32)).is_ok();
        for &cell in &*possibly_full {
            let at = grid.cell_coordinates(cell);
            if corners::<D>().all(|corner| at_corner(grid, at, corner).all(counts)) {
                fractures.push(cell);
            }
        }
        fractures.sort_unstable();
        fractures.dedup();
    }
}

/// Possibly full cells and fractures where the cells `occupied` hold points.
///
/// `occupied` are dense numbers in any order; a number that belongs to no cell is ignored. There is no
/// step before, hence no cell that was internal.
///
/// ```
/// use transpoint::grid::Grid;
/// use transpoint::rearrangement::survey;
/// use transpoint::scene::{Boundary, GridSpec};
/// let spec = GridSpec { origin: [0.0], spacing: [1.0], cells: [5] };
/// let grid = Grid::<f64, 1>::new(&spec, &[[Boundary::Slip; 2]], 1)?;
/// assert_eq!(survey(&grid, &[0, 1, 3]).fractures, [2]);
/// # Ok::<(), transpoint::InvalidInput>(())
/// ```
pub fn survey<T: Scalar, const D: usize>(grid: &Grid<T, D>, occupied: &[u32]) -> Survey {
    let mut holds = vec![false; grid.total_cells()];
    for &cell in occupied {
        if let Some(entry) = holds.get_mut(cell as usize) {
            *entry = true;
        }
    }
    let occupied: Vec<_> =
        (0..holds.len()).filter(|&cell| holds[cell]).map(|cell| cell as u32).collect();
    let mut found = Survey::new(grid);
    found.update(grid, &occupied, |cell| holds[cell]);
    found
}

/// The corners of a cell: bit `a` is 1 at the upper end of axis `a`.
fn corners<const D: usize>() -> std::ops::Range<usize> {
    0..1 << D
}

/// The cells that meet at a corner of a cell and exist.
fn at_corner<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    corner: usize,
) -> impl Iterator<Item = usize> {
    corners::<D>().filter_map(move |code| {
        let side = |axis: usize| ((corner >> axis) & 1) as i32 + ((code >> axis) & 1) as i32 - 1;
        grid.neighbor(cell, std::array::from_fn(side))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Boundary, GridSpec};

    fn grid<const D: usize>(cells: [usize; D], periodic: [bool; D]) -> Grid<f64, D> {
        let spec = GridSpec { origin: [0.0; D], spacing: [1.0; D], cells };
        let faces = periodic
            .map(|joined| if joined { [Boundary::Periodic; 2] } else { [Boundary::Slip; 2] });
        Grid::new(&spec, &faces, 1).unwrap()
    }

    /// A map of one character per cell, `#` with points, `.` empty, `o` possibly full, `x` fracture;
    /// blanks separate rows of the last axis.
    fn check<const D: usize>(cells: [usize; D], periodic: [bool; D], map: &str) {
        let map: Vec<_> = map.chars().filter(|c| !c.is_whitespace()).collect();
        let grid = grid(cells, periodic);
        assert_eq!(map.len(), grid.total_cells(), "a map of another size");
        let those = |kinds: &[char]| -> Vec<u32> {
            (0..map.len()).filter(|&k| kinds.contains(&map[k])).map(|k| k as u32).collect()
        };
        let found = survey(&grid, &those(&['#']));
        assert_eq!(found.possibly_full, those(&['o', 'x']), "possibly full");
        assert_eq!(found.fractures, those(&['x']), "fractures");
    }

    #[test]
    fn maps_in_1d() {
        check([5], [false], "##x##");
        check([6], [false], "##..##");
        check([5], [false], ".##..");
        check([5], [true], "x####");
        check([6], [true], ".####.");
        check([2], [true], "#x");
        check([1], [false], ".");
        check([4], [false], "####");
    }

    #[test]
    fn holes_in_2d() {
        check([3, 5], [false; 2], "##### ##x## #####");
        check([3, 5], [false; 2], "##### #xx## #####");
        check([5, 5], [false; 2], "##### ##x## ##x## ##x## #####");
        check([4, 5], [false; 2], "##### #..## #..## #####");
        check([4, 5], [false; 2], "##### #x### ##x## #####");
    }

    #[test]
    fn walls_and_corners_in_2d() {
        check([3, 3], [false; 2], "#x# ### ###");
        check([3, 5], [false; 2], "#x### x##x# ###x#");
        // The fluid has left the wall, or the corner.
        check([3, 4], [false; 2], ".### .### .###");
        check([3, 4], [false; 2], "..## #### ###.");
        check([2, 2], [false; 2], "#. ##");
    }

    #[test]
    fn bays_and_free_surfaces_in_2d() {
        // A surface: what lies above it touches points with its lower corners only.
        check([3, 4], [false; 2], "##.. ##.. ##..");
        // The mouth of a narrow bay is possibly full, what lies behind is a fracture.
        check([3, 5], [false; 2], "####. #xxo. ####.");
        // A wide bay is open.
        check([4, 5], [false; 2], "####. ##... ##... ####.");
    }

    #[test]
    fn periodic_faces_in_2d() {
        check([3, 4], [true; 2], "x### #### ####");
        check([3, 4], [false, true], "x### #### ####");
        check([4, 4], [true; 2], ".##. #### #### .##.");
        check([3, 4], [true, false], "#x## #x## #x##");
    }

    #[test]
    fn holes_in_3d() {
        let full = "### ### ###";
        check([3; 3], [false; 3], &format!("{full} ### #x# ### {full}"));
        check([3; 3], [false; 3], &format!("#x# ### ### {full} {full}"));
        check([3; 3], [false; 3], &format!(".## ### ### {full} {full}"));
        check([3; 3], [true; 3], &format!("{full} {full} ### ### ##x"));
        let slab = "... ... ...";
        check([3; 3], [false; 3], &format!("{full} xxx xxx xxx {full}"));
        check([3; 3], [false; 3], &format!("{full} {full} {slab}"));
        check([4, 3, 3], [false; 3], &format!("{full} {slab} {slab} {full}"));
    }

    #[test]
    fn an_internal_cell_that_empties_is_a_fracture() {
        let grid = grid([6], [false]);
        let mut found = Survey::new(&grid);
        let mut update = |occupied: &[u32]| {
            found.update(&grid, occupied, |cell| occupied.contains(&(cell as u32)));
            found.fractures.clone()
        };
        assert!(update(&[0, 1, 2, 3]).is_empty());
        // Cells 0 and 1 were internal, 2 too; 3 was cut by the surface.
        assert_eq!(update(&[0]), [1, 2]);
        assert!(update(&[0]).is_empty(), "that was the step before last");
    }
}
