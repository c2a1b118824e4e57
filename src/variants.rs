//! The named recipes: the only place where the generic solver becomes concrete.

use serde::{Deserialize, Serialize};

use crate::basis::{self, Limiters, PolynomialBasis};
use crate::equation_of_state::EquationOfState;
use crate::error::InvalidInput;
use crate::formulation::{Formulation, PointDivergence};
use crate::material::{Deviatoric, General, Inviscid, Material};
use crate::method::{Method, Scheme};
use crate::quadrature::{Mixed, Particle};
use crate::reconstruction::{Carried, MovingLeastSquares};
use crate::scene::Scene;
pub use crate::settings::{
    Blend, BoundaryCriterion, BulkViscosity, EnergyUpdate, Fill, FillMass, FillPoints, PointVolume,
    PressureLimiter, Rearrangement, Settings, Shift, Split, StressUpdate,
};
use crate::shape::{CubicBspline, Gimp, Linear, QuadraticBspline, ShapeFunction};
use crate::simulation::Simulation;
use crate::solver::Solver;
use crate::transfer::{Apic, Flip};

/// A named method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Variant {
    /// Transport point method as printed.
    Tpm,
    /// TPM with the velocity-pressure formulation, divergence interpolated from cell centres.
    TpmVp,
    /// TPM with the velocity-pressure formulation, divergence by quadratic B-splines about the cells.
    TpmVpQuadratic,
    /// TPM with the velocity-pressure formulation, divergence of the point's cell.
    TpmVpConstant,
    /// Classic MPM: linear hat, FLIP.
    Mpm,
    /// uGIMP, FLIP.
    Gimp,
    /// Quadratic B-spline MPM, FLIP.
    Bspline2,
    /// Cubic B-spline MPM, FLIP.
    Bspline3,
    /// Quadratic B-spline MPM with affine transfer.
    Apic,
    /// Linear MPM with the velocity-pressure formulation.
    MpmVp,
    /// uGIMP with the velocity-pressure formulation.
    GimpVp,
}

impl Variant {
    /// Every variant, in the order of tables and legends.
    pub const ALL: [Self; 11] = [
        Self::Tpm,
        Self::TpmVp,
        Self::Mpm,
        Self::Gimp,
        Self::Bspline2,
        Self::Bspline3,
        Self::Apic,
        Self::MpmVp,
        Self::TpmVpQuadratic,
        Self::TpmVpConstant,
        Self::GimpVp,
    ];

    /// Identifier in command lines, tables and file names.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tpm => "tpm",
            Self::TpmVp => "tpm-vp",
            Self::TpmVpQuadratic => "tpm-vp2",
            Self::TpmVpConstant => "tpm-vp0",
            Self::Mpm => "mpm",
            Self::Gimp => "gimp",
            Self::Bspline2 => "bspline2",
            Self::Bspline3 => "bspline3",
            Self::Apic => "apic",
            Self::MpmVp => "mpm-vp",
            Self::GimpVp => "gimp-vp",
        }
    }

    /// One-line description with its source key.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Tpm => "transport point method as printed [Song2020]",
            Self::TpmVp => "TPM, velocity-pressure, divergence interpolated from cell centres",
            Self::TpmVpQuadratic => "TPM, velocity-pressure, divergence by quadratic B-splines",
            Self::TpmVpConstant => "TPM, velocity-pressure, divergence constant in each cell",
            Self::Mpm => "material point method, linear hat, FLIP [Sulsky1994]",
            Self::Gimp => "uniform generalized interpolation MPM, FLIP [Bardenhagen2004]",
            Self::Bspline2 => "quadratic B-spline MPM, FLIP [Steffen2008]",
            Self::Bspline3 => "cubic B-spline MPM, FLIP [Steffen2008]",
            Self::Apic => "quadratic B-spline MPM, affine transfer [Jiang2015]",
            Self::MpmVp => "linear MPM, velocity-pressure formulation [Chen2018]",
            Self::GimpVp => "uGIMP, velocity-pressure formulation [Bardenhagen2004] [Chen2018]",
        }
    }

    /// Finds a variant by its name.
    ///
    /// # Errors
    /// Names the value found and the names allowed.
    pub fn parse(name: &str) -> Result<Self, InvalidInput> {
        Self::ALL.into_iter().find(|variant| variant.name() == name).ok_or_else(|| {
            let allowed: Vec<_> = Self::ALL.iter().map(|variant| variant.name()).collect();
            InvalidInput::new("variant", name, format!("one of {}", allowed.join(", ")))
        })
    }
}

