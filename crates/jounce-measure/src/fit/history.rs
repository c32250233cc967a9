//! Time histories of a run as features.

use std::path::{Path, PathBuf};

use jounce::linear::Response;
use jounce::run::{RunPlan, simulate};
use jounce::study::{Prepared, StudyError};

use super::model::Conditions;
use super::reading::Reader;
use super::response::output;
use super::{Deviation, FitError, Model, Question};
use crate::read;

/// A record whose first sample is that of the start of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryFeature {
    /// The recording, relative to the features.
    pub file: PathBuf,
    /// Its channel.
    pub channel: String,
    /// What the channel measures: a displacement, a velocity, or the voltage of a patch.
    pub output: Response,
    /// Deviation of each sample over the rms of the record.
    pub deviation: Deviation,
    /// Keys that hold during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 5] = ["file", "channel", "output", "deviation", "set"];
const HISTORIES: &str = "a history is a .displacement, a .velocity or the .voltage of a patch";
/// Fewest samples that are a history.
const FEWEST: usize = 8;

impl HistoryFeature {
    pub(super) fn read(reader: &mut Reader<'_>) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let (file, channel) = (reader.text("file", "run.csv"), reader.text("channel", "voltage"));
        let found = reader.text("output", "mfc.voltage").and_then(|text| output(&text, reader));
        if matches!(found, Some(Response::Acceleration(_) | Response::LoadVoltage(_))) {
            reader.fault(format!("output: {HISTORIES}"));
            return None;
        }
        let (deviation, set) = (reader.own_deviation(), reader.conditions());
        Some(Self { file: file?.into(), channel: channel?, output: found?, deviation, set })
    }

    /// Times from the first sample on, s, samples and their unit.
    pub(super) fn samples(&self, folder: &Path, place: &str) -> Result<(Vec<f64>, Vec<f64>, String), FitError> {
        let told = |reason: String| FitError::File { place: place.to_owned(), path: self.file.clone(), reason };
        let record = read::record(&folder.join(&self.file)).map_err(|fault| told(fault.to_string()))?;
        let channel = record.channel(&self.channel).map_err(|fault| told(fault.to_string()))?;
        let places = record.grid.places();
        if places.len() < FEWEST || channel.values.iter().any(|x| !x.is_finite()) {
            return Err(told(format!("a history needs at least {FEWEST} samples, each a number")));
        }
        if channel.values.iter().all(|x| *x == 0.0) {
            return Err(told(format!("channel {} is zero throughout", channel.name)));
        }
        Ok((places.iter().map(|time_s| time_s - places[0]).collect(), channel.values.clone(), channel.unit.clone()))
    }
}

/// The run from its start on, at the times of the record.
pub(super) struct AskedHistory {
    pub output: Response,
    pub time_s: Vec<f64>,
    pub conditions: Conditions,
}

impl Question for AskedHistory {
    fn ask(&self, model: &Model<'_>) -> Result<Vec<f64>, FitError> {
        let prepared = model.prepared_at(&self.conditions)?;
        let start = prepared.start(model.folder)?;
        let kernel = prepared.from_state(&start)?;
        let duration_s = self.time_s.last().copied().unwrap_or(0.0);
        let tolerance = prepared.spec.run.tolerance;
        let plan = RunPlan { duration_s, average_over_s: duration_s / 2.0, tolerance, record_s: duration_s };
        let answer = simulate(&kernel, &start, &plan).map_err(StudyError::from)?;
        let read = self.reader(&prepared)?;
        let instants = answer.trajectory.at(&kernel, &self.time_s);
        Ok(instants.iter().map(|at| read(&kernel.plant.to_physical(&at.state, at.time_s))).collect())
    }
}

/// An output of a physical state.
type Reading<'p> = Box<dyn Fn(&[f64]) -> f64 + 'p>;

impl AskedHistory {
    /// What a physical state has of the output.
    fn reader<'p>(&self, prepared: &'p Prepared) -> Result<Reading<'p>, FitError> {
        let plant = &prepared.kernel.plant;
        let modes = &plant.system.modes;
        let unknown = |name: &str, known: Vec<&String>| FitError::NoPlace {
            name: name.to_owned(),
            known: known.into_iter().cloned().collect::<Vec<_>>().join(", "),
        };
        let shape = |point: &String| modes.shape.get(point).ok_or_else(|| unknown(point, modes.shape.keys().collect()));
        let along = |shape: &'p Vec<f64>, first: usize| -> Reading<'p> {
            Box::new(move |x: &[f64]| shape.iter().zip(&x[first..]).map(|(s, q)| s * q).sum())
        };
        match &self.output {
            Response::Velocity(point) => Ok(along(shape(point)?, modes.len())),
            Response::Voltage(patch) => {
                let place = modes.patch.keys().position(|name| name == patch);
                let place = place.ok_or_else(|| unknown(patch, modes.patch.keys().collect()))?;
                Ok(Box::new(move |x: &[f64]| plant.patch_voltages_v(x)[place]))
            }
            Response::Displacement(point) => Ok(along(shape(point)?, 0)),
            other => Err(FitError::Features { faults: vec![format!("history: output is {}; {HISTORIES}", other.name())] }),
        }
    }
}
