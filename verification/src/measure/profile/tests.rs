use super::*;
use proptest::prelude::*;

const H: f64 = 0.1;

/// 20 cells from x = 0 to 2, `n_rows` rows of height 0.1.
fn grid(n_rows: usize) -> GridSpec<2> {
    GridSpec { origin: [0.0; 2], spacing: [H; 2], cells: [20, n_rows] }
}

/// One point per cell center, row by row from the right, with the value f(x, row).
fn lattice(n_rows: usize, f: impl Fn(f64, usize) -> f64) -> Profile {
    let (mut positions, mut values) = (Vec::new(), Vec::new());
    for row in 0..n_rows {
        for i in (0..20).rev() {
            let x = H * (f64::from(i) + 0.5);
            positions.push([x, H * (row as f64 + 0.5)]);
            values.push(f(x, row));
        }
    }
    let volumes = vec![H * H; values.len()];
    Profile::new(&grid(n_rows), 0, &positions, &values, &volumes).unwrap()
}

fn step(x: f64) -> f64 {
    if x < 1.0 { 5.0 } else { 1.0 }
}

#[test]
fn errors_are_volume_means() {
    let profile = lattice(3, |x, _| step(x) + if x < 1.0 { 0.3 } else { -0.1 });
    assert!((profile.l1(step) - 0.2).abs() < 1e-14);
    assert!((profile.l2(step) - 0.05f64.sqrt()).abs() < 1e-14);
    assert_eq!(
        (lattice(3, |x, _| step(x)).l1(step), lattice(1, |x, _| step(x)).l2(step)),
        (0.0, 0.0)
    );
    // A point with three times the volume counts three times.
    let positions = [[0.05, 0.05], [0.15, 0.05]];
    let profile = Profile::new(&grid(1), 0, &positions, &[1.0, 5.0], &[3.0, 1.0]).unwrap();
    assert_eq!(profile.l1(|_| 1.0), 1.0);
    assert_eq!(profile.l2(|_| 1.0), 2.0);
}

#[test]
fn column_means_weight_by_volume_and_leave_out_empty_columns() {
    let positions = [[0.32, 0.02], [0.01, 0.01], [0.07, 0.05]];
    let profile =
        Profile::new(&grid(1), 0, &positions, &[7.0, 2.0, 6.0], &[1.0, 3.0, 1.0]).unwrap();
    assert_eq!(profile.columns().len(), 2);
    let [first, second] = [profile.columns()[0], profile.columns()[1]];
    assert!((first.position - 0.025).abs() < 1e-15);
    assert_eq!((first.value, first.volume), (3.0, 4.0));
    assert_eq!((second.position, second.value), (0.32, 7.0));
    let xs: Vec<f64> = profile.points().iter().map(|p| p.position).collect();
    assert_eq!(xs, [0.01, 0.07, 0.32]);
}

#[test]
fn overshoot_and_undershoot_are_shares_of_the_jump() {
    let profile =
        lattice(2, |x, row| step(x) + if row == 1 && (x - 0.95).abs() < 0.01 { 1.0 } else { 0.0 });
    assert_eq!(profile.limits(), [1.0, 6.0]);
    assert_eq!(profile.overshoot(1.0, 5.0), 0.25);
    assert_eq!(profile.undershoot(1.0, 5.0), 0.0);
    assert!((profile.undershoot(1.4, 5.0) - 1.0 / 9.0).abs() < 1e-15);
    assert_eq!(profile.overshoot(1.0, 7.0), 0.0);
    assert_eq!(profile.n_outside(1.0, 5.0, 0.5), 1);
    assert_eq!(profile.n_outside(1.0, 5.0, 1.0), 0);
    assert_eq!(profile.n_outside(2.0, 4.0, 0.0), 40);
}

#[test]
fn a_window_cuts_points_and_columns() {
    let plateau = lattice(2, |x, _| step(x) + 0.01 * x).within(1.2, 1.8);
    assert_eq!(plateau.points().len(), 12);
    assert_eq!(plateau.columns().len(), 6);
    let [low, high] = plateau.limits();
    assert!((low - 1.0125).abs() < 1e-14 && (high - 1.0175).abs() < 1e-14);
}

#[test]
fn total_variation_of_a_step_is_the_jump_for_any_number_of_rows() {
    for n_rows in [1, 2, 5] {
        let profile = lattice(n_rows, |x, _| step(x));
        assert!((profile.total_variation_cells() - 4.0).abs() < 1e-14);
        assert!((profile.total_variation_points() - 4.0).abs() < 1e-14);
    }
}

#[test]
fn total_variation_of_a_zigzag_counts_every_tooth() {
    let zigzag = |x: f64| if ((x / H) as usize).is_multiple_of(2) { 1.0 } else { -1.0 };
    let profile = lattice(3, |x, _| zigzag(x));
    assert!((profile.total_variation_cells() - 38.0).abs() < 1e-13);
    assert!((profile.total_variation_points() - 38.0).abs() < 1e-13);
    // Rows out of phase: the columns are blind, the points are not.
    let profile = lattice(2, |x, row| if row == 0 { zigzag(x) } else { -zigzag(x) });
    assert!(profile.total_variation_cells() < 1e-13);
    assert!((profile.total_variation_points() - 38.0).abs() < 1e-13);
}

