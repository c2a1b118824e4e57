use super::*;

const RATIO: f64 = 1.4;

fn state(density: f64, velocity: f64, pressure: f64) -> State {
    State { density, velocity, pressure }
}

fn solve(left: State, right: State) -> IdealGasRiemann {
    IdealGasRiemann::new(left, right, RATIO).unwrap()
}

/// The five problems of \[Toro2009\], Chapter 4, then weak waves, and strong ones.
fn problems() -> Vec<IdealGasRiemann> {
    let collision = [state(5.99924, 19.5975, 460.894), state(5.99242, -6.19633, 46.0950)];
    [
        SOD,
        NEAR_VACUUM,
        [state(1.0, 0.0, 1000.0), state(1.0, 0.0, 0.01)],
        [state(1.0, 0.0, 0.01), state(1.0, 0.0, 100.0)],
        collision,
        [state(1.0, 0.5, 1.0 + 1e-6), state(2.0, 0.5, 1.0)],
        [state(1.0, 1e3, 1.0), state(1.0, -1e3, 1.0)],
        [state(1e-3, 0.0, 1e6), state(1e3, 0.0, 1e-3)],
    ]
    .map(|[left, right]| solve(left, right))
    .to_vec()
}

/// p*, u*, ρ*_L, ρ*_R as printed for the five tests in \[Toro2009\], Chapter 4.
const PUBLISHED: [[f64; 4]; 5] = [
    [0.303_13, 0.927_45, 0.426_32, 0.265_57],
    [0.001_89, 0.0, 0.021_85, 0.021_85],
    [460.894, 19.5975, 0.575_06, 5.999_24],
    [46.0950, -6.196_33, 5.992_42, 0.575_11],
    [1691.64, 8.689_75, 14.2823, 31.0426],
];

#[test]
fn published_star_states() {
    for (exact, row) in problems().into_iter().zip(PUBLISHED) {
        let [left, right] = exact.star();
        for (found, printed) in
            [left.pressure, left.velocity, left.density, right.density].into_iter().zip(row)
        {
            let bound = (1e-5 * printed.abs()).max(5e-6);
            assert!((found - printed).abs() < bound, "{exact:?}: {found} for {printed}");
        }
    }
    let shock = problems()[0].right_wave();
    assert!(shock.is_shock() && (shock.head() - 1.752_16).abs() < 5e-6, "{shock:?}");
}

/// Mass, momentum and energy density, and their fluxes in a frame that moves at `speed`.
fn fluxes(exact: &IdealGasRiemann, s: State, speed: f64) -> [f64; 3] {
    let u = s.velocity - speed;
    let energy = s.density * (exact.internal_energy(s) + 0.5 * s.velocity.powi(2));
    [s.density * u, s.density * s.velocity * u + s.pressure, energy * u + s.pressure * s.velocity]
}

fn sides(exact: &IdealGasRiemann) -> [(Wave, State, State, f64); 2] {
    let [left, right] = exact.star();
    [(exact.left_wave(), exact.left, left, -1.0), (exact.right_wave(), exact.right, right, 1.0)]
}

#[test]
fn shocks_and_contact_satisfy_the_jump_conditions() {
    let mut n_shocks = 0;
    for exact in problems() {
        let [left, right] = exact.star();
        assert_eq!((left.pressure, left.velocity), (right.pressure, right.velocity));
        for (wave, outer, star, sign) in sides(&exact) {
            let Wave::Shock { speed } = wave else { continue };
            n_shocks += 1;
            // In the frame of the shock: no cancellation of large velocities.
            let (a, b) = (star.velocity - speed, outer.velocity - speed);
            let gas = exact.gas();
            let enthalpy = |s: State| RATIO * exact.internal_energy(s);
            let scale = outer.density * b.abs();
            assert!((star.density * a - outer.density * b).abs() < 1e-12 * scale);
            let momentum =
                star.density * a * a + star.pressure - outer.density * b * b - outer.pressure;
            assert!(momentum.abs() < 1e-12 * (scale * b.abs() + outer.pressure), "{exact:?}");
            let energy = enthalpy(star) + 0.5 * a * a - enthalpy(outer) - 0.5 * b * b;
            assert!(energy.abs() < 1e-12 * (enthalpy(outer) + 0.5 * b * b), "{exact:?}");
            assert!(sign * (speed - outer.velocity) > gas.sound_speed(outer));
            assert!(sign * (speed - star.velocity) < gas.sound_speed(star));
        }
    }
    assert_eq!(n_shocks, 9);
}

