//! Internal forces: they cancel, and constant pressure does not push the inside of the fluid.

use crate::common::checks::{interior_force_is, internal_forces_cancel, nodes_hold_the_mass};
use crate::common::parts::{DT, FLIP, GIMP, MIXED, block, cases, mls, setup};
use crate::common::phases::{node_sums, scatter, scheme, solver};
use crate::common::scenes::{Block, DENSITY, SOUND_SPEED, SPACING};
use crate::common::{Check, all, near};
use proptest::prelude::*;
use transpoint::Solver;
use transpoint::formulation::{Formulation, PointDivergence};
use transpoint::material::Deviatoric;
use transpoint::method::{Method, Scheme};
use transpoint::quadrature::{Gauss, Mixed, Particle};
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, Scene};
use transpoint::shape::{CubicBspline, Linear, QuadraticBspline};
use transpoint::variants::PointVolume;

const VP: Formulation = Formulation::VelocityPressure(PointDivergence::Linear);

fn cell_pressure<S, R, Q, X>(scheme: Scheme<S, R, Q, X>) -> Scheme<S, R, Q, X> {
    Scheme { formulation: VP, ..scheme }
}

fn cancel<const D: usize>(scene: &Scene<D>, method: impl Method<f64, D>) -> Check {
    internal_forces_cancel(&mut solver::<f64, D, _>(scene, method), 16.0)
}

proptest! {
    #![proptest_config(cases(8))]

    /// Σ ∇N = 0 at any sample, whatever its volume and stress. Bound in ε of Σ |f|.
    #[test]
    fn internal_forces_sum_to_zero(setup in setup()) {
        let (plane, space) = (block::<2>(setup).scene(), block::<3>(setup).scene());
        let carried_vp = cell_pressure(scheme(Linear, Carried, Particle, FLIP));
        let mixed_vp = cell_pressure(scheme(Linear, mls(), MIXED, FLIP));
        all([
            cancel::<2>(&plane, scheme(GIMP, Carried, Particle, FLIP)),
            cancel::<2>(&plane, scheme(CubicBspline, mls(), Gauss, FLIP)),
            cancel::<2>(&plane, scheme(Linear, mls(), MIXED, FLIP)),
            cancel::<2>(&plane, mixed_vp),
            cancel::<2>(&plane, carried_vp),
            cancel::<3>(&space, scheme(CubicBspline, Carried, Particle, FLIP)),
            cancel::<3>(&space, mixed_vp),
        ]).map_err(TestCaseError::fail)?;
    }

    /// Gauss points alone carry no more than what the reconstruction gives the cells:
    /// Σ m_I = Σ_c ρ_c V_c, and likewise with the points of boundary cells.
    #[test]
    fn node_masses_sum_to_the_cells(setup in setup()) {
        let scene = block::<2>(setup).scene();
        let mass = |density: f64, volume: f64| density * volume;
        macro_rules! check {
            ($quadrature:expr) => {
                let mut solver =
                    solver::<f64, 2, _>(&scene, scheme(Linear, mls(), $quadrature, FLIP));
                scatter(&mut solver, 0.0);
                let cells: f64 = solver.centers.iter().map(|c| mass(c.density, c.volume)).sum();
                let (sum, _) = node_sums(&solver, &solver.nodes.force);
                near("Σ m_I", sum[3], cells, 1e-13 * cells).map_err(TestCaseError::fail)?;
            };
        }
        check!(Gauss);
        check!(MIXED);
    }
}

#[test]
fn viscous_forces_sum_to_zero() {
    let scene = Block { compression: [0.0; 2], ..block::<2>((3, true)) }.scene();
    let method = scheme(QuadraticBspline, Carried, Particle, FLIP);
    let mut solver = Solver::new(&scene, method, Deviatoric::Newtonian { viscosity: 0.1 }).unwrap();
    solver.advance(DT).unwrap();
    internal_forces_cancel(&mut solver, 16.0).unwrap();
}

#[test]
fn particle_quadrature_gives_the_nodes_the_mass_of_the_points() {
    let scene = block::<2>((11, false)).scene();
    nodes_hold_the_mass(&scene, scheme(QuadraticBspline, Carried, Particle, FLIP)).unwrap();
}

