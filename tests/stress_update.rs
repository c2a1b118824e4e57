//! When density is updated (first, last, modified last), with numbers worked out by hand.

use crate::common::checks::point_divergence_is_linear;
use crate::common::near;
use crate::common::parts::{FLIP, MIXED, mls};
use crate::common::phases::{STATE, gather, scheme, solver};
use crate::common::scenes::{Block, DENSITY};
use transpoint::error::StepError;
use transpoint::formulation::{Formulation, PointDivergence};
use transpoint::method::{Method, Scheme};
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec, Scene};
use transpoint::shape::Linear;
use transpoint::variants::StressUpdate;
use transpoint::{Observation, Simulation};

const EVERY: [StressUpdate; 3] =
    [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast];

/// One point in the middle of a cell of 1 m beside a wall, moving away from it.
///
/// ρ = 4, ρ₀ = 2, c₀ = 1: p = 2 Pa in ½ m; the free node holds half of the mass of 2 kg.
fn scene(velocity: f64) -> Scene<1> {
    Scene::new(
        GridSpec { origin: [0.0], spacing: [1.0], cells: [3] },
        [[Boundary::Slip; 2]],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 2.0, sound_speed: 1.0 },
        vec![PointSpec::new([0.5], [velocity], 4.0, 2.0)],
    )
}

/// Position, velocity and density after one step of ¼ s.
fn step(stress_update: StressUpdate, formulation: Formulation) -> [f64; 3] {
    let method = Scheme { stress_update, formulation, ..scheme(Linear, Carried, Particle, FLIP) };
    let mut solver = solver::<f64, 1, _>(&scene(1.0), method);
    solver.advance(0.25).unwrap();
    let p = &solver.particles;
    [p.position[0][0], p.velocity[0][0], p.density[0]]
}

/// The wall holds its node at rest, so the cell's divergence is the free node's velocity per metre:
/// 1 before the force, 1 + ¼ f/m = 5/4 after it with f = V p = 1 N, 9/8 from the advanced point.
#[test]
fn each_order_strains_with_its_own_velocity() {
    for formulation in
        [Formulation::Standard, Formulation::VelocityPressure(PointDivergence::Constant)]
    {
        let last = step(StressUpdate::Last, formulation);
        assert_eq!(last, [0.5 + 0.25 * 0.5 * 1.25, 1.125, 4.0 / (1.0 + 0.25 * 1.25)]);
        let modified = step(StressUpdate::ModifiedLast, formulation);
        assert_eq!(modified, [last[0], last[1], 4.0 / (1.0 + 0.25 * 1.125)]);
        // The new density 3.2 pushes with 1.2 Pa in 0.625 m: f = ¾ N.
        let first = step(StressUpdate::First, formulation);
        for (found, exact) in first.into_iter().zip([0.5 + 0.125 * 1.1875, 1.0 + 0.5 * 0.1875, 3.2])
        {
            near("first", found, exact, 4.0 * f64::EPSILON).unwrap();
        }
    }
}

/// First: ρ = 4/(1 − 5/4) before anything moves.
#[test]
fn a_density_that_is_not_positive_ends_the_run() {
    let method =
        Scheme { stress_update: StressUpdate::First, ..scheme(Linear, Carried, Particle, FLIP) };
    let mut solver = solver::<f64, 1, _>(&scene(-5.0), method);
    let error = solver.advance(0.25).unwrap_err();
    assert_eq!(error, StepError::NotPositive { id: 0, density: -16.0, time: 0.0 });
}

fn observe(method: impl Method<f64, 2>, (steps, dt): (usize, f64)) -> Observation<2> {
    let block = Block { compression: [1e-3, 0.0], ..Block::full(5, Boundary::Slip).random(3) };
    let mut solver = solver::<f64, 2, _>(&block.scene(), method);
    for _ in 0..steps {
        solver.advance(dt).unwrap();
    }
    solver.observe()
}

