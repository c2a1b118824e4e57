//! Checks of a scene, and of what is asked of a method on it, before a run.

use crate::Scalar;
use crate::cells::CellKind;
use crate::equation_of_state::{EquationOfState, WeaklyCompressible};
use crate::error::InvalidInput;
use crate::formulation::Formulation;
use crate::grid::Grid;
use crate::material::Material;
use crate::method::Method;
use crate::quadrature::{Quadrature, Samples};
use crate::reconstruction::Reconstruction;
use crate::scene::{Boundary, Scene};
use crate::settings::{Rearrangement, StressUpdate};
use crate::transfer::Transfer;

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
    check_central_force(scene)?;
    check_force_field(scene)?;
    for (id, point) in scene.points.iter().enumerate() {
        let field = |name: &str| format!("points[{id}].{name}");
        for (name, value) in [("density", point.density), ("mass", point.mass)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(InvalidInput::new(field(name), value, "a positive number"));
            }
        }
        if !point.energy.is_finite() {
            return Err(InvalidInput::new(field("energy"), point.energy, "finite, in J/kg"));
        }
        if point.velocity.iter().any(|v| !v.is_finite()) {
            let value = format!("{:?}", point.velocity);
            return Err(InvalidInput::new(field("velocity"), value, "finite, in m/s"));
        }
        if point.velocity_gradient.iter().flatten().any(|v| !v.is_finite()) {
            let value = format!("{:?}", point.velocity_gradient);
            return Err(InvalidInput::new(field("velocity_gradient"), value, "finite, in 1/s"));
        }
        if let Some(slope) = point.density_slope.filter(|s| s.iter().any(|v| !v.is_finite())) {
            let value = format!("{slope:?}");
            return Err(InvalidInput::new(
                field("density_slope"),
                value,
                "absent, or finite, in kg/m⁴",
            ));
        }
        if grid.cell_of(point.position.map(T::lit)).is_none() {
            let value = format!("{:?}", point.position);
            return Err(InvalidInput::new(field("position"), value, "inside the grid's box, in m"));
        }
    }
    Ok(())
}

/// A central force is finite, and no face or opening contradicts it.
fn check_central_force<const D: usize>(scene: &Scene<D>) -> Result<(), InvalidInput> {
    let Some(force) = scene.central_force else { return Ok(()) };
    for (axis, place) in force.center.into_iter().enumerate() {
        if !place.is_finite() {
            let field = format!("central_force.center[{axis}]");
            return Err(InvalidInput::new(field, place, "finite, in m"));
        }
    }
    if !(force.rate.is_finite() && force.rate > 0.0) {
        let allowed = "a positive number in 1/s, or no central force";
        return Err(InvalidInput::new("central_force.rate", force.rate, allowed));
    }
    if scene.boundaries.iter().flatten().any(|&face| face == Boundary::Periodic) {
        let allowed = "absent where a face is periodic: the force would jump there";
        return Err(InvalidInput::new("central_force", "present", allowed));
    }
    if !scene.inlets.is_empty() {
        let allowed = "absent where there are inlets: their pressure is that of the uniform force";
        return Err(InvalidInput::new("central_force", "present", allowed));
    }
    Ok(())
}

/// A field of force is finite where the points are at the start, and no opening contradicts it.
fn check_force_field<const D: usize>(scene: &Scene<D>) -> Result<(), InvalidInput> {
    let Some(field) = &scene.force_field else { return Ok(()) };
    for (id, point) in scene.points.iter().enumerate() {
        let acceleration = field.at(point.position, 0.0);
        if acceleration.iter().any(|b| !b.is_finite()) {
            let value = format!("`{}` with {acceleration:?}", field.name());
            let allowed = format!("finite at points[{id}], in m/s²");
            return Err(InvalidInput::new("force_field", value, allowed));
        }
    }
    if !scene.inlets.is_empty() {
        let allowed = "absent where there are inlets: their pressure is that of the uniform force";
        return Err(InvalidInput::new("force_field", format!("`{}`", field.name()), allowed));
    }
    Ok(())
}

/// The density of the scene's minimum pressure, kg/m³; zero without one.
///
/// # Errors
/// When the minimum is not finite, no density belongs to it, or it would depend on the energy.
pub fn minimum_density<T: Scalar, const D: usize>(
    scene: &Scene<D>,
    law: &EquationOfState<T>,
) -> Result<T, InvalidInput> {
    let Some(pressure) = scene.minimum_pressure else {
        return Ok(T::zero());
    };
    if law.uses_energy() {
        let allowed = "absent where the pressure depends on the internal energy";
        return Err(InvalidInput::new("minimum_pressure", pressure, allowed));
    }
    let density = law.density(T::lit(pressure), T::zero());
    if density.is_finite() && density > T::zero() {
        Ok(density)
    } else {
        let allowed = "a pressure in Pa at which the fluid has a positive density";
        Err(InvalidInput::new("minimum_pressure", pressure, allowed))
    }
}

/// Edge of the box that a point fills at the start, in cells: that of the median carried volume.
pub fn box_edge<T: Scalar, const D: usize>(scene: &Scene<D>, grid: &Grid<T, D>) -> T {
    let mut volumes: Vec<f64> = scene.points.iter().map(|p| p.mass / p.density).collect();
    volumes.sort_unstable_by(f64::total_cmp);
    let median = volumes.get(volumes.len() / 2).copied().unwrap_or(grid.cell_volume().as_f64());
    T::lit((median / grid.cell_volume().as_f64()).powf(1.0 / D as f64))
}

