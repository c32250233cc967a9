//! Electrical circuits: rectifiers, leakage, fast circuits.

pub mod cell;
mod charges;
mod extremum;
mod leaks;
mod rectified;
mod regulators;
mod stiff;
mod voltage_peak;
