//! Where pressure and divergence live: at the points, or one value per cell.

use serde::{Deserialize, Serialize};

use crate::Scalar;

/// How pressure acts on the nodes and how a point's density changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Pressure at the quadrature samples; divergence from ∇N at the point.
    Standard,
    /// Velocity-pressure: one pressure and one divergence per cell, the force being the adjoint of the
    /// divergence, f_I = Σ_c V_c p_c ∇N_I(x_c) and D_c = Σ_I v_I · ∇N_I(x_c). Derived here; the formulas of
    /// \[Chen2018\] were not at hand.
    VelocityPressure(PointDivergence),
}

/// Divergence at a point in the velocity-pressure formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointDivergence {
    /// That of the point's cell.
    Constant,
    /// Multilinear between cell centres.
    Linear,
    /// Quadratic B-spline about cell centres.
    Quadratic,
    /// Mean of the cells at each vertex, then multilinear between vertices.
    VertexMean,
}

impl PointDivergence {
    /// Weights of the cell before, the cell itself and the cell after, along one axis, at `xi` cells
    /// from the cell's lower face. Each kind has Σ w = 1 and, but for `Constant`, Σ w x_c = x.
    ///
    /// Beyond a wall stands the cell before the wall; in place of an empty cell the point's own cell.
    #[inline(always)]
    pub fn weights<T: Scalar>(self, xi: T) -> [T; 3] {
        let (zero, one, half) = (T::zero(), T::one(), T::lit(0.5));
        let eta = one - xi;
        match self {
            Self::Constant => [zero, one, zero],
            Self::Linear => {
                let (before, after) = ((half - xi).max(zero), (xi - half).max(zero));
                [before, one - before - after, after]
            }
            Self::Quadratic => [half * eta * eta, half + xi * eta, half * xi * xi],
            Self::VertexMean => [half * eta, half, half * xi],
        }
    }
}

/// Sum of the values of the 3^D cells around one, the first axis counting fastest, with a weight of each axis.
#[inline(always)]
pub(crate) fn weighted<T: Scalar, const D: usize>(weights: [[T; 3]; D], around: &[T; 27]) -> T {
    let mut sum = T::zero();
    for (code, value) in around.iter().enumerate().take(3_usize.pow(D as u32)) {
        let (mut rest, mut weight) = (code, T::one());
        for row in weights {
            weight *= row[rest % 3];
            rest /= 3;
        }
        sum += weight * *value;
    }
    sum
}
