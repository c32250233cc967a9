//! Follows one branch from one of its orbits, and names what it passes.

use super::branch::{Bifurcation, Branch, BranchKind, BranchPoint, Ending};
use super::finer::SPARE;
use super::free::Left;
use crate::continuation::{
    Corrected, Corrector, Direction, Mark, Metric, Position, Step, StepControl, Walk, locate, passes, settle, tangent,
};
use crate::orbit::{Orbit, OrbitMethod, determinant_at, multipliers, nearest_pair_to_circle, pairs_outside};

/// Distance from the stop, beside the size of the motion, below which an orbit touches it.
const GRAZES: f64 = 1e-6;

/// Length in the metric to which a bifurcation is located, where nothing else is asked.
pub(super) const RESOLUTION: f64 = 1e-8;

/// Distance from an end of the range, beside its width, at which a branch that goes there has come to it: steps are relative to the size
/// of the answer, so that none of them would reach a drive of amplitude zero.
const AT_EDGE: f64 = 1e-9;

/// How branches are followed.
#[derive(Debug, Clone, Copy)]
pub struct Following {
    /// Ends of the range of the key.
    pub range: (f64, f64),
    /// Newton's goal.
    pub corrector: Corrector,
    /// The law of the step.
    pub control: StepControl,
    /// Most points.
    pub most_points: usize,
    /// Length in the metric to which bifurcations are located.
    pub resolution: f64,
}

/// A walked point with its orbit.
pub(super) struct Place<M: OrbitMethod> {
    pub step: Step<M::Local>,
    pub point: BranchPoint,
}

impl<M: OrbitMethod> Place<M> {
    /// Computes the orbit at a step.
    pub fn new(method: &M, step: Step<M::Local>) -> Result<Self, M::Error> {
        Ok(Self { point: point(method, &step)?, step })
    }
}

impl Following {
    /// Scale of the parameter in the metric.
    pub fn parameter_scale(&self) -> f64 {
        (self.range.1 - self.range.0) / 20.0
    }

