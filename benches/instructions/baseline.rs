//! The committed counts: `benches/instructions/baseline.csv`.

use std::fs;
use std::path::PathBuf;

/// What a baseline holds for.
pub struct Key {
    /// Version of the compiler.
    pub toolchain: String,
    /// Vector instructions that the processor offers.
    pub level: String,
}

struct Entry {
    workload: String,
    toolchain: String,
    level: String,
    instructions: f64,
}

/// Instructions per step of each workload, compiler and instruction set.
pub struct Baselines(Vec<Entry>);

const HEADER: &str = "workload,toolchain,level,instructions_per_step";

impl Baselines {
    /// Reads the file; one that does not exist holds nothing.
    pub fn read() -> Result<Self, String> {
        let text = fs::read_to_string(path()).unwrap_or_default();
        let lines = text.lines().filter(|line| !line.is_empty()).skip(1);
        lines.map(parse).collect::<Result<_, _>>().map(Self)
    }

    /// The baseline of a workload.
    pub fn find(&self, workload: &str, key: &Key) -> Option<f64> {
        let mut entries = self.0.iter();
        entries.find(|e| e.workload == workload && e.holds(key)).map(|e| e.instructions)
    }

    /// Whether there is any baseline for a compiler and instruction set.
    pub fn knows(&self, key: &Key) -> bool {
        self.0.iter().any(|entry| entry.holds(key))
    }

    /// Sets or adds a baseline.
    pub fn set(&mut self, workload: &str, key: &Key, instructions: f64) {
        self.0.retain(|entry| !(entry.workload == workload && entry.holds(key)));
        self.0.push(Entry {
            workload: workload.into(),
            toolchain: key.toolchain.clone(),
            level: key.level.clone(),
            instructions,
        });
    }

    /// Writes the file.
    pub fn write(&self) -> Result<(), String> {
        let line = |e: &Entry| {
            format!("{},{},{},{:.0}\n", e.workload, e.toolchain, e.level, e.instructions)
        };
        let text: String = self.0.iter().map(line).collect();
        fs::write(path(), format!("{HEADER}\n{text}"))
            .map_err(|error| format!("{}: {error}", path().display()))
    }
}

impl Entry {
    fn holds(&self, key: &Key) -> bool {
        self.toolchain == key.toolchain && self.level == key.level
    }
}

fn parse(line: &str) -> Result<Entry, String> {
    let fields: Vec<&str> = line.split(',').collect();
    let [workload, toolchain, level, instructions] = fields[..] else {
        return Err(format!("baseline.csv: four fields expected in {line:?}"));
    };
    let instructions = instructions.parse().map_err(|error| format!("{line:?}: {error}"))?;
    let [workload, toolchain, level] = [workload, toolchain, level].map(String::from);
    Ok(Entry { workload, toolchain, level, instructions })
}

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("instructions/baseline.csv")
}
