//! Response under the drives of the spec, or under noise or a recording in place of the first one.

use super::progress::with_progress;
use super::upload::write_channel;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use crate::session::request::ExcitationRequest;
use jounce::Error;
use jounce::live::{ChannelFile, Design, Excitation, ExcitationResult};
use std::path::Path;

/// Sends powers, histories and the spectral density of the voltage.
///
/// # Errors
/// [`RequestFault`]: there is no drive to replace, or the spec does not allow the noise or the
/// recording.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    request: &ExcitationRequest,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let temporary = tempfile::tempdir()?;
    let (excitation, channel) = excitation(request, temporary.path())?;
    let outcome = with_progress(session, (id, "shake"), cancellation, || {
        let control = cancellation.control();
        session.analysis.excite(design, &excitation, control)
    });
    let result = outcome.map_err(|error| named(error, request, &excitation))?;
    let mut frame = Frame::new(id, "shake", "done");
    frame
        .put("mean_power_w", result.mean_power_w)
        .put("contacts", result.contacts)
        .put("average_over_s", result.average_over_s)
        .put("max_penetration_m", result.max_penetration_m)
        .put("duration_s", result.duration_s)
        .put("linear_power_w", result.linear_power_w);
    let messages = result.warnings.iter().map(ToString::to_string);
    frame.put("warnings", messages.collect::<Vec<_>>());
    if let Some(channel) = channel {
        frame
            .put("channel", channel.channel)
            .put("issues", channel.issues);
    }
    put_histories(&mut frame, &result);
    session.send(cancellation, frame);
    Ok(())
}

/// Returns the excitation of a request; its recording is written into a folder.
fn excitation(
    request: &ExcitationRequest,
    folder: &Path,
) -> Result<(Excitation, Option<ChannelFile>), RequestFault> {
    match request {
        ExcitationRequest::Spec => Ok((Excitation::OfSpec, None)),
        &ExcitationRequest::Noise {
            density,
            low_hz,
            high_hz,
        } => {
            let noise = Excitation::Noise {
                density,
                low_hz,
                high_hz,
            };
            Ok((noise, None))
        }
        ExcitationRequest::Recording {
            name,
            bytes,
            channel,
            scale,
        } => {
            let (file, channel) = write_channel(name, bytes, channel.as_deref(), folder)?;
            let scale = *scale;
            Ok((Excitation::Recording { file, scale }, Some(channel)))
        }
    }
}

/// Returns an error for the page, which knows the recording by its own name, and not the text that
/// was checked.
fn named(error: Error, request: &ExcitationRequest, excitation: &Excitation) -> RequestFault {
    let Error::Spec(faults) = &error else {
        return error.into();
    };
    let messages = faults
        .as_slice()
        .iter()
        .map(|fault| match (request, excitation) {
            (ExcitationRequest::Recording { name, .. }, Excitation::Recording { file, .. }) => {
                fault.message.replace(&file.display().to_string(), name)
            }
            _ => fault.message.clone(),
        });
    RequestFault::Text(messages.collect::<Vec<_>>().join("; "))
}

fn put_histories(frame: &mut Frame, result: &ExcitationResult) {
    frame
        .list("voltage.time", &result.voltage.time_s)
        .list("voltage.value", &result.voltage.value);
    if let Some(displacement) = &result.displacement {
        frame
            .list("displacement.time", &displacement.time_s)
            .list("displacement.value", &displacement.value)
            .put("gap_m", result.gap_m);
    }
    if let Some(density) = &result.density {
        frame
            .list("density.value", &density.value)
            .list("density.frequency", &density.frequency_hz);
    }
}
