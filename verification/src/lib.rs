//! The verification and benchmark harness of `transpoint`.
//!
//! A [`case::Case`] lists runs, executes one of them, and turns the records of all of them into
//! checks, observed orders, figures and tables. Everything else here is shared by the cases.
//!
//! The modules stand in reading order. Data goes one way: command line → plan → runs → records →
//! report and verdict. The report and the verdict are pure functions of the record files.

pub mod benchmark;
pub mod case;
pub mod cases;
pub mod cli;
pub mod command;
pub mod convergence;
pub mod exact;
pub mod ingredients;
pub mod judge;
pub mod machine;
pub mod measure;
pub mod number;
pub mod plan;
pub mod problems;
pub mod progress;
pub mod record;
pub mod reference;
pub mod report;
pub mod run;
pub mod work_precision;