/// The three orders differ by O(Δt) after a fixed time: halving the step halves the difference.
#[test]
fn orders_agree_as_the_step_vanishes() {
    let difference = |stress_update, halvings: u32| {
        let method = |stress_update| Scheme { stress_update, ..scheme(Linear, mls(), MIXED, FLIP) };
        let steps = (4 << halvings, 2e-4 / f64::from(1 << halvings));
        let last = observe(method(StressUpdate::Last), steps);
        let other = observe(method(stress_update), steps);
        let pairs = last.points.iter().zip(&other.points);
        pairs.map(|(p, q)| (p.density - q.density).powi(2)).sum::<f64>().sqrt()
    };
    for stress_update in [StressUpdate::First, StressUpdate::ModifiedLast] {
        let order = (difference(stress_update, 2) / difference(stress_update, 3)).log2();
        assert!((order - 1.0).abs() < 0.2, "{stress_update:?}: {order}");
    }
}

/// A uniform density at rest stays so, bit by bit in velocity, whatever the order.
#[test]
fn fluid_at_rest_without_pressure_stays_at_rest() {
    for stress_update in EVERY {
        let method = Scheme { stress_update, ..scheme(Linear, mls(), MIXED, FLIP) };
        let block = Block { jitter: 0.4, ..Block::<2>::full(6, Boundary::Slip) };
        let scene = Block { fluid: [[0.0, 3.5]; 2], ..block }.scene();
        let mut solver = solver::<f64, 2, _>(&scene, method);
        for _ in 0..5 {
            solver.advance(1e-3).unwrap();
        }
        for point in solver.observe().points {
            // The fit of a constant is exact to round-off only, times c₀² in the pressure.
            assert!(point.velocity.iter().all(|v| v.abs() < 1e-12), "{:?}", point.velocity);
            near("density", point.density, DENSITY, 1e-10).unwrap();
        }
    }
}

#[test]
fn interpolated_divergences_reproduce_linear_fields() {
    for kind in [PointDivergence::Linear, PointDivergence::Quadratic, PointDivergence::VertexMean] {
        point_divergence_is_linear(|xi| kind.weights(xi)).unwrap();
    }
    assert!(point_divergence_is_linear(|xi| PointDivergence::Constant.weights(xi)).is_err());
}

/// v = x² on the nodes: the cells' divergence is 2 x_c, that of the points 2 x between centres.
#[test]
fn cell_divergence_is_interpolated_to_the_points() {
    let dt = 0.01;
    for (kind, exact) in [
        (PointDivergence::Linear, true),
        (PointDivergence::Quadratic, true),
        (PointDivergence::VertexMean, true),
        (PointDivergence::Constant, false),
    ] {
        let method = Scheme {
            formulation: Formulation::VelocityPressure(kind),
            ..scheme(Linear, Carried, Particle, FLIP)
        };
        let mut block = Block::<1>::full(6, Boundary::Slip);
        (block.jitter, block.per_axis) = (0.4, 3);
        let mut solver = solver::<f64, 1, _>(&block.scene(), method);
        let spacing = solver.grid.spacing[0];
        let at = |node: u32| (f64::from(node) * spacing).powi(2);
        for (slot, &node) in solver.nodes.index.iter().enumerate() {
            solver.nodes.velocity[slot] = [at(node), 0.0, 0.0, at(node)];
        }
        gather(&mut solver, STATE, dt).unwrap();
        for (position, &density) in solver.particles.position.iter().zip(&solver.particles.density)
        {
            let cell = (position[0] / spacing).floor();
            if cell == 0.0 || cell == 5.0 {
                // Beyond the wall stands the wall cell itself.
                continue;
            }
            let x = if exact { position[0] } else { (cell + 0.5) * spacing };
            near("ρ", density, DENSITY / (1.0 + dt * 2.0 * x), 1e-12).unwrap();
        }
    }
}