/// Lists, once, which concrete types each variant is.
macro_rules! build {
    ($name:ident, $dimension:literal) => {
        impl Variant {
            /// Builds a simulation in `f64`.
            ///
            /// # Errors
            /// When the scene or a setting is out of range, or the combination is ill-posed.
            pub fn $name(
                self,
                scene: &Scene<$dimension>,
                settings: &Settings,
            ) -> Result<Box<dyn Simulation<$dimension>>, InvalidInput> {
                settings.check()?;
                let recipe = Recipe { scene, settings };
                let vp = Formulation::VelocityPressure;
                match self {
                    Self::Tpm => recipe.transport_points(Formulation::Standard),
                    Self::TpmVp => recipe.transport_points(vp(settings.point_divergence)),
                    Self::TpmVpConstant => recipe.transport_points(vp(PointDivergence::Constant)),
                    Self::TpmVpQuadratic => recipe.transport_points(vp(PointDivergence::Quadratic)),
                    Self::Mpm => recipe.material_points(Linear, Formulation::Standard),
                    Self::Gimp => recipe.material_points(
                        Gimp { length: settings.gimp_length },
                        Formulation::Standard,
                    ),
                    Self::Bspline2 => {
                        recipe.material_points(QuadraticBspline, Formulation::Standard)
                    }
                    Self::Bspline3 => recipe.material_points(CubicBspline, Formulation::Standard),
                    Self::Apic => recipe.affine(QuadraticBspline),
                    Self::MpmVp => recipe.material_points(Linear, vp(PointDivergence::Constant)),
                    Self::GimpVp => recipe.material_points(
                        Gimp { length: settings.gimp_length },
                        vp(PointDivergence::Constant),
                    ),
                }
            }
        }
    };
}

build!(build_1d, 1);
build!(build_2d, 2);
build!(build_3d, 3);

/// What a simulation is built from.
struct Recipe<'a, const D: usize> {
    scene: &'a Scene<D>,
    settings: &'a Settings,
}

type Built<const D: usize> = Result<Box<dyn Simulation<D>>, InvalidInput>;

impl<const D: usize> Recipe<'_, D>
where
    basis::Linear: PolynomialBasis<f64, D>,
{
    fn transport_points(&self, formulation: Formulation) -> Built<D> {
        let mut reconstruction =
            MovingLeastSquares::<basis::Linear, f64>::new(self.settings.support);
        let Settings { leverage, positivity, .. } = *self.settings;
        reconstruction.limiters = Limiters { leverage, positivity };
        self.build(Scheme {
            shape: Linear,
            reconstruction,
            quadrature: Mixed {
                point_volume: self.settings.point_volume,
                criterion: self.settings.boundary_criterion,
            },
            transfer: Flip { blend: self.settings.blend },
            formulation,
            stress_update: self.settings.stress_update,
        })
    }

    fn material_points(
        &self,
        shape: impl ShapeFunction<f64> + 'static,
        formulation: Formulation,
    ) -> Built<D> {
        self.build(Scheme {
            shape,
            reconstruction: Carried,
            quadrature: Particle,
            transfer: Flip { blend: self.settings.blend },
            formulation,
            stress_update: self.settings.stress_update,
        })
    }

    fn affine(&self, shape: impl ShapeFunction<f64> + 'static) -> Built<D> {
        self.build(Scheme {
            shape,
            reconstruction: Carried,
            quadrature: Particle,
            transfer: Apic,
            formulation: Formulation::Standard,
            stress_update: self.settings.stress_update,
        })
    }

    fn build(&self, method: impl Method<f64, D>) -> Built<D> {
        self.check_combination(&method)?;
        let Scene { viscosity, shear_modulus, energy, .. } = *self.scene;
        let deviatoric = match (viscosity, shear_modulus) {
            (Some(viscosity), _) => Some(Deviatoric::Newtonian { viscosity }),
            (None, Some(shear_modulus)) => Some(Deviatoric::Elastic { shear_modulus }),
            (None, None) => None,
        };
        let bulk_viscosity = self.settings.bulk_viscosity;
        let law = EquationOfState::<f64>::new(&self.scene.equation_of_state)?;
        if energy || bulk_viscosity.is_some() || law.linear().is_none() {
            let volume: f64 = self.scene.grid.spacing.iter().product();
            return self.solve(
                method,
                General {
                    deviatoric,
                    energy: energy.then_some(self.settings.energy_update),
                    bulk_viscosity,
                    cell_size: volume.powf(1.0 / D as f64),
                },
            );
        }
        match deviatoric {
            None => self.solve(method, Inviscid),
            Some(law) => self.solve(method, law),
        }
    }

    fn solve(&self, method: impl Method<f64, D>, material: impl Material<f64, D>) -> Built<D> {
        let mut solver = Solver::new(self.scene, method, material)?;
        solver.pressure_limiter = self.settings.pressure_limiter;
        solver.set_rearrangement(self.settings.rearrangement)?;
        Ok(Box::new(solver))
    }

    /// Refuses settings that the method cannot honour.
    fn check_combination<M: Method<f64, D>>(&self, method: &M) -> Result<(), InvalidInput> {
        let by_cell = matches!(method.formulation(), Formulation::VelocityPressure(_));
        if self.settings.pressure_limiter.is_some() && !by_cell {
            let allowed = "absent, or a variant with the velocity-pressure formulation";
            return Err(InvalidInput::new("settings.pressure_limiter", "a limiter", allowed));
        }
        Ok(())
    }
}
