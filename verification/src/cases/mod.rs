//! The studies: one file each, one line each in the list; and what several of them share.

pub mod acoustic_pulse;
pub mod cell_means;
pub mod channel;
pub mod channel_vof;
pub mod column;
pub mod courant_limit;
pub mod cylinder;
pub mod dam_break;
pub mod elastic_bar;
pub mod errors;
pub mod fluid_cells;
pub mod free_overfall;
pub mod free_surface;
pub mod hard_cases;
pub mod jet_on_plate;
pub mod lattice;
pub mod march;
pub mod noise;
pub mod operators;
pub mod riemann;
pub mod rivals;
pub mod series;
pub mod shear_startup;
pub mod sine_wave;
pub mod sod;
pub mod spectral;

use crate::benchmark;
use crate::case::Case;
use crate::ingredients::Ingredients;

/// Every case, in the order of the page.
pub static ALL: [&dyn Case; 36] = [
    &sine_wave::SineWave,
    &riemann::Riemann,
    &dam_break::DamBreak,
    &channel::Channel,
    &channel_vof::ChannelVof,
    &jet_on_plate::JetOnPlate,
    &free_overfall::FreeOverfall,
    &cylinder::Cylinder,
    &sod::Sod,
    &acoustic_pulse::AcousticPulse,
    &shear_startup::ShearStartup,
    &elastic_bar::ElasticBarWave,
    &column::Column,
    &rivals::Rivals,
    &courant_limit::CourantLimit,
    &benchmark::ALL[0],
    &benchmark::ALL[1],
    &benchmark::ALL[2],
    &benchmark::ALL[3],
    &benchmark::ALL[4],
    &benchmark::ALL[5],
    &benchmark::ALL[6],
    &benchmark::ALL[7],
    &benchmark::ALL[8],
    &benchmark::ALL[9],
    &benchmark::ALL[10],
    &benchmark::ALL[11],
    &benchmark::ALL[12],
    &benchmark::ALL[13],
    &benchmark::ALL[14],
    &benchmark::ALL[15],
    &benchmark::ALL[16],
    &Ingredients,
    &operators::Operators,
    &spectral::Spectral,
    &hard_cases::HardCases,
];
