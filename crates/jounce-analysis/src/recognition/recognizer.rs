//! Integration of a start until its attractor is proved.

use super::attracting_orbit::AttractingOrbit;
use super::attractor_kind::AttractorKind;
use super::lyapunov::{Lyapunov, TangentMotion, largest_exponent};
use super::orbit_search::{OrbitSearch, SearchOutcome};
use super::steady_state::{Aperiodic, ReachedOrbit, SteadyState};
use super::transient::Transient;
use jounce_dynamics::{Kernel, SensitivityError};
use jounce_orbits::{OrbitError, ParametricModel, Shooting, cycle_s};
use std::sync::Arc;

/// Growth of the number of cycles from one search to the next; unneeded cycles remain in proportion
/// to the needed ones.
const SEARCH_GROWTH: f64 = 1.25;

/// Drive cycles before the first search for an orbit.
const FIRST_SEARCH_CYCLES: u32 = 32;

/// Drive cycles before averages are examined for a torus; both windows then have the hundred
/// samples that they need.
const FIRST_AVERAGE_CYCLES: u32 = 1000;

/// Drive cycles of an exponent.
const EXPONENT_CYCLES: usize = 320;

/// Drive cycles of a second exponent that confirms chaos: one exponent in a few hundred is too
/// large by chance.
const CONFIRMATION_CYCLES: usize = 4 * EXPONENT_CYCLES;

/// Factor on the tolerance where an orbit attracts too weakly for it, and the smallest tolerance.
const TOLERANCE_REDUCTION: f64 = 1e-2;
const MIN_TOLERANCE: f64 = 1e-12;

/// Entry of a motion into the ball of an orbit.
#[derive(Debug, Clone, Copy)]
struct BallEntry {
    /// Index of the orbit.
    orbit: usize,
    /// Distance on entry into its ball.
    distance: f64,
    /// Drive cycle one period later.
    until: u32,
}

/// Options of the recognition of attractors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recognition {
    /// Relative tolerance of the integration.
    pub tolerance: f64,
    /// Goal of Newton's method, relative to the state.
    pub goal: f64,
    /// Longest period of an orbit, drive cycles.
    pub longest_period: u32,
    /// Drive cycles after which a motion without a proved attractor is chaos or undecided.
    pub max_cycles: u32,
    /// True where such a motion is examined for chaos by its exponent; otherwise it is undecided.
    pub examines_chaos: bool,
}

impl Recognition {
    /// Returns the defaults at a tolerance.
    pub fn at(tolerance: f64) -> Self {
        Self {
            tolerance,
            goal: 10.0 * tolerance,
            longest_period: 64,
            max_cycles: 20_000,
            examines_chaos: true,
        }
    }
}

/// Recognizes attractors at one value of the parameter.
#[derive(Debug)]
pub struct Recognizer<'h, H: ParametricModel> {
    /// Family of models.
    pub family: &'h H,
    /// Kernel of the model at the value.
    pub kernel: &'h Kernel,
    /// Value of the parameter.
    pub parameter: f64,
    /// Options.
    pub options: Recognition,
}

