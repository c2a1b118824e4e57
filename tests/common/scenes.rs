//! Blocks of points in a box.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec, Scene};
use transpoint::{Settings, Simulation, Variant};

use super::Random;

/// ρ₀, kg/m³.
pub const DENSITY: f64 = 1000.0;
/// c₀, m/s.
pub const SOUND_SPEED: f64 = 10.0;
/// Cell sizes by axis, m: all different, none a power of two.
pub const SPACING: [f64; 3] = [0.1, 0.12, 0.09];

/// A block of points, a jittered lattice, in a box of cells.
#[derive(Clone, Debug)]
pub struct Block<const D: usize> {
    /// Cells of the box.
    pub cells: [usize; D],
    /// Where the fluid is along each axis, cells.
    pub fluid: [[f64; 2]; D],
    /// Points per cell along each axis.
    pub per_axis: usize,
    /// Displacement of the points, ± this share of the point spacing.
    pub jitter: f64,
    /// Random velocities and affine fields, up to this, m/s (and this per cell).
    pub speed: f64,
    /// Mean and random part of the relative compression ρ/ρ₀ − 1.
    pub compression: [f64; 2],
    /// All faces.
    pub faces: Boundary,
    /// Seed of all that is random.
    pub seed: u64,
}

impl<const D: usize> Block<D> {
    /// A box full of a regular lattice at rest, two points per cell and axis.
    pub fn full(cells: usize, faces: Boundary) -> Self {
        Self {
            cells: [cells; D],
            fluid: [[0.0, cells as f64]; D],
            per_axis: 2,
            jitter: 0.0,
            speed: 0.0,
            compression: [0.0; 2],
            faces,
            seed: 1,
        }
    }

    /// The same with disorder and random velocities and densities.
    #[must_use]
    pub fn random(mut self, seed: u64) -> Self {
        (self.seed, self.jitter, self.speed) = (seed, 0.45, 1.0);
        self.compression = [0.0, 1e-3];
        self
    }

    /// The scene of the block.
    pub fn scene(&self) -> Scene<D> {
        let spacing = std::array::from_fn(|axis| SPACING[axis]);
        let grid = GridSpec { origin: [0.0; D], spacing, cells: self.cells };
        Scene::new(
            grid,
            [[self.faces; 2]; D],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            self.points(spacing),
        )
    }

    fn points(&self, spacing: [f64; D]) -> Vec<PointSpec<D>> {
        let mut random = Random(self.seed);
        let per_cell = self.per_axis as f64;
        let counts = self.fluid.map(|[a, b]| ((b - a) * per_cell).round() as usize);
        let volume = spacing.iter().product::<f64>() / per_cell.powi(D as i32);
        let point = |index: usize| {
            let mut rest = index;
            let mut position = [0.0; D];
            for axis in (0..D).rev() {
                let at = (rest % counts[axis]) as f64 + 0.5 + self.jitter * random.signed();
                rest /= counts[axis];
                position[axis] = (self.fluid[axis][0] + at / per_cell) * spacing[axis];
            }
            let velocity = std::array::from_fn(|_| self.speed * random.signed());
            let compression = self.compression[0] + self.compression[1] * random.signed();
            let density = DENSITY * (1.0 + compression);
            let velocity_gradient = std::array::from_fn(|_| {
                std::array::from_fn(|axis| self.speed * random.signed() / spacing[axis])
            });
            let point = PointSpec::new(position, velocity, density, density * volume);
            PointSpec { velocity_gradient, ..point }
        };
        (0..counts.iter().product()).map(point).collect()
    }
}

/// A scene of one dimension or another, for [`Variant`].
pub trait Build<const D: usize> {
    /// Builds a variant on the scene.
    fn build(&self, variant: Variant, settings: &Settings) -> Box<dyn Simulation<D>>;
}

impl Build<1> for Scene<1> {
    fn build(&self, variant: Variant, settings: &Settings) -> Box<dyn Simulation<1>> {
        variant.build_1d(self, settings).unwrap()
    }
}

impl Build<2> for Scene<2> {
    fn build(&self, variant: Variant, settings: &Settings) -> Box<dyn Simulation<2>> {
        variant.build_2d(self, settings).unwrap()
    }
}

impl Build<3> for Scene<3> {
    fn build(&self, variant: Variant, settings: &Settings) -> Box<dyn Simulation<3>> {
        variant.build_3d(self, settings).unwrap()
    }
}

/// Steps a variant on a scene.
pub fn run<const D: usize>(
    scene: &Scene<D>,
    variant: Variant,
    settings: &Settings,
    (n_steps, dt): (usize, f64),
) -> Box<dyn Simulation<D>>
where
    Scene<D>: Build<D>,
{
    let mut simulation = scene.build(variant, settings);
    for step in 0..n_steps {
        simulation.step(dt).unwrap_or_else(|e| panic!("{} step {step}: {e}", variant.name()));
    }
    simulation
}
