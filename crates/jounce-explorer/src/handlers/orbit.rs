//! Orbit of a point of a response or of an attractor.

use crate::session::Session;
use crate::session::cancellation::Cancellation;
use crate::session::fault::RequestFault;
use crate::session::frame::Frame;
use jounce::Error;
use jounce::live::{BeamMotion, OrbitPlace, OrbitResult, OrbitStop, PlateMotion};
use serde_json::{Value, json};

/// Sends the orbit of a point or of an attractor.
///
/// # Errors
/// [`RequestFault`]: the response or the attractors are not stored, have no such point or
/// orbit, or the orbit cannot be computed.
pub fn respond(
    session: &Session,
    id: u64,
    place: &OrbitPlace,
    cancellation: &Cancellation,
) -> Result<(), RequestFault> {
    let orbit = session.analysis.orbit(place, cancellation.control())?;
    let mut frame = Frame::new(id, "orbit", "done");
    put_head(&mut frame, &orbit);
    let plates = orbit.plates.iter().map(plate);
    frame.put("plates", plates.collect::<Result<Vec<_>, _>>()?);
    let multipliers = &orbit.multipliers;
    frame
        .array("multiplier.re", multipliers.iter().map(|(re, _)| *re))
        .array("multiplier.im", multipliers.iter().map(|(_, im)| *im));
    put_histories(&mut frame, &orbit);
    for beam in &orbit.beams {
        frame
            .list(&format!("place.{}", beam.name), &beam.position_m)
            .list(&format!("motion.{}", beam.name), &beam.displacement_m);
    }
    session.send(cancellation, frame);
    Ok(())
}

fn put_head(frame: &mut Frame, orbit: &OrbitResult) {
    let beam = |own: &BeamMotion| json!({ "name": own.name, "places": own.position_m.len() });
    frame
        .put("period_cycles", orbit.period_cycles)
        .put("period_s", orbit.period_s)
        .put("mean_power_w", orbit.mean_power_w)
        .put("voltage_rms_v", orbit.voltage_rms_v)
        .put("contacts", orbit.contacts)
        .put("max_penetration_m", orbit.max_penetration_m)
        .put("stable", orbit.stable)
        .put("bifurcation", orbit.bifurcation)
        .put("section", json!(orbit.section))
        .put("is_at_stability_limit", orbit.is_at_stability_limit)
        .put("floquet_max_abs", orbit.floquet_max_abs)
        .put("error_estimate", orbit.error_estimate)
        .put("beams", orbit.beams.iter().map(beam).collect::<Vec<_>>())
        .put("attractors", json!(orbit.attractors))
        .put("limits", json!(orbit.limits))
        .put("warnings", json!(orbit.warnings))
        .put("pictures", orbit.frames)
        .put("stops", orbit.stops.iter().map(stop).collect::<Vec<_>>());
}

fn plate(own: &PlateMotion) -> Result<Value, Error> {
    let largest_m = own.max_displacement_m();
    Ok(json!({ "name": own.name, "largest": largest_m, "pictures": own.pictures()? }))
}

fn put_histories(frame: &mut Frame, orbit: &OrbitResult) {
    frame.list("time", &orbit.time_s);
    for (number, stop) in orbit.stops.iter().enumerate() {
        frame
            .list(&format!("displacement.{number}"), &stop.displacement_m)
            .list(&format!("velocity.{number}"), &stop.velocity_m_s)
            .list(&format!("force.{number}"), &stop.force_n);
    }
    frame.list("contact.time", &orbit.forces.time_s);
    for (number, force_n) in orbit.forces.force_n.iter().enumerate() {
        frame.list(&format!("contact.force.{number}"), force_n);
    }
    frame
        .list("spectrum.frequency", &orbit.spectrum_frequency_hz)
        .list("spectrum.amplitude", &orbit.spectrum_amplitude_peak_v)
        .list("voltage", &orbit.voltage_v);
}

fn stop(own: &OrbitStop) -> Value {
    let place = own.place.as_ref();
    let at = place.map(|(beam, position_m)| json!({ "beam": beam, "place": position_m }));
    json!({ "name": own.name, "gap": own.gap_m, "at": at, "above": own.above, "frame": own.frame })
}
