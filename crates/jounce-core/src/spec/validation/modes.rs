//! Lists have one number per mode; windows fit into the duration.

use super::ValidationFaults;
use crate::spec::{Modal, Quantity, Reduction, Spec};

pub(super) fn check(spec: &Spec, broken: &mut ValidationFaults) {
    if spec.beam.is_empty() && spec.mass.is_empty() && spec.modal.is_empty() {
        let text =
            || "there is no structure; add [beam.NAME], [mass.NAME] or [modal.NAME]".to_owned();
        broken.push(|| super::NO_STRUCTURE.to_owned(), text);
    }
    for (name, modal) in &spec.modal {
        check_lists(name, modal, broken);
    }
    check_damping(spec, broken);
    check_count(spec, broken);
    let run = &spec.run;
    if run.average_over_s > run.duration_s {
        let [window, duration] =
            [run.average_over_s, run.duration_s].map(|time| Quantity::Time.write(time));
        broken.push(
            || "run.average_over".to_owned(),
            || format!("is {window}; it must be at most run.duration = {duration}"),
        );
    }
}

fn check_lists(name: &str, modal: &Modal, broken: &mut ValidationFaults) {
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
        broken.push(|| format!("modal.{name}.frequency_hz"), text);
    }
    let mut check = |key: &dyn Fn() -> String, list: &[f64]| {
        if modes > 0 && !list.is_empty() && list.len() != modes {
            let text = || {
                format!(
                    "has {}, but frequency_hz has {modes}; give one per mode",
                    numbers(list.len())
                )
            };
            broken.push(key, text);
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
fn check_damping(spec: &Spec, broken: &mut ValidationFaults) {
    if spec.beam.is_empty() || spec.damping.beyond.is_some() {
        return;
    }
    let damped = damped_elsewhere(spec);
    let (kept, given) = (spec.reduction.modes, spec.damping.ratios.len());
    let wanted = kept.saturating_sub(damped);
    if given < wanted {
        let except = if damped == 0 {
            String::new()
        } else {
            format!(" ({damped} of them damped by [mass] or [modal])")
        };
        let text = || {
            format!(
                "has {}, but {kept} modes are retained{except}, so {wanted} are required; \
                 add ratios, set `beyond` for the others, or lower reduction.modes",
                numbers(given)
            )
        };
        broken.push(|| "damping.ratios".to_owned(), text);
    }
}

/// Without beams the number of modes is known. The default number never exceeds it.
fn check_count(spec: &Spec, broken: &mut ValidationFaults) {
    let there = damped_elsewhere(spec);
    let has_hole = spec
        .modal
        .values()
        .any(|modal| modal.frequency_hz.is_empty());
    let wanted = spec.reduction.modes;
    if spec.beam.is_empty()
        && there > 0
        && !has_hole
        && wanted > there
        && wanted != Reduction::default().modes
    {
        broken.push(
            || "reduction.modes".to_owned(),
            || format!("is {wanted}; it must not exceed the {there} modes of the structure"),
        );
    }
}

/// Returns the number of modes whose damping ratios are given by masses and modal structures; a
/// fixed mass has no mode of its own.
fn damped_elsewhere(spec: &Spec) -> usize {
    spec.mass
        .values()
        .filter(|mass| {
            mass.stiffness_n_m.is_some() || ["ground", "nothing"].contains(&mass.on.as_str())
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
