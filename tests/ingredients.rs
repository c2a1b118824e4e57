//! Limiters, bulk viscosity, pressure cut-off and the elastic solid: what each does, and that it
//! counts what it does.

use crate::common::near;
use crate::common::parts::{DT, block};
use crate::common::phases::scheme;
use crate::common::scenes::{Block, DENSITY, SOUND_SPEED, run};
use transpoint::formulation::PointDivergence;
use transpoint::material::{Deviatoric, General};
use transpoint::math::Tensor;
use transpoint::quadrature::Particle;
use transpoint::reconstruction::Carried;
use transpoint::scene::Boundary;
use transpoint::shape::QuadraticBspline;
use transpoint::transfer::Apic;
use transpoint::variants::{BulkViscosity, PressureLimiter};
use transpoint::{Scene, Settings, Solver, Variant};

const LIMITERS: [PressureLimiter; 2] = [PressureLimiter::BarthJespersen, PressureLimiter::PerAxis];

/// Pressure and volume-weighted mean pressure of each cell of 0.1 by 0.12 m.
fn means(points: &[(f64, [f64; 2], f64)]) -> std::collections::BTreeMap<(i64, i64), f64> {
    let mut sums = std::collections::BTreeMap::new();
    for &(pressure, [x, y], volume) in points {
        let cell = ((x / 0.1).floor() as i64, (y / 0.12).floor() as i64);
        let sum: &mut (f64, f64) = sums.entry(cell).or_default();
        *sum = (sum.0 + volume * pressure, sum.1 + volume);
    }
    sums.into_iter().map(|(cell, (work, volume))| (cell, work / volume)).collect()
}

type Sample = (f64, [f64; 2], f64);

/// The points before and after the limiter alone, and the number of cells limited.
fn limited(scene: &Scene<2>, limiter: PressureLimiter) -> (Vec<Sample>, Vec<Sample>, u64) {
    let method = scheme(QuadraticBspline, Carried, Particle, Apic);
    let mut solver =
        Solver::<f64, 2, _, _>::new(scene, method, transpoint::material::Inviscid).unwrap();
    let samples = |solver: &Solver<f64, 2, _, _>| {
        let p = &solver.particles;
        let law = solver.physics.equation_of_state;
        // The volumes at the start weigh both means.
        let volume = scene.points[0].mass / scene.points[0].density;
        (0..p.len()).map(|k| (law.pressure(p.density[k], 0.0), p.position[k], volume)).collect()
    };
    solver.bin_particles();
    let before = samples(&solver);
    solver.pressure_limiter = Some(limiter);
    solver.limit_pressure();
    (before, samples(&solver), solver.counters.n_pressure_limited)
}

/// Equal volumes, pressures as given.
fn with_pressures(mut scene: Scene<2>, pressure: impl Fn([f64; 2]) -> f64) -> Scene<2> {
    let volume = scene.points[0].mass / scene.points[0].density;
    for point in &mut scene.points {
        point.density = DENSITY + pressure(point.position) / (SOUND_SPEED * SOUND_SPEED);
        point.mass = volume * point.density;
    }
    scene
}

#[test]
fn limiters_keep_cell_means_and_make_no_new_extremes() {
    let scene = block::<2>((11, true)).scene();
    let noisy = with_pressures(scene, |[x, y]| 50.0 * (40.0 * x).sin() + 30.0 * (55.0 * y).cos());
    for limiter in LIMITERS {
        let (before, after, count) = limited(&noisy, limiter);
        assert!(count > 0);
        let (means_before, means_after) = (means(&before), means(&after));
        let range = |means: &std::collections::BTreeMap<_, f64>| {
            let values = means.values().copied();
            (values.clone().fold(f64::MAX, f64::min), values.fold(f64::MIN, f64::max))
        };
        let (low, high) = range(&means_before);
        for (cell, mean) in &means_before {
            near("mean", means_after[cell], *mean, 1e-9).unwrap();
        }
        if limiter == PressureLimiter::BarthJespersen {
            assert!(after.iter().all(|&(p, ..)| p >= low - 1e-9 && p <= high + 1e-9));
        }
    }
}

