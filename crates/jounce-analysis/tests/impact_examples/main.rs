//! Impact harvesters of the literature: every spec of `examples/` with impacts or a rectifier,
//! against closed forms.
#![allow(clippy::unwrap_used, reason = "tests")]

mod ball_umeda;
mod complete;
mod driving_beam_gu;
mod example;
mod faults;
mod impact_harvester_2019;
mod missile_renaud;
mod plate_de_marqui;
mod pump_sensor;
mod random_base;
mod rectified_shu_lien;
mod reduced_basis;
#[path = "../linear/rows.rs"]
mod rows;
mod seismic_mass_jacquelin;
mod shock_cavallier;
mod two_beams_vijayan;
mod wireless_sensor;
