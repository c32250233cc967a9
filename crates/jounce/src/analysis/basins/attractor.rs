//! Attractors and their shares, counted from where each start ends.

use super::basin_fraction::{BasinFraction, wilson};
use super::expected::expected_power_w;
use super::letters::letters;
use crate::analysis::{Aperiodic, AttractingOrbit, AttractorKind, SteadyState};
use crate::orbit::Orbit;
use crate::run::ExceededLimit;
use std::sync::Arc;

/// An attractor with its share of the starts; what no attractor was proved for stands last, as `undecided`.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Drive cycles of its period and a letter by falling power: `1a`, `1b`, `2a`; `chaos`; `torus`; `undecided`.
    pub id: String,
    /// What it is.
    pub kind: AttractorKind,
    /// Drive cycles of the period; 0 for none.
    pub period_cycles: u32,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Contacts per period; 0 for none.
    pub contacts_per_period: u64,
    /// The orbit, where there is one.
    pub orbit: Option<Orbit>,
    /// Largest Lyapunov exponent and its error, 1/s, where there is no orbit.
    pub lyapunov: Option<(f64, f64)>,
    /// Id of the orbit of which this one is the mirror image half a drive cycle later.
    pub mirror_of: Option<String>,
    /// Share of the starts, 95 %.
    pub share: BasinFraction,
    /// Numbers of the starts that end here.
    pub starts: Vec<usize>,
    /// Limits of patches that it passes.
    pub exceeded: Vec<ExceededLimit>,
}

/// What the starts have shown.
#[derive(Debug, Clone, PartialEq)]
pub struct BasinsResult {
    /// Attractors: orbits by period and falling power, then chaos, tori, and the starts that are undecided.
    pub attractors: Vec<Attractor>,
    /// `sum fraction power`, W.
    pub expected_power_w: f64,
    /// Lower end of its 95 % interval, W: starts that are undecided, and an attractor that no start reached, may give nothing.
    pub expected_power_low_w: f64,
    /// Upper end, W: starts that are undecided may give the largest power seen.
    pub expected_power_high_w: f64,
    /// Starts whose integration failed, with the reason.
    pub lost: Vec<(usize, String)>,
}

impl Attractor {
    /// Without starts and limits.
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
            orbit: None,
            lyapunov: None,
            mirror_of: None,
            share: wilson(starts.len(), of),
            starts,
            exceeded: Vec::new(),
        }
    }

    /// True when neighbouring motions part exponentially.
    pub fn is_chaotic(&self) -> bool {
        self.kind == AttractorKind::Chaos
    }

    /// True for the starts that no attractor was proved for.
    pub fn is_undecided(&self) -> bool {
        self.kind == AttractorKind::Undecided
    }
}

/// The attracting orbits among where starts end, each once, with the numbers of its starts: by period and falling power.
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

/// The result from where each start ends; `mirrored` finds, of two orbits, whether the second is the mirror image of the first.
pub(super) fn counted(
    ends: &[(usize, SteadyState)],
    mirrored: impl Fn(&AttractingOrbit, &AttractingOrbit) -> bool,
) -> BasinsResult {
    let failed = |(index, end): &(usize, SteadyState)| match end {
        SteadyState::Failed(reason) => Some((*index, reason.clone())),
        SteadyState::Periodic(_) | SteadyState::Aperiodic(_) => None,
    };
    let lost: Vec<(usize, String)> = ends.iter().filter_map(failed).collect();
    let of = ends.len() - lost.len();
    let mut attractors: Vec<Attractor> = Vec::new();
    let orbits = orbits(ends);
    for (k, (found, starts)) in orbits.iter().enumerate() {
        let orbit = &found.orbit;
        let place = attractors
            .iter()
            .filter(|known| known.period_cycles == orbit.period_cycles)
            .count();
        let id = format!("{}{}", orbit.period_cycles, letters(place));
        let alike = |(j, (other, _)): &(usize, &(Arc<AttractingOrbit>, Vec<usize>))| {
            other.orbit.period_cycles == orbit.period_cycles
                && attractors[*j].mirror_of.is_none()
                && mirrored(other, found)
        };
        let mirror_of = orbits[..k]
            .iter()
            .enumerate()
            .find(alike)
            .map(|(j, _)| attractors[j].id.clone());
        attractors.push(Attractor {
            period_cycles: orbit.period_cycles,
            contacts_per_period: orbit.contacts,
            orbit: Some(orbit.clone()),
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
        lost,
    }
}

/// Expected power and its interval. What is undecided may give nothing, or the largest power seen.
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

/// All starts that end on motions of a kind without a period.
fn aperiodic(kind: AttractorKind, ends: &[(usize, SteadyState)], of: usize) -> Option<Attractor> {
    let own = |(index, end): &'_ (usize, SteadyState)| match end {
        SteadyState::Aperiodic(found) if found.kind == kind => Some((*index, found.clone())),
        _ => None,
    };
    let found: Vec<(usize, Aperiodic)> = ends.iter().filter_map(own).collect();
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
    let taken = exponents.len() as f64;
    let exponent = exponents
        .iter()
        .map(|exponent| exponent.exponent_per_s)
        .sum::<f64>()
        / taken;
    let error = exponents
        .iter()
        .map(|exponent| exponent.error_per_s)
        .sum::<f64>()
        / taken
        / taken.sqrt();
    let starts: Vec<usize> = found.iter().map(|(index, _)| *index).collect();
    (!found.is_empty()).then(|| Attractor {
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

    /// Three of four starts on a torus of 2 W, one undecided: it may give nothing, or as much as the torus.
    #[test]
    fn undecided_starts_widen_the_interval_of_the_expected_power() {
        let torus = (AttractorKind::Torus, 2.0);
        let decided = counted(
            &ends(&[torus, torus, torus, (AttractorKind::Torus, 0.0)]),
            |_, _| false,
        );
        assert_eq!(decided.attractors.len(), 1);
        let found = counted(
            &ends(&[torus, torus, torus, (AttractorKind::Undecided, 1.0)]),
            |_, _| false,
        );
        let ids: Vec<&str> = found.attractors.iter().map(|a| a.id.as_str()).collect();
        assert_eq!(ids, ["torus", "undecided"]);
        assert!(
            (found.expected_power_w - 1.75).abs() < 1e-12 && found.expected_power_high_w == 2.0
        );
        let with_nothing = expected_power_w(&[(3, 2.0), (1, 0.0)]);
        assert!((found.expected_power_low_w - with_nothing[1]).abs() < 1e-12);
        assert_eq!(
            (
                found.attractors[1].starts.as_slice(),
                found.attractors[1].share.fraction
            ),
            (&[3][..], 0.25)
        );
    }
}
