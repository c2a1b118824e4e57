//! Quadrature: at which samples mass and force are integrated, and with which volumes.

mod balance;
mod gauss;
mod mixed;
mod particle;
mod plane;
mod surface;
mod whole_cells;

pub(crate) use balance::{balance, balances};
pub use gauss::Gauss;
pub use mixed::Mixed;
pub use particle::Particle;
pub use plane::{Plane, Wetted, normal};
pub use surface::{boxed_volume, classify, classify_by_volume, mark_near_surface, wetted_sites};
pub use whole_cells::WholeCells;

use crate::Scalar;
use crate::cells::CellKind;
use crate::reconstruction::Cloud;

/// Where the integrals over a cell are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Samples {
    /// At the points that the cell holds, each with its volume.
    Points,
    /// At the centre, with the volume of the whole cell and reconstructed fields.
    Center,
    /// At the centre, with the volume of the fluid in the cell and the means of its points.
    Part,
    /// As [`Self::Part`], at the centroid of the part of the cell that a plane cuts off.
    Wetted,
    /// As [`Self::Part`], near that centroid, with the pressure that holds up a column at rest.
    Balanced,
}

/// A rule for the integrals over the fluid.
///
/// ```
/// use transpoint::cells::CellKind;
/// use transpoint::quadrature::{Mixed, Quadrature, Samples};
/// use transpoint::variants::PointVolume;
/// let rule = Mixed::new(PointVolume::Sphere);
/// let samples = Quadrature::<f64, 2>::samples(&rule, CellKind::Internal);
/// assert_eq!(samples, Samples::Center);
/// ```
pub trait Quadrature<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Whether any cell is sampled at its centre.
    const USES_CENTERS: bool;
    /// Whether cells have to be told apart as internal or boundary.
    const CLASSIFIES: bool;

    /// Where a cell of this kind is sampled.
    fn samples(&self, kind: CellKind) -> Samples;

    /// Share β of a cell's volume that its points must fill for the cell to count as internal; `None`:
    /// a cell is internal unless it has an empty neighbour.
    fn least_share(&self) -> Option<T> {
        None
    }

    /// Volumes of the points of an active cell that is sampled at its points.
    fn point_volumes<'a>(&self, cloud: &'a Cloud<'a, T, D>, slot: usize) -> PointVolumes<'a, T, D>;
}

/// Volumes of the points of one cell.
#[derive(Clone, Copy, Debug)]
pub enum PointVolumes<'a, T, const D: usize> {
    /// Carried volume m/ρ times a factor common to the cell.
    Scaled(T),
    /// Carried volume, at most this.
    Capped(T),
    /// Circle or sphere of half the distance to the nearest point.
    Sphere(&'a Cloud<'a, T, D>, [usize; D]),
}

impl<T: Scalar, const D: usize> PointVolumes<'_, T, D> {
    /// Volume (m³) and mass (kg) that a point of carried mass and density stands for.
    #[inline(always)]
    pub fn of(&self, point: usize, mass: T, density: T) -> (T, T) {
        match *self {
            Self::Scaled(factor) => (factor * mass / density, factor * mass),
            Self::Capped(most) => {
                let volume = mass / density;
                if volume <= most { (volume, mass) } else { (most, most * density) }
            }
            Self::Sphere(cloud, cell) => {
                let volume = mixed::sphere_volume(cloud, cell, point);
                (volume, volume * density)
            }
        }
    }
}
