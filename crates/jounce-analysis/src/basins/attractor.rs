//! Attractors and their basin fractions, counted from the end of each start.

use super::basin_fraction::{BasinFraction, wilson};
use super::expected::expected_power_w;
use super::letters::letters;
use crate::run::ExceededLimit;
use crate::{Aperiodic, AttractingOrbit, AttractorKind, SteadyState};
use jounce_orbits::Orbit;
use std::sync::Arc;

/// Attractor with its fraction of the starts. Starts without a proved attractor are listed last, as
/// `undecided`.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Drive cycles of the period and a letter by falling power: `1a`, `1b`, `2a`; `chaos`;
    /// `torus`; `undecided`.
    pub id: String,
    /// Kind of the attractor.
    pub kind: AttractorKind,
    /// Drive cycles of the period; 0 for an aperiodic motion.
    pub period_cycles: u32,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Contacts per period; 0 without contact.
    pub contacts_per_period: u64,
    /// Orbit of a periodic attractor, with the ball that proves that it attracts.
    pub attracting: Option<Arc<AttractingOrbit>>,
    /// State (physical) of an aperiodic attractor at the start of a drive cycle: the last one of
    /// its first start.
    pub last_state: Option<Vec<f64>>,
    /// Largest Lyapunov exponent and its error, 1/s, of an aperiodic attractor.
    pub lyapunov: Option<(f64, f64)>,
    /// Id of the orbit whose mirror image, half a drive cycle later, is this one.
    pub mirror_of: Option<String>,
    /// Fraction of the starts with its 95 % interval.
    pub share: BasinFraction,
    /// Indices of the starts that end here.
    pub starts: Vec<usize>,
    /// Limits of patches that are exceeded.
    pub exceeded: Vec<ExceededLimit>,
}

/// Attractors reached by all starts.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsResult {
    /// Attractors: orbits by period and falling power, then chaos, tori, and the undecided starts.
    pub attractors: Vec<Attractor>,
    /// `sum fraction power`, W.
    pub expected_power_w: f64,
    /// Lower end of its 95 % interval, W: undecided starts, and an attractor that no start reached,
    /// may have zero power.
    pub expected_power_low_w: f64,
    /// Upper end, W: undecided starts may have the largest power found.
    pub expected_power_high_w: f64,
    /// Starts whose integration failed, with the reason.
    pub lost: Vec<(usize, String)>,
    /// Starts that reach one of several attractors after a chaotic transient: roundoff decides which.
    pub chaotic_transients: Vec<usize>,
}

impl Attractor {
    /// Creates an attractor without starts and limits.
    fn new(
        id: String,
        kind: AttractorKind,
        mean_power_w: f64,
        starts: Vec<usize>,
        of: usize,
    ) -> Self {
        Self {
            id,
            kind,
            period_cycles: 0,
            mean_power_w,
            contacts_per_period: 0,
            attracting: None,
            last_state: None,
            lyapunov: None,
            mirror_of: None,
            share: wilson(starts.len(), of),
            starts,
            exceeded: Vec::new(),
        }
    }

    /// Returns the orbit of a periodic attractor.
    pub fn orbit(&self) -> Option<&Orbit> {
        Some(&self.attracting.as_ref()?.orbit)
    }

    /// True for a chaotic attractor: neighbouring trajectories diverge exponentially.
    pub fn is_chaotic(&self) -> bool {
        self.kind == AttractorKind::Chaos
    }

    /// True for the starts without a proved attractor.
    pub fn is_undecided(&self) -> bool {
        self.kind == AttractorKind::Undecided
    }
}

/// Returns each attracting orbit once, with the indices of its starts, by period and falling power.
pub(super) fn orbits(ends: &[(usize, SteadyState)]) -> Vec<(Arc<AttractingOrbit>, Vec<usize>)> {
    let mut orbits: Vec<(Arc<AttractingOrbit>, Vec<usize>)> = Vec::new();
    for (index, end) in ends {
        let Some(orbit) = end.orbit() else { continue };
        match orbits
            .iter_mut()
            .find(|(known, _)| Arc::ptr_eq(known, orbit) || known.is_same(orbit))
        {
            Some((_, starts)) => starts.push(*index),
            None => orbits.push((Arc::clone(orbit), vec![*index])),
        }
    }
    orbits.sort_by(|(a, _), (b, _)| {
        a.orbit
            .period_cycles
            .cmp(&b.orbit.period_cycles)
            .then(b.orbit.mean_power_w.total_cmp(&a.orbit.mean_power_w))
    });
    orbits
}

/// Builds the result from the end of each start; `mirrored` is true where the second orbit is the
/// mirror image of the first.
pub(super) fn counted(
    ends: &[(usize, SteadyState)],
    mirrored: impl Fn(&AttractingOrbit, &AttractingOrbit) -> bool,
) -> BasinsResult {
    let failed = |(index, end): &(usize, SteadyState)| match end {
        SteadyState::Failed(reason) => Some((*index, reason.clone())),
        SteadyState::Periodic(_) | SteadyState::Aperiodic(_) => None,
    };
    let failures: Vec<(usize, String)> = ends.iter().filter_map(failed).collect();
    let of = ends.len() - failures.len();
    let mut attractors = periodic(&orbits(ends), mirrored, of);
    for kind in [
        AttractorKind::Chaos,
        AttractorKind::Torus,
        AttractorKind::Undecided,
    ] {
        attractors.extend(aperiodic(kind, ends, of));
    }
    let [
        expected_power_w,
        expected_power_low_w,
        expected_power_high_w,
    ] = expected(&attractors);
    BasinsResult {
        attractors,
        expected_power_w,
        expected_power_low_w,
        expected_power_high_w,
        lost: failures,
        chaotic_transients: Vec::new(),
    }
}

