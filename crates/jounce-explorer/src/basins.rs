//! Basins of attraction: a plane of initial displacements and velocities at the drive of the
//! design.

use crate::cancellation::Cancellation;
use crate::design::{Design, DesignFault};
use crate::frame::Frame;
use crate::session::Session;
use jounce_core::analysis::{
    Basins, Grid, GridAxis, GridSide, InitialStates, Parameter, Recognition, SectionPoint,
};
use jounce_core::orbit::ParametricModel;
use serde_json::json;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Half width of the plane, in sizes of the motion (steady amplitude or gap).
const HALF_WIDTH: f64 = 5.0;
/// Largest number of values on a side.
const MAX_SIDE_VALUES: usize = 81;
/// Tolerance of the integrations.
const TOLERANCE: f64 = 1e-6;

/// Sends the attractors with their basin fractions, and the attractor of each start.
///
/// # Errors
/// [`DesignFault`].
pub fn respond(
    session: &Session,
    id: u64,
    design: &Design,
    side: usize,
    cancellation: &Cancellation,
) -> Result<(), DesignFault> {
    let base = session.model(&design.spec, cancellation)?;
    let sine = design
        .spec
        .drive
        .iter()
        .find_map(|(name, drive)| Some((name, drive.frequency_hz()?)));
    let Some((name, value)) = sine else {
        return Err(DesignFault::Text(
            "basins need a drive of one frequency: give a drive a frequency".to_owned(),
        ));
    };
    let key = design.key(&format!("drive.{name}.frequency"))?;
    let parameter = Parameter::new(&base, &key, value);
    // Returns the specific error of a design whose orbits cannot be followed.
    parameter.at(value)?;
    let plant = &base.kernel.plant;
    let Some(tone) = plant.tones.first().filter(|_| !plant.ports.is_empty()) else {
        return Err(DesignFault::Text(
            "basins need a stop and a drive: add the missing one to the spec".to_owned(),
        ));
    };
    let max_displacement_m = HALF_WIDTH * plant.scale_m();
    let max_velocity_m_s = max_displacement_m * tone.angular_frequency_rad_s;
    let count = side.clamp(2, MAX_SIDE_VALUES);
    let axis = |axis, half_width: f64| GridSide {
        axis,
        from: -half_width,
        to: half_width,
        count,
    };
    let starts = InitialStates::Grid(Grid {
        sides: vec![
            axis(GridAxis::Displacement, max_displacement_m),
            axis(GridAxis::Velocity, max_velocity_m_s),
        ],
    });
    let study = Basins {
        base: &base,
        parameter: &parameter,
        value,
        starts,
        recognition: Recognition::at(TOLERANCE),
    };
    let (total, completed_runs, start_time) =
        (study.starts.len(), AtomicUsize::new(0), Instant::now());
    let result = study.run(&|| {
        let completed = 1 + completed_runs.fetch_add(1, Ordering::Relaxed);
        let mut frame = Frame::new(id, "basins", "progress");
        frame
            .put("done", completed)
            .put("of", total)
            .put("seconds", start_time.elapsed().as_secs_f64());
        session.try_send(cancellation, frame);
    })?;
    let points: Vec<SectionPoint> = (0..total)
        .map(|index| SectionPoint::of(&plant.system, &study.starts.start(plant, index)))
        .collect();
    let attractor_index = |index: usize| {
        result
            .attractors
            .iter()
            .position(|a| a.starts.contains(&index))
            .map_or(-1.0, |k| k as f64)
    };
    let mut frame = Frame::new(id, "basins", "done");
    let attractors: Vec<_> = (result.attractors.iter())
        .map(|a| {
            json!({
                "id": a.id, "period_cycles": a.period_cycles, "mean_power_w": a.mean_power_w, "contacts": a.contacts_per_period,
                "fraction": a.share.fraction, "low": a.share.low, "high": a.share.high,
            })
        })
        .collect();
    frame
        .put("attractors", attractors)
        .put("lost", result.lost.len())
        .put("side", count)
        .put("frequency_hz", value);
    frame
        .put("expected_power_w", result.expected_power_w)
        .put("expected_power_low_w", result.expected_power_low_w);
    frame.put("expected_power_high_w", result.expected_power_high_w);
    frame.array(
        "displacement",
        points.iter().map(|point| point.displacement_m),
    );
    frame.array(
        "velocity",
        points.iter().map(|point| point.velocity_m_per_s),
    );
    frame.array("home", (0..total).map(attractor_index));
    session.send(cancellation, frame);
    Ok(())
}
