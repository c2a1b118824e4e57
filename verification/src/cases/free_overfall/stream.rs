//! Depth and discharge along the stream at an instant, from the points.

use transpoint::Simulation;
use transpoint::scene::GridSpec;
use transpoint::simulation::PointState;

/// What is measured of an instant, by columns of cells.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stream {
    /// Volume of the points over the width of the column: the depth, m.
    pub(super) depths: Vec<f64>,
    /// Σ V u over the width of the column: the discharge per width, m²/s.
    pub(super) discharges: Vec<f64>,
    /// Mean pressure over the points in the cell on the bed, Pa; zero without points.
    pub(super) bed_pressures: Vec<f64>,
    /// Height of the highest point, m; zero without points.
    pub(super) tops: Vec<f64>,
    /// Height of the lowest point, m; infinite without points.
    pub(super) bottoms: Vec<f64>,
    /// Σ m, kg/m.
    pub(super) mass: f64,
    /// Σ ½ m v² over Σ m, J/kg.
    pub(super) energy: f64,
}

impl Stream {
    /// Sums over the points of a simulation; `bed` is the layer of cells on the bed.
    pub(super) fn of(grid: &GridSpec<2>, bed: usize, simulation: &dyn Simulation<2>) -> Self {
        let (h, n) = (grid.spacing[0], grid.cells[0]);
        let mut counts = vec![0_u32; n];
        let mut stream = Self {
            depths: vec![0.0; n],
            discharges: vec![0.0; n],
            bed_pressures: vec![0.0; n],
            tops: vec![0.0; n],
            bottoms: vec![f64::INFINITY; n],
            mass: 0.0,
            energy: 0.0,
        };
        simulation.visit_points(&mut |point: &PointState<2>| {
            let column = ((point.position[0] / h) as usize).min(n - 1);
            stream.depths[column] += point.volume() / h;
            stream.discharges[column] += point.volume() * point.velocity[0] / h;
            stream.tops[column] = stream.tops[column].max(point.position[1]);
            stream.bottoms[column] = stream.bottoms[column].min(point.position[1]);
            if (point.position[1] / h) as usize == bed {
                stream.bed_pressures[column] += point.pressure;
                counts[column] += 1;
            }
            stream.mass += point.mass;
            stream.energy += 0.5 * point.mass * point.velocity.iter().map(|v| v * v).sum::<f64>();
        });
        stream.energy /= stream.mass;
        for (pressure, count) in stream.bed_pressures.iter_mut().zip(counts) {
            *pressure /= f64::from(count.max(1));
        }
        stream
    }
}

/// Mean of the two columns beside a face between columns.
pub(super) fn at_face(values: &[f64], face: usize) -> f64 {
    0.5 * (values[face - 1] + values[face])
}
