//! Search for all bifurcation curves that cross an edge of the plane or the spec's value of the
//! second key.

use super::curve::{BifurcationCurve, BifurcationCurvePoint};
use super::key_plane::KeyPlane;
use super::seed::CurveSeed;
use crate::bandwidth::CurvePiece;
use crate::{
    AnalysisError, Branch, BranchOptions, BranchSearch, Model, OrbitMethodKind, Parameter,
};
use jounce_continuation::{Corrector, Direction, Metric, Position, Problem, correct_at, tangent};
use jounce_linalg::norm;
use jounce_orbits::{ExtendedProblem, OrbitError, Shooting, TwoParameterProblem};
use jounce_spec::NumericKey;

/// Definition of a search for bifurcation curves.
#[derive(Debug)]
pub struct BifurcationSearch<'s> {
    /// Model of the spec, unchanged.
    pub base: &'s Model,
    /// First and second key.
    pub keys: [&'s NumericKey; 2],
    /// Ranges of the keys.
    pub ranges: [(f64, f64); 2],
    /// Relative tolerance of the integrations.
    pub tolerance: f64,
    /// Number of values across a range at which integrations search for orbits.
    pub seeds: usize,
    /// Longest period of a branch, drive cycles.
    pub longest_period: u32,
    /// True: follow peaks of power too.
    pub peaks: bool,
}

type Failure = OrbitError<AnalysisError>;

/// Fraction of a range within which two points of one kind coincide ...
const SAME_PLACE_SHARE: f64 = 5e-3;

/// ... and fraction of a power.
const SAME_POWER_SHARE: f64 = 0.05;

/// Goal of Newton's method relative to the tolerance of the integration. A critical multiplier is
/// less accurate than the orbit; along its eigenvector a fold moves by that error over its
/// curvature. The parameter moves only by the square of it.
const NEWTON_GOAL_FACTOR: f64 = 1e3;

