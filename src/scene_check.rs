//! Checks of a scene's points before a run.

use crate::Scalar;
use crate::error::InvalidInput;
use crate::grid::Grid;
use crate::scene::Scene;

/// Checks that every point lies in the box and has a positive density and mass.
///
/// # Errors
/// Names the first offending point and field.
pub fn check_points<T: Scalar, const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<T, D>,
) -> Result<(), InvalidInput> {
    if scene.points.len() >= u32::MAX as usize {
        return Err(InvalidInput::new("points", scene.points.len(), "fewer than 2³² − 1 points"));
    }
    for axis in 0..D {
        if !scene.body_force[axis].is_finite() {
            let field = format!("body_force[{axis}]");
            return Err(InvalidInput::new(field, scene.body_force[axis], "finite, in m/s²"));
        }
    }
    for (id, point) in scene.points.iter().enumerate() {
        let field = |name: &str| format!("points[{id}].{name}");
        for (name, value) in [("density", point.density), ("mass", point.mass)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(InvalidInput::new(field(name), value, "a positive number"));
            }
        }
        if point.velocity.iter().any(|v| !v.is_finite()) {
            let value = format!("{:?}", point.velocity);
            return Err(InvalidInput::new(field("velocity"), value, "finite, in m/s"));
        }
        if point.velocity_gradient.iter().flatten().any(|v| !v.is_finite()) {
            let value = format!("{:?}", point.velocity_gradient);
            return Err(InvalidInput::new(field("velocity_gradient"), value, "finite, in 1/s"));
        }
        if grid.cell_of(point.position.map(T::lit)).is_none() {
            let value = format!("{:?}", point.position);
            return Err(InvalidInput::new(field("position"), value, "inside the grid's box, in m"));
        }
    }
    Ok(())
}
