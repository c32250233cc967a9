//! Continuation as an iterator over the points of a curve.

use super::corrector::CorrectedPoint;
use super::{
    ContinuationError, Corrector, Direction, HermiteSegment, Metric, Position, Problem,
    ResidualReport, StepControl, correct, tangent,
};

/// Distance from the curve, in tolerances of Newton, of a predictor through points within that
/// tolerance.
const KNOWN_DISTANCE: f64 = 10.0;

/// Fraction of the turn of the tangent that remains on a shorter step at a kink. On a smooth curve
/// the turn is proportional to the length.
const CORNER_TURN_SHARE: f64 = 0.8;

/// Number of shorter steps with an unchanged turn that identifies a kink.
const CORNER_STEPS: u32 = 4;

/// Length below which one such step is enough, since many short steps precede it.
const SHORT_STEP: f64 = 1e-5;

/// Rejected turns of the tangent, on shorter and shorter steps.
#[derive(Debug, Default)]
struct RefusedTurns {
    turn: f64,
    stayed: u32,
}

impl RefusedTurns {
    /// Adds one turn; true at a kink. An orbit has one where the edge of a contact whose force
    /// jumps passes the start of the period.
    fn is_corner(&mut self, turn: f64, length: f64) -> bool {
        self.stayed = if turn > CORNER_TURN_SHARE * self.turn {
            self.stayed + 1
        } else {
            0
        };
        self.turn = turn;
        // The first turn is always counted, since it is compared with zero.
        self.stayed > if length < SHORT_STEP { 1 } else { CORNER_STEPS }
    }
}

/// Point of a curve with its tangent.
#[derive(Debug)]
pub struct CurvePoint<L> {
    /// Position.
    pub position: Position,
    /// Unit tangent, in the direction of continuation.
    pub tangent: Direction,
    /// Evaluation of the problem there.
    pub local: L,
    /// Error of the position, in the metric.
    pub error: f64,
}

/// State of a continuation, to return to.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    position: Position,
    tangent: Direction,
    behind: Option<HermiteSegment>,
    length: f64,
}

impl Checkpoint {
    /// Returns the tangent there, in the direction of continuation.
    pub fn tangent(&self) -> &Direction {
        &self.tangent
    }
}

/// Continuation along a curve.
#[derive(Debug)]
pub struct Continuation<'f, F: Problem> {
    /// The problem.
    pub family: &'f F,
    /// Newton's method.
    pub corrector: Corrector,
    /// Step length control.
    pub control: StepControl,
    /// Scale of the parameter.
    pub parameter_scale: f64,
    /// Last point.
    pub position: Position,
    /// Tangent there.
    pub tangent: Direction,
    /// Segment that leads to the last point.
    pub behind: Option<HermiteSegment>,
    /// Length of the next step.
    pub length: f64,
    /// Number of points so far.
    pub points: usize,
    ended: bool,
}

impl<'f, F: Problem> Continuation<'f, F> {
    /// Creates a continuation from a point on the curve in a direction near its tangent.
    pub fn new(
        family: &'f F,
        corrector: Corrector,
        control: StepControl,
        parameter_scale: f64,
        position: Position,
        tangent: Direction,
    ) -> Self {
        Self {
            family,
            corrector,
            control,
            parameter_scale,
            position,
            tangent,
            behind: None,
            length: control.first,
            points: 0,
            ended: false,
        }
    }

    /// Returns a checkpoint of the current state.
    pub fn mark(&self) -> Checkpoint {
        let Self {
            position,
            tangent,
            behind,
            length,
            ..
        } = self;
        Checkpoint {
            position: position.clone(),
            tangent: tangent.clone(),
            behind: behind.clone(),
            length: *length,
        }
    }

    /// Continues from a checkpoint of a continuation in another unknown, given the linear map to
    /// this one.
    pub fn resume(&mut self, mark: &Checkpoint, map: impl Fn(&[f64]) -> Vec<f64>) {
        self.behind = mark.behind.as_ref().map(|segment| segment.mapped(&map));
        self.length = mark.length;
    }

