//! Orbit of a point of a response, sampled over its period.

use crate::cancellation::Cancellation;
use crate::design::DesignFault;
use crate::frame::Frame;
use crate::session::{Session, Shapes};
use jounce_core::analysis::Parameter;
use jounce_core::continuation::{Corrector, Metric, Position, correct_at};
use jounce_core::integrate::TrajectoryState;
use jounce_core::orbit::{OrbitMethod, Shooting, ShootingEvaluation};
use jounce_core::plant::Plant;
use jounce_core::signal::{Samples, Window};
use serde_json::json;

/// Samples per drive cycle.
const SAMPLES_PER_CYCLE: usize = 480;
/// Largest number of samples of a period.
const MAX_SAMPLES: usize = 1920;
/// Frames of the beam motion in a period.
const FRAMES_PER_PERIOD: usize = 240;
/// Largest frequency of the spectrum, in orders of the drive.
const SHOWN_ORDERS: f64 = 12.0;
/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-9;

/// Sends the orbit of a point: index of the response, of the branch, of the point.
///
/// # Errors
/// [`DesignFault`]: the response is not stored, has no such point, or the orbit cannot be computed.
pub fn respond(
    session: &Session,
    id: u64,
    (answer, branch, point): (u64, usize, usize),
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let answered = session.answered(answer)?;
    let curve = answered
        .branches
        .get(branch)
        .and_then(|branch| Some((branch.period_cycles, branch.points.get(point)?)));
    let Some((cycles, point)) = curve else {
        return Err(DesignFault::Text(
            "this response has no such point; choose a point of its curves".to_owned(),
        ));
    };
    let base = session.prepared(&answered.spec, cancellation)?;
    let parameter = Parameter::new(&base, &answered.key, answered.range.1 - answered.range.0);
    let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
    let position = Position {
        unknown: point.orbit.start().to_vec(),
        parameter: point.parameter,
    };
    let metric = Metric::at(&position, 1.0);
    let found = correct_at(
        &shooting,
        &Corrector {
            goal: 50.0 * TOLERANCE,
            most: 10,
        },
        &metric,
        position,
    )?;
    let orbit = shooting.orbit(&found.local, found.error)?;

    let mut frame = Frame::new(id, "orbit", "done");
    frame
        .put("parameter", point.parameter)
        .put("over", answered.key.path())
        .put("unit", answered.key.unit());
    frame
        .put("period_cycles", cycles)
        .put("period_s", found.local.period_s);
    frame
        .put("mean_power_w", orbit.mean_power_w)
        .put("voltage_rms_v", orbit.voltage_rms_v)
        .put("contacts", orbit.contacts);
    frame
        .put("max_penetration_m", orbit.max_penetration_m)
        .put("stable", orbit.is_stable());
    frame
        .put("floquet_max_abs", orbit.floquet_max_abs())
        .put("error_estimate", orbit.error_estimate);
    frame.array(
        "multiplier.re",
        orbit.multipliers.iter().map(|value| value.re),
    );
    frame.array(
        "multiplier.im",
        orbit.multipliers.iter().map(|value| value.im),
    );
    put_histories(&mut frame, &found.local)?;
    put_pictures(&mut frame, &found.local, &session.shapes(&answered.spec)?);
    put_stops(&mut frame, &answered.spec, &found.local.kernel.plant);
    session.send(cancellation, frame);
    Ok(())
}

/// Returns the states at `samples` equally spaced times of the period.
fn sampled(shot: &ShootingEvaluation, samples: usize) -> Vec<TrajectoryState> {
    let cycle_s = shot.period_s / shot.trajectories.len() as f64;
    let per_cycle = samples / shot.trajectories.len();
    let times: Vec<f64> = (0..per_cycle)
        .map(|k| cycle_s * k as f64 / per_cycle as f64)
        .collect();
    shot.trajectories
        .iter()
        .flat_map(|trajectory| trajectory.at(&shot.kernel, &times))
        .collect()
}

