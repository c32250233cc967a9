//! Analysis of the recordings of each location of the input.

use jounce_signal::spectral::{
    ImpactHit, ImpactRecord, ImpactResponses, ImpactSettings, SpectralError, impact,
};
use jounce_signal::{Samples, SignalError};

use super::excitation::input;
use super::forces::ReferenceRecords;
use super::{ChannelChoice, ResponseError};
use jounce_data::recording::{Channel, Issue, IssueKind, Recording};

/// Responses of the recordings of each location. Unless a length is given, blocks have the shortest
/// length of any location.
pub(super) fn analyse_references(
    forces: &[ReferenceRecords<'_>],
    choice: &ChannelChoice,
    outputs: &[String],
    settings: &ImpactSettings,
) -> Result<Vec<ImpactResponses>, ResponseError> {
    let analyse = |force: &ReferenceRecords<'_>,
                   settings: &ImpactSettings|
     -> Result<ImpactResponses, ResponseError> {
        let blocks = force
            .records
            .iter()
            .map(|(_, record)| impact_record(record, choice, outputs))
            .collect::<Result<Vec<_>, _>>()?;
        Ok(impact(&blocks, settings)?)
    };
    let rates = forces
        .iter()
        .filter_map(|force| force.records.first())
        .map(|(_, record)| record.rate())
        .collect::<Vec<f64>>();
    if let Some(other_hz) = rates
        .iter()
        .copied()
        .find(|rate| (rate / rates[0] - 1.0).abs() > 1e-6)
    {
        return Err(ResponseError::Spectral(SpectralError::Rates {
            first_hz: rates[0],
            other_hz,
        }));
    }
    let found = forces
        .iter()
        .map(|force| analyse(force, settings))
        .collect::<Result<Vec<_>, _>>()?;
    let least_block_s = found
        .iter()
        .map(|analyse| analyse.block_s)
        .fold(f64::INFINITY, f64::min);
    let settings = ImpactSettings {
        block_s: Some(least_block_s),
        ..*settings
    };
    let with_common_block = |(force, found): (&ReferenceRecords<'_>, ImpactResponses)| {
        // Only lengths of whole samples differ by more than roundoff.
        let has_common_block = (found.block_s - least_block_s) * rates[0] < 0.5;
        if has_common_block {
            Ok(found)
        } else {
            analyse(force, &settings)
        }
    };
    forces.iter().zip(found).map(with_common_block).collect()
}

/// Hits of all locations, each with the index of its record, in the order of the records.
pub(super) fn in_order(
    forces: &[ReferenceRecords<'_>],
    results: &[ImpactResponses],
) -> Vec<ImpactHit> {
    let hits_of = |(force, result): (&ReferenceRecords<'_>, &ImpactResponses)| {
        let with_record_index = |hit: &ImpactHit| ImpactHit {
            record: force.records[hit.record].0,
            ..hit.clone()
        };
        result
            .hits
            .iter()
            .map(with_record_index)
            .collect::<Vec<_>>()
    };
    let mut hits: Vec<ImpactHit> = forces.iter().zip(results).flat_map(hits_of).collect();
    hits.sort_by_key(|hit| hit.record);
    hits
}

/// Reports how a sweep affects its blocks.
pub(super) fn sweep_issue(settings: &ImpactSettings, block_s: f64) -> Issue {
    let message = match settings.block_s {
        None => format!(
            "the force is a sweep: each recording is one block of {block_s:.4} s without a \
            window, and the coherence of a single block has no meaning"
        ),
        Some(_) => format!(
            "the force is a sweep and drives each line in only a few blocks of {block_s:.4} s: \
            peaks are underestimated; omit the block length, then each recording is one block"
        ),
    };
    Issue::new(IssueKind::Assumed, 1, None, message)
}

fn impact_record<'a>(
    recording: &'a Recording,
    choice: &ChannelChoice,
    names: &[String],
) -> Result<ImpactRecord<'a>, ResponseError> {
    let signal_error = |fault: SignalError| ResponseError::Spectral(SpectralError::Signal(fault));
    let samples = |channel: &'a Channel| {
        Samples::new(&channel.values, recording.rate()).map_err(signal_error)
    };
    let responses = names
        .iter()
        .map(|name| samples(recording.channel(name)?))
        .collect::<Result<_, _>>()?;
    Ok(ImpactRecord {
        force: samples(input(recording, choice)?)?,
        responses,
    })
}
