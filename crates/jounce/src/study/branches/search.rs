//! All branches of a spec over a range of one key.
//!
//! The branches through the two ends of the range are followed first; then every orbit that marches from rest, from the steady state without
//! the stop, from a hard kick and from a stronger drive settle on, at values across the range, unless it lies on a branch already known. Doubled branches are entered where a branch
//! doubles. Marches run in parallel; everything after them is in a fixed order.

use super::branch::{Branch, BranchKind, BranchPoint};
use super::eased::eased;
use super::follow::{Following, RESOLUTION, newton_goal};
use super::options::BranchOptions;
use crate::continuation::{Corrected, Corrector, Direction, Family, Metric, Position, StepControl, correct, settle, tangent};
use crate::orbit::{HarmonicBalance, Harvester, Orbit, OrbitError, OrbitMethod, Shooting, null_vector};
use crate::study::{Parameter, Prepared, StudyError, settled_orbits};
use faer::{ColRef, Mat};
use rayon::prelude::*;

/// How orbits are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// On the exact flow.
    Shooting,
    /// Harmonics at the ports, as many as the accuracy needs.
    HarmonicBalance {
        /// Harmonics of the drive to begin with.
        harmonics: usize,
    },
}

/// A search to be made.
#[derive(Debug)]
pub struct BranchSearch<'s> {
    /// The spec at its own values.
    pub base: &'s Prepared,
    /// The harvesters.
    pub parameter: &'s Parameter<'s>,
    /// Ends of the range.
    pub range: (f64, f64),
    /// How orbits are computed.
    pub method: Method,
    /// Relative tolerance of the marches.
    pub tolerance: f64,
    /// Values between the ends of the range at which orbits are sought by marching.
    pub seeds: usize,
    /// Longest period of a branch, drive cycles.
    pub longest_period: u32,
}

/// Where a march begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Start {
    /// At rest.
    Rest,
    /// In the steady state without the stop: where that does not touch, it is the exact low branch.
    Steady,
    /// With the shape of the stop's port moving fast towards it.
    Kicked,
    /// Where a stronger drive leaves it that is eased; left out where no seeds are asked for.
    Eased,
}

/// Most points of a branch.
const MAX_POINTS: usize = 4000;

/// Share of the range at which no two frequencies, of which one goes with the key, have a common period by chance: that of the golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Speed of a kick, beside that of the steady motion.
const KICK: f64 = 20.0;

/// Tolerance of marches that only lead to where others start.
const COARSE: f64 = 1e-6;

/// Distance beside their size below which two orbits are one, ...
const SAME: f64 = 1e-4;

/// ... or in goals of Newton, where marches are so coarse that those are more.
const SAME_GOALS: f64 = 10.0;

/// Error of the mean power that is allowed in harmonic balance, beside the tolerance of a march.
const ACCURACY: f64 = 300.0;

type Failure = OrbitError<StudyError>;

