//! The plain kernels of the benches compute what the generic solver computes.

use crate::plain::apic_quadratic_2d::Apic2;
use crate::plain::apic_quadratic_3d::Apic3;
use crate::plain::mpm_linear_2d::Mpm2;
use crate::plain::mpm_linear_3d::Mpm3;
use crate::plain::scene::{DT, Layout, REFERENCE_DENSITY, SOUND_SPEED, scene_of_cells};
use crate::plain::tpm_linear::Tpm2;
use crate::plain::{State, Stepper};

/// Largest difference of any field after `steps` steps, relative to the field's scale.
fn difference<const D: usize>(a: &State<D>, b: &State<D>) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
    let vectors = |a: &[[f64; D]], b: &[[f64; D]]| {
        let scale = largest(&mut a.iter().flatten().copied());
        let pairs = a.iter().flatten().zip(b.iter().flatten());
        largest(&mut pairs.map(|(a, b)| a - b)) / scale
    };
    let density = a.density.iter().zip(&b.density).map(|(a, b)| (a - b) / REFERENCE_DENSITY);
    vectors(&a.position, &b.position)
        .max(vectors(&a.velocity, &b.velocity))
        .max(largest(&mut density.into_iter()))
}

fn compare<const D: usize>(mut plain: impl Stepper<D>, mut generic: impl Stepper<D>) {
    for _ in 0..40 {
        plain.step(DT);
        generic.step(DT);
    }
    assert!(plain.n_sorts() > 1, "the scene is meant to need sorting");
    let found = difference(&plain.points(), &generic.points());
    assert!(found < 1e-10, "relative difference {found:e}");
}

#[test]
fn apic_in_2d_equals_the_generic_step() {
    let scene = scene_of_cells([12, 9], Layout::Random);
    compare(Apic2::<f64>::new(&scene), crate::generic::apic::<f64, 2>(&scene));
}

#[test]
fn apic_in_3d_equals_the_generic_step() {
    let scene = scene_of_cells([7, 6, 5], Layout::Random);
    compare(Apic3::<f64>::new(&scene), crate::generic::apic::<f64, 3>(&scene));
}

#[test]
fn mpm_in_2d_equals_the_generic_step() {
    let scene = scene_of_cells([12, 9], Layout::Random);
    compare(Mpm2::<f64>::new(&scene), crate::generic::mpm::<f64, 2>(&scene));
}

#[test]
fn mpm_in_3d_equals_the_generic_step() {
    let scene = scene_of_cells([7, 6, 5], Layout::Random);
    compare(Mpm3::<f64>::new(&scene), crate::generic::mpm::<f64, 3>(&scene));
}

#[test]
fn tpm_in_2d_equals_the_generic_step() {
    let scene = scene_of_cells([12, 9], Layout::Random);
    compare(Tpm2::<f64>::new(&scene), crate::generic::tpm(&scene));
}

/// Σ over the nodes of the first `D` lanes and of lane `mass`.
fn node_totals<const D: usize>(
    rows: impl Iterator<Item = [f64; 4]>,
    mass: usize,
) -> (f64, [f64; D]) {
    rows.fold((0.0, [0.0; D]), |(m, v), row| {
        (m + row[mass], std::array::from_fn(|a| v[a] + row[a]))
    })
}

fn conserved<const D: usize>(points: (f64, [f64; D]), nodes: (f64, [f64; D])) {
    // Velocities reach 0.3 m/s; the impulses that cancel reach Δt p h^(D−1).
    let scale = points.0 * (0.3 + DT * SOUND_SPEED * SOUND_SPEED * 1e-3);
    assert!((nodes.0 / points.0 - 1.0).abs() < 1e-13);
    for a in 0..D {
        assert!((nodes.1[a] - points.1[a]).abs() < 1e-12 * scale);
    }
}

#[test]
fn plain_scatter_conserves_mass_and_momentum() {
    let scene = scene_of_cells([12, 9], Layout::Random);
    let mut apic = Apic2::<f64>::new(&scene);
    apic.step(DT);
    apic.particles_to_grid(DT);
    conserved(apic.points().totals(), node_totals(apic.nodes().iter().copied(), 2));
    let mut mpm = Mpm2::<f64>::new(&scene);
    mpm.particles_to_grid(DT);
    conserved(mpm.points().totals(), node_totals(mpm.nodes().iter().map(|n| n[0]), 2));
    let scene = scene_of_cells([7, 6, 5], Layout::Random);
    let mut apic = Apic3::<f64>::new(&scene);
    apic.step(DT);
    apic.particles_to_grid(DT);
    conserved(apic.points().totals(), node_totals(apic.nodes().iter().copied(), 3));
    let mut mpm = Mpm3::<f64>::new(&scene);
    mpm.particles_to_grid(DT);
    conserved(mpm.points().totals(), node_totals(mpm.nodes().iter().map(|n| n[0]), 3));
}

#[test]
fn plain_kernels_give_the_same_bits_on_two_threads() {
    let scene = scene_of_cells([40, 9], Layout::Random);
    let run = |n_threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build().unwrap();
        pool.install(|| {
            let (mut apic, mut tpm) = (Apic2::<f64>::new(&scene), Tpm2::<f64>::new(&scene));
            for _ in 0..20 {
                apic.step(DT);
                tpm.step(DT);
            }
            (apic.points(), tpm.points())
        })
    };
    assert_eq!(run(1), run(2));
}
