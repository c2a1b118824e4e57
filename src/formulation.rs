//! Where pressure and divergence live: at the points, or one value per cell.

use serde::{Deserialize, Serialize};

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
    /// Multilinear between cell centres; at walls and next to empty cells the weights of the cells
    /// that exist are scaled to one.
    Interpolated,
}
