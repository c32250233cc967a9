//! Multipliers of two neighbouring points, joined into groups with test functions that are smooth
//! where members meet.
//!
//! ```text
//! doubling  prod (1 + mu_i)      fold, branch point  prod (1 - mu_i)      Neimark-Sacker  prod_(i < j) (mu_i mu_j - 1)
//! ```
//!
//! A group contains its conjugates. Where two real multipliers become a complex pair on the step,
//! it contains both. So the products are real and smooth, unlike single multipliers. Products over
//! all multipliers would be smooth too. But pairs of fast modes rotate several times about the
//! origin on a step, and would hide the slow ones.

use super::interpolant::Interpolant;
use super::linking::linked_pairs;
use super::test_data::TestDataPair;
use jounce_linalg::c64;

/// Function of the multipliers of a group.
pub(in crate::branches) type TestFunction = fn(&[c64]) -> f64;

/// Group of multipliers, by their indices at the two ends of a step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct MultiplierGroup {
    pub from: Vec<usize>,
    pub to: Vec<usize>,
}

/// One end of a step: its data, and the length of the step as measured there.
#[derive(Debug, Clone, Copy)]
pub(in crate::branches) struct StepEnd<'r> {
    pub readings: &'r TestDataPair,
    pub length: f64,
}

impl StepEnd<'_> {
    pub fn value(&self, i: usize) -> c64 {
        self.readings.current.multipliers[i]
    }

    /// Returns the change of a multiplier over the step, by its derivative.
    pub fn change(&self, i: usize) -> c64 {
        (self.readings.multipliers[i] - self.value(i)) * self.per()
    }

    /// Returns the factor from differences to derivatives times the length of the step.
    pub fn per(&self) -> f64 {
        self.length / self.readings.length
    }

    pub fn count(&self) -> usize {
        self.readings.current.multipliers.len()
    }

    /// Returns the index of the conjugate.
    pub fn conjugate(&self, i: usize) -> usize {
        let conjugate = self.value(i).conj();
        if conjugate.im == 0.0 {
            return i;
        }
        let distance = |j: usize| (self.value(j) - conjugate).norm_sqr();
        (0..self.count())
            .map(|j| (distance(j), j))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(i, |(_, j)| j)
    }

    /// Returns a function of some multipliers, and its change over the step by its derivative.
    fn of(&self, members: &[usize], f: TestFunction) -> (f64, f64) {
        let all = |values: &[c64]| f(&members.iter().map(|i| values[*i]).collect::<Vec<_>>());
        let value = all(&self.readings.current.multipliers);
        (
            value,
            (all(&self.readings.multipliers) - value) * self.per(),
        )
    }
}

/// Returns a function of a group between two ends.
pub(super) fn between(
    [a, b]: [StepEnd; 2],
    group: &MultiplierGroup,
    f: TestFunction,
) -> Interpolant {
    let (from, to) = (a.of(&group.from, f), b.of(&group.to, f));
    Interpolant {
        values: [from.0, to.0],
        slopes: [from.1, to.1],
    }
}

/// Returns by how much a zero of a test function at a fraction of the step contradicts the
/// interpolants of the groups whose function changes its sign, as a fraction of the step; the least
/// of several groups, 0 without one.
pub(in crate::branches) fn contradiction(ends: [StepEnd; 2], f: TestFunction, at: f64) -> f64 {
    groups(ends, &linked_pairs(ends), |_, _| false)
        .iter()
        .map(|group| between(ends, group, f))
        .filter(|function| function.values[0] * function.values[1] < 0.0)
        .map(|function| function.contradiction(at))
        .min_by(f64::total_cmp)
        .unwrap_or(0.0)
}

/// True where the blocks of the group hold it inside the unit circle on the step. Their discs lie
/// inside it at both ends, and remain inside if they change by the same amount again.
pub(super) fn is_enclosed([a, b]: [StepEnd; 2], group: &MultiplierGroup) -> bool {
    let radius = |end: StepEnd, members: &[usize]| {
        members
            .iter()
            .map(|i| end.readings.current.radii[*i])
            .fold(0.0, f64::max)
    };
    let [one, two] = [radius(a, &group.from), radius(b, &group.to)];
    one.max(two) + (one - two).abs() < 1.0
}