    /// Walks both ways from the orbit that Newton finds near a state in energy coordinates; nothing where it finds none.
    ///
    /// # Errors
    /// As [`Following::walk`].
    pub(super) fn both_ways<M: OrbitMethod>(&self, method: &M, state: &[f64], parameter: f64) -> Result<Option<Branch>, M::Error> {
        let position = Position { unknown: method.unknown_of(state, parameter)?, parameter };
        let metric = Metric::at(&position, self.parameter_scale());
        let up = Direction { unknown: vec![0.0; position.unknown.len()], parameter: 1.0 };
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let at_edge = parameter == if sign < 0.0 { self.range.0 } else { self.range.1 };
            let Ok(first) = settle(method, &self.corrector, &metric, position.clone()) else { return Ok(None) };
            let Some(mut ahead) = tangent(&first.local, &metric, &up) else { return Ok(None) };
            ahead.unknown.iter_mut().for_each(|d| *d *= sign);
            ahead.parameter *= sign;
            let closed = ways.last().is_some_and(|way: &Branch| way.endings.contains(&Ending::Closed));
            if !at_edge && !closed {
                ways.push(self.walk(method, first, ahead)?);
            }
        }
        let mut ways = ways.into_iter();
        Ok(match (ways.next(), ways.next()) {
            (Some(down), Some(up)) => Some(down.joined(up)),
            (one, _) => one,
        })
    }

    /// Walks from an orbit in a direction until the branch ends.
    ///
    /// # Errors
    /// An orbit whose multipliers cannot be computed, or a harvester that cannot be made.
    pub fn walk<M: OrbitMethod>(&self, method: &M, first: Corrected<M::Local>, direction: Direction) -> Result<Branch, M::Error> {
        let metric = Metric::at(&first.position, self.parameter_scale());
        let tangent = metric.unit(direction);
        let sense = tangent.parameter;
        let start = Step { position: first.position, tangent, local: first.local, error: first.error };
        let mut branch = Branch { period_cycles: method.cycles(), ..Branch::default() };
        if let Some((finer, start)) = self.finer(method, &start, &start)? {
            branch.points.push(point(&finer, &start)?);
            let beginning = Beginning::of(&finer, &branch.points[0], sense)?;
            self.walk_on(&finer, start, (beginning, None), &mut branch)?;
        } else {
            branch.points.push(point(method, &start)?);
            let beginning = Beginning::of(method, &branch.points[0], sense)?;
            self.walk_on(method, start, (beginning, None), &mut branch)?;
        }
        Ok(branch)
    }

    /// Walks on from the last point of a branch, as the walk did that made the mark.
    fn walk_on<M: OrbitMethod>(
        &self,
        method: &M,
        start: Step<M::Local>,
        (mut beginning, mark): (Beginning, Option<Mark>),
        branch: &mut Branch,
    ) -> Result<(), M::Error> {
        let (position, tangent) = (start.position.clone(), start.tangent.clone());
        let mut before = Place::new(method, start)?;
        if let Some(mark) = &mark {
            add_passed(mark.tangent().parameter * tangent.parameter < 0.0, &before.point, branch);
        }
        let mut walk = Walk::new(method, self.corrector, self.control, self.parameter_scale(), position, tangent);
        if let Some(mark) = mark {
            walk.resume(&mark, |unknown| method.carried(unknown));
        }
        let (mut mark, mut spare) = (walk.mark(), SPARE);
        while let Some(next) = walk.next() {
            let step = match next {
                Ok(step) => step,
                // Beyond the range a key may have no meaning at all.
                Err(error) => return self.give_up(method, before, error.to_string(), branch),
            };
            if self.leaves_range(method, &before, &step, branch)? {
                return Ok(());
            }
            let step = self.polished(method, step)?;
            if let Some((finer, start)) = self.finer(method, &step, &before.step)? {
                return self.walk_on(&finer, start, (beginning.carried(&finer), Some(mark)), branch);
            }
            let after = Place::new(method, step)?;
            let places = self.refined(method, &before, after)?;
            if places.iter().any(|place| place.point.orbit.repeats_early()) {
                // Newton may have strayed to an orbit of fewer cycles; if a short step gets there too, the branch ends on it.
                if walk.retreat(mark.clone()) {
                    continue;
                }
                branch.endings.push(Ending::Merged);
                return Ok(());
            }
            for after in places {
                beginning.left = Left::between(&before.point, &after.point, branch).or(beginning.left);
                branch.bifurcations.extend(self.between(method, &before, &after)?);
                branch.points.push(after.point.clone());
                if let Some((left, back_at)) = beginning.left.and_then(|left| Some((left, left.comes_back(branch)?))) {
                    left.end(branch, back_at);
                    return Ok(());
                }
                if let Some(ending) = self.ending(&beginning, &before, &after, branch.points.len()) {
                    branch.endings.push(ending);
                    return Ok(());
                }
                before = after;
            }
            mark = walk.mark();
            if let Some((coarser, start)) = self.coarser(method, &before.step, &mut spare)? {
                return self.walk_on(&coarser, start, (beginning.carried(&coarser), Some(mark)), branch);
            }
        }
        Ok(())
    }

    /// Ends a branch whose walk has come to the end of the range.
    fn leaves_range<M: OrbitMethod>(
        &self,
        method: &M,
        before: &Place<M>,
        step: &Step<M::Local>,
        branch: &mut Branch,
    ) -> Result<bool, M::Error> {
        if step.position.parameter < self.range.0 || step.position.parameter > self.range.1 {
            self.cut(method, before, step, branch)?;
        } else if self.is_at_edge(&step.position, &step.tangent) {
            branch.points.push(point(method, step)?);
        } else {
            return Ok(false);
        }
        branch.endings.push(Ending::Range);
        Ok(true)
    }

    /// True where a walk in a direction has come as near to the end of the range as matters.
    fn is_at_edge(&self, position: &Position, tangent: &Direction) -> bool {
        let edge = if tangent.parameter < 0.0 { self.range.0 } else { self.range.1 };
        (position.parameter - edge).abs() < AT_EDGE * (self.range.1 - self.range.0)
    }

    /// Ends a branch that cannot be followed: at a grazing where the orbit touches the stop there, for on a stiff stop a branch turns
    /// at its grazing more sharply than any step can follow.
    fn give_up<M: OrbitMethod>(&self, method: &M, last: Place<M>, why: String, branch: &mut Branch) -> Result<(), M::Error> {
        let distance_m = method.nearest_extremum_m(&last.step.local)?.map_or(f64::INFINITY, f64::abs);
        let parameter = last.point.parameter;
        if distance_m < GRAZES * method.scale_m(&last.step.local) {
            branch.bifurcations.push(Bifurcation { kind: BranchKind::Grazing, at: last.point });
            branch.endings.push(Ending::Grazing { why, parameter });
        } else {
            branch.endings.push(Ending::Failed { why, parameter });
        }
        Ok(())
    }

    /// The last point, exactly on the edge of the range.
    fn cut<M: OrbitMethod>(&self, method: &M, before: &Place<M>, outside: &Step<M::Local>, branch: &mut Branch) -> Result<(), M::Error> {
        let edge = if outside.position.parameter < self.range.0 { self.range.0 } else { self.range.1 };
        let from = &before.step.position;
        let t = (edge - from.parameter) / (outside.position.parameter - from.parameter);
        let unknown = from.unknown.iter().zip(&outside.position.unknown).map(|(a, b)| a + t * (b - a)).collect();
        let guess = Position { unknown, parameter: edge };
        let metric = Metric::at(&guess, self.parameter_scale());
        if let Ok(found) = settle(method, &self.corrector, &metric, guess) {
            let step = Step { position: found.position, tangent: outside.tangent.clone(), local: found.local, error: found.error };
            let after = Place::new(method, step)?;
            branch.bifurcations.extend(self.between(method, before, &after)?);
            branch.points.push(after.point);
        }
        Ok(())
    }

    fn ending<M: OrbitMethod>(&self, beginning: &Beginning, before: &Place<M>, after: &Place<M>, points: usize) -> Option<Ending> {
        let metric = Metric::at(&after.step.position, self.parameter_scale());
        // Another sheet of the curve may pass near by, in the other sense.
        let goes_alike = beginning.sense * after.step.tangent.parameter > 0.0;
        let closes = |origin| passes(&metric, origin, &before.step.position, &after.step.position);
        if points > 4 && goes_alike && beginning.origins.iter().any(closes) {
            return Some(Ending::Closed);
        }
        // The halves of a doubled orbit pass through each other where it merges with the branch that it left.
        if let (Some(a), Some(b)) = (before.point.orbit.halves_apart(), after.point.orbit.halves_apart()) {
            let product: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
            if product < 0.0 && points > 3 {
                return Some(Ending::Merged);
            }
        }
        (points >= self.most_points).then_some(Ending::Points)
    }

    /// Everything that happens between two points.
    pub(super) fn between<M: OrbitMethod>(&self, method: &M, a: &Place<M>, b: &Place<M>) -> Result<Vec<Bifurcation>, M::Error> {
        let (one, two) = (&a.point.orbit, &b.point.orbit);
        let turns = a.step.tangent.parameter * b.step.tangent.parameter < 0.0;
        let mut found = Vec::new();
        for kind in kinds(one, two, turns) {
            let value = |step: &Step<M::Local>| test(method, kind, step, one, two);
            let place = locate(method, &self.corrector, self.parameter_scale(), (&a.step, &b.step), self.resolution, value);
            let Some(place) = place else { continue };
            let at = point(method, &place)?;
            // Two real multipliers that meet outside the circle are no torus.
            let on_circle = at.orbit.multipliers.iter().any(|value| value.im > 1e-9 && (value.norm() - 1.0).abs() < 1e-4);
            if kind != BranchKind::NeimarkSacker || on_circle {
                found.push(Bifurcation { kind, at });
            }
        }
        let forward = b.step.position.parameter >= a.step.position.parameter;
        found.sort_by(|x, y| if forward { x.at.parameter.total_cmp(&y.at.parameter) } else { y.at.parameter.total_cmp(&x.at.parameter) });
        Ok(found)
    }
}

