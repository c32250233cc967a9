//! Channel of a recording.

use super::{ChannelHead, Quantity};

/// Samples of one quantity at one location.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Channel name.
    pub name: String,
    /// Measured quantity.
    pub quantity: Quantity,
    /// SI unit of the values; for an unknown quantity the unit of the file, empty if not given.
    pub unit: String,
    /// Location of the sensor; empty if not given.
    pub place: String,
    /// Direction of the sensor, such as `+z`; empty if not given.
    pub direction: String,
    /// Node and direction of the force of a response function, such as `node 3 +z`; empty if not
    /// given.
    pub reference: String,
    /// Samples; real parts of complex ones. NaN where missing.
    pub values: Vec<f64>,
    /// Imaginary parts of a complex channel, equally many.
    pub imaginary: Option<Vec<f64>>,
}

impl Channel {
    /// Returns a real channel without location and direction.
    pub fn new(name: &str, quantity: Quantity, unit: &str, values: Vec<f64>) -> Self {
        Self {
            name: name.to_owned(),
            quantity,
            unit: unit.to_owned(),
            place: String::new(),
            direction: String::new(),
            reference: String::new(),
            values,
            imaginary: None,
        }
    }

    /// Properties by which the channel is selected.
    pub fn head(&self) -> ChannelHead<'_> {
        ChannelHead {
            name: &self.name,
            quantity: self.quantity,
            unit: &self.unit,
        }
    }
}