/// A linear pressure stays in cells that have all neighbours: on any points by least squares, on a
/// lattice by differences along the axes.
#[test]
fn limiters_keep_linear_pressure() {
    let linear = |[x, y]: [f64; 2]| 40.0 * x - 70.0 * y;
    let lattice = Block::<2>::full(6, Boundary::Slip);
    let disordered = Block { jitter: 0.45, ..lattice.clone() };
    let inside = |[x, y]: [f64; 2]| (0.1..0.5).contains(&x) && (0.12..0.6).contains(&y);
    for (blocks, limiter, tolerance) in [
        (&lattice, LIMITERS[0], 1e-9),
        (&lattice, LIMITERS[1], 1e-9),
        (&disordered, LIMITERS[0], 1e-9),
    ] {
        let (_, after, _) = limited(&with_pressures(blocks.scene(), linear), limiter);
        for (pressure, position, _) in after.into_iter().filter(|sample| inside(sample.1)) {
            near("pressure", pressure, linear(position), tolerance).unwrap();
        }
    }
}

#[test]
fn limiters_need_the_velocity_pressure_formulation() {
    let scene = block::<2>((1, true)).scene();
    for limiter in LIMITERS {
        let settings = Settings { pressure_limiter: Some(limiter), ..Settings::default() };
        let error = Variant::Mpm.build_2d(&scene, &settings).err().unwrap();
        assert_eq!(error.field, "settings.pressure_limiter");
        let limited = run(&scene, Variant::MpmVp, &settings, (5, DT));
        assert!(limited.counters().n_pressure_limited > 0);
    }
    let free = run(&scene, Variant::MpmVp, &Settings::default(), (5, DT));
    assert_eq!(free.counters().n_pressure_limited, 0);
}

/// A lone affine point of a given velocity gradient after a step of no length.
fn lone(
    gradient: [[f64; 2]; 2],
    material: General<f64>,
    stress: [[f64; 2]; 2],
    dt: f64,
) -> [f64; 5] {
    let mut scene = Block::<2>::full(9, Boundary::Free).scene();
    scene.points.truncate(1);
    scene.points[0].position = [0.43, 0.52];
    scene.points[0].velocity_gradient = gradient;
    let method = scheme(QuadraticBspline, Carried, Particle, Apic);
    let mut solver = Solver::<f64, 2, _, _>::new(&scene, method, material).unwrap();
    solver.particles.state[0].stress = Tensor(stress);
    solver.advance(dt).unwrap();
    let [[a, b], [c, d]] = solver.particles.state[0].stress.0;
    [solver.particles.state[0].viscous_pressure, a, b, c, d]
}

const NOTHING: General<f64> =
    General { deviatoric: None, energy: None, bulk_viscosity: None, cell_size: 0.1 };

#[test]
fn bulk_viscosity_is_that_of_compression() {
    let coefficients = BulkViscosity { linear: 0.3, quadratic: 1.5, expansion: false };
    let both = BulkViscosity { expansion: true, ..coefficients };
    let q = |coefficients, rate| {
        let material = General { bulk_viscosity: Some(coefficients), ..NOTHING };
        lone([[rate, 0.0], [0.0, rate]], material, [[0.0; 2]; 2], 0.0)[0]
    };
    // |D| = 4/s, h = 0.1 m: ρ h |D| (0.3 c + 1.5 h |D|).
    let (linear, quadratic) = (DENSITY * 0.4 * 0.3 * SOUND_SPEED, DENSITY * 0.4 * 1.5 * 0.4);
    near("compression", q(coefficients, -2.0), linear + quadratic, 1e-9).unwrap();
    near("expansion", q(coefficients, 2.0), 0.0, 0.0).unwrap();
    near("expansion with both", q(both, 2.0), -linear, 1e-9).unwrap();
}

