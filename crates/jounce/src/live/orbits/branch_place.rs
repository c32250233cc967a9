//! Orbit of a point of a response.

use super::orbit::{ShownOrbit, TOLERANCE};
use crate::error::Error;
use crate::live::LiveAnalysis;
use crate::live::responses::StoredResponse;
use jounce_analysis::{Bifurcation, BranchPoint, Parameter};
use jounce_continuation::{Corrector, Metric, Position, Problem, correct_at};
use jounce_control::Control;
use jounce_orbits::{Orbit, OrbitMethod, ParametricModel, Shooting, ShootingEvaluation};
use serde::{Deserialize, Serialize};

/// Goal of Newton's method and its largest number of iterations.
const CORRECTOR: Corrector = Corrector {
    goal: 50.0 * TOLERANCE,
    most: 10,
};

/// Point of a stored response.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BranchPlace {
    /// Number of the response.
    pub response: u64,
    /// Number of the branch in the response, from 0.
    pub branch: usize,
    /// Number of the point on the branch, from 0.
    pub point: usize,
    /// Value of the key near the point at which the orbit is computed, SI; by default the value at
    /// the point.
    #[serde(default)]
    pub parameter: Option<f64>,
}

impl LiveAnalysis {
    /// Computes the orbit of a point of a stored response.
    pub(super) fn branch_orbit(
        &self,
        place: &BranchPlace,
        control: &Control,
    ) -> Result<ShownOrbit, Error> {
        let response = self.stored_response(place.response)?;
        let (cycles, point) = point_at(&response, place)?;
        let base = self.model(&response.spec, control)?;
        let parameter = response.parameter(&base);
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
        let value = place.parameter.unwrap_or(point.parameter);
        let bifurcation = bifurcation_at(&response, place);
        let (orbit, motion) = match bifurcation {
            Some(own) => own_orbit(&shooting, &own.at)?,
            None => corrected(&shooting, point.orbit.start(), value)?,
        };
        let own = Shooting::new(&parameter, &motion.kernel, cycles, TOLERANCE);
        Ok(ShownOrbit {
            spec: response.spec_at(value)?,
            bifurcation: bifurcation.map(|own| own.kind),
            orbit: Orbit {
                strobe_states: rescaled(&orbit.strobe_states, &shooting, &own),
                ..orbit
            },
            motion,
        })
    }
}

/// Returns the period of a branch in drive cycles and a point of it.
pub(in crate::live) fn point_at<'r>(
    response: &'r StoredResponse,
    place: &BranchPlace,
) -> Result<(u32, &'r BranchPoint), Error> {
    let branch = response.branches.get(place.branch);
    let found = branch.and_then(|own| Some((own.period_cycles, own.points.get(place.point)?)));
    found.ok_or_else(|| {
        Error::option(
            "point",
            format!("{} of branch {}", place.point, place.branch),
            "this response has no such point; choose a point of its curves",
        )
    })
}

/// Returns the orbit at a value of the key from a state near its start, with its motion.
pub(super) fn corrected(
    shooting: &Shooting<'_, Parameter<'_>>,
    start: &[f64],
    parameter: f64,
) -> Result<(Orbit, ShootingEvaluation), Error> {
    let position = Position {
        unknown: start.to_vec(),
        parameter,
    };
    let metric = Metric::at(&position, 1.0);
    let solution = correct_at(shooting, &CORRECTOR, &metric, position)?;
    let orbit = shooting.orbit(&solution.local, solution.error)?;
    Ok((orbit, solution.local))
}

/// Returns states in the energy coordinates of another design: these scale with its modes.
pub(super) fn rescaled<H: ParametricModel>(
    states: &[Vec<f64>],
    from: &Shooting<'_, H>,
    to: &Shooting<'_, H>,
) -> Vec<Vec<f64>> {
    let state = |own: &Vec<f64>| to.unknown(&from.physical(own));
    states.iter().map(state).collect()
}

/// Returns the orbit of a bifurcation as it was located. At a fixed value of the key Newton's method
/// finds no orbit at a fold.
pub(super) fn own_orbit(
    shooting: &Shooting<'_, Parameter<'_>>,
    bifurcation: &BranchPoint,
) -> Result<(Orbit, ShootingEvaluation), Error> {
    let orbit = bifurcation.orbit.clone();
    let motion = shooting.at(orbit.start(), bifurcation.parameter)?;
    Ok((orbit, motion))
}

/// Returns the bifurcation of the branch at the requested value of the key.
fn bifurcation_at<'r>(
    response: &'r StoredResponse,
    place: &BranchPlace,
) -> Option<&'r Bifurcation> {
    let parameter = place.parameter?;
    let mut all = response.branches.get(place.branch)?.bifurcations.iter();
    all.find(|own| own.at.parameter == parameter)
}
