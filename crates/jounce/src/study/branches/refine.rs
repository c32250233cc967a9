//! Points put between two points whose multipliers may have passed a critical value and come back unseen.
//!
//! A pair of doublings (or of branch points) inside one step changes no sign, and a complex pair that leaves the unit circle and
//! returns changes no count. A multiplier that lies nearer to -1 (or +1) than it moved on the step may have been there; one that lies
//! nearer to the circle than a share of its move may have been outside. Then the step is halved, until no multiplier moves so far.

use super::follow::{Following, Place};
use crate::continuation::{Metric, Step, Stretch, correct, tangent};
use crate::orbit::{Orbit, OrbitMethod};

/// Most halvings of one step.
const HALVINGS: u32 = 4;

/// Multipliers nearer to zero than this are left out: they cannot reach the unit circle on one step.
const NEAR_CIRCLE: f64 = 0.5;

/// Share of the move of a complex multiplier that may lead away from zero.
const LEAVING: f64 = 0.1;

impl Following {
    /// The point after another one, and before it those that are needed to see what happens on the way.
    ///
    /// # Errors
    /// As [`Following::walk`].
    pub(super) fn refined<M: OrbitMethod>(&self, method: &M, before: &Place<M>, after: Place<M>) -> Result<Vec<Place<M>>, M::Error> {
        self.halved(method, before, after, HALVINGS)
    }

    fn halved<M: OrbitMethod>(&self, method: &M, before: &Place<M>, after: Place<M>, halvings: u32) -> Result<Vec<Place<M>>, M::Error> {
        if halvings == 0 || !hides(&before.point.orbit, &after.point.orbit) {
            return Ok(vec![after]);
        }
        let Some(middle) = self.middle(method, &before.step, &after.step) else { return Ok(vec![after]) };
        let middle = Place::new(method, middle)?;
        let mut places = self.halved(method, before, middle, halvings - 1)?;
        if let Some(last) = places.pop() {
            let rest = self.halved(method, &last, after, halvings - 1)?;
            places.push(last);
            places.extend(rest);
        }
        Ok(places)
    }

    /// The point of the curve half-way between two.
    fn middle<M: OrbitMethod>(&self, method: &M, before: &Step<M::Local>, after: &Step<M::Local>) -> Option<Step<M::Local>> {
        let metric = Metric::at(&before.position, self.parameter_scale());
        let stretch = Stretch::between(&metric, (&before.position, &before.tangent), (&after.position, &after.tangent));
        let ahead = metric.unit(before.position.to(&after.position));
        let found = correct(method, &self.corrector, &metric, &ahead, stretch.at(0.5 * stretch.length)).ok()?;
        let ahead = tangent(&found.local, &metric, &ahead)?;
        Some(Step { position: found.position, tangent: ahead, local: found.local, error: found.error })
    }
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
}
