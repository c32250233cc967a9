//! The driver: an iterator over the points of a curve.

use super::corrector::CorrectedPoint;
use super::{
    ContinuationError, Corrector, Direction, HermiteSegment, Metric, Position, Problem,
    ResidualReport, StepControl, correct, tangent,
};

/// Distance from the curve, in goals of Newton, of a guess that polynomials through points within the goal give.
const KNOWN_DISTANCE: f64 = 10.0;

/// Share of the turn of the tangent on a step that is left on a shorter one where the curve is smooth: it goes with the length.
const CORNER_TURN_SHARE: f64 = 0.8;

/// Shorter steps on which the turn has stayed, at a corner.
const CORNER_STEPS: u32 = 4;

/// Length below which one is enough: the walk has come to it in many short steps.
const SHORT_STEP: f64 = 1e-5;

/// Turns that were refused, on shorter and shorter steps.
#[derive(Debug, Default)]
struct RefusedTurns {
    turn: f64,
    stayed: u32,
}

impl RefusedTurns {
    /// One more; true at a corner, as an orbit has where the edge of a contact whose force jumps passes the start of the period.
    fn is_corner(&mut self, turn: f64, length: f64) -> bool {
        self.stayed = if turn > CORNER_TURN_SHARE * self.turn {
            self.stayed + 1
        } else {
            0
        };
        self.turn = turn;
        // The first has stayed beside nothing.
        self.stayed > if length < SHORT_STEP { 1 } else { CORNER_STEPS }
    }
}

/// A point of a curve with its tangent.
#[derive(Debug)]
pub struct CurvePoint<L> {
    /// Where.
    pub position: Position,
    /// Unit tangent, in the direction of the walk.
    pub tangent: Direction,
    /// The problem there.
    pub local: L,
    /// Error of the place, in the metric.
    pub error: f64,
}

/// Where a walk stood, to go back to.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    position: Position,
    tangent: Direction,
    behind: Option<HermiteSegment>,
    length: f64,
}

impl Checkpoint {
    /// The tangent there, in the direction of the walk.
    pub fn tangent(&self) -> &Direction {
        &self.tangent
    }
}

/// A walk along a curve. All of its state is visible.
#[derive(Debug)]
pub struct Continuation<'f, F: Problem> {
    /// The problem.
    pub family: &'f F,
    /// Newton.
    pub corrector: Corrector,
    /// The law of the step.
    pub control: StepControl,
    /// Scale of the parameter.
    pub parameter_scale: f64,
    /// Last point.
    pub position: Position,
    /// Tangent there.
    pub tangent: Direction,
    /// The stretch that led there.
    pub behind: Option<HermiteSegment>,
    /// Length of the next step.
    pub length: f64,
    /// Points so far.
    pub points: usize,
    ended: bool,
}

impl<'f, F: Problem> Continuation<'f, F> {
    /// A walk from a point on the curve into a direction near its tangent.
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

    /// Where the walk stands now.
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

    /// Goes on as from a mark of a walk in another unknown, to which a linear map leads.
    pub fn resume(&mut self, mark: &Checkpoint, map: impl Fn(&[f64]) -> Vec<f64>) {
        self.behind = mark.behind.as_ref().map(|stretch| stretch.carried(&map));
        self.length = mark.length;
    }

    /// Goes back to a mark, to try a shorter step from there; false, and no change, when the step would be too short.
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
        let ahead = metric.unit(self.tangent.clone());
        let (mut last, mut refused) = ((f64::NAN, ResidualReport::default()), None);
        let mut turns = RefusedTurns::default();
        while self.length > self.control.shortest {
            let guess = match &self.behind {
                Some(stretch) => stretch.at(stretch.length + self.length),
                None => self.position.moved(&ahead, self.length),
            };
            match correct(self.family, &self.corrector, &metric, &ahead, guess.clone()) {
                Ok(found) => {
                    // A place is known to Newton's goal, and so is a guess from places.
                    let way = metric.length(&guess.to(&found.position))
                        - KNOWN_DISTANCE * self.corrector.goal;
                    if self.behind.is_some()
                        && self.control.strayed(way, self.length, found.evaluations)
                    {
                        last = (found.error, ResidualReport::default());
                    } else if let Some(step) = self.take(found, &ahead, &mut turns) {
                        return Ok(step);
                    }
                }
                Err(ContinuationError::Diverged { error, left, .. }) => last = (error, left),
                // A step may lead where the problem has no meaning, though the curve does not: a shorter one need not.
                Err(ContinuationError::Family(error)) => refused = Some(error),
                Err(ContinuationError::Singular { .. } | ContinuationError::Stuck { .. }) => {}
            }
            self.length = self.control.shorter(self.length);
        }
        if let Some(error) = refused {
            return Err(ContinuationError::Family(error));
        }
        let (error, left) = last;
        Err(ContinuationError::Stuck {
            parameter: self.position.parameter,
            step: self.length,
            error,
            left,
        })
    }

    /// Takes a corrected point, unless the curve turned too far on the way and may be lost.
    fn take(
        &mut self,
        found: CorrectedPoint<F::Evaluation>,
        ahead: &Direction,
        turns: &mut RefusedTurns,
    ) -> Option<CurvePoint<F::Evaluation>> {
        let metric = Metric::at(&found.position, self.parameter_scale);
        let ahead = metric.unit(ahead.clone());
        let tangent = tangent(&found.local, &metric, &ahead)?;
        let turn = metric.inner(&tangent, &ahead).clamp(-1.0, 1.0).acos();
        let turned = self.control.refuses(turn) && self.points > 0;
        if turned && !turns.is_corner(turn, self.length) {
            return None;
        }
        self.length = self.control.after(self.length, found.evaluations, turn);
        let stretch = HermiteSegment::between(
            &metric,
            (&self.position, &ahead),
            (&found.position, &tangent),
        );
        // What lies behind a corner says nothing of what lies ahead.
        self.behind = (!turned).then_some(stretch);
        self.position = found.position.clone();
        self.tangent = tangent.clone();
        self.points += 1;
        Some(CurvePoint {
            position: found.position,
            tangent,
            local: found.local,
            error: found.error,
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
