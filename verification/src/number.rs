//! Numbers as text: the same bytes for the same value, on any machine.

/// Six significant digits: plain between 10⁻³ and 10⁶, scientific elsewhere; `NaN` if not finite.
///
/// ```
/// use verification::number::significant;
/// assert_eq!(significant(0.0034670012), "0.00346700");
/// assert_eq!(significant(1.0e-9), "1.00000e-9");
/// assert_eq!(significant(f64::INFINITY), "NaN");
/// ```
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "NaN".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs();
    if !(1e-3..1e6).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let digits_before = magnitude.log10().floor() as i32 + 1;
    format!("{value:.*}", usize::try_from(6 - digits_before).unwrap_or(0))
}

/// Three significant digits in scientific form, `–` if not finite.
pub fn scientific(value: f64) -> String {
    if value.is_finite() { format!("{value:.2e}") } else { "–".to_owned() }
}

/// Two decimals, for orders of convergence; `–` if not finite.
pub fn order(value: f64) -> String {
    // Adding zero turns −0 into 0.
    if value.is_finite() {
        format!("{:.2}", (value * 100.0).round() / 100.0 + 0.0)
    } else {
        "–".to_owned()
    }
}

/// An optional bound as short as it is exact; empty if absent.
pub fn bound(value: Option<f64>) -> String {
    let shortest = |value: f64| {
        if (1e-3..1e6).contains(&value.abs()) || value == 0.0 {
            format!("{value}")
        } else {
            format!("{value:e}")
        }
    };
    value.map(shortest).unwrap_or_default()
}

/// The smallest power of ten that is not below `value`: round-off is reported by its decade, so
/// that files do not change with the instruction set of the machine.
pub fn decade_above(value: f64) -> f64 {
    if value > 0.0 { 10f64.powi(value.log10().ceil() as i32) } else { value }
}

/// Numbers that JSON cannot hold are stored as `null`.
pub mod nullable {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    /// Writes a finite number, else `null`.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    /// Reads a number, or `null` as not a number.
    ///
    /// # Errors
    /// Those of the deserializer.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::<f64>::deserialize(deserializer)?.unwrap_or(f64::NAN))
    }
}
