//! Run of a harvester by the library.

use super::independent::{AT_START, Contact};
use super::system::Drawn;
use super::verdict::Verdict;
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_control::Control;
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::contact::Law;
use jounce_model::plant::System;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A run of the library.
pub struct LibraryRun {
    pub result: RunResult,
    /// Contacts of each stop that begin after the start.
    pub contacts: Vec<Vec<Contact>>,
    /// Physical state at the end.
    pub end: Vec<f64>,
}

/// Calls of the control, each after a few dozen steps, after which a run is stopped as endless.
const MOST_CALLS: usize = 20_000;

/// Runs a harvester; the error is a refusal, or a disagreement where the run does not end.
pub fn run(drawn: &Drawn) -> Result<LibraryRun, Verdict> {
    let plant = drawn.plant.clone();
    let n = plant.system.modes.len();
    let start = StartState {
        displacement: drawn.start[..n].to_vec(),
        velocity: drawn.start[n..2 * n].to_vec(),
        voltage_v: drawn.start[2 * n..].to_vec(),
        ..StartState::rest(&plant)
    };
    let calls = AtomicUsize::new(0);
    let control = Control::with_callback(move |control| {
        if calls.fetch_add(1, Ordering::Relaxed) == MOST_CALLS {
            control.stop();
        }
    });
    let kernel = Kernel::new(plant)
        .map_err(|error| Verdict::Refused(error.to_string()))?
        .with_control(&control);
    let cycle_s = kernel.plant.system.drives[0].frequency_hz.recip();
    let duration_s = drawn.cycles as f64 * cycle_s;
    let plan = RunPlan {
        duration_s,
        average_over_s: duration_s,
        tolerance: drawn.tolerance,
        record_s: duration_s,
    };
    let result = simulate(&kernel, &start, &plan).map_err(|error| match control.is_quiet() {
        true => Verdict::Refused(error.to_string()),
        false => Verdict::Disagree(format!("no end: {error}")),
    })?;
    let system = &kernel.plant.system;
    let after_s = AT_START * cycle_s;
    let contacts = (0..system.stops.len())
        .map(|p| contacts(system, &result.trajectory, p))
        .map(|all| all.into_iter().filter(|one| one.time_s > after_s).collect())
        .collect();
    let end = result.end.physical();
    Ok(LibraryRun {
        result,
        contacts,
        end,
    })
}

/// Begins of the contacts of a stop in a record.
fn contacts(system: &System, trajectory: &Trajectory, p: usize) -> Vec<Contact> {
    let (segments, stop) = (trajectory.segments(), &system.stops[p]);
    match stop.law {
        Law::Rigid(law) => {
            let mobility: f64 = stop.shape.iter().map(|s| s * s).sum();
            let impacts = trajectory.impacts().iter().filter(|one| one.port == p);
            let contact = |impact: &jounce_dynamics::Impact| Contact {
                time_s: segments.get(impact.after).map_or_else(
                    || {
                        segments
                            .last()
                            .map_or(0.0, |last| last.start_s + last.length_s)
                    },
                    |next| next.start_s,
                ),
                speed_m_s: impact.impulse_n_s * mobility / (1.0 + law.restitution),
            };
            impacts.map(contact).collect()
        }
        Law::Cubic(_) => Vec::new(),
        _ => {
            let touches: Vec<bool> = segments
                .iter()
                .map(|segment| segment.forces.iter().any(|force| force.port == p))
                .collect();
            let begins =
                (0..segments.len()).filter(|i| touches[*i] && (*i == 0 || !touches[i - 1]));
            let contact = |i: usize| Contact {
                time_s: segments[i].start_s,
                speed_m_s: f64::NAN,
            };
            begins.map(contact).collect()
        }
    }
}
