//! Reads a design problem from its text.
//!
//! ```toml
//! spec = "harvester.toml"
//! [free]
//! "stop.tip.gap" = "0.2mm:3mm"
//! [goal]
//! maximise = "expected-power"
//! [limits]
//! "patch.mfc.strain" = "600 ppm"
//! ```

use super::{
    Condition, FreeKey, FreeValues, Goal, Limit, LimitedQuantity, Problem, Tolerance, digest,
};
use crate::DesignError;
use jounce_analysis::Model;
use jounce_analysis::study::FaultCollector;
use jounce_model::plant::Plant;
use jounce_spec::SpecFile;
use std::path::PathBuf;
use toml_edit::{Item, Table};

/// Largest number of free keys and of tolerances: a design of more is slower than its user.
const MAX_FREE: usize = 64;

/// Largest number of combinations of choices.
const MAX_VARIANTS: usize = 1000;

/// Reads a text; `file` finds the spec and its name in messages by the path in the text, `None` if
/// it names no path.
pub(super) fn read(
    text: &str,
    file: impl FnOnce(Option<&str>) -> Result<(SpecFile, String), DesignError>,
) -> Result<Problem, DesignError> {
    let mut reader = FaultCollector::new(text);
    let Some(document) = reader.document() else {
        return Err(DesignError::Faults(reader.faults));
    };
    let root = document.as_table();
    let known = [
        "spec",
        "seed",
        "evaluations",
        "seconds",
        "draws",
        "free",
        "goal",
        "limits",
        "conditions",
        "tolerance",
    ];
    reader.known("", root, &known);
    let (file, name) = file(reader.text("spec", root.get("spec")))?;
    let spec = file
        .spec()
        .map_err(|faults| DesignError::Spec { file: name, faults })?;
    let model = Model::new(spec.clone())?;
    let free = free(&mut reader, root.get("free"), &file);
    let (goals, starts) = goals(&mut reader, root.get("goal"));
    let limits = limits(&mut reader, root.get("limits"), &model.kernel.plant);
    check_together(&mut reader, root, &goals, &limits);
    let conditions = conditions(&mut reader, root.get("conditions"), &file);
    let tolerances = tolerances(&mut reader, root.get("tolerance"), &file);
    let seed = reader.integer("seed", root.get("seed"), (0, 1 << 53), 1);
    let evaluations = root.get("evaluations");
    let evaluations = reader.integer("evaluations", evaluations, (1, 100_000_000), 1000) as usize;
    let draws = reader.integer("draws", root.get("draws"), (8, 1 << 20), 128) as usize;
    let seconds = root.get("seconds");
    let seconds = seconds.map(|item| reader.positive("seconds", Some(item), 1.0));
    let variants = variants(&mut reader, &free, &file);
    if !reader.faults.is_empty() {
        return Err(DesignError::Faults(reader.faults));
    }
    Ok(Problem {
        hash_hex: digest(text, &spec),
        file,
        variants,
        spec,
        folder: PathBuf::new(),
        free,
        goals,
        starts,
        limits,
        conditions,
        tolerances,
        draws,
        seed,
        evaluations,
        seconds,
    })
}

/// Reads the free keys.
fn free(reader: &mut FaultCollector, item: Option<&Item>, file: &SpecFile) -> Vec<FreeKey> {
    let table = reader.table("free", item);
    let Some(table) = table.filter(|table| !table.is_empty()) else {
        let message =
            "free names no key; write [free] and \"stop.tip.gap\" = \"0.2mm:3mm\" below it";
        reader.fault("free", item.and_then(Item::span), message);
        return Vec::new();
    };
    let mut all = Vec::new();
    for (path, item) in table {
        let read = match (item.as_str(), item.as_array()) {
            (Some(text), _) => FreeKey::range(file, path, text),
            (None, Some(array)) => {
                let texts: Vec<String> = array
                    .iter()
                    .filter_map(|value| value.as_str().map(str::to_owned))
                    .collect();
                match texts.len() == array.len() && texts.len() > 1 {
                    true => Ok(FreeKey {
                        path: path.to_owned(),
                        values: FreeValues::Choice(texts),
                    }),
                    false => Err(vec![format!(
                        "free.{path} must list at least two texts, as in [\"steel\", \"aluminium\"]"
                    )]),
                }
            }
            _ => Err(vec![format!(
                "free.{path} must be a text, as in \"0.2mm:3mm\", under the whole path as one key, or a list of texts"
            )]),
        };
        match read {
            Ok(free) => all.push(free),
            Err(messages) => messages
                .into_iter()
                .for_each(|message| reader.fault(path, item.span(), message)),
        }
    }
    if table.len() > MAX_FREE {
        let message = format!(
            "free has {} keys; at most {MAX_FREE} are allowed",
            table.len()
        );
        reader.fault("free", item.and_then(Item::span), message);
    }
    all
}

