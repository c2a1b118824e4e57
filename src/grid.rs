//! The background grid: a box of equal cells, row-major with the last axis contiguous.

use crate::error::InvalidInput;
use crate::math::widen;
use crate::scene::{Boundary, GridSpec, Relaxation};
use crate::{Scalar, shape::AxisPosition};

/// Geometry and numbering of cells and nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<T, const D: usize> {
    /// Lower corner, m.
    pub origin: [T; D],
    /// Cell size, m.
    pub spacing: [T; D],
    /// 1 / spacing, 1/m.
    pub inverse_spacing: [T; D],
    /// Cells per axis.
    pub n_cells: [usize; D],
    /// Nodes stored per axis minus cells (a property of the shape function).
    pub extra: usize,
    /// Axes whose two faces are joined.
    pub periodic: [bool; D],
    /// Lower corner and 1 / spacing once more, padded with zeros: where a vector is loaded from the fields
    /// above, its spare lanes hold what comes next in memory, and arithmetic on that may be very slow.
    padded: [[T; 4]; 2],
}

impl<T: Scalar, const D: usize> Grid<T, D> {
    /// Checks and converts the grid of a scene.
    ///
    /// # Errors
    /// When a size is not positive and finite, an axis has no cells, faces are not paired, a periodic
    /// axis has fewer cells than the shape function needs, or cells or nodes cannot be numbered by `u32`.
    pub fn new(
        spec: &GridSpec<D>,
        boundaries: &[[Boundary; 2]; D],
        extra: usize,
    ) -> Result<Self, InvalidInput> {
        let mut n_nodes = 1_u128;
        for axis in 0..D {
            check_axis(spec, boundaries[axis], extra, axis)?;
            n_nodes *= (spec.cells[axis] + extra) as u128;
        }
        if n_nodes >= u128::from(u32::MAX) {
            return Err(InvalidInput::new(
                "grid.cells",
                format!("{:?}", spec.cells),
                "fewer than 2³² nodes",
            ));
        }
        let origin = spec.origin.map(T::lit);
        let inverse_spacing = spec.spacing.map(|h| T::lit(1.0 / h));
        Ok(Self {
            origin,
            spacing: spec.spacing.map(T::lit),
            inverse_spacing,
            padded: [widen(origin), widen(inverse_spacing)],
            n_cells: spec.cells,
            extra,
            periodic: boundaries.map(|faces| faces[0] == Boundary::Periodic),
        })
    }

    /// Volume of a cell, m³ (m² in 2D, m in 1D).
    pub fn cell_volume(&self) -> T {
        self.spacing.iter().fold(T::one(), |volume, &h| volume * h)
    }

    /// Number of cells.
    pub fn total_cells(&self) -> usize {
        self.n_cells.iter().product()
    }

    /// Nodes stored along an axis.
    pub fn n_nodes(&self, axis: usize) -> usize {
        self.n_cells[axis] + self.extra
    }

    /// Number of nodes stored by a dense numbering.
    pub fn total_nodes(&self) -> usize {
        (0..D).map(|axis| self.n_nodes(axis)).product()
    }

    /// Position along an axis in cells from the lower face.
    #[inline(always)]
    pub fn in_cells(&self, position: [T; D], axis: usize) -> T {
        (position[axis] - self.origin[axis]) * self.inverse_spacing[axis]
    }

    /// Lower corner, m, and 1 / spacing, 1/m, padded with zeros.
    #[inline(always)]
    pub(crate) fn padded(&self) -> &[[T; 4]; 2] {
        &self.padded
    }

    /// Cell that holds a position, or `None` outside the box (or not a number).
    ///
    /// The upper face belongs to the last cell.
    #[inline(always)]
    pub fn cell_of(&self, position: [T; D]) -> Option<u32> {
        let mut index = 0;
        for axis in 0..D {
            let s = self.in_cells(position, axis);
            let n = self.n_cells[axis];
            let end = T::from_index(n);
            if !(s >= T::zero() && s <= end) {
                return None;
            }
            index = index * n + (s.truncate() as usize).min(n - 1);
        }
        Some(index as u32)
    }

    /// Index of a cell along each axis.
    #[inline(always)]
    pub fn cell_coordinates(&self, cell: u32) -> [usize; D] {
        unravel(cell as usize, |axis| self.n_cells[axis])
    }

    /// Index of a node along each axis.
    #[inline(always)]
    pub fn node_coordinates(&self, node: u32) -> [usize; D] {
        unravel(node as usize, |axis| self.n_nodes(axis))
    }

    /// Dense number of the cell at a shift from another, wrapped on periodic axes; `None` outside.
    #[inline(always)]
    pub fn neighbor(&self, cell: [usize; D], shift: [i32; D]) -> Option<usize> {
        let mut index = 0;
        for axis in 0..D {
            let n = self.n_cells[axis] as i64;
            let mut at = cell[axis] as i64 + i64::from(shift[axis]);
            if at < 0 || at >= n {
                if !self.periodic[axis] {
                    return None;
                }
                at = at.rem_euclid(n);
            }
            index = index * n as usize + at as usize;
        }
        Some(index)
    }

