//! Distances of the turning points of the ports past their stops, joined between two neighbouring
//! points by port, kind and phase.
//!
//! A grazing is a zero of one of these distances. A maximum that rises through the surface begins a
//! contact; a minimum that falls through it divides one.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::spectrum::StepEnd;
use super::test_data::{TestData, way};
use crate::orbit::{ShootingEvaluation, TurningPoint, turns};

/// Turning point on a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::analysis::branches) struct Extremum {
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
    pub fn past_m(&self, shot: &ShootingEvaluation, share: f64) -> f64 {
        let cycles = shot.trajectories.len() as f64;
        let expected = self.phase + share * self.way;
        let off = |turn: &TurningPoint| {
            let off =
                (turn.cycle as f64 + turn.time_s * cycles / shot.period_s) / cycles - expected;
            (off - off.round()).abs()
        };
        let alike = turns(shot)
            .into_iter()
            .filter(|turn| (turn.port, turn.is_maximum) == (self.from.port, self.from.is_maximum));
        alike
            .min_by(|a, b| off(a).total_cmp(&off(b)))
            .map_or(f64::NAN, |turn| turn.refined(shot).past_m)
    }
}

/// Returns the turning points that both ends of a step have.
pub(in crate::analysis::branches) fn extrema(ends: [StepEnd; 2]) -> Vec<Extremum> {
    let [a, b] = ends;
    let (from, to) = (&a.readings.here, &b.readings.here);
    let joined = |(i, j): (usize, usize)| Extremum {
        past_m: Interpolant {
            values: [from.turns[i].past_m, to.turns[j].past_m],
            slopes: [a.fall_m(i), b.fall_m(j)],
        },
        from: from.turns[i],
        phase: from.phase(&from.turns[i]),
        way: way((from, &from.turns[i]), (to, &to.turns[j])),
    };
    pairs(ends).into_iter().map(joined).collect()
}

/// True where a turning point that may have touched its stop appears or disappears on a step.
pub(super) fn may_touch_unseen(ends: [StepEnd; 2]) -> bool {
    let pairs = pairs(ends);
    let is_alone = |side: usize, k: usize| !pairs.iter().any(|pair| [pair.0, pair.1][side] == k);
    ends.iter().enumerate().any(|(side, end)| {
        let turns = &end.readings.here.turns;
        // It may move by twice the change given by its derivative.
        let stays = |k: usize| turns[k].past_m.abs() >= 2.0 * end.fall_m(k).abs();
        (0..turns.len()).any(|k| is_alone(side, k) && !stays(k))
    })
}

fn pairs(ends: [StepEnd; 2]) -> Vec<(usize, usize)> {
    let [from, to] = ends.map(|end| &end.readings.here);
    let [near, far] = [from, to].map(|reading| {
        (0..reading.turns.len())
            .map(|k| to_neighbour(reading, k))
            .collect::<Vec<f64>>()
    });
    paired(near.len(), far.len(), |i, j| {
        let off = off(ends, (i, j));
        // A turning point cannot pass its neighbours.
        if off < near[i].min(far[j]) {
            off
        } else {
            f64::INFINITY
        }
    })
}

/// Returns the phase difference from a turning point to the nearest one of the other kind at its
/// port; infinite without one.
fn to_neighbour(reading: &TestData, k: usize) -> f64 {
    let own = &reading.turns[k];
    let neighbours = reading
        .turns
        .iter()
        .filter(|turn| turn.port == own.port && turn.is_maximum != own.is_maximum);
    let away = neighbours
        .map(|turn| reading.phase(turn) - reading.phase(own))
        .map(|away| (away - away.round()).abs());
    away.fold(f64::INFINITY, f64::min)
}

/// Returns the phase difference between two turning points, each extrapolated towards the other end
/// of the step.
fn off([a, b]: [StepEnd; 2], (i, j): (usize, usize)) -> f64 {
    let (from, to) = (&a.readings.here, &b.readings.here);
    let way = way((from, &from.turns[i]), (to, &to.turns[j]));
    (way - 0.5 * (a.turn(i) + b.turn(j))).abs().min(way.abs())
}

impl StepEnd<'_> {
    fn ahead(&self, k: usize) -> Option<(&TurningPoint, TurningPoint)> {
        Some((&self.readings.here.turns[k], self.readings.turns[k]?))
    }

    /// Change of the distance past the surface over the step, m, by its derivative; NaN where the
    /// turning point disappears at once.
    fn fall_m(&self, k: usize) -> f64 {
        self.ahead(k).map_or(f64::NAN, |(here, ahead)| {
            (ahead.past_m - here.past_m) * self.per()
        })
    }

    /// Change of a level over the step, by its derivative.
    pub fn level(&self, k: usize) -> f64 {
        (self.readings.levels[k] - self.readings.here.levels[k]) * self.per()
    }

    /// Change of the phase over the step, by its derivative.
    fn turn(&self, k: usize) -> f64 {
        let here = &self.readings.here;
        self.ahead(k).map_or(0.0, |(from, to)| {
            way((here, from), (here, &to)) * self.per()
        })
    }
}
