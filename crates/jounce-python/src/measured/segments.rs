//! Segmentation of a long record into steady-state responses.

use super::recording::{RecordingInput, findings};
use crate::arrays::PythonDict;
use crate::branch::json;
use crate::cancellable::{cancellable, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::integrate::Control;
use jounce_core::signal::Samples;
use jounce_measure::recording::{Channel, Quantity, Recording};
use jounce_measure::segmentation::{SegmentMatches, Segmentation, match_segments, regimes_watched};
use jounce_measure::solution::{Solution, SolutionSearch, as_recorded, solutions};
use jounce_measure::spectral::{MeanPower, mean_power_if_long};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Options of the search and comparison of the solutions of a model.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct ModelComparison {
    starts: usize,
    seed: u64,
    load: Option<String>,
    within: f64,
}

/// Result of a segmentation.
struct SegmentationData {
    channel: Channel,
    segmentation: Segmentation,
    /// `None` where a segment is too short for an interval; empty without a resistance.
    powers: Vec<Option<MeanPower>>,
    matches: Vec<SegmentMatches>,
}

/// Segments a channel under a drive. Returns the mean power of each segment where the channel is
/// the voltage of a resistance, and the matching solutions where a model is given.
#[pyfunction]
pub fn measured_regimes<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    drive_hz: f64,
    channel: Option<String>,
    resistance_ohm: Option<f64>,
    model: Option<&Spec>,
    comparison: ModelComparison,
) -> PythonResult<'py> {
    let record = recording.even()?;
    let outcome = cancellable(py, None, |control| {
        let channel = match &channel {
            // Any quantity can be segmented; only a voltage has a power.
            Some(name) if resistance_ohm.is_none() => record.channel(name)?,
            name => record.choose(name.as_deref(), Quantity::Voltage)?,
        };
        let segmentation = regimes_watched(
            &Samples::new(&channel.values, record.rate())?,
            drive_hz,
            control,
        )?;
        let mut powers = Vec::new();
        for segment in segmentation
            .stretches
            .iter()
            .filter(|_| resistance_ohm.is_some())
        {
            let samples_of_segment =
                Samples::new(&channel.values[segment.start..segment.end], record.rate())?;
            powers.push(mean_power_if_long(
                &samples_of_segment,
                resistance_ohm.unwrap_or(f64::NAN),
                false,
            )?);
        }
        let samples = Samples::new(&channel.values, record.rate())?;
        let matches = match model {
            None => Vec::new(),
            Some(model) => {
                let known_solutions =
                    comparison.solutions(model, drive_hz, resistance_ohm, control)?;
                segmentation
                    .stretches
                    .iter()
                    .map(|segment| {
                        match_segments(
                            &samples,
                            drive_hz,
                            segment,
                            &known_solutions,
                            comparison.within,
                        )
                    })
                    .collect()
            }
        };
        Ok::<_, Failure>(SegmentationData {
            channel: channel.clone(),
            segmentation,
            powers,
            matches,
        })
    });
    to_python_result(py, outcome, |data| into_python(py, &record, data))
}

impl ModelComparison {
    /// Returns the solutions of a model at the drive and the load of a record.
    fn solutions(
        &self,
        model: &Spec,
        drive_hz: f64,
        resistance_ohm: Option<f64>,
        control: &Control,
    ) -> Result<Vec<Solution>, Failure> {
        if !(self.within > 0.0 && self.within <= 1.0) || self.starts == 0 {
            let reason = format!(
                "within is {} and starts {}; within must be above 0 and at most 1, starts above 0",
                self.within, self.starts
            );
            let details = serde_json::json!({ "within": self.within, "starts": self.starts });
            return Err(Failure::new("ArgumentError", reason).with(details));
        }
        let mut spec = model.spec().clone();
        as_recorded(&mut spec, drive_hz, resistance_ohm, self.load.as_deref());
        let search = SolutionSearch {
            starts: self.starts,
            seed: self.seed,
            load: self.load.clone(),
            ..SolutionSearch::default()
        };
        let known_solutions = solutions(&spec, &search, control)?;
        // A stopped search is incomplete.
        Failure::unless_stopped(control, known_solutions)
    }
}

fn into_python<'py>(
    py: Python<'py>,
    record: &Recording,
    data: SegmentationData,
) -> PyResult<Bound<'py, PyDict>> {
    let SegmentationData {
        channel,
        segmentation,
        powers,
        matches,
    } = data;
    let dict = PythonDict::new(py)
        .with("channel", channel.name)?
        .with("unit", channel.unit)?
        .with("uncertainty_s", segmentation.uncertainty_s)?
        .with("stretches", json(&segmentation.stretches)?)?
        .with("joints", json(&segmentation.joints)?)?
        .with("powers", json(&powers)?)?
        .with("correspondences", json(&matches)?)?
        .array("time_s", record.grid.places())?
        .array("values", channel.values)?
        .with("findings", findings(&record.findings)?)?;
    Ok(dict.dict())
}
