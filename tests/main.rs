//! The integration tests of the solver.

#[path = "../benches/generic.rs"]
#[expect(dead_code, reason = "each user takes a part of it")]
mod generic;
#[path = "../benches/plain/mod.rs"]
#[expect(dead_code, reason = "each user takes a part of it")]
mod plain;

mod affine_density;
mod balanced_samples;
mod bodies;
mod boundaries;
mod central_force;
mod common;
mod counters;
mod density_filter;
mod determinism;
mod energy;
mod force_field;
mod ingredients;
mod inlets;
mod internal_forces;
mod invariance;
mod mutants;
mod one_particle;
mod plain_kernels;
mod plane;
mod quadrature;
mod rearrangement;
mod rearrangement_motion;
mod reconstruction;
mod reconstruction_runs;
mod references;
mod rivals;
mod rivals_overfill;
mod rivals_smoothing;
mod rivals_transfer;
mod shape_functions;
mod shape_values;
mod small_cuts;
mod sparse;
mod stress_update;
mod time_step_bound;
mod transfer_conservation;
mod viscosity;