    /// Dense numbers of the cells of the box at and around a cell; over a narrow periodic axis one may
    /// come twice.
    #[inline(always)]
    pub fn around(&self, cell: [usize; D]) -> impl Iterator<Item = usize> {
        (0..3_usize.pow(D as u32)).filter_map(move |code| self.neighbor(cell, shift_of(code)))
    }

    /// Whether something holds for all cells of the box at and around a cell, given by dense numbers.
    #[inline(always)]
    pub fn all_around(&self, cell: [usize; D], mut holds: impl FnMut(usize) -> bool) -> bool {
        let is_inside = (0..D).all(|axis| cell[axis] > 0 && cell[axis] + 1 < self.n_cells[axis]);
        if !is_inside {
            return self.around(cell).all(holds);
        }
        // Rows of three cells, without a look at faces.
        let n_rows = 3_usize.pow(D as u32 - 1);
        (0..n_rows).all(|row| {
            let (mut rest, mut start, mut stride) = (row, cell[D - 1] - 1, self.n_cells[D - 1]);
            for axis in (0..D - 1).rev() {
                start += (cell[axis] + rest % 3 - 1) * stride;
                rest /= 3;
                stride *= self.n_cells[axis];
            }
            (start..start + 3).all(&mut holds)
        })
    }

    /// Dense number of the first node that the points of a cell can touch.
    #[inline(always)]
    pub fn first_node(&self, cell: [usize; D]) -> usize {
        let mut index = 0;
        for axis in 0..D {
            index = index * self.n_nodes(axis) + cell[axis];
        }
        index
    }

    /// Where a point of a known cell sits along an axis.
    #[inline(always)]
    pub fn axis_position(
        &self,
        position: [T; D],
        cell: [usize; D],
        axis: usize,
    ) -> AxisPosition<T> {
        AxisPosition {
            cell: cell[axis],
            xi: self.in_cells(position, axis) - T::from_index(cell[axis]),
            n_cells: self.n_cells[axis],
            periodic: self.periodic[axis],
        }
    }
}

/// Shift in cells of one of the 3^D cells at and around another; the middle one is no shift.
#[inline(always)]
pub fn shift_of<const D: usize>(code: usize) -> [i32; D] {
    let mut rest = code;
    std::array::from_fn(|_| {
        let step = (rest % 3) as i32 - 1;
        rest /= 3;
        step
    })
}

#[inline(always)]
fn unravel<const D: usize>(index: usize, size: impl Fn(usize) -> usize) -> [usize; D] {
    // All numbers are below 2³², and 32-bit division takes half the time.
    let mut rest = index as u32;
    let mut at = [0; D];
    for axis in (1..D).rev() {
        let n = size(axis) as u32;
        at[axis] = (rest % n) as usize;
        rest /= n;
    }
    at[0] = rest as usize;
    at
}

fn check_axis<const D: usize>(
    spec: &GridSpec<D>,
    faces: [Boundary; 2],
    extra: usize,
    axis: usize,
) -> Result<(), InvalidInput> {
    let spacing = spec.spacing[axis];
    if !(spacing.is_finite() && spacing > 0.0) {
        let field = format!("grid.spacing[{axis}]");
        return Err(InvalidInput::new(field, spacing, "a positive length in m"));
    }
    if !spec.origin[axis].is_finite() {
        let field = format!("grid.origin[{axis}]");
        return Err(InvalidInput::new(field, spec.origin[axis], "a finite coordinate in m"));
    }
    let cells = spec.cells[axis];
    if cells == 0 || cells > i32::MAX as usize {
        return Err(InvalidInput::new(format!("grid.cells[{axis}]"), cells, "1 to 2³¹ − 1 cells"));
    }
    if (faces[0] == Boundary::Periodic) != (faces[1] == Boundary::Periodic) {
        let field = format!("boundaries[{axis}]");
        return Err(InvalidInput::new(
            field,
            format!("{faces:?}"),
            "periodic on both faces or on none",
        ));
    }
    if faces[0] == Boundary::Periodic && cells < extra.max(2) {
        let allowed = format!("at least {} cells on a periodic axis", extra.max(2));
        return Err(InvalidInput::new(format!("grid.cells[{axis}]"), cells, allowed));
    }
    for face in faces {
        if let Boundary::Velocity(v) = face
            && v.iter().any(|c| !c.is_finite())
        {
            let field = format!("boundaries[{axis}]");
            return Err(InvalidInput::new(field, format!("{v:?}"), "finite velocities in m/s"));
        }
        if let Boundary::Outflow { relaxation: Some(relaxation) } = face {
            let Relaxation { pressure, velocity, time, layers } = relaxation;
            let finite = pressure.is_finite() && velocity.unwrap_or(0.0).is_finite();
            if !(finite && time.is_finite() && time > 0.0 && layers > 0) {
                let field = format!("boundaries[{axis}].relaxation");
                let allowed = "finite numbers, a positive time in s, and at least 1 layer";
                return Err(InvalidInput::new(field, format!("{relaxation:?}"), allowed));
            }
        }
    }
    Ok(())
}
