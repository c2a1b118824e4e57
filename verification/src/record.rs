//! Records of finished runs, written at once and whole, so that an interrupt loses nothing.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};

use crate::case::{Outcome, Profile, Raster, Row, RunSpec};
use crate::machine::Manifest;
use crate::number::{nullable, significant};

/// A finished run: what was asked, what came out, and on which machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunRecord {
    /// What was run.
    pub spec: RunSpec,
    /// Content key, see [`RunSpec::key`].
    pub key: String,
    /// How the run ended.
    pub outcome: Outcome,
    /// The measured numbers.
    pub rows: Vec<Row>,
    /// Sampled curves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profiles: Vec<Profile>,
    /// Fields and classifications on the cells of a plane grid.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rasters: Vec<Raster>,
    /// Work and event counters by name.
    pub counters: BTreeMap<String, u64>,
    /// Wall time of the work itself, s.
    #[serde(with = "nullable")]
    pub seconds: f64,
    /// Program, compiler and machine.
    pub manifest: Manifest,
}

impl RunRecord {
    /// The row of that quantity and norm.
    pub fn row(&self, quantity: &str, norm: &str) -> Option<&Row> {
        self.rows.iter().find(|row| row.quantity == quantity && row.norm == norm)
    }

    /// The curve of that name.
    pub fn profile(&self, name: &str) -> Option<&Profile> {
        self.profiles.iter().find(|profile| profile.name == name)
    }

    /// The raster of that name.
    pub fn raster(&self, name: &str) -> Option<&Raster> {
        self.rasters.iter().find(|raster| raster.name == name)
    }

    /// Wall time per point and step, s; not a number if no step was taken.
    pub fn seconds_per_point_step(&self) -> f64 {
        match self.counters.get("n_point_updates") {
            Some(&updates) if updates > 0 => self.seconds / updates as f64,
            _ => f64::NAN,
        }
    }
}

/// The folder `<out>/runs`: one JSON record and one tidy CSV per run, named by the run.
#[derive(Clone, Debug)]
pub struct Store {
    root: PathBuf,
}

impl Store {
    /// The store below the output folder; nothing is created yet.
    pub fn new(out: &Path) -> Self {
        Self { root: out.join("runs") }
    }

    /// Where the record of a run is kept.
    pub fn path(&self, spec: &RunSpec) -> PathBuf {
        self.root.join(&spec.case).join(format!("{}.json", spec.slug()))
    }

    /// Reads the record of a run; `None` if there is none.
    ///
    /// # Errors
    /// When the file cannot be read or is not a record.
    pub fn read(&self, spec: &RunSpec) -> Result<Option<RunRecord>> {
        let path = self.path(spec);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => {
                return Err(error).with_context(|| format!("cannot read {}", path.display()));
            }
        };
        serde_json::from_str(&text)
            .map(Some)
            .with_context(|| format!("{} is not a run record", path.display()))
    }

    /// Writes a record: first the tidy CSV, then the JSON file, whose presence means "finished".
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn write(&self, record: &RunRecord) -> Result<()> {
        let path = self.path(&record.spec);
        write_whole(&path.with_extension("csv"), &tidy_csv([record])?)?;
        let mut json = serde_json::to_vec_pretty(record)?;
        json.push(b'\n');
        write_whole(&path, &json)
    }
}

/// Rows of several runs as CSV, one measured number per line, without times or machine facts.
///
/// # Errors
/// When the text cannot be assembled.
pub fn tidy_csv<'a>(records: impl IntoIterator<Item = &'a RunRecord>) -> Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "case", "variant", "layout", "labels", "level", "spacing", "quantity", "norm", "value",
        "scale",
    ])?;
    for record in records {
        let spec = &record.spec;
        let labels: Vec<_> =
            spec.labels.iter().map(|(name, value)| format!("{name}={value}")).collect();
        for row in &record.rows {
            writer.write_record([
                spec.case.as_str(),
                &spec.variant,
                &spec.layout,
                &labels.join(" "),
                &spec.level.to_string(),
                &spec.spacing.to_string(),
                &row.quantity,
                &row.norm,
                &significant(row.value),
                &significant(row.scale),
            ])?;
        }
    }
    writer.into_inner().map_err(|error| anyhow::anyhow!("cannot assemble CSV: {error}"))
}

/// Writes a file under a temporary name in the same folder and renames it, creating folders.
///
/// # Errors
/// When the folder or the file cannot be written; names it.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)
        .with_context(|| format!("cannot create {}", folder.display()))?;
    let name = || format!("cannot write {}", path.display());
    let mut file =
        tempfile::Builder::new().prefix(".tmp-").tempfile_in(folder).with_context(name)?;
    file.write_all(bytes).with_context(name)?;
    set_readable(file.as_file()).with_context(name)?;
    file.persist(path).with_context(name)?;
    Ok(())
}

/// Temporary files are private to their owner; results are not.
#[cfg(unix)]
fn set_readable(file: &std::fs::File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn set_readable(_file: &std::fs::File) -> std::io::Result<()> {
    Ok(())
}
