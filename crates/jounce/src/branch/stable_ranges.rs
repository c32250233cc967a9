//! Ranges of the key over which the orbits of a branch are stable.

use super::{Bifurcation, Branch, BranchPoint, Termination, TerminationReason};
use jounce_analysis::BranchKind;

impl Branch {
    /// Returns the ranges of the key over which the orbits are stable, in the order of the branch. A
    /// range ends at the bifurcation that changes the stability; where none was located, at the last
    /// stable point. Two ranges may overlap: a branch that turns back has several orbits at one
    /// value.
    pub fn stable_ranges(&self) -> Vec<(f64, f64)> {
        let mut ranges: Vec<(f64, f64)> = Vec::new();
        let mut was_stable = false;
        for (index, point) in self.points.iter().enumerate() {
            if point.stable && !was_stable {
                ranges.push((f64::INFINITY, f64::NEG_INFINITY));
            }
            let edge = index
                .checked_sub(1)
                .filter(|_| point.stable != was_stable)
                .and_then(|before| self.stability_change([&self.points[before], point]));
            let values = point
                .stable
                .then_some(point.parameter)
                .into_iter()
                .chain(edge);
            if let Some((low, high)) = ranges.last_mut() {
                for value in values {
                    (*low, *high) = (low.min(value), high.max(value));
                }
            }
            was_stable = point.stable;
        }
        // A closed branch continues at its first point.
        let is_closed = |end: &Termination| end.reason == TerminationReason::Closed;
        let is_joined = was_stable && self.points[0].stable;
        if is_joined
            && self.termination.iter().any(is_closed)
            && let [first, .., last] = &mut ranges[..]
        {
            *first = (first.0.min(last.0), first.1.max(last.1));
            ranges.pop();
        }
        ranges
    }

    /// True where a stable part of the branch ends at one of its bifurcations.
    pub fn ends_stable_part(&self, bifurcation: &Bifurcation) -> bool {
        let mut pairs = self.points.windows(2);
        pairs.any(|pair| {
            pair[0].stable != pair[1].stable
                && self
                    .located([&pair[0], &pair[1]])
                    .is_some_and(|own| std::ptr::eq(own, bifurcation))
        })
    }

    /// Returns the value of the key at which the stability changes between two neighbouring points.
    fn stability_change(&self, pair: [&BranchPoint; 2]) -> Option<f64> {
        self.located(pair).map(|own| own.parameter)
    }

    /// Returns the bifurcation between two neighbouring points of different stability: a grazing
    /// only without another one, because a bifurcation of the multipliers explains the change.
    fn located(&self, pair: [&BranchPoint; 2]) -> Option<&Bifurcation> {
        let ends = pair.map(|point| point.parameter);
        let between = || {
            let all = self.bifurcations.iter();
            all.filter(move |own| own.neighbours == Some(ends))
        };
        let of_multipliers =
            |own: &&Bifurcation| !matches!(own.kind, BranchKind::Grazing | BranchKind::Level);
        let grazing = |own: &&Bifurcation| own.kind == BranchKind::Grazing;
        between()
            .find(of_multipliers)
            .or_else(|| between().find(grazing))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch(points: &[(f64, bool)], bifurcations: &[(BranchKind, f64, [f64; 2])]) -> Branch {
        let point = |&(parameter, stable): &(f64, bool)| BranchPoint {
            parameter,
            mean_power_w: 0.0,
            voltage_rms_v: 0.0,
            stable,
            stability_undecided: false,
            floquet_max_abs: 0.5,
            contacts_per_period: 0,
            max_penetration_m: 0.0,
            displacement_peak_m: 0.0,
            error_estimate: 0.0,
            warnings: Vec::new(),
        };
        let bifurcation = |&(kind, parameter, neighbours): &(_, f64, [f64; 2])| Bifurcation {
            kind,
            parameter,
            parameter_error: None,
            mean_power_w: 0.0,
            displacement_peak_m: 0.0,
            contacts_per_period: 0,
            level: None,
            stop: None,
            neighbours: Some(neighbours),
        };
        Branch {
            period_cycles: 1,
            points: points.iter().map(point).collect(),
            bifurcations: bifurcations.iter().map(bifurcation).collect(),
            not_proved: Vec::new(),
            termination: Vec::new(),
            not_followed: 0,
            peak: None,
            half_power_bandwidth: None,
        }
    }

    #[test]
    fn stable_ranges_end_at_their_bifurcations() {
        let points = [
            (1.0, true),
            (2.0, true),
            (1.9, false),
            (1.5, false),
            (1.7, true),
        ];
        let events = [
            (BranchKind::Grazing, 1.95, [2.0, 1.9]),
            (BranchKind::Fold, 2.1, [2.0, 1.9]),
            (BranchKind::NeimarkSacker, 1.6, [1.9, 1.5]),
        ];
        let branch = branch(&points, &events);
        assert_eq!(branch.stable_ranges(), [(1.0, 2.1), (1.7, 1.7)]);
        let ends = branch.bifurcations.iter();
        let ends: Vec<bool> = ends.map(|own| branch.ends_stable_part(own)).collect();
        assert_eq!(ends, [false, true, false]);
    }

    #[test]
    fn a_stable_range_passes_the_first_point_of_a_closed_branch() {
        let points = [(1.0, true), (2.0, false), (1.5, true), (1.0, true)];
        let mut closed = branch(&points, &[]);
        assert_eq!(closed.stable_ranges(), [(1.0, 1.0), (1.0, 1.5)]);
        closed.termination.push(Termination {
            reason: TerminationReason::Closed,
            parameter: None,
            message: None,
        });
        assert_eq!(closed.stable_ranges(), [(1.0, 1.5)]);
        assert!(branch(&[(1.0, false)], &[]).stable_ranges().is_empty());
    }
}
