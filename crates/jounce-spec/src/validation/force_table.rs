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
        if let Some((key, text)) = fault(&stop.table) {
            faults.push(|| format!("stop.{name}.{key}"), || text);
        }
    }
}

/// Returns the first fault of a table: the key and one sentence. An empty list is a hole.
fn fault(table: &ForceTable) -> Option<(&'static str, String)> {
    let (at, force) = (&table.penetration_m, &table.force_n);
    if at.is_empty() || force.is_empty() {
        return None;
    }
    if at.len() != force.len() {
        return Some((
            "force_n",
            format!(
                "has {} numbers, but penetration_m has {}; give one force for each penetration",
                force.len(),
                at.len()
            ),
        ));
    }
    if at.len() > MAX_POINTS {
        let text = format!("has {} points; give at most {MAX_POINTS}", at.len());
        return Some(("penetration_m", text));
    }
    if at[0] == 0.0 && force[0] != 0.0 {
        let text = format!(
            "has {} N at zero penetration, where a stop does not push; start with 0, or omit this point",
            force[0]
        );
        return Some(("force_n", text));
    }
    if at.len() == 1 && at[0] == 0.0 {
        let text = "has only the point at 0; give at least one penetration above 0".to_owned();
        return Some(("penetration_m", text));
    }
    falls(at, |before, after| after <= before)
        .map(|i| ("penetration_m", order(at, i, "m", "larger than the one before it")))
        .or_else(|| {
            let index = falls(force, |before, after| after < before)?;
            Some(("force_n", order(force, index, "N", "at least the one before it; smooth a measured table first")))
        })
        .or_else(|| {
            let before = force.len().checked_sub(2).map_or(0.0, |index| force[index]);
            let last = force[force.len() - 1];
            (last <= before).then(|| {
                ("force_n", format!("has {last} N at the last point, no more than the force before it; the last force must be larger, because its slope continues past the table"))
            })
        })
}

/// Returns the index of the first number that violates an order with the one before it.
fn falls(values: &[f64], is_wrong: impl Fn(f64, f64) -> bool) -> Option<usize> {
    let index = values
        .windows(2)
        .position(|pair| is_wrong(pair[0], pair[1]))?;
    Some(index + 1)
}

fn order(values: &[f64], index: usize, unit: &str, rule: &str) -> String {
    format!(
        "has {} {unit} as number {}, after {} {unit}; each number must be {rule}",
        values[index],
        index + 1,
        values[index - 1]
    )
}
