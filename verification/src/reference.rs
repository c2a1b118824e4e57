//! Outside truth: the data sets of `reference-data/`, compiled in and checked when they are read.
//!
//! A data set is refused where its header, a value, the order of its rows or its checksum differs
//! from what is declared, so that no check compares with numbers that nobody vouches for. What the
//! files hold and where they come from stands beside them.

pub mod channel;
pub mod cylinder;
pub mod dam_break;
pub mod lid_cavity;

use std::fmt::Write;

use sha2::{Digest, Sha256};
use transpoint::InvalidInput;

/// Checksums of all files, one line `<hexadecimal>  <path>` per file.
const CHECKSUMS: &str = include_str!("../../reference-data/SHA256SUMS");

/// How the values of the first column follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ascent {
    /// Each above the one before it.
    Strict,
    /// None below the one before it.
    Weak,
}

/// A file of `reference-data/` with what it must look like.
#[derive(Clone, Copy, Debug)]
pub struct DataSet {
    /// Path below `reference-data/`.
    pub path: &'static str,
    /// Its text.
    pub text: &'static str,
    /// Headings, each a name followed by its unit in brackets, `[-]` for none.
    pub columns: &'static [&'static str],
    /// Order of the first column.
    pub ascent: Ascent,
}

/// The values of a data set, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    path: &'static str,
    columns: &'static [&'static str],
    /// As long as there are columns each.
    rows: Vec<Vec<f64>>,
}

/// A curve of a data set.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Path of the file below `reference-data/`.
    pub path: &'static str,
    /// Heading of the abscissae, with the unit in brackets.
    pub abscissa: &'static str,
    /// Heading of the values, with the unit in brackets.
    pub ordinate: &'static str,
    /// Abscissae, ascending, and values; all finite.
    pub points: Vec<(f64, f64)>,
}

impl DataSet {
    /// Reads and checks the data set.
    ///
    /// # Errors
    /// Names the file, the line and the column where the text differs from the declaration, or the
    /// file alone where its checksum does.
    pub fn read(&self) -> Result<Table, InvalidInput> {
        let table = self.parse()?;
        self.check_sum()?;
        Ok(table)
    }

    fn parse(&self) -> Result<Table, InvalidInput> {
        let mut lines = self.text.lines().zip(1..);
        let (header, _) = lines.next().unwrap_or_default();
        self.check_header(header)?;
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (line, number) in lines {
            let row = self.parse_row(line, number)?;
            if let Some(before) = rows.last() {
                self.check_order(before[0], row[0], number)?;
            }
            rows.push(row);
        }
        Ok(Table { path: self.path, columns: self.columns, rows })
    }

    fn check_header(&self, header: &str) -> Result<(), InvalidInput> {
        self.check_count(header, 1)?;
        for (found, declared) in header.split(',').zip(self.columns) {
            if found != *declared {
                let allowed = format!("the heading is `{declared}`");
                return Err(InvalidInput::new(self.place(1, declared), found, allowed));
            }
        }
        Ok(())
    }

    fn parse_row(&self, line: &str, number: usize) -> Result<Vec<f64>, InvalidInput> {
        self.check_count(line, number)?;
        let value = |(found, column): (&str, &&str)| {
            found.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| {
                InvalidInput::new(self.place(number, column), found, "a finite number")
            })
        };
        line.split(',').zip(self.columns).map(value).collect()
    }

    fn check_count(&self, line: &str, number: usize) -> Result<(), InvalidInput> {
        let (found, declared) = (line.split(',').count(), self.columns.len());
        if found == declared {
            return Ok(());
        }
        let allowed = format!("{declared} columns are declared");
        Err(InvalidInput::new(self.place(number, "number of columns"), found, allowed))
    }

    fn check_order(&self, before: f64, value: f64, number: usize) -> Result<(), InvalidInput> {
        let (holds, relation) = match self.ascent {
            Ascent::Strict => (value > before, "above"),
            Ascent::Weak => (value >= before, "not below"),
        };
        if holds {
            return Ok(());
        }
        let allowed = format!("{relation} {before} of the line before");
        Err(InvalidInput::new(self.place(number, self.columns[0]), value, allowed))
    }

    fn check_sum(&self) -> Result<(), InvalidInput> {
        let found = hexadecimal(&Sha256::digest(self.text.as_bytes()));
        let declared = CHECKSUMS
            .lines()
            .filter_map(|line| line.split_once("  "))
            .find(|(_, path)| *path == self.path)
            .map_or("no line", |(sum, _)| sum);
        if found == declared {
            return Ok(());
        }
        let allowed = format!("SHA256SUMS has {declared}");
        Err(InvalidInput::new(format!("{}, SHA-256", self.path), found, allowed))
    }

    fn place(&self, line: usize, field: &str) -> String {
        format!("{}, line {line}, {field}", self.path)
    }
}

impl Table {
    /// The values of `ordinate` over those of `abscissa`, both headings as declared.
    ///
    /// # Errors
    /// When no column has that heading.
    pub fn series(&self, abscissa: &str, ordinate: &str) -> Result<Series, InvalidInput> {
        let (x, y) = (self.column(abscissa)?, self.column(ordinate)?);
        Ok(Series {
            path: self.path,
            abscissa: self.columns[x],
            ordinate: self.columns[y],
            points: self.rows.iter().map(|row| (row[x], row[y])).collect(),
        })
    }

    /// Index of a column.
    fn column(&self, heading: &str) -> Result<usize, InvalidInput> {
        self.columns.iter().position(|column| *column == heading).ok_or_else(|| {
            let field = format!("{}, heading", self.path);
            InvalidInput::new(field, heading, format!("one of {}", self.columns.join(", ")))
        })
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string does not fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(test)]
mod tests;
