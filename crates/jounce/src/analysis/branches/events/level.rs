//! Levels of quantities of an orbit that a user gives.

use crate::contact::Law;
use crate::orbit::{OrbitQuantity, ShootingEvaluation};
use crate::plant::Plant;
use crate::spec::Quantity;

/// A level of a quantity, labelled where a branch passes it.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityLevel {
    /// As it was given.
    pub text: String,
    /// The level, SI.
    pub value: f64,
    /// Of what.
    pub quantity: OrbitQuantity,
}

impl QuantityLevel {
    /// Reads `QUANTITY=VALUE`: `mean_power`, `voltage.PATCH`, `strain.PATCH` (a number without a unit) or `contact_force.STOP`.
    ///
    /// # Errors
    /// What is wrong with it, and what is allowed.
    pub fn parse(text: &str, plant: &Plant) -> Result<Self, String> {
        let allowed = || format!("{text}: {}", choices(plant));
        let (name, value_text) = text.split_once('=').ok_or_else(allowed)?;
        let (kind, of) = name.trim().split_once('.').unwrap_or((name.trim(), ""));
        let patch = plant.system.modes.patch.keys().position(|own| own == of);
        let stop = plant
            .system
            .stops
            .iter()
            .position(|own| own.name == of && !matches!(own.law, Law::Rigid(_)));
        let (quantity, unit) = match (kind, patch, stop) {
            ("mean_power", ..) if of.is_empty() => {
                (OrbitQuantity::MeanPower, Some(Quantity::Power))
            }
            ("voltage", Some(patch), _) => (OrbitQuantity::Voltage(patch), Some(Quantity::Voltage)),
            ("strain", Some(patch), _) if has_strain(plant, of) => {
                (OrbitQuantity::Strain(patch), None)
            }
            ("contact_force", _, Some(stop)) => {
                (OrbitQuantity::ContactForce(stop), Some(Quantity::Force))
            }
            _ => return Err(allowed()),
        };
        let value = match unit {
            Some(unit) => unit
                .read(value_text.trim())
                .map_err(|error| format!("{text}: {error}"))?,
            None => value_text
                .trim()
                .parse()
                .map_err(|_| format!("{text}: a strain is a number without a unit, as 3e-4"))?,
        };
        if value > 0.0 && f64::is_finite(value) {
            Ok(Self {
                text: text.to_owned(),
                value,
                quantity,
            })
        } else {
            Err(format!("{text}: a level must be above zero"))
        }
    }

    /// The quantity of an orbit less the level, relative to it.
    pub(in crate::analysis) fn off(&self, shot: &ShootingEvaluation) -> f64 {
        self.quantity.of(shot) / self.value - 1.0
    }
}

fn has_strain(plant: &Plant, patch: &str) -> bool {
    plant
        .system
        .modes
        .patch
        .get(patch)
        .is_some_and(|patch| !patch.strain.is_empty())
}

/// What may be given, for a message.
fn choices(plant: &Plant) -> String {
    let patches = plant.system.modes.patch.keys().flat_map(|patch| {
        let strain = has_strain(plant, patch).then(|| format!("strain.{patch}=3e-4"));
        std::iter::once(format!("voltage.{patch}=\"5 V\"")).chain(strain)
    });
    let stops = plant
        .system
        .stops
        .iter()
        .filter(|stop| !matches!(stop.law, Law::Rigid(_)));
    let forces = stops.map(|stop| format!("contact_force.{}=\"2 N\"", stop.name));
    let all: Vec<String> = std::iter::once("mean_power=\"50 uW\"".to_owned())
        .chain(patches)
        .chain(forces)
        .collect();
    format!("write QUANTITY=VALUE; here {} can be given", all.join(", "))
}
