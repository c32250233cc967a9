//! Limits that a harvester allows, for an offer to the user.

use super::LimitedQuantity;
use super::limited_quantity::{LimitUnit, allowed};
use jounce_analysis::Model;
use serde::Serialize;

/// Size of 1 ppm.
const PPM: f64 = 1e-6;

/// Limit that a harvester allows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AllowedLimit {
    /// Name, as in the file.
    pub name: String,
    /// A value, as in the file.
    pub example: String,
    /// Unit in which its values are shown: that of the SI, or ppm; empty for a fraction.
    pub unit: String,
    /// Size of this unit, SI.
    pub factor: f64,
}

/// Returns all limits that a harvester allows.
pub fn allowed_limits(model: &Model) -> Vec<AllowedLimit> {
    let limit = |(name, quantity, unit, example): (String, LimitedQuantity, LimitUnit, &str)| {
        let (unit, factor) = match (unit, quantity) {
            (LimitUnit::Of(quantity), _) => (quantity.si_unit(), 1.0),
            (LimitUnit::Number, LimitedQuantity::BasinFraction) => (String::new(), 1.0),
            (LimitUnit::Number, _) => ("ppm".to_owned(), PPM),
        };
        AllowedLimit {
            name,
            example: example.trim_matches('"').to_owned(),
            unit,
            factor,
        }
    };
    allowed(model).into_iter().map(limit).collect()
}
