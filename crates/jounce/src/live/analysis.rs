//! Data that speed up the next computation.

use super::responses::{LastLinear, StoredResponse, StoredResponses};
use crate::error::Error;
use jounce_analysis::{AnalysisError, Model};
use jounce_control::Control;
use jounce_model::structure::{BeamShape, shapes_along_beams};
use jounce_spec::Spec;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of positions along a beam at which its motion is drawn.
const BEAM_POSITIONS: usize = 49;

/// Shapes of the modes along each beam.
pub(super) type Shapes = Arc<BTreeMap<String, BeamShape>>;

/// Computations on designs that follow one another. It stores only data that speed up the next
/// computation: the last model, the last responses, and the last curve without contact.
#[derive(Debug, Default)]
pub struct LiveAnalysis {
    last_model: Mutex<Option<Arc<Model>>>,
    shapes: Mutex<Option<(Spec, Shapes)>>,
    pub(super) responses: StoredResponses,
    pub(super) linear: LastLinear,
}

impl LiveAnalysis {
    /// Returns the model of a design under a control; parts shared with the previous model are
    /// reused.
    pub(super) fn model(&self, spec: &Spec, control: &Control) -> Result<Model, Error> {
        let previous = self
            .last_model
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone();
        let model = match previous {
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

    /// Returns the shapes of the modes along the beams of a design.
    pub(super) fn shapes(&self, spec: &Spec) -> Result<Shapes, Error> {
        let has_same_shapes = |cached: &Spec| {
            (
                &cached.beam,
                &cached.plate,
                &cached.patch,
                &cached.mass,
                &cached.modal,
            ) == (
                &spec.beam,
                &spec.plate,
                &spec.patch,
                &spec.mass,
                &spec.modal,
            ) && cached.reduction == spec.reduction
        };
        let mut cached = self.shapes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, shapes)) = cached
            .as_ref()
            .filter(|(cached, _)| has_same_shapes(cached))
        {
            return Ok(Arc::clone(shapes));
        }
        let shapes = shapes_along_beams(spec, &[], BEAM_POSITIONS).map_err(AnalysisError::from)?;
        let shapes = Arc::new(shapes);
        *cached = Some((spec.clone(), Arc::clone(&shapes)));
        Ok(shapes)
    }

    /// Returns an earlier response.
    pub(super) fn stored_response(&self, id: u64) -> Result<Arc<StoredResponse>, Error> {
        self.responses.find(id).ok_or_else(|| {
            Error::option("response", id, "it is no longer stored; compute it again")
        })
    }
}
