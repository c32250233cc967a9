//! Electrical circuits: rectifiers, leakage, fast circuits.

mod leaks;
pub mod rectified;
mod stiff;
mod voltage_peak;
