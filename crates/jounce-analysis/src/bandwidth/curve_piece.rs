//! Evaluation of the curve at any point between two neighbouring points of a branch.

use crate::BranchPoint;
use jounce_continuation::{
    Bracket, Corrector, CurvePoint, Direction, HermiteSegment, Metric, Position, correct,
    correct_at, tangent,
};
use jounce_orbits::{
    Orbit, OrbitMethod, ParametricModel, Shooting, ShootingEvaluation, multipliers,
};
use std::cell::RefCell;
use std::rc::Rc;

/// Largest number of iterations for one zero.
const MAX_TRIALS: u32 = 60;

/// Fraction of the end values below which a value counts as zero.
const ZERO_ROUNDOFF: f64 = 1e-11;

/// Fraction of the piece below which two points coincide.
const MIN_BRACKET: f64 = 1e-11;

/// Half width of the difference for the slope of power, as a fraction of the piece.
const DIFFERENCE_WIDTH: f64 = 0.02;

/// Point of a piece.
#[derive(Debug, Clone)]
pub struct PiecePoint {
    /// Fraction of the chord.
    pub x: f64,
    step: Rc<CurvePoint<ShootingEvaluation>>,
}

impl PiecePoint {
    /// Returns the value of the key.
    pub fn parameter(&self) -> f64 {
        self.step.position.parameter
    }

    /// Returns the mean power, W.
    pub fn mean_power_w(&self) -> f64 {
        self.step.local.loads_w.iter().sum::<f64>() + 0.0
    }

    /// Returns the state at the start of the period, energy coordinates.
    pub fn start(&self) -> &[f64] {
        &self.step.local.strobe_states[0]
    }

    /// Returns the largest modulus of a Floquet multiplier.
    pub fn floquet_max_abs(&self) -> Option<f64> {
        Some(multipliers(&self.step.local.block_map)?.first()?.norm())
    }
}

/// Zero of a function on a piece, and the remaining value there.
#[derive(Debug)]
pub struct PieceZero {
    pub point: PiecePoint,
    pub value: f64,
}

/// Piece of a branch between two neighbouring points.
pub struct CurvePiece<'h, H> {
    shooting: Shooting<'h, H>,
    corrector: Corrector,
    metric: Metric,
    direction: Direction,
    /// Length of the chord.
    length: f64,
    /// Start of the piece.
    from: Position,
    /// All points computed so far, in order along the piece; a new guess interpolates between its
    /// neighbours.
    known: RefCell<Vec<PiecePoint>>,
}

impl<'h, H: ParametricModel> CurvePiece<'h, H> {
    /// Creates the piece between two points; `None` where shooting does not converge to them again.
    pub fn new(
        shooting: Shooting<'h, H>,
        corrector: Corrector,
        parameter_scale: f64,
        [a, b]: [&BranchPoint; 2],
    ) -> Option<Self> {
        let position = |point: &BranchPoint| Position {
            unknown: point.orbit.start().to_vec(),
            parameter: point.parameter,
        };
        let (from, to) = (position(a), position(b));
        let metric = Metric::at(&from, parameter_scale);
        let direction = metric.unit(from.to(&to));
        let step = |guess: Position| {
            let corrected = correct(&shooting, &corrector, &metric, &direction, guess.clone());
            // Where the curve is cut at an edge of the range, the hyperplane across the chord may
            // not intersect it.
            let corrected = corrected
                .or_else(|_| correct_at(&shooting, &corrector, &metric, guess))
                .ok()?;
            let tangent = tangent(&corrected.local, &metric, &direction)?;
            Some(Rc::new(CurvePoint {
                position: corrected.position,
                tangent,
                local: corrected.local,
                error: corrected.error,
            }))
        };
        let (start, end) = (step(from)?, step(to)?);
        let from = start.position.clone();
        let length = metric.inner(&direction, &from.to(&end.position));
        let known = RefCell::new(vec![
            PiecePoint {
                x: 0.0,
                step: start,
            },
            PiecePoint { x: 1.0, step: end },
        ]);
        (length > 0.0).then_some(Self {
            shooting,
            corrector,
            metric,
            direction,
            length,
            from,
            known,
        })
    }

