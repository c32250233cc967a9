//! Points put between two points whose multipliers may have passed a critical value and come back unseen.
//!
//! A pair of doublings (or of branch points) inside one step changes no sign, and a complex pair that leaves the unit circle and
//! returns changes no count. A multiplier that lies nearer to -1 (or +1) than it moved on the step may have been there; one that lies
//! nearer to the circle than a share of its move may have been outside. Then the step is halved, until no multiplier moves so far.
//! A contact that comes while another goes changes no number of contacts either; there a contact lies elsewhere than any did before.
//! A pair that comes to the circle as a parabola comes to its top may pass it between the last two points: a point is put at the top.

use super::follow::{Following, Place};
use crate::continuation::{Metric, Step, Stretch, correct, tangent};
use crate::orbit::{Orbit, OrbitMethod, contacts_apart};

/// Most halvings of one step.
const HALVINGS: u32 = 4;

/// Most halvings of a step on which a contact comes and another goes.
const DEEPER: u32 = 6;

/// Farthest that a contact moves on a step that has no need to be halved, drive cycles.
const ELSEWHERE_CYCLES: f64 = 0.05;

/// Multipliers nearer to zero than this are left out: they cannot reach the unit circle on one step.
const NEAR_CIRCLE: f64 = 0.5;

/// Share of the move of a complex multiplier that may lead away from zero.
const LEAVING: f64 = 0.1;

/// Most points put at tops on one step.
const TOPS: u32 = 2;

impl Following {
    /// The point after another one, and before it those that are needed to see what happens on the way.
    ///
    /// # Errors
    /// As [`Following::walk`].
    pub(super) fn refined<M: OrbitMethod>(&self, method: &M, before: &Place<M>, after: Place<M>) -> Result<Vec<Place<M>>, M::Error> {
        let mut places = self.halved(method, before, after, 0)?;
        for _ in 0..TOPS {
            let way: Vec<&Place<M>> = std::iter::once(before).chain(&places).collect();
            let top = way.windows(3).enumerate().find_map(|(index, three)| Some((index, self.top([three[0], three[1], three[2]])?)));
            let Some((index, (second, share))) = top else { break };
            let from = index + usize::from(second);
            let Some(step) = self.at_share(method, &way[from].step, &way[from + 1].step, share) else { break };
            places.insert(from, Place::new(method, step)?);
        }
        Ok(places)
    }

    /// Where between three points the pair nearest to the circle may pass it and come back: whether in the second stretch, and the share of
    /// that.
    fn top<M: OrbitMethod>(&self, [a, b, c]: [&Place<M>; 3]) -> Option<(bool, f64)> {
        let metric = Metric::at(&b.step.position, self.parameter_scale());
        let length = |from: &Place<M>, to: &Place<M>| metric.length(&from.step.position.to(&to.step.position));
        let off = [a, b, c].map(|place| off_circle(&place.point.orbit));
        crosses_at_top([length(a, b), length(b, c)], [off[0]?, off[1]?, off[2]?])
    }

    fn halved<M: OrbitMethod>(&self, method: &M, before: &Place<M>, after: Place<M>, halved: u32) -> Result<Vec<Place<M>>, M::Error> {
        let (one, two) = (&before.point.orbit, &after.point.orbit);
        if !(halved < HALVINGS && hides(one, two) || halved < DEEPER && exchanges(one, two)) {
            return Ok(vec![after]);
        }
        let Some(middle) = self.at_share(method, &before.step, &after.step, 0.5) else { return Ok(vec![after]) };
        let middle = Place::new(method, middle)?;
        let mut places = self.halved(method, before, middle, halved + 1)?;
        if let Some(last) = places.pop() {
            let rest = self.halved(method, &last, after, halved + 1)?;
            places.push(last);
            places.extend(rest);
        }
        Ok(places)
    }

    /// The point of the curve at a share of the way between two.
    fn at_share<M: OrbitMethod>(&self, method: &M, before: &Step<M::Local>, after: &Step<M::Local>, share: f64) -> Option<Step<M::Local>> {
        let metric = Metric::at(&before.position, self.parameter_scale());
        let stretch = Stretch::between(&metric, (&before.position, &before.tangent), (&after.position, &after.tangent));
        let ahead = metric.unit(before.position.to(&after.position));
        let found = correct(method, &self.corrector, &metric, &ahead, stretch.at(share * stretch.length)).ok()?;
        let ahead = tangent(&found.local, &metric, &ahead)?;
        Some(Step { position: found.position, tangent: ahead, local: found.local, error: found.error })
    }
}

