//! Mixed quadrature: Gauss points in internal cells, the points themselves in boundary cells.

use super::{PointVolumes, Quadrature, Samples};
use crate::Scalar;
use crate::cells::CellKind;
use crate::reconstruction::{Cloud, Neighborhood};
use crate::variants::{BoundaryCriterion, PointVolume};

/// Gauss quadrature in internal cells and point quadrature in boundary cells,
/// Eqs. (25)-(27) of \[Song2020\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixed {
    /// Volume of the points of boundary cells.
    pub point_volume: PointVolume,
    /// What a boundary cell is.
    pub criterion: BoundaryCriterion,
}

impl Mixed {
    /// A boundary cell is one with an empty neighbour.
    pub const fn new(point_volume: PointVolume) -> Self {
        Self { point_volume, criterion: BoundaryCriterion::EmptyNeighbor }
    }
}

impl<T: Scalar, const D: usize> Quadrature<T, D> for Mixed {
    const USES_CENTERS: bool = true;
    const CLASSIFIES: bool = true;

    #[inline(always)]
    fn samples(&self, kind: CellKind) -> Samples {
        match kind {
            CellKind::Internal => Samples::Center,
            CellKind::Boundary => match self.point_volume {
                PointVolume::CellCenter => Samples::Part,
                PointVolume::Plane => Samples::Wetted,
                PointVolume::Balanced => Samples::Balanced,
                PointVolume::Sphere | PointVolume::CarriedCapped | PointVolume::VolumeFraction => {
                    Samples::Points
                }
            },
        }
    }

    fn least_share(&self) -> Option<T> {
        match self.criterion {
            BoundaryCriterion::EmptyNeighbor => None,
            BoundaryCriterion::VolumeShare(share) => Some(T::lit(share)),
        }
    }

    fn point_volumes<'a>(&self, cloud: &'a Cloud<'a, T, D>, slot: usize) -> PointVolumes<'a, T, D> {
        let points = cloud.cells.points(slot);
        let cell_volume = cloud.grid.cell_volume();
        match self.point_volume {
            PointVolume::Sphere => {
                let cell = cloud.grid.cell_coordinates(cloud.cells.index[slot]);
                PointVolumes::Sphere(cloud, cell)
            }
            PointVolume::CarriedCapped => {
                PointVolumes::Capped(cell_volume / T::from_index(points.len()))
            }
            // A cell may hold the fluid of its empty neighbour: a cap would lose its weight.
            PointVolume::CellCenter | PointVolume::Plane | PointVolume::Balanced => {
                PointVolumes::Scaled(T::one())
            }
            PointVolume::VolumeFraction => {
                let carried =
                    points.fold(T::zero(), |sum, p| sum + cloud.mass[p] / cloud.density[p]);
                PointVolumes::Scaled((cell_volume / carried).min(T::one()))
            }
        }
    }
}

/// Volume of the circle (2D), sphere (3D) or interval (1D) around a point that touches the one
/// around its nearest neighbour, Eqs. (26)-(27) of \[Song2020\].
///
/// The search ends at the neighbouring cells; a point alone there gets the radius of half a cell.
pub(super) fn sphere_volume<T: Scalar, const D: usize>(
    cloud: &Cloud<'_, T, D>,
    cell: [usize; D],
    point: usize,
) -> T {
    let spacing = cloud.grid.spacing;
    let widest = spacing.iter().fold(spacing[0], |least, &h| least.min(h));
    let position = cloud.position[point];
    let target = std::array::from_fn(|axis| cloud.grid.in_cells(position, axis));
    let neighborhood = Neighborhood::of_cells_around(cloud.grid, cell);
    let mut nearest = widest * widest;
    cloud.visit(neighborhood, target, |other, offset| {
        if other != point {
            let mut distance = T::zero();
            for axis in 0..D {
                let along = offset[axis] * spacing[axis];
                distance += along * along;
            }
            nearest = nearest.min(distance);
        }
    });
    let diameter = nearest.sqrt();
    match D {
        1 => diameter,
        2 => T::frac_pi_4() * diameter * diameter,
        _ => T::frac_pi_6() * diameter * diameter * diameter,
    }
}
