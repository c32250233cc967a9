//! The curve between two neighbouring points of a branch, at any place in between.

use crate::analysis::BranchPoint;
use crate::continuation::{
    Bracket, Corrector, CurvePoint, Direction, HermiteSegment, Metric, Position, correct,
    correct_at, tangent,
};
use crate::orbit::{
    Orbit, OrbitMethod, ParametricModel, Shooting, ShootingEvaluation, multipliers,
};
use std::cell::RefCell;
use std::rc::Rc;

/// Most trials for one zero.
const MAX_TRIALS: u32 = 60;

/// Share of its values at the ends below which a value counts as zero.
const ZERO_ROUNDOFF: f64 = 1e-11;

/// Share of the piece below which two places are one.
const MIN_BRACKET: f64 = 1e-11;

/// Half the width of the difference that gives the slope of power, as a share of the piece.
const DIFFERENCE_WIDTH: f64 = 0.02;

/// A place of the piece.
#[derive(Debug, Clone)]
pub struct PiecePoint {
    /// Share of the way, along the chord.
    pub x: f64,
    step: Rc<CurvePoint<ShootingEvaluation>>,
}

impl PiecePoint {
    /// Value of the key.
    pub fn parameter(&self) -> f64 {
        self.step.position.parameter
    }

    /// Mean power, W.
    pub fn mean_power_w(&self) -> f64 {
        self.step.local.loads_w.iter().sum::<f64>() + 0.0
    }

    /// State at the start of the period, energy coordinates.
    pub fn start(&self) -> &[f64] {
        &self.step.local.strobe_states[0]
    }

    /// Largest modulus of a multiplier.
    pub fn floquet_max_abs(&self) -> Option<f64> {
        Some(multipliers(&self.step.local.block_map)?.first()?.norm())
    }
}

/// A zero, and the value that is left there.
#[derive(Debug)]
pub struct PieceZero {
    pub place: PiecePoint,
    pub value: f64,
}

/// A piece of a branch.
pub struct CurvePiece<'h, H> {
    shooting: Shooting<'h, H>,
    corrector: Corrector,
    metric: Metric,
    ahead: Direction,
    /// Of the chord.
    length: f64,
    /// Where it starts.
    from: Position,
    /// All places looked at so far, in their order: the next one is guessed between its neighbours.
    known: RefCell<Vec<PiecePoint>>,
}

impl<'h, H: ParametricModel> CurvePiece<'h, H> {
    /// Between two points; `None` where shooting does not find them again.
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
        let ahead = metric.unit(from.to(&to));
        let step = |guess: Position| {
            let found = correct(&shooting, &corrector, &metric, &ahead, guess.clone());
            // Where the curve is cut at an edge of the range, the chord may stand across nothing.
            let found = found
                .or_else(|_| correct_at(&shooting, &corrector, &metric, guess))
                .ok()?;
            let tangent = tangent(&found.local, &metric, &ahead)?;
            Some(Rc::new(CurvePoint {
                position: found.position,
                tangent,
                local: found.local,
                error: found.error,
            }))
        };
        let (start, end) = (step(from)?, step(to)?);
        let from = start.position.clone();
        let length = metric.inner(&ahead, &from.to(&end.position));
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
            ahead,
            length,
            from,
            known,
        })
    }

    /// The place at a share of the way, a little beyond the ends too.
    pub fn at(&self, x: f64) -> Option<PiecePoint> {
        let known = self
            .known
            .borrow()
            .iter()
            .find(|place| place.x == x)
            .cloned();
        if known.is_some() {
            return known;
        }
        let found = correct(
            &self.shooting,
            &self.corrector,
            &self.metric,
            &self.ahead,
            self.guess(x),
        )
        .ok()?;
        let tangent = tangent(&found.local, &self.metric, &self.ahead)?;
        let step = Rc::new(CurvePoint {
            position: found.position,
            tangent,
            local: found.local,
            error: found.error,
        });
        let (place, mut known) = (PiecePoint { x, step }, self.known.borrow_mut());
        let next = known.partition_point(|other| other.x < x);
        known.insert(next, place.clone());
        Some(place)
    }

    /// A guess at a share of the way: on the cubic between the neighbours known, and in the plane across the chord there.
    fn guess(&self, x: f64) -> Position {
        let known = self.known.borrow();
        let next = known
            .partition_point(|place| place.x < x)
            .clamp(1, known.len() - 1);
        let (a, b) = (&known[next - 1], &known[next]);
        let cubic = HermiteSegment::between(
            &self.metric,
            (&a.step.position, &a.step.tangent),
            (&b.step.position, &b.step.tangent),
        );
        let guess = cubic.at((x - a.x) / (b.x - a.x) * cubic.length);
        let off = x * self.length - self.metric.inner(&self.ahead, &self.from.to(&guess));
        guess.moved(&self.ahead, off)
    }

    /// The orbit at a place, with its multipliers and its error.
    pub fn orbit(&self, place: &PiecePoint) -> Option<Orbit> {
        self.shooting
            .orbit(&place.step.local, place.step.error)
            .ok()
    }

    /// Change of power along the piece, W per share of the way: a difference of fourth order.
    pub fn power_slope_w(&self, x: f64) -> Option<f64> {
        let power_w = |offset: f64| Some(self.at(x + offset * DIFFERENCE_WIDTH)?.mean_power_w());
        Some(
            (8.0 * (power_w(1.0)? - power_w(-1.0)?) - (power_w(2.0)? - power_w(-2.0)?))
                / (12.0 * DIFFERENCE_WIDTH),
        )
    }

    /// How far off the key may be at a place that is off by a share of the way, and by what Newton left out.
    pub fn parameter_error(&self, place: &PiecePoint, off: f64) -> Option<f64> {
        let slope = (self.at(place.x + DIFFERENCE_WIDTH)?.parameter()
            - self.at(place.x - DIFFERENCE_WIDTH)?.parameter())
            / (2.0 * DIFFERENCE_WIDTH);
        Some(off * slope.abs() + self.metric.parameter * place.step.error)
    }

    /// The place between two shares at which power has its maximum, where it rises into the stretch from both ends; a slope below
    /// `noise_w` counts as none.
    pub fn maximum(&self, (from, to): (f64, f64), noise_w: f64) -> Option<PieceZero> {
        let rises = self.power_slope_w(from)? > 0.0 && self.power_slope_w(to)? < 0.0;
        rises
            .then(|| self.zero((from, to), noise_w, |place| self.power_slope_w(place.x)))
            .flatten()
    }

    /// The place between two shares where `value` passes zero, to its own noise; `None` without a change of sign.
    pub fn zero(
        &self,
        (from, to): (f64, f64),
        noise: f64,
        value: impl Fn(&PiecePoint) -> Option<f64>,
    ) -> Option<PieceZero> {
        let look = |x: f64| {
            let place = self.at(x)?;
            let value = value(&place)?;
            Some(PieceZero { place, value })
        };
        let (low, high) = (look(from)?, look(to)?);
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
            best = look(x)?;
            let moved = bracket.put(x, best.value);
            if best.value.abs() <= enough || moved.min(bracket.length()) <= MIN_BRACKET {
                break;
            }
        }
        Some(best)
    }
}
