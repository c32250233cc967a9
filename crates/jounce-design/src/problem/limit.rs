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
            LimitedQuantity::MeanPower
                | LimitedQuantity::BasinFraction
                | LimitedQuantity::FoldDistance
        )
    }

    /// True where a run gives the value, so that it depends on the realisation of the noise.
    pub fn depends_on_run(&self) -> bool {
        matches!(
            self.quantity,
            LimitedQuantity::Peak(_) | LimitedQuantity::MeanPower
        )
    }

    /// Returns the value that is farthest beyond the limit or nearest to it: the largest, or the
    /// smallest for a limit from below; NaN if one is NaN.
    pub fn worst(&self, values: impl Iterator<Item = f64>) -> f64 {
        match self.is_lower() {
            true => values.fold(f64::INFINITY, smaller),
            false => values.fold(0.0, larger),
        }
    }

    /// Returns the share of a value that lies beyond the limit or, of a limit from below, the missing
    /// share of the limit: 0 within it, 1 where the value is not known. So an unknown value never
    /// ranks before a known one.
    pub fn violation(&self, value: f64) -> f64 {
        let share = if self.is_lower() {
            value / self.value
        } else {
            self.value / value
        };
        if share.is_nan() {
            1.0
        } else {
            (1.0 - share).max(0.0)
        }
    }
}

/// Returns the smaller of two numbers; NaN if one is NaN.
fn smaller(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

/// Returns the larger of two numbers; NaN if one is NaN.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Size;

    fn limit(quantity: LimitedQuantity) -> Limit {
        Limit {
            name: String::new(),
            quantity,
            value: 0.5,
        }
    }

    #[test]
    fn an_unknown_value_is_the_largest_violation() {
        let (upper, lower) = (
            limit(LimitedQuantity::Size(Size::Mass)),
            limit(LimitedQuantity::BasinFraction),
        );
        assert_eq!(
            [0.0, 0.4, 0.5].map(|value| upper.violation(value)),
            [0.0; 3]
        );
        assert_eq!([1.0, 5.0].map(|value| upper.violation(value)), [0.5, 0.9]);
        assert_eq!([1.0, 0.5].map(|value| lower.violation(value)), [0.0; 2]);
        assert_eq!([0.25, 0.0].map(|value| lower.violation(value)), [0.5, 1.0]);
        assert_eq!(
            [&upper, &lower].map(|one| one.violation(f64::NAN)),
            [1.0; 2]
        );
    }
}
