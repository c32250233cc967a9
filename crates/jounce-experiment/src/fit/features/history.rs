//! Time histories of a run as features.

use std::path::{Path, PathBuf};

use jounce_analysis::run::{RunPlan, simulate};
use jounce_analysis::{AnalysisError, Model};
use jounce_model::linear::FrfOutput;
use jounce_spec::Quantity;

use super::response::output;
use super::table::FeatureTable;
use crate::fit::model::Conditions;
use crate::fit::{Deviation, FeatureModel, FitError, FitModel};
use jounce_data::read;

/// Measured time history. Its stamps are times of the run, unless `begins` is given.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryFeature {
    /// Recording, relative to the features.
    pub file: PathBuf,
    /// Channel of the recording.
    pub channel: String,
    /// Measured output: a displacement, a velocity, or the voltage of a patch.
    pub output: FrfOutput,
    /// Standard deviation of each sample relative to the RMS of the record.
    pub deviation: Deviation,
    /// Time of the run at the first sample, s; without it the stamps of the record are times of the
    /// run.
    pub begins_s: Option<f64>,
    /// Keys that apply during the test.
    pub set: Vec<(String, String)>,
}

const KEYS: [&str; 6] = ["file", "channel", "output", "begins", "deviation", "set"];
const HISTORIES: &str = "a history is a .displacement, a .velocity or the .voltage of a patch";
/// Minimum number of samples of a history.
const MIN_SAMPLES: usize = 8;
/// Tolerance of stamps at the start and end of the run, relative to a step: roundoff.
const STAMP_ROUNDOFF: f64 = 1e-6;
const BEGINS: &str = "give `begins`, the time of the run at the first sample, such as begins = \
    \"0 s\" for the start of the run";

/// Samples of a record at times of the run.
pub(in crate::fit) struct HistorySamples {
    pub time_s: Vec<f64>,
    pub values: Vec<f64>,
    pub unit: String,
    /// True where the record begins later than the run, by its stamps alone.
    pub starts_late: bool,
}

impl HistoryFeature {
    pub(super) fn read(reader: &mut FeatureTable<'_>) -> Option<Self> {
        reader.refuse_all_but(&KEYS);
        let (file, channel) = (
            reader.text("file", "run.csv"),
            reader.text("channel", "voltage"),
        );
        let result = reader
            .text("output", "mfc.voltage")
            .and_then(|text| output(&text, reader));
        if matches!(
            result,
            Some(FrfOutput::Acceleration(_) | FrfOutput::LoadVoltage(_))
        ) {
            reader.fault("output", format!("output: {HISTORIES}"));
            return None;
        }
        let begins_s = reader.text_if_any("begins", "0 s").map(|text| {
            let result = Quantity::Time
                .read(&text)
                .ok()
                .filter(|time_s| *time_s >= 0.0);
            if result.is_none() {
                reader.fault(
                    "begins",
                    format!(
                        "begins is \"{text}\"; it must be a time of the run, not \
                    negative, with its unit, such as \"0 s\""
                    ),
                );
            }
            result.unwrap_or_default()
        });
        let (deviation, set) = (reader.own_deviation(), reader.conditions());
        Some(Self {
            file: file?.into(),
            channel: channel?,
            output: result?,
            begins_s,
            deviation,
            set,
        })
    }

    fn file_error(&self, position: &str, reason: &str) -> FitError {
        self.unusable(position, format!("{}: {reason}", self.file.display()))
    }

    fn unusable(&self, position: &str, reason: String) -> FitError {
        FitError::File {
            place: position.to_owned(),
            path: self.file.clone(),
            reason,
        }
    }

    /// Reads the samples with their times.
    pub(in crate::fit) fn samples(
        &self,
        folder: &Path,
        position: &str,
    ) -> Result<HistorySamples, FitError> {
        let file_error = |reason: String| self.file_error(position, &reason);
        let record = read::record(&folder.join(&self.file))
            .map_err(|fault| self.unusable(position, fault.to_string()))?;
        let channel = record
            .channel(&self.channel)
            .map_err(|fault| file_error(fault.to_string()))?;
        let time_stamps = record.grid.places();
        if time_stamps.len() < MIN_SAMPLES || channel.values.iter().any(|x| !x.is_finite()) {
            return Err(file_error(format!(
                "a history needs at least {MIN_SAMPLES} samples, each a number"
            )));
        }
        if channel.values.iter().all(|x| *x == 0.0) {
            return Err(file_error(format!(
                "channel {} is zero throughout",
                channel.name
            )));
        }
        let tolerance_s = STAMP_ROUNDOFF * (time_stamps[time_stamps.len() - 1] - time_stamps[0])
            / (time_stamps.len() - 1) as f64;
        let first_s = match self.begins_s {
            Some(begins_s) => begins_s,
            None if time_stamps[0] < -tolerance_s => {
                return Err(file_error(format!(
                    "its first stamp is {} s, before the run starts at 0: {BEGINS}",
                    time_stamps[0]
                )));
            }
            None if time_stamps[0] <= tolerance_s => 0.0,
            None => time_stamps[0],
        };
        Ok(HistorySamples {
            time_s: time_stamps
                .iter()
                .map(|time_s| first_s + (time_s - time_stamps[0]))
                .collect(),
            values: channel.values.clone(),
            unit: channel.unit.clone(),
            starts_late: self.begins_s.is_none() && first_s > 0.0,
        })
    }

