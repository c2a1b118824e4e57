//! A disordered block of gas, and the check of its total energy.

use transpoint::material::Material;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{EquationOfStateSpec, Scene};
use transpoint::shape::Linear;
use transpoint::{Simulation, Solver};

use super::parts::{DT, FLIP, block};
use super::phases::scheme;
use super::{Check, near};

/// Specific internal energy with which the gas has about the speed of sound of the other blocks, J/kg.
pub const ENERGY: f64 = 180.0;
/// Ratio of specific heats.
pub const RATIO: f64 = 1.4;

/// A disordered block of gas.
pub fn gas<const D: usize>(at: (u64, bool)) -> Scene<D> {
    let mut scene = block::<D>(at).scene();
    scene.equation_of_state = EquationOfStateSpec::IdealGas { ratio: RATIO };
    scene.energy = true;
    for (k, point) in scene.points.iter_mut().enumerate() {
        point.energy = ENERGY * (1.0 + 0.2 * (0.7 * k as f64).sin());
    }
    scene
}

/// Kinetic and internal energy of a disordered block stay together.
pub fn energy_is_kept<K: Material<f64, 2>>(material: K) -> Check {
    let scene = gas::<2>((7, true));
    let method = scheme(Linear, Carried, Particle, FLIP);
    let mut solver = Solver::new(&scene, method, material).map_err(|e| e.to_string())?;
    let total = |solver: &dyn Simulation<2>| {
        let sum = solver.conserved();
        sum.kinetic_energy + sum.internal_energy
    };
    let start = total(&solver);
    for _ in 0..12 {
        solver.advance(0.2 * DT).map_err(|e| e.to_string())?;
    }
    near("total energy", total(&solver), start, 1e-12 * start)
}
