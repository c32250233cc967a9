//! Distances of the turning points of the ports past their stops, joined between two neighbouring points by port, kind and phase.
//!
//! A maximum that rises through the surface begins a contact, a minimum that falls through it divides one: a contact more. The other way
//! round it is a contact less.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::reading::way;
use super::spectrum::End;
use crate::orbit::Turn;

/// A turning point on a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extremum {
    /// Distance past the surface, m.
    pub past_m: Interpolant,
    /// True for a maximum.
    pub is_maximum: bool,
}

impl Extremum {
    /// Contacts that it adds where it passes the surface once.
    pub fn adds(&self) -> i32 {
        let rises = self.past_m.values[1] > self.past_m.values[0];
        if rises == self.is_maximum { 1 } else { -1 }
    }
}

/// Turning points between two ends; `None` where one that may have touched ends on the way or begins there.
pub(super) fn extrema(ends: [End; 2]) -> Option<Vec<Extremum>> {
    let [a, b] = ends;
    let turns = ends.map(|end| &end.readings.here.turns);
    let pairs = paired(turns[0].len(), turns[1].len(), |i, j| off(ends, (i, j)));
    let is_alone = |side: usize, k: usize| !pairs.iter().any(|pair| [pair.0, pair.1][side] == k);
    let may_touch = [a, b].iter().enumerate().any(|(side, end)| {
        // It moves by what its derivative says, or by as much again.
        let stays = |k: usize| end.readings.here.turns[k].past_m.abs() >= 2.0 * end.fall_m(k).abs();
        (0..turns[side].len()).any(|k| is_alone(side, k) && !stays(k))
    });
    let joined = pairs.iter().map(|(i, j)| Extremum {
        past_m: Interpolant { values: [turns[0][*i].past_m, turns[1][*j].past_m], slopes: [a.fall_m(*i), b.fall_m(*j)] },
        is_maximum: turns[0][*i].is_maximum,
    });
    (!may_touch).then(|| joined.collect())
}

/// Distance in phase from where the derivatives at both ends lead a turning point to the other end.
fn off([a, b]: [End; 2], (i, j): (usize, usize)) -> f64 {
    let (from, to) = (&a.readings.here, &b.readings.here);
    let way = way((from, &from.turns[i]), (to, &to.turns[j]));
    (way - 0.5 * (a.turn(i) + b.turn(j))).abs().min(way.abs())
}

impl End<'_> {
    fn ahead(&self, k: usize) -> Option<(&Turn, Turn)> {
        Some((&self.readings.here.turns[k], self.readings.turns[k]?))
    }

    /// Change of the distance past the surface over the step, m, by its derivative; not a number where the turning point ends at once.
    fn fall_m(&self, k: usize) -> f64 {
        self.ahead(k).map_or(f64::NAN, |(here, ahead)| (ahead.past_m - here.past_m) * self.per())
    }

    /// Change of a level over the step, by its derivative.
    pub fn level(&self, k: usize) -> f64 {
        (self.readings.levels[k] - self.readings.here.levels[k]) * self.per()
    }

    /// Change of the phase over the step, by its derivative.
    fn turn(&self, k: usize) -> f64 {
        let here = &self.readings.here;
        self.ahead(k).map_or(0.0, |(from, to)| way((here, from), (here, &to)) * self.per())
    }
}
