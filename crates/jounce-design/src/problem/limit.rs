//! Limits that a design must keep.

use super::LimitedQuantity;
use super::limited_quantity::allowed;
use jounce_analysis::Model;

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
    /// Reads a limit by its name. A strain and a fraction are numbers; a strain may have the unit
    /// ppm.
    ///
    /// # Errors
    /// A message with the mistake and what is allowed.
    pub(super) fn read(name: &str, text: &str, model: &Model) -> Result<Self, String> {
        let all = allowed(model);
        let Some((_, quantity, unit, _)) = all.iter().find(|(known, ..)| known == name) else {
            let shown = |(name, _, _, example): &(String, _, _, &str)| match name.contains('.') {
                true => format!("\"{name}\" = {example}"),
                false => format!("{name} = {example}"),
            };
            let all: Vec<String> = all.iter().map(shown).collect();
            return Err(format!(
                "{name}: there is no such limit; this spec allows {}",
                all.join(", ")
            ));
        };
        let value = unit
            .read(text)
            .map_err(|error| format!("{name}: {error}"))?;
        let is_fraction = *quantity == LimitedQuantity::BasinFraction;
        if !(value > 0.0 && value.is_finite() && (value <= 1.0 || !is_fraction)) {
            let most = if is_fraction { " and at most 1" } else { "" };
            return Err(format!("{name} is {text}; it must be above 0{most}"));
        }
        Ok(Self {
            name: name.to_owned(),
            quantity: *quantity,
            value,
        })
    }

    /// True where a value must be at least the limit.
    pub fn is_lower(&self) -> bool {
        matches!(
            self.quantity,
            LimitedQuantity::BasinFraction | LimitedQuantity::FoldDistance
        )
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