/// Returns the spec of each combination of choices.
fn variants(reader: &mut FaultCollector, free: &[FreeKey], file: &SpecFile) -> Vec<SpecFile> {
    let mut variants = vec![file.clone()];
    for free in free {
        let FreeValues::Choice(texts) = &free.values else {
            continue;
        };
        if variants.len() * texts.len() > MAX_VARIANTS {
            let message = format!("free: the choices have more than {MAX_VARIANTS} combinations");
            reader.fault(&free.path, None, message);
            return variants;
        }
        let mut combined = Vec::with_capacity(variants.len() * texts.len());
        for text in texts {
            for variant in &variants {
                let mut variant = variant.clone();
                let set = variant.set(&free.path, text);
                let faults = match set {
                    Err(fault) => vec![fault],
                    Ok(()) => variant
                        .spec()
                        .err()
                        .map_or_else(Vec::new, |faults| faults.as_slice().to_vec()),
                };
                for fault in faults {
                    let message = format!("free.{} = \"{text}\": {}", free.path, fault.message);
                    reader.fault(&free.path, None, message);
                }
                combined.push(variant);
            }
        }
        variants = combined;
    }
    variants
}

/// Reads the goals and the number of starts.
fn goals(reader: &mut FaultCollector, item: Option<&Item>) -> (Vec<Goal>, usize) {
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
    if names.is_empty() {
        let message = format!(
            "goal.maximise is missing; write one of {all}, as in maximise = \"expected-power\" below [goal]"
        );
        reader.fault("goal.maximise", maximise.and_then(Item::span), message);
    }
    (goals, starts)
}

/// Reads the limits.
fn limits(reader: &mut FaultCollector, item: Option<&Item>, plant: &Plant) -> Vec<Limit> {
    let mut all = Vec::new();
    for (name, item) in reader.table("limits", item).into_iter().flatten() {
        let text = item.as_str().unwrap_or(reader.bare(item));
        match Limit::read(name, text, plant) {
            Ok(limit) => all.push(limit),
            Err(message) => reader.fault(name, item.span(), message),
        }
    }
    all
}

/// Checks that goals and limits are compatible.
fn check_together(reader: &mut FaultCollector, root: &Table, goals: &[Goal], limits: &[Limit]) {
    let has_starts = goals.iter().any(|goal| goal.needs_starts());
    let Some(goal) = goals.first().filter(|_| !has_starts) else {
        return;
    };
    for limit in limits {
        let is_allowed = matches!(
            (goal, limit.quantity),
            (
                Goal::MeanPower,
                LimitedQuantity::Peak(jounce_orbits::OrbitQuantity::ContactForce(_))
            )
        );
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

/// Reads the conditions: `[[conditions]]` with `set` and `weight`.
fn conditions(reader: &mut FaultCollector, item: Option<&Item>, file: &SpecFile) -> Vec<Condition> {
    let Some(item) = item else {
        return vec![Condition {
            values: Vec::new(),
            weight: 1.0,
        }];
    };
    let Some(tables) = item
        .as_array_of_tables()
        .filter(|tables| !tables.is_empty())
    else {
        let message = "conditions must be tables, [[conditions]], each with set = { \"drive.shaker.frequency\" = \"11 Hz\" } and weight = 1";
        reader.fault("conditions", item.span(), message);
        return Vec::new();
    };
    let mut all = Vec::new();
    for table in tables {
        reader.known("conditions.", table, &["set", "weight"]);
        let weight = reader.positive("conditions.weight", table.get("weight"), 1.0);
        let set = table.get("set").and_then(Item::as_table_like);
        let mut values = Vec::new();
        for (path, item) in set.into_iter().flat_map(|set| set.iter()) {
            let text = item.as_str().unwrap_or(reader.bare(item));
            let read = file.numeric_key(path).map_err(|faults| faults.to_string());
            match read.and_then(|key| key.read(text).map(|value| (key, value))) {
                Ok(pair) => values.push(pair),
                Err(message) => reader.fault(path, item.span(), format!("conditions: {message}")),
            }
        }
        all.push(Condition { values, weight });
    }
    all
}

/// Reads the tolerances.
fn tolerances(reader: &mut FaultCollector, item: Option<&Item>, file: &SpecFile) -> Vec<Tolerance> {
    let mut all = Vec::new();
    for (path, item) in reader.table("tolerance", item).into_iter().flatten() {
        let text = item.as_str().unwrap_or(reader.bare(item));
        match Tolerance::read(file, path, text) {
            Ok(tolerance) => all.push(tolerance),
            Err(messages) => messages
                .into_iter()
                .for_each(|message| reader.fault(path, item.span(), message)),
        }
    }
    all
}
