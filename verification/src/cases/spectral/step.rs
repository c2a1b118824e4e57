//! One step of the solver as a map of the points' state, at frozen positions.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::variants::TransferKind;
use transpoint::{InvalidInput, Scene, Settings, Simulation, Variant};

/// What comes of building.
pub(super) type Built<const D: usize> = Result<Box<dyn Simulation<D>>, InvalidInput>;

/// Builds a simulation in a fixed dimension.
pub(in crate::cases) type Build<'a, const D: usize> = &'a dyn Fn(&Scene<D>, &Settings) -> Built<D>;

/// One step of a method on given points, or one period of steps.
pub(in crate::cases) struct Step<'a, const D: usize> {
    pub(in crate::cases) variant: Variant,
    pub(in crate::cases) settings: &'a Settings,
    pub(in crate::cases) build: Build<'a, D>,
    pub(in crate::cases) scene: Scene<D>,
    pub(in crate::cases) dt: f64,
    /// Steps of the map: the period of what is done in every n-th step. From rest, points move by so little in
    /// them that it does not count.
    pub(in crate::cases) period: u32,
}

impl<const D: usize> Step<'_, D> {
    /// Numbers per point: velocity, density and, where there are such, the affine velocity field and the slope of the
    /// density.
    pub(super) fn width(&self) -> usize {
        let (affine, slope) = self.carries();
        D + 1 + if affine { D * D } else { 0 } + if slope { D } else { 0 }
    }

    /// Whether points carry an affine velocity field, and whether a slope of the density.
    fn carries(&self) -> (bool, bool) {
        let affine = self.variant.parts().transfer != TransferKind::Flip;
        (affine, self.variant.settings(self.settings).affine_density)
    }

    /// The state of the scene: rest at the reference density.
    pub(super) fn base(&self) -> Vec<f64> {
        let width = self.width();
        let mut state = vec![0.0; width * self.scene.points.len()];
        state.iter_mut().skip(D).step_by(width).for_each(|density| *density = 1.0);
        state
    }

    /// Writes to `after` the state after one period from `state` at the positions of the scene.
    pub(super) fn advance(&mut self, state: &[f64], after: &mut [f64]) -> Result<(), String> {
        let width = self.width();
        let (affine, slope) = self.carries();
        for (point, values) in self.scene.points.iter_mut().zip(state.chunks(width)) {
            point.velocity.copy_from_slice(&values[..D]);
            point.density = values[D];
            let mut rest = values[D + 1..].chunks(D);
            if affine {
                for (row, values) in point.velocity_gradient.iter_mut().zip(rest.by_ref()) {
                    row.copy_from_slice(values);
                }
            }
            point.density_slope = slope.then(|| {
                let values = rest.next().unwrap_or_default();
                std::array::from_fn(|axis| values[axis])
            });
        }
        let mut simulation =
            (self.build)(&self.scene, self.settings).map_err(|error| error.to_string())?;
        for _ in 0..self.period {
            simulation.step(self.dt).map_err(|error| error.to_string())?;
        }
        let width = self.width();
        simulation.visit_points(&mut |point| {
            let values = &mut after[point.id as usize * width..][..width];
            values[..D].copy_from_slice(&point.velocity);
            values[D] = point.density;
            let mut rest = values[D + 1..].chunks_mut(D);
            if affine {
                for (row, found) in rest.by_ref().zip(point.velocity_gradient) {
                    row.copy_from_slice(&found);
                }
            }
            if slope {
                rest.for_each(|row| row.copy_from_slice(&point.density_slope));
            }
        });
        Ok(())
    }
}

/// A periodic box of `cells` unit cells per axis with 2 points per cell and axis, each displaced
/// by up to `jitter` point spacings along each axis; unit density and speed of sound.
///
/// Layouts with an empty cell are drawn again, so that every cell is full of fluid.
pub(in crate::cases) fn scene<const D: usize>(cells: usize, jitter: f64, seed: u64) -> Scene<D> {
    let mut random = Pcg64::seed_from_u64(seed);
    let positions = loop {
        let positions = positions::<D>(cells, jitter, &mut random);
        if fills_every_cell(cells, &positions) {
            break positions;
        }
    };
    let mass = std::iter::repeat_n(0.5, D).product();
    let point = |position| PointSpec::new(position, [0.0; D], 1.0, mass);
    Scene::new(
        GridSpec { origin: [0.0; D], spacing: [1.0; D], cells: [cells; D] },
        [[Boundary::Periodic; 2]; D],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        positions.into_iter().map(point).collect(),
    )
}

fn positions<const D: usize>(cells: usize, jitter: f64, random: &mut Pcg64) -> Vec<[f64; D]> {
    let per_axis = 2 * cells;
    let mut displacement = || (random.next_u64() >> 11) as f64 * 2f64.powi(-52) - 1.0;
    (0..per_axis.pow(D as u32))
        .map(|flat| {
            let mut rest = flat;
            std::array::from_fn(|_| {
                let index = (rest % per_axis) as f64;
                rest /= per_axis;
                (0.5 * (index + 0.5 + jitter * displacement())).rem_euclid(cells as f64)
            })
        })
        .collect()
}

fn fills_every_cell<const D: usize>(cells: usize, positions: &[[f64; D]]) -> bool {
    let mut filled = vec![false; cells.pow(D as u32)];
    for position in positions {
        let cell = position.iter().fold(0, |cell, &x| cell * cells + (x as usize).min(cells - 1));
        filled[cell] = true;
    }
    filled.into_iter().all(|filled| filled)
}
