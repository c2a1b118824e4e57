//! Axes: range, ticks and the map from values to pixels.

/// How values are spaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithm; values that are not positive are gaps.
    Log,
}

/// An axis as a case asks for it; the range follows from the data.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// Spacing of values.
    pub scale: Scale,
    /// Values to label; empty: chosen from the range.
    pub ticks: Vec<f64>,
}

impl Axis {
    /// A logarithmic axis.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, ticks: Vec::new() }
    }

    /// A linear axis.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, ticks: Vec::new() }
    }

    /// The same axis with labels at these values.
    #[must_use]
    pub fn with_ticks(mut self, ticks: impl Into<Vec<f64>>) -> Self {
        self.ticks = ticks.into();
        self
    }
}

/// An axis with its range, mapped to pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Ruler {
    scale: Scale,
    /// Range, transformed by the scale.
    range: (f64, f64),
    pixels: (i32, i32),
    ticks: Vec<f64>,
    style: TickStyle,
}

/// How labels are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TickStyle {
    /// As decimals where that is short.
    Decimal,
    /// As powers of ten.
    Power,
}

impl Ruler {
    /// Fits the range to the values: `margins` are the fractions of the span left free below and
    /// above. `pixels` are the places of the lower and upper end.
    pub fn fit(
        axis: &Axis,
        values: impl Iterator<Item = f64>,
        margins: (f64, f64),
        pixels: (i32, i32),
    ) -> Self {
        let mut range = values
            .chain(axis.ticks.iter().copied())
            .filter_map(|value| transform(axis.scale, value))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        if range.0 > range.1 {
            range = (0.0, 1.0);
        }
        // A span that is too small would show round-off, or nothing at all.
        let least = match axis.scale {
            Scale::Log => 0.1,
            Scale::Linear => 1e-12_f64.max(1e-6 * range.1.abs()),
        };
        let missing = 0.5 * (least - (range.1 - range.0)).max(0.0);
        range = (range.0 - missing, range.1 + missing);
        let span = range.1 - range.0;
        range = (range.0 - margins.0 * span, range.1 + margins.1 * span);
        let ticks = if axis.ticks.is_empty() {
            automatic_ticks(axis.scale, range)
        } else {
            axis.ticks.clone()
        };
        let style = match axis.scale {
            Scale::Log if axis.ticks.is_empty() => TickStyle::Power,
            _ => TickStyle::Decimal,
        };
        Self { scale: axis.scale, range, pixels, ticks, style }
    }

    /// Pixel of a value; `None` where it has no place on this axis.
    pub fn pixel(&self, value: f64) -> Option<i32> {
        transform(self.scale, value).map(|value| self.place(value))
    }

    /// Pixel of a transformed value (the logarithm to base 10 on a logarithmic axis).
    pub fn place(&self, transformed: f64) -> i32 {
        let fraction = (transformed - self.range.0) / (self.range.1 - self.range.0);
        let (low, high) = (f64::from(self.pixels.0), f64::from(self.pixels.1));
        (low + fraction.clamp(-10.0, 10.0) * (high - low)).round() as i32
    }

    /// Lower and upper end, transformed by the scale.
    pub fn range(&self) -> (f64, f64) {
        self.range
    }

    /// Spacing of values.
    pub fn scale(&self) -> Scale {
        self.scale
    }

    /// Pixel and text of each labelled value within the range.
    pub fn labels(&self) -> Vec<(i32, String)> {
        let within = |value: &&f64| {
            transform(self.scale, **value)
                .is_some_and(|value| (self.range.0..=self.range.1).contains(&value))
        };
        self.ticks
            .iter()
            .filter(within)
            .filter_map(|&value| Some((self.pixel(value)?, label(self.style, value))))
            .collect()
    }

