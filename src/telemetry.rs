//! Integer counters: what a run did, and how often a fallback or limiter acted.

/// Counts since the start of a run. Work counters grow with every step; events are rare and named.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Steps taken.
    pub n_steps: u64,
    /// Σ over steps of the points.
    pub n_point_updates: u64,
    /// Σ over steps of the cells that hold points.
    pub n_cell_updates: u64,
    /// Σ over steps of the nodes stored.
    pub n_node_updates: u64,
    /// Samples visited by the quadrature.
    pub n_samples: u64,
    /// Moving-least-squares systems solved.
    pub n_reconstructions: u64,
    /// Affine densities of cells: sums over the points of 3^D cells.
    pub n_affine_sums: u64,
    /// Reconstructions that fell back to a constant basis because the moments were singular.
    pub n_singular_fallbacks: u64,
    /// Reconstructions changed by the positivity limiter.
    pub n_positivity_limited: u64,
    /// Reconstructions changed by the limiter of the leverage alone.
    pub n_leverage_limited: u64,
    /// Steps in which the points were sorted again.
    pub n_sorts: u64,
    /// Cells whose pressure slope was reduced by the limiter.
    pub n_pressure_limited: u64,
    /// Σ over steps of the points with a viscous pressure.
    pub n_viscous_pressures: u64,
    /// Points raised to the density of the minimum pressure.
    pub n_pressure_cutoffs: u64,
    /// Points removed through an open face.
    pub n_points_removed: u64,
    /// Points that came in through inlets.
    pub n_points_entered: u64,
    /// Points taken out of the first column of an inlet, where they had come back.
    pub n_points_returned: u64,
    /// Σ over steps of the points relaxed at outflows.
    pub n_points_relaxed: u64,
    /// Steps in which the nodes' velocity was projected.
    pub n_projections: u64,
    /// Σ over steps of the lengths of points that were kept within their bounds.
    pub n_lengths_limited: u64,
    /// Σ over steps of the numerical fractures found where they are filled.
    pub n_fracture_cells: u64,
    /// Points put into numerical fractures.
    pub n_points_filled: u64,
    /// Fractures not filled: no mass left in the budget, or no sound field around.
    pub n_fills_refused: u64,
    /// Cells whose points were replaced by fewer.
    pub n_cells_reduced: u64,
    /// Σ over applications of the points pushed apart.
    pub n_points_shifted: u64,
    /// Points split.
    pub n_points_split: u64,
}

impl Counters {
    /// Entrywise sum.
    #[must_use]
    pub fn sum(self, other: Self) -> Self {
        Self {
            n_steps: self.n_steps + other.n_steps,
            n_point_updates: self.n_point_updates + other.n_point_updates,
            n_cell_updates: self.n_cell_updates + other.n_cell_updates,
            n_node_updates: self.n_node_updates + other.n_node_updates,
            n_samples: self.n_samples + other.n_samples,
            n_reconstructions: self.n_reconstructions + other.n_reconstructions,
            n_affine_sums: self.n_affine_sums + other.n_affine_sums,
            n_singular_fallbacks: self.n_singular_fallbacks + other.n_singular_fallbacks,
            n_positivity_limited: self.n_positivity_limited + other.n_positivity_limited,
            n_leverage_limited: self.n_leverage_limited + other.n_leverage_limited,
            n_sorts: self.n_sorts + other.n_sorts,
            n_pressure_limited: self.n_pressure_limited + other.n_pressure_limited,
            n_viscous_pressures: self.n_viscous_pressures + other.n_viscous_pressures,
            n_pressure_cutoffs: self.n_pressure_cutoffs + other.n_pressure_cutoffs,
            n_points_removed: self.n_points_removed + other.n_points_removed,
            n_points_entered: self.n_points_entered + other.n_points_entered,
            n_points_returned: self.n_points_returned + other.n_points_returned,
            n_points_relaxed: self.n_points_relaxed + other.n_points_relaxed,
            n_projections: self.n_projections + other.n_projections,
            n_lengths_limited: self.n_lengths_limited + other.n_lengths_limited,
            n_fracture_cells: self.n_fracture_cells + other.n_fracture_cells,
            n_points_filled: self.n_points_filled + other.n_points_filled,
            n_fills_refused: self.n_fills_refused + other.n_fills_refused,
            n_cells_reduced: self.n_cells_reduced + other.n_cells_reduced,
            n_points_shifted: self.n_points_shifted + other.n_points_shifted,
            n_points_split: self.n_points_split + other.n_points_split,
        }
    }

    /// Name and value of each counter, in a fixed order.
    pub fn entries(&self) -> [(&'static str, u64); 26] {
        [
            ("n_steps", self.n_steps),
            ("n_point_updates", self.n_point_updates),
            ("n_cell_updates", self.n_cell_updates),
            ("n_node_updates", self.n_node_updates),
            ("n_samples", self.n_samples),
            ("n_reconstructions", self.n_reconstructions),
            ("n_affine_sums", self.n_affine_sums),
            ("n_singular_fallbacks", self.n_singular_fallbacks),
            ("n_positivity_limited", self.n_positivity_limited),
            ("n_leverage_limited", self.n_leverage_limited),
            ("n_sorts", self.n_sorts),
            ("n_pressure_limited", self.n_pressure_limited),
            ("n_viscous_pressures", self.n_viscous_pressures),
            ("n_pressure_cutoffs", self.n_pressure_cutoffs),
            ("n_points_removed", self.n_points_removed),
            ("n_points_entered", self.n_points_entered),
            ("n_points_returned", self.n_points_returned),
            ("n_points_relaxed", self.n_points_relaxed),
            ("n_projections", self.n_projections),
            ("n_lengths_limited", self.n_lengths_limited),
            ("n_fracture_cells", self.n_fracture_cells),
            ("n_points_filled", self.n_points_filled),
            ("n_fills_refused", self.n_fills_refused),
            ("n_cells_reduced", self.n_cells_reduced),
            ("n_points_shifted", self.n_points_shifted),
            ("n_points_split", self.n_points_split),
        ]
    }
}
