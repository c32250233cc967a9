//! Attractors matched from one value of the key to the next.
//!
//! An attractor goes on where a march from it at the next value ends on an attractor of the same period from which a march back ends on
//! the first: both are one. One of the two marches is enough where the points of the section lie near each other, for over a coarse
//! step the other may leave the basin. Otherwise the first is lost and the second is new; each names the other end of its march. An
//! attractor that only such a march finds is counted as seen by no start.

use super::lineage::{Lineage, Seen, Turn};
use super::march::Diagram;
use super::visit::{Motion, Place, Visit};
use crate::study::{StudyError, Way};
use rayon::prelude::*;

/// Distance of two sections, beside their size, below which one march is enough.
const NEAR: f64 = 0.3;

/// What the visits from many starts have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Attractors by first appearance.
    pub attractors: Vec<Lineage>,
    /// For each visit, the place of its attractor in the list; `None` for a march that failed.
    pub homes: Vec<Option<usize>>,
}

/// Visits at one value that end on one attractor.
#[derive(Debug, Clone)]
struct Group {
    first: Visit,
    visits: Vec<usize>,
}

impl Diagram<'_> {
    /// Matches the attractors of visits from many starts along the key.
    ///
    /// # Errors
    /// A harvester that cannot be made.
    pub fn history(&self, visits: &[Visit]) -> Result<History, StudyError> {
        let mut history = History { attractors: Vec::new(), homes: vec![None; visits.len()] };
        let mut before: Vec<(Group, usize)> = Vec::new();
        for (step, value) in self.values.iter().enumerate() {
            let mut here = groups(visits, *value);
            let forward = self.reached(before.iter().map(|(group, _)| &group.first), *value)?;
            for visit in &forward {
                if visit.motion != Motion::Lost && !here.iter().any(|group| group.first.is_of(visit)) {
                    here.push(Group { first: visit.clone(), visits: Vec::new() });
                }
            }
            let backward = match step {
                0 => Vec::new(),
                _ => self.reached(here.iter().map(|group| &group.first), self.values[step - 1])?,
            };
            let lands = |visit: &Visit| here.iter().position(|group| group.first.is_of(visit));
            let ahead: Vec<Option<usize>> = forward.iter().map(lands).collect();
            let comes = |visit: &Visit| before.iter().position(|(group, _)| group.first.is_of(visit));
            let behind: Vec<Option<usize>> = backward.iter().map(comes).collect();
            let partners = partners(&before, &here, &ahead, &behind);
            let mut homes = Vec::with_capacity(here.len());
            for (j, group) in here.iter().enumerate() {
                let other = || behind.get(j).copied().flatten().map(|i| history.attractors[before[i].1].id.clone());
                let born = || (step > 0).then(|| Turn { parameter: *value, other: other() });
                let known = partners.iter().find(|(_, partner)| *partner == j).map(|(i, _)| before[*i].1);
                let born = if known.is_none() { born() } else { None };
                homes.push(known.unwrap_or_else(|| history.begin(&group.first, born)));
            }
            for (i, (_, home)) in before.iter().enumerate().filter(|(_, (_, home))| !homes.contains(home)) {
                let other = ahead[i].map(|j| history.attractors[homes[j]].id.clone());
                history.attractors[*home].died = Some(Turn { parameter: *value, other });
            }
            let of = visits.iter().filter(|visit| visit.parameter == *value).count();
            here.iter().zip(&homes).for_each(|(group, home)| history.see(group, *home, of));
            before = here.into_iter().zip(homes).collect();
        }
        Ok(history)
    }

    /// Where marches at a value from the ends of other visits end.
    fn reached<'v>(&self, from: impl Iterator<Item = &'v Visit>, value: f64) -> Result<Vec<Visit>, StudyError> {
        let place = Place { index: 0, parameter: value, direction: Way::Independent, start: 0 };
        from.collect::<Vec<_>>().into_par_iter().map(|visit| self.visit(place, &visit.end)).collect()
    }
}

impl History {
    fn begin(&mut self, first: &Visit, born: Option<Turn>) -> usize {
        let id = Lineage::name(&self.attractors, first);
        let (motion, period_cycles) = (first.motion, first.period_cycles);
        self.attractors.push(Lineage { id, motion, period_cycles, born, died: None, seen: Vec::new() });
        self.attractors.len() - 1
    }

    fn see(&mut self, group: &Group, home: usize, of: usize) {
        group.visits.iter().for_each(|visit| self.homes[*visit] = Some(home));
        self.attractors[home].seen.push(Seen {
            parameter: group.first.parameter,
            mean_power_w: group.first.mean_power_w,
            contacts_per_period: group.first.contacts_per_period,
            fraction: group.visits.len() as f64 / of.max(1) as f64,
        });
    }
}

/// Attractors before and here that are one, nearest first, each in one pair only.
fn partners(before: &[(Group, usize)], here: &[Group], ahead: &[Option<usize>], behind: &[Option<usize>]) -> Vec<(usize, usize)> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (i, (one, _)) in before.iter().enumerate() {
        for (j, two) in here.iter().enumerate() {
            let alike = one.first.motion == two.first.motion && one.first.period_cycles == two.first.period_cycles;
            let apart = match (ahead[i] == Some(j), behind.get(j) == Some(&Some(i))) {
                (true, true) => Some(0.0),
                (true, false) | (false, true) => one.first.apart(&two.first).filter(|apart| *apart < NEAR),
                (false, false) => None,
            };
            pairs.extend(apart.filter(|_| alike).map(|apart| (apart, i, j)));
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
fn groups(visits: &[Visit], value: f64) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let own = visits.iter().enumerate().filter(|(_, visit)| visit.parameter == value && visit.motion != Motion::Lost);
    for (k, visit) in own {
        match groups.iter_mut().find(|group| group.first.is_of(visit)) {
            Some(group) => group.visits.push(k),
            None => groups.push(Group { first: visit.clone(), visits: vec![k] }),
        }
    }
    groups.sort_by(|a, b| (a.first.period_cycles.cmp(&b.first.period_cycles)).then(b.first.mean_power_w.total_cmp(&a.first.mean_power_w)));
    groups
}
