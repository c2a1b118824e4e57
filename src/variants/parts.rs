//! What a variant is put together from, as data: for the list of what is compiled, and for tables.

use serde::Serialize;

use crate::formulation::Formulation;
use crate::settings::Settings;

/// One choice of each part, and what the variant fixes of the settings.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    /// Grid shape functions.
    pub kernel: Kernel,
    /// Fields between the points, and the samples of the integrals that go with them.
    pub fields: Fields,
    /// Velocity between points and nodes.
    pub transfer: TransferKind,
    /// Where pressure and divergence live.
    pub formulation: Formulation,
    /// Settings that belong to the variant; all others are the caller's.
    pub fixes: fn(&mut Settings),
}

/// Grid shape functions of a variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kernel {
    /// [`Linear`](crate::shape::Linear).
    Linear,
    /// [`Gimp`](crate::shape::Gimp) with one length for all particles.
    Gimp,
    /// [`QuadraticBspline`](crate::shape::QuadraticBspline).
    QuadraticBspline,
    /// [`CubicBspline`](crate::shape::CubicBspline).
    CubicBspline,
    /// [`ConvectedGimp`](crate::shape::ConvectedGimp).
    ConvectedGimp,
    /// [`DualDomain`](crate::shape::DualDomain).
    DualDomain,
    /// [`Staggered`](crate::shape::Staggered).
    Staggered,
    /// [`Corrected`](crate::shape::Corrected).
    Corrected,
    /// [`LeastSquares`](crate::shape::LeastSquares) over quadratic B-splines.
    LeastSquares,
}

impl Kernel {
    /// Functions of one axis that are non-zero at a point.
    pub const fn width(self) -> usize {
        match self {
            Self::Linear => 2,
            Self::Gimp
            | Self::QuadraticBspline
            | Self::ConvectedGimp
            | Self::Staggered
            | Self::Corrected
            | Self::LeastSquares => 3,
            Self::CubicBspline | Self::DualDomain => 4,
        }
    }
}

/// How fields between the points are found, and where the integrals are sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fields {
    /// [`Carried`](crate::reconstruction::Carried) values, sampled at the points.
    Carried,
    /// [`MovingLeastSquares`](crate::reconstruction::MovingLeastSquares), linear basis, sampled at the centers
    /// of full cells and at the points of cut ones.
    TransportPoints,
    /// [`CellLeastSquares`](crate::reconstruction::CellLeastSquares), linear basis, sampled at the centers of all
    /// cells that hold points.
    CellLeastSquares,
    /// [`TaylorLeastSquares`](crate::reconstruction::TaylorLeastSquares), linear basis, momentum and mass
    /// integrated over full cells, forces sampled at their centers and at the points of cut ones.
    TaylorLeastSquares,
}

/// How velocity goes from points to nodes and back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransferKind {
    /// [`Flip`](crate::transfer::Flip), blended with PIC as the settings say.
    Flip,
    /// [`Apic`](crate::transfer::Apic).
    Apic,
    /// [`Tpic`](crate::transfer::Tpic).
    Tpic,
}
