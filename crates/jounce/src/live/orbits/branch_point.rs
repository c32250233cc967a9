//! Point of a response whose orbit is a given one. Two orbits of one power are distinguished, because
//! the motion at the given value of the key is computed and compared.

use super::attractor_place::AttractorPlace;
use super::branch_place::{BranchPlace, corrected, own_orbit, rescaled};
use super::orbit::TOLERANCE;
use super::orbit_identity::{OrbitIdentity, size};
use crate::error::Error;
use crate::live::LiveAnalysis;
use crate::live::responses::StoredResponse;
use jounce_analysis::{Bifurcation, Branch, Parameter, SectionPoint};
use jounce_control::Control;
use jounce_linalg::distance;
use jounce_orbits::{Orbit, ParametricModel, Shooting, ShootingEvaluation};
use serde::{Deserialize, Serialize};

/// Part of its length by which a line between two points of a branch is extended at both ends: at
/// a fold the branch turns beyond its last point.
const EXTENSION: f64 = 0.5;

/// Largest number of lines from which the orbit is computed: the nearest ones.
const MAX_LINES: usize = 6;

/// Distance below which a motion is that of an identity: it is written with six digits.
const SAME_DISTANCE: f64 = 1e-4;

/// The same at a bifurcation, where the state is known only as well as the root of the error of the key.
const SAME_BIFURCATION_DISTANCE: f64 = 1e-2;

/// An orbit that is sought on the branches of a response.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum SoughtOrbit {
    /// That of a stored attractor.
    Attractor(AttractorPlace),
    /// The one of an identity.
    Identified(OrbitIdentity),
}

/// A line of a branch next to a value of the key.
struct BranchLine {
    place: BranchPlace,
    /// State on the line at that value, near the start of the orbit there.
    start: Vec<f64>,
}

impl LiveAnalysis {
    /// Returns the point of a stored response next to a given orbit of the same design, with the
    /// value of the key of the orbit; `None` where no branch is proved to have it. The motion is
    /// compared, not the power.
    ///
    /// # Errors
    /// [`Error::Option`] for a response or an attractor that is no longer stored.
    pub fn branch_point(
        &self,
        response: u64,
        sought: &SoughtOrbit,
        control: &Control,
    ) -> Result<Option<BranchPlace>, Error> {
        match sought {
            SoughtOrbit::Attractor(place) => self.point_of_attractor(response, place, control),
            SoughtOrbit::Identified(own) => match &own.bifurcation {
                Some(kind) => self.bifurcation_of_identity(response, own, kind, control),
                None => self.point_of_identity(response, own, control),
            },
        }
    }