impl<H: ParametricModel> Recognizer<'_, H> {
    /// Integrates a physical start to its steady state. The `known` orbits are tried first.
    pub fn settle(&self, start: &[f64], known: &[Arc<AttractingOrbit>]) -> SteadyState {
        let cycle_s = match cycle_s(&self.kernel.plant) {
            Ok(cycle_s) => cycle_s,
            Err(error) => return failed::<OrbitError<H::Error>>(&error),
        };
        self.integrate(start, known, cycle_s)
            .unwrap_or_else(|error| failed(&error))
    }

    fn integrate(
        &self,
        start: &[f64],
        known: &[Arc<AttractingOrbit>],
        cycle_s: f64,
    ) -> Result<SteadyState, SensitivityError> {
        let Recognition {
            tolerance,
            goal,
            longest_period,
            max_cycles,
            examines_chaos,
        } = self.options;
        let scale = Shooting::new(self.family, self.kernel, 1, tolerance).scale;
        let mut motion = Transient::from(
            self.kernel,
            start,
            (&scale, cycle_s),
            (tolerance, longest_period),
        )?;
        let mut search = OrbitSearch {
            family: self.family,
            kernel: self.kernel,
            parameter: self.parameter,
            cycle_s,
            goal,
        };
        let mut orbits = known.to_vec();
        let (mut entry, mut next_search): (Option<BallEntry>, u32) = (None, FIRST_SEARCH_CYCLES);
        let mut searched: [Option<Vec<f64>>; 2] = [None, None];
        while motion.cycles < max_cycles {
            motion.advance()?;
            if let Some(attracting) = arrived(&motion, &orbits, &mut entry) {
                let ([earlier, _], cycles) = (searched, motion.cycles);
                return Ok(SteadyState::Periodic(ReachedOrbit {
                    attracting,
                    cycles,
                    earlier,
                }));
            }
            if motion.cycles < next_search {
                continue;
            }
            next_search = (SEARCH_GROWTH * f64::from(motion.cycles)).ceil() as u32;
            searched = [searched[1].take(), Some(motion.block_state())];
            match search.near(&mut motion, &orbits) {
                Some(SearchOutcome::Attracting(orbit)) => orbits.push(orbit),
                Some(SearchOutcome::Weak) if motion.tolerance > MIN_TOLERANCE => {
                    motion.restart((TOLERANCE_REDUCTION * motion.tolerance).max(MIN_TOLERANCE))?;
                    search.goal = search.goal.min(10.0 * motion.tolerance);
                }
                _ => {}
            }
            if motion.cycles >= FIRST_AVERAGE_CYCLES && motion.is_quasi_periodic() {
                let state = motion.block_state();
                let (cycles, tolerance) = (EXPONENT_CYCLES, motion.tolerance);
                let exponent = largest_exponent(self.kernel, &state, (cycles, cycle_s), tolerance)?;
                if exponent.kind() == AttractorKind::Torus {
                    return Ok(aperiodic(AttractorKind::Torus, Some(exponent), &motion));
                }
            }
        }
        match examines_chaos {
            true => self.without_orbit(&motion, cycle_s),
            false => Ok(aperiodic(AttractorKind::Undecided, None, &motion)),
        }
    }

    /// Returns chaos or an undecided end for a motion without a proved attractor.
    fn without_orbit(
        &self,
        motion: &Transient<'_>,
        cycle_s: f64,
    ) -> Result<SteadyState, SensitivityError> {
        let state = motion.block_state();
        let mut tangent = TangentMotion::from(self.kernel, &state, (cycle_s, motion.tolerance));
        let mut exponent = tangent.exponent(EXPONENT_CYCLES)?;
        if exponent.kind() == AttractorKind::Chaos {
            exponent = tangent.exponent(CONFIRMATION_CYCLES)?;
        }
        let is_chaos = exponent.kind() == AttractorKind::Chaos;
        Ok(aperiodic(
            if is_chaos {
                AttractorKind::Chaos
            } else {
                AttractorKind::Undecided
            },
            Some(exponent),
            motion,
        ))
    }
}

/// Returns the end of an integration that failed.
fn failed<E: std::error::Error>(error: &E) -> SteadyState {
    SteadyState::Failed(error.to_string())
}

/// Returns the orbit that a motion has reached: it entered the ball, and contracted over one period
/// as the bound requires.
fn arrived(
    motion: &Transient<'_>,
    orbits: &[Arc<AttractingOrbit>],
    entry: &mut Option<BallEntry>,
) -> Option<Arc<AttractingOrbit>> {
    if let Some(BallEntry {
        orbit,
        distance,
        until,
    }) = *entry
    {
        if motion.cycles < until {
            return None;
        }
        *entry = None;
        let reached = &orbits[orbit];
        if reached
            .distance(&motion.state)
            .is_some_and(|now| reached.contracts(distance, now))
        {
            return Some(Arc::clone(reached));
        }
    }
    // The latest first: it was found from this motion.
    *entry = orbits.iter().enumerate().rev().find_map(|(orbit, known)| {
        let distance = known.distance(&motion.state)?;
        Some(BallEntry {
            orbit,
            distance,
            until: motion.cycles + known.orbit.period_cycles,
        })
    });
    None
}

fn aperiodic(
    kind: AttractorKind,
    exponent: Option<Lyapunov>,
    motion: &Transient<'_>,
) -> SteadyState {
    let (mean_power_w, state, cycles) = (motion.mean_power_w(), motion.physical(), motion.cycles);
    SteadyState::Aperiodic(Aperiodic {
        kind,
        exponent,
        mean_power_w,
        state,
        cycles,
    })
}
