//! From names to types: the only place where the generic solver becomes concrete.

use super::{Fields, Kernel, Settings, TransferKind, Variant};
use crate::basis::{self, Limiters, PolynomialBasis};
use crate::equation_of_state::EquationOfState;
use crate::error::InvalidInput;
use crate::formulation::Formulation;
use crate::material::{Deviatoric, General, Inviscid, Material};
use crate::method::{Method, Scheme};
use crate::quadrature::{Mixed, Particle, Quadrature, WholeCells};
use crate::reconstruction::{
    Carried, CellFit, CellLeastSquares, MovingLeastSquares, Reconstruction, TaylorLeastSquares,
};
use crate::scene::Scene;
use crate::shape::{
    AboutVertices, ConvectedGimp, Corrected, CubicBspline, DualDomain, FourWide, Gimp,
    LeastSquares, Linear, Quadratic, QuadraticBspline, ShapeFunction, Staggered,
};
use crate::simd::InSpace;
use crate::simulation::Simulation;
use crate::solver::Solver;
use crate::transfer::{Apic, Flip, Tpic, Transfer};

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
                build(self, scene, settings)
            }
        }
    };
}

build!(build_1d, 1);
build!(build_2d, 2);
build!(build_3d, 3);

type Built<const D: usize> = Result<Box<dyn Simulation<D>>, InvalidInput>;

/// The combinations that are compiled. All go with an inviscid fluid and with [`General`] materials; those with more
/// uses also with stress alone, in two and three dimensions.
fn build<const D: usize>(variant: Variant, scene: &Scene<D>, settings: &Settings) -> Built<D>
where
    basis::Linear: PolynomialBasis<f64, D>,
{
    let settings = &variant.settings(settings);
    settings.check()?;
    let parts = variant.parts();
    let formulation = match parts.formulation {
        super::AS_SET => Formulation::VelocityPressure(settings.point_divergence),
        other => other,
    };
    let recipe = Recipe { scene, settings, formulation };
    let flip = Flip { blend: settings.blend };
    let least_squares = || {
        let mut fit = MovingLeastSquares::<basis::Linear, f64>::new(settings.support);
        let Settings { leverage, positivity, .. } = *settings;
        fit.limiters = Limiters { leverage, positivity };
        fit
    };
    let mixed =
        Mixed { point_volume: settings.point_volume, criterion: settings.boundary_criterion };
    let points = (Carried, Particle);
    match (parts.kernel, parts.fields, parts.transfer) {
        (Kernel::Linear, Fields::TransportPoints, TransferKind::Flip) => {
            recipe.with_stress(Linear, (least_squares(), mixed), flip)
        }
        (Kernel::Linear, Fields::Carried, TransferKind::Flip) => {
            recipe.with_stress(Linear, points, flip)
        }
        (Kernel::QuadraticBspline, Fields::Carried, TransferKind::Flip) => {
            recipe.with_stress(QuadraticBspline, points, flip)
        }
        (Kernel::QuadraticBspline, Fields::Carried, TransferKind::Apic) => {
            recipe.with_stress(QuadraticBspline, points, Apic)
        }
        (kernel, Fields::Carried, TransferKind::Flip) => {
            match (about_vertices(kernel, settings), four_wide(kernel)) {
                (Some(shape), _) => recipe.with_stress(shape, points, flip),
                (_, Some(shape)) => recipe.with_stress(shape, points, flip),
                _ => not_compiled(variant),
            }
        }
        (kernel, Fields::Carried, TransferKind::Tpic) => match quadratic(kernel) {
            Some(shape) => recipe.build(shape, points, Tpic),
            None => not_compiled(variant),
        },
        (Kernel::Linear, Fields::CellLeastSquares, TransferKind::Flip) => {
            let fit = CellFit::Moving(CellLeastSquares(least_squares()));
            recipe.build(Linear, (fit, WholeCells::All), flip)
        }
        (Kernel::Linear, Fields::TaylorLeastSquares, TransferKind::Flip) => {
            let fit = CellFit::<basis::Linear, f64>::Taylor(TaylorLeastSquares::new());
            recipe.build(Linear, (fit, WholeCells::Internal), flip)
        }
        _ => not_compiled(variant),
    }
}

fn about_vertices(kernel: Kernel, settings: &Settings) -> Option<AboutVertices<f64>> {
    Some(match kernel {
        Kernel::Gimp => AboutVertices::Gimp(Gimp { length: settings.gimp_length }),
        Kernel::ConvectedGimp => AboutVertices::ConvectedGimp(ConvectedGimp::default()),
        Kernel::Staggered => AboutVertices::Staggered(Staggered),
        Kernel::Corrected => AboutVertices::Corrected(Corrected::default()),
        _ => return None,
    })
}

