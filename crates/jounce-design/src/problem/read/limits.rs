//! Limits.

use crate::problem::limited_quantity::allowed;
use crate::problem::{Goal, Limit, LimitedQuantity};
use jounce_analysis::Model;
use jounce_analysis::study::FaultCollector;
use toml_edit::{Item, Table};

/// Reads the limits.
pub(super) fn limits(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    model: &Model,
) -> Vec<Limit> {
    let mut all = Vec::new();
    for (name, item) in reader.table("limits", item).into_iter().flatten() {
        let text = item.as_str().unwrap_or(reader.bare(item));
        match Limit::read(name, text, model) {
            Ok(limit) => all.push(limit),
            Err(message) => reader.fault(name, item.span(), message),
        }
    }
    all
}

/// Checks that goals and limits are compatible.
pub(super) fn check_together(
    reader: &mut FaultCollector,
    root: &Table,
    goals: &[Goal],
    limits: &[Limit],
) {
    let has_starts = goals.iter().any(|goal| goal.needs_starts());
    let has_run = goals.iter().any(|goal| goal.needs_run());
    let Some(goal) = goals.first().filter(|_| !has_starts) else {
        return;
    };
    for limit in limits {
        let is_allowed = match limit.quantity {
            LimitedQuantity::Size(_) => true,
            LimitedQuantity::Peak(_) | LimitedQuantity::MeanPower => has_run,
            LimitedQuantity::BasinFraction | LimitedQuantity::FoldDistance => false,
        };
        if !is_allowed {
            let span = root.get("limits").and_then(Item::span);
            let message = format!(
                "limits.{} does not go with the goal \"{}\"; list \"expected-power\" or \"stable-power\" too",
                limit.name,
                goal.name()
            );
            reader.fault(&limit.name, span, message);
        }
    }
}

/// Checks that the harvester of a combination of choices has all limited quantities.
pub(super) fn check_limits(
    reader: &mut FaultCollector,
    root: &Table,
    limits: &[Limit],
    (model, choices): (&Model, &str),
) {
    let all = allowed(model);
    for limit in limits {
        let is_known = |(name, quantity): (&str, LimitedQuantity)| {
            name == limit.name && quantity == limit.quantity
        };
        if !all
            .iter()
            .any(|(name, quantity, ..)| is_known((name, *quantity)))
        {
            let span = root.get("limits").and_then(Item::span);
            let message = format!(
                "limits.{}: there is no such quantity with {choices}; remove the limit or the choice",
                limit.name
            );
            reader.fault(&limit.name, span, message);
        }
    }
}