/// The laws of the material that a scene lists agree with each other.
///
/// # Errors
/// Names the first ingredient that is out of range or does not go with the others.
pub fn check_material<const D: usize>(scene: &Scene<D>) -> Result<(), InvalidInput> {
    let positive = |field: &str, value: Option<f64>, allowed: &str| match value {
        Some(value) if !(value.is_finite() && value > 0.0) => {
            Err(InvalidInput::new(field, value, allowed))
        }
        _ => Ok(()),
    };
    let absent = "or absent for an inviscid fluid";
    positive("viscosity", scene.viscosity, &format!("a positive number in m²/s, {absent}"))?;
    positive("shear_modulus", scene.shear_modulus, &format!("a positive number in Pa, {absent}"))?;
    if let (Some(_), Some(modulus)) = (scene.viscosity, scene.shear_modulus) {
        let allowed = "absent where there is a viscosity: a material is a fluid or a solid";
        return Err(InvalidInput::new("shear_modulus", modulus, allowed));
    }
    if EquationOfState::<f64>::new(&scene.equation_of_state)?.uses_energy() && !scene.energy {
        let allowed = "true: the pressure law depends on the internal energy";
        return Err(InvalidInput::new("energy", false, allowed));
    }
    Ok(())
}

/// The pressure law in the form in which a material without other laws uses it.
///
/// # Errors
/// When the material goes with the weakly compressible law only and the scene has another.
pub fn linear_law<T: Scalar, const D: usize, K: Material<T, D>>(
    law: &EquationOfState<T>,
) -> Result<WeaklyCompressible<T>, InvalidInput> {
    if K::ANY_LAW {
        // Not used.
        let zero = T::zero();
        let nothing = WeaklyCompressible { reference_density: zero, sound_speed_squared: zero };
        return Ok(law.linear().unwrap_or(nothing));
    }
    let allowed = "the weakly compressible law, or the material `General`";
    law.linear().ok_or_else(|| InvalidInput::new("equation_of_state", "another law", allowed))
}

/// The update of the energy by work has what makes it exact, see
/// [`EnergyUpdate::Work`](crate::settings::EnergyUpdate::Work).
///
/// # Errors
/// When the method's transfer, samples, formulation or order of updates break the sum.
pub fn check_energy_update<T, const D: usize, M, K>(
    method: &M,
    material: &K,
) -> Result<(), InvalidInput>
where
    T: Scalar,
    M: Method<T, D>,
    K: Material<T, D>,
{
    let keeps_energy = method.formulation() == Formulation::Standard
        && <M::Transfer as Transfer<T, D>>::USES_INCREMENT
        && !<M::Quadrature as Quadrature<T, D>>::USES_CENTERS
        && method.stress_update() == StressUpdate::Last;
    if material.wants_work() && !keeps_energy {
        let allowed = "`strain`; `work` needs FLIP, carried values, the standard formulation and the \
                       stress updated last";
        return Err(InvalidInput::new("settings.energy_update", "`work`", allowed));
    }
    Ok(())
}

/// Planes through cut cells are known when the strain is taken at them.
///
/// # Errors
/// When the velocity-pressure formulation updates the stress first, before the samples of the step.
pub fn check_samples<T: Scalar, const D: usize, M: Method<T, D>>(
    method: &M,
) -> Result<(), InvalidInput> {
    let samples = method.quadrature().samples(CellKind::Boundary);
    let at_planes = matches!(samples, Samples::Wetted | Samples::Balanced);
    let by_cell = method.formulation() != Formulation::Standard;
    if at_planes && by_cell && method.stress_update() == StressUpdate::First {
        let allowed = "`last` or `modified-last`, or another `point_volume`: the planes belong to the \
                       samples of the step";
        return Err(InvalidInput::new("settings.stress_update", "`first`", allowed));
    }
    Ok(())
}

/// A rearrangement has what it needs from the method.
///
/// # Errors
/// When a setting is out of range, points are added or moved without reconstructed fields or split
/// with them, or a reduced cell would be reduced again.
pub fn check_rearrangement<T, const D: usize, M>(
    settings: &Rearrangement,
) -> Result<(), InvalidInput>
where
    T: Scalar,
    M: Method<T, D>,
{
    settings.check()?;
    let field = |name: &str| format!("settings.rearrangement.{name}");
    let least = 1_u32 << D;
    if let Some(n) = settings.most_points.filter(|&n| n < least) {
        let allowed = format!("at least the {least} points that a reduced cell gets");
        return Err(InvalidInput::new(field("most_points"), n, allowed));
    }
    let reconstructs = <M::Reconstruction as Reconstruction<T, D>>::REBUILDS_NODES;
    let by_fits = <M::Reconstruction as Reconstruction<T, D>>::BY_CELLS;
    let rebuilt = "absent, or a method that reconstructs fields";
    let parts = [
        ("fill", settings.fill.is_some() && !reconstructs, rebuilt),
        ("most_points", settings.most_points.is_some() && !reconstructs, rebuilt),
        ("shift", settings.shift.is_some() && !reconstructs, rebuilt),
        (
            "overfill",
            settings.overfill.is_some() && (reconstructs || by_fits),
            "absent, or a method with carried values",
        ),
    ];
    for (name, refused, allowed) in parts {
        if refused {
            return Err(InvalidInput::new(field(name), "present", allowed));
        }
    }
    Ok(())
}
