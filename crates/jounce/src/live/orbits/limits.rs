//! Limits of the patches and of the linear beam over the period of an orbit.

use super::motion::BeamMotion;
use jounce_analysis::run::{ExceededLimit, Limits, MAX_DEFLECTION_SHARE, Warning};
use jounce_orbits::ShootingEvaluation;
use jounce_spec::Spec;

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
    exceeded.map(ToString::to_string).chain(bent).collect()
}
