//! The named methods: which parts each is put together from, and what it fixes of the settings.

// Unit tests build no variant: forty solvers would be compiled once more.
#[cfg(not(test))]
mod build;
mod parts;

use serde::{Deserialize, Serialize};

use crate::error::InvalidInput;
use crate::formulation::{Formulation, PointDivergence};
pub use crate::settings::{
    Blend, BoundaryCriterion, BulkViscosity, EnergyUpdate, Fill, FillMass, FillPoints, Overfill,
    PointVolume, PressureLimiter, Projection, ProjectionKind, Rearrangement, Settings, Shift,
    Split, StressUpdate,
};
pub use parts::{Fields, Kernel, Parts, TransferKind};

/// f of the averaged divergence: a hundredth of the point's own is kept against modes that the average does not
/// see.
const FBAR: f64 = 0.99;
/// δ of the density diffusion, as is usual in δ-SPH, \[Antuono2010\].
const DIFFUSION: f64 = 0.1;
/// θ and Λ of limited fits, ADR 0010.
const POSITIVITY: f64 = 0.8;
const LEVERAGE: f64 = 16.0;
/// The filter of what the nodes do not see.
const FILTER: Projection = Projection { kind: ProjectionKind::All, order: 3, interval: 8 };
/// The same for velocity and density.
const FILTER_BOTH: Projection = Projection { kind: ProjectionKind::AllAndDensity, ..FILTER };
/// N_m of crowded cells, four times a cell of 2 x 2 points.
const MOST_POINTS: u32 = 16;
/// Length in cells beyond which a lone point leaves a gap.
const LONE: f64 = 1.0;
/// Stretch in cells at which a point is split.
const SPLIT: f64 = 1.5;

const STANDARD: Formulation = Formulation::Standard;
const CONSTANT: Formulation = Formulation::VelocityPressure(PointDivergence::Constant);
const QUADRATIC: Formulation = Formulation::VelocityPressure(PointDivergence::Quadratic);
/// Velocity-pressure with the divergence at the points that the settings name.
const AS_SET: Formulation = Formulation::VelocityPressure(PointDivergence::VertexMean);

fn split(settings: &mut Settings, split: Split) {
    settings.rearrangement.get_or_insert_default().split = Some(split);
}

fn shift_by_overfill(settings: &mut Settings) {
    let rearrangement = settings.rearrangement.get_or_insert_default();
    rearrangement.overfill = Some(Overfill { interval: 1 });
}

/// Limited fits, one sample per cut cell, fractures filled with donated mass, and points pushed apart.
fn keep_even(settings: &mut Settings) {
    settings.positivity = Some(POSITIVITY);
    settings.leverage = Some(LEVERAGE);
    settings.point_volume = PointVolume::CellCenter;
    let rearrangement = settings.rearrangement.get_or_insert_default();
    rearrangement.fill = Some(Fill { points: FillPoints::Center, mass: FillMass::Donated });
    rearrangement.shift = Some(Shift { strength: 0.1, interval: 10 });
}

/// The same, with lone points split, crowded cells reduced, cut cells balanced, velocity and density filtered.
fn cell_adjoint(settings: &mut Settings) {
    keep_even(settings);
    split(settings, Split::Lone(LONE));
    settings.rearrangement.get_or_insert_default().most_points = Some(MOST_POINTS);
    settings.point_volume = PointVolume::Balanced;
    settings.projection = Some(FILTER_BOTH);
}

/// Defines the variants: one entry each, in the order of tables and legends.
macro_rules! variants {
    ($(
        $(#[$doc:meta])*
        $variant:ident = $name:literal, $about:literal,
            [$kernel:ident, $fields:ident, $transfer:ident, $formulation:ident], $fixes:expr;
    )*) => {
        /// A named method.
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
        )]
        #[serde(rename_all = "kebab-case")]
        pub enum Variant {
            $($(#[$doc])* $variant,)*
        }

        impl Variant {
            /// Every variant, in the order of tables and legends.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$variant),*];

            /// Identifier in command lines, tables and file names.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }

            /// One-line description with its source keys.
            pub const fn about(self) -> &'static str {
                match self {
                    $(Self::$variant => $about,)*
                }
            }

            /// What it is put together from.
            pub fn parts(self) -> Parts {
                match self {
                    $(Self::$variant => Parts {
                        kernel: Kernel::$kernel,
                        fields: Fields::$fields,
                        transfer: TransferKind::$transfer,
                        formulation: $formulation,
                        fixes: $fixes,
                    },)*
                }
            }
        }
    };
}

