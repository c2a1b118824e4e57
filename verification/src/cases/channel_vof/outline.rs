//! The wet part of the channel, of a run and of a volume-of-fluid run, as a picture of small squares.

use super::scene::DOMAIN;
use crate::cases::fluid_cells::FluidCells;

/// Which squares of the channel are wet.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Region {
    /// Edge of a square, m.
    edge: f64,
    columns: usize,
    rows: usize,
    /// By columns from the inlet, each from the bed.
    wet: Vec<bool>,
}

impl Region {
    fn new(edge: f64, is_wet: impl Fn([f64; 2]) -> bool) -> Self {
        let [columns, rows] = DOMAIN.map(|length| (length / edge).round() as usize);
        let center = |index: usize| (index as f64 + 0.5) * edge;
        let place = |index: usize| [center(index / rows), center(index % rows)];
        let wet = (0..columns * rows).map(|index| is_wet(place(index))).collect();
        Self { edge, columns, rows, wet }
    }

    /// What the fluid of some cells encloses: a hole that air cannot reach from above or from the end is
    /// within the outline.
    pub(super) fn of_cells(cells: &FluidCells, edge: f64) -> Self {
        let mut region = Self::new(edge, |place| cells.is_wet(place));
        region.fill_holes();
        region
    }

    /// What lies below a line that runs from the front to the inlet.
    pub(super) fn of_outline(line: &[[f64; 2]], edge: f64) -> Self {
        let (Some(first), Some(last)) = (line.first(), line.last()) else {
            return Self::new(edge, |_| false);
        };
        let ends = [[0.0, last[1]], [0.0, 0.0], [first[0], 0.0]];
        let corners: Vec<[f64; 2]> = line.iter().copied().chain(ends).collect();
        Self::new(edge, |place| encloses(&corners, place))
    }

    fn fill_holes(&mut self) {
        let Self { columns, rows, .. } = *self;
        let mut air = vec![false; self.wet.len()];
        let mut ahead: Vec<usize> = (0..columns).map(|column| column * rows + rows - 1).collect();
        ahead.extend((0..rows).map(|row| (columns - 1) * rows + row));
        while let Some(index) = ahead.pop() {
            if self.wet[index] || air[index] {
                continue;
            }
            air[index] = true;
            let (column, row) = (index / rows, index % rows);
            ahead.extend((column > 0).then(|| index - rows));
            ahead.extend((column + 1 < columns).then(|| index + rows));
            ahead.extend((row > 0).then(|| index - 1));
            ahead.extend((row + 1 < rows).then(|| index + 1));
        }
        for (wet, air) in self.wet.iter_mut().zip(air) {
            *wet = !air;
        }
    }

    /// Wet area, m².
    pub(super) fn area(&self) -> f64 {
        self.count(|wet| *wet)
    }

    /// Area that is wet in exactly one of two regions of equal squares, m².
    pub(super) fn difference(&self, other: &Self) -> f64 {
        let differ = self.wet.iter().zip(&other.wet).filter(|(a, b)| a != b).count();
        differ as f64 * self.edge * self.edge
    }

    fn count(&self, holds: impl Fn(&bool) -> bool) -> f64 {
        self.wet.iter().filter(|wet| holds(wet)).count() as f64 * self.edge * self.edge
    }

    /// Largest x that is wet, m.
    pub(super) fn front(&self) -> f64 {
        let last = self.wet.iter().rposition(|&wet| wet);
        last.map_or(0.0, |index| (index / self.rows + 1) as f64 * self.edge)
    }

    /// Middle of each column of squares and its highest wet place, m; not a number where it is dry.
    pub(super) fn tops(&self) -> Vec<(f64, f64)> {
        let top = |(column, wet): (usize, &[bool])| {
            let highest = wet.iter().rposition(|&wet| wet);
            let top = highest.map_or(f64::NAN, |row| (row + 1) as f64 * self.edge);
            ((column as f64 + 0.5) * self.edge, top)
        };
        self.wet.chunks(self.rows).enumerate().map(top).collect()
    }
}

/// Whether a closed line of corners encloses a place, by the number of its edges to the right.
fn encloses(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(next).filter(|(a, b)| {
        (a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]
    });
    crossed.count() % 2 == 1
}
