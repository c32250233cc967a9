//! Refinement of a design along its orbit: sequential quadratic programming with the derivatives of
//! the orbit.
//!
//! The logarithm of the power is maximised over the unit cube of the keys that have a derivative,
//! while every limited peak on the orbit stays below its limit. A design at which the orbit is lost
//! or unstable counts as much worse, so that the line search turns back.

use super::{Candidate, Followed};
use crate::evaluation::Evaluator;
use crate::problem::{Problem, Size};
use jounce_analysis::{Derivative, DerivativeAccuracy, DerivativeKey, orbit_derivatives};
use jounce_orbits::OrbitQuantity;
use jounce_spec::NumericKey;
use slsqp::{Func, StopTols, minimize};
use std::cell::RefCell;
use std::rc::Rc;

/// Numbers of followed designs after which the best of them is evaluated; the last is the largest.
const STAGES: [usize; 3] = [10, 20, 40];

/// Relative change of the power below which the refinement ends.
const POWER_TOLERANCE: f64 = 1e-8;

/// Value of a design without a stable orbit.
const LOST: f64 = 1e3;

/// Share of the distance to a limit that the refinement leaves, for its own error.
const MARGIN: f64 = 1e-3;

/// A followed design.
struct Point {
    place: Vec<f64>,
    followed: Option<Followed>,
    /// `-ln P`, then `value / limit - 1` of each limited peak and size.
    values: Vec<f64>,
    /// Derivatives of the values by the place; per value.
    slopes: Vec<Vec<f64>>,
}

/// Refinement of one design.
struct Refinement<'r> {
    problem: &'r Problem,
    /// Place of the start, with the keys that stay.
    start: &'r [f64],
    /// Indices of the keys that have a derivative.
    smooth: Vec<usize>,
    quantities: Vec<OrbitQuantity>,
    /// Sizes that have limits.
    sizes: Vec<Size>,
    /// Limits of the quantities after the first, then of the sizes, SI.
    limits: Vec<f64>,
    points: RefCell<Vec<Rc<Point>>>,
}

/// Best of the first followed designs of a refinement.
#[derive(Clone)]
pub struct Refined {
    /// Place of the largest power along the orbit within its limits.
    pub place: Vec<f64>,
    /// Power there, W.
    pub mean_power_w: f64,
    /// Largest violation of a limit there, as [`crate::problem::Limit::violation`] measures it.
    pub violation: f64,
    /// Number of these designs.
    pub designs: usize,
}

impl Refined {
    /// Returns a design that cannot be refined.
    pub fn at(start: &Candidate) -> Self {
        Self {
            place: start.place.clone(),
            mean_power_w: start.evaluation.goals[0],
            violation: start.evaluation.violation,
            designs: 0,
        }
    }
}

/// Follows the orbit of a design to its largest power within the limits, and returns the best of the
/// followed designs after each stage; `None` where there is nothing to follow.
pub fn refine(evaluator: &Evaluator<'_>, start: &Candidate) -> Option<Vec<Refined>> {
    let problem = evaluator.problem;
    let smooth: Vec<usize> = (0..problem.free.len())
        .filter(|index| problem.free[*index].smooth().is_some())
        .filter(|index| problem.applies(*index, &start.place))
        .collect();
    if !problem.follows_orbit() || smooth.is_empty() {
        return None;
    }
    let mut quantities = vec![OrbitQuantity::MeanPower];
    let (peaks, sizes) = (problem.peaks(), problem.sizes());
    quantities.extend(peaks.iter().map(|(_, quantity)| *quantity));
    let indices = peaks.iter().map(|(index, _)| *index);
    let indices = indices.chain(sizes.iter().map(|(index, _)| *index));
    let limit = |index: usize| problem.limits[index].value * (1.0 - MARGIN);
    let first = Followed::start(evaluator, &start.place, start.evaluation.orbit.as_ref()?)?;
    let refinement = Refinement {
        problem,
        start: &start.place,
        smooth,
        quantities,
        limits: indices.map(limit).collect(),
        sizes: sizes.into_iter().map(|(_, size)| size).collect(),
        points: RefCell::new(Vec::new()),
    };
    refinement.keep(start.place.clone(), Some(first));
    refinement.minimised();
    let points = refinement.points.borrow();
    let mut ends: Vec<usize> = STAGES
        .into_iter()
        .filter(|end| *end < points.len())
        .collect();
    ends.push(points.len());
    ends.into_iter()
        .map(|end| best_of(&points[..end]))
        .collect()
}

/// Returns the best of some followed designs.
fn best_of(points: &[Rc<Point>]) -> Option<Refined> {
    let is_within = |point: &&Rc<Point>| {
        let mut excesses = point.values[1..].iter();
        excesses.all(|excess| *excess <= 0.5 * MARGIN)
    };
    let by_power = |a: &&Rc<Point>, b: &&Rc<Point>| a.values[0].total_cmp(&b.values[0]);
    let best = points.iter().filter(is_within).min_by(by_power);
    // Beyond the limits everywhere: the least violation.
    let worst = |point: &Point| point.values[1..].iter().copied().fold(0.0, f64::max);
    let least = || points.iter().min_by(|a, b| worst(a).total_cmp(&worst(b)));
    let best = best.filter(|best| best.values[0] < LOST).or_else(least)?;
    let excess = worst(best);
    Some(Refined {
        place: best.place.clone(),
        mean_power_w: (-best.values[0]).exp(),
        violation: if excess <= 0.5 * MARGIN {
            0.0
        } else {
            excess / (1.0 + excess)
        },
        designs: points.len(),
    })
}