/// How a walk began.
struct Beginning {
    /// The first orbit, looked at in each of its drive cycles: a branch closes where it comes back to any of them.
    origins: Vec<Position>,
    /// Sense of the parameter.
    sense: f64,
    /// Where the walk left the orbits that never touch.
    left: Option<Left>,
}

impl Beginning {
    fn of<M: OrbitMethod>(method: &M, first: &BranchPoint, sense: f64) -> Result<Self, M::Error> {
        let cycles = first.orbit.period_cycles as usize;
        let looks = first.orbit.looks.iter().take(cycles);
        let origin = |look: &Vec<f64>| Ok(Position { unknown: method.unknown_of(look, first.parameter)?, parameter: first.parameter });
        Ok(Self { origins: looks.map(origin).collect::<Result<_, M::Error>>()?, sense, left: None })
    }

    /// In the unknown of another method.
    fn carried<M: OrbitMethod>(self, method: &M) -> Self {
        let carried = |origin: Position| Position { unknown: method.carried(&origin.unknown), ..origin };
        Self { origins: self.origins.into_iter().map(carried).collect(), ..self }
    }
}

/// What must lie between two orbits of a branch that turns between them, or does not.
/// Adds what was passed between the last point of a branch and another one: where a bifurcation lies nearer than the accuracy, the other
/// method may have the place on its other side.
fn add_passed(turns: bool, at: &BranchPoint, branch: &mut Branch) {
    let Some(last) = branch.points.last() else { return };
    let passed = kinds(&last.orbit, &at.orbit, turns);
    branch.bifurcations.extend(passed.into_iter().map(|kind| Bifurcation { kind, at: at.clone() }));
}