impl BranchSearch<'_> {
    fn following(&self) -> Following {
        self.following_with(&BranchOptions::default())
    }

    fn following_with(&self, options: &BranchOptions) -> Following {
        Following {
            range: self.range,
            corrector: Corrector { goal: newton_goal(self.tolerance), most: 8 },
            control: StepControl { longest: options.largest_step, ..StepControl::default() },
            most_points: MAX_POINTS,
            budget: options.budget,
            resolution: RESOLUTION,
            levels: options.levels.clone(),
        }
    }

    fn shooting(&self, cycles: u32) -> Shooting<'_, Parameter<'_>> {
        Shooting::new(self.parameter, &self.base.kernel, cycles, self.tolerance)
    }

    /// Finds and follows the branches; stopped by its watch it gives what is finished.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self) -> Result<Vec<Branch>, Failure> {
        self.run_with(&BranchOptions::default())
    }

    /// The same with options of its own.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run_with(&self, options: &BranchOptions) -> Result<Vec<Branch>, Failure> {
        let following = self.following_with(options);
        match self.method {
            Method::Shooting => self.run_by(&following, |cycles| Ok(self.shooting(cycles))),
            Method::HarmonicBalance { harmonics } => self.run_by(&following, |cycles| {
                let accuracy = ACCURACY * self.tolerance;
                HarmonicBalance::new(self.shooting(cycles), &self.base.kernel, harmonics * cycles as usize, accuracy)
            }),
        }
    }

    fn run_by<M: OrbitMethod<Fault = StudyError>>(
        &self,
        following: &Following,
        make: impl Fn(u32) -> Result<M, Failure>,
    ) -> Result<Vec<Branch>, Failure> {
        self.check_ends()?;
        make(1)?;
        let watch = &self.base.kernel.watch;
        let mut branches: Vec<Branch> = Vec::new();
        let starts = self.starts();
        watch.expect(starts.len());
        for (orbit, parameter) in starts {
            if orbit.period_cycles > self.longest_period || branches.iter().any(|branch| self.lies_on(branch, &orbit, parameter)) {
                watch.count();
                continue;
            }
            let Some(within) = following.within(&branches, orbit.period_cycles) else {
                branches.push(Branch::of_one(orbit, parameter));
                watch.count();
                continue;
            };
            let method = make(orbit.period_cycles)?;
            let found = within.both_ways(&method, orbit.start(), parameter);
            let found = found.and_then(|branch| {
                // One that could not be followed to its end may be a part of one that was begun elsewhere.
                branches.retain(|known| known.is_whole() || !branch.as_ref().is_some_and(|whole| self.is_part(known, whole)));
                branches.extend(branch);
                self.doubled(following, &make, &mut branches)
            });
            if !watch.is_stopped() {
                found?;
            }
            watch.count();
        }
        Ok(branches)
    }

    /// Harvesters exist at both ends of the range, with drives that repeat themselves together there and in between.
    fn check_ends(&self) -> Result<(), Failure> {
        Parameter::check_key(self.parameter.key()).map_err(OrbitError::Harvester)?;
        let between = self.range.0 + GOLDEN * (self.range.1 - self.range.0);
        for value in [self.range.0, self.range.1, between] {
            let kernel = self.parameter.at(value).map_err(OrbitError::Harvester)?.kernel;
            if kernel.plant.period_s().is_none() {
                return Err(OrbitError::Frequencies { frequencies: kernel.plant.tones.len() });
            }
        }
        Ok(())
    }

    /// True when an orbit lies on a branch, at whichever of its drive cycles it is looked at. Where the branch leaves the chord between
    /// two of its points, by less than the length of that, Newton tells whether it is the branch that passes there.
    fn lies_on(&self, branch: &Branch, orbit: &Orbit, parameter: f64) -> bool {
        if branch.period_cycles != orbit.period_cycles || branch.holds(orbit, parameter) {
            return branch.period_cycles == orbit.period_cycles;
        }
        let shooting = self.shooting(orbit.period_cycles);
        let same = (SAME_GOALS * newton_goal(self.tolerance)).max(SAME);
        let apart = |a: &[f64], b: &[f64]| (ColRef::from_slice(a) - ColRef::from_slice(b)).norm_l2();
        let nearest = |state: &[f64]| orbit.looks.iter().map(|look| apart(state, look)).fold(f64::INFINITY, f64::min);
        branch.chords(parameter).into_iter().any(|(guess, length)| {
            if nearest(&guess) > length {
                return false;
            }
            let guess = Position { unknown: guess, parameter };
            let metric = Metric::at(&guess, 1.0);
            let found = settle(&shooting, &self.following().corrector, &metric, guess);
            found.is_ok_and(|found| nearest(&found.position.unknown) < same * orbit.size())
        })
    }

    /// True when a branch lies on another one, by its ends and its middle.
    fn is_part(&self, part: &Branch, whole: &Branch) -> bool {
        let count = part.points.len();
        [0, count / 2, count - 1].into_iter().all(|k| self.lies_on(whole, &part.points[k].orbit, part.points[k].parameter))
    }

    /// Settled orbits: lower end, upper end, then across the range.
    fn starts(&self) -> Vec<(Orbit, f64)> {
        let (low, high) = self.range;
        let inner = (1..=self.seeds).map(|k| low + (high - low) * k as f64 / (self.seeds + 1) as f64);
        let values: Vec<f64> = [low, high].into_iter().chain(inner).collect();
        let kinds = [Start::Rest, Start::Steady, Start::Kicked, Start::Eased];
        // Without seeds only what a plain integration reaches.
        let kinds = &kinds[..if self.seeds > 0 { 4 } else { 3 }];
        let watch = &self.base.kernel.watch;
        watch.expect(values.len());
        let settled = |value: &f64| -> Vec<(Start, (Orbit, f64))> {
            let starts = kinds.iter().filter_map(|kind| Some((*kind, self.start(*value, *kind)?)));
            let (kinds, starts): (Vec<Start>, Vec<Vec<f64>>) = starts.unzip();
            let found = settled_orbits(self.parameter, *value, &starts, self.tolerance);
            watch.count();
            kinds.into_iter().zip(found).filter_map(|(kind, orbit)| Some((kind, (orbit?, *value)))).collect()
        };
        let found: Vec<(Start, (Orbit, f64))> = values.par_iter().flat_map_iter(settled).collect();
        // The eased starts last, so that they only add to what the others find.
        let (eased, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|(kind, _)| *kind == Start::Eased);
        others.into_iter().chain(eased).map(|(_, found)| found).collect()
    }

    /// The physical state of a start.
    fn start(&self, value: f64, start: Start) -> Option<Vec<f64>> {
        let kernel = self.parameter.at(value).ok()?.kernel;
        let plant = &kernel.plant;
        let mut state = vec![0.0; plant.len()];
        match start {
            Start::Rest => {}
            Start::Eased => state = eased(&kernel, self.tolerance.max(COARSE))?,
            Start::Steady => state = plant.to_physical(&state, 0.0),
            Start::Kicked => {
                let w = plant.tones.first()?.angular_frequency_rad_s;
                let n = plant.system.modes.len();
                let speed = KICK * w * plant.scale_m();
                // Towards every stop at once.
                for stop in &plant.system.stops {
                    let square: f64 = stop.shape.iter().map(|s| s * s).sum();
                    stop.shape.iter().enumerate().for_each(|(i, s)| state[n + i] += s / square * speed);
                }
            }
        }
        Some(state)
    }

    /// Enters doubled branches until none is left.
    fn doubled<M: OrbitMethod<Fault = StudyError>>(
        &self,
        following: &Following,
        make: &impl Fn(u32) -> Result<M, Failure>,
        branches: &mut Vec<Branch>,
    ) -> Result<(), Failure> {
        let mut next = 0;
        while next < branches.len() {
            let cycles = 2 * branches[next].period_cycles;
            let doublings: Vec<BranchPoint> = (branches[next].bifurcations.iter())
                .filter(|found| found.kind == BranchKind::PeriodDoubling)
                .map(|found| found.at.clone())
                .collect();
            next += 1;
            if cycles > self.longest_period {
                continue;
            }
            for at in doublings {
                let Some(within) = following.within(branches, cycles) else {
                    branches[next - 1].not_followed += 1;
                    continue;
                };
                let method = make(cycles)?;
                let Some((first, ahead)) = self.off(following, &method, &at) else { continue };
                let orbit = method.orbit(&first.local, first.error)?;
                if !branches.iter().any(|branch| self.lies_on(branch, &orbit, first.position.parameter)) {
                    let found = within.walk(&method, first, ahead)?;
                    branches.push(found);
                }
            }
        }
        Ok(())
    }

    /// A first orbit on the doubled branch, off the doubling along the eigenvector of the multiplier -1.
    fn off<M: OrbitMethod<Fault = StudyError>>(
        &self,
        following: &Following,
        method: &M,
        at: &BranchPoint,
    ) -> Option<(Corrected<M::Local>, Direction)> {
        let state = at.orbit.start();
        let shot = self.shooting(method.cycles() / 2).at(state, at.parameter).ok()?;
        let map = shot.map();
        let n = state.len();
        let vector = null_vector(&Mat::from_fn(n, n, |i, j| map[(i, j)] + if i == j { 1.0 } else { 0.0 }));
        let size = at.orbit.size();
        let origin = Position { unknown: method.unknown_of(state, at.parameter).ok()?, parameter: at.parameter };
        let metric = Metric::at(&origin, following.parameter_scale());
        [1e-2, 3e-3, 3e-2].into_iter().find_map(|length| {
            let moved: Vec<f64> = (0..n).map(|i| state[i] + length * size * vector[i]).collect();
            let guess = Position { unknown: method.unknown_of(&moved, at.parameter).ok()?, parameter: at.parameter };
            let apart = guess.unknown.iter().zip(&origin.unknown).map(|(a, b)| a - b).collect();
            let ahead = metric.unit(Direction { unknown: apart, parameter: 0.0 });
            let found = correct(method, &following.corrector, &metric, &ahead, guess).ok()?;
            let ahead = tangent(&found.local, &metric, &ahead)?;
            Some((found, ahead))
        })
    }
}
