//! Levels of quantities of an orbit that a user specifies.

use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_orbits::{OrbitQuantity, ShootingEvaluation};
use jounce_spec::Quantity;

/// Level of a quantity, labelled where a branch crosses it.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityLevel {
    /// Text as specified.
    pub text: String,
    /// Value of the level, SI.
    pub value: f64,
    /// Quantity of the level.
    pub quantity: OrbitQuantity,
}

impl QuantityLevel {
    /// Reads `QUANTITY=VALUE`: `mean_power`, `voltage.PATCH`, `strain.PATCH` (a number without a
    /// unit) or `contact_force.STOP`.
    ///
    /// # Errors
    /// A message with the mistake and the allowed values.
    pub fn parse(text: &str, plant: &Plant) -> Result<Self, String> {
        let allowed = || format!("{text}: {}", choices(plant));
        let (name, value_text) = text.split_once('=').ok_or_else(allowed)?;
        let (kind, of) = name.trim().split_once('.').unwrap_or((name.trim(), ""));
        let patch = plant
            .system
            .modes
            .patch
            .keys()
            .position(|candidate| candidate == of);
        let stop =
            plant.system.stops.iter().position(|candidate| {
                candidate.name == of && !matches!(candidate.law, Law::Rigid(_))
            });
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
            None => value_text.trim().parse().map_err(|_| {
                format!("{text}: a strain is a number without a unit, such as 3e-4")
            })?,
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

    /// Returns the difference of the quantity of an orbit from the level, relative to the level.
    pub(crate) fn relative_difference(&self, evaluation: &ShootingEvaluation) -> f64 {
        self.quantity.of(evaluation) / self.value - 1.0
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

/// Lists the allowed levels for a message.
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
    format!("write QUANTITY=VALUE; this spec allows {}", all.join(", "))
}
