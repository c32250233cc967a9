//! Error of the key at a located event: its distance from the event of integrations with a tenth of
//! the tolerance, by one step of Newton's method.
//!
//! ```text
//! dp = a_p + p' s,   f(x + a) + f' s = 0
//! ```
//!
//! `a` leads to the curve of these integrations, normal to it; `p'` and `f'` are the derivatives of
//! the key and of the test function along the curve. At a fold `p'` is zero.
//!
//! Multipliers of coarse integrations scatter from point to point, and two tolerances may agree by
//! chance. So the distance by which the located point contradicts the interpolant of the step with
//! its error bound is added.

use super::detection::DetectedEvent;
use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use crate::branches::events::contradiction;
use jounce_continuation::{CurvePoint, Metric};
use jounce_orbits::OrbitMethod;

impl BranchTracer {
    /// Estimates the error of the key at a located event between two points; `None` where the
    /// integrations fail.
    pub(super) fn parameter_error<M: OrbitMethod>(
        &self,
        method: &M,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        located: &CurvePoint<M::Evaluation>,
    ) -> Option<f64> {
        let parameter = located.position.parameter;
        let state = &method.shot(&located.local).ok()?.strobe_states[0];
        let finer = method.finer_shot(state, parameter).ok()?;
        let (across, _) = finer.across(parameter, self.parameter_scale())?;
        let along = if event == DetectedEvent::Fold {
            0.0
        } else {
            let moved = state.iter().zip(&across.unknown).map(|(u, a)| u + a);
            let moved: Vec<f64> = moved.collect();
            let there = method
                .finer_shot(&moved, parameter + across.parameter)
                .ok()?;
            let value = self.value(event, (a, b), located, &there)?;
            -value / self.slope(method, event, (a, b), located)? * self.key_slope((a, b), located)
        };
        let resolution = self.resolution * self.parameter_scale();
        let contradiction = self.contradiction(method, event, (a, b), located);
        Some((across.parameter + along).abs() + contradiction + resolution)
    }

    /// Returns the change of the key over which a located event of the multipliers contradicts their
    /// interpolants; 0 for other events.
    fn contradiction<M: OrbitMethod>(
        &self,
        method: &M,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        located: &CurvePoint<M::Evaluation>,
    ) -> f64 {
        let (Some(function), Some(ends)) = (event.test_function(), self.ends(method, a, b)) else {
            return 0.0;
        };
        let length = self.along(&a.step, &b.step, &b.step.position);
        let at = self.along(&a.step, &b.step, &located.position) / length;
        contradiction(ends, function, at) * (length * self.key_slope((a, b), located)).abs()
    }

    /// Returns the derivative of the test function of an event along the chord. A grazing has
    /// derivatives at both ends; they are needed, since coarse integrations miss a short separation
    /// and then find it all at once, so that a secant over this jump is too steep. Of other events
    /// there are values at both ends: the secants are weighted so that a parabola gives its tangent.
    fn slope<M: OrbitMethod>(
        &self,
        method: &M,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        located: &CurvePoint<M::Evaluation>,
    ) -> Option<f64> {
        let value = |point: &OrbitPoint<M>| {
            let evaluation = method.shot(&point.step.local).ok()?;
            self.value(event, (a, b), &point.step, evaluation)
        };
        let length = self.along(&a.step, &b.step, &b.step.position);
        let before = self.along(&a.step, &b.step, &located.position);
        let after = length - before;
        let [from, to] = match event {
            DetectedEvent::Grazing(turn) => {
                let [from, to] = turn.past_m.slopes;
                [from / length, to / length]
            }
            _ => [-value(a)? / before, value(b)? / after],
        };
        Some((from * after + to * before) / length)
    }

    /// Returns the derivative of the key along the chord.
    fn key_slope<M: OrbitMethod>(
        &self,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        located: &CurvePoint<M::Evaluation>,
    ) -> f64 {
        let metric = Metric::at(&a.step.position, self.parameter_scale());
        let chord = metric.unit(a.step.position.to(&b.step.position));
        located.tangent.parameter / metric.inner(&chord, &located.tangent)
    }
}
