//! Electrical circuits: rectifiers, leakage, fast circuits.

pub mod cell;
mod charges;
mod leaks;
mod rectified;
mod regulators;
mod stiff;
mod voltage_peak;
