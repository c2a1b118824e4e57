//! The methods compared and the dissipation that each is given.

use transpoint::variants::{Blend, BulkViscosity, PressureLimiter, StressUpdate};
use transpoint::{Settings, Variant};

/// τ = 2 h/c₀, s: at the Courant number of this case a PIC share of 0.1 per step.
pub(super) const RELAXATION_TIME: f64 = 4e-5;
/// Bulk viscosity of all viscous runs. In expansion too: the rarefaction is as steep as the shock.
pub(super) const BULK_VISCOSITY: BulkViscosity =
    BulkViscosity { linear: 0.25, quadratic: 1.5, expansion: true };

/// What damps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dissipation {
    /// Nothing: pure FLIP.
    Flip,
    /// Nothing but the affine transfer itself.
    Affine,
    /// A relaxation towards PIC.
    Relaxed,
    /// Bulk viscosity.
    Viscous,
}

impl Dissipation {
    /// The value of the label `dissipation`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::Affine => "affine",
            Self::Relaxed => "relaxed",
            Self::Viscous => "viscous",
        }
    }
}

/// A method under its name in this case.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    /// Name in tables and legends.
    pub(super) name: &'static str,
    /// The library's variant.
    pub(super) variant: Variant,
    stress_update: StressUpdate,
    pressure_limiter: Option<PressureLimiter>,
    /// The dissipations that it runs with.
    pub(super) dissipations: &'static [Dissipation],
}

const ALL: &[Dissipation] = &[Dissipation::Flip, Dissipation::Relaxed, Dissipation::Viscous];

impl Method {
    /// A variant with what it fixes itself.
    pub(super) const fn of(variant: Variant) -> Self {
        Self {
            name: variant.name(),
            variant,
            stress_update: StressUpdate::Last,
            pressure_limiter: None,
            dissipations: ALL,
        }
    }

    const fn limited(name: &'static str, variant: Variant, limiter: PressureLimiter) -> Self {
        Self {
            name,
            pressure_limiter: Some(limiter),
            dissipations: &[Dissipation::Flip, Dissipation::Relaxed],
            ..Self::of(variant)
        }
    }

    const fn modified_last(name: &'static str, variant: Variant) -> Self {
        Self { name, stress_update: StressUpdate::ModifiedLast, ..Self::of(variant) }
    }

    /// The settings of a run.
    pub(super) fn settings(&self, dissipation: Dissipation) -> Settings {
        let pure = Settings {
            stress_update: self.stress_update,
            pressure_limiter: self.pressure_limiter,
            ..Settings::default()
        };
        match dissipation {
            Dissipation::Flip | Dissipation::Affine => pure,
            Dissipation::Relaxed => {
                Settings { blend: Blend::RelaxationTime(RELAXATION_TIME), ..pure }
            }
            Dissipation::Viscous => Settings { bulk_viscosity: Some(BULK_VISCOSITY), ..pure },
        }
    }

    /// Whether the run belongs to the smoke tier: the runs with goals and one that rings.
    pub(super) fn in_smoke(&self, dissipation: Dissipation) -> bool {
        matches!(
            (self.name, dissipation),
            ("tpm-vp0", Dissipation::Relaxed | Dissipation::Viscous)
                | ("mpm-vp", Dissipation::Flip)
        )
    }
}

/// Every method, in the order of the table.
pub(super) static METHODS: [Method; 15] = [
    Method::of(Variant::Tpm),
    Method::of(Variant::TpmVpConstant),
    Method::of(Variant::TpmVp),
    Method::of(Variant::TpmVpQuadratic),
    Method::of(Variant::Mpm),
    Method::of(Variant::MpmVp),
    Method::of(Variant::Gimp),
    Method::of(Variant::Bspline2),
    Method {
        dissipations: &[Dissipation::Affine, Dissipation::Viscous],
        ..Method::of(Variant::Apic)
    },
    Method::limited("tpm-vp0-bj", Variant::TpmVpConstant, PressureLimiter::BarthJespersen),
    Method::limited("tpm-vp0-mc", Variant::TpmVpConstant, PressureLimiter::PerAxis),
    Method::limited("mpm-vp-bj", Variant::MpmVp, PressureLimiter::BarthJespersen),
    Method::limited("mpm-vp-mc", Variant::MpmVp, PressureLimiter::PerAxis),
    Method::modified_last("tpm-vp0-musl", Variant::TpmVpConstant),
    Method::modified_last("mpm-vp-musl", Variant::MpmVp),
];