fn kinds(one: &Orbit, two: &Orbit, turns: bool) -> Vec<BranchKind> {
    let passes = |s: f64| one.determinant_at(s) * two.determinant_at(s) < 0.0;
    let found = [
        (BranchKind::Fold, turns),
        (BranchKind::BranchPoint, passes(1.0) != turns),
        (BranchKind::PeriodDoubling, passes(-1.0)),
        (BranchKind::NeimarkSacker, one.pairs_outside() != two.pairs_outside()),
        (BranchKind::Grazing, one.contacts != two.contacts),
    ];
    found.into_iter().filter(|(_, is_there)| *is_there).map(|(kind, _)| kind).collect()
}

fn point<M: OrbitMethod>(method: &M, step: &Step<M::Local>) -> Result<BranchPoint, M::Error> {
    let orbit = method.orbit(&step.local, step.error)?;
    Ok(BranchPoint { parameter: step.position.parameter, orbit })
}

/// The function of the curve that is zero at a bifurcation, for two points on its two sides.
fn test<M: OrbitMethod>(method: &M, kind: BranchKind, step: &Step<M::Local>, before: &Orbit, after: &Orbit) -> f64 {
    if kind == BranchKind::Fold {
        return step.tangent.parameter;
    }
    if kind == BranchKind::Grazing {
        let fewer = before.contacts.min(after.contacts);
        let distance = method.nearest_extremum_m(&step.local).ok().flatten().map_or(0.0, f64::abs);
        return if method.contacts(&step.local).is_ok_and(|contacts| contacts <= fewer) { -distance } else { distance };
    }
    let Ok(map) = method.map(&step.local) else { return 0.0 };
    match kind {
        BranchKind::PeriodDoubling => determinant_at(map, -1.0),
        BranchKind::NeimarkSacker => {
            // The count decides on the sign: where real multipliers meet on the way, that of any product says nothing.
            let Some(values) = multipliers(map) else { return 0.0 };
            let distance = nearest_pair_to_circle(&values);
            if pairs_outside(&values) == before.pairs_outside() { -distance } else { distance }
        }
        _ => determinant_at(map, 1.0) * step.tangent.parameter.signum(),
    }
}
