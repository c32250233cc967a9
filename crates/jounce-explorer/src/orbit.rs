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
const MAX_SPECTRUM_ORDER: f64 = 12.0;
/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-9;

/// Sends the orbit of a point: index of the response, of the branch, of the point.
///
/// # Errors
/// [`DesignFault`]: the response is not stored, has no such point, or the orbit cannot be computed.
pub fn respond(
    session: &Session,
    id: u64,
    (response_id, branch, point): (u64, usize, usize),
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let response = session.stored_response(response_id)?;
    let curve = response
        .branches
        .get(branch)
        .and_then(|branch| Some((branch.period_cycles, branch.points.get(point)?)));
    let Some((cycles, point)) = curve else {
        return Err(DesignFault::Text(
            "this response has no such point; choose a point of its curves".to_owned(),
        ));
    };
    let base = session.model(&response.spec, cancellation)?;
    let parameter = Parameter::new(&base, &response.key, response.range.1 - response.range.0);
    let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
    let position = Position {
        unknown: point.orbit.start().to_vec(),
        parameter: point.parameter,
    };
    let metric = Metric::at(&position, 1.0);
    let solution = correct_at(
        &shooting,
        &Corrector {
            goal: 50.0 * TOLERANCE,
            most: 10,
        },
        &metric,
        position,
    )?;
    let orbit = shooting.orbit(&solution.local, solution.error)?;

    let mut frame = Frame::new(id, "orbit", "done");
    frame
        .put("parameter", point.parameter)
        .put("over", response.key.path())
        .put("unit", response.key.unit());
    frame
        .put("period_cycles", cycles)
        .put("period_s", solution.local.period_s);
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
    put_histories(&mut frame, &solution.local)?;
    put_beam_motion(
        &mut frame,
        &solution.local,
        &session.shapes(&response.spec)?,
    );
    put_stops(&mut frame, &response.spec, &solution.local.kernel.plant);
    session.send(cancellation, frame);
    Ok(())
}

/// Returns the states at `samples` equally spaced times of the period.
fn sample_states(evaluation: &ShootingEvaluation, samples: usize) -> Vec<TrajectoryState> {
    let cycle_s = evaluation.period_s / evaluation.trajectories.len() as f64;
    let samples_per_cycle = samples / evaluation.trajectories.len();
    let times: Vec<f64> = (0..samples_per_cycle)
        .map(|k| cycle_s * k as f64 / samples_per_cycle as f64)
        .collect();
    evaluation
        .trajectories
        .iter()
        .flat_map(|trajectory| trajectory.at(&evaluation.kernel, &times))
        .collect()
}

/// Adds times, displacements towards the stops, velocities, forces, voltage and its spectrum.
fn put_histories(frame: &mut Frame, evaluation: &ShootingEvaluation) -> Result<(), DesignFault> {
    let plant = &evaluation.kernel.plant;
    let cycles = evaluation.trajectories.len();
    let samples_per_cycle = SAMPLES_PER_CYCLE.min(MAX_SAMPLES / cycles).max(60);
    let instants = sample_states(evaluation, samples_per_cycle * cycles);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|instant| plant.to_physical(&instant.state, instant.time_s))
        .collect();
    let step_s = evaluation.period_s / instants.len() as f64;
    let n = plant.system.modes.len();
    frame.array("time", (0..instants.len()).map(|k| step_s * k as f64));
    for (p, stop) in plant.system.stops.iter().enumerate() {
        let project = |state: &Vec<f64>, from: usize| {
            stop.shape
                .iter()
                .zip(&state[from..])
                .map(|(s, x)| s * x)
                .sum::<f64>()
        };
        frame.array(
            &format!("displacement.{p}"),
            states.iter().map(|state| project(state, 0)),
        );
        frame.array(
            &format!("velocity.{p}"),
            states.iter().map(|state| project(state, n)),
        );
        frame.array(
            &format!("force.{p}"),
            instants.iter().map(|instant| instant.forces_n[p]),
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
        let max_frequency_hz = MAX_SPECTRUM_ORDER * cycles as f64 / evaluation.period_s * 1.0001;
        let count = spectrum
            .frequency_hz
            .iter()
            .take_while(|f| **f <= max_frequency_hz)
            .count();
        frame.array(
            "spectrum.frequency",
            spectrum.frequency_hz[..count].iter().copied(),
        );
        frame.array(
            "spectrum.amplitude",
            spectrum.amplitude_peak[..count].iter().copied(),
        );
    }
    frame.array("voltage", voltage);
    Ok(())
}

/// Adds the motion of the beams: displacement at each position, frame by frame.
fn put_beam_motion(frame: &mut Frame, evaluation: &ShootingEvaluation, shapes: &Shapes) {
    let plant = &evaluation.kernel.plant;
    let instants = sample_states(evaluation, FRAMES_PER_PERIOD);
    let modes = plant.system.modes.len();
    let mut beams = Vec::new();
    for (name, beam) in shapes.iter() {
        beams.push(json!({ "name": name, "places": beam.place_m.len() }));
        frame.array(&format!("place.{name}"), beam.place_m.iter().copied());
        let beam_frame = |instant: &TrajectoryState| {
            let state = plant.to_physical(&instant.state, instant.time_s);
            let deflection = |shape: &Vec<f64>| {
                shape
                    .iter()
                    .zip(&state[..modes])
                    .map(|(s, q)| s * q)
                    .sum::<f64>()
            };
            beam.shape.iter().map(deflection).collect::<Vec<f64>>()
        };
        frame.array(
            &format!("motion.{name}"),
            instants.iter().flat_map(beam_frame),
        );
    }
    frame.put("beams", beams).put("pictures", instants.len());
}

/// Adds the positions of the stops.
fn put_stops(frame: &mut Frame, spec: &jounce_core::spec::Spec, plant: &Plant) {
    let stops = plant.system.stops.iter().map(|stop| {
        let stop_spec = spec.stop.get(&stop.name);
        let position = stop_spec.and_then(|stop_spec| {
            let (beam, point) = stop_spec.at.split_once('.')?;
            let length_m = spec.beam.get(beam)?.length_m;
            let position_m = match point {
                "root" => 0.0,
                "end" => length_m,
                _ => *spec.beam.get(beam)?.point.get(point)?,
            };
            Some(json!({ "beam": beam, "place": position_m }))
        });
        let above = stop_spec.is_none_or(|stop_spec| stop_spec.side == jounce_core::spec::Side::Positive);
        json!({ "name": stop.name, "gap": stop.gap_m, "at": position, "above": above, "frame": stop_spec.map(|stop_spec| stop_spec.frame.clone()) })
    });
    frame.put("stops", stops.collect::<Vec<_>>());
}
