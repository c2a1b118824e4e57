use super::*;

fn state(density: f64, velocity: f64) -> State {
    State { density, velocity }
}

/// Fan and shock, both mirrored, two shocks, two fans, nothing, strong ones, near vacuum.
fn problems() -> Vec<IsothermalRiemann> {
    [
        (state(1000.4, 0.0), state(1000.04, 0.0)),
        (state(1000.04, 0.3), state(1000.4, 0.3)),
        (state(1000.0, 3.0), state(1001.0, -1.0)),
        (state(1000.0, -3.0), state(1001.0, 1.0)),
        (state(998.0, 2.0), state(998.0, 2.0)),
        (state(5000.0, 10.0), state(1.0, -20.0)),
        (state(1.0, 400.0), state(3.0, -300.0)),
        (state(2.0, -200.0), state(1.0, 300.0)),
    ]
    .map(|(left, right)| IsothermalRiemann::new(left, right, 50.0, 1000.0).unwrap())
    .to_vec()
}

#[test]
fn problem_of_the_paper() {
    let at_rest = |pressure: f64| state(1000.0 + pressure / 2500.0, 0.0);
    let exact = IsothermalRiemann::new(at_rest(1000.0), at_rest(100.0), 50.0, 1000.0).unwrap();
    let star = exact.star();
    assert!((exact.pressure(star) - 549.95951).abs() < 5e-6, "{}", exact.pressure(star));
    assert!((star.velocity - 0.008_998_02).abs() < 5e-9, "{}", star.velocity);
    let place = |speed: f64| 0.5 + speed * 5e-3;
    assert!((place(exact.left_wave().head()) - 0.25).abs() < 1e-12);
    assert!((place(exact.left_wave().tail()) - 0.250_045).abs() < 5e-7);
    assert!((place(exact.right_wave().head()) - 0.750_022).abs() < 5e-7);
    assert!(!exact.left_wave().is_shock() && exact.right_wave().is_shock());
}

#[test]
fn shocks_satisfy_the_jump_conditions_and_are_compressive() {
    let mut n_shocks = 0;
    for exact in problems() {
        let star = exact.star();
        for (wave, outer, sign) in
            [(exact.left_wave(), exact.left, -1.0), (exact.right_wave(), exact.right, 1.0)]
        {
            let Wave::Shock { speed } = wave else { continue };
            n_shocks += 1;
            let (a, b) = (star.velocity - speed, outer.velocity - speed);
            let mass = star.density * a - outer.density * b;
            let momentum = star.density * a * a - outer.density * b * b + exact.pressure(star)
                - exact.pressure(outer);
            let scale = star.density * 50.0;
            assert!(mass.abs() < 1e-13 * scale, "{exact:?}: {mass}");
            let scale = scale * (50.0 + b.abs());
            assert!(momentum.abs() < 1e-13 * scale, "{exact:?}: {momentum}");
            assert!(sign * (speed - outer.velocity) > 50.0);
            assert!(sign * (speed - star.velocity) < 50.0);
        }
    }
    assert_eq!(n_shocks, 7);
}

#[test]
fn fans_solve_the_equations_and_keep_the_riemann_invariant() {
    for exact in problems() {
        for (wave, outer, sign) in
            [(exact.left_wave(), exact.left, -1.0), (exact.right_wave(), exact.right, 1.0)]
        {
            let Wave::Fan { head, tail } = wave else { continue };
            if head == tail {
                continue;
            }
            for i in 1..10 {
                let ray = tail + (head - tail) * f64::from(i) / 10.0;
                let here = exact.at(ray);
                assert!((here.velocity + sign * 50.0 - ray).abs() < 1e-12 * head.abs());
                let invariant = |s: State| s.velocity - sign * 50.0 * s.density.ln();
                assert!((invariant(here) - invariant(outer)).abs() < 1e-10);
                // Self-similar: −ξ q' + f' = 0.
                let d = 1e-3 * (head - tail);
                let (a, b) = (exact.at(ray - d), exact.at(ray + d));
                let mass = |s: State| s.density * (s.velocity - ray);
                let slope = (mass(b) - mass(a)) / (2.0 * d);
                assert!(slope.abs() < 1e-4 * here.density, "{exact:?} {ray}: {slope}");
                let force =
                    |s: State| s.density * s.velocity * (s.velocity - ray) + exact.pressure(s);
                let slope = (force(b) - force(a)) / (2.0 * d);
                let scale = here.density * (50.0 + here.velocity.abs());
                assert!(slope.abs() < 1e-4 * scale, "{exact:?} {ray}: {slope}");
            }
            // Continuous at both edges.
            assert!((exact.at(head).density - outer.density).abs() < 1e-12 * outer.density);
            let inside = exact.at(tail + 1e-9 * (head - tail));
            let star = exact.star();
            assert!((inside.density / star.density - 1.0).abs() < 1e-7);
            assert!((inside.velocity - star.velocity).abs() < 1e-6);
        }
    }
}

#[test]
fn far_states_are_the_given_ones_and_a_uniform_state_stays() {
    for exact in problems() {
        assert_eq!(exact.at(f64::NEG_INFINITY), exact.left);
        assert_eq!(exact.at(f64::INFINITY), exact.right);
        assert_eq!(exact.at(exact.star().velocity), exact.star());
    }
    let uniform = problems()[4];
    for ray in [-100.0, 1.0, 2.0, 3.0, 100.0] {
        assert_eq!(uniform.at(ray), state(998.0, 2.0));
    }
}

#[test]
fn bad_input_and_vacuum_are_refused() {
    let good = state(1000.0, 0.0);
    for bad in [state(0.0, 0.0), state(-1.0, 0.0), state(f64::NAN, 0.0), state(1.0, f64::NAN)] {
        assert!(IsothermalRiemann::new(bad, good, 50.0, 1000.0).is_err(), "{bad:?}");
        assert!(IsothermalRiemann::new(good, bad, 50.0, 1000.0).is_err(), "{bad:?}");
    }
    assert!(IsothermalRiemann::new(good, good, 0.0, 1000.0).is_err());
    assert!(IsothermalRiemann::new(good, good, 50.0, f64::INFINITY).is_err());
    let apart = |u: f64| IsothermalRiemann::new(state(1.0, -u), state(1.0, u), 1.0, 1.0);
    assert!(apart(700.0).is_ok());
    assert!(apart(710.0).is_err());
    assert!(apart(-1e150).is_ok());
    assert!(apart(-1e300).is_err());
}
