//! Matching of attractors between successive values of the key.
//!
//! Two attractors at successive values match if an integration from each one, at the value of the
//! other, ends on the other with the same period. One of the two integrations is enough where their
//! Poincare sections are close, since a coarse step can leave the basin. Where one step fails, the
//! interval is divided into more and more steps; each must end close to its start and preserve the
//! period. Otherwise the first attractor ends and the second begins, and each names the attractor
//! that its integration reached. An attractor found only by such an integration has a fraction of
//! 0.

use super::attractor_track::{AttractorTrack, TrackPoint, Transition};
use super::diagram_point::{DiagramPoint, SectionState};
use super::diagram_search::Diagram;
use crate::basins::wilson;
use crate::{AnalysisError, AttractorKind, SweepDirection};
use rayon::prelude::*;

/// Distance of two sections relative to their size, below which one integration is enough.
const MAX_SINGLE_STEP_DISTANCE: f64 = 0.3;

/// Numbers of steps between two values where one step is too coarse.
const STEP_SUBDIVISIONS: [u32; 3] = [2, 4, 8];

/// Attractors tracked over all points of a diagram from many starts.
#[derive(Debug, Clone, PartialEq)]
pub struct AttractorTracks {
    /// Attractors by first appearance.
    pub attractors: Vec<AttractorTrack>,
    /// For each point, the index of its attractor in the list; `None` for an integration that
    /// failed.
    pub homes: Vec<Option<usize>>,
}

/// Points at one value that end on one attractor.
#[derive(Debug, Clone)]
struct VisitGroup {
    first: DiagramPoint,
    visits: Vec<usize>,
}

impl Diagram<'_> {
    /// Matches the attractors of points from many starts along the key.
    ///
    /// # Errors
    /// A model cannot be built.
    pub fn history(&self, visits: &[DiagramPoint]) -> Result<AttractorTracks, AnalysisError> {
        let mut history = AttractorTracks {
            attractors: Vec::new(),
            homes: vec![None; visits.len()],
        };
        let mut before: Vec<(VisitGroup, usize)> = Vec::new();
        for (step, value) in self.values.iter().enumerate() {
            let mut current = groups(visits, *value);
            let forward = self.continued(&before, *value)?;
            add_reached(&mut current, &forward);
            let backward = match step {
                0 => Vec::new(),
                _ => self.reached(
                    current.iter().map(|group| &group.first),
                    self.values[step - 1],
                )?,
            };
            let lands =
                |visit: &DiagramPoint| current.iter().position(|group| group.first.is_of(visit));
            let next_groups: Vec<(Option<usize>, bool)> = forward
                .iter()
                .map(|(visit, bridged)| (lands(visit), *bridged))
                .collect();
            let comes = |visit: &DiagramPoint| {
                before
                    .iter()
                    .position(|(group, _)| group.first.is_of(visit))
            };
            let behind: Vec<Option<usize>> = backward.iter().map(comes).collect();
            let partners = partners(&before, &current, &next_groups, &behind);
            let mut homes = Vec::with_capacity(current.len());
            for (j, group) in current.iter().enumerate() {
                let known = partners
                    .iter()
                    .find(|(_, partner)| *partner == j)
                    .map(|(i, _)| before[*i].1);
                let from = behind.get(j).copied().flatten().map(|i| before[i].1);
                let birth = (known.is_none() && step > 0).then(|| Transition {
                    parameter: *value,
                    other: from.map(|track| history.attractors[track].id.clone()),
                });
                homes.push(known.unwrap_or_else(|| history.start_track(&group.first, birth)));
            }
            for (i, (_, track)) in before.iter().enumerate() {
                if !homes.contains(track) {
                    history.end_track(*track, *value, next_groups[i].0.map(|j| homes[j]));
                }
            }
            let of = visits
                .iter()
                .filter(|visit| visit.parameter == *value && visit.motion != AttractorKind::Lost)
                .count();
            current
                .iter()
                .zip(&homes)
                .for_each(|(group, track)| history.record(group, *track, of));
            before = current.into_iter().zip(homes).collect();
        }
        Ok(history)
    }

    /// Returns where attractors lead at the next value, and true where that took shorter steps
    /// because a single one failed.
    fn continued(
        &self,
        before: &[(VisitGroup, usize)],
        value: f64,
    ) -> Result<Vec<(DiagramPoint, bool)>, AnalysisError> {
        let follow = |(group, _): &(VisitGroup, usize)| {
            let direct_bridge = self.continue_attractor(&group.first, value, 1)?;
            if let Some(visit) = direct_bridge.1 {
                return Ok((visit, false));
            }
            for steps in STEP_SUBDIVISIONS {
                if let (_, Some(visit)) = self.continue_attractor(&group.first, value, steps)? {
                    return Ok((visit, true));
                }
            }
            Ok((direct_bridge.0, false))
        };
        before.par_iter().map(follow).collect()
    }

    /// Follows an attractor to another value in `steps` steps. Returns the last point, and again
    /// the last point if every step stayed close.
    fn continue_attractor(
        &self,
        from: &DiagramPoint,
        value: f64,
        steps: u32,
    ) -> Result<(DiagramPoint, Option<DiagramPoint>), AnalysisError> {
        let mut last = from.clone();
        for step in 1..=steps {
            let parameter =
                from.parameter + (value - from.parameter) * f64::from(step) / f64::from(steps);
            let next = self.visit(
                SectionState {
                    index: 0,
                    parameter,
                    direction: SweepDirection::Independent,
                    start: 0,
                },
                &last.end,
            )?;
            if !alike(&last, &next)
                || last
                    .distance(&next)
                    .is_none_or(|distance| distance >= MAX_SINGLE_STEP_DISTANCE)
            {
                return Ok((next, None));
            }
            last = next;
        }
        Ok((last.clone(), Some(last)))
    }

    /// Returns the end points of integrations at a value from the ends of other points.
    fn reached<'v>(
        &self,
        from: impl Iterator<Item = &'v DiagramPoint>,
        value: f64,
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let state = SectionState {
            index: 0,
            parameter: value,
            direction: SweepDirection::Independent,
            start: 0,
        };
        from.collect::<Vec<_>>()
            .into_par_iter()
            .map(|visit| self.visit(state, &visit.end))
            .collect()
    }
}

