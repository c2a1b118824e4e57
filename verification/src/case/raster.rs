//! A field or a classification on the cells of a plane grid, small enough to be put on record.

use std::io::{Read, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use serde::{Deserialize, Serialize};
use transpoint::InvalidInput;

/// One byte for each cell of a plane grid.
///
/// On record the bytes are deflated and written in base 64.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Packed", into = "Packed")]
pub struct Raster {
    /// What is shown, unique within the run.
    pub name: String,
    /// Cells along x.
    pub columns: usize,
    /// Cells along y.
    pub rows: usize,
    /// Lower left corner, m.
    pub origin: [f64; 2],
    /// Size of a cell, m.
    pub spacing: [f64; 2],
    /// Codes by rows from the bottom, each from the left. 0: the cell has no value. Of a field, 1:
    /// below `lower`, 2 to 255: evenly from `lower` to `upper` and above. Of classes, 1 + class.
    pub values: Vec<u8>,
    /// Lower end of a field, in its unit; 0 for classes.
    pub lower: f64,
    /// Upper end of a field, in its unit; the number of classes for classes.
    pub upper: f64,
}

/// The form on record.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Packed {
    name: String,
    columns: usize,
    rows: usize,
    origin: [f64; 2],
    spacing: [f64; 2],
    lower: f64,
    upper: f64,
    values: String,
}

impl Raster {
    /// Code of a cell without a value.
    pub const EMPTY: u8 = 0;
    /// Code of a value of a field below its lower end.
    pub const BELOW: u8 = 1;
    /// Code of the lower end of a field.
    pub const LOWER: u8 = 2;

    /// A field on `cells[0]` columns and `cells[1]` rows, cell by cell in the order of
    /// [`Raster::values`]; a value that is absent or not finite leaves its cell empty.
    ///
    /// `bounds` are the lower and upper end of the scale in the unit of the field; `origin` and
    /// `spacing` are in m.
    ///
    /// # Errors
    /// When the number of values is not that of the cells, or a number makes no grid or scale.
    pub fn field(
        name: impl Into<String>,
        cells: [usize; 2],
        origin: [f64; 2],
        spacing: [f64; 2],
        bounds: [f64; 2],
        values: &[Option<f64>],
    ) -> Result<Self, InvalidInput> {
        let [lower, upper] = bounds;
        let steps = f64::from(u8::MAX - Self::LOWER);
        let code = |value: &Option<f64>| match value {
            Some(value) if value.is_finite() && *value < lower => Self::BELOW,
            Some(value) if value.is_finite() => {
                // Conversion from `f64` saturates.
                let place = ((value - lower) / (upper - lower) * steps).round() as u8;
                Self::LOWER.saturating_add(place)
            }
            _ => Self::EMPTY,
        };
        let values = values.iter().map(code).collect();
        let [columns, rows] = cells;
        Self { name: name.into(), columns, rows, origin, spacing, values, lower, upper }.checked()
    }

    /// A class, below `n_classes`, for each of `cells[0]` columns and `cells[1]` rows, in the order
    /// of [`Raster::values`]; `origin` and `spacing` are in m.
    ///
    /// # Errors
    /// When the number of classes given is not that of the cells, a class is not below `n_classes`,
    /// or a number makes no grid.
    pub fn classes(
        name: impl Into<String>,
        cells: [usize; 2],
        origin: [f64; 2],
        spacing: [f64; 2],
        n_classes: u8,
        classes: &[Option<u8>],
    ) -> Result<Self, InvalidInput> {
        let name = name.into();
        if let Some(class) = classes.iter().flatten().find(|class| **class >= n_classes) {
            let field = format!("raster {name}, class");
            return Err(InvalidInput::new(field, class, format!("below {n_classes}")));
        }
        let values = classes.iter().map(|class| class.map_or(Self::EMPTY, |class| class + 1));
        let (lower, upper) = (0.0, f64::from(n_classes));
        let [columns, rows] = cells;
        Self { name, columns, rows, origin, spacing, values: values.collect(), lower, upper }
            .checked()
    }

    /// Width and height, m.
    pub fn extent(&self) -> [f64; 2] {
        [self.columns as f64 * self.spacing[0], self.rows as f64 * self.spacing[1]]
    }

    /// The same raster if its numbers fit together.
    ///
    /// # Errors
    /// Names the field that does not fit.
    pub fn checked(self) -> Result<Self, InvalidInput> {
        let fault = |field: &str, value: &dyn std::fmt::Display, allowed: String| {
            Err(InvalidInput::new(format!("raster {}, {field}", self.name), value, allowed))
        };
        for (field, count) in [("columns", self.columns), ("rows", self.rows)] {
            if !(1..=MOST).contains(&count) {
                return fault(field, &count, format!("1 to {MOST}"));
            }
        }
        let cells = self.columns * self.rows;
        if self.values.len() != cells {
            return fault("values", &self.values.len(), format!("{cells}, one for each cell"));
        }
        for origin in self.origin {
            if !origin.is_finite() {
                return fault("origin", &origin, "finite".to_owned());
            }
        }
        for spacing in self.spacing {
            if !(spacing > 0.0 && spacing.is_finite()) {
                return fault("spacing", &spacing, "positive and finite".to_owned());
            }
        }
        if !(self.lower < self.upper && self.lower.is_finite() && self.upper.is_finite()) {
            return fault("upper", &self.upper, format!("finite and above {}", self.lower));
        }
        Ok(self)
    }
}

/// Most cells along an axis: a picture has no more pixels.
const MOST: usize = 10_000;

impl From<Raster> for Packed {
    fn from(raster: Raster) -> Self {
        let Raster { name, columns, rows, origin, spacing, values, lower, upper } = raster;
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
        // Writing to memory does not fail; a truncated text would be refused when it is read.
        let _ = encoder.write_all(&values);
        let values = STANDARD.encode(encoder.finish().unwrap_or_default());
        Self { name, columns, rows, origin, spacing, lower, upper, values }
    }
}

impl TryFrom<Packed> for Raster {
    type Error = InvalidInput;

    fn try_from(packed: Packed) -> Result<Self, InvalidInput> {
        let Packed { name, columns, rows, origin, spacing, lower, upper, values } = packed;
        let fault = |error: &dyn std::fmt::Display| {
            let field = format!("raster {name}, values");
            InvalidInput::new(field, error, "bytes, deflated, in base 64")
        };
        let deflated = STANDARD.decode(values).map_err(|error| fault(&error))?;
        // One byte more than fits is enough to refuse the record.
        let most = columns.min(MOST) * rows.min(MOST) + 1;
        let mut values = Vec::new();
        ZlibDecoder::new(deflated.as_slice())
            .take(most as u64)
            .read_to_end(&mut values)
            .map_err(|error| fault(&error))?;
        Self { name, columns, rows, origin, spacing, values, lower, upper }.checked()
    }
}

#[cfg(test)]
mod tests;
