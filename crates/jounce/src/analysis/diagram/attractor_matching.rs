//! Attractors matched from one value of the key to the next.
//!
//! An attractor goes on where a march from it at the next value ends on an attractor of the same period from which a march back ends on
//! the first: both are one. One of the two marches is enough where the points of the section lie near each other, for over a coarse
//! step the other may leave the basin. Where a step leads away, the way between both values is gone in shorter and shorter ones, each of which
//! must end near where it begins and keep the period. Otherwise the first is lost and the second is new; each names the other end of its
//! march. An attractor that only such a march finds is counted as seen by no start.

use super::attractor_track::{AttractorTrack, TrackPoint, Transition};
use super::diagram_point::{DiagramPoint, SectionState};
use super::diagram_search::Diagram;
use crate::analysis::basins::wilson;
use crate::analysis::{AnalysisError, AttractorKind, SweepDirection};
use rayon::prelude::*;

/// Distance of two sections, beside their size, below which one march is enough.
const MAX_SINGLE_STEP_DISTANCE: f64 = 0.3;

/// Numbers of steps in which the way from one value to the next is gone where one step is too coarse.
const STEP_SUBDIVISIONS: [u32; 3] = [2, 4, 8];

/// What the visits from many starts have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct AttractorTracks {
    /// Attractors by first appearance.
    pub attractors: Vec<AttractorTrack>,
    /// For each visit, the place of its attractor in the list; `None` for a march that failed.
    pub homes: Vec<Option<usize>>,
}

/// Visits at one value that end on one attractor.
#[derive(Debug, Clone)]
struct VisitGroup {
    first: DiagramPoint,
    visits: Vec<usize>,
}

impl Diagram<'_> {
    /// Matches the attractors of visits from many starts along the key.
    ///
    /// # Errors
    /// A harvester that cannot be made.
    pub fn history(&self, visits: &[DiagramPoint]) -> Result<AttractorTracks, AnalysisError> {
        let mut history = AttractorTracks {
            attractors: Vec::new(),
            homes: vec![None; visits.len()],
        };
        let mut before: Vec<(VisitGroup, usize)> = Vec::new();
        for (step, value) in self.values.iter().enumerate() {
            let mut here = groups(visits, *value);
            let forward = self.followed(&before, *value)?;
            for (visit, _) in &forward {
                if visit.motion != AttractorKind::Lost
                    && !here.iter().any(|group| group.first.is_of(visit))
                {
                    here.push(VisitGroup {
                        first: visit.clone(),
                        visits: Vec::new(),
                    });
                }
            }
            let backward = match step {
                0 => Vec::new(),
                _ => self.reached(here.iter().map(|group| &group.first), self.values[step - 1])?,
            };
            let lands =
                |visit: &DiagramPoint| here.iter().position(|group| group.first.is_of(visit));
            let ahead: Vec<(Option<usize>, bool)> = forward
                .iter()
                .map(|(visit, bridged)| (lands(visit), *bridged))
                .collect();
            let comes = |visit: &DiagramPoint| {
                before
                    .iter()
                    .position(|(group, _)| group.first.is_of(visit))
            };
            let behind: Vec<Option<usize>> = backward.iter().map(comes).collect();
            let partners = partners(&before, &here, &ahead, &behind);
            let mut homes = Vec::with_capacity(here.len());
            for (j, group) in here.iter().enumerate() {
                let other = || {
                    behind
                        .get(j)
                        .copied()
                        .flatten()
                        .map(|i| history.attractors[before[i].1].id.clone())
                };
                let born = || {
                    (step > 0).then(|| Transition {
                        parameter: *value,
                        other: other(),
                    })
                };
                let known = partners
                    .iter()
                    .find(|(_, partner)| *partner == j)
                    .map(|(i, _)| before[*i].1);
                let born = if known.is_none() { born() } else { None };
                homes.push(known.unwrap_or_else(|| history.begin(&group.first, born)));
            }
            for (i, (_, home)) in before
                .iter()
                .enumerate()
                .filter(|(_, (_, home))| !homes.contains(home))
            {
                let other = ahead[i].0.map(|j| history.attractors[homes[j]].id.clone());
                history.attractors[*home].died = Some(Transition {
                    parameter: *value,
                    other,
                });
            }
            let of = visits
                .iter()
                .filter(|visit| visit.parameter == *value && visit.motion != AttractorKind::Lost)
                .count();
            here.iter()
                .zip(&homes)
                .for_each(|(group, home)| history.see(group, *home, of));
            before = here.into_iter().zip(homes).collect();
        }
        Ok(history)
    }

    /// Where attractors go at the next value, and whether shorter steps led there because a single one leads away.
    fn followed(
        &self,
        before: &[(VisitGroup, usize)],
        value: f64,
    ) -> Result<Vec<(DiagramPoint, bool)>, AnalysisError> {
        let follow = |(group, _): &(VisitGroup, usize)| {
            let at_once = self.bridge(&group.first, value, 1)?;
            if let Some(visit) = at_once.1 {
                return Ok((visit, false));
            }
            for steps in STEP_SUBDIVISIONS {
                if let (_, Some(visit)) = self.bridge(&group.first, value, steps)? {
                    return Ok((visit, true));
                }
            }
            Ok((at_once.0, false))
        };
        before.par_iter().map(follow).collect()
    }

    /// The way of an attractor to another value in so many steps: the last visit, and the same where no step leads away from it.
    fn bridge(
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
                    .apart(&next)
                    .is_none_or(|apart| apart >= MAX_SINGLE_STEP_DISTANCE)
            {
                return Ok((next, None));
            }
            last = next;
        }
        Ok((last.clone(), Some(last)))
    }

    /// Where marches at a value from the ends of other visits end.
    fn reached<'v>(
        &self,
        from: impl Iterator<Item = &'v DiagramPoint>,
        value: f64,
    ) -> Result<Vec<DiagramPoint>, AnalysisError> {
        let place = SectionState {
            index: 0,
            parameter: value,
            direction: SweepDirection::Independent,
            start: 0,
        };
        from.collect::<Vec<_>>()
            .into_par_iter()
            .map(|visit| self.visit(place, &visit.end))
            .collect()
    }
}