fn four_wide(kernel: Kernel) -> Option<FourWide<f64>> {
    Some(match kernel {
        Kernel::CubicBspline => FourWide::CubicBspline(CubicBspline),
        Kernel::DualDomain => FourWide::DualDomain(DualDomain::default()),
        _ => return None,
    })
}

fn quadratic(kernel: Kernel) -> Option<Quadratic<f64>> {
    Some(match kernel {
        Kernel::QuadraticBspline => Quadratic::Bspline(QuadraticBspline),
        Kernel::LeastSquares => Quadratic::LeastSquares(LeastSquares(QuadraticBspline)),
        _ => return None,
    })
}

fn not_compiled<const D: usize>(variant: Variant) -> Built<D> {
    let allowed = "a combination of parts that is compiled, see `src/variants/build.rs`";
    Err(InvalidInput::new("variant", variant.name(), allowed))
}

/// What a simulation is built from besides its types.
struct Recipe<'a, const D: usize> {
    scene: &'a Scene<D>,
    settings: &'a Settings,
    formulation: Formulation,
}

impl<const D: usize> Recipe<'_, D>
where
    basis::Linear: PolynomialBasis<f64, D>,
{
    fn scheme<S, R, Q, X>(
        &self,
        shape: S,
        (reconstruction, quadrature): (R, Q),
        transfer: X,
    ) -> Scheme<S, R, Q, X> {
        Scheme {
            shape,
            reconstruction,
            quadrature,
            transfer,
            formulation: self.formulation,
            stress_update: self.settings.stress_update,
        }
    }

    /// A method for every material, stress without energy having a state of its own.
    fn with_stress(
        &self,
        shape: impl ShapeFunction<f64> + 'static,
        fields: (impl Reconstruction<f64, D>, impl Quadrature<f64, D>),
        transfer: impl Transfer<f64, D>,
    ) -> Built<D> {
        let method = self.scheme(shape, fields, transfer);
        let general = self.is_general()?;
        #[expect(
            clippy::collapsible_if,
            reason = "a constant condition on its own: nothing of it is compiled for one dimension"
        )]
        if InSpace::<D>::HOLDS {
            if let Some(law) = self.deviatoric().filter(|_| !general) {
                return self.solve(method, law);
            }
        }
        self.solve_any(method)
    }

    /// A method for every material, stress always with room for the rest.
    fn build(
        &self,
        shape: impl ShapeFunction<f64> + 'static,
        fields: (impl Reconstruction<f64, D>, impl Quadrature<f64, D>),
        transfer: impl Transfer<f64, D>,
    ) -> Built<D> {
        self.solve_any(self.scheme(shape, fields, transfer))
    }

    fn deviatoric(&self) -> Option<Deviatoric<f64>> {
        let Scene { viscosity, shear_modulus, .. } = *self.scene;
        match (viscosity, shear_modulus) {
            (Some(viscosity), _) => Some(Deviatoric::Newtonian { viscosity }),
            (None, Some(shear_modulus)) => Some(Deviatoric::Elastic { shear_modulus }),
            (None, None) => None,
        }
    }

    /// Whether there is more than a linear law of pressure and stress.
    fn is_general(&self) -> Result<bool, InvalidInput> {
        let law = EquationOfState::<f64>::new(&self.scene.equation_of_state)?;
        let viscous_pressure = self.settings.bulk_viscosity.is_some();
        Ok(self.scene.energy || viscous_pressure || law.linear().is_none())
    }

    fn solve_any(&self, method: impl Method<f64, D>) -> Built<D> {
        let deviatoric = self.deviatoric();
        if deviatoric.is_none() && !self.is_general()? {
            return self.solve(method, Inviscid);
        }
        let volume: f64 = self.scene.grid.spacing.iter().product();
        let material = General {
            deviatoric,
            energy: self.scene.energy.then_some(self.settings.energy_update),
            bulk_viscosity: self.settings.bulk_viscosity,
            cell_size: volume.powf(1.0 / D as f64),
        };
        self.solve(method, material)
    }

    fn solve(&self, method: impl Method<f64, D>, material: impl Material<f64, D>) -> Built<D> {
        self.check_combination(&method)?;
        let mut solver = Solver::new(self.scene, method, material)?;
        solver.pressure_limiter = self.settings.pressure_limiter;
        solver.set_smoothing(self.settings)?;
        solver.set_affine_density(self.settings.affine_density, self.scene)?;
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
