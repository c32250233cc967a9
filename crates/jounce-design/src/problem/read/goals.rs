//! Goals and the number of starts.

use crate::problem::Goal;
use jounce_analysis::study::FaultCollector;
use jounce_spec::Spec;
use toml_edit::{Item, Table};

/// Reads the goals and the number of starts.
pub(super) fn goals(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    spec: &Spec,
) -> (Vec<Goal>, usize) {
    let empty = Table::new();
    let table = reader.table("goal", item).unwrap_or(&empty);
    reader.known("goal.", table, &["maximise", "starts"]);
    let starts = reader.integer("goal.starts", table.get("starts"), (1, 100_000), 100) as usize;
    let maximise = table.get("maximise");
    let names: Vec<&str> = match (
        maximise.and_then(Item::as_str),
        maximise.and_then(Item::as_array),
    ) {
        (Some(name), _) => vec![name],
        (None, Some(array)) => array
            .iter()
            .map(|value| value.as_str().unwrap_or(""))
            .collect(),
        (None, None) => Vec::new(),
    };
    let all = Goal::ALL.map(Goal::name).join(", ");
    let mut goals: Vec<Goal> = Vec::new();
    for name in &names {
        match Goal::ALL.into_iter().find(|goal| goal.name() == *name) {
            Some(goal) if !goals.contains(&goal) => goals.push(goal),
            Some(_) => reader.fault(
                "goal.maximise",
                maximise.and_then(Item::span),
                format!("goal.maximise lists \"{name}\" twice"),
            ),
            None => reader.fault(
                "goal.maximise",
                maximise.and_then(Item::span),
                format!(
                    "goal.maximise is \"{name}\"; it must be one of {all}, or a list of several"
                ),
            ),
        }
    }
    if let Some(goal) = goals.iter().find(|goal| goal.needs_device())
        && spec.device.is_empty()
    {
        let message = format!(
            "goal.maximise is \"{}\", but the spec has no device; give a [regulator.NAME] and a [device.NAME], or choose \"mean-power\"",
            goal.name()
        );
        reader.fault("goal.maximise", maximise.and_then(Item::span), message);
    }
    if names.is_empty() {
        let message = format!(
            "goal.maximise is missing; write one of {all}, as in maximise = \"expected-power\" below [goal]"
        );
        reader.fault("goal.maximise", maximise.and_then(Item::span), message);
    }
    (goals, starts)
}
