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

mod choices;
mod conditions;
mod effects;
mod free;
mod goals;
mod limits;
mod variants;

use super::{Condition, Goal, Limit, Problem, SpecSource, Tolerance, digest};
use crate::DesignError;
use conditions::conditions;
use free::{check_paths, free};
use goals::{check_goals, goals};
use jounce_analysis::Model;
use jounce_analysis::study::FaultCollector;
use jounce_control::Control;
use jounce_spec::{DriveSignal, Spec, SpecFile};
use limits::{check_limits, check_together, limits};
use toml_edit::{Item, Table};
use variants::{check_keys, variants};

/// Keys of a problem.
const KEYS: [&str; 10] = [
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

/// Reads a text; `source` finds the spec by the path in the text, `None` if it names no path.
pub(super) fn read(
    text: &str,
    source: impl FnOnce(Option<&str>) -> Result<SpecSource, DesignError>,
) -> Result<Problem, DesignError> {
    let mut reader = FaultCollector::new(text);
    let Some(document) = reader.document() else {
        return Err(DesignError::Faults(reader.sorted()));
    };
    let root = document.as_table();
    reader.known("", root, &KEYS);
    let path = reader.text("spec", root.get("spec"));
    let SpecSource { file, name, folder } =
        source(path).map_err(|error| unread_spec(text, root, error))?;
    let spec = file
        .spec()
        .map_err(|faults| DesignError::Spec { file: name, faults })?;
    let model = Model::new(spec.clone())?;
    let free = free(&mut reader, root.get("free"), &file);
    let (goals, starts, limits) = wanted(&mut reader, root, &model);
    let (conditions, changes) = conditions(&mut reader, root.get("conditions"), &file);
    check_paths(&mut reader, root, &free, &conditions, &changes);
    let tolerances = tolerances(&mut reader, root.get("tolerance"), &file);
    let seed = reader.integer("seed", root.get("seed"), (0, 1 << 53), 1);
    let evaluations = root.get("evaluations");
    let evaluations = reader.integer("evaluations", evaluations, (1, 100_000_000), 1000) as usize;
    let draws = reader.integer("draws", root.get("draws"), (8, 1 << 20), 128) as usize;
    let seconds = root.get("seconds");
    let seconds = seconds.map(|item| reader.positive("seconds", Some(item), 1.0));
    let variants = variants(&mut reader, root, &free, &file);
    if !reader.faults.is_empty() {
        return Err(DesignError::Faults(reader.sorted()));
    }
    let mut problem = Problem {
        file,
        variants,
        spec,
        folder,
        free,
        goals,
        starts,
        limits,
        conditions,
        changes,
        has_noise: false,
        tolerances,
        draws,
        seed,
        evaluations,
        seconds,
        hash_hex: String::new(),
    };
    let models = problem.models(&Control::default())?;
    problem.hash_hex = digest(text, &problem.folder, models.iter().flatten());
    problem.has_noise = models.iter().flatten().any(|model| has_noise(&model.spec));
    check(&mut reader, root, &problem, &models);
    match reader.faults.is_empty() {
        true => Ok(problem),
        false => Err(DesignError::Faults(reader.sorted())),
    }
}

/// Returns the error of a spec that cannot be read, with the place of its path.
fn unread_spec(text: &str, root: &Table, error: DesignError) -> DesignError {
    let DesignError::SpecFile(error) = error else {
        return error;
    };
    let mut reader = FaultCollector::new(text);
    let span = root.get("spec").and_then(Item::span);
    reader.fault("spec", span, format!("spec: {error}"));
    DesignError::Faults(reader.sorted())
}

/// Reads the goals, the number of starts and the limits, and checks that the spec can have them.
fn wanted(
    reader: &mut FaultCollector,
    root: &Table,
    model: &Model,
) -> (Vec<Goal>, usize, Vec<Limit>) {
    let (goals, starts) = goals(reader, root.get("goal"));
    check_goals(reader, root, &goals, (model, ""));
    let limits = limits(reader, root.get("limits"), model);
    check_together(reader, root, &goals, &limits);
    (goals, starts, limits)
}

/// True where a drive of a spec is noise.
fn has_noise(spec: &Spec) -> bool {
    let mut drives = spec.drive.values();
    drives.any(|drive| matches!(drive.signal, DriveSignal::Noise { .. }))
}

/// Checks the harvesters of all combinations of choices and of all conditions, and the effects of the
/// free keys.
fn check(reader: &mut FaultCollector, root: &Table, problem: &Problem, models: &[Vec<Model>]) {
    for (change, models) in models.iter().enumerate() {
        let conditions = problem.conditions.iter();
        let own: Vec<&Condition> = conditions.filter(|one| one.change == change).collect();
        // The harvester of the spec as given has been checked.
        if own.is_empty() || (models.len() == 1 && change == 0) {
            continue;
        }
        let in_condition = problem.change_text(change);
        for (index, model) in models.iter().enumerate() {
            let parts = [problem.choices_text(index), in_condition.clone()];
            let parts = parts.into_iter().filter(|part| !part.is_empty());
            let choices = parts.collect::<Vec<_>>().join(", ");
            let with = format!("; this concerns {choices}");
            check_goals(reader, root, &problem.goals, (model, &with));
            check_keys(reader, root, &problem.free, &own, (&model.spec, &choices));
            check_limits(reader, root, &problem.limits, (model, &choices));
            if !reader.faults.is_empty() {
                return;
            }
        }
    }
    effects::check(reader, root, problem, models);
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
