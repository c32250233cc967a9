//! Search for the attracting orbit of a motion from its return times.

use super::attracting_orbit::{AttractingOrbit, PeriodRun};
use super::transient::Transient;
use jounce_continuation::{
    ContinuationError, CorrectedPoint, Corrector, Metric, Position, correct_at,
};
use jounce_dynamics::{IntegrationError, Integrator, Kernel, SensitivityError};
use jounce_orbits::{
    Orbit, OrbitError, OrbitMethod, ParametricModel, Shooting, ShootingEvaluation,
};
use std::sync::Arc;

/// Largest number of evaluations of Newton's method.
const MAX_EVALUATIONS: u32 = 12;

/// Cost of a search over a period, in integrations of that period: several evaluations, each with
/// its derivative.
const SEARCH_COST: u32 = 20;

/// Largest cost of searches as a fraction of the cost of the integration so far; a long period is
/// tried only after many cycles.
const COST_SHARE: f64 = 0.1;

/// Ratio of the tighter tolerance to the tolerance, for the error of a period.
const TOLERANCE_REDUCTION: f64 = 1e-2;

/// Relative change over a period, below which a motion has settled where the flow has no
/// derivative. The state before coming to rest has no effect any more, so the change is due to the
/// other modes.
const SETTLED_CHANGE: f64 = 1e-8;

/// Result of a search.
pub enum SearchOutcome {
    /// A stable orbit with the ball in which it attracts.
    Attracting(Arc<AttractingOrbit>),
    /// A stable orbit that attracts too weakly for the tolerance of the integration.
    Weak,
}

/// Search for orbits at one value of the parameter.
#[derive(Debug, Clone, Copy)]
pub struct OrbitSearch<'h, H> {
    pub family: &'h H,
    pub kernel: &'h Kernel,
    pub parameter: f64,
    /// Length of the drive cycle, s.
    pub cycle_s: f64,
    /// Goal of Newton's method.
    pub goal: f64,
}

type Failure<H> = ContinuationError<OrbitError<<H as ParametricModel>::Error>>;

