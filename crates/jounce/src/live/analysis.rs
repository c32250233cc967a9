//! Data that speed up the next computation.

use super::orbits::StoredAttractors;
use super::recent::Recent;
use super::responses::{LastLinear, StoredResponse};
use crate::error::Error;
use crate::modes::{PlateShapes, modes_and_plates};
use jounce_analysis::{AnalysisError, Model, has_same_modes};
use jounce_control::Control;
use jounce_model::structure::{BeamShape, shapes_along_beams};
use jounce_spec::Spec;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of positions along a beam at which its motion is drawn.
const BEAM_POSITIONS: usize = 49;

/// Shapes of the modes along each beam and over each plate.
#[derive(Debug, PartialEq)]
pub(super) struct Shapes {
    pub beams: BTreeMap<String, BeamShape>,
    pub plates: Vec<PlateShapes>,
}

impl Shapes {
    fn of(spec: &Spec) -> Result<Self, Error> {
        let beams = if spec.beam.is_empty() {
            BTreeMap::new()
        } else {
            shapes_along_beams(spec, &[], BEAM_POSITIONS).map_err(AnalysisError::from)?
        };
        let plates = if spec.plate.is_empty() {
            Vec::new()
        } else {
            modes_and_plates(spec, &[]).map_err(AnalysisError::from)?.1
        };
        Ok(Self { beams, plates })
    }
}

/// Computations on designs that follow one another. It stores only data that speed up the next
/// computation or that a later one names: the last model, the last responses and attractors, and the
/// last curve without contact.
#[derive(Debug, Default)]
pub struct LiveAnalysis {
    last_model: Mutex<Option<Arc<Model>>>,
    shapes: Mutex<Option<(Spec, Arc<Shapes>)>>,
    pub(super) responses: Recent<StoredResponse>,
    pub(super) attractors: Recent<StoredAttractors>,
    pub(super) linear: LastLinear,
}

impl LiveAnalysis {
    /// Returns the model of a design under a control; parts shared with the previous model are
    /// reused.
    pub(super) fn model(&self, spec: &Spec, control: &Control) -> Result<Model, Error> {
        let model = match copy(&self.last_model) {
            Some(previous) if previous.spec == *spec => previous,
            previous => {
                let model = Arc::new(match previous {
                    Some(previous) => previous.changed(spec.clone())?,
                    None => Model::new(spec.clone())?,
                });
                *self
                    .last_model
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(&model));
                model
            }
        };
        Ok(model.with_control(control)?)
    }

    /// Returns the shapes of the modes along the beams and over the plates of a design.
    pub(super) fn shapes(&self, spec: &Spec) -> Result<Arc<Shapes>, Error> {
        let mut cached = self.shapes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, shapes)) = cached
            .as_ref()
            .filter(|(cached, _)| has_same_modes(cached, spec))
        {
            return Ok(Arc::clone(shapes));
        }
        let shapes = Arc::new(Shapes::of(spec)?);
        *cached = Some((spec.clone(), Arc::clone(&shapes)));
        Ok(shapes)
    }

    /// Returns an analysis with the same stored data; what one of both stores later, the other
    /// lacks. A computation that several pages share has such an analysis of its own.
    #[must_use]
    pub fn fork(&self) -> Self {
        Self {
            last_model: Mutex::new(copy(&self.last_model)),
            shapes: Mutex::new(copy(&self.shapes)),
            responses: self.responses.fork(),
            attractors: self.attractors.fork(),
            linear: self.linear.fork(),
        }
    }

    /// Stores a response of another analysis under a number, with its model.
    ///
    /// # Errors
    /// [`Error::Option`] for a response that the other analysis does not store.
    pub fn adopt(&self, id: u64, other: &Self, other_id: u64) -> Result<(), Error> {
        let stored = other.stored_response(other_id)?;
        *self
            .last_model
            .lock()
            .unwrap_or_else(PoisonError::into_inner) = copy(&other.last_model);
        self.responses.store(id, stored);
        Ok(())
    }

    /// Returns the response over a key from which the next one starts.
    pub fn history(&self, key: &str) -> ResponseHistory {
        ResponseHistory(self.last_response(key))
    }

    /// Returns the last response over a key that has branches.
    pub(super) fn last_response(&self, key: &str) -> Option<Arc<StoredResponse>> {
        let responses = self.responses.all().into_iter();
        let mut over_key = responses.map(|(_, own)| own);
        over_key.find(|own| own.key.path() == key && !own.branches.is_empty())
    }

    /// Returns an earlier response.
    pub(super) fn stored_response(&self, id: u64) -> Result<Arc<StoredResponse>, Error> {
        self.responses.find(id).ok_or_else(|| {
            Error::option("response", id, "it is no longer stored; compute it again")
        })
    }
}

