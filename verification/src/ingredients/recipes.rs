//! The ingredients: what is changed, one at a time.

use std::marker::PhantomData;

use transpoint::basis::{Constant, Limiters, Linear, PolynomialBasis, Quadratic};
use transpoint::formulation::{Formulation, PointDivergence};
use transpoint::material::Inviscid;
use transpoint::method::Scheme;
use transpoint::quadrature::Mixed;
use transpoint::reconstruction::MovingLeastSquares;
use transpoint::transfer::Flip;
use transpoint::variants::{
    Blend, Fill, FillMass, FillPoints, Projection, ProjectionKind, Rearrangement, Shift,
    StressUpdate,
};
use transpoint::{InvalidInput, Scalar, Settings, Simulation, Solver, Variant};

use super::BASE;
use crate::cases::free_surface::{LEVERAGE, POSITIVITY, RELAXATION, is_modified_last};
use crate::problems::SetUp;
use transpoint::shape;

type Built = Result<Box<dyn Simulation<2>>, InvalidInput>;

/// One change to the base method or to the scene.
#[derive(Clone, Copy)]
pub struct Ingredient {
    /// Identifier in labels.
    pub name: &'static str,
    /// What is changed, for a reader.
    pub about: &'static str,
    /// Builds the simulation of a set-up with it.
    pub build: fn(&mut SetUp<2>) -> Built,
}

/// A method in place of the base.
macro_rules! method {
    ($variant:ident) => {
        |set_up| {
            // The policy of free surfaces, whose scenes alone have a relaxation of their own.
            let has_free_surface = matches!(set_up.settings.blend, Blend::RelaxationTime(_));
            if has_free_surface && is_modified_last(Variant::$variant) {
                set_up.settings.stress_update = StressUpdate::ModifiedLast;
            }
            Variant::$variant.build_2d(&set_up.scene, &set_up.settings)
        }
    };
}

/// The base with other settings or another scene.
macro_rules! changed {
    ($change:expr) => {
        |set_up| {
            let change: fn(&mut SetUp<2>) = $change;
            change(set_up);
            BASE.build_2d(&set_up.scene, &set_up.settings)
        }
    };
}