impl<H: ParametricModel> OrbitSearch<'_, H> {
    /// Returns the orbit near a motion, over the periods after which it nearly returns; `None`
    /// without a new stable orbit.
    pub fn near(
        &self,
        motion: &mut Transient<'_>,
        known: &[Arc<AttractingOrbit>],
    ) -> Option<SearchOutcome> {
        let mut weak = None;
        for cycles in motion.returns.periods() {
            let cost = motion.search_cost_cycles + SEARCH_COST * cycles;
            if f64::from(cost) > COST_SHARE * f64::from(motion.cycles) {
                continue;
            }
            motion.search_cost_cycles = cost;
            match self.of_period(motion, cycles, known) {
                Some(SearchOutcome::Attracting(orbit)) => {
                    return Some(SearchOutcome::Attracting(orbit));
                }
                Some(SearchOutcome::Weak) => weak = Some(SearchOutcome::Weak),
                None => {}
            }
        }
        weak
    }

    fn of_period(
        &self,
        motion: &Transient<'_>,
        cycles: u32,
        known: &[Arc<AttractingOrbit>],
    ) -> Option<SearchOutcome> {
        let (tolerance, physical) = (motion.tolerance, motion.physical());
        let shooting =
            Shooting::new(self.family, self.kernel, cycles, tolerance).charged_as(&physical);
        let (shooting, orbit, shot) = match self.newton(shooting, &motion.state) {
            Ok(found) => found,
            // The flow has no derivative where a point comes to rest, or where two rigid stops are
            // struck simultaneously.
            Err(ContinuationError::Family(OrbitError::Integration(
                SensitivityError::Rests { .. } | SensitivityError::StruckTogether { .. },
            ))) => {
                return self
                    .observed(motion, cycles)
                    .map(|orbit| SearchOutcome::Attracting(Arc::new(orbit)));
            }
            Err(_) => return None,
        };
        if !orbit.is_stable() || known.iter().any(|known| known.holds(&orbit)) {
            return None;
        }
        let displacement: Vec<f64> = motion
            .state
            .iter()
            .zip(orbit.start())
            .map(|(state, start)| state - start)
            .collect();
        let start = orbit.start().to_vec();
        let period = |away: &[f64]| -> Result<PeriodRun, Failure<H>> {
            let from: Vec<f64> = start.iter().zip(away).map(|(x, d)| x + d).collect();
            let (evaluation, _) = shooting
                .shoot(&from, self.parameter)
                .map_err(ContinuationError::Family)?;
            let ends = [tolerance, TOLERANCE_REDUCTION * tolerance]
                .map(|tolerance| self.end(&shooting, &from, tolerance));
            let [coarse, fine] = ends.map(|end| {
                end.map_err(|error| {
                    ContinuationError::Family(OrbitError::Integration(error.into()))
                })
            });
            let end = fine?;
            Ok(PeriodRun {
                derivative: evaluation.map().clone(),
                error: coarse?.iter().zip(&end).map(|(a, b)| a - b).collect(),
                end,
            })
        };
        let found = AttractingOrbit::prove(orbit, shot.keeps_charge, &displacement, period);
        Some(found.map_or(SearchOutcome::Weak, |orbit| {
            SearchOutcome::Attracting(Arc::new(orbit))
        }))
    }

    /// Returns the orbit that Newton's method finds, with the least period that divides the given
    /// one.
    fn newton<'s>(
        &'s self,
        shooting: Shooting<'s, H>,
        state: &[f64],
    ) -> Result<(Shooting<'s, H>, Orbit, ShootingEvaluation), Failure<H>> {
        let position = Position {
            unknown: state.to_vec(),
            parameter: self.parameter,
        };
        let metric = Metric::at(&position, 1.0);
        let corrector = Corrector {
            goal: self.goal,
            most: MAX_EVALUATIONS,
        };
        let CorrectedPoint {
            local: evaluation,
            error,
            ..
        } = correct_at(&shooting, &corrector, &metric, position)?;
        let orbit = shooting
            .orbit(&evaluation, error)
            .map_err(ContinuationError::Family)?;
        if let Some(cycles) = orbit.shorter_period() {
            let shorter = Shooting {
                cycles,
                charged: shooting.charged.clone(),
                scale: shooting.scale.clone(),
                ..shooting
            };
            // Just after a period doubling both orbits are close to each other, and the shorter one
            // is unstable.
            let shorter_orbit = self
                .newton(shorter, orbit.start())
                .ok()
                .filter(|(_, orbit, _)| orbit.is_stable());
            return Ok(shorter_orbit.unwrap_or((shooting, orbit, evaluation)));
        }
        Ok((shooting, orbit, evaluation))
    }

    /// Integrates a period without its derivative, and returns the state in energy coordinates.
    fn end(
        &self,
        shooting: &Shooting<'_, H>,
        from: &[f64],
        tolerance: f64,
    ) -> Result<Vec<f64>, IntegrationError> {
        let plant = &self.kernel.plant;
        let mut integrator = Integrator::new(
            self.kernel,
            &plant.from_physical(&shooting.physical(from), 0.0),
            0.0,
            tolerance,
        )?;
        integrator.advance_to(f64::from(shooting.cycles) * self.cycle_s)?;
        Ok(shooting.unknown(&plant.to_physical(&integrator.state(), 0.0)))
    }

    /// Returns the orbit that a motion without a derivative has reached, with the least period that
    /// divides the given one: return times that differ by roundoff are those of one period.
    fn observed(&self, motion: &Transient<'_>, cycles: u32) -> Option<AttractingOrbit> {
        let cycles = (1..=cycles)
            .filter(|least| cycles.is_multiple_of(*least))
            .find(|least| has_settled(motion, *least))?;
        let shooting = Shooting::new(self.family, self.kernel, cycles, motion.tolerance);
        let orbit = shooting
            .integrated_orbit(&motion.physical(), self.parameter)
            .ok()?;
        Some(AttractingOrbit::observed(orbit))
    }
}

/// True when a motion without a derivative has reached an orbit, by its contraction over the last
/// three periods.
fn has_settled(motion: &Transient<'_>, cycles: u32) -> bool {
    let settled = SETTLED_CHANGE * jounce_linalg::norm(&motion.state);
    let change = |back: u32| motion.returns.distance((back * cycles) as usize, cycles);
    let (Some(now), Some(before)) = (change(0), change(1)) else {
        return false;
    };
    let rate = now / before;
    // The further changes are a geometric series, down to the error of the integration.
    let remaining = if rate < 1.0 {
        now * rate / (1.0 - rate)
    } else {
        f64::INFINITY
    };
    now <= settled && (remaining <= settled || now <= TOLERANCE_REDUCTION * settled)
}
