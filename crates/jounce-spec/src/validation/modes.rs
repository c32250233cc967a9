//! Lists have one number per mode; windows fit into the duration.

use super::ValidationFaults;
use crate::{GROUND, Modal, NO_SUPPORT, Quantity, Reduction, Spec};

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    if spec.beam.is_empty()
        && spec.plate.is_empty()
        && spec.mass.is_empty()
        && spec.modal.is_empty()
    {
        let text = || {
            "there is no structure; add [beam.NAME], [plate.NAME], [mass.NAME] or [modal.NAME]"
                .to_owned()
        };
        faults.push(|| super::NO_STRUCTURE.to_owned(), text);
    }
    for (name, modal) in &spec.modal {
        check_lists(name, modal, faults);
    }
    check_damping(spec, faults);
    check_count(spec, faults);
    let run = &spec.run;
    if run.average_over_s > run.duration_s {
        let [window, duration] =
            [run.average_over_s, run.duration_s].map(|time| Quantity::Time.write(time));
        faults.push(
            || "run.average_over".to_owned(),
            || {
                format!(
                    "is {window}; it must be at most run.duration = {duration}: \
                     write run.average_over = \"{duration}\" or run.duration = \"{window}\""
                )
            },
        );
    }
}

fn check_lists(name: &str, modal: &Modal, faults: &mut ValidationFaults) {
    let modes = modal.frequency_hz.len();
    let pairs = modal.frequency_hz.windows(2).enumerate();
    if let Some((index, pair)) = pairs.into_iter().find(|(_, pair)| pair[0] > pair[1]) {
        let text = || {
            format!(
                "frequencies must ascend, but number {} is {} after {}",
                index + 2,
                pair[1],
                pair[0]
            )
        };
        faults.push(|| format!("modal.{name}.frequency_hz"), text);
    }
    let mut check = |key: &dyn Fn() -> String, list: &[f64]| {
        if modes > 0 && !list.is_empty() && list.len() != modes {
            let text = || {
                format!(
                    "has {}, but frequency_hz has {modes}; give one per mode",
                    numbers(list.len())
                )
            };
            faults.push(key, text);
        }
    };
    check(
        &|| format!("modal.{name}.damping_ratio"),
        &modal.damping_ratio,
    );
    check(
        &|| format!("modal.{name}.participation_sqrt_kg"),
        &modal.participation_sqrt_kg,
    );
    for (point, shape) in &modal.point {
        check(&|| format!("modal.{name}.point.{point}"), shape);
    }
    for (patch, values) in &modal.patch {
        check(
            &|| format!("modal.{name}.patch.{patch}.coupling_n_per_v"),
            &values.coupling_n_per_v,
        );
    }
}

/// Every retained mode needs a damping ratio, given with its mass or here.
fn check_damping(spec: &Spec, faults: &mut ValidationFaults) {
    let is_bodies_only = spec.beam.is_empty() && spec.plate.is_empty();
    if is_bodies_only || spec.damping.beyond.is_some() {
        return;
    }
    let damped = damped_elsewhere(spec);
    let (modes, ratios) = (spec.reduction.modes, spec.damping.ratios.len());
    let expected = modes.saturating_sub(damped);
    if ratios < expected {
        let except = if damped == 0 {
            String::new()
        } else {
            format!(" ({damped} of them damped by [mass] or [modal])")
        };
        let text = || {
            format!(
                "has {}, but {modes} modes are retained{except}, so {expected} are required; \
                 add ratios, set `beyond` for the others, or lower reduction.modes",
                numbers(ratios)
            )
        };
        faults.push(|| "damping.ratios".to_owned(), text);
    }
}

/// Without beams and plates the number of modes is known. The default number never exceeds it.
fn check_count(spec: &Spec, faults: &mut ValidationFaults) {
    let elsewhere = damped_elsewhere(spec);
    let has_hole = spec
        .modal
        .values()
        .any(|modal| modal.frequency_hz.is_empty());
    let expected = spec.reduction.modes;
    if spec.beam.is_empty()
        && spec.plate.is_empty()
        && elsewhere > 0
        && !has_hole
        && expected > elsewhere
        && expected != Reduction::default().modes
    {
        faults.push(
            || "reduction.modes".to_owned(),
            || format!("is {expected}; it must not exceed the {elsewhere} modes of the structure"),
        );
    }
}

/// Returns the number of modes whose damping ratios are given by masses and modal structures; a
/// fixed mass has no mode of its own.
fn damped_elsewhere(spec: &Spec) -> usize {
    spec.mass
        .values()
        .filter(|mass| {
            mass.stiffness_n_m.is_some() || [GROUND, NO_SUPPORT].contains(&mass.on.as_str())
        })
        .count()
        + spec
            .modal
            .values()
            .map(|modal| modal.frequency_hz.len())
            .sum::<usize>()
}

fn numbers(count: usize) -> String {
    if count == 1 {
        "1 number".to_owned()
    } else {
        format!("{count} numbers")
    }
}