variants! {
    /// Transport point method as printed.
    Tpm = "tpm", "transport point method as printed [Song2020]",
        [Linear, TransportPoints, Flip, STANDARD], |_| {};

    /// TPM with the velocity-pressure formulation, divergence interpolated from cell centres.
    TpmVp = "tpm-vp", "TPM, velocity-pressure, divergence interpolated from cell centres",
        [Linear, TransportPoints, Flip, AS_SET], |_| {};

    /// Classic MPM: linear hat, FLIP.
    Mpm = "mpm", "material point method, linear hat, FLIP [Sulsky1994]",
        [Linear, Carried, Flip, STANDARD], |_| {};

    /// uGIMP, FLIP.
    Gimp = "gimp", "uniform generalized interpolation MPM, FLIP [Bardenhagen2004]",
        [Gimp, Carried, Flip, STANDARD], |_| {};

    /// Quadratic B-spline MPM, FLIP.
    Bspline2 = "bspline2", "quadratic B-spline MPM, FLIP [Steffen2008]",
        [QuadraticBspline, Carried, Flip, STANDARD], |_| {};

    /// Cubic B-spline MPM, FLIP.
    Bspline3 = "bspline3", "cubic B-spline MPM, FLIP [Steffen2008]",
        [CubicBspline, Carried, Flip, STANDARD], |_| {};

    /// Quadratic B-spline MPM with affine transfer.
    Apic = "apic", "quadratic B-spline MPM, affine transfer [Jiang2015]",
        [QuadraticBspline, Carried, Apic, STANDARD], |_| {};

    /// Linear MPM with the velocity-pressure formulation.
    MpmVp = "mpm-vp", "linear MPM, velocity-pressure formulation [Chen2018]",
        [Linear, Carried, Flip, CONSTANT], |_| {};

    /// TPM with the velocity-pressure formulation, divergence by quadratic B-splines about the cells.
    TpmVpQuadratic = "tpm-vp2", "TPM, velocity-pressure, divergence by quadratic B-splines",
        [Linear, TransportPoints, Flip, QUADRATIC], |_| {};

    /// TPM with the velocity-pressure formulation, divergence of the point's cell.
    TpmVpConstant = "tpm-vp0", "TPM, velocity-pressure, divergence constant in each cell",
        [Linear, TransportPoints, Flip, CONSTANT], |_| {};

    /// uGIMP with the velocity-pressure formulation.
    GimpVp = "gimp-vp", "uGIMP, velocity-pressure formulation [Bardenhagen2004] [Chen2018]",
        [Gimp, Carried, Flip, CONSTANT], |_| {};

    /// Quadratic B-spline MPM, PIC.
    Pic = "pic", "quadratic B-spline MPM, PIC [Harlow1964]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.blend = Blend::PerStep(0.0);

    /// Linear MPM, stress updated first.
    MpmUsf = "mpm-usf", "linear MPM, FLIP, stress updated first [Bardenhagen2002]",
        [Linear, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::First;

    /// Linear MPM, stress updated modified-last.
    MpmMusl = "mpm-musl", "linear MPM, FLIP, stress updated modified-last [Sulsky1995]",
        [Linear, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::ModifiedLast;

    /// uGIMP, stress updated first.
    GimpUsf = "gimp-usf", "uGIMP, FLIP, stress updated first [Bardenhagen2002]",
        [Gimp, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::First;

    /// uGIMP, stress updated modified-last.
    GimpMusl = "gimp-musl", "uGIMP, FLIP, stress updated modified-last [Sulsky1995]",
        [Gimp, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::ModifiedLast;

    /// Quadratic B-spline MPM, stress updated first.
    Bspline2Usf = "bspline2-usf", "quadratic B-spline MPM, FLIP, stress updated first [Bardenhagen2002]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::First;

    /// Quadratic B-spline MPM, stress updated modified-last.
    Bspline2Musl = "bspline2-musl", "quadratic B-spline MPM, FLIP, stress updated modified-last [Sulsky1995]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.stress_update = StressUpdate::ModifiedLast;

    /// cpGIMP, FLIP.
    ConvectedGimp = "cpgimp", "contiguous-particle GIMP, boxes stretched by the flow, FLIP [Bardenhagen2004]",
        [ConvectedGimp, Carried, Flip, STANDARD], |_| {};

    /// Dual domain MPM, FLIP.
    DualDomain = "ddmp", "dual domain MPM, axis by axis, FLIP [Zhang2011]",
        [DualDomain, Carried, Flip, STANDARD], |_| {};

    /// Staggered-grid MPM, FLIP.
    Staggered = "sgmp", "staggered-grid MPM, FLIP [Liang2019]",
        [Staggered, Carried, Flip, STANDARD], |_| {};

    /// Quadratic B-splines about the vertices with boundary-corrected kernels, FLIP.
    Corrected = "corrected", "quadratic B-splines, kernels corrected at surface and walls, FLIP [Nakamura2023]",
        [Corrected, Carried, Flip, STANDARD], |_| {};

    /// Quadratic B-spline MPM with Taylor transfer.
    Tpic = "tpic", "quadratic B-spline MPM, Taylor transfer [Nakamura2023]",
        [QuadraticBspline, Carried, Tpic, STANDARD], |_| {};

    /// MLS-MPM: affine transfer, gradients by least squares over the nodes.
    MlsMpm = "mls-mpm", "moving-least-squares MPM, affine transfer [Hu2018]",
        [LeastSquares, Carried, Tpic, STANDARD], |_| {};

    /// XPIC(2) with quadratic B-splines.
    Xpic2 = "xpic2", "quadratic B-spline MPM, XPIC(2) [Hammerquist2017]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.projection = Some(Projection { kind: ProjectionKind::Velocity, order: 2, interval: 1 });

    /// XPIC(5) with quadratic B-splines.
    Xpic5 = "xpic5", "quadratic B-spline MPM, XPIC(5) [Hammerquist2017]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.projection = Some(Projection { kind: ProjectionKind::Velocity, order: 5, interval: 1 });

    /// FMPM(2) with quadratic B-splines.
    Fmpm2 = "fmpm2", "quadratic B-spline MPM, FMPM(2) [Nairn2021]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.projection = Some(Projection { kind: ProjectionKind::All, order: 2, interval: 1 });

    /// FMPM(4) with quadratic B-splines.
    Fmpm4 = "fmpm4", "quadratic B-spline MPM, FMPM(4) [Nairn2021]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.projection = Some(Projection { kind: ProjectionKind::All, order: 4, interval: 1 });

    /// FLIP, and FMPM(4) in every eighth step, with quadratic B-splines.
    Fmpm4Periodic = "fmpm4-periodic", "quadratic B-spline MPM, FLIP with FMPM(4) in every 8th step [Nairn2021]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.projection = Some(Projection { kind: ProjectionKind::All, order: 4, interval: 8 });

    /// Quadratic B-spline MPM, FLIP, with volume-averaged F-bar.
    Bspline2Fbar = "bspline2-fbar", "quadratic B-spline MPM, FLIP, volume-averaged F-bar [Zhao2023]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| s.dilation = Some(FBAR);

    /// Quadratic B-spline MPM with Taylor transfer and volume-averaged F-bar.
    TpicFbar = "tpic-fbar", "quadratic B-spline MPM, Taylor transfer, volume-averaged F-bar [Nakamura2023] [Zhao2023]",
        [QuadraticBspline, Carried, Tpic, STANDARD], |s| s.dilation = Some(FBAR);

    /// Quadratic B-spline MPM with Taylor transfer, averaged divergence and points pushed out of overfull nodes.
    TpicFbarOverfill = "tpic-fbar-overfill",
        "`tpic-fbar`, points shifted where nodes are overfull [Baumgarten2023]",
        [QuadraticBspline, Carried, Tpic, STANDARD], |s| {
            s.dilation = Some(FBAR);
            shift_by_overfill(s);
        };

    /// Linear MPM with adaptive splitting.
    MpmSplit = "mpm-split", "linear MPM, FLIP, points split by their stretch [Ma2009]",
        [Linear, Carried, Flip, STANDARD], |s| split(s, Split::Stretch(SPLIT));

    /// Linear MPM, velocity-pressure, pressure slopes limited over the neighbours.
    MpmVpBj = "mpm-vp-bj", "linear MPM, velocity-pressure, Barth-Jespersen limiter [Chen2018] [BarthJespersen1989]",
        [Linear, Carried, Flip, CONSTANT], |s| s.pressure_limiter = Some(PressureLimiter::BarthJespersen);

    /// Linear MPM, velocity-pressure, pressure slopes limited axis by axis.
    MpmVpMc = "mpm-vp-mc", "linear MPM, velocity-pressure, monotonized central limiter [Chen2018] [VanLeer1977]",
        [Linear, Carried, Flip, CONSTANT], |s| s.pressure_limiter = Some(PressureLimiter::PerAxis);

    /// Improved MPM of Sulsky and Gong: least squares at cell centres, Gauss quadrature.
    SulskyGong = "sulsky-gong", "least squares at cell centres, Gauss quadrature, FLIP [SulskyGong2016]",
        [Linear, CellLeastSquares, Flip, STANDARD], |_| {};

    /// Conservative Taylor least squares, FLIP.
    TaylorLeastSquares = "ctls", "conservative Taylor least squares in each cell, FLIP [Wobbes2019]",
        [Linear, TaylorLeastSquares, Flip, STANDARD], |_| {};

    /// `tpm-vp2` with a projection of the velocity in every eighth step.
    TpmVpFmpm = "tpm-vp2-fmpm", "`tpm-vp2`, the null space filtered by FMPM(3) in every 8th step [Nairn2021]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| s.projection = Some(FILTER);

    /// `tpm-vp2` with diffusion of density between cells.
    TpmVpDiffusion = "tpm-vp2-diffusion", "`tpm-vp2`, density diffused between full cells [Antuono2010]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| s.density_diffusion = Some(DIFFUSION);

    /// Quadratic B-spline MPM, FLIP, points pushed out of overfull nodes.
    Bspline2Overfill = "bspline2-overfill", "quadratic B-spline MPM, FLIP, points shifted where nodes are overfull [Baumgarten2023]",
        [QuadraticBspline, Carried, Flip, STANDARD], |s| shift_by_overfill(s);

    /// `tpm-vp2` whose points are kept even.
    TpmVpEven = "tpm-vp2-even", "`tpm-vp2`, fits limited, fractures filled, points pushed apart in every 10th step [Song2020]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| keep_even(s);

    /// Cell-adjoint transport points: `tpm-vp2-even`, velocity and density filtered, cut cells balanced.
    CellAdjoint = "catp", "`tpm-vp2-even`, velocity and density filtered in every 8th step, cut cells balanced [Nairn2021]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| cell_adjoint(s);

    /// `tpm-vp2` with affine density.
    TpmAffine = "tpm-affine", "`tpm-vp2`, points carry the slope of their density [Jiang2015]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| s.affine_density = true;

    /// `catp` with affine density.
    CellAdjointAffine = "catp-affine", "`catp`, points carry the slope of their density [Jiang2015]",
        [Linear, TransportPoints, Flip, QUADRATIC], |s| {
            cell_adjoint(s);
            s.affine_density = true;
        };
}

impl Variant {
    /// The transport point methods and the classic ones: those that every study compares.
    pub const CORE: [Self; 11] = {
        let mut core = [Self::Tpm; 11];
        let mut k = 0;
        while k < core.len() {
            core[k] = Self::ALL[k];
            k += 1;
        }
        core
    };

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

    /// The settings with which it runs: those given, with what the variant fixes.
    pub fn settings(self, given: &Settings) -> Settings {
        let mut settings = *given;
        (self.parts().fixes)(&mut settings);
        settings
    }
}
