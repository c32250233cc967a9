//! The points of a force table are those of a contact that never pulls and never softens to zero.

use super::ValidationFaults;
use crate::{ForceTable, Spec, StopLaw};

/// Largest number of points of a table.
const MAX_POINTS: usize = 4096;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    let tables = spec
        .stop
        .iter()
        .filter(|(_, stop)| matches!(stop.law, StopLaw::Table { .. }));
    for (name, stop) in tables {
        for (key, text) in faults_of(&stop.table) {
            faults.push(|| format!("stop.{name}.{key}"), || text);
        }
    }
}

/// Returns all faults of a table: the key and one sentence. An empty list is a hole.
pub(crate) fn faults_of(table: &ForceTable) -> Vec<(&'static str, String)> {
    let (at, force) = (&table.penetration_m, &table.force_n);
    if at.is_empty() || force.is_empty() {
        return Vec::new();
    }
    let mut faults = Vec::new();
    if at.len() != force.len() {
        let text = format!(
            "has {} numbers, but penetration_m has {}; give one force for each penetration",
            force.len(),
            at.len()
        );
        faults.push(("force_n", text));
    }
    if at.len() > MAX_POINTS {
        let text = format!("has {} points; give at most {MAX_POINTS}", at.len());
        faults.push(("penetration_m", text));
    }
    if at[0] == 0.0 && force[0] != 0.0 {
        let text = format!(
            "has {} N at zero penetration, where a stop does not push; start with 0, or omit this point",
            force[0]
        );
        faults.push(("force_n", text));
    }
    if at.len() == 1 && at[0] == 0.0 {
        let text = "has only the point at 0; give at least one penetration above 0".to_owned();
        faults.push(("penetration_m", text));
    }
    let rule = "larger than the one before it";
    let not_rising = falls(at, |before, after| after <= before);
    faults.extend(not_rising.map(|index| ("penetration_m", order(at, index, "m", rule))));
    let rule = "at least the one before it; smooth a measured table first";
    let mut is_reported = at.len() == 1 && at[0] == 0.0;
    for index in falls(force, |before, after| after < before) {
        faults.push(("force_n", order(force, index, "N", rule)));
        is_reported |= index + 1 == force.len();
    }
    let last = force.len() - 1;
    let before = last.checked_sub(1).map_or(0.0, |index| force[index]);
    if force[last] <= before && !is_reported {
        let text = format!(
            "has {} N at the last point, no more than the force before it; the last force must be larger, because its slope continues past the table",
            force[last]
        );
        faults.push(("force_n", text));
    }
    faults
}

/// Returns the index of each number that violates an order with the one before it.
fn falls(values: &[f64], is_wrong: impl Fn(f64, f64) -> bool) -> impl Iterator<Item = usize> {
    let pairs = values.windows(2).enumerate();
    pairs.filter_map(move |(index, pair)| is_wrong(pair[0], pair[1]).then_some(index + 1))
}

fn order(values: &[f64], index: usize, unit: &str, rule: &str) -> String {
    format!(
        "has {} {unit} as number {}, after {} {unit}; each number must be {rule}",
        values[index],
        index + 1,
        values[index - 1]
    )
}
