//! All curves of jumps that pass through three lines of the plane: both ends of the second range, and the spec's own value between.

use super::curve::JumpCurve;
use super::key_plane::KeyPlane;
use super::seed::Seed;
use crate::continuation::{Corrector, Direction, Family, Metric, Position, settle, tangent};

use crate::orbit::{OrbitError, Plane, Shooting, Tracking};
use crate::spec::NumericKey;
use crate::study::bandwidth::Piece;
use crate::study::{BranchSearch, Method, Parameter, Prepared, StudyError};
use faer::ColRef;

/// A search to be made.
#[derive(Debug)]
pub struct JumpSearch<'s> {
    /// The spec at its own values.
    pub base: &'s Prepared,
    /// First and second key.
    pub keys: [&'s NumericKey; 2],
    /// Their ranges.
    pub ranges: [(f64, f64); 2],
    /// Relative tolerance of the marches.
    pub tolerance: f64,
    /// Values across the first range at which orbits are sought by marching.
    pub seeds: usize,
    /// Longest period of a branch, drive cycles.
    pub longest_period: u32,
    /// Whether peaks of power are followed too.
    pub peaks: bool,
}

type Failure = OrbitError<StudyError>;

/// Newton's goal beside the tolerance of the march. A critical multiplier is known less well than the orbit, and along its eigenvector
/// a fold moves by that error over its curvature; the parameter moves by the square of it only.
const RESOLUTION: f64 = 1e3;

impl JumpSearch<'_> {
    /// Finds and follows the curves; stopped by its watch it gives what is finished.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self) -> Result<Vec<JumpCurve>, Failure> {
        let plane = KeyPlane { base: self.base, keys: self.keys, widths: self.ranges.map(|(low, high)| high - low) };
        let (low, high) = self.ranges[1];
        let own = self.keys[1].get(&self.base.spec).ok().filter(|own| *own > low && *own < high);
        let mut curves: Vec<JumpCurve> = Vec::new();
        for parameter_2 in own.into_iter().chain([low, high]) {
            let found = self.through(&plane, parameter_2, &mut curves);
            if self.base.kernel.watch.is_stopped() {
                break;
            }
            found?;
        }
        Ok(curves)
    }

    /// Adds the curves through one line.
    fn through(&self, plane: &KeyPlane, parameter_2: f64, curves: &mut Vec<JumpCurve>) -> Result<(), Failure> {
        for seed in self.seeds(plane, parameter_2)? {
            if !curves.iter().any(|curve| self.holds(curve, &seed, parameter_2)) {
                curves.extend(self.both_ways(plane, &seed, parameter_2)?);
            }
        }
        Ok(())
    }

    /// Places on one line from which curves may start.
    fn seeds(&self, plane: &KeyPlane, parameter_2: f64) -> Result<Vec<Seed>, Failure> {
        let line = plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let range = self.ranges[0];
        let parameter = Parameter::new(&line.prepared, self.keys[0], range.1 - range.0);
        let search = BranchSearch {
            base: &line.prepared,
            parameter: &parameter,
            range,
            method: Method::Shooting,
            tolerance: self.tolerance,
            seeds: self.seeds,
            longest_period: self.longest_period,
        };
        let branches = search.run()?;
        let bifurcations = branches.iter().flat_map(|branch| branch.bifurcations.iter().map(|found| Seed::bifurcation(branch, found)));
        let corrector = Corrector { goal: (10.0 * self.tolerance).clamp(1e-11, 1e-6), most: 8 };
        let peaks = branches.iter().filter(|_| self.peaks).flat_map(|branch| {
            let shooting = || Shooting::new(&parameter, &line.prepared.kernel, branch.period_cycles, self.tolerance);
            Seed::peaks(branch, |points| Piece::new(shooting(), corrector, (range.1 - range.0) / 20.0, points))
        });
        Ok(bifurcations.chain(peaks).collect())
    }

    /// True when a place lies on a curve already known.
    fn holds(&self, curve: &JumpCurve, seed: &Seed, parameter_2: f64) -> bool {
        let (low, high) = self.ranges[0];
        let near = |(parameter, power_w): &(f64, f64)| {
            (parameter - seed.parameter).abs() < 5e-3 * (high - low) && (power_w - seed.mean_power_w).abs() <= 0.05 * seed.mean_power_w
        };
        curve.kind == seed.kind && curve.period_cycles == seed.cycles && curve.crossings(parameter_2).iter().any(near)
    }

    fn both_ways(&self, plane: &KeyPlane, seed: &Seed, parameter_2: f64) -> Result<Option<JumpCurve>, Failure> {
        let kernel = &self.base.kernel;
        let line = plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let shooting = Shooting::new(&line, kernel, seed.cycles, self.tolerance);
        let Some(condition) = seed.condition(&shooting.at(&seed.state, seed.parameter)?) else { return Ok(None) };
        let (low, high) = self.ranges[0];
        let tracking = Tracking {
            plane,
            condition,
            cycles: seed.cycles,
            tolerance: self.tolerance,
            scale: shooting.scale.clone(),
            origin: seed.parameter,
            unit: (high - low) / (20.0 * ColRef::from_slice(&seed.state).norm_l2()),
        };
        let corrector = Corrector { goal: (RESOLUTION * self.tolerance).clamp(1e-9, 1e-4), most: 12 };
        let position = Position { unknown: tracking.unknown(&seed.state, seed.parameter), parameter: parameter_2 };
        let metric = Metric::at(&position, self.scale_2());
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let Ok(first) = settle(&tracking, &corrector, &metric, position.clone()) else { return Ok(None) };
            let up = Direction { unknown: vec![0.0; position.unknown.len()], parameter: sign };
            let Some(ahead) = tangent(&first.local, &metric, &up) else { return Ok(None) };
            ways.push(self.walk(&tracking, corrector, first, ahead, seed.kind));
        }
        let up = ways.pop();
        Ok(ways.pop().zip(up).map(|(down, up)| down.joined(up)))
    }

    /// Scale of the second key in the metric.
    pub(super) fn scale_2(&self) -> f64 {
        (self.ranges[1].1 - self.ranges[1].0) / 20.0
    }
}
