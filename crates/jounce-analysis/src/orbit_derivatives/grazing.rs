//! Distance of an orbit from its nearest grazing, and the derivative of this distance by keys.
//!
//! At a grazing a turning point of the motion is on the surface of a stop. There the derivatives of
//! the orbit's results may differ on both sides. A contact that a turning point `d` past the surface
//! adds or divides lasts `t ~ sqrt(d)`, at speeds `v ~ sqrt(d)`, and changes the momentum by
//!
//! ```text
//! k d^n:  d^(n + 1/2)      c v, never pulling:  d      rebound:  sqrt(d)
//! ```
//!
//! So the derivative is continuous for elastic laws and for damping that grows with the penetration,
//! it jumps with a dashpot, and it has no bound on the side with contact at a rigid stop.
//!
//! Source: A. B. Nordmark, J. Sound Vib. 145 (1991) 279 (rigid stops); M. di Bernardo et al.,
//! Piecewise-smooth Dynamical Systems (2008), section 2.5 (the order of the jump).

use super::{DerivativeKey, Failure, TOLERANCE, corrected, exact::ExactKey, prepared};
use crate::{KeyLine, Model};
use jounce_model::contact::Law;
use jounce_orbits::{Orbit, OrbitInstant, Shooting, ShootingEvaluation, TurningPoint, turns};
use rayon::prelude::*;

/// Turning point of an orbit that is nearest to the surface of its stop.
#[derive(Debug)]
pub struct NearestGrazing {
    /// Name of the stop.
    pub stop: String,
    /// Turning point.
    pub turn: TurningPoint,
    /// Derivatives of the orbit across the grazing.
    pub across: AcrossGrazing,
    /// Derivative of its distance past the surface by each key, m per SI unit; `None` where it is not
    /// known in closed form.
    pub distance_by_key: Vec<Option<f64>>,
}

/// Derivatives of the motion with respect to a key from one side of a grazing to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AcrossGrazing {
    /// They are the same on both sides.
    Continuous,
    /// They differ.
    Jump,
    /// They grow without bound towards the grazing on the side with contact.
    Unbounded,
}

impl AcrossGrazing {
    fn of(law: &Law) -> Self {
        match law {
            Law::Rigid(_) => Self::Unbounded,
            Law::KelvinVoigt(law) if law.damping_n_s_m > 0.0 => Self::Jump,
            Law::Hertz(_)
            | Law::KelvinVoigt(_)
            | Law::HuntCrossley(_)
            | Law::Cubic(_)
            | Law::Table(_) => Self::Continuous,
        }
    }

    /// Returns the name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Continuous => "continuous",
            Self::Jump => "jump",
            Self::Unbounded => "unbounded",
        }
    }
}

/// Returns the nearest grazing of an orbit of a model; `None` without a stop that it could graze.
///
/// # Errors
/// The integration of the orbit fails.
pub fn nearest_grazing(
    base: &Model,
    orbit: &Orbit,
    keys: &[DerivativeKey<'_>],
) -> Result<Option<NearestGrazing>, Failure> {
    let line = KeyLine::at(base);
    let shooting = Shooting::new(&line, &base.kernel, orbit.period_cycles, TOLERANCE);
    let evaluation = corrected(&shooting, orbit.start())?;
    let near = |a: &TurningPoint, b: &TurningPoint| a.past_m.abs().total_cmp(&b.past_m.abs());
    let Some(turn) = turns(&evaluation).into_iter().min_by(near) else {
        return Ok(None);
    };
    let turn = turn.refined(&evaluation);
    let stop = &base.kernel.plant.system.stops[turn.port];
    let of_key = |key: &DerivativeKey<'_>| prepared(base, *key).ok().flatten();
    let exact: Vec<Option<ExactKey>> = keys.par_iter().map(of_key).collect();
    Ok(Some(NearestGrazing {
        stop: stop.name.clone(),
        across: AcrossGrazing::of(&stop.law),
        distance_by_key: distances(&shooting, &evaluation, &turn, &exact)?,
        turn,
    }))
}

/// Returns the derivatives of the distance past the surface: that of the displacement at the fixed
/// time of the turning point, where the displacement is stationary, minus that of the gap.
fn distances(
    shooting: &Shooting<'_, KeyLine<'_>>,
    evaluation: &ShootingEvaluation,
    turn: &TurningPoint,
    keys: &[Option<ExactKey>],
) -> Result<Vec<Option<f64>>, Failure> {
    let plants: Vec<_> = keys.iter().flatten().map(|key| key.plant.clone()).collect();
    let instant = OrbitInstant {
        cycle: turn.cycle,
        time_s: turn.time_s,
    };
    let found = shooting.sensitivity(evaluation, &plants, &[instant])?;
    let displacements = found.instants.first().map(|at| &at.displacements_by);
    let mut by_key = displacements.into_iter().flatten();
    let distance = |key: &Option<ExactKey>| {
        let key = key.as_ref()?;
        let by_gap = key
            .systems
            .derivative(|system| system.stops[turn.port].gap_m);
        Some(by_key.next()?[turn.port] - by_gap)
    };
    Ok(keys.iter().map(distance).collect())
}