/// Every ingredient, the base first.
pub const INGREDIENTS: [Ingredient; 19] = [
    Ingredient { name: "none", about: "the method as it is", build: method!(TpmVpQuadratic) },
    Ingredient {
        name: "carried-fields",
        about: "carried values sampled at the points in place of fits (mpm-vp)",
        build: method!(MpmVp),
    },
    Ingredient {
        name: "carried-fields-gimp",
        about: "the same on uGIMP functions (gimp-vp)",
        build: method!(GimpVp),
    },
    Ingredient {
        name: "standard-formulation",
        about: "pressure and divergence at the points, no velocity-pressure formulation (tpm)",
        build: method!(Tpm),
    },
    Ingredient {
        name: "divergence-of-the-cell",
        about: "a point takes the divergence of its cell (tpm-vp0)",
        build: method!(TpmVpConstant),
    },
    Ingredient {
        name: "divergence-by-vertices",
        about: "divergence by the vertex mean (tpm-vp)",
        build: method!(TpmVp),
    },
    Ingredient {
        name: "constant-fits",
        about: "fits of a constant in place of linear ones",
        build: |set_up| recipe::<f64, Constant>(set_up, 1.0),
    },
    Ingredient {
        name: "quadratic-fits",
        about: "quadratic fits over 2 cells in place of linear ones over 1",
        build: |set_up| recipe::<f64, Quadratic>(set_up, 2.0),
    },
    Ingredient {
        name: "wider-support",
        about: "linear fits over 1.5 cells",
        build: changed!(|set_up| set_up.settings.support = 1.5),
    },
    Ingredient {
        name: "limited-fits",
        about: "limiters of positivity and leverage",
        build: changed!(|set_up| {
            set_up.settings.positivity = Some(POSITIVITY);
            set_up.settings.leverage = Some(LEVERAGE);
        }),
    },
    Ingredient {
        name: "projection",
        about: "full mass matrix by 4 terms in every 8th step",
        build: changed!(|set_up| {
            let kind = ProjectionKind::All;
            set_up.settings.projection = Some(Projection { kind, order: 4, interval: 8 });
        }),
    },
    Ingredient {
        name: "relaxation",
        about: "relaxation towards PIC with τ = 12 h/c₀",
        build: changed!(|set_up| {
            let dt = 1.0 / sound_speed(set_up);
            let spacing = set_up.scene.grid.spacing[0];
            set_up.settings.blend = Blend::RelaxationTime(RELAXATION * spacing * dt);
        }),
    },
    Ingredient {
        name: "density-diffusion",
        about: "diffusion of density with δ = 0.1",
        build: changed!(|set_up| set_up.settings.density_diffusion = Some(0.1)),
    },
    Ingredient {
        name: "viscosity",
        about: "a viscosity of 10⁻⁹ h c₀, too small to act",
        build: changed!(|set_up| {
            let spacing = set_up.scene.grid.spacing[0];
            set_up.scene.viscosity = Some(1e-9 * spacing * sound_speed(set_up));
        }),
    },
    Ingredient {
        name: "energy",
        about: "the energy equation, which this pressure does not depend on",
        build: changed!(|set_up| set_up.scene.energy = true),
    },
    Ingredient {
        name: "fill",
        about: "fractures filled with donated mass",
        build: changed!(|set_up| {
            let fill = Fill { points: FillPoints::Center, mass: FillMass::Donated };
            rearrangement(set_up).fill = Some(fill);
        }),
    },
    Ingredient {
        name: "shift",
        about: "points pushed apart in every 10th step",
        build: changed!(|set_up| {
            rearrangement(set_up).shift = Some(Shift { strength: 0.1, interval: 10 });
        }),
    },
    Ingredient {
        name: "single-precision",
        about: "f32 in place of f64",
        build: |set_up| recipe::<f32, Linear>(set_up, 1.0),
    },
    Ingredient {
        name: "room",
        about: "three times as many empty cells as the scene has in all, which active cells leave alone",
        build: changed!(add_room),
    },
];

fn rearrangement(set_up: &mut SetUp<2>) -> &mut Rearrangement {
    set_up.settings.rearrangement.get_or_insert_default()
}

fn sound_speed(set_up: &SetUp<2>) -> f64 {
    use transpoint::scene::EquationOfStateSpec as Law;
    match set_up.scene.equation_of_state {
        Law::WeaklyCompressible { sound_speed, .. } | Law::Tait { sound_speed, .. } => sound_speed,
        // The problems here are all of water.
        Law::StiffenedGas { .. } | Law::IdealGas { .. } => f64::NAN,
    }
}

/// Makes the grid three times larger upwards where its upper end is no periodic one; elsewhere nothing can be added.
fn add_room(set_up: &mut SetUp<2>) {
    if set_up.scene.boundaries[1][1] != transpoint::scene::Boundary::Periodic {
        set_up.scene.grid.cells[1] *= 4;
    }
}

/// The base method with fits of another basis or scalars of another type.
fn recipe<T: Scalar, B>(set_up: &mut SetUp<2>, support: f64) -> Built
where
    B: PolynomialBasis<T, 2>,
    Linear: PolynomialBasis<T, 2>,
{
    let settings: Settings = BASE.settings(&set_up.settings);
    let blend = settings.blend;
    let scheme = Scheme {
        shape: shape::Linear,
        reconstruction: MovingLeastSquares::<B, T> {
            support: T::lit(support * settings.support),
            limiters: Limiters {
                leverage: settings.leverage.map(T::lit),
                positivity: settings.positivity.map(T::lit),
            },
            basis: PhantomData,
        },
        quadrature: Mixed {
            point_volume: settings.point_volume,
            criterion: settings.boundary_criterion,
        },
        transfer: Flip { blend },
        formulation: Formulation::VelocityPressure(PointDivergence::Quadratic),
        stress_update: settings.stress_update,
    };
    Ok(Box::new(Solver::<T, 2, _, _>::new(&set_up.scene, scheme, Inviscid)?))
}