    /// Pixels of the unlabelled ticks 2…9 of each decade of a logarithmic axis.
    pub fn minor_ticks(&self) -> Vec<i32> {
        if self.scale == Scale::Linear {
            return Vec::new();
        }
        let (first, last) = (self.range.0.floor() as i32, self.range.1.ceil() as i32);
        (first..last)
            .flat_map(|decade| (2..10).map(move |digit| f64::from(digit) * 10f64.powi(decade)))
            .filter(|value| (self.range.0..=self.range.1).contains(&value.log10()))
            .filter_map(|value| self.pixel(value))
            .collect()
    }
}

fn transform(scale: Scale, value: f64) -> Option<f64> {
    let transformed = match scale {
        Scale::Linear => value,
        Scale::Log => value.log10(),
    };
    (transformed.is_finite() && (scale == Scale::Linear || value > 0.0)).then_some(transformed)
}

fn automatic_ticks(scale: Scale, range: (f64, f64)) -> Vec<f64> {
    match scale {
        Scale::Log => {
            let decades = range.0.floor() as i32..=range.1.ceil() as i32;
            let every = ((range.1 - range.0) / 8.0).ceil().max(1.0) as i32;
            let digits: &[f64] = if range.1 - range.0 < 1.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
            decades
                .filter(|decade| decade.rem_euclid(every) == 0)
                .flat_map(|decade| digits.iter().map(move |digit| digit * 10f64.powi(decade)))
                .collect()
        }
        Scale::Linear => {
            let raw = (range.1 - range.0) / 6.0;
            let power = 10f64.powf(raw.log10().floor());
            let step = [1.0, 2.0, 5.0, 10.0]
                .into_iter()
                .map(|factor| factor * power)
                .find(|step| *step >= raw)
                .unwrap_or(raw);
            let first = (range.0 / step).ceil() as i64;
            let last = (range.1 / step).floor() as i64;
            (first..=last).map(|i| i as f64 * step).collect()
        }
    }
}

/// Powers of ten with raised digits if so wanted, other values as short as they are exact to six
/// digits.
fn label(style: TickStyle, value: f64) -> String {
    let exponent = value.abs().log10();
    let is_power = (exponent - exponent.round()).abs() < 1e-9;
    if style == TickStyle::Power && is_power && !(-0.5..1.5).contains(&exponent) {
        return format!("10{}", raised(exponent.round() as i32));
    }
    if value != 0.0 && !(-3.5..6.0).contains(&exponent) {
        let power = exponent.floor() as i32;
        let mantissa = (value / 10f64.powi(power) * 1e5).round() / 1e5;
        return format!("{mantissa}·10{}", raised(power));
    }
    // Rounding to 12 places hides the last bits of multiples of a step.
    format!("{}", (value * 1e12).round() / 1e12)
}

fn raised(exponent: i32) -> String {
    let raise = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        '9' => '⁹',
        _ => '⁰',
    };
    exponent.to_string().chars().map(raise).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_short_and_exact() {
        assert_eq!(label(TickStyle::Power, 1e-4), "10⁻⁴");
        assert_eq!(label(TickStyle::Decimal, 0.004), "0.004");
        assert_eq!(label(TickStyle::Decimal, 0.1 + 0.2), "0.3");
        assert_eq!(label(TickStyle::Power, 2e-5), "2·10⁻⁵");
        assert_eq!(label(TickStyle::Decimal, 0.0), "0");
    }

    #[test]
    fn a_ruler_leaves_out_what_has_no_place() {
        let axis = Axis::log("x");
        let ruler = Ruler::fit(&axis, [0.0, f64::NAN, 1e-3, 1e1].into_iter(), (0.0, 0.0), (0, 400));
        assert_eq!(ruler.pixel(0.0), None);
        assert_eq!(ruler.pixel(1e-1), Some(200));
        assert_eq!(ruler.labels().len(), 5);
    }

    #[test]
    fn no_data_and_one_value_still_make_an_axis() {
        for values in [vec![], vec![3.0]] {
            let ruler = Ruler::fit(&Axis::linear("x"), values.into_iter(), (0.1, 0.1), (0, 100));
            assert!(ruler.pixel(0.5).is_some());
            assert!(ruler.labels().len() < 20);
        }
    }
}