/// Response from which the next one over its key starts. Two are equal where one computation gave
/// both, or where there is none.
#[derive(Debug, Clone)]
pub struct ResponseHistory(Option<Arc<StoredResponse>>);

impl PartialEq for ResponseHistory {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Some(one), Some(two)) => Arc::ptr_eq(&one.branches, &two.branches),
            (one, two) => one.is_none() && two.is_none(),
        }
    }
}

/// Returns a copy of a guarded value.
fn copy<T: Clone>(guarded: &Mutex<T>) -> T {
    let value = guarded.lock().unwrap_or_else(PoisonError::into_inner);
    value.clone()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_spec::SpecFile;

    const LAYER: &str = "[layer.coat]\non = \"PART\"\nstart = \"1 mm\"\nlength = \"60 mm\"\nthickness = \"0.2 mm\"\nface = \"bottom\"\nwidth = \"20 mm\"\n\
        youngs_modulus = \"70 GPa\"\ndensity = \"2700 kg/m^3\"\n";

    /// Each change of a key of the bodies gives the shapes that a computation without an earlier
    /// one gives; other keys need no new shapes.
    #[test]
    fn shapes_follow_every_key_of_the_bodies() {
        let cases = [
            (
                "plate-de-marqui-2009/stop.toml",
                "plate",
                [
                    "layer.coat.thickness",
                    "patch.ceramic.thickness",
                    "plate.plate.width",
                ],
                "stop.corner.gap",
            ),
            (
                "impact-harvester-2019/harvester.toml",
                "beam",
                [
                    "layer.coat.thickness",
                    "patch.mfc.thickness",
                    "mass.table.mass",
                ],
                "stop.tip.gap",
            ),
        ];
        for (example, part, keys, other) in cases {
            let path = format!("{}/../../examples/{example}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(path).unwrap();
            let own = if part == "beam" {
                "section = \"thin-skin\"\n"
            } else {
                "poisson_ratio = 0.33\n"
            };
            let text = format!("{text}\n{}{own}", LAYER.replace("PART", part));
            let mut file = SpecFile::from_text(text);
            let analysis = LiveAnalysis::default();
            let mut last = analysis.shapes(&file.spec().unwrap()).unwrap();
            for key in keys {
                let value = 1.3
                    * file
                        .numeric_key(key)
                        .unwrap()
                        .get(&file.spec().unwrap())
                        .unwrap();
                let unit = if key.ends_with("mass") { "kg" } else { "m" };
                file.set(key, &format!("{value} {unit}")).unwrap();
                let spec = file.spec().unwrap();
                let shapes = analysis.shapes(&spec).unwrap();
                assert_ne!(shapes, last, "{key}");
                assert_eq!(*shapes, Shapes::of(&spec).unwrap(), "{key}");
                last = shapes;
            }
            file.set(other, "0.3 mm").unwrap();
            let same = analysis.shapes(&file.spec().unwrap()).unwrap();
            assert!(Arc::ptr_eq(&same, &last), "{other}");
        }
    }
}
