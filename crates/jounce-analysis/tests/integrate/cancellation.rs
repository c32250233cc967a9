//! The callback of the control runs during every kind of integration.

use crate::circuits::cell::lossy_with_stop;
use crate::plants::{bench, kernel};
use jounce_control::Control;
use jounce_dynamics::{IntegrationError, Integrator};
use jounce_model::contact::{Law, Rigid};
use jounce_model::plant::{RectifierScheme, Stop, Storage, System};
use std::sync::atomic::{AtomicU32, Ordering};

/// Longer than the time of any of these runs up to the third callback.
const LONG_S: f64 = 1e4;

fn rigid() -> System {
    let mut system = bench(50.0, 11.0);
    system.stops[0].law = Law::Rigid(Rigid { restitution: 0.7 });
    system
}

fn two_stops() -> System {
    let mut system = bench(50.0, 11.0);
    let first = system.stops[0].clone();
    system.stops.push(Stop {
        name: "other".into(),
        shape: first.shape.iter().map(|phi| -phi).collect(),
        ..first
    });
    system
}

#[test]
fn a_callback_ends_an_integration_of_any_kind() {
    let rectified = lossy_with_stop(
        RectifierScheme::Standard,
        Storage::Capacitor {
            capacitance_f: 4.0,
            load_ohm: 2.0,
        },
    );
    for (name, system) in [
        ("one stop", bench(50.0, 11.0)),
        ("rigid", rigid()),
        ("two stops", two_stops()),
        ("rectifier", rectified),
    ] {
        let calls = AtomicU32::new(0);
        let control = Control::with_callback(move |control| {
            if calls.fetch_add(1, Ordering::Relaxed) == 2 {
                control.stop();
            }
        });
        let kernel = kernel(system).with_control(&control);
        let rest = vec![0.0; kernel.plant.len()];
        let outcome = Integrator::new(&kernel, &kernel.plant.from_physical(&rest, 0.0), 0.0, 1e-8)
            .unwrap()
            .advance_to(LONG_S);
        assert!(
            matches!(outcome, Err(IntegrationError::Stopped { time_s }) if time_s < LONG_S),
            "{name}: {outcome:?}"
        );
    }
}
