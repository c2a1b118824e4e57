//! The radius that the cylinder is given on the grid.

use super::scene::{CENTER, DIAMETER};

/// A place on the grid, cells.
type Place = (i64, i64);

/// The radius, m, with which the cylinder on the grid is as large as the circle, by the area of the convex
/// hull of its nodes.
///
/// A body is the union of the cells whose centers it contains, and the fluid stands still on all of their
/// nodes. What the flow meets is the outline of the corners of this staircase. With the radius of the circle
/// its hull is 2 to 6 % wider than the circle at ten to six cells per diameter. Of all radii between those
/// at which a cell joins, this is the one whose hull differs least; it follows from the grid alone.
pub(super) fn matched_radius(spacing: f64) -> f64 {
    let circle = 0.5 * DIAMETER / spacing;
    let mut radii: Vec<f64> = cells(spacing, 1.5 * circle).iter().map(|cell| cell.0).collect();
    radii.sort_by(f64::total_cmp);
    radii.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let middles = radii.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let error = |radius: f64| (hull_radius(spacing, radius * spacing) / spacing - circle).abs();
    let best = middles.min_by(|a, b| error(*a).total_cmp(&error(*b)));
    best.map_or(0.5 * DIAMETER, |radius| radius * spacing)
}

/// Radius, m, of the circle with the area of the convex hull of the nodes of a cylinder on the grid.
pub(super) fn hull_radius(spacing: f64, radius: f64) -> f64 {
    let nodes: Vec<Place> = cells(spacing, radius / spacing)
        .into_iter()
        .flat_map(|(_, (i, j))| [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)])
        .collect();
    (hull_area(nodes) / std::f64::consts::PI).sqrt() * spacing
}

/// Cells whose centers lie within a radius, cells, with the distances of the centers.
fn cells(spacing: f64, radius: f64) -> Vec<(f64, Place)> {
    let [x, y] = CENTER.map(|c| c / spacing);
    let range = |c: f64| (c - radius).floor() as i64 - 1..=(c + radius).ceil() as i64;
    let mut found = Vec::new();
    for i in range(x) {
        for j in range(y) {
            let distance = (i as f64 + 0.5 - x).hypot(j as f64 + 0.5 - y);
            if distance < radius {
                found.push((distance, (i, j)));
            }
        }
    }
    found
}

/// Area of the convex hull of places, by Andrew's monotone chain.
fn hull_area(mut places: Vec<Place>) -> f64 {
    places.sort_unstable();
    places.dedup();
    let mut lower = chain(&places);
    places.reverse();
    let upper = chain(&places);
    lower.extend(upper);
    let twice: i64 = (0..lower.len())
        .map(|k| {
            let (a, b) = (lower[k], lower[(k + 1) % lower.len()]);
            a.0 * b.1 - a.1 * b.0
        })
        .sum();
    0.5 * twice as f64
}

/// The part of the hull on the right of the way through sorted places, without its last place.
fn chain(places: &[Place]) -> Vec<Place> {
    let mut found: Vec<Place> = Vec::new();
    for &place in places {
        while let [.., a, b] = found[..] {
            if (b.0 - a.0) * (place.1 - a.1) - (b.1 - a.1) * (place.0 - a.0) > 0 {
                break;
            }
            found.pop();
        }
        found.push(place);
    }
    found.pop();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_square_and_of_a_cross_is_known() {
        assert_eq!(hull_area(vec![(0, 0), (2, 0), (1, 1), (0, 2), (2, 2), (1, 0)]), 4.0);
        assert_eq!(hull_area(vec![(1, 0), (0, 1), (-1, 0), (0, -1), (0, 0)]), 2.0);
        assert_eq!(hull_area(Vec::new()), 0.0);
    }

    #[test]
    fn ten_cells_per_diameter_make_an_octagon_too_large() {
        // Corners (5, 2), (4, 4), (2, 5) and so on: area 88.
        let plain = hull_radius(0.01, 0.05);
        assert!((plain - 0.01 * (88.0 / std::f64::consts::PI).sqrt()).abs() < 1e-12, "{plain}");
        let radius = matched_radius(0.01);
        // Area 78, of 25π = 78.5.
        assert!((radius / 0.01 - 4.636).abs() < 1e-3, "{radius}");
        assert!((hull_radius(0.01, radius) / 0.05 - 1.0).abs() < 0.005);
    }

    #[test]
    fn finer_grids_come_closer() {
        for cells_across in [25, 41, 62, 82] {
            let spacing = super::super::scene::spacing(cells_across);
            let of = |radius| (hull_radius(spacing, radius) / (0.5 * DIAMETER) - 1.0).abs();
            let (plain, matched) = (of(0.5 * DIAMETER), of(matched_radius(spacing)));
            assert!(matched < 0.01 && plain > 2.0 * matched, "{cells_across}: {plain} {matched}");
        }
    }
}