    /// Refuses stamps beyond the run, which are usually from a clock that was not set.
    pub(in crate::fit) fn within(
        &self,
        time_s: &[f64],
        duration_s: f64,
        position: &str,
    ) -> Result<(), FitError> {
        let (first_s, last_s) = (time_s[0], time_s[time_s.len() - 1]);
        if last_s <= duration_s + STAMP_ROUNDOFF * (last_s - first_s) {
            return Ok(());
        }
        let reason = format!(
            "its stamps range from {first_s} to {last_s} s, but the run ends at run.duration = \
            {duration_s} s: if they are times of the run, raise run.duration; otherwise {BEGINS}"
        );
        Err(self.file_error(position, &reason))
    }

    /// Warning about a record whose stamps begin later than the run.
    pub(in crate::fit) fn late_start_warning(&self, first_s: f64, position: &str) -> String {
        format!(
            "{position}, {}: its first stamp, {first_s} s, is read as a time of the run; use \
            `begins` for another time, such as begins = \"0 s\"",
            self.file.display()
        )
    }
}

/// Run of the model, sampled at the times of the record.
pub(in crate::fit) struct HistoryModel {
    pub output: FrfOutput,
    pub time_s: Vec<f64>,
    pub conditions: Conditions,
}

impl FeatureModel for HistoryModel {
    fn predict(&self, model: &FitModel<'_>) -> Result<Vec<f64>, FitError> {
        let harvester = model.model_at(&self.conditions)?;
        let start = harvester.start(model.folder)?;
        let kernel = harvester.from_state(&start)?;
        let duration_s = self.time_s.last().copied().unwrap_or(0.0);
        let tolerance = harvester.spec.run.tolerance;
        let plan = RunPlan {
            duration_s,
            average_over_s: duration_s / 2.0,
            tolerance,
            record_s: duration_s,
        };
        let run = simulate(&kernel, &start, &plan).map_err(AnalysisError::from)?;
        let read = self.reader(&harvester)?;
        let instants = run.trajectory.at(&kernel, &self.time_s);
        Ok(instants
            .iter()
            .map(|at| read(&kernel.plant.to_physical(&at.state, at.time_s)))
            .collect())
    }
}

/// Output as a function of the physical state.
type Reading<'p> = Box<dyn Fn(&[f64]) -> f64 + 'p>;

impl HistoryModel {
    /// Returns the function that computes the output from a physical state.
    fn reader<'p>(&self, harvester: &'p Model) -> Result<Reading<'p>, FitError> {
        let plant = &harvester.kernel.plant;
        let modes = &plant.system.modes;
        let unknown = |name: &str, known: Vec<&String>| FitError::NoPlace {
            name: name.to_owned(),
            known: known.into_iter().cloned().collect::<Vec<_>>().join(", "),
        };
        let shape = |point: &String| {
            modes
                .shape
                .get(point)
                .ok_or_else(|| unknown(point, modes.shape.keys().collect()))
        };
        let projection = |shape: &'p Vec<f64>, first: usize| -> Reading<'p> {
            Box::new(move |x: &[f64]| shape.iter().zip(&x[first..]).map(|(s, q)| s * q).sum())
        };
        match &self.output {
            FrfOutput::Velocity(point) => Ok(projection(shape(point)?, modes.len())),
            FrfOutput::Voltage(patch) => {
                let patch_index = modes.patch.keys().position(|name| name == patch);
                let patch_index =
                    patch_index.ok_or_else(|| unknown(patch, modes.patch.keys().collect()))?;
                Ok(Box::new(move |x: &[f64]| {
                    plant.patch_voltages_v(x)[patch_index]
                }))
            }
            FrfOutput::Displacement(point) => Ok(projection(shape(point)?, 0)),
            other => Err(FitError::Features {
                faults: vec![format!("history: output is {}; {HISTORIES}", other.name())],
            }),
        }
    }
}
