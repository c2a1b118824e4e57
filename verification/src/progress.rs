//! Progress on the standard error: bars on a terminal, a line per finished run otherwise.

use std::io::{IsTerminal, Write};
use std::sync::atomic::{AtomicUsize, Ordering};

use indicatif::{MultiProgress, ProgressBar, ProgressStyle};

/// What a running case reports to.
#[derive(Debug, Default)]
pub struct Progress {
    bar: Option<ProgressBar>,
}

impl Progress {
    /// Reports to nobody.
    pub fn silent() -> Self {
        Self::default()
    }

    /// `done` of `total` units of work are finished.
    pub fn advance(&self, done: u64, total: u64) {
        if let Some(bar) = &self.bar {
            bar.set_length(total);
            bar.set_position(done);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Follows all runs of one command.
#[derive(Debug)]
pub struct Reporter {
    bars: Option<(MultiProgress, ProgressBar)>,
    quiet: bool,
    total: usize,
    done: AtomicUsize,
}

impl Reporter {
    /// Prepares to report on `total` runs.
    pub fn new(total: usize, quiet: bool) -> Self {
        let bars = (!quiet && total > 0 && std::io::stderr().is_terminal()).then(|| {
            let bars = MultiProgress::new();
            let overall = bars.add(ProgressBar::new(total as u64).with_style(style(
                "{pos:>4}/{len} runs [{bar:30}] {elapsed_precise} elapsed, about {eta} left",
            )));
            overall.tick();
            (bars, overall)
        });
        Self { bars, quiet, total, done: AtomicUsize::new(0) }
    }

    /// A run begins.
    pub fn start(&self, name: &str) -> Progress {
        let bar = self.bars.as_ref().map(|(bars, _)| {
            bars.add(
                ProgressBar::new(0)
                    .with_style(style("          [{bar:30}] {msg}"))
                    .with_message(name.to_owned()),
            )
        });
        Progress { bar }
    }

    /// A run has ended; `remark` says how.
    pub fn finish(&self, name: &str, remark: &str) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some((_, overall)) = &self.bars {
            overall.inc(1);
        } else if !self.quiet {
            say(&format!("[{done:>4}/{}] {name}: {remark}", self.total));
        }
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        if let Some((_, overall)) = &self.bars {
            overall.finish_and_clear();
        }
    }
}

/// Writes a line to the standard error; a closed pipe is not an error.
pub fn say(text: &str) {
    // Nothing is left to be done if even the error stream is closed.
    let _ = writeln!(std::io::stderr(), "{text}");
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .progress_chars("=> ")
}
