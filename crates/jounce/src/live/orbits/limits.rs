//! Limits of the patches and of the linear beam over the period of an orbit.

use super::motion::BeamMotion;
use jounce_analysis::run::{ExceededLimit, Limits};
use jounce_orbits::ShootingEvaluation;
use jounce_spec::Spec;

/// Largest deflection of a beam, relative to its length, up to which the linear model has no
/// warning.
const MAX_DEFLECTION_SHARE: f64 = 0.1;

/// Returns each limit of a patch with the value that exceeds it most or is nearest to it.
pub(super) fn reached(spec: &Spec, evaluation: &ShootingEvaluation) -> Vec<ExceededLimit> {
    let limits = Limits::of(spec, &evaluation.kernel.plant);
    let mut worst: Vec<ExceededLimit> = Vec::new();
    for trajectory in &evaluation.trajectories {
        for (index, limit) in limits
            .reached(&evaluation.kernel, trajectory)
            .into_iter()
            .enumerate()
        {
            match worst.get_mut(index) {
                Some(known) if limit.excess() > known.excess() => *known = limit,
                Some(_) => {}
                None => worst.push(limit),
            }
        }
    }
    worst
}

/// Returns the messages about exceeded limits and about deflections too large for a linear beam.
pub(super) fn warnings(limits: &[ExceededLimit], beams: &[BeamMotion]) -> Vec<String> {
    let exceeded = limits.iter().filter(|limit| limit.is_beyond());
    let bent = beams.iter().filter_map(|beam| {
        let share = beam.max_deflection_m() / beam.position_m.last()?;
        (share > MAX_DEFLECTION_SHARE).then(|| {
            format!(
                "beam {}: its deflection reaches {:.0} % of its length; the linear model holds up to about {:.0} %",
                beam.name,
                100.0 * share,
                100.0 * MAX_DEFLECTION_SHARE
            )
        })
    });
    exceeded.map(ToString::to_string).chain(bent).collect()
}
