//! Goals and the number of starts.

use crate::problem::Goal;
use jounce_analysis::Model;
use jounce_analysis::study::FaultCollector;
use jounce_spec::did_you_mean;
use toml_edit::{Item, Table};

/// Reads the goals and the number of starts.
pub(super) fn goals(reader: &mut FaultCollector, item: Option<&Item>) -> (Vec<Goal>, usize) {
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
        match Goal::named(name) {
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
                    "goal.maximise is \"{name}\"{}; it must be one of {all}, or a list of several",
                    did_you_mean(name, &Goal::ALL.map(Goal::name))
                ),
            ),
        }
    }
    if names.is_empty() {
        let message = format!(
            "goal.maximise is missing; write one of {all}, as in maximise = \"expected-power\" below [goal]"
        );
        reader.missing("goal.maximise", maximise.and_then(Item::span), message);
    }
    (goals, starts)
}

/// Checks that a harvester can have the goals; `with` says for which choices, or nothing.
pub(super) fn check_goals(
    reader: &mut FaultCollector,
    root: &Table,
    goals: &[Goal],
    (model, with): (&Model, &str),
) {
    let maximise = root.get("goal").and_then(|goal| goal.get("maximise"));
    let span = maximise.and_then(Item::span);
    let verb = match maximise.and_then(Item::as_array) {
        Some(_) => "lists",
        None => "is",
    };
    for goal in goals {
        if let Some(reason) = obstacle(*goal, model) {
            let name = goal.name();
            let message = format!("goal.maximise {verb} \"{name}\", but {reason}{with}");
            reader.fault("goal.maximise", span.clone(), message);
        }
    }
}

/// Returns why a harvester cannot have a goal, and what to do.
fn obstacle(goal: Goal, model: &Model) -> Option<String> {
    let system = &model.kernel.plant.system;
    if goal.needs_device() && model.spec.device.is_empty() {
        return Some(
            "the spec has no device; give a [regulator.NAME] and a [device.NAME], or choose \"mean-power\""
                .to_owned(),
        );
    }
    if system.loads.is_empty() && system.bridges.is_empty() {
        return Some(
            "no circuit takes power from a patch; add a [circuit.NAME] with patch = \"NAME\" and resistance = \"100 kohm\""
                .to_owned(),
        );
    }
    if goal.needs_run() {
        return None;
    }
    if let Some(part) = system.aperiodic() {
        return Some(format!(
            "{part} is not periodic, so that there are no periodic orbits; choose \"mean-power\", or give every drive signal = \"sine\""
        ));
    }
    system.drives.is_empty().then(|| {
        "the spec has no sinusoidal drive; add a [drive.NAME] with an amplitude and a frequency, or choose \"mean-power\""
            .to_owned()
    })
}