/// Distance past the circle of the complex pair nearest to it.
fn off_circle(orbit: &Orbit) -> Option<f64> {
    let pairs = orbit.multipliers.iter().filter(|value| value.im > 1e-9).map(|value| value.norm() - 1.0);
    pairs.min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// Where the parabola through three values of one sign, at two lengths from one to the next, has a top that lies beyond zero or nearer to
/// it than to the middle value: whether in the second stretch, and the share of that.
fn crosses_at_top([first, second]: [f64; 2], [a, b, c]: [f64; 3]) -> Option<(bool, f64)> {
    let (before, after) = ((b - a) / first, (c - b) / second);
    let bend = (after - before) / (first + second);
    let slope = (before * second + after * first) / (first + second);
    let (place, gain) = (-0.5 * slope / bend, 0.25 * slope * slope / bend.abs());
    let is_one_side = a * b > 0.0 && b * c > 0.0 && b * bend > 0.0;
    let is_near = is_one_side && b.abs() < 2.0 * gain && -first < place && place < second;
    is_near.then(|| if place < 0.0 { (false, 1.0 + place / first) } else { (true, place / second) })
}

/// True when a contact may have come and another gone: as many as before, one of them elsewhere.
fn exchanges(before: &Orbit, after: &Orbit) -> bool {
    let moved = contacts_apart(&before.contact_starts, &after.contact_starts);
    before.contacts == after.contacts && moved.is_none_or(|moved| moved * f64::from(before.period_cycles) > ELSEWHERE_CYCLES)
}

/// True when a multiplier may have crossed the circle twice. Without contacts and switches multipliers are those of the plant, all inside.
fn hides(before: &Orbit, after: &Orbit) -> bool {
    let flies = [before, after].iter().all(|orbit| orbit.contacts == 0 && orbit.switches == 0);
    let critical = [-1.0, 1.0].map(|s| (s, before.determinant_at(s) * after.determinant_at(s) > 0.0));
    let alike = before.pairs_outside() == after.pairs_outside();
    !flies
        && before.multipliers.iter().filter(|value| value.norm() > NEAR_CIRCLE).any(|value| {
            let nearest = after.multipliers.iter().min_by(|a, b| (*a - value).norm().total_cmp(&(*b - value).norm()));
            nearest.is_some_and(|other| {
                let moved = (other - value).norm();
                let to_circle = (value.norm() - 1.0).abs().min((other.norm() - 1.0).abs());
                let leaves = alike && value.im != 0.0 && other.im != 0.0 && moved * LEAVING > to_circle;
                leaves || critical.iter().any(|(s, unseen)| *unseen && moved > (value - s).norm().min((other - s).norm()))
            })
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::orbit::ContactStart;
    use faer::c64;

    fn orbit(multipliers: &[(f64, f64)]) -> Orbit {
        Orbit { multipliers: multipliers.iter().map(|(re, im)| c64::new(*re, *im)).collect(), ..Orbit::of_cycles(1) }
    }

    #[test]
    fn a_pair_that_nears_minus_one_quickly_may_hide_two_doublings() {
        let turned = |angle: f64| orbit(&[(0.97 * angle.cos(), 0.97 * angle.sin()), (0.97 * angle.cos(), -0.97 * angle.sin())]);
        assert!(hides(&turned(2.9), &turned(3.1)));
        assert!(!hides(&turned(2.0), &turned(2.2)));
        assert!(hides(&turned(2.0), &turned(2.4)), "the pair may have been outside on the way");
    }

    /// As many contacts: at the same times, or one of them elsewhere, or at another stop.
    #[test]
    fn a_contact_that_comes_while_another_goes_is_seen() {
        let touches = |places: [(usize, f64); 2]| {
            let contact_starts = places.map(|(stop, share)| ContactStart { stop, share }).to_vec();
            Orbit { contacts: 2, contact_starts, ..Orbit::of_cycles(1) }
        };
        let one = touches([(0, 0.2), (0, 0.6)]);
        assert!(!exchanges(&one, &touches([(0, 0.62), (0, 0.23)])));
        assert!(exchanges(&one, &touches([(0, 0.2), (0, 0.75)])) && exchanges(&one, &touches([(0, 0.2), (1, 0.6)])));
    }

    /// `2e-5 - (s - 0.6)^2` is above zero within 0.0045 of its top only.
    #[test]
    fn a_parabola_that_passes_zero_between_two_points_is_seen() {
        let value = |s: f64| 2e-5 - (s - 0.6) * (s - 0.6);
        let seen = crosses_at_top([0.6, 0.2], [value(0.0), value(0.6), value(0.8)]);
        assert!(seen.is_none(), "values of two signs need no top");
        let (second, share) = crosses_at_top([0.5, 0.2], [value(0.0), value(0.5), value(0.7)]).unwrap_or((false, 0.0));
        assert!(second && (share - 0.5).abs() < 1e-9);
        assert!(crosses_at_top([0.5, 0.2], [value(0.0) - 0.1, value(0.5) - 0.1, value(0.7) - 0.1]).is_none(), "its top stays below");
    }
}
