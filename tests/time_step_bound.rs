//! The acoustic limit bounds the highest frequency of any cloud of points, and is nearly reached.

use nalgebra::DMatrix;
use proptest::prelude::*;
use transpoint::shape::{
    AxisPosition, CubicBspline, Gimp, Linear, QuadraticBspline, ShapeFunction,
};
use transpoint::time_step::{acoustic_cell, acoustic_point};

const N_CELLS: usize = 4;
const SPACING: f64 = 0.5;
const SOUND_SPEED: f64 = 3.0;

/// 2/ω of the stiffest mode, and the smallest limit over the points; unit density, 1D.
fn sharp_and_bound<S: ShapeFunction<f64>>(shape: S, points: &[(f64, f64)]) -> (f64, f64) {
    let n_nodes = N_CELLS + S::EXTRA;
    let mut stiffness = DMatrix::<f64>::zeros(n_nodes, n_nodes);
    let mut masses = vec![0.0; n_nodes];
    let mut bound = f64::INFINITY;
    for &(position, volume) in points {
        let cell = (position as usize).min(N_CELLS - 1);
        let xi = position - cell as f64;
        let row = shape.row(AxisPosition { cell, xi, n_cells: N_CELLS, periodic: false });
        bound = bound.min(acoustic_point(&[row], [SPACING], SOUND_SPEED, S::WIDTH));
        for (i, k) in (0..S::WIDTH).map(|k| (cell + row.first + k, k)) {
            masses[i] += volume * row.weight[k];
            for (j, l) in (0..S::WIDTH).map(|l| (cell + row.first + l, l)) {
                stiffness[(i, j)] += volume * row.gradient[k] * row.gradient[l];
            }
        }
    }
    let scale = |i: usize| if masses[i] > 0.0 { 1.0 / masses[i].sqrt() } else { 0.0 };
    let scaled = DMatrix::from_fn(n_nodes, n_nodes, |i, j| scale(i) * scale(j) * stiffness[(i, j)]);
    let largest = scaled.symmetric_eigenvalues().max().sqrt() * SOUND_SPEED / SPACING;
    (2.0 / largest, bound)
}

fn cloud() -> impl Strategy<Value = Vec<(f64, f64)>> {
    prop::collection::vec((0.0..N_CELLS as f64, 0.1..1.0), 1..20)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_mode_is_stiffer_than_the_stiffest_point(cloud in cloud(), length in 0.1..=1.0) {
        for (sharp, bound) in [
            sharp_and_bound(Linear, &cloud),
            sharp_and_bound(Gimp { length }, &cloud),
            sharp_and_bound(QuadraticBspline, &cloud),
            sharp_and_bound(CubicBspline, &cloud),
        ] {
            prop_assert!(bound <= sharp * (1.0 + 1e-9), "{bound} > {sharp}");
        }
    }
}

#[test]
fn one_point_reaches_its_own_bound() {
    for position in [1.2, 1.5, 1.7] {
        let (sharp, bound) = sharp_and_bound(QuadraticBspline, &[(position, 1.0)]);
        assert!((bound / sharp - 1.0).abs() < 1e-12, "{bound} is not {sharp}");
    }
}

#[test]
fn centered_points_of_the_linear_hat_reach_the_cell_limit() {
    let centers: Vec<_> = (0..N_CELLS).map(|cell| (cell as f64 + 0.5, 1.0)).collect();
    let (sharp, bound) = sharp_and_bound(Linear, &centers);
    let cell = acoustic_cell([SPACING], SOUND_SPEED);
    assert!((bound / cell - 1.0).abs() < 1e-12 && (sharp / cell - 1.0).abs() < 1e-12);
}
