//! Times that neighbours on the machine disturb little: thread CPU time, shortest of many.

use std::time::Duration;

/// CPU time of this thread, or the wall clock where there is none to ask for.
pub fn thread_time() -> Duration {
    #[cfg(unix)]
    {
        let now = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Duration::new(now.tv_sec as u64, now.tv_nsec as u32)
    }
    #[cfg(not(unix))]
    {
        use std::{sync::OnceLock, time::Instant};
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed()
    }
}

/// Wall time since the first call.
pub fn wall_time() -> Duration {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed()
}

/// Shortest time of `a` and of `b` in seconds, run in turns, after two runs of each to warm up.
pub fn in_turns(
    repetitions: usize,
    clock: fn() -> Duration,
    mut a: impl FnMut(),
    mut b: impl FnMut(),
) -> [f64; 2] {
    let mut shortest = [Duration::MAX; 2];
    for repetition in 0..repetitions + 2 {
        let start = clock();
        a();
        let middle = clock();
        b();
        let end = clock();
        if repetition >= 2 {
            shortest[0] = shortest[0].min(middle.saturating_sub(start));
            shortest[1] = shortest[1].min(end.saturating_sub(middle));
        }
    }
    shortest.map(|time| time.as_secs_f64())
}

/// Whether the short form is asked for, `TRANSPOINT_BENCH=short`.
pub fn short() -> bool {
    std::env::var("TRANSPOINT_BENCH").is_ok_and(|value| value == "short")
}
