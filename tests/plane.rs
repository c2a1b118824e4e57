//! A box cut by a plane, against polygons and tetrahedra that are cut in other ways, and identities.

use crate::common::near;
use proptest::prelude::*;
use transpoint::Scalar;
use transpoint::quadrature::{Plane, Wetted, normal};

/// Volume and first moments of simplices, (corner, corner, …), in the half space n·x ≤ d.
type Sums<const D: usize> = (f64, [f64; D]);

fn height<const D: usize>(plane: &Plane<f64, D>, at: &[f64; D]) -> f64 {
    (0..D).map(|axis| plane.normal[axis] * at[axis]).sum::<f64>() - plane.offset
}

/// Where the edge between two corners on different sides is cut.
fn cut<const D: usize>(plane: &Plane<f64, D>, wet: &[f64; D], dry: &[f64; D]) -> [f64; D] {
    let (a, b) = (height(plane, wet), height(plane, dry));
    let share = a / (a - b);
    std::array::from_fn(|axis| wet[axis] + share * (dry[axis] - wet[axis]))
}

/// The square as a polygon, cut edge by edge; its area as a fan of triangles.
fn polygon(plane: &Plane<f64, 2>) -> Sums<2> {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for (k, corner) in square.iter().enumerate() {
        let next = &square[(k + 1) % 4];
        let (is_wet, next_is_wet) = (height(plane, corner) <= 0.0, height(plane, next) <= 0.0);
        if is_wet {
            corners.push(*corner);
        }
        if is_wet && !next_is_wet {
            corners.push(cut(plane, corner, next));
        } else if !is_wet && next_is_wet {
            corners.push(cut(plane, next, corner));
        }
    }
    let (mut area, mut first) = (0.0, [0.0; 2]);
    for k in 2..corners.len() {
        let [a, b, c] = [corners[0], corners[k - 1], corners[k]];
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        area += 0.5 * twice;
        for axis in 0..2 {
            first[axis] += 0.5 * twice * (a[axis] + b[axis] + c[axis]) / 3.0;
        }
    }
    (area, first)
}

fn add_tetrahedron(sums: &mut Sums<3>, corners: [[f64; 3]; 4]) {
    let [u, v, w] = [1, 2, 3].map(|k| {
        let edge: [f64; 3] = std::array::from_fn(|axis| corners[k][axis] - corners[0][axis]);
        edge
    });
    let product = u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0]);
    let volume = product.abs() / 6.0;
    sums.0 += volume;
    for axis in 0..3 {
        sums.1[axis] += volume * corners.iter().map(|corner| corner[axis]).sum::<f64>() / 4.0;
    }
}

/// A wedge between two triangles with corresponding corners.
fn add_wedge(sums: &mut Sums<3>, a: [[f64; 3]; 3], b: [[f64; 3]; 3]) {
    add_tetrahedron(sums, [a[0], a[1], a[2], b[0]]);
    add_tetrahedron(sums, [a[1], a[2], b[0], b[1]]);
    add_tetrahedron(sums, [a[2], b[0], b[1], b[2]]);
}

/// The cube as six tetrahedra, one per order of the axes, each cut into tetrahedra.
fn tetrahedra(plane: &Plane<f64, 3>) -> Sums<3> {
    let mut sums = (0.0, [0.0; 3]);
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let mut corners = vec![[0.0; 3]];
        for axis in order {
            let mut next = corners[corners.len() - 1];
            next[axis] = 1.0;
            corners.push(next);
        }
        let (wet, dry): (Vec<_>, Vec<_>) =
            corners.into_iter().partition(|corner| height(plane, corner) <= 0.0);
        let at = |i: usize, j: usize| cut(plane, &wet[i], &dry[j]);
        match wet.len() {
            0 => (),
            1 => add_tetrahedron(&mut sums, [wet[0], at(0, 0), at(0, 1), at(0, 2)]),
            2 => {
                let [a, b] = [0, 1].map(|k| [wet[k], at(k, 0), at(k, 1)]);
                add_wedge(&mut sums, a, b);
            }
            3 => add_wedge(&mut sums, [wet[0], wet[1], wet[2]], [0, 1, 2].map(|k| at(k, 0))),
            _ => add_tetrahedron(&mut sums, [wet[0], wet[1], wet[2], wet[3]]),
        }
    }
    sums
}

fn check<const D: usize>(plane: &Plane<f64, D>, (volume, first): Sums<D>) {
    let found = plane.wetted();
    near("fraction", found.fraction, volume, 1e-13).unwrap();
    if volume > 0.0 {
        for axis in 0..D {
            let bound = 1e-12 + 1e-15 / volume;
            near("centroid", found.centroid[axis], first[axis] / volume, bound).unwrap();
        }
    }
}