    fn point_of_attractor(
        &self,
        id: u64,
        place: &AttractorPlace,
        control: &Control,
    ) -> Result<Option<BranchPlace>, Error> {
        let (spec, attracting) = self.stored_attractor(place)?;
        let response = self.stored_response(id)?;
        let value = response.key.get(&spec)?;
        if response.spec_at(value)? != spec {
            return Ok(None);
        }
        let (orbit, cycles) = (&attracting.orbit, attracting.orbit.period_cycles);
        let base = self.model(&response.spec, control)?;
        let parameter = response.parameter(&base);
        let kernel = parameter.at(value)?.kernel;
        let own = Shooting::new(&parameter, &kernel, cycles, TOLERANCE);
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE)
            .charged_as(&own.physical(orbit.start()));
        let states = rescaled(&orbit.strobe_states, &own, &shooting);
        let away = |start: &[f64]| {
            let distances = states.iter().map(|state| distance(state, start));
            distances.fold(f64::INFINITY, f64::min)
        };
        let is_same = |found: &Orbit, _: &ShootingEvaluation| {
            attracting.passes(&rescaled(&found.strobe_states, &shooting, &own))
        };
        let lines = response.lines_at(id, cycles, value);
        Ok(first_point(&shooting, lines, away, is_same))
    }

    fn point_of_identity(
        &self,
        id: u64,
        identity: &OrbitIdentity,
        control: &Control,
    ) -> Result<Option<BranchPlace>, Error> {
        let (cycles, value) = (identity.period_cycles, identity.parameter);
        let response = self.stored_response(id)?;
        let base = self.model(&response.spec, control)?;
        let parameter = response.parameter(&base);
        let kernel = parameter.at(value)?.kernel;
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
        let section =
            |start: &[f64]| SectionPoint::of(&kernel.plant.system, &shooting.physical(start));
        let lines = response.lines_at(id, cycles, value);
        let sections: Vec<SectionPoint> = lines.iter().map(|own| section(&own.start)).collect();
        let size = size(&sections);
        let away = |start: &[f64]| identity.distance_to(&section(start), size);
        let is_same = |found: &Orbit, motion: &ShootingEvaluation| {
            identity.distance(found, motion) < SAME_DISTANCE
        };
        Ok(first_point(&shooting, lines, away, is_same))
    }

    fn bifurcation_of_identity(
        &self,
        id: u64,
        identity: &OrbitIdentity,
        kind: &str,
        control: &Control,
    ) -> Result<Option<BranchPlace>, Error> {
        let cycles = identity.period_cycles;
        let response = self.stored_response(id)?;
        let base = self.model(&response.spec, control)?;
        let parameter = response.parameter(&base);
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
        let width = response.range.1 - response.range.0;
        let mut nearest: Option<(f64, BranchPlace)> = None;
        for (branch, own) in response.branches_of(cycles) {
            let same = own.bifurcations.iter().filter(|found| {
                let away = (found.at.parameter - identity.parameter).abs();
                found.kind.name() == kind && away < SAME_DISTANCE * width
            });
            for found in same {
                let (orbit, motion) = own_orbit(&shooting, &found.at)?;
                let away = identity.distance(&orbit, &motion);
                if away < nearest.map_or(SAME_BIFURCATION_DISTANCE, |(least, _)| least) {
                    let place = BranchPlace {
                        response: id,
                        branch,
                        point: nearest_point(own, found),
                        parameter: Some(found.at.parameter),
                    };
                    nearest = Some((away, place));
                }
            }
        }
        Ok(nearest.map(|(_, place)| place))
    }
}

impl StoredResponse {
    /// Returns the branches of a period, with their numbers.
    fn branches_of(&self, cycles: u32) -> impl Iterator<Item = (usize, &Branch)> {
        let all = self.branches.iter().enumerate();
        all.filter(move |(_, own)| own.period_cycles == cycles)
    }

    /// Returns the lines of the branches of a period next to a value of the key.
    fn lines_at(&self, response: u64, cycles: u32, value: f64) -> Vec<BranchLine> {
        let line = |branch: usize, own: &Branch, point: usize| {
            let (from, to) = (&own.points[point], &own.points[point + 1]);
            let share = (value - from.parameter) / (to.parameter - from.parameter);
            let reached = -EXTENSION..=1.0 + EXTENSION;
            let states = from.orbit.start().iter().zip(to.orbit.start());
            reached.contains(&share).then(|| BranchLine {
                place: BranchPlace {
                    response,
                    branch,
                    point: if share < 0.5 { point } else { point + 1 },
                    parameter: Some(value),
                },
                start: states.map(|(a, b)| a + share * (b - a)).collect(),
            })
        };
        let lines = self.branches_of(cycles).flat_map(|(branch, own)| {
            let last = own.points.len().saturating_sub(1);
            (0..last).filter_map(move |point| line(branch, own, point))
        });
        lines.collect()
    }
}

/// Returns the nearest line on which the corrected orbit is the sought one.
fn first_point(
    shooting: &Shooting<'_, Parameter<'_>>,
    mut lines: Vec<BranchLine>,
    away: impl Fn(&[f64]) -> f64,
    is_same: impl Fn(&Orbit, &ShootingEvaluation) -> bool,
) -> Option<BranchPlace> {
    lines.sort_by(|one, other| away(&one.start).total_cmp(&away(&other.start)));
    let found = lines.iter().take(MAX_LINES).find(|line| {
        let value = line.place.parameter.unwrap_or(f64::NAN);
        let orbit = corrected(shooting, &line.start, value);
        orbit.is_ok_and(|(orbit, motion)| is_same(&orbit, &motion))
    });
    Some(found?.place)
}

/// Returns the point of a branch whose state is nearest to that of a bifurcation.
fn nearest_point(branch: &Branch, bifurcation: &Bifurcation) -> usize {
    let away = |point: usize| {
        let start = branch.points[point].orbit.start();
        distance(start, bifurcation.at.orbit.start())
    };
    let points = 0..branch.points.len();
    let nearest = points.min_by(|one, other| away(*one).total_cmp(&away(*other)));
    nearest.unwrap_or_default()
}