/// Adds times, displacements towards the stops, velocities, forces, voltage and its spectrum.
fn put_histories(frame: &mut Frame, shot: &ShootingEvaluation) -> Result<(), DesignFault> {
    let plant = &shot.kernel.plant;
    let cycles = shot.trajectories.len();
    let per_cycle = SAMPLES_PER_CYCLE.min(MAX_SAMPLES / cycles).max(60);
    let instants = sampled(shot, per_cycle * cycles);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|at| plant.to_physical(&at.state, at.time_s))
        .collect();
    let step_s = shot.period_s / instants.len() as f64;
    let n = plant.system.modes.len();
    frame.array("time", (0..instants.len()).map(|k| step_s * k as f64));
    for (p, stop) in plant.system.stops.iter().enumerate() {
        let along = |state: &Vec<f64>, from: usize| {
            stop.shape
                .iter()
                .zip(&state[from..])
                .map(|(s, x)| s * x)
                .sum::<f64>()
        };
        frame.array(
            &format!("displacement.{p}"),
            states.iter().map(|state| along(state, 0)),
        );
        frame.array(
            &format!("velocity.{p}"),
            states.iter().map(|state| along(state, n)),
        );
        frame.array(
            &format!("force.{p}"),
            instants.iter().map(|at| at.forces_n[p]),
        );
    }
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
    if voltage.len() > 1 {
        let spectrum = Samples::new(&voltage, 1.0 / step_s)?.spectrum(Window::Rectangular);
        let highest = SHOWN_ORDERS * cycles as f64 / shot.period_s * 1.0001;
        let kept = spectrum
            .frequency_hz
            .iter()
            .take_while(|f| **f <= highest)
            .count();
        frame.array(
            "spectrum.frequency",
            spectrum.frequency_hz[..kept].iter().copied(),
        );
        frame.array(
            "spectrum.amplitude",
            spectrum.amplitude_peak[..kept].iter().copied(),
        );
    }
    frame.array("voltage", voltage);
    Ok(())
}

/// Adds the motion of the beams: displacement at each position, frame by frame.
fn put_pictures(frame: &mut Frame, shot: &ShootingEvaluation, shapes: &Shapes) {
    let plant = &shot.kernel.plant;
    let instants = sampled(shot, FRAMES_PER_PERIOD);
    let modes = plant.system.modes.len();
    let mut beams = Vec::new();
    for (name, beam) in shapes.iter() {
        beams.push(json!({ "name": name, "places": beam.place_m.len() }));
        frame.array(&format!("place.{name}"), beam.place_m.iter().copied());
        let picture = |at: &TrajectoryState| {
            let state = plant.to_physical(&at.state, at.time_s);
            let bent = |shape: &Vec<f64>| {
                shape
                    .iter()
                    .zip(&state[..modes])
                    .map(|(s, q)| s * q)
                    .sum::<f64>()
            };
            beam.shape.iter().map(bent).collect::<Vec<f64>>()
        };
        frame.array(&format!("motion.{name}"), instants.iter().flat_map(picture));
    }
    frame.put("beams", beams).put("pictures", instants.len());
}

/// Adds the positions of the stops.
fn put_stops(frame: &mut Frame, spec: &jounce_core::spec::Spec, plant: &Plant) {
    let listed = plant.system.stops.iter().map(|stop| {
        let own = spec.stop.get(&stop.name);
        let place = own.and_then(|own| {
            let (beam, point) = own.at.split_once('.')?;
            let length_m = spec.beam.get(beam)?.length_m;
            let place_m = match point {
                "root" => 0.0,
                "end" => length_m,
                _ => *spec.beam.get(beam)?.point.get(point)?,
            };
            Some(json!({ "beam": beam, "place": place_m }))
        });
        let above = own.is_none_or(|own| own.side == jounce_core::spec::Side::Positive);
        json!({ "name": stop.name, "gap": stop.gap_m, "at": place, "above": above, "frame": own.map(|own| own.frame.clone()) })
    });
    frame.put("stops", listed.collect::<Vec<_>>());
}
