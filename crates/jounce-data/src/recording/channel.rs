//! One channel.

use super::{ChannelHead, Quantity};

/// Samples of one quantity at one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Its name.
    pub name: String,
    /// What it measures.
    pub quantity: Quantity,
    /// SI unit of the values; as in the file where the quantity is unknown, and empty where nothing is told.
    pub unit: String,
    /// Where the sensor sits; empty where nothing is told.
    pub place: String,
    /// Which way it points, as `+z`; empty where nothing is told.
    pub direction: String,
    /// Where and which way the force of a response function acts, as `node 3 +z`; empty where nothing is told.
    pub reference: String,
    /// The samples, real parts of complex ones. NaN where one is missing.
    pub values: Vec<f64>,
    /// Imaginary parts of a complex channel, as many.
    pub imaginary: Option<Vec<f64>>,
}

impl Channel {
    /// A real channel without place and direction.
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

    /// What it is chosen by.
    pub fn head(&self) -> ChannelHead<'_> {
        ChannelHead {
            name: &self.name,
            quantity: self.quantity,
            unit: &self.unit,
        }
    }
}
