//! Response over a key: first the branches near those of the previous design, then all branches
//! that `jounce branch` finds.

use super::progress::with_progress;
use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::live::{
    Design, KeySpan, ResponseBifurcation, ResponseBranch, ResponseOptions, ResponseResult,
};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Time without slider movement before the fine response begins.
const SLIDER_REST: Duration = Duration::from_millis(120);
/// Time between two checks for a newer position of the slider.
const POLL_INTERVAL: Duration = Duration::from_millis(5);

/// Sends the harvester without contact, the coarse and the fine response, then peak and bandwidth.
///
/// # Errors
/// [`RequestFault`]: faults of the range or of the harvester.
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    (span, options): (&KeySpan, &ResponseOptions),
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let (analysis, control) = (&session.analysis, cancellation.control());
    let start_time = Instant::now();
    if let Some(first) = analysis.first_response(design, span, control)? {
        session.send(cancellation, frame(id, "first", &first, start_time));
    }
    let coarse = analysis.coarse_response(id, design, span, options, control)?;
    session.send(cancellation, frame(id, "coarse", &coarse, start_time));

    let rest_start = Instant::now();
    while rest_start.elapsed() < SLIDER_REST && !cancellation.is_stopped() {
        std::thread::sleep(POLL_INTERVAL);
    }
    if cancellation.is_stopped() {
        return Ok(());
    }
    let start_time = Instant::now();
    let fine = with_progress(session, (id, "response"), cancellation, || {
        analysis.fine_response(id, design, span, options, control)
    })?;
    session.send(cancellation, frame(id, "fine", &fine, start_time));
    if cancellation.is_stopped() || fine.branches.is_empty() {
        return Ok(());
    }
    let bandwidth = analysis.bandwidth(id, options, control)?;
    let mut frame = Frame::new(id, "response", "widths");
    if let Some(bandwidth) = bandwidth {
        frame
            .put("peak", json!(bandwidth.peak))
            .put("intervals", json!(bandwidth.intervals))
            .put("width", bandwidth.width);
    }
    session.send(cancellation, frame);
    Ok(())
}

fn frame(id: u64, stage: &str, response: &ResponseResult, start_time: Instant) -> Frame {
    let mut frame = Frame::new(id, "response", stage);
    frame
        .put("over", response.over.as_str())
        .put("unit", response.unit.as_str())
        .put("storage", response.is_storage_voltage)
        .put("patches", response.patches)
        .put("note", json!(response.note))
        .put("draft", json!(response.draft))
        .put("ms", 1e3 * start_time.elapsed().as_secs_f64());
    frame.curve("linear", &response.linear);
    for (index, branch) in response.branches.iter().enumerate() {
        put_branch(&mut frame, index, branch);
    }
    let branch =
        |own: &ResponseBranch| json!({ "period": own.period_cycles, "endings": own.endings });
    frame
        .put(
            "branches",
            response.branches.iter().map(branch).collect::<Vec<_>>(),
        )
        .put(
            "bifurcations",
            response
                .bifurcations
                .iter()
                .map(bifurcation)
                .collect::<Vec<_>>(),
        );
    frame
}

fn put_branch(frame: &mut Frame, index: usize, branch: &ResponseBranch) {
    let lists = [
        ("x", &branch.parameter),
        ("power", &branch.mean_power_w),
        ("voltage", &branch.voltage_rms_v),
        ("penetration", &branch.max_penetration_m),
        ("force", &branch.max_contact_force_n),
        ("impact", &branch.max_impact_velocity_m_s),
        ("displacement", &branch.displacement_peak_m),
        ("floquet", &branch.floquet_max_abs),
        ("error", &branch.line_error),
    ];
    for (name, list) in lists {
        frame.array(&format!("{index}.{name}"), list.iter().copied());
    }
    let contacts = branch.contacts.iter().map(|contacts| *contacts as f64);
    frame.array(&format!("{index}.contacts"), contacts);
}

fn bifurcation(own: &ResponseBifurcation) -> Value {
    json!({
        "branch": own.branch, "kind": own.kind, "x": own.parameter, "power": own.mean_power_w,
        "voltage": own.voltage_rms_v, "penetration": own.max_penetration_m, "floquet": own.floquet_max_abs,
        "force": own.max_contact_force_n, "impact": own.max_impact_velocity_m_s, "displacement": own.displacement_peak_m,
        "contacts": own.contacts,
    })
}