/// True where the product of the group changes its sign although all members exceed their error. The
/// period map has an inverse, so no multiplier passes zero: wrong multipliers were linked.
pub(super) fn changes_sign([a, b]: [StepEnd; 2], group: &MultiplierGroup) -> bool {
    let exceed = |end: StepEnd, members: &[usize]| {
        members
            .iter()
            .all(|i| end.value(*i).norm() > end.readings.error)
    };
    let product =
        |end: StepEnd, members: &[usize]| members.iter().map(|i| end.value(*i)).product::<c64>().re;
    product(a, &group.from) * product(b, &group.to) < 0.0
        && exceed(a, &group.from)
        && exceed(b, &group.to)
}

/// Zero where a member of the group is -1.
pub(in crate::branches) fn doubling(values: &[c64]) -> f64 {
    values.iter().map(|mu| 1.0 + mu).product::<c64>().re
}

/// Zero where a member of the group is +1.
pub(in crate::branches) fn fold(values: &[c64]) -> f64 {
    values.iter().map(|mu| 1.0 - mu).product::<c64>().re
}

/// Zero where the product of two members is one.
pub(in crate::branches) fn torus(values: &[c64]) -> f64 {
    let pairs = (0..values.len()).flat_map(|j| (0..j).map(move |i| values[i] * values[j] - 1.0));
    pairs.product::<c64>().re
}

/// Zero where two real multipliers meet.
fn discriminant(values: &[c64]) -> f64 {
    (values[0] - values[1]).powi(2).re
}

/// True where the multipliers whose product passes one are a complex pair: a Neimark-Sacker
/// bifurcation. False where they are real: no event. `None` where two real ones may become a pair
/// on the step.
pub(super) fn is_torus_crossing(ends: [StepEnd; 2], group: &MultiplierGroup) -> Option<bool> {
    let [a, b] = ends;
    let is_real = |i: &usize, end: StepEnd| end.value(*i).im == 0.0;
    let real = group.from.iter().filter(|i| is_real(i, a)).count()
        + group.to.iter().filter(|i| is_real(i, b)).count();
    match real {
        0 => Some(true),
        4 if group.from.len() == 2 && between(ends, group, discriminant).crossings() == Some(0) => {
            Some(false)
        }
        _ => None,
    }
}

/// Returns the groups of linked multipliers between two ends. `is_tied` returns true for two complex
/// multipliers, given by their indices at both ends, that belong to one group.
pub(super) fn groups(
    ends: [StepEnd; 2],
    pairs: &[(usize, usize)],
    is_tied: impl Fn((usize, usize), (usize, usize)) -> bool,
) -> Vec<MultiplierGroup> {
    let [a, b] = ends;
    // Index of the group of each pair.
    let mut group: Vec<usize> = (0..pairs.len()).collect();
    for (k, (i, j)) in pairs.iter().enumerate() {
        let (conjugate, opposite) = (a.conjugate(*i), b.conjugate(*j));
        for (other, (i, j)) in pairs.iter().enumerate() {
            if *i == conjugate || *j == opposite {
                join(&mut group, k, other);
            }
        }
    }
    for k in 0..pairs.len() {
        for other in 0..k {
            let (one, two) = (pairs[k], pairs[other]);
            if group[k] != group[other] && (may_meet(ends, one, two) || is_tied(one, two)) {
                join(&mut group, k, other);
            }
        }
    }
    let mut numbers = group.clone();
    numbers.sort_unstable();
    numbers.dedup();
    let members = |number: usize| {
        let member = || {
            pairs
                .iter()
                .zip(&group)
                .filter(move |(_, member)| **member == number)
        };
        MultiplierGroup {
            from: member().map(|((i, _), _)| *i).collect(),
            to: member().map(|((_, j), _)| *j).collect(),
        }
    };
    numbers.into_iter().map(members).collect()
}

/// Joins the groups of two pairs of linked multipliers.
fn join(group: &mut [usize], one: usize, two: usize) {
    let (one, two) = (group[one], group[two]);
    group
        .iter_mut()
        .filter(|member| **member == two)
        .for_each(|member| *member = one);
}