/// Returns the attracting orbits as attractors, named by period and order.
fn periodic(
    orbits: &[(Arc<AttractingOrbit>, Vec<usize>)],
    mirrored: impl Fn(&AttractingOrbit, &AttractingOrbit) -> bool,
    of: usize,
) -> Vec<Attractor> {
    let mut attractors: Vec<Attractor> = Vec::new();
    for (k, (attracting, starts)) in orbits.iter().enumerate() {
        let orbit = &attracting.orbit;
        let number = attractors
            .iter()
            .filter(|known| known.period_cycles == orbit.period_cycles)
            .count();
        let id = format!("{}{}", orbit.period_cycles, letters(number));
        let is_same_kind = |(j, (other, _)): &(usize, &(Arc<AttractingOrbit>, Vec<usize>))| {
            other.orbit.period_cycles == orbit.period_cycles
                && attractors[*j].mirror_of.is_none()
                && mirrored(other, attracting)
        };
        let mirror_of = orbits[..k]
            .iter()
            .enumerate()
            .find(is_same_kind)
            .map(|(j, _)| attractors[j].id.clone());
        attractors.push(Attractor {
            period_cycles: orbit.period_cycles,
            contacts_per_period: orbit.contacts,
            attracting: Some(Arc::clone(attracting)),
            mirror_of,
            ..Attractor::new(
                id,
                AttractorKind::Orbit,
                orbit.mean_power_w,
                starts.clone(),
                of,
            )
        });
    }
    attractors
}

/// Returns the expected power and its interval. Undecided starts may have zero power or the largest
/// power found.
fn expected(attractors: &[Attractor]) -> [f64; 3] {
    let largest = attractors
        .iter()
        .map(|a| a.mean_power_w)
        .fold(0.0, f64::max);
    let with = |undecided_w: Option<f64>| {
        let power = |a: &Attractor| {
            undecided_w
                .filter(|_| a.is_undecided())
                .unwrap_or(a.mean_power_w)
        };
        expected_power_w(
            &attractors
                .iter()
                .map(|a| (a.starts.len(), power(a)))
                .collect::<Vec<_>>(),
        )
    };
    [with(None)[0], with(Some(0.0))[1], with(Some(largest))[2]]
}

/// Collects all starts that end on aperiodic motions of one kind.
fn aperiodic(kind: AttractorKind, ends: &[(usize, SteadyState)], of: usize) -> Option<Attractor> {
    let of_kind = |(index, end): &'_ (usize, SteadyState)| match end {
        SteadyState::Aperiodic(found) if found.kind == kind => Some((*index, found.clone())),
        _ => None,
    };
    let found: Vec<(usize, Aperiodic)> = ends.iter().filter_map(of_kind).collect();
    let count = found.len() as f64;
    let mean_power_w = found
        .iter()
        .map(|(_, found)| found.mean_power_w)
        .sum::<f64>()
        / count;
    let exponents: Vec<_> = found
        .iter()
        .filter_map(|(_, found)| found.exponent)
        .collect();
    let exponent_count = exponents.len() as f64;
    let exponent = exponents
        .iter()
        .map(|exponent| exponent.exponent_per_s)
        .sum::<f64>()
        / exponent_count;
    let error = exponents
        .iter()
        .map(|exponent| exponent.error_per_s)
        .sum::<f64>()
        / exponent_count
        / exponent_count.sqrt();
    let starts: Vec<usize> = found.iter().map(|(index, _)| *index).collect();
    let last_state = found.first().map(|(_, own)| own.state.clone());
    (!found.is_empty()).then(|| Attractor {
        last_state,
        lyapunov: (!exponents.is_empty()).then_some((exponent, error)),
        ..Attractor::new(kind.name().to_owned(), kind, mean_power_w, starts, of)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(kinds: &[(AttractorKind, f64)]) -> Vec<(usize, SteadyState)> {
        let end = |(kind, mean_power_w): &(AttractorKind, f64)| {
            let (exponent, state, cycles) = (None, Vec::new(), 0);
            SteadyState::Aperiodic(Aperiodic {
                kind: *kind,
                exponent,
                mean_power_w: *mean_power_w,
                state,
                cycles,
            })
        };
        kinds.iter().map(end).enumerate().collect()
    }

    /// Three of four starts end on a torus of 2 W; the undecided one may have zero power, or the
    /// power of the torus.
    #[test]
    fn undecided_starts_widen_the_interval_of_the_expected_power() {
        let torus = (AttractorKind::Torus, 2.0);
        let decided = counted(
            &ends(&[torus, torus, torus, (AttractorKind::Torus, 0.0)]),
            |_, _| false,
        );
        assert_eq!(decided.attractors.len(), 1);
        let result = counted(
            &ends(&[torus, torus, torus, (AttractorKind::Undecided, 1.0)]),
            |_, _| false,
        );
        let ids: Vec<&str> = result.attractors.iter().map(|a| a.id.as_str()).collect();
        assert_eq!(ids, ["torus", "undecided"]);
        assert!(
            (result.expected_power_w - 1.75).abs() < 1e-12 && result.expected_power_high_w == 2.0
        );
        let with_nothing = expected_power_w(&[(3, 2.0), (1, 0.0)]);
        assert!((result.expected_power_low_w - with_nothing[1]).abs() < 1e-12);
        assert_eq!(
            (
                result.attractors[1].starts.as_slice(),
                result.attractors[1].share.fraction
            ),
            (&[3][..], 0.25)
        );
    }
}
