//! Measured quantities.

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
    /// Response per input, in the quotient of their SI units
    Response,
    /// Pure number
    Number,
    /// Not given: the values are as in the file
    Unknown,
}

impl Quantity {
    /// SI unit of the values; empty for quantities without a fixed unit.
    pub fn si_unit(self) -> &'static str {
        match self {
            Self::Acceleration => "m/s^2",
            Self::Velocity => "m/s",
            Self::Displacement => "m",
            Self::Force => "N",
            Self::Voltage => "V",
            Self::Pressure => "Pa",
            Self::Time => "s",
            Self::Frequency => "Hz",
            Self::AccelerationPsd => "(m/s^2)^2/Hz",
            Self::ForcePsd => "N^2/Hz",
            Self::Response | Self::Number | Self::Unknown => "",
        }
    }
}
