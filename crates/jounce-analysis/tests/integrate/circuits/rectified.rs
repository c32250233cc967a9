//! Rectifiers: closed forms, published numbers, RK4.

use super::cell::cell;
use crate::plants::{from_rest, kernel};
use crate::runge_kutta::runge_kutta;
use jounce_analysis::run::{RunPlan, RunResult, StartState, simulate};
use jounce_analysis::{Model, Sweep, SweepOrder, SweepPoint};
use jounce_control::Control;
use jounce_dynamics::Kernel;
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{RectifierScheme, Stop, Storage};
use jounce_spec::SpecFile;
use std::f64::consts::{PI, TAU};

/// Mean power into the battery or the load over the last of `cycles`, and the residual of the
/// energy balance.
fn settled_power(
    kernel: &Kernel,
    start: &StartState,
    cycles: f64,
    over: f64,
    tolerance: f64,
) -> (f64, f64) {
    let period_s = 1.0 / kernel.plant.system.drives[0].frequency_hz;
    let plan = RunPlan {
        duration_s: cycles * period_s,
        average_over_s: over * period_s,
        tolerance,
        record_s: 0.0,
    };
    let result = simulate(kernel, start, &plan).unwrap();
    (result.mean_power_w, result.energies.residual_relative())
}

/// Direct integration of the same circuit by another program, with a battery of 1 and of 2: 2.37962
/// and 2.10016. Ours differ by 2.1e-5 and 4.5e-5. The error of that program is unknown; the RK4
/// integration below agrees with ours to 1e-10.
#[test]
fn a_bridge_on_a_strongly_coupled_oscillator_gives_the_power_of_direct_integration() {
    for (battery, power) in [(1.0, 2.37962), (2.0, 2.10016)] {
        let kernel = kernel(cell(
            0.3_f64.sqrt(),
            0.02,
            1.05,
            RectifierScheme::Standard,
            Storage::Battery { voltage_v: battery },
        ));
        let (power_w, residual) =
            settled_power(&kernel, &StartState::rest(&kernel.plant), 400.0, 10.0, 1e-9);
        eprintln!("battery {battery}: {power_w:.6} against {power}, residual {residual:.1e}");
        assert!((power_w / power - 1.0).abs() < 6e-5 && residual.abs() < 1e-8);
    }
}

/// Weak coupling: the motion is that without a circuit, and the powers are in closed form (Guyomar
/// et al. 2005, Lefeuvre et al. 2006).
#[test]
fn weakly_coupled_interfaces_give_their_closed_forms() {
    let (w, theta, q) = (0.8_f64, 1e-5, 0.7);
    let displacement = 1.0 / ((1.0 - w * w).powi(2) + (0.1 * w).powi(2)).sqrt();
    let open = theta * displacement;
    let current = theta * w * displacement;
    let best = current / (w * (1.0 - q));
    let series = (1.0 + q) / (1.0 - q);
    for (scheme, battery, power) in [
        (
            RectifierScheme::Standard,
            0.5 * open,
            current * current / (TAU * w),
        ),
        (
            RectifierScheme::Standard,
            0.3 * open,
            2.0 * w / PI * 0.3 * 0.7 * open * open,
        ),
        (
            RectifierScheme::ParallelSshi { inversion: q },
            best,
            current * current / (PI * w * (1.0 - q)),
        ),
        (
            RectifierScheme::SeriesSshi { inversion: q },
            0.5 * open,
            series * current * current / (TAU * w),
        ),
        (
            RectifierScheme::Extraction { efficiency: 1.0 },
            open,
            4.0 * current * current / (TAU * w),
        ),
        (
            RectifierScheme::Extraction { efficiency: 0.8 },
            open,
            3.2 * current * current / (TAU * w),
        ),
    ] {
        let storage = Storage::Battery { voltage_v: battery };
        let kernel = kernel(cell(theta, 0.05, w, scheme, storage));
        let (power_w, residual) = settled_power(
            &kernel,
            &StartState::linear(&kernel.plant),
            120.0,
            20.0,
            1e-9,
        );
        eprintln!(
            "{scheme:?}: {:.2e} off, residual {residual:.1e}",
            power_w / power - 1.0
        );
        assert!(
            (power_w / power - 1.0).abs() < 1e-8 && residual.abs() < 1e-12,
            "{scheme:?}: {power_w:e} against {power:e}"
        );
    }
}

