//! Limits that a design must keep.

use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_orbits::OrbitQuantity;
use jounce_spec::Quantity;

/// Quantity with a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitedQuantity {
    /// Largest value on every attractor that a start reaches.
    Peak(OrbitQuantity),
    /// Share of the starts that reach the main orbit; the limit is a lower one.
    BasinFraction,
}

/// Limit of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Name, as in the file.
    pub name: String,
    /// Quantity.
    pub quantity: LimitedQuantity,
    /// Value, SI.
    pub value: f64,
}

impl Limit {
    /// Reads a limit by its name: `patch.NAME.strain`, `patch.NAME.voltage`,
    /// `stop.NAME.contact_force`, `stop.NAME.displacement` or `basin_fraction`. A strain and a
    /// fraction are numbers; a strain may have the unit ppm.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub(super) fn read(name: &str, text: &str, plant: &Plant) -> Result<Self, String> {
        let (quantity, unit) =
            find(name, plant).ok_or_else(|| format!("{name}: {}", choices(plant)))?;
        let value = match unit {
            Some(unit) => unit
                .read(text)
                .map_err(|error| format!("{name}: {error}"))?,
            None => number(text).ok_or_else(|| {
                format!("{name} is {text:?}; write a number, such as 6e-4 or 0.9, or \"600 ppm\"")
            })?,
        };
        let is_fraction = quantity == LimitedQuantity::BasinFraction;
        if !(value > 0.0 && value.is_finite() && (value <= 1.0 || !is_fraction)) {
            let most = if is_fraction { " and at most 1" } else { "" };
            return Err(format!("{name} is {text}; it must be above 0{most}"));
        }
        let name = name.to_owned();
        Ok(Self {
            name,
            quantity,
            value,
        })
    }

    /// True where a value must be at least the limit.
    pub fn is_lower(&self) -> bool {
        self.quantity == LimitedQuantity::BasinFraction
    }

    /// Returns by how much a value violates the limit, relative to it; 0 within it.
    pub fn violation(&self, value: f64) -> f64 {
        let excess = value / self.value - 1.0;
        let excess = if self.is_lower() { -excess } else { excess };
        // NaN: the quantity could not be computed.
        if excess.is_nan() {
            1.0
        } else {
            excess.max(0.0)
        }
    }
}

fn find(name: &str, plant: &Plant) -> Option<(LimitedQuantity, Option<Quantity>)> {
    if name == "basin_fraction" {
        return Some((LimitedQuantity::BasinFraction, None));
    }
    let (kind, rest) = name.split_once('.')?;
    let (of, quantity) = rest.rsplit_once('.')?;
    let patches = &plant.system.modes.patch;
    let patch = || patches.keys().position(|patch| patch == of);
    let stop = || plant.system.stops.iter().position(|stop| stop.name == of);
    let (quantity, unit) = match (kind, quantity) {
        ("patch", "strain") if !patches.get(of)?.strain.is_empty() => {
            (OrbitQuantity::Strain(patch()?), None)
        }
        ("patch", "voltage") => (OrbitQuantity::Voltage(patch()?), Some(Quantity::Voltage)),
        ("stop", "contact_force") if has_force(plant, stop()?) => {
            (OrbitQuantity::ContactForce(stop()?), Some(Quantity::Force))
        }
        ("stop", "displacement") => (OrbitQuantity::Displacement(stop()?), Some(Quantity::Length)),
        _ => return None,
    };
    Some((LimitedQuantity::Peak(quantity), unit))
}

fn has_force(plant: &Plant, stop: usize) -> bool {
    !matches!(plant.system.stops[stop].law, Law::Rigid(_))
}

/// Reads a number, or a number of ppm.
fn number(text: &str) -> Option<f64> {
    match text.trim().strip_suffix("ppm") {
        Some(number) => number.trim().parse().ok().map(|number: f64| 1e-6 * number),
        None => text.trim().parse().ok(),
    }
}

/// Lists the allowed limits for a message.
fn choices(plant: &Plant) -> String {
    let mut all = vec!["basin_fraction = 0.9".to_owned()];
    for (name, patch) in &plant.system.modes.patch {
        if !patch.strain.is_empty() {
            all.push(format!("\"patch.{name}.strain\" = \"600 ppm\""));
        }
        all.push(format!("\"patch.{name}.voltage\" = \"100 V\""));
    }
    for (index, stop) in plant.system.stops.iter().enumerate() {
        if has_force(plant, index) {
            all.push(format!("\"stop.{}.contact_force\" = \"10 N\"", stop.name));
        }
        all.push(format!("\"stop.{}.displacement\" = \"20 mm\"", stop.name));
    }
    format!(
        "there is no such limit; this spec allows {}",
        all.join(", ")
    )
}