#[test]
fn fans_are_isentropic_and_solve_the_equations() {
    let mut n_fans = 0;
    for exact in problems() {
        let gas = exact.gas();
        for (wave, outer, star, sign) in sides(&exact) {
            let Wave::Fan { head, tail } = wave else { continue };
            n_fans += 1;
            let invariant = |s: State| s.velocity - sign * 2.0 / (RATIO - 1.0) * gas.sound_speed(s);
            let entropy = |s: State| s.pressure / s.density.powf(RATIO);
            let speed = gas.sound_speed(outer);
            for i in 1..10 {
                let ray = tail + (head - tail) * f64::from(i) / 10.0;
                let here = exact.at(ray);
                let characteristic = here.velocity + sign * gas.sound_speed(here);
                assert!((characteristic - ray).abs() < 1e-12 * (speed + ray.abs()));
                assert!((invariant(here) - invariant(outer)).abs() < 1e-11 * speed);
                assert!((entropy(here) / entropy(outer) - 1.0).abs() < 1e-11);
                // Self-similar: −ξ q' + f' = 0, against the size of the terms themselves.
                let d = 1e-4 * (head - tail).abs();
                let (a, b) = (exact.at(ray - d), exact.at(ray + d));
                let (fa, fb) = (fluxes(&exact, a, ray), fluxes(&exact, b, ray));
                let mass = here.density * gas.sound_speed(here);
                let unit = here.velocity.abs() + gas.sound_speed(here);
                for (i, scale) in [mass, mass * unit, mass * unit * unit].into_iter().enumerate() {
                    let residual = (fb[i] - fa[i]).abs() / scale;
                    let change = (b.density - a.density).abs() / here.density;
                    assert!(residual < 1e-5 * change + 1e-13, "{exact:?} {i}: {residual}");
                }
            }
            let close = |a: State, b: State, bound: f64| {
                (a.density / b.density - 1.0).abs() < bound
                    && (a.pressure / b.pressure - 1.0).abs() < bound
                    && (a.velocity - b.velocity).abs() < bound * (speed + b.velocity.abs())
            };
            assert!(close(exact.at(head), outer, 1e-12));
            assert!(close(exact.at(tail + 1e-9 * (head - tail)), star, 1e-5), "{exact:?}");
        }
    }
    assert_eq!(n_fans, 7);
}

#[test]
fn what_flows_in_is_what_the_profile_holds() {
    // d/dt ∫ q dx over [−X, X] is the difference of the fluxes of the outer states.
    for exact in [solve(SOD[0], SOD[1]), solve(NEAR_VACUUM[0], NEAR_VACUUM[1])] {
        let (n, reach) = (400_000, 4.0);
        let width = 2.0 * reach / f64::from(n);
        let mut total = [0.0; 3];
        for i in 0..n {
            let s = exact.at(-reach + (f64::from(i) + 0.5) * width);
            let energy = exact.internal_energy(s) + 0.5 * s.velocity.powi(2);
            for (sum, per_mass) in total.iter_mut().zip([1.0, s.velocity, energy]) {
                *sum += s.density * per_mass * width;
            }
        }
        let (left, right) =
            (fluxes(&exact, exact.left, -reach), fluxes(&exact, exact.right, reach));
        for ((sum, a), b) in total.into_iter().zip(left).zip(right) {
            assert!((sum - (a - b)).abs() < 2e-5, "{exact:?}: {sum} against {}", a - b);
        }
    }
}

#[test]
fn mirrored_problems_have_mirrored_solutions() {
    for exact in problems() {
        let mirror = solve(exact.right.mirrored(), exact.left.mirrored());
        for ray in [-30.0, -1.0, -0.3, 0.1, 0.7, 2.0, 40.0] {
            let (a, b) = (exact.at(ray), mirror.at(-ray).mirrored());
            assert!((a.density / b.density - 1.0).abs() < 1e-9, "{exact:?} {ray}: {a:?} {b:?}");
        }
        assert_eq!(exact.at(f64::NEG_INFINITY), exact.left);
        assert_eq!(exact.at(f64::INFINITY), exact.right);
    }
}

#[test]
fn bad_input_and_vacuum_are_refused() {
    let good = state(1.0, 0.0, 1.0);
    for bad in [
        state(0.0, 0.0, 1.0),
        state(-1.0, 0.0, 1.0),
        state(1.0, 0.0, 0.0),
        state(1.0, f64::NAN, 1.0),
        state(f64::INFINITY, 0.0, 1.0),
    ] {
        assert!(IdealGasRiemann::new(bad, good, RATIO).is_err(), "{bad:?}");
        assert!(IdealGasRiemann::new(good, bad, RATIO).is_err(), "{bad:?}");
    }
    assert!(IdealGasRiemann::new(good, good, 1.0).is_err());
    // A vacuum opens at u_R − u_L = 4a/(γ−1).
    let apart = |u: f64| IdealGasRiemann::new(state(1.0, -u, 1.0), state(1.0, u, 1.0), RATIO);
    let limit = 5.0 * RATIO.sqrt();
    assert!(apart(0.999 * limit).is_ok());
    assert!(apart(1.001 * limit).is_err());
    let together = apart(-1e6);
    assert!(together.is_ok());
    assert!(apart(-1e200).is_err());
}