impl AttractorTracks {
    fn begin(&mut self, first: &DiagramPoint, born: Option<Transition>) -> usize {
        let id = AttractorTrack::name(&self.attractors, first);
        let (motion, period_cycles) = (first.motion, first.period_cycles);
        self.attractors.push(AttractorTrack {
            id,
            motion,
            period_cycles,
            born,
            died: None,
            seen: Vec::new(),
        });
        self.attractors.len() - 1
    }

    fn see(&mut self, group: &VisitGroup, home: usize, of: usize) {
        group
            .visits
            .iter()
            .for_each(|visit| self.homes[*visit] = Some(home));
        let share = wilson(group.visits.len(), of);
        self.attractors[home].seen.push(TrackPoint {
            parameter: group.first.parameter,
            mean_power_w: group.first.mean_power_w,
            contacts_per_period: group.first.contacts_per_period,
            fraction: share.fraction,
            fraction_low: share.low,
            fraction_high: share.high,
        });
    }
}

/// True for the same kind of motion with the same period.
fn alike(one: &DiagramPoint, other: &DiagramPoint) -> bool {
    one.motion == other.motion && one.period_cycles == other.period_cycles
}

/// Attractors before and here that are one, nearest first, each in one pair only.
fn partners(
    before: &[(VisitGroup, usize)],
    here: &[VisitGroup],
    ahead: &[(Option<usize>, bool)],
    behind: &[Option<usize>],
) -> Vec<(usize, usize)> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, (one, _)) in before.iter().enumerate() {
        for (j, two) in here.iter().enumerate() {
            let (lands, bridged) = (ahead[i].0 == Some(j), ahead[i].1);
            let apart = match (lands, behind.get(j) == Some(&Some(i))) {
                (true, true) => Some(0.0),
                (true, false) if bridged => Some(0.0),
                (true, false) | (false, true) => one
                    .first
                    .apart(&two.first)
                    .filter(|apart| *apart < MAX_SINGLE_STEP_DISTANCE),
                (false, false) => None,
            };
            pairs.extend(
                apart
                    .filter(|_| alike(&one.first, &two.first))
                    .map(|apart| (apart, i, j)),
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

/// Visits at a value by attractor, by period and falling power.
fn groups(visits: &[DiagramPoint], value: f64) -> Vec<VisitGroup> {
    let mut groups: Vec<VisitGroup> = Vec::new();
    let own = visits
        .iter()
        .enumerate()
        .filter(|(_, visit)| visit.parameter == value && visit.motion != AttractorKind::Lost);
    for (k, visit) in own {
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
