//! Limits of the patches and of the linear beam over the period of an orbit.

use super::motion::BeamMotion;
use jounce_analysis::run::{ExceededLimit, Limits, MAX_DEFLECTION_SHARE, Warning};
use jounce_orbits::ShootingEvaluation;
use jounce_spec::Spec;
use serde::Serialize;

/// Limit of a patch with the value that exceeds it most or is nearest to it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReachedLimit {
    /// The limit.
    #[serde(flatten)]
    pub limit: ExceededLimit,
    /// The lowest or highest allowed value, whichever the value exceeds or is nearest to.
    pub bound: f64,
    /// Excess over it, in the unit of the quantity; negative within the limits.
    pub excess: f64,
}

impl ReachedLimit {
    pub(super) fn of(limit: &ExceededLimit) -> Self {
        let ([low, high], excess) = (limit.limits, limit.excess());
        Self {
            limit: limit.clone(),
            bound: if low - limit.reached < excess {
                high
            } else {
                low
            },
            excess,
        }
    }
}

/// Returns each limit of a patch with the value that exceeds it most or is nearest to it.
pub(super) fn reached(spec: &Spec, evaluation: &ShootingEvaluation) -> Vec<ExceededLimit> {
    let limits = Limits::of(spec, &evaluation.kernel.plant);
    let mut worst: Vec<ExceededLimit> = Vec::new();
    for trajectory in &evaluation.trajectories {
        for (index, limit) in limits
            .reached(&evaluation.kernel, trajectory, f64::INFINITY)
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
    let messages = exceeded.map(ToString::to_string);
    messages.chain(large_deflections(beams)).collect()
}

/// Returns the messages about deflections too large for a linear beam.
pub(super) fn large_deflections(beams: &[BeamMotion]) -> Vec<String> {
    let bent = beams.iter().filter_map(|beam| {
        let share = beam.max_deflection_m() / beam.position_m.last()?;
        (share > MAX_DEFLECTION_SHARE).then(|| {
            let warning = Warning::LargeDeflection {
                beam: beam.name.clone(),
                share,
            };
            warning.to_string()
        })
    });
    bent.collect()
}
