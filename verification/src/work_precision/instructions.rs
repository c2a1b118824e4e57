//! Instructions per point and step of every method: a snapshot of this code, written by
//! `cargo instructions --variants --update` and taken in when this crate is built.

use std::sync::LazyLock;

/// The file, with the compiler and the instruction set that it holds for in its first line.
const SNAPSHOT: &str = include_str!("../../../benches/instructions/variants.csv");

/// What a count holds for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind<'a> {
    /// Name of the method.
    pub(super) variant: &'a str,
    /// Number of axes.
    pub(super) dimension: usize,
    /// Points per cell and axis.
    pub(super) points_per_axis: usize,
    /// What the method computes besides its own parts.
    pub(super) flow: Flow,
}

/// What a method computes besides its own parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    /// Nothing.
    Inviscid,
    /// A shear stress.
    Viscous,
    /// A stress updated modified-last.
    ModifiedLast,
}

impl Flow {
    /// That of a run; both additions at once are not counted.
    pub(super) const fn of(is_viscous: bool, is_modified_last: bool) -> Option<Self> {
        match (is_viscous, is_modified_last) {
            (false, false) => Some(Self::Inviscid),
            (true, false) => Some(Self::Viscous),
            (false, true) => Some(Self::ModifiedLast),
            (true, true) => None,
        }
    }

    fn parse(name: &str) -> Option<Self> {
        match name {
            "inviscid" => Some(Self::Inviscid),
            "viscous" => Some(Self::Viscous),
            "modified-last" => Some(Self::ModifiedLast),
            _ => None,
        }
    }
}

/// Instructions per point and step; not a number where there is no count.
pub(super) fn per_point_step(kind: &Kind) -> f64 {
    static COUNTS: LazyLock<Vec<(Kind<'static>, f64)>> = LazyLock::new(|| parse(SNAPSHOT));
    find(&COUNTS, kind)
}

/// Compiler and instruction set that the counts hold for.
pub(super) fn holds_for() -> &'static str {
    let comment = SNAPSHOT.lines().next().and_then(|line| line.strip_prefix('#'));
    comment.map_or("an unknown compiler", str::trim)
}

fn find(counts: &[(Kind, f64)], kind: &Kind) -> f64 {
    counts.iter().find(|(of, _)| of == kind).map_or(f64::NAN, |&(_, count)| count)
}

/// The rows that can be read; all others, the comment and the header among them, are left out.
fn parse(text: &str) -> Vec<(Kind<'_>, f64)> {
    text.lines().filter_map(row).collect()
}

fn row(line: &str) -> Option<(Kind<'_>, f64)> {
    let fields: Vec<&str> = line.split(',').collect();
    let [variant, dimension, points_per_axis, flow, count] = fields[..] else { return None };
    let kind = Kind {
        variant,
        dimension: dimension.parse().ok()?,
        points_per_axis: points_per_axis.parse().ok()?,
        flow: Flow::parse(flow)?,
    };
    let count: f64 = count.parse().ok()?;
    (count.is_finite() && count > 0.0).then_some((kind, count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::benchmark::{ALL, POINTS_PER_AXIS, VARIANTS};
    use crate::case::Case;

    #[test]
    fn every_run_of_the_study_has_a_count() {
        for benchmark in &ALL {
            let is_viscous = benchmark.is_viscous();
            for variant in VARIANTS {
                let flow = Flow::of(is_viscous, benchmark.is_modified_last(variant));
                let flow = flow.expect("a flow that is counted");
                for points_per_axis in POINTS_PER_AXIS {
                    let (name, dimension) = (variant.name(), benchmark.dimension());
                    let kind = Kind { variant: name, dimension, points_per_axis, flow };
                    assert!(per_point_step(&kind).is_finite(), "{}: {kind:?}", benchmark.name());
                }
            }
        }
    }

    #[test]
    fn every_row_below_the_header_can_be_read() {
        assert_eq!(parse(SNAPSHOT).len() + 2, SNAPSHOT.lines().count());
    }

    #[test]
    fn a_bad_or_missing_row_is_a_gap() {
        let text = "# compiler\nvariant,dimension,points_per_axis,flow,count\nmpm,2,2,viscous,-1\n\
                    mpm,2,2,sticky,400\nmpm,two,2,inviscid,400\nmpm,2,2\n\nmpm,1,2,inviscid,250.5\n";
        let counts = parse(text);
        let kind = Kind { variant: "mpm", dimension: 1, points_per_axis: 2, flow: Flow::Inviscid };
        assert_eq!(counts, [(kind, 250.5)]);
        assert_eq!(find(&counts, &kind), 250.5);
        assert!(find(&counts, &Kind { dimension: 2, ..kind }).is_nan());
    }
}