impl AttractorTracks {
    fn start_track(&mut self, first: &DiagramPoint, birth: Option<Transition>) -> usize {
        let id = AttractorTrack::name(&self.attractors, first);
        let (motion, period_cycles) = (first.motion, first.period_cycles);
        self.attractors.push(AttractorTrack {
            id,
            motion,
            period_cycles,
            born: birth,
            died: None,
            seen: Vec::new(),
        });
        self.attractors.len() - 1
    }

    /// Ends a track at a value where its attractor is missing; `other` is the track on which the
    /// integration from it ended.
    fn end_track(&mut self, track: usize, parameter: f64, other: Option<usize>) {
        let other = other.map(|other| self.attractors[other].id.clone());
        self.attractors[track].died = Some(Transition { parameter, other });
    }

    fn record(&mut self, group: &VisitGroup, track: usize, of: usize) {
        group
            .visits
            .iter()
            .for_each(|visit| self.homes[*visit] = Some(track));
        let share = wilson(group.visits.len(), of);
        self.attractors[track].seen.push(TrackPoint {
            parameter: group.first.parameter,
            mean_power_w: group.first.mean_power_w,
            contacts_per_period: group.first.contacts_per_period,
            fraction: share.fraction,
            fraction_low: share.low,
            fraction_high: share.high,
        });
    }
}

/// Adds the attractors that only the integrations from the previous value reach.
fn add_reached(current: &mut Vec<VisitGroup>, forward: &[(DiagramPoint, bool)]) {
    for (visit, _) in forward {
        if visit.motion != AttractorKind::Lost
            && !current.iter().any(|group| group.first.is_of(visit))
        {
            current.push(VisitGroup {
                first: visit.clone(),
                visits: Vec::new(),
            });
        }
    }
}

/// True for attractors of one kind and period.
fn alike(one: &DiagramPoint, other: &DiagramPoint) -> bool {
    one.motion == other.motion && one.period_cycles == other.period_cycles
}

/// Returns the matching pairs of attractors before and here, nearest first; each attractor is in
/// one pair at most.
fn partners(
    before: &[(VisitGroup, usize)],
    current: &[VisitGroup],
    next_groups: &[(Option<usize>, bool)],
    behind: &[Option<usize>],
) -> Vec<(usize, usize)> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, (one, _)) in before.iter().enumerate() {
        for (j, two) in current.iter().enumerate() {
            let (lands, bridged) = (next_groups[i].0 == Some(j), next_groups[i].1);
            let distance = match (lands, behind.get(j) == Some(&Some(i))) {
                (true, true) => Some(0.0),
                (true, false) if bridged => Some(0.0),
                (true, false) | (false, true) => one
                    .first
                    .distance(&two.first)
                    .filter(|distance| *distance < MAX_SINGLE_STEP_DISTANCE),
                (false, false) => None,
            };
            pairs.extend(
                distance
                    .filter(|_| alike(&one.first, &two.first))
                    .map(|distance| (distance, i, j)),
            );
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut chosen: Vec<(usize, usize)> = Vec::new();
    for (_, i, j) in pairs {
        if !chosen.iter().any(|(a, b)| *a == i || *b == j) {
            chosen.push((i, j));
        }
    }
    chosen
}

/// Groups the points at a value by attractor, sorted by period and falling power.
fn groups(visits: &[DiagramPoint], value: f64) -> Vec<VisitGroup> {
    let mut groups: Vec<VisitGroup> = Vec::new();
    let at_value = visits
        .iter()
        .enumerate()
        .filter(|(_, visit)| visit.parameter == value && visit.motion != AttractorKind::Lost);
    for (k, visit) in at_value {
        match groups.iter_mut().find(|group| group.first.is_of(visit)) {
            Some(group) => group.visits.push(k),
            None => groups.push(VisitGroup {
                first: visit.clone(),
                visits: vec![k],
            }),
        }
    }
    groups.sort_by(|a, b| {
        (a.first.period_cycles.cmp(&b.first.period_cycles))
            .then(b.first.mean_power_w.total_cmp(&a.first.mean_power_w))
    });
    groups
}
