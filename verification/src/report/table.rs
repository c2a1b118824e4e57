//! Tables: CSV to compute with, Markdown and terminal text to read.

use anyhow::{Result, anyhow};

use crate::number;

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A name.
    Text(String),
    /// A measured value: six digits in CSV, three in Markdown.
    Value(f64),
    /// An observed order: six digits in CSV, two decimals in Markdown.
    Order(f64),
    /// A measured value of everyday size: six digits in CSV, two decimals in Markdown.
    Decimal(f64),
    /// A count.
    Count(u64),
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl Cell {
    fn exact(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Value(value) | Self::Order(value) | Self::Decimal(value) => {
                number::significant(*value)
            }
            Self::Count(count) => count.to_string(),
        }
    }

    fn readable(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Value(value) => number::scientific(*value),
            Self::Order(value) | Self::Decimal(value) => number::order(*value),
            Self::Count(count) => count.to_string(),
        }
    }
}

/// A table with a line of explanation.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Column headings.
    pub columns: Vec<String>,
    /// Rows, each as long as the headings.
    pub rows: Vec<Vec<Cell>>,
    /// Printed below the Markdown form: settings and units.
    pub note: String,
}

impl Table {
    /// As CSV.
    ///
    /// # Errors
    /// When the rows differ in length.
    pub fn csv(&self) -> Result<Vec<u8>> {
        let rows = self.rows.iter().map(|row| row.iter().map(Cell::exact).collect());
        csv(&self.columns, rows)
    }

    /// As a Markdown table with its note.
    pub fn markdown(&self) -> String {
        let mut text = markdown(
            &self.columns,
            self.rows.iter().map(|row| row.iter().map(Cell::readable).collect()),
        );
        if !self.note.is_empty() {
            text = text + "\n" + &self.note + "\n";
        }
        text
    }
}

/// Rows of text as CSV.
///
/// # Errors
/// When the rows differ in length.
pub fn csv<S: AsRef<str>>(
    columns: &[S],
    rows: impl Iterator<Item = Vec<String>>,
) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|column| column.as_ref().as_bytes()))?;
    for row in rows {
        writer.write_record(&row)?;
    }
    writer.into_inner().map_err(|error| anyhow!("cannot assemble CSV: {error}"))
}

/// Rows of text as a Markdown table.
pub fn markdown<S: AsRef<str>>(columns: &[S], rows: impl Iterator<Item = Vec<String>>) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        let cells: Vec<_> = cells.map(|cell| cell.replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let mut text = line(&mut columns.iter().map(|column| column.as_ref().to_owned()));
    text += &line(&mut columns.iter().map(|_| "---".to_owned()));
    for row in rows {
        text += &line(&mut row.into_iter());
    }
    text
}

/// Rows of text as a table for the terminal.
pub fn terminal<S: AsRef<str>>(columns: &[S], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut table = comfy_table::Table::new();
    table
        .load_style(comfy_table::presets::UTF8_BORDERS_ONLY)
        .set_header(columns.iter().map(AsRef::as_ref));
    for row in rows {
        table.add_row(row);
    }
    table.to_string()
}