impl Refinement<'_> {
    fn minimised(&self) {
        let inner: Vec<f64> = self.smooth.iter().map(|k| self.start[*k]).collect();
        let function = |index: usize| {
            move |x: &[f64], gradient: Option<&mut [f64]>, _: &mut ()| {
                let point = self.at(x);
                if let Some(gradient) = gradient {
                    gradient.copy_from_slice(&point.slopes[index]);
                }
                point.values[index]
            }
        };
        let constraints: Vec<_> = (1..=self.limits.len()).map(function).collect();
        let constraints: Vec<&dyn Func<()>> =
            constraints.iter().map(|one| one as &dyn Func<()>).collect();
        let tolerances = StopTols {
            ftol_abs: POWER_TOLERANCE,
            ..StopTols::default()
        };
        let bounds = vec![(0.0, 1.0); inner.len()];
        // The points are kept, whatever the reason of the end.
        let _ = minimize(
            function(0),
            &inner,
            &bounds,
            &constraints,
            (),
            STAGES[STAGES.len() - 1],
            Some(tolerances),
        );
    }

    /// Returns the followed design at some values of the smooth keys.
    fn at(&self, x: &[f64]) -> Rc<Point> {
        let mut place = self.start.to_vec();
        for (k, x) in self.smooth.iter().zip(x) {
            place[*k] = x.clamp(0.0, 1.0);
        }
        let known = self.points.borrow();
        if let Some(point) = known.iter().find(|point| point.place == place) {
            return Rc::clone(point);
        }
        let distance = |point: &Point| jounce_linalg::distance(&point.place, &place);
        let nearest = known
            .iter()
            .filter(|point| point.followed.is_some())
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .map(Rc::clone);
        drop(known);
        let from = nearest.as_ref().and_then(|point| point.followed.as_ref());
        let followed = from.and_then(|from| from.to(&self.numbers(&place)));
        self.keep(place, followed)
    }

    fn numbers(&self, place: &[f64]) -> Vec<(&NumericKey, f64)> {
        let applying = self.problem.applying(place);
        let numbers = applying.filter_map(|(_, free, coordinate)| {
            let range = free.smooth()?;
            Some((&range.key, range.at(coordinate)))
        });
        numbers.collect()
    }

    /// Evaluates a followed design, and keeps it.
    fn keep(&self, place: Vec<f64>, followed: Option<Followed>) -> Rc<Point> {
        let evaluated = followed
            .as_ref()
            .and_then(|followed| self.evaluated(&place, followed));
        let point = match evaluated {
            Some((values, slopes)) => Point {
                place,
                followed,
                values,
                slopes,
            },
            None => {
                let mut values = vec![0.0; 1 + self.limits.len()];
                values[0] = LOST;
                Point {
                    place,
                    followed: None,
                    slopes: vec![vec![0.0; self.smooth.len()]; values.len()],
                    values,
                }
            }
        };
        let point = Rc::new(point);
        self.points.borrow_mut().push(Rc::clone(&point));
        point
    }

    fn evaluated(&self, place: &[f64], followed: &Followed) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let keys = self.problem.derivative_keys(&self.smooth, place);
        let found = orbit_derivatives(
            &followed.model,
            &followed.orbit,
            &keys,
            &self.quantities,
            DerivativeAccuracy::Rough,
        )
        .ok()?;
        let spec = &followed.model.spec;
        let by_key: Result<Vec<_>, _> = found.by_key.into_iter().collect();
        let by_key = by_key.ok()?;
        let power_w = found.values[0].max(f64::MIN_POSITIVE);
        let sizes = self.sizes.iter().map(|size| size.of(spec));
        let limited = found.values[1..].iter().copied().chain(sizes);
        let mut values = vec![-power_w.ln()];
        values.extend(
            limited
                .zip(&self.limits)
                .map(|(value, limit)| value / limit - 1.0),
        );
        let slope = |index: usize, (row, key): (&Vec<Derivative>, &DerivativeKey<'_>)| {
            let by_key = match row.get(index) {
                Some(derivative) => derivative.value,
                None => self.sizes[index - row.len()].derivative(spec, key)?,
            };
            let factor = match index {
                0 => -1.0 / power_w,
                _ => 1.0 / self.limits[index - 1],
            };
            Some(factor * by_key * key.scale)
        };
        let by_place = |index: usize| {
            let pairs = by_key.iter().zip(&keys);
            pairs
                .map(|pair| slope(index, pair))
                .collect::<Option<Vec<f64>>>()
        };
        let by_place = (0..values.len())
            .map(by_place)
            .collect::<Option<Vec<_>>>()?;
        let is_finite = values
            .iter()
            .chain(by_place.iter().flatten())
            .all(|x| x.is_finite());
        is_finite.then_some((values, by_place))
    }
}
