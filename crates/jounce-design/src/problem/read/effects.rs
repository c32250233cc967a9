//! Free keys on which nothing depends.

use super::free::span_of;
use crate::problem::{FreeKey, FreeRange, FreeValues, Problem};
use jounce_analysis::Model;
use jounce_analysis::study::FaultCollector;
use jounce_spec::NumericKey;
use toml_edit::Table;

/// Places of a range at which the harvesters are compared, its ends first.
const PLACES: [f64; 5] = [0.0, 1.0, 0.5, 0.25, 0.75];

/// Table of the spec that only goals of a run depend on.
const RUN: &str = "run.";

/// Refuses free keys whose values all lead to the same goals and limits: the equations of the
/// harvester, the limited sizes and, for goals of a run, the run are the same.
pub(super) fn check(
    reader: &mut FaultCollector,
    root: &Table,
    problem: &Problem,
    models: &[Vec<Model>],
) {
    let mut stride = 1;
    for (index, free) in problem.free.iter().enumerate() {
        let has_effect = match &free.values {
            FreeValues::Choice(choices) => {
                let own = (stride, choices.len());
                stride *= choices.len();
                let mut models = models.iter();
                models.any(|models| choice_has_effect(problem, models, own))
                    || has_ranges(problem, index)
            }
            FreeValues::Range(_) if free.path.starts_with(RUN) && !has_run(problem) => false,
            FreeValues::Range(range) => {
                let mut models = models.iter();
                models.any(|models| range_has_effect(problem, models, (free, range)))
            }
        };
        if !has_effect {
            let path = &free.path;
            let message = match &free.values {
                FreeValues::Range(_) => format!(
                    "free.{path}: no goal and no limit depends on this key; remove it from [free]"
                ),
                FreeValues::Choice(_) => format!(
                    "free.{path}: no goal and no limit depends on this choice; remove it from [free], or remove values from the spec that it should set"
                ),
            };
            reader.fault(path, span_of(root, path), message);
        }
    }
}

/// True where ranges belong to a choice.
fn has_ranges(problem: &Problem, index: usize) -> bool {
    let mut withs = problem.free.iter().filter_map(|free| free.with);
    withs.any(|with| with.free == index)
}

/// True where two choices of a key lead to different harvesters with the same other choices.
fn choice_has_effect(problem: &Problem, models: &[Model], (stride, count): (usize, usize)) -> bool {
    (0..models.len()).any(|variant| {
        let own = variant / stride % count;
        let first = variant - own * stride;
        own > 0 && !is_same(problem, &models[first], &models[variant])
    })
}

/// True where two values of a range lead to different harvesters, or where this cannot be seen.
fn range_has_effect(
    problem: &Problem,
    models: &[Model],
    (free, range): (&FreeKey, &FreeRange),
) -> bool {
    let applies = |variant: usize| {
        let is_own = |(k, one): (usize, usize)| {
            free.with
                .is_none_or(|with| with.free != k || with.choice == one)
        };
        problem.choices_of(variant).into_iter().all(is_own)
    };
    (0..models.len())
        .filter(|variant| applies(*variant))
        .any(|variant| differs(problem, &models[variant], range))
}

/// True where two values lead to different changes of a model, or where fewer than two are allowed.
fn differs(problem: &Problem, model: &Model, range: &FreeRange) -> bool {
    let at = |place: &f64| {
        let mut spec = model.spec.clone();
        NumericKey::set_all(&mut spec, &[(&range.key, range.value(*place))]).ok()?;
        model.changed(spec).ok()
    };
    let mut models = PLACES.iter().filter_map(at);
    let Some(first) = models.next() else {
        return true;
    };
    let mut count = 0;
    for other in models {
        if !is_same(problem, &first, &other) {
            return true;
        }
        count += 1;
    }
    count == 0
}

/// True where two models have the same goals and limits.
fn is_same(problem: &Problem, one: &Model, other: &Model) -> bool {
    let sizes = problem.sizes();
    let mut sizes = sizes.iter().map(|(_, size)| size);
    let has_same_run = || {
        let start = |model: &Model| model.start(&problem.folder).ok();
        one.spec.run == other.spec.run && start(one) == start(other)
    };
    one.kernel.plant.system == other.kernel.plant.system
        && sizes.all(|size| size.of(&one.spec) == size.of(&other.spec))
        && (!has_run(problem) || has_same_run())
}

/// True where a goal is one of a run.
fn has_run(problem: &Problem) -> bool {
    problem.goals.iter().any(|goal| goal.needs_run())
}
