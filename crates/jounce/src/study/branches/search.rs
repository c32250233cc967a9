//! All branches of a spec over a range of one key.
//!
//! The branch at the lower end of the range is followed through it; then the one at the upper end; then every orbit that marches
//! from rest and from a hard kick settle on, at values across the range, unless it lies on a branch already known. Doubled
//! branches are entered where a branch doubles. Marches run in parallel; everything after them is in a fixed order.

use super::attractor::settled_orbit;
use super::branch::{Branch, BranchKind, BranchPoint};
use super::follow::Following;
use crate::continuation::{Corrector, Direction, Metric, Position, StepControl, correct, settle, tangent};
use crate::orbit::{Harvester, OrbitError, Shooting, Shot};
use crate::study::{Parameter, Prepared, StudyError};
use faer::Mat;
use faer::linalg::solvers::Solve;
use rayon::prelude::*;

/// A search to be made.
#[derive(Debug)]
pub struct BranchSearch<'s> {
    /// The spec at its own values.
    pub base: &'s Prepared,
    /// The harvesters.
    pub parameter: &'s Parameter<'s>,
    /// Ends of the range.
    pub range: (f64, f64),
    /// Relative tolerance of the marches.
    pub tolerance: f64,
    /// Values across the range at which orbits are sought by marching.
    pub seeds: usize,
    /// Longest period of a doubled branch, drive cycles.
    pub longest_period: u32,
}

type Failure = OrbitError<StudyError>;