/// On a lattice whose cells are full, the capped and the shared volumes are the carried ones.
#[test]
fn mixed_quadrature_gives_the_nodes_the_mass_of_a_lattice_block() {
    let lattice = Block { fluid: [[2.0, 7.0]; 2], ..Block::<2>::full(9, Boundary::Free) };
    for point_volume in [PointVolume::CarriedCapped, PointVolume::VolumeFraction] {
        let method = scheme(Linear, mls(), Mixed::new(point_volume), FLIP);
        nodes_hold_the_mass(&lattice.scene(), method).unwrap();
    }
}

/// A lattice is symmetric about every node, so that Σ ∇N vanishes there with any rule and shape.
#[test]
fn constant_pressure_does_not_push_the_inside_of_a_lattice() {
    let lattice = Block { compression: [0.01, 0.0], ..Block::<2>::full(9, Boundary::Slip) };
    let (scene, bound) = (lattice.scene(), 64.0);
    let space = Block { compression: [0.01, 0.0], ..Block::<3>::full(8, Boundary::Slip) }.scene();
    let still = [0.0; 2];
    all([
        interior_force_is(&scene, scheme(Linear, Carried, Particle, FLIP), still, bound),
        interior_force_is(&scene, scheme(GIMP, Carried, Particle, FLIP), still, bound),
        interior_force_is(&scene, scheme(QuadraticBspline, Carried, Particle, FLIP), still, bound),
        interior_force_is(&scene, scheme(CubicBspline, Carried, Particle, FLIP), still, bound),
        interior_force_is(&space, scheme(CubicBspline, Carried, Particle, FLIP), [0.0; 3], bound),
    ])
    .unwrap();
}

proptest! {
    #![proptest_config(cases(8))]

    /// With disorder it takes one sample per cell, at its centre, of the same volume in every cell:
    /// Gauss and mixed quadrature in full cells, and cell pressures of points if every cell holds
    /// the same volume of points. Bound: ρ/(ρ − ρ₀) = 100 times the round-off of the fit.
    #[test]
    fn constant_pressure_does_not_push_disordered_cells(seed in any::<u64>()) {
        let disorder = Block { compression: [0.01, 0.0], ..Block::<2>::full(9, Boundary::Slip).random(seed) };
        let scene = disorder.scene();
        let (still, bound) = ([0.0; 2], 4000.0);
        let carried_vp = cell_pressure(scheme(Linear, Carried, Particle, FLIP));
        all([
            interior_force_is(&scene, scheme(Linear, mls(), Gauss, FLIP), still, bound),
            interior_force_is(&scene, scheme(CubicBspline, mls(), Gauss, FLIP), still, bound),
            interior_force_is(&scene, scheme(Linear, mls(), MIXED, FLIP), still, bound),
            interior_force_is(&scene, carried_vp, still, bound),
        ]).map_err(TestCaseError::fail)?;
    }

    /// One Gauss point per cell and a linear reconstruction integrate a linear pressure exactly.
    #[test]
    fn linear_pressure_pushes_disordered_cells_exactly(seed in any::<u64>()) {
        let mut scene = Block::<2>::full(9, Boundary::Slip).random(seed).scene();
        let slope = [30.0, -20.0];
        for point in &mut scene.points {
            let x = point.position;
            point.density = 1.1 * DENSITY + slope[0] * x[0] + slope[1] * x[1];
        }
        let volume = SPACING[0] * SPACING[1];
        let force = slope.map(|s| -SOUND_SPEED * SOUND_SPEED * s * volume);
        all([
            interior_force_is(&scene, scheme(Linear, mls(), Gauss, FLIP), force, 256.0),
            interior_force_is(&scene, scheme(QuadraticBspline, mls(), MIXED, FLIP), force, 256.0),
        ]).map_err(TestCaseError::fail)?;
    }
}

/// A disordered point quadrature does push: the counterexample that makes the tests above matter.
#[test]
fn constant_pressure_pushes_disordered_points() {
    let disorder =
        Block { compression: [0.01, 0.0], ..Block::<2>::full(9, Boundary::Slip).random(2) };
    let method = scheme(QuadraticBspline, Carried, Particle, FLIP);
    assert!(interior_force_is(&disorder.scene(), method, [0.0; 2], 1e13).is_err());
}