impl BifurcationSearch<'_> {
    /// Value of `seeds` where not given.
    pub const DEFAULT_SEEDS: usize = 4;

    /// Finds and follows the curves; after cancellation returns the finished ones.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run(&self) -> Result<Vec<BifurcationCurve>, Failure> {
        self.run_with(&BranchOptions::default())
    }

    /// Finds and follows the curves with options for the initial branches; their levels are
    /// followed too.
    ///
    /// # Errors
    /// [`OrbitError`].
    pub fn run_with(&self, options: &BranchOptions) -> Result<Vec<BifurcationCurve>, Failure> {
        for key in self.keys {
            Parameter::check_key(key).map_err(OrbitError::Harvester)?;
        }
        let plane = KeyPlane {
            base: self.base,
            keys: self.keys,
            widths: self.ranges.map(|(low, high)| high - low),
        };
        let (low, high) = self.ranges[1];
        let second_value = self.keys[1]
            .get(&self.base.spec)
            .ok()
            .filter(|second_value| *second_value > low && *second_value < high);
        let mut curves: Vec<BifurcationCurve> = Vec::new();
        let of_second = second_value
            .into_iter()
            .chain([low, high])
            .map(|value| (1, value));
        let of_first = <[f64; 2]>::from(self.ranges[0]).map(|value| (0, value));
        for (fixed_key, value) in of_second.chain(of_first) {
            let outcome = if fixed_key == 1 {
                self.through(&plane, (value, options), &mut curves)
            } else {
                self.across(&plane, (value, options), &mut curves)
            };
            if self.base.kernel.control.is_stopped() {
                break;
            }
            outcome?;
        }
        Ok(curves)
    }

    /// Adds the curves that cross an edge of the first range and are found only over the second
    /// key.
    fn across(
        &self,
        plane: &KeyPlane,
        (parameter, options): (f64, &BranchOptions),
        curves: &mut Vec<BifurcationCurve>,
    ) -> Result<(), Failure> {
        let mut spec = self.base.spec.clone();
        self.keys[0]
            .set(&mut spec, parameter)
            .map_err(|fault| OrbitError::Harvester(fault.into()))?;
        let model = self.base.changed(spec).map_err(OrbitError::Harvester)?;
        let branches = self.branches(&model, 1, options)?;
        for (branch, bifurcation) in branches.iter().flat_map(|branch| {
            branch
                .bifurcations
                .iter()
                .map(move |bifurcation| (branch, bifurcation))
        }) {
            let seed = CurveSeed {
                parameter,
                ..CurveSeed::bifurcation(branch, bifurcation, &options.levels)
            };
            let parameter_2 = bifurcation.at.parameter;
            if !curves.iter().any(|curve| {
                self.holds(curve, &seed, parameter_2) || self.ends_at(curve, &seed, parameter_2)
            }) {
                self.add(self.both_ways(plane, &seed, parameter_2)?, curves);
            }
        }
        Ok(())
    }

    /// Returns the branches over one key, at the value of the other in `model`.
    fn branches(
        &self,
        model: &Model,
        key: usize,
        options: &BranchOptions,
    ) -> Result<Vec<Branch>, Failure> {
        let range = self.ranges[key];
        let parameter = Parameter::new(model, self.keys[key], range.1 - range.0);
        let (method, tolerance, seeds, longest_period) = (
            OrbitMethodKind::Shooting,
            self.tolerance,
            self.seeds,
            self.longest_period,
        );
        BranchSearch {
            base: model,
            parameter: &parameter,
            range,
            method,
            tolerance,
            seeds,
            longest_period,
        }
        .run_with(options)
    }

    /// Adds the curves through one line.
    fn through(
        &self,
        plane: &KeyPlane,
        (parameter_2, options): (f64, &BranchOptions),
        curves: &mut Vec<BifurcationCurve>,
    ) -> Result<(), Failure> {
        for seed in self.seeds(plane, parameter_2, options)? {
            if !curves
                .iter()
                .any(|curve| self.holds(curve, &seed, parameter_2))
            {
                self.add(self.both_ways(plane, &seed, parameter_2)?, curves);
            }
        }
        Ok(())
    }

    /// Returns the points on one line from which curves may start.
    fn seeds(
        &self,
        plane: &KeyPlane,
        parameter_2: f64,
        options: &BranchOptions,
    ) -> Result<Vec<CurveSeed>, Failure> {
        let line = plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let range = self.ranges[0];
        let parameter = Parameter::new(&line.model, self.keys[0], range.1 - range.0);
        let branches = self.branches(&line.model, 0, options)?;
        let bifurcations = branches.iter().flat_map(|branch| {
            branch
                .bifurcations
                .iter()
                .map(|bifurcation| CurveSeed::bifurcation(branch, bifurcation, &options.levels))
        });
        let corrector = Corrector {
            goal: (10.0 * self.tolerance).clamp(1e-11, 1e-6),
            most: 8,
        };
        let peaks = branches.iter().filter(|_| self.peaks).flat_map(|branch| {
            let shooting = || {
                Shooting::new(
                    &parameter,
                    &line.model.kernel,
                    branch.period_cycles,
                    self.tolerance,
                )
            };
            CurveSeed::peaks(branch, |points| {
                CurvePiece::new(shooting(), corrector, (range.1 - range.0) / 20.0, points)
            })
        });
        Ok(bifurcations.chain(peaks).collect())
    }

    /// Adds a curve. An incomplete curve may be a part of a complete one with another start.
    fn add(&self, curve: Option<BifurcationCurve>, curves: &mut Vec<BifurcationCurve>) {
        let Some(curve) = curve else { return };
        if curve.failures.is_empty() {
            curves.retain(|known| known.failures.is_empty() || !self.is_part(known, &curve));
        } else if curves
            .iter()
            .any(|complete| complete.failures.is_empty() && self.is_part(&curve, complete))
        {
            return;
        }
        curves.push(curve);
    }

    /// True when a curve lies on another, by its first point and two inner ones.
    fn is_part(&self, part: &BifurcationCurve, complete: &BifurcationCurve) -> bool {
        let count = part.points.len();
        let passes = |k: usize| self.passes(complete, &part.points[k]);
        part.is_alike(complete) && [0, count / 2, 3 * count / 4].into_iter().all(passes)
    }

    /// True when a point lies on a known curve.
    fn holds(&self, curve: &BifurcationCurve, seed: &CurveSeed, parameter_2: f64) -> bool {
        seed.is_of(curve) && self.passes(curve, &seed.point(parameter_2))
    }

    /// True when a curve passes near a point.
    fn passes(&self, curve: &BifurcationCurve, point: &BifurcationCurvePoint) -> bool {
        let (low, high) = self.ranges[0];
        let near = |(parameter, power_w): &(f64, f64)| {
            (parameter - point.parameter).abs() < SAME_PLACE_SHARE * (high - low)
                && (power_w - point.mean_power_w).abs() <= SAME_POWER_SHARE * point.mean_power_w
        };
        curve.crossings(point.parameter_2).iter().any(near)
    }

    /// True when a curve ends at a point.
    fn ends_at(&self, curve: &BifurcationCurve, seed: &CurveSeed, parameter_2: f64) -> bool {
        let [width, width_2] = self.ranges.map(|(low, high)| high - low);
        let near = |end: &BifurcationCurvePoint| {
            (end.parameter - seed.parameter).abs() < SAME_PLACE_SHARE * width
                && (end.parameter_2 - parameter_2).abs() < SAME_PLACE_SHARE * width_2
                && (end.mean_power_w - seed.mean_power_w).abs()
                    <= SAME_POWER_SHARE * seed.mean_power_w.abs()
        };
        let ends = curve.points.first().into_iter().chain(curve.points.last());
        seed.is_of(curve) && ends.into_iter().any(near)
    }

    fn both_ways(
        &self,
        plane: &KeyPlane,
        seed: &CurveSeed,
        parameter_2: f64,
    ) -> Result<Option<BifurcationCurve>, Failure> {
        let kernel = &self.base.kernel;
        let line = plane.line(parameter_2).map_err(OrbitError::Harvester)?;
        let shooting = Shooting::new(&line, kernel, seed.cycles, self.tolerance);
        let Some(condition) = seed.condition(&shooting.at(&seed.state, seed.parameter)?) else {
            return Ok(None);
        };
        let (low, high) = self.ranges[0];
        let tracking = ExtendedProblem {
            plane,
            condition,
            cycles: seed.cycles,
            tolerance: self.tolerance,
            scale: shooting.scale.clone(),
            origin: seed.parameter,
            unit: (high - low) / (20.0 * norm(&seed.state)),
        };
        let corrector = Corrector {
            goal: (NEWTON_GOAL_FACTOR * self.tolerance).clamp(1e-9, 1e-4),
            most: 12,
        };
        let position = Position {
            unknown: tracking.unknown(&seed.state, seed.parameter),
            parameter: parameter_2,
        };
        let metric = Metric::at(&position, self.scale_2());
        // A seed from which no curve starts is a curve of one point with the reason.
        let lone = |reason: String| BifurcationCurve {
            points: vec![seed.point(parameter_2)],
            failures: vec![reason],
            ..seed.curve()
        };
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let first = match correct_at(&tracking, &corrector, &metric, position.clone()) {
                Ok(first) => first,
                Err(error) => return Ok(Some(lone(error.to_string()))),
            };
            let up = Direction {
                unknown: vec![0.0; position.unknown.len()],
                parameter: sign,
            };
            let Some(direction) = tangent(&first.local, &metric, &up) else {
                return Ok(Some(lone("the curve has no direction there".to_owned())));
            };
            ways.push(self.trace(&tracking, corrector, (first, direction), seed.curve()));
        }
        let up = ways.pop();
        Ok(ways.pop().zip(up).map(|(down, up)| down.joined(up)))
    }

    /// Scale of the second key in the metric.
    pub(super) fn scale_2(&self) -> f64 {
        (self.ranges[1].1 - self.ranges[1].0) / 20.0
    }
}