/// Components of a normal: of any sign, of any size down to 10⁻¹⁸, or none.
fn component() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0..1.0_f64,
        2 => (-18.0..0.0_f64, prop::bool::ANY).prop_map(|(power, is_up)| {
            10.0_f64.powf(power) * if is_up { 1.0 } else { -1.0 }
        }),
        1 => Just(0.0),
        1 => prop::sample::select(vec![1.0, -1.0, 0.5]),
    ]
}

/// A plane whose level lies anywhere between the first and the last corner.
fn plane<const D: usize>() -> impl Strategy<Value = Plane<f64, D>> {
    (prop::collection::vec(component(), D), 0.0..1.0_f64).prop_filter_map("zero", |(n, share)| {
        let normal: [f64; D] = n.try_into().ok()?;
        let sum = normal.iter().map(|n| n.abs()).sum::<f64>();
        let lowest = normal.iter().map(|n| n.min(0.0)).sum::<f64>();
        (sum > 0.0).then_some(Plane { normal, offset: lowest + share * sum })
    })
}

fn is_near<const D: usize>(a: &Wetted<f64, D>, b: &Wetted<f64, D>) {
    near("fraction", a.fraction, b.fraction, 1e-14).unwrap();
    for axis in 0..D {
        let bound = 1e-12 + 1e-15 / a.fraction;
        near("centroid", a.centroid[axis], b.centroid[axis], bound).unwrap();
    }
}

fn complement<const D: usize>(plane: &Plane<f64, D>) {
    let wet = plane.wetted();
    let dry = Plane { normal: plane.normal.map(|n| -n), offset: -plane.offset }.wetted();
    near("both", wet.fraction + dry.fraction, 1.0, 1e-14).unwrap();
    for axis in 0..D {
        let first = wet.fraction * wet.centroid[axis] + dry.fraction * dry.centroid[axis];
        near("first moment", first, 0.5, 1e-14).unwrap();
    }
}

fn mirror<const D: usize>(plane: &Plane<f64, D>) {
    for axis in 0..D {
        let mut other = *plane;
        other.normal[axis] = -plane.normal[axis];
        other.offset -= plane.normal[axis];
        let mut expected = plane.wetted();
        expected.centroid[axis] = 1.0 - expected.centroid[axis];
        is_near(&expected, &other.wetted());
    }
}

fn permutation<const D: usize>(plane: &Plane<f64, D>) {
    let turned = |x: [f64; D]| std::array::from_fn(|axis| x[(axis + 1) % D]);
    let mut expected = plane.wetted();
    expected.centroid = turned(expected.centroid);
    is_near(&expected, &Plane { normal: turned(plane.normal), ..*plane }.wetted());
}

/// Not falling, and the slope is that of the chords: the volume is an integral of it.
fn monotone<const D: usize>(plane: &Plane<f64, D>, further: f64) {
    let next = Plane { offset: plane.offset + further, ..*plane };
    let (a, b) = (plane.wetted(), next.wetted());
    assert!(b.fraction >= a.fraction - 1e-15 && a.slope >= 0.0 && a.slope.is_finite());
    let inside = |x: f64| (-1e-15..=1.0 + 1e-15).contains(&x);
    assert!(inside(a.fraction) && a.centroid.into_iter().all(inside), "{a:?}");
}

/// Both ways round; the offset as far as the fraction determines it.
fn inverse<const D: usize>(plane: &Plane<f64, D>) {
    let wet = plane.wetted();
    let back = Plane::of_fraction(plane.normal, wet.fraction);
    near("fraction", back.wetted().fraction, wet.fraction, 4e-15).unwrap();
    let scale = plane.normal.iter().map(|n| n.abs()).sum::<f64>();
    if wet.slope > 0.0 && wet.fraction < 0.999 {
        let bound = 1e-14 * scale + 1e-14 / wet.slope;
        near("offset", back.offset, plane.offset, bound).unwrap();
    }
}