    /// Returns the point at a fraction of the chord, which may lie slightly beyond the ends. `None` where
    /// Newton's method does not converge; the caller then takes the ends of the piece, with its length as
    /// their error.
    pub fn at(&self, x: f64) -> Option<PiecePoint> {
        let known = self
            .known
            .borrow()
            .iter()
            .find(|point| point.x == x)
            .cloned();
        if known.is_some() {
            return known;
        }
        let corrected = correct(
            &self.shooting,
            &self.corrector,
            &self.metric,
            &self.direction,
            self.guess(x),
        )
        .ok()?;
        let tangent = tangent(&corrected.local, &self.metric, &self.direction)?;
        let step = Rc::new(CurvePoint {
            position: corrected.position,
            tangent,
            local: corrected.local,
            error: corrected.error,
        });
        let (point, mut known) = (PiecePoint { x, step }, self.known.borrow_mut());
        let next = known.partition_point(|other| other.x < x);
        known.insert(next, point.clone());
        Some(point)
    }

    /// Predicts the position at a fraction of the chord: on the Hermite cubic between the known
    /// neighbours, moved into the hyperplane across the chord.
    fn guess(&self, x: f64) -> Position {
        let known = self.known.borrow();
        let next = known
            .partition_point(|point| point.x < x)
            .clamp(1, known.len() - 1);
        let (a, b) = (&known[next - 1], &known[next]);
        let cubic = HermiteSegment::between(
            &self.metric,
            (&a.step.position, &a.step.tangent),
            (&b.step.position, &b.step.tangent),
        );
        let guess = cubic.at((x - a.x) / (b.x - a.x) * cubic.length);
        let distance = x * self.length - self.metric.inner(&self.direction, &self.from.to(&guess));
        guess.offset_along(&self.direction, distance)
    }

    /// Returns the orbit at a point, with its multipliers and its error; `None` where the integration
    /// fails, as in [`Self::at`].
    pub fn orbit(&self, point: &PiecePoint) -> Option<Orbit> {
        self.shooting
            .orbit(&point.step.local, point.step.error)
            .ok()
    }

    /// Returns the change of power along the piece, W per fraction of the chord, by a fourth-order
    /// difference.
    pub fn power_slope_w(&self, x: f64) -> Option<f64> {
        let power_w = |offset: f64| Some(self.at(x + offset * DIFFERENCE_WIDTH)?.mean_power_w());
        Some(
            (8.0 * (power_w(1.0)? - power_w(-1.0)?) - (power_w(2.0)? - power_w(-2.0)?))
                / (12.0 * DIFFERENCE_WIDTH),
        )
    }

    /// Returns the error of the key at a point whose fraction has the error `x_error`, with the
    /// residual error of Newton's method.
    pub fn parameter_error(&self, point: &PiecePoint, x_error: f64) -> Option<f64> {
        let slope = (self.at(point.x + DIFFERENCE_WIDTH)?.parameter()
            - self.at(point.x - DIFFERENCE_WIDTH)?.parameter())
            / (2.0 * DIFFERENCE_WIDTH);
        Some(x_error * slope.abs() + self.metric.parameter * point.step.error)
    }

    /// Returns the point of maximum power between two fractions, if power rises inwards from both
    /// ends; a slope below `noise_w` counts as zero.
    pub fn maximum(&self, (from, to): (f64, f64), noise_w: f64) -> Option<PieceZero> {
        let rises = self.power_slope_w(from)? > 0.0 && self.power_slope_w(to)? < 0.0;
        rises
            .then(|| self.zero((from, to), noise_w, |point| self.power_slope_w(point.x)))
            .flatten()
    }

    /// Returns the point between two fractions where `value` passes zero, to its noise; `None`
    /// without a change of sign.
    pub fn zero(
        &self,
        (from, to): (f64, f64),
        noise: f64,
        value: impl Fn(&PiecePoint) -> Option<f64>,
    ) -> Option<PieceZero> {
        let sample = |x: f64| {
            let point = self.at(x)?;
            let value = value(&point)?;
            Some(PieceZero { point, value })
        };
        let (low, high) = (sample(from)?, sample(to)?);
        if (low.value > 0.0) == (high.value > 0.0) {
            return None;
        }
        let enough = noise.max(ZERO_ROUNDOFF * low.value.abs().max(high.value.abs()));
        let mut bracket = Bracket::between((from, low.value), (to, high.value));
        let mut best = if low.value.abs() < high.value.abs() {
            low
        } else {
            high
        };
        for _ in 0..MAX_TRIALS {
            let x = bracket.next(MIN_BRACKET);
            best = sample(x)?;
            let progress = bracket.put(x, best.value);
            if best.value.abs() <= enough || progress.min(bracket.length()) <= MIN_BRACKET {
                break;
            }
        }
        Some(best)
    }
}
