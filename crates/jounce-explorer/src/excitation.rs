//! Response under noise, or under a recording dropped onto the page, in place of the first drive.

use crate::cancellation::Cancellation;
use crate::design::{Design, DesignFault};
use crate::frame::Frame;
use crate::request::ExcitationRequest;
use crate::session::Session;
use crate::upload::{Upload, read_upload};
use jounce_core::analysis::AnalysisError;
use jounce_core::integrate::Kernel;
use jounce_core::linear::Random;
use jounce_core::run::{RunPlan, RunResult, simulate};
use jounce_core::signal::{Samples, Window};
use jounce_core::spec::{DriveSignal, Spec, SpecFile};
use std::path::Path;

/// Length of a run under noise, s.
const NOISE_S: f64 = 60.0;
/// Fraction of the run that is averaged.
const AVERAGED_SHARE: f64 = 0.75;
/// Longest recording, s.
const MAX_DURATION_S: f64 = 3600.0;
/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-6;
/// Samples per second of histories and densities; fewer in a long run.
const RATE_HZ: f64 = 1000.0;
/// Largest number of samples.
const MAX_SAMPLES: f64 = 120_000.0;
/// Pairs of the smallest and the largest value in a history.
const HISTORY_PAIRS: usize = 900;
/// Frequency bands of a density.
const DENSITY_BANDS: usize = 300;

/// Integrates and sends powers, histories and the spectral density of the voltage.
///
/// # Errors
/// [`DesignFault`]: there is no drive to replace, or the spec does not allow the noise or the
/// recording.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    request: &ExcitationRequest,
    folder: &Path,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let temporary = tempfile::tempdir()?;
    let record = match request {
        ExcitationRequest::Recording {
            name,
            bytes,
            channel,
            ..
        } => Some(read_upload(
            name,
            bytes,
            channel.as_deref(),
            temporary.path(),
        )?),
        ExcitationRequest::Noise { .. } => None,
    };
    let mut spec = with_excitation(design, request, record.as_ref(), folder)?;
    let recording_duration_s = spec.drive.values().find_map(|drive| match &drive.signal {
        DriveSignal::Recording {
            record: Some(record),
            ..
        } => Some(record.duration_s()),
        _ => None,
    });
    let duration_s = recording_duration_s.unwrap_or(NOISE_S);
    if duration_s > MAX_DURATION_S {
        return Err(DesignFault::Text(format!(
            "the recording is {duration_s:.0} s long; drop one of at most {MAX_DURATION_S:.0} s"
        )));
    }
    let average_over_s = if recording_duration_s.is_some() {
        duration_s
    } else {
        AVERAGED_SHARE * duration_s
    };
    // The realisation of noise has the length of the run.
    (spec.run.duration_s, spec.run.average_over_s) = (duration_s, average_over_s);
    let base = session.model(&spec, cancellation)?;
    let start = base.start(folder)?;
    let kernel = base.from_state(&start)?;
    let plan = RunPlan {
        duration_s,
        average_over_s,
        tolerance: TOLERANCE,
        record_s: duration_s,
    };
    let result = simulate(&kernel, &start, &plan).map_err(AnalysisError::from)?;
    let mut frame = Frame::new(id, "shake", "done");
    frame
        .put("mean_power_w", result.mean_power_w)
        .put("contacts", result.contacts)
        .put("average_over_s", average_over_s);
    frame
        .put("max_penetration_m", result.max_penetration_m)
        .put("duration_s", duration_s);
    if let Some(record) = record {
        frame
            .put("channel", record.channel)
            .put("findings", record.issues);
    }
    if matches!(request, ExcitationRequest::Noise { .. }) {
        let linear = Random::new(&spec).and_then(|random| random.response());
        frame.put(
            "linear_power_w",
            linear.map_or(f64::NAN, |result| result.mean_power_w),
        );
    }
    put_histories(&mut frame, &kernel, &result, duration_s)?;
    session.send(cancellation, frame);
    Ok(())
}

