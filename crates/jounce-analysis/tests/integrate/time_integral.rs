//! Time integrals along a record in closed form, against quadrature of the recorded states.

use crate::circuits::cell::lossy_with_stop;
use crate::plants::kernel;
use jounce_dynamics::{Integrator, Kernel, Trajectory};
use jounce_model::drive::Wave;
use jounce_model::plant::{RectifierScheme, Signal, Storage};
use std::sync::Arc;

/// Nodes and weights of the five-point Gauss rule on (-1, 1).
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Integrates every component of the physical state by quadrature over panels no longer than
/// `panel_s`, split at step ends.
fn by_quadrature(
    kernel: &Kernel,
    record: &Trajectory,
    [from_s, to_s]: [f64; 2],
    panel_s: f64,
) -> Vec<f64> {
    let (mut times, mut weights) = (Vec::new(), Vec::new());
    for segment in record.segments() {
        let (start_s, end_s) = (
            segment.start_s.max(from_s),
            (segment.start_s + segment.length_s).min(to_s),
        );
        let panels = ((end_s - start_s) / panel_s).ceil().max(0.0);
        let length_s = (end_s - start_s) / panels;
        for panel in 0..panels as usize {
            times.extend(GAUSS.map(|(x, _)| start_s + (panel as f64 + 0.5 * (1.0 + x)) * length_s));
            weights.extend(GAUSS.map(|(_, weight)| 0.5 * length_s * weight));
        }
    }
    let mut sum = vec![0.0; kernel.plant.len()];
    for (at, weight) in record.at(kernel, &times).iter().zip(weights) {
        let x = kernel.plant.to_physical(&at.state, at.time_s);
        sum.iter_mut()
            .zip(x)
            .for_each(|(sum, x)| *sum += weight * x);
    }
    sum
}

/// Contacts, diodes, a switch, a sinusoid and a sampled force together; start and end times that
/// cut steps. The integral of a velocity equals the change of displacement: measured 3e-14. Against
/// quadrature: 1e-13, except 2e-10 for the velocity, which a record gives to 1e-7 in the first step
/// of a contact.
#[test]
fn integrals_along_a_record_are_those_by_quadrature() {
    let storage = Storage::Capacitor {
        capacitance_f: 5.0,
        load_ohm: 3.0,
    };
    for (scheme, sampled) in [
        (RectifierScheme::Standard, false),
        (RectifierScheme::Standard, true),
        (RectifierScheme::SeriesSshi { inversion: 0.6 }, false),
    ] {
        let mut system = lossy_with_stop(scheme, storage);
        system.bridges[0].diode_ohm = 0.1;
        if sampled {
            let sizes: Arc<[f64]> = (0..400)
                .map(|k: i32| (0.7 * f64::from(k)).sin() + 0.3 * (0.11 * f64::from(k)).cos())
                .collect();
            let wave = Wave::Sampled {
                start_s: 0.0,
                step_s: 0.25,
                sizes,
            };
            system.signals.push(Signal {
                name: "sampled".into(),
                shape: vec![0.5],
                wave,
                base: None,
                drawn_from: None,
            });
        }
        let kernel = kernel(system);
        let mut integrator =
            Integrator::new(&kernel, &vec![0.0; kernel.plant.len()], 0.0, 1e-9).unwrap();
        integrator.start_record();
        integrator.advance_to(60.0).unwrap();
        let (contacts, record) = (integrator.statistics().contacts, integrator.take_record());
        let span_s = [7.123, 55.77];
        let exact = by_quadrature(&kernel, &record, span_s, 0.02);
        for (number, exact) in exact.iter().enumerate() {
            let integral = record.integral(&kernel, span_s[0], span_s[1], number);
            eprintln!(
                "{scheme:?}, sampled {sampled}, {contacts} contacts, number {number}: {integral:e}, {:.1e} off",
                integral - exact
            );
            let allowed = if number == 1 { 1e-9 } else { 1e-12 };
            assert!((integral - exact).abs() < allowed && contacts > 3);
        }
        let [before, after] = span_s.map(|time_s| record.physical_at(&kernel, time_s));
        let gained = record.integral(&kernel, span_s[0], span_s[1], 1) - (after[0] - before[0]);
        eprintln!("{scheme:?}, sampled {sampled}: velocity and displacement {gained:.1e} apart");
        assert!(gained.abs() < 1e-12);
    }
}