/// A bridge next to a stop, from rest over 20 units of time.
struct NextToStop {
    gap_m: f64,
    drop_v: f64,
    diode_ohm: f64,
    force_n: f64,
}

impl NextToStop {
    fn kernel(&self) -> Kernel {
        let storage = Storage::Capacitor {
            capacitance_f: 4.0,
            load_ohm: 2.0,
        };
        let mut system = cell(0.6, 0.03, 1.1, RectifierScheme::Standard, storage);
        (system.bridges[0].drop_v, system.bridges[0].diode_ohm) = (self.drop_v, self.diode_ohm);
        system.drives[0].amplitude_n = self.force_n;
        system.drives.retain(|drive| drive.amplitude_n > 0.0);
        system.stops.push(Stop {
            name: "stop".into(),
            shape: vec![1.0],
            gap_m: self.gap_m,
            law: Law::Hertz(Hertz {
                stiffness: 20.0,
                exponent: 1.5,
            }),
            bases: Vec::new(),
        });
        kernel(system)
    }

    /// RK4 on the same equations, with the diodes as kinks of their current.
    fn end_by_runge_kutta(&self, steps: u32) -> [f64; 4] {
        let rates = |t: f64, x: [f64; 4]| -> [f64; 4] {
            let [q, v, patch, store] = x;
            let over = patch.abs() - store - self.drop_v;
            let current = (over / self.diode_ohm).max(0.0) * patch.signum();
            let contact = 20.0 * (q - self.gap_m).max(0.0).powf(1.5);
            [
                v,
                self.force_n * (1.1 * t + 0.4).sin() - 0.06 * v - q + 0.6 * patch - contact,
                -0.6 * v - current,
                (current.abs() - store / 2.0) / 4.0,
            ]
        };
        runge_kutta(rates, [0.0; 4], 20.0, steps)
    }

    /// Largest difference of the states at the end.
    fn error(&self, result: &RunResult, steps: u32) -> f64 {
        let plain = self.end_by_runge_kutta(steps);
        let ours = result.end.physical();
        let error = ours
            .iter()
            .zip(plain)
            .map(|(ours, plain)| (ours - plain).abs())
            .fold(0.0, f64::max);
        eprintln!("{ours:?} against {plain:?}: {error:.1e}, {:?}", result.work);
        error
    }
}

/// At 2e5 steps of Runge-Kutta per unit of time.
#[test]
fn a_bridge_next_to_a_stop_agrees_with_a_plain_integrator() {
    let bridge = NextToStop {
        gap_m: 0.5,
        drop_v: 0.1,
        diode_ohm: 0.05,
        force_n: 1.0,
    };
    let result = from_rest(&bridge.kernel(), 20.0, 1e-10);
    assert!(bridge.error(&result, 400_000) < 1e-8 && result.contacts > 1);
}

/// Diodes that settle within 1e-4 of the time in which a contact changes; the point stays on its
/// stop most of the time, so that they start and stop to conduct during a contact.
#[test]
fn fast_diodes_during_a_contact_agree_with_a_plain_integrator() {
    let bridge = NextToStop {
        gap_m: -0.6,
        drop_v: 0.1,
        diode_ohm: 1e-4,
        force_n: 1.0,
    };
    let result = from_rest(&bridge.kernel(), 20.0, 1e-10);
    assert!(bridge.error(&result, 4_000_000) < 1e-7);
    let work = result.work;
    assert!(
        work.contact_steps + work.contact_rejections < 300,
        "{work:?}"
    );
}

