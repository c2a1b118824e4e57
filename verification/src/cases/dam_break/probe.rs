//! Pressure on the far wall.

use transpoint::scene::GridSpec;
use transpoint::simulation::PointState;

use super::scene::{UP, pressure_scale};

/// Places of the pressure, in the order of [`Wall::pressures`].
pub(in crate::cases) const PLACES: [&str; 5] = ["160mm", "120mm", "60mm", "20mm", "disc"];
/// Heights of the first four, m; the first is Q.
const HEIGHTS: [f64; 4] = [0.16, 0.12, 0.06, 0.02];
/// Radius of the transducer about Q, m.
const RADIUS: f64 = 0.045;
/// Heights at which the disc is sampled.
const CHORDS: usize = 16;

/// Means over the points in the last column of cells, about each height with a hat as wide as two cells.
#[derive(Clone, Debug)]
pub(in crate::cases) struct Wall {
    /// Where the last column begins, m.
    begin: f64,
    spacing: f64,
    /// Height, Σ w p and Σ w; those of the disc last.
    places: [(f64, f64, f64); HEIGHTS.len() + CHORDS],
    wet: bool,
}

impl Wall {
    /// The far wall of a grid, without points yet.
    pub(in crate::cases) fn new<const D: usize>(grid: &GridSpec<D>) -> Self {
        let spacing = grid.spacing[0];
        let height = |k: usize| match k.checked_sub(HEIGHTS.len()) {
            None => HEIGHTS[k],
            Some(chord) => HEIGHTS[0] + RADIUS * angle(chord).cos(),
        };
        Self {
            begin: (grid.cells[0] - 1) as f64 * spacing,
            spacing,
            places: std::array::from_fn(|k| (height(k), 0.0, 0.0)),
            wet: false,
        }
    }

    /// Takes a point into account if it is at the wall.
    pub(in crate::cases) fn add<const D: usize>(&mut self, point: &PointState<D>) {
        if point.position[0] < self.begin {
            return;
        }
        let y = point.position[UP];
        self.wet |= (y - HEIGHTS[0]).abs() < 0.5 * self.spacing;
        for (height, sum, weights) in &mut self.places {
            let weight = 1.0 - (y - *height).abs() / self.spacing;
            if weight > 0.0 {
                *sum += weight * point.pressure;
                *weights += weight;
            }
        }
    }

    /// Whether a point is within half a cell of Q's height.
    pub(super) const fn wet(&self) -> bool {
        self.wet
    }

    /// P = p/(ρ₀ g h₀) at the [`PLACES`]; zero where there are no points.
    ///
    /// The mean over the disc weighs each height with its chord, by the Chebyshev-Gauss rule of the
    /// second kind, which is exact for profiles of degree 31.
    pub(in crate::cases) fn pressures(&self) -> [f64; PLACES.len()] {
        let mean = |&(_, sum, weights): &(f64, f64, f64)| {
            if weights > 0.0 { sum / weights / pressure_scale() } else { 0.0 }
        };
        let (heights, disc) = self.places.split_at(HEIGHTS.len());
        let chord = |k: usize| angle(k).sin().powi(2);
        let total: f64 = (0..CHORDS).map(chord).sum();
        let disc: f64 = disc.iter().enumerate().map(|(k, place)| chord(k) * mean(place)).sum();
        std::array::from_fn(|k| heights.get(k).map_or(disc / total, mean))
    }
}

/// Angle of a node of the rule.
fn angle(chord: usize) -> f64 {
    std::f64::consts::PI * (chord + 1) as f64 / (CHORDS + 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall_of(pressure: impl Fn(f64) -> f64) -> Wall {
        let grid = GridSpec { origin: [0.0; 2], spacing: [0.02; 2], cells: [3, 20] };
        let mut wall = Wall::new(&grid);
        for k in 0..800 {
            let y = (f64::from(k) + 0.5) * 0.0005;
            for x in [0.03, 0.05] {
                wall.add(&PointState {
                    id: 0,
                    position: [x, y],
                    velocity: [0.0; 2],
                    density: 1000.0,
                    // What is not at the wall must not count.
                    pressure: if x > 0.04 { pressure(y) * pressure_scale() } else { 1e9 },
                    mass: 1.0,
                    energy: 0.0,
                    stress: [[0.0; 2]; 2],
                    velocity_gradient: [[0.0; 2]; 2],
                    density_slope: [0.0; 2],
                });
            }
        }
        wall
    }

    #[test]
    fn constant_and_linear_pressures_are_found_exactly() {
        let wall = wall_of(|y| 3.0 - 2.0 * y);
        let expected = [0.16, 0.12, 0.06, 0.02, 0.16].map(|y| 3.0 - 2.0 * y);
        for (found, expected) in wall.pressures().into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
        assert!(wall.wet());
    }

    #[test]
    fn the_disc_weighs_heights_with_their_chords() {
        // ∫ s² √(r² − s²) ds = π r⁴/8 over the area π r²/2; the hat adds its own variance h²/6.
        let found = wall_of(|y| (y - 0.16).powi(2)).pressures()[4];
        let expected = 0.045_f64.powi(2) / 4.0 + 0.02_f64.powi(2) / 6.0;
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }

    #[test]
    fn a_dry_wall_has_no_pressure() {
        let grid = GridSpec { origin: [0.0; 2], spacing: [0.02; 2], cells: [3, 20] };
        let wall = Wall::new(&grid);
        assert_eq!((wall.pressures(), wall.wet()), ([0.0; 5], false));
    }
}