impl BranchSearch<'_> {
    fn following(&self) -> Following {
        Following {
            range: self.range,
            corrector: Corrector { goal: (10.0 * self.tolerance).clamp(1e-11, 1e-6), most: 8 },
            control: StepControl::default(),
            most_points: 4000,
        }
    }

    /// Finds and follows the branches.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self) -> Result<Vec<Branch>, Failure> {
        let following = self.following();
        let mut branches: Vec<Branch> = Vec::new();
        for (cycles, unknown, parameter) in self.starts() {
            if branches.iter().any(|branch| holds(branch, cycles, &unknown, parameter)) {
                continue;
            }
            let shooting = Shooting::new(self.parameter, &self.base.kernel, cycles, self.tolerance);
            branches.extend(self.both_ways(&following, &shooting, unknown, parameter)?);
            self.doubled(&following, &mut branches)?;
        }
        Ok(branches)
    }

    /// Settled orbits: lower end, upper end, then across the range.
    fn starts(&self) -> Vec<(u32, Vec<f64>, f64)> {
        let (low, high) = self.range;
        let inner = (1..=self.seeds).map(|k| low + (high - low) * k as f64 / (self.seeds + 1) as f64);
        let values: Vec<f64> = [low, high].into_iter().chain(inner).collect();
        let jobs: Vec<(f64, bool)> = values.iter().flat_map(|value| [(*value, false), (*value, true)]).collect();
        let goal = self.following().corrector.goal;
        (jobs.into_par_iter())
            .filter_map(|(value, kicked)| {
                let start = self.start(value, kicked)?;
                let (cycles, unknown) = settled_orbit(self.parameter, value, &start, self.tolerance, goal)?;
                Some((cycles, unknown, value))
            })
            .collect()
    }

    /// Rest, or every mode moving as fast as the drive could make the stiffest of them.
    fn start(&self, value: f64, kicked: bool) -> Option<Vec<f64>> {
        let plant = self.parameter.at(value).ok()?.kernel.plant;
        let mut state = vec![0.0; plant.len()];
        if kicked {
            let stop = plant.system.stops.first()?;
            let w = plant.tones.first()?.angular_frequency_rad_s;
            let n = plant.system.modes.len();
            // The whole motion at the stop: twenty gaps in amplitude, in the shape of the stop's own port.
            let square: f64 = stop.shape.iter().map(|s| s * s).sum();
            let speed = 20.0 * w * stop.gap_m.abs().max(plant.ports[0].steady_m[0].norm());
            stop.shape.iter().enumerate().for_each(|(i, s)| state[n + i] = s / square * speed);
        }
        Some(state)
    }

    fn both_ways(
        &self,
        following: &Following,
        shooting: &Shooting<'_, Parameter<'_>>,
        unknown: Vec<f64>,
        parameter: f64,
    ) -> Result<Option<Branch>, Failure> {
        let position = Position { unknown, parameter };
        let metric = Metric::at(&position, following.parameter_scale());
        let up = Direction { unknown: vec![0.0; position.unknown.len()], parameter: 1.0 };
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let at_edge = parameter == if sign < 0.0 { self.range.0 } else { self.range.1 };
            let Ok(first) = settle(shooting, &following.corrector, &metric, position.clone()) else { return Ok(None) };
            let Some(mut ahead) = tangent(&first.local, &metric, &up) else { return Ok(None) };
            ahead.unknown.iter_mut().for_each(|d| *d *= sign);
            ahead.parameter *= sign;
            if !at_edge {
                ways.push(following.walk(shooting, first, ahead)?);
            }
        }
        let mut ways = ways.into_iter();
        Ok(match (ways.next(), ways.next()) {
            (Some(down), Some(up)) => Some(down.joined(up)),
            (one, _) => one,
        })
    }

    /// Enters doubled branches until none is left.
    fn doubled(&self, following: &Following, branches: &mut Vec<Branch>) -> Result<(), Failure> {
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
                let shooting = Shooting::new(self.parameter, &self.base.kernel, cycles, self.tolerance);
                let Some((first, ahead)) = self.off(following, &shooting, &at) else { continue };
                if branches.iter().any(|branch| holds(branch, cycles, &first.position.unknown, first.position.parameter)) {
                    continue;
                }
                let found = following.walk(&shooting, first, ahead)?;
                branches.push(found);
            }
        }
        Ok(())
    }

    /// A first orbit on the doubled branch, off the doubling along the eigenvector of the multiplier -1.
    fn off(
        &self,
        following: &Following,
        shooting: &Shooting<'_, Parameter<'_>>,
        at: &BranchPoint,
    ) -> Option<(crate::continuation::Corrected<Shot>, Direction)> {
        let single = Shooting::new(self.parameter, &self.base.kernel, shooting.cycles / 2, self.tolerance);
        let map = crate::continuation::Family::at(&single, &at.unknown, at.parameter).ok()?.map;
        let n = at.unknown.len();
        // Inverse iteration towards -1.
        let shifted = Mat::from_fn(n, n, |i, j| map[(i, j)] + if i == j { 1.0 + 1e-9 } else { 0.0 });
        let solver = shifted.partial_piv_lu();
        let mut vector = Mat::from_fn(n, 1, |_, _| 1.0);
        for _ in 0..4 {
            vector = solver.solve(&vector);
            let size = vector.norm_l2();
            vector = Mat::from_fn(n, 1, |i, _| vector[(i, 0)] / size);
        }
        let position = Position { unknown: at.unknown.clone(), parameter: at.parameter };
        let metric = Metric::at(&position, following.parameter_scale());
        let ahead = metric.unit(Direction { unknown: (0..n).map(|i| vector[(i, 0)]).collect(), parameter: 0.0 });
        [1e-2, 3e-3, 3e-2].into_iter().find_map(|length| {
            let found = correct(shooting, &following.corrector, &metric, &ahead, position.moved(&ahead, length)).ok()?;
            let ahead = tangent(&found.local, &metric, &ahead)?;
            Some((found, ahead))
        })
    }
}

/// True when an orbit lies on a branch.
fn holds(branch: &Branch, cycles: u32, unknown: &[f64], parameter: f64) -> bool {
    let size = unknown.iter().map(|u| u * u).sum::<f64>().sqrt();
    branch.period_cycles == cycles
        && branch.crossings(parameter).iter().any(|(state, _)| {
            let distance = state.iter().zip(unknown).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            distance < 0.03 * size
        })
}
