//! What a channel measures.

use serde::{Deserialize, Serialize};

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// m/s^2
    Acceleration,
    /// m/s
    Velocity,
    /// m
    Displacement,
    /// N
    Force,
    /// V
    Voltage,
    /// Pa
    Pressure,
    /// s
    Time,
    /// Hz
    Frequency,
    /// (m/s^2)^2/Hz, one-sided
    AccelerationPsd,
    /// N^2/Hz, one-sided
    ForcePsd,
    /// A response per input, in the quotient of their SI units
    Response,
    /// A pure number
    Number,
    /// Not told: the values are as they stand in the file
    Unknown,
}
