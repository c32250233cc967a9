//! Search for all branches of a spec over a range of one key.
//!
//! The search first follows the branches on which integrations settle. These start at both ends of
//! the range and at values between. The initial states are rest, the steady state without the stop,
//! a large initial velocity and the end of a ramp down from a stronger drive. The search then
//! follows the branches that leave these at period doublings, shorter periods first. Among branches
//! of one period it takes the parent with the largest area below its power first. Integrations run
//! in parallel; the order of the rest is fixed. The search ends when its budget is spent.

mod known;
mod ramp_down;
mod starts;

pub(crate) use known::SAME_ORBIT_DISTANCE;

use super::branch::{Branch, BranchKind, BranchPoint};
use super::branch_tracer::tracer::BranchTracer;
use super::options::BranchOptions;
use crate::{AnalysisError, Model, Parameter};
use jounce_continuation::{
    CorrectedPoint, Direction, Metric, Position, Problem, StepControl, correct, tangent,
};
use jounce_linalg::Mat;
use jounce_orbits::{
    HarmonicBalance, Orbit, OrbitError, OrbitMethod, ParametricModel, Shooting, null_vector,
};
use known::is_end_of_one;

/// Method of computing orbits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrbitMethodKind {
    /// Shooting on the exact flow.
    Shooting,
    /// Harmonic balance at the ports, with as many harmonics as the accuracy needs.
    HarmonicBalance {
        /// Initial number of harmonics of the drive.
        harmonics: usize,
    },
}

/// Definition of a search for branches.
#[derive(Debug)]
pub struct BranchSearch<'s> {
    /// Model of the spec, unchanged.
    pub base: &'s Model,
    /// Family of models over the key.
    pub parameter: &'s Parameter<'s>,
    /// Ends of the range.
    pub range: (f64, f64),
    /// Method of computing orbits.
    pub method: OrbitMethodKind,
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
    /// Number of values between the ends of the range at which integrations search for orbits.
    pub seeds: usize,
    /// Longest period of a branch, drive cycles.
    pub longest_period: u32,
}

/// Golden section of the range. There two frequencies, one of them proportional to the key, have no
/// common period by chance.
const GOLDEN_SHARE: f64 = 0.618_033_988_749_894_9;

/// Distances of a first orbit from a period doubling, relative to the size of the orbit, in the
/// order in which they are tried. The small ones serve a branch with a grazing next to its doubling.
const DISPLACEMENTS: [f64; 5] = [1e-2, 3e-3, 3e-2, 1e-3, 3e-4];

/// Permitted error of the mean power in harmonic balance, relative to the tolerance of an
/// integration.
const POWER_ERROR_FACTOR: f64 = 300.0;

type Failure = OrbitError<AnalysisError>;