    /// Returns to a checkpoint to try a shorter step; false, without a change, when the step would
    /// be too short.
    pub fn retreat(&mut self, mark: Checkpoint) -> bool {
        let length = self.control.shorter(mark.length.min(self.length));
        let is_long_enough = length > self.control.shortest;
        if is_long_enough {
            (self.position, self.tangent, self.behind, self.length) =
                (mark.position, mark.tangent, mark.behind, length);
        }
        is_long_enough
    }

    fn advance(&mut self) -> Result<CurvePoint<F::Evaluation>, ContinuationError<F::Error>> {
        let metric = Metric::at(&self.position, self.parameter_scale);
        let direction = metric.unit(self.tangent.clone());
        let (mut last, mut refused) = ((None, ResidualReport::default()), None);
        let mut turns = RefusedTurns::default();
        while self.length > self.control.shortest {
            let guess = match &self.behind {
                Some(segment) => segment.at(segment.length + self.length),
                None => self.position.offset_along(&direction, self.length),
            };
            match correct(
                self.family,
                &self.corrector,
                &metric,
                &direction,
                guess.clone(),
            ) {
                Ok(corrected) => {
                    // Points are known to Newton's tolerance, and so is the predictor computed from
                    // them.
                    let correction = metric.length(&guess.to(&corrected.position))
                        - KNOWN_DISTANCE * self.corrector.goal;
                    if self.behind.is_some()
                        && self
                            .control
                            .strayed(correction, self.length, corrected.evaluations)
                    {
                        last = (Some(corrected.error), ResidualReport::default());
                    } else if let Some(step) = self.take(corrected, &direction, &mut turns) {
                        return Ok(step);
                    }
                }
                Err(ContinuationError::Diverged {
                    error,
                    left: residuals,
                    ..
                }) => last = (Some(error), residuals),
                // The problem may have no meaning at a long step although the curve continues; try
                // a shorter one.
                Err(ContinuationError::Family(error)) => refused = Some(error),
                Err(ContinuationError::Singular { .. } | ContinuationError::Stuck { .. }) => {}
            }
            self.length = self.control.shorter(self.length);
        }
        if let Some(error) = refused {
            return Err(ContinuationError::Family(error));
        }
        let (error, residuals) = last;
        Err(ContinuationError::Stuck {
            parameter: self.position.parameter,
            step: self.length,
            error,
            left: residuals,
        })
    }

    /// Accepts a corrected point, unless the tangent turned so far that it may be on another curve.
    fn take(
        &mut self,
        corrected: CorrectedPoint<F::Evaluation>,
        direction: &Direction,
        turns: &mut RefusedTurns,
    ) -> Option<CurvePoint<F::Evaluation>> {
        let metric = Metric::at(&corrected.position, self.parameter_scale);
        let direction = metric.unit(direction.clone());
        let tangent = tangent(&corrected.local, &metric, &direction)?;
        let turn = metric.inner(&tangent, &direction).clamp(-1.0, 1.0).acos();
        let turns_too_far = self.control.refuses(turn) && self.points > 0;
        if turns_too_far && !turns.is_corner(turn, self.length) {
            return None;
        }
        self.length = self.control.after(self.length, corrected.evaluations, turn);
        let segment = HermiteSegment::between(
            &metric,
            (&self.position, &direction),
            (&corrected.position, &tangent),
        );
        // The segment before a kink does not predict the curve beyond it.
        self.behind = (!turns_too_far).then_some(segment);
        self.position = corrected.position.clone();
        self.tangent = tangent.clone();
        self.points += 1;
        Some(CurvePoint {
            position: corrected.position,
            tangent,
            local: corrected.local,
            error: corrected.error,
        })
    }
}

impl<F: Problem> Iterator for Continuation<'_, F> {
    type Item = Result<CurvePoint<F::Evaluation>, ContinuationError<F::Error>>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let step = self.advance();
        self.ended = step.is_err();
        Some(step)
    }
}