#[test]
fn points_of_one_row_of_cells_are_one_sequence() {
    // Two points per cell, one above the other: ties by y, value 0 below and 1 above.
    let positions = [[0.05, 0.07], [0.05, 0.02], [0.15, 0.02], [0.15, 0.07]];
    let profile = Profile::new(&grid(1), 0, &positions, &[1.0, 0.0, 0.0, 1.0], &[1.0; 4]).unwrap();
    assert_eq!(profile.total_variation_cells(), 0.0);
    assert_eq!(profile.total_variation_points(), 3.0);
}

#[test]
fn width_of_a_ramp_and_of_a_step() {
    // From 5 at x = 0.55 to 1 at x = 1.35: 8 cells, of which 10-90 % is 80 %.
    let ramp = |x: f64| 5.0 - 4.0 * ((x - 0.55) / 0.8).clamp(0.0, 1.0);
    for n_rows in [1, 3] {
        let front = lattice(n_rows, |x, _| ramp(x)).front(1.2, 5.0, 1.0).unwrap();
        assert!((front.width - 6.4).abs() < 1e-12, "{front:?}");
        assert!((front.position - 0.95).abs() < 1e-12, "{front:?}");
    }
    let front = lattice(1, |x, _| step(x)).front(1.0, 5.0, 1.0).unwrap();
    assert!((front.width - 0.8).abs() < 1e-12 && (front.position - 1.0).abs() < 1e-12);
    // A rising front is the same with its values named from the left.
    let front = lattice(1, |x, _| -ramp(x)).front(1.2, -5.0, -1.0).unwrap();
    assert!((front.width - 6.4).abs() < 1e-12, "{front:?}");
}

#[test]
fn the_nearest_front_is_taken_and_a_missing_one_is_none() {
    // Two falling steps with a rise between them.
    let two = |x: f64| if x < 0.5 || (1.0..1.5).contains(&x) { 3.0 } else { 1.0 };
    let profile = lattice(1, |x, _| two(x));
    assert!((profile.front(0.6, 3.0, 1.0).unwrap().position - 0.5).abs() < 1e-12);
    assert!((profile.front(1.3, 3.0, 1.0).unwrap().position - 1.5).abs() < 1e-12);
    assert_eq!(profile.front(1.0, 9.0, 5.0), None);
    assert_eq!(profile.within(0.6, 0.9).front(0.5, 3.0, 1.0), None);
    assert_eq!(profile.within(9.0, 9.0).front(0.5, 3.0, 1.0), None);
    // Ringing behind the front does not widen it.
    let ringing = |x: f64| step(x) + if x < 0.9 { 3.0 * (40.0 * x).sin() } else { 0.0 };
    let front = lattice(1, |x, _| ringing(x)).front(1.0, 5.0, 1.0).unwrap();
    assert!((front.width - 0.8).abs() < 1e-12, "{front:?}");
}

#[test]
fn a_value_that_is_not_a_number_is_not_hidden() {
    for place in [0.05, 0.95, 1.95] {
        let bad = |x: f64, _| if (x - place).abs() < 0.01 { f64::NAN } else { step(x) };
        let profile = lattice(2, bad);
        assert!(profile.l1(step).is_nan() && profile.l2(step).is_nan());
        assert!(profile.limits().iter().all(|q| q.is_nan()));
        assert!(profile.overshoot(1.0, 5.0).is_nan() && profile.undershoot(1.0, 5.0).is_nan());
        assert!(profile.total_variation_cells().is_nan());
        assert!(profile.total_variation_points().is_nan());
        assert_eq!(profile.n_outside(1.0, 5.0, 0.1), 2);
    }
    let empty = lattice(1, |x, _| x).within(5.0, 6.0);
    assert!(empty.limits()[0].is_nan() && empty.l1(|x| x).is_nan());
}

#[test]
fn bad_input_is_refused() {
    let new = |axis, values: &[f64]| Profile::new(&grid(1), axis, &[[0.0; 2]], values, &[1.0]);
    assert!(new(0, &[1.0]).is_ok() && new(1, &[1.0]).is_ok());
    assert!(new(2, &[1.0]).is_err());
    assert!(new(0, &[]).is_err());
    let none = GridSpec { origin: [0.0], spacing: [0.0], cells: [1] };
    assert!(Profile::new(&none, 0, &[], &[], &[]).is_err());
    let none = GridSpec { origin: [0.0], spacing: [1.0], cells: [0] };
    assert!(Profile::new(&none, 0, &[[0.0]], &[1.0], &[1.0]).is_err());
}

proptest! {
    /// On jittered points of a monotone function both total variations are its change.
    #[test]
    fn monotone_functions_vary_by_their_change(
        xs in proptest::collection::vec(0.0..2.0f64, 2..80), scale in 0.1..10.0f64,
    ) {
        let f = |x: f64| -scale * (3.0 * (x - 1.0)).tanh();
        let positions: Vec<_> = xs.iter().map(|&x| [x, 0.05]).collect();
        let values: Vec<f64> = xs.iter().map(|&x| f(x)).collect();
        let profile =
            Profile::new(&grid(1), 0, &positions, &values, &vec![1.0; xs.len()]).unwrap();
        let [low, high] = profile.limits();
        prop_assert!((profile.total_variation_points() - (high - low)).abs() < 1e-12 * scale);
        prop_assert!(profile.total_variation_cells() <= (high - low) * (1.0 + 1e-12) + 1e-12);
        prop_assert!(profile.points().is_sorted_by(|a, b| a.position <= b.position));
    }
}
