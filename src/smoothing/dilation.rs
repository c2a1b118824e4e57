//! Divergence of the points, averaged over the nodes: a cure for volumetric locking.

use crate::Scalar;
use crate::material::Material;
use crate::method::Method;
use crate::parallel::for_each_block;
use crate::particles::POINT_GRAIN;
use crate::solver::Solver;
use crate::step::{divergence_at_points, interpolate};

impl<T, const D: usize, M, K> Solver<T, D, M, K>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    /// Averages the divergence of the points after the F-bar of \[Zhao2023\], who average the volume change
    /// since the start; here its rate, weighted by mass:
    ///
    /// ```text
    /// D̄_p = f Σ_I N_I D_I + (1 − f) D_p,   D_I = Σ_p N m_p D_p / Σ_p N m_p
    /// ```
    ///
    /// with the divergence D_p of the points, 1/s, and the share f of the setting `dilation`.
    pub(crate) fn average_dilation(&mut self) {
        let Some(mut kept) = self.smoother.take() else { return };
        if let Some(share) = kept.dilation {
            let n = self.particles.len();
            kept.divergence.resize(n, T::zero());
            super::resize_points(&mut kept.at_points, n);
            let Self { method, grid, cells, nodes, particles, .. } = &*self;
            let shape = method.shape();
            let space = (grid, cells, &shape);
            let points = (particles.position.as_slice(), particles.length.as_slice());
            let velocity = if self.strain_is_rebuilt { &nodes.rebuilt } else { &nodes.velocity };
            divergence_at_points(space, (&nodes.rows, velocity), points, &mut kept.divergence);
            for (field, &divergence) in kept.at_points.iter_mut().zip(&kept.divergence) {
                *field = [T::zero(); D];
                field[0] = divergence;
            }
            self.transfer_field(&mut kept.at_points, &mut kept.no_affine, &mut kept.at_nodes);
            let Self { method, grid, cells, nodes, particles, .. } = &*self;
            let shape = method.shape();
            let points = (particles.position.as_slice(), particles.length.as_slice());
            let nodes = (nodes.rows.as_slice(), kept.at_nodes.as_slice());
            interpolate((grid, cells, &shape), nodes, points, &mut kept.at_points);
            let smooth = &kept.at_points;
            let own = T::one() - share;
            for_each_block(
                n,
                POINT_GRAIN,
                kept.divergence.as_mut_slice(),
                &|range, part: &mut [T]| {
                    for (divergence, smooth) in part.iter_mut().zip(&smooth[range]) {
                        *divergence = share * smooth[0] + own * *divergence;
                    }
                },
            );
        }
        self.smoother = Some(kept);
    }
}