/// Returns the spec with noise or the recording in place of its first drive, after the same checks
/// as any spec.
fn with_excitation(
    design: &Design,
    request: &ExcitationRequest,
    record: Option<&Upload>,
    folder: &Path,
) -> Result<Spec, DesignFault> {
    let mut spec = design.spec.clone();
    let recording = record.map_or_else(String::new, |record| record.file.display().to_string());
    for drive in spec.drive.values_mut() {
        if let DriveSignal::Recording { file, .. } = &mut drive.signal {
            *file = folder.canonicalize()?.join(&*file).display().to_string();
        }
    }
    let Some(drive) = spec.drive.values_mut().next() else {
        return Err(DesignFault::Text(
            "this design has no drive; add [drive.NAME] to the spec".to_owned(),
        ));
    };
    drive.signal = match *request {
        ExcitationRequest::Noise {
            density,
            low_hz,
            high_hz,
        } => DriveSignal::Noise {
            density,
            low_hz,
            high_hz,
            sample_rate_hz: None,
            seed: 1,
        },
        ExcitationRequest::Recording { scale, .. } => {
            let mut signal = DriveSignal::recording(&recording);
            if let DriveSignal::Recording {
                scale: factor,
                keep_mean,
                ..
            } = &mut signal
            {
                (*factor, *keep_mean) = (scale, Some(true));
            }
            signal
        }
    };
    let checked_spec = SpecFile::from_text(spec.to_toml()).spec();
    checked_spec.map_err(|faults| {
        // The page knows the recording by its own name, and not the text that was checked here.
        let messages = faults.as_slice().iter().map(|fault| match request {
            ExcitationRequest::Recording { name, .. } => fault.message.replace(&recording, name),
            ExcitationRequest::Noise { .. } => fault.message.clone(),
        });
        DesignFault::Text(messages.collect::<Vec<_>>().join("; "))
    })
}

/// Adds voltage and displacement in pairs of extremes, and the spectral density of the voltage in
/// bands.
fn put_histories(
    frame: &mut Frame,
    kernel: &Kernel,
    result: &RunResult,
    duration_s: f64,
) -> Result<(), DesignFault> {
    let plant = &kernel.plant;
    let rate_hz = RATE_HZ.min(MAX_SAMPLES / duration_s);
    let count = (duration_s * rate_hz) as usize;
    let time_s: Vec<f64> = (0..count).map(|k| k as f64 / rate_hz).collect();
    let instants = result.trajectory.at(kernel, &time_s);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|instant| plant.to_physical(&instant.state, instant.time_s))
        .collect();
    let voltage: Vec<f64> = states
        .iter()
        .map(|state| {
            plant
                .patch_voltages_v(state)
                .first()
                .copied()
                .unwrap_or(0.0)
        })
        .collect();
    put_history(frame, "voltage", &time_s, &voltage);
    if let Some(stop) = plant.system.stops.first() {
        let displacement: Vec<f64> = states
            .iter()
            .map(|state| stop.shape.iter().zip(state).map(|(s, x)| s * x).sum())
            .collect();
        put_history(frame, "displacement", &time_s, &displacement);
        frame.put("gap_m", stop.gap_m);
    }
    if count > 2 * DENSITY_BANDS {
        let density = Samples::new(&voltage, rate_hz)?.density(Window::Hann);
        let chunk_length = density.len() / DENSITY_BANDS;
        let bands = density
            .chunks_exact(chunk_length)
            .map(|band| band.iter().sum::<f64>() / chunk_length as f64);
        frame.array("density.value", bands);
        frame.array(
            "density.frequency",
            (0..density.len() / chunk_length)
                .map(|k| (k as f64 + 0.5) * chunk_length as f64 / duration_s),
        );
    }
    Ok(())
}

fn put_history(frame: &mut Frame, name: &str, time_s: &[f64], values: &[f64]) {
    let chunk_length = values.len().div_ceil(HISTORY_PAIRS).max(1);
    let extremes = |chunk: &[f64]| {
        chunk
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (low.min(*v), high.max(*v))
            })
    };
    frame.array(
        &format!("{name}.time"),
        time_s
            .chunks(chunk_length)
            .flat_map(|chunk| [chunk[0], chunk[0]]),
    );
    frame.array(
        &format!("{name}.value"),
        values
            .chunks(chunk_length)
            .map(extremes)
            .flat_map(|(low, high)| [low, high]),
    );
}