fn identities<const D: usize>(plane: &Plane<f64, D>, further: f64) {
    complement(plane);
    mirror(plane);
    permutation(plane);
    monotone(plane, further);
    inverse(plane);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn squares_are_cut_as_polygons(plane in plane::<2>()) {
        check(&plane, polygon(&plane));
    }

    #[test]
    fn cubes_are_cut_as_tetrahedra(plane in plane::<3>()) {
        check(&plane, tetrahedra(&plane));
    }

    #[test]
    fn identities_hold(a in plane::<1>(), b in plane::<2>(), c in plane::<3>(), t in 0.0..0.1_f64) {
        identities(&a, t);
        identities(&b, t);
        identities(&c, t);
    }

    /// Relative accuracy: the corner tetrahedron V = α³/(6 m₁ m₂ m₃) with its centroid α/(4 m).
    #[test]
    fn tiny_corners_keep_their_digits(n in prop::array::uniform3(0.01..1.0_f64), p in -60.0..-3.0_f64) {
        let offset = 10_f64.powf(p);
        let wet = Plane { normal: n, offset }.wetted();
        let volume = offset.powi(3) / (6.0 * n[0] * n[1] * n[2]);
        near("fraction", wet.fraction / volume, 1.0, 1e-13).unwrap();
        for axis in 0..3 {
            near("centroid", wet.centroid[axis] / (offset / (4.0 * n[axis])), 1.0, 1e-13).unwrap();
        }
        let back = Plane::of_fraction(n, wet.fraction);
        near("offset", back.offset / offset, 1.0, 1e-13).unwrap();
    }

    /// The slope against a difference quotient, away from kinks in the mean.
    #[test]
    fn slope_is_the_derivative(plane in plane::<3>()) {
        let normal = plane.normal.map(|n| n + 1.5);
        let middle = Plane { normal, offset: 0.3 * normal.iter().sum::<f64>() };
        let at = |shift: f64| Plane { offset: middle.offset + shift, ..middle }.wetted().fraction;
        let step = 1.0 / 1024.0;
        let quotient = (at(step) - at(-step)) / (2.0 * step);
        near("slope", middle.wetted().slope, quotient, 1e-5).unwrap();
    }

    /// A linear interface across an axis comes back exactly, at walls too.
    #[test]
    fn planes_across_an_axis_are_reproduced(
        (axis, is_up, height) in (0..3_usize, prop::bool::ANY, 0.0..1.0_f64),
        walls in prop::array::uniform3(0..3_u8),
    ) {
        let fraction = |shift: [i32; 3]| {
            // 1: a wall below; 2: a wall above. Not across the normal, where the wall hides the surface.
            let is_outside = |a: usize| match walls[a] {
                1 => shift[a] < 0,
                2 => shift[a] > 0,
                _ => false,
            };
            let beyond = (0..3).any(|a| a != axis && is_outside(a));
            let below: f64 = if shift[axis] < 0 { 1.0 } else { 0.0 };
            let value = if shift[axis] == 0 { height } else { below };
            (!beyond).then_some(if is_up || shift[axis] == 0 { value } else { 1.0 - value })
        };
        let found = normal::<f64, 3>(fraction).unwrap();
        let sign = if is_up { 1.0 } else { -1.0 };
        for other in 0..3 {
            prop_assert_eq!(found[other], if other == axis { sign } else { 0.0 });
        }
        let plane = Plane::of_fraction(found, height);
        let expected = if is_up { height } else { -(1.0 - height) };
        near("offset", plane.offset, expected, 1e-15).unwrap();
        let center = if is_up { 0.5 * height } else { 1.0 - 0.5 * height };
        near("centroid", plane.wetted().centroid[axis], center, 1e-15).unwrap();
    }
}

#[test]
fn fractions_beyond_the_ends_are_the_ends() {
    for fraction in [-1.0, 0.0] {
        assert_eq!(Plane::of_fraction([1.0, -2.0], fraction).offset, -2.0);
    }
    for fraction in [1.0, 2.0] {
        assert_eq!(Plane::of_fraction([1.0, -2.0], fraction).offset, 1.0);
    }
    let empty = Plane { normal: [1.0, -2.0], offset: -3.0 }.wetted();
    assert_eq!((empty.fraction, empty.centroid, empty.slope), (0.0, [0.0, 1.0], 0.0));
    let full = Plane { normal: [1.0, -2.0], offset: 3.0 }.wetted();
    assert_eq!((full.fraction, full.slope), (1.0, 0.0));
}

#[test]
fn without_a_normal_all_or_nothing_is_wetted() {
    let flat = |offset| Plane { normal: [0.0; 3], offset }.wetted().fraction;
    assert_eq!([flat(-1.0), flat(0.0), flat(1.0)], [0.0, 1.0, 1.0]);
    assert_eq!(normal::<f64, 3>(|_| Some(0.7)), None);
    assert_eq!(normal::<f64, 2>(|shift| (shift == [0; 2]).then_some(0.7)), None);
}

/// An inclined plane in 2D: exact on 3 × 3 cells where it cuts no other than the middle column's.
#[test]
fn an_oblique_normal_points_out_of_the_fluid() {
    let slope = |shift: [i32; 2]| {
        Some((0.5 - f64::from(shift[0]) * 0.1 - f64::from(shift[1])).clamp(0.0, 1.0))
    };
    let [x, y] = normal::<f64, 2>(slope).unwrap();
    assert!(x > 0.0 && y > x && (x + y - 1.0).abs() < 1e-15, "{x} {y}");
}

#[test]
fn single_precision_finds_the_same() {
    fn run<T: Scalar>() -> (f64, f64) {
        let plane = Plane { normal: [0.3, -0.5, 0.01].map(T::lit), offset: T::lit(-0.2) };
        let back = Plane::of_fraction(plane.normal, plane.wetted().fraction);
        (plane.wetted().fraction.as_f64(), back.offset.as_f64())
    }
    near("fraction", run::<f32>().0, run::<f64>().0, 1e-6).unwrap();
    near("offset", run::<f32>().1, run::<f64>().1, 1e-6).unwrap();
}