/// True where two real multipliers, given by their indices at both ends, may meet and separate
/// again on the step.
fn may_meet(ends: [StepEnd; 2], one: (usize, usize), two: (usize, usize)) -> bool {
    let [a, b] = ends;
    let values = [
        a.value(one.0),
        a.value(two.0),
        b.value(one.1),
        b.value(two.1),
    ];
    let is_real = values
        .iter()
        .all(|mu| mu.im == 0.0 && (mu.re > 0.0) == (values[0].re > 0.0));
    if !is_real {
        return false;
    }
    let both = MultiplierGroup {
        from: vec![one.0, two.0],
        to: vec![one.1, two.1],
    };
    between(ends, &both, discriminant).crossings() != Some(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branches::events::test_data::TestData;

    /// Data of multipliers at a point of a curve, and at 1e-6 ahead.
    fn at(multipliers: impl Fn(f64) -> Vec<c64>, s: f64) -> TestDataPair {
        let (turns, levels, radii) = (Vec::new(), Vec::new(), vec![2.0; multipliers(s).len()]);
        let data = TestData {
            multipliers: multipliers(s),
            radii,
            turns,
            levels,
            period_s: 1.0,
            cycles: 1,
            is_free: false,
        };
        TestDataPair {
            current: data,
            multipliers: multipliers(s + 1e-6),
            turns: Vec::new(),
            levels: Vec::new(),
            length: 1e-6,
            error: 1e-9,
        }
    }

    fn groups_of(
        multipliers: impl Fn(f64) -> Vec<c64>,
        (from, to): (f64, f64),
    ) -> (Vec<MultiplierGroup>, [TestDataPair; 2]) {
        let readings = [at(&multipliers, from), at(&multipliers, to)];
        let ends = readings.each_ref().map(|readings| StepEnd {
            readings,
            length: to - from,
        });
        let pairs = linked_pairs(ends);
        (groups(ends, &pairs, |_, _| false), readings.clone())
    }

    /// A pair that meets at -0.9, passes -1 on the real axis and returns: `mu^2 + 2 b mu + 0.9`
    /// with `b` from 0.9 to 0.97 and back.
    #[test]
    fn a_pair_that_becomes_real_and_comes_back_is_one_group() {
        let pair = |s: f64| {
            let b = 0.97 - 0.3 * (s - 0.5) * (s - 0.5);
            let root = c64::new(b * b - 0.9, 0.0).sqrt();
            vec![-root - b, root - b, c64::new(0.2, 0.0)]
        };
        let (multiplier_groups, readings) = groups_of(pair, (0.0, 0.6));
        let wide = multiplier_groups.iter().find(|group| group.from.len() == 2);
        assert!(
            wide.is_some() && multiplier_groups.len() == 2,
            "{multiplier_groups:?}"
        );
        let ends = readings.each_ref().map(|readings| StepEnd {
            readings,
            length: 0.6,
        });
        let test = wide.map(|group| between(ends, group, doubling));
        let exact = |s: f64| 1.9 - 2.0 * (0.97 - 0.3 * (s - 0.5) * (s - 0.5));
        assert!(
            test.is_some_and(|test| (test.values[0] - exact(0.0)).abs() < 1e-12
                && (test.slopes[0] + 0.36).abs() < 1e-4),
            "{test:?}"
        );
    }

    /// Two pairs that rotate by 1.5 and by 9 rad; the second ends where the first began.
    #[test]
    fn pairs_are_joined_by_where_they_turn() {
        let pair =
            |size: f64, angle: f64| [c64::from_polar(size, angle), c64::from_polar(size, -angle)];
        let both = |s: f64| {
            [
                pair(0.97, 0.4 + 1.5 * s),
                pair(0.9, 0.4 - 9.0 * s + 0.1 * s * s),
            ]
            .concat()
        };
        let (multiplier_groups, _) = groups_of(both, (0.0, 1.0));
        assert_eq!(multiplier_groups.len(), 2);
        assert!(
            multiplier_groups.iter().all(|group| group.from == group.to),
            "{multiplier_groups:?}"
        );
    }

    /// A single multiplier from -0.9 to 0.8 is a wrong link, unless it is smaller than its error.
    #[test]
    fn a_multiplier_does_not_pass_zero() {
        let (one, all) = (|s: f64| vec![c64::new(1.7 * s - 0.9, 0.0)], (0.0, 1.0));
        let tiny = |s: f64| vec![c64::new(1e-11 * (s - 0.5), 0.0)];
        let is_wrong = |(groups, readings): (Vec<MultiplierGroup>, [TestDataPair; 2])| {
            let length = 1.0;
            let ends = readings
                .each_ref()
                .map(|readings| StepEnd { readings, length });
            groups.iter().any(|group| changes_sign(ends, group))
        };
        assert!(is_wrong(groups_of(one, all)) && !is_wrong(groups_of(tiny, all)));
        assert!(!is_wrong(groups_of(one, (0.6, 1.0))));
    }
}
