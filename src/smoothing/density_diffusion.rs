//! Diffusion of the cells' density.

use crate::Scalar;
use crate::cells::CellKind;
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::for_each_block;
use crate::settings::StressUpdate;
use crate::solver::Solver;
use crate::step::{CELL_GRAIN, FieldAt, LocalAcceleration};

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Adds a diffusion of density to the divergence of internal cells, as δ-SPH \[Antuono2010\] does to its points:
    ///
    /// ```text
    /// D_c ← D_c − (δ c / ρ_c) Σ_faces (ρ_n − ρ_c − ρ̄ b · (x_n − x_c)/c²) / h_a
    /// ```
    ///
    /// over the internal neighbours n; the last term takes out the hydrostatic slope, so that a tank at rest stays as it
    /// is (there, differences of renormalized gradients do that). δ is the setting `density_diffusion`, c the speed of sound in the cell.
    pub(crate) fn diffuse_density(&mut self) {
        let Some(mut kept) = self.smoother.take() else { return };
        if let Some(delta) = kept.density_diffusion {
            if self.method.stress_update() == StressUpdate::First {
                // The step's own come later.
                self.rebuild_cells();
            }
            kept.at_cells.resize(self.cells.len(), T::zero());
            let Self { physics, force_field, grid, cells, centers, time, .. } = &*self;
            let law = &physics.equation_of_state;
            for_each_block(
                cells.len(),
                CELL_GRAIN,
                kept.at_cells.as_mut_slice(),
                &|slots, part: &mut [T]| {
                    for (slot, out) in slots.zip(part) {
                        *out = T::zero();
                        if cells.kind[slot] != CellKind::Internal {
                            continue;
                        }
                        let cell = grid.cell_coordinates(cells.index[slot]);
                        let here = &centers[slot];
                        let sound = law.sound_speed(here.density, K::energy(&here.state));
                        let slope_per_density = T::one() / (sound * sound);
                        for axis in 0..D {
                            for side in [-1, 1] {
                                let mut shift = [0; D];
                                shift[axis] = side;
                                let Some(neighbor) = grid.neighbor(cell, shift) else { continue };
                                let other = cells.slot_of[neighbor] as usize;
                                if cells.kind.get(other) != Some(&CellKind::Internal) {
                                    continue;
                                }
                                let there = centers[other].density;
                                let mean = T::lit(0.5) * (here.density + there);
                                let distance = T::lit(f64::from(side)) * grid.spacing[axis];
                                let mut force = physics.body_force[axis];
                                let face = || face_center(grid, cell, axis, side);
                                if let Some(central) = &physics.central_force {
                                    force += central.acceleration(face())[axis];
                                }
                                if let Some(field) = force_field {
                                    let now = FieldAt { field, time: *time };
                                    force += now.acceleration(face())[axis];
                                }
                                let rest = mean * force * distance * slope_per_density;
                                *out += (there - here.density - rest) * grid.inverse_spacing[axis];
                            }
                        }
                        *out *= delta * sound / here.density;
                    }
                },
            );
            let change = &kept.at_cells;
            for (divergence, change) in self.divergence.iter_mut().zip(change) {
                *divergence -= *change;
            }
        }
        self.smoother = Some(kept);
    }
}

/// The center of a face of a cell, m: the upper one along the axis for `side` 1, the lower one for −1.
fn face_center<T: Scalar, const D: usize>(
    grid: &Grid<T, D>,
    cell: [usize; D],
    axis: usize,
    side: i32,
) -> [T; D] {
    std::array::from_fn(|k| {
        let shift = if k == axis { 0.5 * f64::from(1 + side) } else { 0.5 };
        grid.origin[k] + grid.spacing[k] * (T::from_index(cell[k]) + T::lit(shift))
    })
}
