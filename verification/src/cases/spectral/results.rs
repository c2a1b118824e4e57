//! From the records of this case to checks, a figure and tables.

use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::Artifact;

pub(super) fn checks(_records: &[RunRecord]) -> Vec<Check> {
    Vec::new()
}

pub(super) fn artifacts(_records: &[RunRecord], _policy: &str) -> Vec<Artifact> {
    Vec::new()
}