impl BranchSearch<'_> {
    /// Value of [`Self::seeds`] where not given.
    pub const DEFAULT_SEEDS: usize = 12;
    /// Largest value of [`Self::seeds`].
    pub const MAX_SEEDS: usize = 100_000;

    fn following(&self, options: &BranchOptions) -> BranchTracer {
        BranchTracer {
            control: StepControl {
                longest: options.largest_step,
                ..StepControl::default()
            },
            budget: options.budget,
            levels: options.levels.clone(),
            ..BranchTracer::new(self.range, self.tolerance)
        }
    }

    fn shooting(&self, cycles: u32) -> Shooting<'_, Parameter<'_>> {
        Shooting::new(self.parameter, &self.base.kernel, cycles, self.tolerance)
    }

    /// Finds and follows the branches; after cancellation returns the finished ones.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self) -> Result<Vec<Branch>, Failure> {
        self.run_with(&BranchOptions::default())
    }

    /// Finds and follows the branches with the given options.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run_with(&self, options: &BranchOptions) -> Result<Vec<Branch>, Failure> {
        let tracer = self.following(options);
        match self.method {
            OrbitMethodKind::Shooting => {
                self.run_by(&tracer, options, |cycles| Ok(self.shooting(cycles)))
            }
            OrbitMethodKind::HarmonicBalance { harmonics } => {
                self.run_by(&tracer, options, |cycles| {
                    let accuracy = POWER_ERROR_FACTOR * self.tolerance;
                    HarmonicBalance::new(
                        self.shooting(cycles),
                        &self.base.kernel,
                        harmonics * cycles as usize,
                        accuracy,
                    )
                })
            }
        }
    }

    fn run_by<M: OrbitMethod<Fault = AnalysisError>>(
        &self,
        tracer: &BranchTracer,
        options: &BranchOptions,
        make: impl Fn(u32) -> Result<M, Failure>,
    ) -> Result<Vec<Branch>, Failure> {
        self.check_ends()?;
        make(1)?;
        let control = &self.base.kernel.control;
        let mut branches: Vec<Branch> = Vec::new();
        let mut starts = self.starts();
        starts.extend(self.corrected(tracer, &options.known_orbits));
        control.expect(starts.len());
        for (orbit, parameter) in starts {
            if orbit.period_cycles <= self.longest_period
                && !self.is_known(&branches, tracer, (&orbit, parameter))
            {
                match tracer.within(&branches, orbit.period_cycles) {
                    Some(within) => {
                        let branch =
                            within.both_ways(&make(orbit.period_cycles)?, orbit.start(), parameter);
                        branches.extend(if control.is_stopped() {
                            branch.unwrap_or(None)
                        } else {
                            branch?
                        });
                    }
                    None => branches.push(Branch::of_one(orbit, parameter)),
                }
            }
            control.count();
        }
        let doubled = self.doubled(tracer, &make, &mut branches);
        if !control.is_stopped() {
            doubled?;
        }
        Ok(self.without_duplicates(tracer, branches))
    }

    /// Checks that models exist at both ends of the range, and that their drives have a common
    /// period there and between.
    fn check_ends(&self) -> Result<(), Failure> {
        Parameter::check_key(self.parameter.key()).map_err(OrbitError::Harvester)?;
        let between = self.range.0 + GOLDEN_SHARE * (self.range.1 - self.range.0);
        for value in [self.range.0, self.range.1, between] {
            let kernel = self
                .parameter
                .at(value)
                .map_err(OrbitError::Harvester)?
                .kernel;
            if kernel.plant.period_s().is_none() {
                return Err(OrbitError::Frequencies {
                    frequencies: kernel.plant.tones.len(),
                });
            }
        }
        Ok(())
    }

    /// True when an orbit lies on one of the branches.
    fn is_known(&self, branches: &[Branch], tracer: &BranchTracer, orbit: (&Orbit, f64)) -> bool {
        let shooting = self.shooting(orbit.0.period_cycles);
        branches
            .iter()
            .any(|branch| branch.holds(tracer, &shooting, orbit))
    }

    /// Removes branches that are parts of others. Two continuations may have followed one curve
    /// from different points.
    fn without_duplicates(&self, tracer: &BranchTracer, mut branches: Vec<Branch>) -> Vec<Branch> {
        let mut k = 0;
        while k < branches.len() {
            let (part, shooting) = (&branches[k], self.shooting(branches[k].period_cycles));
            let is_longer =
                |other: usize| (branches[other].points.len(), k) > (part.points.len(), other);
            let mut others = (0..branches.len()).filter(|other| *other != k && is_longer(*other));
            let complete =
                others.find(|other| part.is_part_of(&branches[*other], tracer, &shooting));
            match complete {
                Some(complete) => {
                    branches[complete].not_followed += branches[k].not_followed;
                    branches.remove(k);
                }
                None => k += 1,
            }
        }
        branches
    }

    /// Follows doubled branches until all are followed.
    fn doubled<M: OrbitMethod<Fault = AnalysisError>>(
        &self,
        tracer: &BranchTracer,
        make: &impl Fn(u32) -> Result<M, Failure>,
        branches: &mut Vec<Branch>,
    ) -> Result<(), Failure> {
        let mut entered = vec![false; branches.len()];
        while let Some(parent) = self.next_parent(branches, &entered) {
            entered[parent] = true;
            let cycles = 2 * branches[parent].period_cycles;
            let doublings = branches[parent]
                .bifurcations
                .iter()
                .filter(|found| found.kind == BranchKind::PeriodDoubling);
            let doublings: Vec<BranchPoint> = doublings.map(|found| found.at.clone()).collect();
            for at in doublings {
                if is_end_of_one(branches, &at, tracer) {
                    continue;
                }
                let Some(within) = tracer.within(branches, cycles) else {
                    branches[parent].not_followed += 1;
                    continue;
                };
                let method = make(cycles)?;
                if !self.follow_doubling((tracer, &within), &method, &at, branches)? {
                    branches[parent].not_followed += 1;
                }
                entered.resize(branches.len(), false);
            }
        }
        Ok(())
    }

    /// Adds the doubled branch of a doubling, unless it is known. Returns false where Newton's method
    /// finds no first orbit, or every continuation falls back to the parent.
    fn follow_doubling<M: OrbitMethod<Fault = AnalysisError>>(
        &self,
        (tracer, within): (&BranchTracer, &BranchTracer),
        method: &M,
        at: &BranchPoint,
        branches: &mut Vec<Branch>,
    ) -> Result<bool, Failure> {
        for length in DISPLACEMENTS {
            let start = || self.displaced_orbit(tracer, method, at, length);
            let Some((first, _)) = start() else {
                continue;
            };
            let orbit = method.orbit(&first.local, first.error)?;
            if self.is_known(branches, tracer, (&orbit, first.position.parameter)) {
                return Ok(true);
            }
            let found = within.both_ways_from(method, start)?;
            // A continuation of one point has fallen back to the parent.
            if let Some(found) = found.filter(|found| found.points.len() > 1) {
                branches.push(found);
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Returns the branch whose doublings are followed next: of the shortest period, then of the
    /// largest area below its power.
    fn next_parent(&self, branches: &[Branch], entered: &[bool]) -> Option<usize> {
        let remaining = (0..branches.len())
            .filter(|k| !entered[*k] && 2 * branches[*k].period_cycles <= self.longest_period);
        remaining.min_by(|one, two| {
            let [one, two] = [one, two].map(|k| &branches[*k]);
            one.period_cycles
                .cmp(&two.period_cycles)
                .then(two.area_w().total_cmp(&one.area_w()))
        })
    }

    /// Returns a first orbit on the doubled branch, displaced from the doubling along the
    /// eigenvector of the multiplier -1 by a length relative to the size of the orbit.
    fn displaced_orbit<M: OrbitMethod<Fault = AnalysisError>>(
        &self,
        tracer: &BranchTracer,
        method: &M,
        at: &BranchPoint,
        length: f64,
    ) -> Option<(CorrectedPoint<M::Evaluation>, Direction)> {
        let state = at.orbit.start();
        let evaluation = self
            .shooting(method.cycles() / 2)
            .at(state, at.parameter)
            .ok()?;
        let map = evaluation.map();
        let n = state.len();
        let vector = null_vector(&Mat::from_fn(n, n, |i, j| {
            map[(i, j)] + if i == j { 1.0 } else { 0.0 }
        }));
        let size = at.orbit.size();
        let origin = Position {
            unknown: method.unknown_of(state, at.parameter).ok()?,
            parameter: at.parameter,
        };
        let metric = Metric::at(&origin, tracer.parameter_scale());
        let shifted: Vec<f64> = (0..n)
            .map(|i| state[i] + length * size * vector[i])
            .collect();
        let guess = Position {
            unknown: method.unknown_of(&shifted, at.parameter).ok()?,
            parameter: at.parameter,
        };
        let direction = metric.unit(origin.to(&guess));
        let corrected = correct(method, &tracer.corrector, &metric, &direction, guess).ok()?;
        let direction = tangent(&corrected.local, &metric, &direction)?;
        Some((corrected, direction))
    }
}