/// Small steps turn the stress with the point: s = R s₀ Rᵀ to first order in the angle. The solid that
/// turns is soft, for its stress sets the nodes in motion.
#[test]
fn elastic_stress_turns_and_strains() {
    let material =
        General { deviatoric: Some(Deviatoric::Elastic { shear_modulus: 7e4 }), ..NOTHING };
    let angle = 1e-4;
    let soft = General { deviatoric: Some(Deviatoric::Elastic { shear_modulus: 1.0 }), ..NOTHING };
    let turned = lone([[0.0, -1.0], [1.0, 0.0]], soft, [[50.0, 20.0], [20.0, -50.0]], angle);
    let exact =
        [50.0 - 40.0 * angle, 20.0 + 100.0 * angle, 20.0 + 100.0 * angle, -50.0 + 40.0 * angle];
    for (found, exact) in turned[1..].iter().zip(exact) {
        near("turned", *found, exact, 1e-5).unwrap();
    }
    let strained = lone([[0.3, 0.2], [0.0, -0.1]], material, [[0.0; 2]; 2], 1e-6);
    let scale = 7e4 * 1e-6;
    let third = 2.0 * 0.2 / 3.0;
    let exact = [2.0 * 0.3 - third, 0.2, 0.2, -2.0 * 0.1 - third].map(|e| scale * e);
    for (found, exact) in strained[1..].iter().zip(exact) {
        near("strained", *found, exact, 1e-3 * scale).unwrap();
    }
}

/// A block that flies apart: with the cut-off no pressure is below the minimum, and it is counted.
#[test]
fn minimum_pressure_raises_the_density_with_it() {
    let mut scene = block::<2>((5, false)).scene();
    for point in &mut scene.points {
        point.velocity = [6.0 * (point.position[0] - 0.5), 6.0 * (point.position[1] - 0.5)];
    }
    let lowest = |scene: &Scene<2>| {
        let simulation = run(scene, Variant::Bspline2, &Settings::default(), (6, DT));
        let points = simulation.observe().points;
        let least = points.iter().map(|p| p.pressure).fold(f64::MAX, f64::min);
        (least, simulation.counters().n_pressure_cutoffs)
    };
    let (free, none) = lowest(&scene);
    assert!(free < -1000.0 && none == 0, "{free}");
    scene.minimum_pressure = Some(-500.0);
    let (found, count) = lowest(&scene);
    near("lowest pressure", found, -500.0, 1e-6).unwrap();
    assert!(count > 100, "{count}");
    scene.minimum_pressure = Some(-1e6);
    assert_eq!(
        Variant::Mpm.build_2d(&scene, &Settings::default()).err().unwrap().field,
        "minimum_pressure"
    );
}

/// In a block at rest nothing is viscous; where points move at random about half of them are.
#[test]
fn viscous_pressures_are_counted() {
    let coefficients = BulkViscosity { linear: 0.3, quadratic: 1.5, expansion: false };
    let settings = Settings { bulk_viscosity: Some(coefficients), ..Settings::default() };
    let count = |scene: &Scene<2>, settings: &Settings| {
        run(scene, Variant::Bspline2, settings, (1, DT)).counters().n_viscous_pressures
    };
    let scene = block::<2>((5, true)).scene();
    let n = scene.points.len() as u64;
    let found = count(&scene, &settings);
    assert!((n / 4..3 * n / 4).contains(&found), "{found} of {n}");
    assert_eq!(count(&scene, &Settings::default()), 0);
    assert_eq!(count(&Block::<2>::full(4, Boundary::Periodic).scene(), &settings), 0);
}

#[test]
fn cell_wise_divergence_is_a_setting() {
    let scene = block::<2>((5, true)).scene();
    let settings = Settings { point_divergence: PointDivergence::Constant, ..Settings::default() };
    let [constant, mean] = [settings, Settings::default()]
        .map(|settings| run(&scene, Variant::TpmVp, &settings, (3, DT)).observe());
    assert_ne!(constant, mean);
}
