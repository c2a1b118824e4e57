//! Instructions of every named method per point and step: reported and kept as a snapshot, not checked.
//!
//! `variants.csv` is what the study of speed against error takes its scale of instructions from. Counts taken twice
//! agree within 0.05 %: where a program's memory lies moves a few instructions.

use std::fs;
use std::path::PathBuf;

use transpoint::variants::StressUpdate;
use transpoint::{Settings, Simulation, Variant};

use crate::baseline::Key;
use crate::count;
use crate::plain::scene::{DT, Layout, scene_of_points};

/// What names of these workloads begin with.
const PREFIX: &str = "variant";
/// Cells in one dimension.
const LINE: [usize; 1] = [256];
/// Cells in two.
const SQUARE: [usize; 2] = [16, 16];
/// Points per cell and axis that the study has.
const POINTS_PER_AXIS: [usize; 2] = [2, 3];
/// Steps of the shorter run: a multiple of the intervals of shifts and filters.
const STEPS: u32 = 40;
/// Kinematic viscosity of viscous flows, m²/s: too small to change the time step.
const VISCOSITY: f64 = 1e-6;
/// Methods that the cases with a free surface run with the stress updated modified-last.
const MODIFIED_LAST: [Variant; 3] = [Variant::MpmVp, Variant::GimpVp, Variant::Bspline2];

const HEADER: &str = "variant,dimension,points_per_axis,flow,instructions_per_point_step";

/// What a method computes besides its own parts.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flow {
    /// Nothing.
    Inviscid,
    /// A shear stress, in two dimensions: the study has no viscous flow in one.
    Viscous,
    /// A stress updated modified-last.
    ModifiedLast,
}

impl Flow {
    const ALL: [Self; 3] = [Self::Inviscid, Self::Viscous, Self::ModifiedLast];

    const fn name(self) -> &'static str {
        match self {
            Self::Inviscid => "inviscid",
            Self::Viscous => "viscous",
            Self::ModifiedLast => "modified-last",
        }
    }

    fn holds_for(self, variant: Variant, dimension: usize) -> bool {
        match self {
            Self::Inviscid => true,
            Self::Viscous => dimension == 2,
            Self::ModifiedLast => MODIFIED_LAST.contains(&variant),
        }
    }
}

/// A method on the scene of its count.
#[derive(Clone, Copy)]
struct Workload {
    variant: Variant,
    dimension: usize,
    per_axis: usize,
    flow: Flow,
}

impl Workload {
    /// In the order of the file.
    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for variant in Variant::ALL {
            for dimension in [1, 2] {
                for per_axis in POINTS_PER_AXIS {
                    let flows = Flow::ALL.into_iter().filter(|f| f.holds_for(variant, dimension));
                    all.extend(flows.map(|flow| Self { variant, dimension, per_axis, flow }));
                }
            }
        }
        all
    }

    fn name(self) -> String {
        let Self { variant, dimension, per_axis, flow } = self;
        [PREFIX, variant.name(), &dimension.to_string(), &per_axis.to_string(), flow.name()]
            .join("/")
    }

    fn parse(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|workload| workload.name() == name)
    }

    fn n_points(self) -> usize {
        match self.dimension {
            1 => LINE[0] * self.per_axis,
            _ => SQUARE.iter().product::<usize>() * self.per_axis.pow(2),
        }
    }

    /// Builds and steps; false if either fails.
    fn run(self, n_steps: usize) -> bool {
        let mut settings =
            Settings { gimp_length: 1.0 / self.per_axis as f64, ..Settings::default() };
        if self.flow == Flow::ModifiedLast {
            settings.stress_update = StressUpdate::ModifiedLast;
        }
        let viscosity = (self.flow == Flow::Viscous).then_some(VISCOSITY);
        if self.dimension == 1 {
            let mut scene = scene_of_points(LINE, self.per_axis, Layout::Jittered);
            scene.viscosity = viscosity;
            self.variant.build_1d(&scene, &settings).is_ok_and(|solver| steps(solver, n_steps))
        } else {
            let mut scene = scene_of_points(SQUARE, self.per_axis, Layout::Jittered);
            scene.viscosity = viscosity;
            self.variant.build_2d(&scene, &settings).is_ok_and(|solver| steps(solver, n_steps))
        }
    }

    fn per_point(self) -> Result<f64, String> {
        Ok(count::per_step(&self.name(), STEPS)? / self.n_points() as f64)
    }
}

/// Takes steps; false if one fails.
fn steps<const D: usize>(mut solver: Box<dyn Simulation<D>>, n_steps: usize) -> bool {
    // The first step, in which buffers take their size, is in both runs.
    (0..=n_steps).all(|_| solver.step(DT).is_ok())
}

/// Runs a method on the scene of its workload; false if there is none of that name.
pub fn run(name: &str, n_steps: usize) -> bool {
    transpoint::limit_to_baseline(true);
    Workload::parse(name).is_some_and(|workload| workload.run(n_steps))
}

/// Counts all methods and prints a table in Markdown; writes the snapshot if asked to.
pub fn report(key: &Key, update: bool) -> Result<(), String> {
    let workloads = Workload::all();
    let mut counts = Vec::with_capacity(workloads.len());
    for (done, workload) in workloads.iter().enumerate() {
        counts.push(workload.per_point()?);
        eprintln!("{} of {}: {}", done + 1, workloads.len(), workload.name());
    }
    if update {
        write(key, &workloads, &counts)?;
    }
    print(&workloads, &counts);
    Ok(())
}

fn write(key: &Key, workloads: &[Workload], counts: &[f64]) -> Result<(), String> {
    let row = |(workload, count): (&Workload, &f64)| {
        let Workload { variant, dimension, per_axis, flow } = workload;
        format!("{},{dimension},{per_axis},{},{count:.1}\n", variant.name(), flow.name())
    };
    let rows: String = workloads.iter().zip(counts).map(row).collect();
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("instructions/variants.csv");
    let text = format!("# {}, {}\n{HEADER}\n{rows}", key.toolchain, key.level);
    fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))
}

fn print(workloads: &[Workload], counts: &[f64]) {
    let find = |variant: Variant, dimension: usize, per_axis: usize, flow: Flow| {
        let same = |w: &Workload| {
            (w.variant, w.dimension, w.per_axis, w.flow) == (variant, dimension, per_axis, flow)
        };
        workloads.iter().position(same).map(|at| counts[at])
    };
    println!("| variant | 2D, 2×2 points | over `mpm` | 3×3 | 2×2, viscous | 1D, 2 points | 3 |");
    println!("|---|---|---|---|---|---|---|");
    let text = |count: Option<f64>| count.map_or("–".to_owned(), |count| format!("{count:.0}"));
    let mpm = find(Variant::Mpm, 2, 2, Flow::Inviscid);
    for variant in Variant::ALL {
        let plain = find(variant, 2, 2, Flow::Inviscid);
        let ratio = plain.zip(mpm).map_or("–".to_owned(), |(a, b)| format!("{:.2}", a / b));
        println!(
            "| {} | {} | {ratio} | {} | {} | {} | {} |",
            variant.name(),
            text(plain),
            text(find(variant, 2, 3, Flow::Inviscid)),
            text(find(variant, 2, 2, Flow::Viscous)),
            text(find(variant, 1, 2, Flow::Inviscid)),
            text(find(variant, 1, 3, Flow::Inviscid)),
        );
    }
}
