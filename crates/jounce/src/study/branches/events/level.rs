//! Levels of quantities of an orbit that a user gives.

use crate::contact::Law;
use crate::orbit::Shot;
use crate::plant::Plant;
use crate::spec::Quantity;

/// Times per drive cycle at which the largest value is sought.
const SAMPLES: usize = 1024;

/// Times between two of those about the largest one: the parabola through the highest three has its top within the error of a march.
const CLOSER: usize = 32;

/// A level of a quantity, labelled where a branch passes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// As it was given.
    pub text: String,
    /// The level, SI.
    pub value: f64,
    quantity: OrbitQuantity,
}

/// A quantity of an orbit.
#[derive(Debug, Clone, PartialEq)]
enum OrbitQuantity {
    /// Mean power of all loads and rectified circuits.
    MeanPower,
    /// Largest magnitude of the voltage of a patch.
    Voltage(usize),
    /// Largest magnitude of the strain of a patch.
    Strain(String),
    /// Largest contact force of a stop.
    ContactForce(usize),
}

impl Level {
    /// Reads `QUANTITY=VALUE`: `mean_power`, `voltage.PATCH`, `strain.PATCH` (a number without a unit) or `contact_force.STOP`.
    ///
    /// # Errors
    /// What is wrong with it, and what is allowed.
    pub fn parse(text: &str, plant: &Plant) -> Result<Self, String> {
        let allowed = || format!("{text}: {}", choices(plant));
        let (name, value_text) = text.split_once('=').ok_or_else(allowed)?;
        let (kind, of) = name.trim().split_once('.').unwrap_or((name.trim(), ""));
        let patch = plant.system.modes.patch.keys().position(|own| own == of);
        let stop = plant.system.stops.iter().position(|own| own.name == of && !matches!(own.law, Law::Rigid(_)));
        let (quantity, unit) = match (kind, patch, stop) {
            ("mean_power", ..) if of.is_empty() => (OrbitQuantity::MeanPower, Some(Quantity::Power)),
            ("voltage", Some(patch), _) => (OrbitQuantity::Voltage(patch), Some(Quantity::Voltage)),
            ("strain", Some(_), _) if has_strain(plant, of) => (OrbitQuantity::Strain(of.to_owned()), None),
            ("contact_force", _, Some(stop)) => (OrbitQuantity::ContactForce(stop), Some(Quantity::Force)),
            _ => return Err(allowed()),
        };
        let value = match unit {
            Some(unit) => unit.read(value_text.trim()).map_err(|error| format!("{text}: {error}"))?,
            None => value_text.trim().parse().map_err(|_| format!("{text}: a strain is a number without a unit, as 3e-4"))?,
        };
        if value > 0.0 && f64::is_finite(value) {
            Ok(Self { text: text.to_owned(), value, quantity })
        } else {
            Err(format!("{text}: a level must be above zero"))
        }
    }

    /// The quantity of an orbit less the level, relative to it.
    pub(in crate::study::branches) fn off(&self, shot: &Shot) -> f64 {
        let plant = &shot.kernel.plant;
        let reached = match &self.quantity {
            OrbitQuantity::MeanPower => shot.loads_w.iter().sum(),
            OrbitQuantity::Voltage(patch) => largest(shot, |state, _| plant.patch_voltages_v(state)[*patch].abs()),
            OrbitQuantity::Strain(patch) => largest(shot, |state, _| {
                let strain = |shape: &Vec<f64>| shape.iter().zip(state).map(|(s, q)| s * q).sum::<f64>().abs();
                plant.system.modes.patch[patch].strain.iter().map(strain).fold(0.0, f64::max)
            }),
            OrbitQuantity::ContactForce(stop) => largest(shot, |_, forces_n| forces_n[*stop]),
        };
        reached / self.value - 1.0
    }
}

fn has_strain(plant: &Plant, patch: &str) -> bool {
    plant.system.modes.patch.get(patch).is_some_and(|patch| !patch.strain.is_empty())
}

/// What may be given, for a message.
fn choices(plant: &Plant) -> String {
    let patches = plant.system.modes.patch.keys().flat_map(|patch| {
        let strain = has_strain(plant, patch).then(|| format!("strain.{patch}=3e-4"));
        std::iter::once(format!("voltage.{patch}=\"5 V\"")).chain(strain)
    });
    let stops = plant.system.stops.iter().filter(|stop| !matches!(stop.law, Law::Rigid(_)));
    let forces = stops.map(|stop| format!("contact_force.{}=\"2 N\"", stop.name));
    let all: Vec<String> = std::iter::once("mean_power=\"50 uW\"".to_owned()).chain(patches).chain(forces).collect();
    format!("write QUANTITY=VALUE; here {} can be given", all.join(", "))
}

/// Largest value over the period of a function of the physical state and the contact forces.
fn largest(shot: &Shot, value: impl Fn(&[f64], &[f64]) -> f64) -> f64 {
    let plant = &shot.kernel.plant;
    let cycle_s = shot.period_s / shot.trajectories.len() as f64;
    let of_cycle = |trajectory: &crate::march::Trajectory| {
        let at = |times_s: &[f64]| -> Vec<f64> {
            let instants = trajectory.at(&shot.kernel, times_s);
            instants.iter().map(|at| value(&plant.to_physical(&at.state, at.time_s), &at.forces_n)).collect()
        };
        let step_s = cycle_s / SAMPLES as f64;
        let rough = at(&(0..=SAMPLES).map(|k| k as f64 * step_s).collect::<Vec<_>>());
        let top = (0..rough.len()).max_by(|a, b| rough[*a].total_cmp(&rough[*b])).unwrap_or(0);
        let (from, closer_s) = (top.saturating_sub(1) as f64 * step_s, 2.0 * step_s / CLOSER as f64);
        let times: Vec<f64> = (0..=CLOSER).map(|k| (from + k as f64 * closer_s).min(cycle_s)).collect();
        parabola_top(&at(&times)).max(rough[top])
    };
    shot.trajectories.iter().map(of_cycle).fold(0.0, f64::max)
}

/// Top of the parabola through the highest of equally spaced values and its neighbours.
fn parabola_top(values: &[f64]) -> f64 {
    let top = (0..values.len()).max_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    if top == 0 || top + 1 >= values.len() {
        return values.get(top).copied().unwrap_or(0.0);
    }
    let (slope, bend) = (0.5 * (values[top + 1] - values[top - 1]), values[top + 1] - 2.0 * values[top] + values[top - 1]);
    if bend < 0.0 { values[top] - 0.5 * slope * slope / bend } else { values[top] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_finds_its_own_top() {
        let values: Vec<f64> = (0..5).map(|k| 3.0 - (f64::from(k) - 1.7).powi(2)).collect();
        assert!((parabola_top(&values) - 3.0).abs() < 1e-14);
        assert_eq!(parabola_top(&[1.0, 2.0, 3.0]), 3.0);
    }
}
