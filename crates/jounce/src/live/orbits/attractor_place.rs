//! Orbit of an attractor of an operating point or of basins.

use super::orbit::{ShownOrbit, TOLERANCE};
use crate::basins::{AttractorResult, BasinsResult};
use crate::error::Error;
use crate::live::{Design, LiveAnalysis};
use jounce_analysis::{AttractingOrbit, KeyLine, Model};
use jounce_control::Control;
use jounce_orbits::{Orbit, ParametricModel, Shooting, ShootingEvaluation};
use jounce_spec::Spec;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An attractor of a stored operating point or of stored basins.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct AttractorPlace {
    /// Number of the operating point or of the basins.
    pub attractors: u64,
    /// Id of the attractor.
    pub attractor: String,
}

/// Attractors of a design.
#[derive(Debug)]
pub struct StoredAttractors {
    spec: Spec,
    attractors: Vec<AttractorResult>,
}

impl LiveAnalysis {
    /// Stores the attractors of a design under a number, for their orbits.
    pub fn store_attractors(&self, id: u64, design: &Design, basins: &BasinsResult) {
        let stored = StoredAttractors {
            spec: design.spec().clone(),
            attractors: basins.attractors.clone(),
        };
        self.attractors.store(id, Arc::new(stored));
    }

    /// Integrates the period of the orbit of a stored attractor.
    pub(super) fn attractor_orbit(
        &self,
        place: &AttractorPlace,
        control: &Control,
    ) -> Result<ShownOrbit, Error> {
        let (spec, attracting) = self.stored_attractor(place)?;
        let base = self.model(&spec, control)?;
        let orbit = attracting.orbit.clone();
        let motion = period(&orbit, &base)?;
        Ok(ShownOrbit {
            spec,
            bifurcation: None,
            orbit,
            motion,
        })
    }

    /// Returns the design and the orbit of a stored attractor.
    pub(super) fn stored_attractor(
        &self,
        place: &AttractorPlace,
    ) -> Result<(Spec, Arc<AttractingOrbit>), Error> {
        let allowed = "no periodic attractor has this id; choose one that the page shows";
        self.of_stored_attractor(place, allowed, |own| own.attracting.clone())
    }

    /// Returns the design and the last state of a stored attractor without a period.
    pub(super) fn stored_last_state(
        &self,
        place: &AttractorPlace,
    ) -> Result<(Spec, Vec<f64>), Error> {
        let allowed = "no attractor without a period has this id; choose one that the page shows";
        self.of_stored_attractor(place, allowed, |own| own.last_state.clone())
    }

    fn of_stored_attractor<T>(
        &self,
        place: &AttractorPlace,
        allowed: &str,
        value: impl Fn(&AttractorResult) -> Option<T>,
    ) -> Result<(Spec, T), Error> {
        let stored = self.attractors.find(place.attractors).ok_or_else(|| {
            let allowed = "they are no longer stored; compute them again";
            Error::option("attractors", place.attractors, allowed)
        })?;
        let mut all = stored.attractors.iter();
        let found = all.find(|own| own.id == place.attractor).and_then(value);
        let found = found.ok_or_else(|| Error::option("attractor", &place.attractor, allowed))?;
        Ok((stored.spec.clone(), found))
    }

    /// Returns the stored attractors of the same design whose orbit this is.
    pub(super) fn attractors_of(&self, shown: &ShownOrbit) -> Vec<AttractorPlace> {
        let stored = self.attractors.all().into_iter();
        let of_design = stored.filter(|(_, own)| own.spec == shown.spec);
        let places = of_design.flat_map(|(number, own)| {
            let same = own
                .attractors
                .iter()
                .filter(|own| own.has_orbit(&shown.orbit));
            let place = |own: &AttractorResult| AttractorPlace {
                attractors: number,
                attractor: own.id.clone(),
            };
            same.map(place).collect::<Vec<_>>()
        });
        places.collect()
    }
}

impl AttractorResult {
    /// True where an orbit of the same harvester is that of this attractor: itself, or one that
    /// passes the ball that only this orbit passes.
    fn has_orbit(&self, orbit: &Orbit) -> bool {
        let attracting = self.attracting.as_ref();
        attracting.is_some_and(|own| own.orbit == *orbit || own.holds(orbit))
    }
}

/// Integrates the period of the orbit of an attractor.
pub(super) fn period(orbit: &Orbit, base: &Model) -> Result<ShootingEvaluation, Error> {
    let line = KeyLine::at(base);
    let kernel = line.at(0.0)?.kernel;
    let shooting = Shooting::new(&line, &base.kernel, orbit.period_cycles, TOLERANCE);
    Ok(shooting.integrated(kernel, orbit.start())?)
}
