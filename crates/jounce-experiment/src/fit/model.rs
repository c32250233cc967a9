//! Evaluation of the model at one set of keys.

use std::cell::OnceCell;
use std::path::Path;

use jounce_analysis::Model;
use jounce_control::Control;
use jounce_spec::{NumericKey, Spec, SpecFile};

use super::FitError;

/// Spec of a fit, and the folder of its files.
#[derive(Clone, Copy)]
pub(super) struct FitSource<'a> {
    pub file: &'a SpecFile,
    pub folder: &'a Path,
}

/// Model at one set of keys.
pub(super) struct FitModel<'a> {
    pub spec: Spec,
    pub hold: &'a [String],
    /// Folder of the spec and its files.
    pub folder: &'a Path,
    /// Cancels the runs.
    pub control: Control,
    /// Harvester without conditions, built at first use.
    pub base_model: OnceCell<Model>,
}

/// Measurement with a corresponding model result.
pub(super) trait FeatureModel {
    /// Computes the model's value for every measured number of this test.
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError>;
}

/// Values of keys that apply during a test.
#[derive(Debug, Clone, Default)]
pub(super) struct Conditions(Vec<(NumericKey, f64)>);

impl Conditions {
    /// Parses keys and values in command-line notation.
    pub fn new(
        source: FitSource<'_>,
        set: &[(String, String)],
        position: &str,
    ) -> Result<Self, FitError> {
        let one = |(key, value): &(String, String)| {
            let condition_error = |reason: String| FitError::Condition {
                place: position.to_owned(),
                key: key.clone(),
                reason,
            };
            let result = source
                .file
                .numeric_key(key)
                .map_err(|faults| condition_error(faults.to_string()))?;
            let mut changed_file = SpecFile::from_text(source.file.text()).in_folder(source.folder);
            changed_file
                .set(key, value)
                .map_err(|fault| condition_error(fault.to_string()))?;
            let value = result.get(
                &changed_file
                    .spec()
                    .map_err(|faults| condition_error(faults.to_string()))?,
            )?;
            Ok((result, value))
        };
        set.iter()
            .map(one)
            .collect::<Result<_, FitError>>()
            .map(Self)
    }

    /// Applies the conditions to the initial spec.
    pub fn spec(&self, source: FitSource<'_>) -> Result<Spec, FitError> {
        let mut spec = source.file.spec().map_err(|faults| FitError::Features {
            faults: vec![faults.to_string()],
        })?;
        self.0
            .iter()
            .try_for_each(|(key, value)| key.set(&mut spec, *value))?;
        Ok(spec)
    }

    /// First condition.
    pub fn first(&self) -> Option<&(NumericKey, f64)> {
        self.0.first()
    }

    /// Returns the conditions with one more.
    pub fn with(&self, key: &NumericKey, value: f64) -> Self {
        Self(
            self.0
                .iter()
                .cloned()
                .chain([(key.clone(), value)])
                .collect(),
        )
    }
}

impl FitModel<'_> {
    /// Spec under conditions.
    pub fn spec_at(&self, conditions: &Conditions) -> Result<Spec, FitError> {
        let mut spec = self.spec.clone();
        for (key, value) in &conditions.0 {
            key.set(&mut spec, *value)?;
        }
        Ok(spec)
    }

    /// Harvester under conditions.
    pub fn model_at(&self, conditions: &Conditions) -> Result<Model, FitError> {
        let base = match self.base_model.get() {
            Some(base) => base,
            None => {
                let model = Model::watched(self.spec.clone(), &self.control)?;
                self.base_model.get_or_init(|| model)
            }
        };
        Ok(base.changed(self.spec_at(conditions)?)?)
    }
}
