//! What Riemann problems of all fluids share.

/// A wave that leaves the interface of a Riemann problem; speeds in m/s, positive to the right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wave {
    /// A jump.
    Shock {
        /// Speed of the jump, m/s.
        speed: f64,
    },
    /// A centered rarefaction, continuous, with a straight characteristic per value of x/t.
    Fan {
        /// Speed of the edge at the undisturbed state, m/s.
        head: f64,
        /// Speed of the edge at the star state, m/s.
        tail: f64,
    },
}

impl Wave {
    /// Speed of the edge at the undisturbed state, m/s.
    pub fn head(self) -> f64 {
        match self {
            Self::Shock { speed } => speed,
            Self::Fan { head, .. } => head,
        }
    }

    /// Speed of the edge at the star state, m/s.
    pub fn tail(self) -> f64 {
        match self {
            Self::Shock { speed } => speed,
            Self::Fan { tail, .. } => tail,
        }
    }

    /// Is it a jump?
    pub fn is_shock(self) -> bool {
        matches!(self, Self::Shock { .. })
    }

    /// The wave seen in a mirror: all speeds change sign.
    pub(super) fn mirrored(self) -> Self {
        match self {
            Self::Shock { speed } => Self::Shock { speed: -speed },
            Self::Fan { head, tail } => Self::Fan { head: -head, tail: -tail },
        }
    }
}

/// ln(a / b) of positive numbers, accurate also where a is close to b.
pub(super) fn log_ratio(a: f64, b: f64) -> f64 {
    if (a - b).abs() < 0.5 * b { ((a - b) / b).ln_1p() } else { a.ln() - b.ln() }
}
