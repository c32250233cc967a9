//! Where the contacts of an orbit begin, and how far those of another orbit lie from them.

use crate::march::Trajectory;
use std::collections::BTreeMap;

/// The beginning of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactStart {
    /// Number of the stop.
    pub stop: usize,
    /// Time in the period, as a share of it.
    pub share: f64,
}

/// All of a period. A contact that lasts over the end of the period begins once.
pub(super) fn contact_starts(trajectories: &[Trajectory], period_s: f64) -> Vec<ContactStart> {
    let cycle_s = period_s / trajectories.len() as f64;
    let mut found = Vec::new();
    let pressed = |trajectory: &Trajectory| -> Vec<usize> {
        trajectory.segments().last().map_or_else(Vec::new, |segment| segment.forces.iter().map(|force| force.port).collect())
    };
    let mut touching: Vec<usize> = trajectories.last().map_or_else(Vec::new, pressed);
    for (cycle, trajectory) in trajectories.iter().enumerate() {
        let segments = trajectory.segments();
        let share = |time_s: f64| (cycle as f64 * cycle_s + time_s) / period_s;
        for segment in segments {
            let now: Vec<usize> = segment.forces.iter().map(|force| force.port).collect();
            let new = now.iter().filter(|port| !touching.contains(port));
            found.extend(new.map(|port| ContactStart { stop: *port, share: share(segment.start_s) }));
            touching = now;
        }
        let struck = trajectory.impacts().iter();
        found.extend(struck.map(|impact| ContactStart {
            stop: impact.port,
            share: share(segments.get(impact.after).map_or(cycle_s, |next| next.start_s)),
        }));
    }
    found
}

/// The farthest that a contact lies from its partner, as a share of the period, where those of two orbits are joined in their order round the
/// period so that this is least; `None` where a stop is touched more often in one of the two.
pub fn contacts_apart(one: &[ContactStart], two: &[ContactStart]) -> Option<f64> {
    let by_stop = |all: &[ContactStart]| {
        let mut shares: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
        all.iter().for_each(|own| shares.entry(own.stop).or_default().push(own.share));
        shares.values_mut().for_each(|own| own.sort_by(f64::total_cmp));
        shares
    };
    let (one, two) = (by_stop(one), by_stop(two));
    if one.len() != two.len() {
        return None;
    }
    one.iter().try_fold(0.0_f64, |farthest, (stop, from)| {
        let to = two.get(stop).filter(|to| to.len() == from.len())?;
        let apart = |a: f64, b: f64| {
            let way = (a - b).abs();
            way.min(1.0 - way)
        };
        let turned = |by: usize| (0..from.len()).map(|k| apart(from[k], to[(k + by) % to.len()])).fold(0.0, f64::max);
        Some(farthest.max((0..from.len()).map(turned).fold(f64::INFINITY, f64::min)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(shares: &[f64]) -> Vec<ContactStart> {
        shares.iter().map(|share| ContactStart { stop: 0, share: *share }).collect()
    }

    #[test]
    fn contacts_are_joined_round_the_period() {
        let moved = |one: &[f64], two: &[f64]| contacts_apart(&of(one), &of(two));
        assert!(moved(&[], &[]) == Some(0.0) && moved(&[0.1], &[]).is_none());
        assert!((moved(&[0.01, 0.5], &[0.52, 0.99]).unwrap_or(1.0) - 0.02).abs() < 1e-12, "over the end of the period");
        assert!((moved(&[0.1, 0.5], &[0.1, 0.8]).unwrap_or(0.0) - 0.3).abs() < 1e-12, "one goes, another comes");
        let other = [ContactStart { stop: 0, share: 0.1 }, ContactStart { stop: 1, share: 0.5 }];
        assert!(contacts_apart(&of(&[0.1, 0.5]), &other).is_none(), "another stop is touched");
    }
}
