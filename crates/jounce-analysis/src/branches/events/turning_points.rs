//! Distances of the turning points of the ports past their stops, joined between two neighbouring
//! points by port, kind and phase.
//!
//! A grazing is a zero of one of these distances. A maximum that rises through the surface begins a
//! contact; a minimum that falls through it divides one.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::spectrum::StepEnd;
use super::test_data::{TestData, phase_shift};
use jounce_orbits::{ShootingEvaluation, TurningPoint, turns};

/// Turning point on a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::branches) struct Extremum {
    /// Distance past the surface, m.
    pub past_m: Interpolant,
    /// Turning point at the beginning of the step.
    pub from: TurningPoint,
    /// Phase at the beginning, as a fraction of the period.
    phase: f64,
    /// Change of the phase over the step.
    way: f64,
}

impl Extremum {
    /// True where the turning point lies on different sides of the surface at the two ends.
    pub fn grazes(&self) -> bool {
        let [from, to] = self.past_m.values;
        (from > 0.0) != (to > 0.0)
    }

    /// Returns the distance past the surface, m, of the turning point on an orbit at a fraction of
    /// the step; NaN where the orbit has no such turning point.
    pub fn past_m(&self, evaluation: &ShootingEvaluation, share: f64) -> f64 {
        let cycles = evaluation.trajectories.len() as f64;
        let expected = self.phase + share * self.way;
        let phase_error = |turn: &TurningPoint| {
            let phase_error = (turn.cycle as f64 + turn.time_s * cycles / evaluation.period_s)
                / cycles
                - expected;
            (phase_error - phase_error.round()).abs()
        };
        let is_same_kind = turns(evaluation)
            .into_iter()
            .filter(|turn| (turn.port, turn.is_maximum) == (self.from.port, self.from.is_maximum));
        is_same_kind
            .min_by(|a, b| phase_error(a).total_cmp(&phase_error(b)))
            .map_or(f64::NAN, |turn| turn.refined(evaluation).past_m)
    }
}

/// Returns the turning points that both ends of a step have.
pub(in crate::branches) fn extrema(ends: [StepEnd; 2]) -> Vec<Extremum> {
    let [a, b] = ends;
    let (from, to) = (&a.readings.current, &b.readings.current);
    let joined = |(i, j): (usize, usize)| Extremum {
        past_m: Interpolant {
            values: [from.turns[i].past_m, to.turns[j].past_m],
            slopes: [a.fall_m(i), b.fall_m(j)],
        },
        from: from.turns[i],
        phase: from.phase(&from.turns[i]),
        way: phase_shift((from, &from.turns[i]), (to, &to.turns[j])),
    };
    pairs(ends).into_iter().map(joined).collect()
}

/// True where a turning point that may have touched its stop appears or disappears on a step.
pub(super) fn may_touch_unseen(ends: [StepEnd; 2]) -> bool {
    let pairs = pairs(ends);
    let is_unpaired = |side: usize, k: usize| !pairs.iter().any(|pair| [pair.0, pair.1][side] == k);
    ends.iter().enumerate().any(|(side, end)| {
        let turns = &end.readings.current.turns;
        // It may move by twice the change given by its derivative.
        let stays = |k: usize| turns[k].past_m.abs() >= 2.0 * end.fall_m(k).abs();
        (0..turns.len()).any(|k| is_unpaired(side, k) && !stays(k))
    })
}

fn pairs(ends: [StepEnd; 2]) -> Vec<(usize, usize)> {
    let [from, to] = ends.map(|end| &end.readings.current);
    let [near, far] = [from, to].map(|reading| {
        (0..reading.turns.len())
            .map(|k| to_neighbour(reading, k))
            .collect::<Vec<f64>>()
    });
    paired(near.len(), far.len(), |i, j| {
        let mismatch = phase_difference(ends, (i, j));
        // A turning point cannot pass its neighbours.
        if mismatch < near[i].min(far[j]) {
            mismatch
        } else {
            f64::INFINITY
        }
    })
}

/// Returns the phase difference from a turning point to the nearest one of the other kind at its
/// port; infinite without one.
fn to_neighbour(reading: &TestData, k: usize) -> f64 {
    let this = &reading.turns[k];
    let neighbours = reading
        .turns
        .iter()
        .filter(|turn| turn.port == this.port && turn.is_maximum != this.is_maximum);
    let away = neighbours
        .map(|turn| reading.phase(turn) - reading.phase(this))
        .map(|away| (away - away.round()).abs());
    away.fold(f64::INFINITY, f64::min)
}

/// Returns the phase difference between two turning points, each extrapolated towards the other end
/// of the step.
fn phase_difference([a, b]: [StepEnd; 2], (i, j): (usize, usize)) -> f64 {
    let (from, to) = (&a.readings.current, &b.readings.current);
    let phase_shift = phase_shift((from, &from.turns[i]), (to, &to.turns[j]));
    (phase_shift - 0.5 * (a.turn(i) + b.turn(j)))
        .abs()
        .min(phase_shift.abs())
}

impl StepEnd<'_> {
    fn next_turn(&self, k: usize) -> Option<(&TurningPoint, TurningPoint)> {
        Some((&self.readings.current.turns[k], self.readings.turns[k]?))
    }

    /// Change of the distance past the surface over the step, m, by its derivative; NaN where the
    /// turning point disappears at once.
    fn fall_m(&self, k: usize) -> f64 {
        self.next_turn(k).map_or(f64::NAN, |(current, neighbour)| {
            (neighbour.past_m - current.past_m) * self.per()
        })
    }

    /// Change of a level over the step, by its derivative.
    pub fn level(&self, k: usize) -> f64 {
        (self.readings.levels[k] - self.readings.current.levels[k]) * self.per()
    }

    /// Change of the phase over the step, by its derivative.
    fn turn(&self, k: usize) -> f64 {
        let current = &self.readings.current;
        self.next_turn(k).map_or(0.0, |(from, to)| {
            phase_shift((current, from), (current, &to)) * self.per()
        })
    }
}