/// Diodes without a drop at rest, whose event functions start at zero when a pressed stop throws the
/// point off.
#[test]
fn diodes_without_a_drop_conduct_at_once_where_a_stop_presses() {
    let bridge = NextToStop {
        gap_m: -0.6,
        drop_v: 0.0,
        diode_ohm: 0.05,
        force_n: 0.0,
    };
    let result = from_rest(&bridge.kernel(), 20.0, 1e-10);
    assert!(bridge.error(&result, 400_000) < 1e-8);
}

/// With diodes of zero resistance and negligible storage, a battery above the open-circuit voltage
/// receives no current.
#[test]
fn a_battery_above_the_open_voltage_receives_no_charge() {
    let kernel = kernel(cell(
        1e-5,
        0.05,
        0.8,
        RectifierScheme::Standard,
        Storage::Battery { voltage_v: 1.0 },
    ));
    let (power, residual) = settled_power(
        &kernel,
        &StartState::linear(&kernel.plant),
        20.0,
        10.0,
        1e-9,
    );
    assert!(power == 0.0 && residual.abs() < 1e-12);
}

/// A mode with a patch, under a force.
const CELL_OF_TEXT: &str = r#"
[modal.m]
frequency_hz = [10.0]
damping_ratio = [0.02]
[modal.m.point]
tip = [1.0]
[modal.m.patch.p]
coupling_n_per_v = [1e-3]
capacitance = "10 nF"
[drive.f]
at = "m.tip"
amplitude = "1 N"
frequency = "10 Hz"
[reduction]
modes = 1
[run]
duration = "2 s"
average_over = "1 s"
"#;

/// A bridge on that patch.
const BRIDGE: &str = "[circuit.r]\npatch = \"m.p\"\ninterface = \"bridge\"\nstorage = \"10 nF\"\nresistance = \"10 Mohm\"\n";

/// A sweep reports the voltage of a rectified circuit as a run does, and no voltage where the
/// circuit draws no power; both survive a journal.
#[test]
fn a_sweep_reports_the_voltage_of_the_storage() {
    for (circuit, is_reported) in [(BRIDGE, true), ("", false)] {
        let mut file_text = format!("{CELL_OF_TEXT}{circuit}");
        if !is_reported {
            file_text = file_text.replace("capacitance =", "electrodes = \"open\"\ncapacitance =");
        }
        let file = SpecFile::from_text(file_text);
        let (spec, range) = (
            file.spec().unwrap(),
            file.range("drive.f.amplitude=1N:2N:2x").unwrap(),
        );
        let sweep = Sweep {
            spec: &spec,
            range: &range,
            direction: SweepOrder::Independent,
            fixed_duration: true,
            folder: "".into(),
        };
        let points = sweep.run(None, &Control::default(), &|_| ()).unwrap();
        let prepared = Model::new(spec.clone()).unwrap();
        let start = prepared.start(std::path::Path::new("")).unwrap();
        let run = simulate(
            &prepared.from_state(&start).unwrap(),
            &start,
            &RunPlan::of(&spec.run, 0.0).watching(&spec, &prepared.kernel.plant),
        )
        .unwrap();
        let rms_v = points[0].voltage_rms_v;
        let back: SweepPoint =
            serde_json::from_str(&serde_json::to_string(&points[0]).unwrap()).unwrap();
        match run.rectified.first() {
            Some(storage) => assert!(
                is_reported
                    && rms_v == storage.voltage_rms_v
                    && rms_v > 0.0
                    && back.voltage_rms_v == rms_v,
                "{rms_v}"
            ),
            None => assert!(
                !is_reported
                    && run.voltage_rms_v().is_none()
                    && rms_v.is_nan()
                    && back.voltage_rms_v.is_nan(),
                "{rms_v}"
            ),
        }
    }
}
