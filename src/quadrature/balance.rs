//! Samples of cut cells that hold up a column at rest.

use super::surface::WetPart;
use super::{Quadrature, Samples};
use crate::Scalar;
use crate::cells::CellKind;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::fold_blocks;
use crate::rearrangement::fields_at;
use crate::step::{CELL_GRAIN, Center, StateOf, View};
use crate::telemetry::Counters;

/// Least distance of a balanced sample from a face, cells. The row stiffness of linear hats is 16/3 there and 4 in the
/// middle, so that the stable time step keeps at least √3/2 of that of full cells.
const MARGIN: f64 = 0.25;

impl<T: Scalar, const D: usize> WetPart<T, D> {
    /// Place of the balanced sample, cells from the lower corner: the centroid, but a quarter of a cell from all faces.
    pub fn balanced(&self) -> [T; D] {
        let (least, most) = (T::lit(MARGIN), T::one() - T::lit(MARGIN));
        self.whole_centroid().map(|along| along.max(least).min(most))
    }

    /// Where the pressure of the balanced sample is taken: opposite to it about the centroid.
    fn opposite(&self) -> [T; D] {
        let (centroid, site) = (self.whole_centroid(), self.balanced());
        std::array::from_fn(|axis| centroid[axis] + centroid[axis] - site[axis])
    }
}

/// Gives the balanced samples their pressure, that of the fit at a place of the wet part.
///
/// In a cell of size h that is wet up to f h, fluid of the volume V with its sample at ξ h gives the upper node the weight
/// V ρ g ξ and the force V p/h. In a column at rest they are equal for the pressure at the depth ξ h, which is
/// that at the centroid where ξ = f/2, and else that at the place opposite to the sample. The mean of the cell's points,
/// which is what other rules take, is off by up to a quarter of ρ g h, more or less as points cross faces.
pub(crate) fn balance<T, const D: usize, M, K>(
    view: &View<'_, T, D, M, K>,
    volumes: &[T],
    centers: &mut [Center<T, StateOf<T, D, K>>],
) -> Counters
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let (grid, cells) = (view.grid, view.cells);
    let reconstruction = view.method.reconstruction();
    let work = |slots: std::ops::Range<usize>, part: &mut [Center<T, StateOf<T, D, K>>]| {
        let mut counters = Counters::default();
        for (slot, center) in slots.zip(part) {
            let Some(wet) = WetPart::of(grid, cells, slot, |slot| volumes[slot]) else { continue };
            let cell = grid.cell_coordinates(cells.index[slot]);
            let inside = wet.opposite();
            let target = std::array::from_fn(|axis| T::from_index(cell[axis]) + inside[axis]);
            if let Some(fields) = fields_at(view, &reconstruction, target, &mut counters) {
                center.pressure = view.physics.pressure(fields.density, &center.state);
            }
        }
        counters
    };
    fold_blocks(centers.len(), CELL_GRAIN, centers, &|slot| slot, &work, &Counters::sum)
}

/// Whether a method samples its cut cells so.
pub(crate) fn balances<T: Scalar, const D: usize, M: Method<T, D>>(method: &M) -> bool {
    method.quadrature().samples(CellKind::Boundary) == Samples::Balanced
}
