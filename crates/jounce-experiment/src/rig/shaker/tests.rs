//! Records of shaker tests against frequency responses and rates.

use super::*;
use crate::rig::{on_recorded_base, paper_spec};
use jounce_data::recording::Quantity;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::structure::{modes, modes_holding};
use jounce_signal::Samples;

/// 6 Hz, 20 N, linear steady state, 100 kohm.
fn linear() -> (Spec, Modes) {
    let settings = [
        ("drive.shaker.frequency", "6 Hz"),
        ("drive.shaker.amplitude", "20 N"),
        ("stop.tip.gap", "1 m"),
    ];
    let spec = paper_spec(&[&settings[..], &[("circuit.load.resistance", "100 kohm")]].concat());
    let modes = modes(&spec).unwrap();
    (spec, modes)
}

fn plant(spec: &Spec, modes: &Modes) -> Plant {
    Plant::new(System::assemble(spec, modes.clone()).unwrap()).unwrap()
}

fn test(start: StartState, duration_s: f64) -> ShakerTest {
    let sensor = Sensor {
        noise_ratio: 0.0,
        bits: None,
    };
    let (starts, accelerometers) = (vec![(0.0, start)], vec!["beam.tip".to_owned()]);
    ShakerTest {
        rate_hz: 1536.0,
        duration_s,
        before_s: 0.0,
        starts,
        disturbance: Disturbance::NONE,
        accelerometers,
        sensor,
        seed: 1,
    }
}

fn peak(recording: &Recording, channel: &str, hz: f64) -> f64 {
    let samples = Samples::new(&recording.channel(channel).unwrap().values, 1536.0).unwrap();
    samples.orders(hz, &[1.0]).unwrap().lines[0].amplitude_peak
}

/// In the steady state without contact every channel has the amplitude of its frequency
/// response; measured 4e-15. The same drive as undisturbed samples gives the same record;
/// measured 5e-5, linear interpolation with 64 samples per cycle.
#[test]
fn channels_are_the_frequency_responses_for_tones_and_disturbed_drives() {
    let (spec, modes) = linear();
    let linear_plant = plant(&spec, &modes);
    let responses = [
        FrfOutput::Acceleration("table".to_owned()),
        FrfOutput::Acceleration("beam.tip".to_owned()),
    ];
    let responses = [&responses[..], &[FrfOutput::Voltage("mfc".to_owned())]].concat();
    let expected = frf(
        &linear_plant,
        &FrfInput::Force("table".to_owned()),
        &responses,
        &[6.0],
    )
    .unwrap();
    let undisturbed_test = test(StartState::linear(&linear_plant), 2.0);
    let disturbed_test = ShakerTest {
        disturbance: Disturbance {
            amplitude_ratio: 1e-13,
            ..Disturbance::NONE
        },
        ..undisturbed_test.clone()
    };
    for (test, allowed) in [(undisturbed_test, 1e-11), (disturbed_test, 2e-4)] {
        let result = shaker_test(&spec, &modes, &test, &Control::default()).unwrap();
        for (channel, expected) in ["base.acceleration", "beam.tip.acceleration", "mfc.voltage"]
            .into_iter()
            .zip(&expected)
        {
            let relative_error =
                peak(&result, channel, 6.0) / (20.0 * expected.value[0].norm()) - 1.0;
            eprintln!("{channel}: {relative_error:.1e}");
            assert!(
                relative_error.abs() < allowed,
                "{channel}: {relative_error:e}"
            );
        }
    }
}

/// In contact, the acceleration is the rate of the velocity: differences of the velocity over
/// 2e-5 s in the same run. Measured 3e-6 of the largest.
#[test]
fn an_acceleration_in_contact_is_the_rate_of_the_velocity() {
    let spec = paper_spec(&[("run.tolerance", "1e-9")]);
    let modes = modes(&spec).unwrap();
    let (kernel, trajectory) = integrated(
        &spec,
        &modes,
        (&StartState::rest(&plant(&spec, &modes)), 1.0),
        &Control::default(),
    )
    .unwrap();
    let times_s: Vec<f64> = (0..900).map(|k| 0.05 + 1e-3 * f64::from(k)).collect();
    let sensor_outputs = [
        SensorOutput::Acceleration("beam.tip".to_owned()),
        SensorOutput::StopForce(0),
    ];
    let result = outputs(&spec, &kernel, &trajectory, &times_s, &sensor_outputs);
    let row = kernel.plant.velocity_row(&modes.shape["beam.tip"]);
    let velocity = |time_s: f64| {
        let at = &trajectory.at(&kernel, &[time_s])[0];
        let steady = kernel.plant.steady_at(time_s);
        row.iter()
            .zip(&at.state)
            .zip(&steady)
            .map(|((c, y), s)| c * (y + s))
            .sum::<f64>()
    };
    let peak_acceleration = result[0].iter().fold(0.0, |peak: f64, x| peak.max(x.abs()));
    let rate = |t: f64| (velocity(t + 1e-5) - velocity(t - 1e-5)) / 2e-5;
    let max_error = times_s
        .iter()
        .zip(&result[0])
        .map(|(t, a)| (a - rate(*t)).abs() / peak_acceleration)
        .fold(0.0, f64::max);
    let contact_samples = result[1].iter().filter(|force| **force > 0.0).count();
    eprintln!("{contact_samples} of 900 in contact, off by {max_error:.1e}");
    assert!(
        contact_samples > 20 && max_error < 1e-4,
        "{contact_samples} {max_error:e}"
    );
}

/// Base acceleration of 20 Hz and 2 m/s^2 about an offset of gravity, 6 s at 1000 Hz.
fn recorded_sine() -> Recording {
    let value = |k: usize| 9.81 + 2.0 * (std::f64::consts::TAU * 20.0 * k as f64 / 1000.0).sin();
    let channels = vec![Channel::new(
        "a",
        Quantity::Acceleration,
        "m/s^2",
        (0..6000).map(value).collect(),
    )];
    let grid = Grid::even(0.0, 1e-3, 6000).unwrap();
    Recording {
        name: "base".to_owned(),
        over: Over::Time,
        grid,
        channels,
        issues: Vec::new(),
    }
}

/// A recorded base motion, 20 Hz and 2 m/s^2 about an offset of gravity, 50 samples per cycle.
/// The base channel is the record without its mean; the accelerometer adds its own response to
/// the base motion, `a |1 + H|`; linear interpolation multiplies both by `sinc^2(f h)`.
/// Measured 1e-6.
#[test]
fn recorded_base_moves_the_structure() {
    let settings = [
        ("stop.tip.gap", "1 m"),
        (
            "damping.ratios",
            "[0.05, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05]",
        ),
    ];
    let mut spec = paper_spec(&settings);
    let modes = modes_holding(&spec, &["table".to_owned()]).unwrap();
    let recorded = recorded_sine();
    let mean = on_recorded_base(&mut spec, &recorded, "a", false).unwrap();
    assert!((mean - 9.81).abs() < 1e-9 && (spec.run.duration_s - 5.999).abs() < 1e-12);
    let plant_on_base = plant(&spec, &modes);
    let result = shaker_test(
        &spec,
        &modes,
        &test(StartState::rest(&plant_on_base), 5.999),
        &Control::default(),
    )
    .unwrap();
    let last = |channel: &str| {
        let values = &result.channel(channel).unwrap().values;
        Samples::new(&values[values.len() - 3072..], 1536.0)
            .unwrap()
            .orders(20.0, &[1.0])
            .unwrap()
            .lines[0]
            .amplitude_peak
    };
    let h = frf(
        &plant_on_base,
        &FrfInput::BaseAcceleration,
        &[FrfOutput::Acceleration("beam.tip".to_owned())],
        &[20.0],
    )
    .unwrap()[0]
        .value[0];
    let half_angle = std::f64::consts::PI * 0.02;
    let amplitude = 2.0 * (half_angle.sin() / half_angle).powi(2);
    let (base, tip) = (
        last("base.acceleration") / amplitude,
        last("beam.tip.acceleration") / (amplitude * (h + 1.0).norm()),
    );
    eprintln!("base {:.1e}, tip {:.1e} off", base - 1.0, tip - 1.0);
    assert!(
        (base - 1.0).abs() < 1e-4 && (tip - 1.0).abs() < 1e-4,
        "{base} {tip}"
    );
}

#[test]
fn impossible_tests_are_errors() {
    let (spec, modes) = linear();
    let start = StartState::linear(&plant(&spec, &modes));
    let valid_test = test(start.clone(), 1.0);
    let with = |change: fn(&mut ShakerTest)| {
        let mut test = valid_test.clone();
        change(&mut test);
        shaker_test(&spec, &modes, &test, &Control::default())
            .unwrap_err()
            .to_string()
    };
    assert!(with(|t| t.duration_s = 0.01).contains("change the rate"));
    assert!(with(|t| t.accelerometers = vec!["beam.tpi".to_owned()]).contains("beam.tip"));
    assert!(
        with(|t| t.disturbance.amplitude_ratio = f64::NAN)
            .contains("standard deviation of the drive amplitude")
    );
    for noise_ratio in [-1.0, f64::NAN, f64::INFINITY] {
        let sensor = Sensor {
            noise_ratio,
            bits: None,
        };
        let message = shaker_test(
            &spec,
            &modes,
            &ShakerTest {
                sensor,
                ..valid_test.clone()
            },
            &Control::default(),
        )
        .unwrap_err()
        .to_string();
        assert!(
            message.contains("the noise ratio") && message.contains("from 0 to 10"),
            "{message}"
        );
    }
    assert!(
        with(|t| t.sensor.bits = Some(0)).contains("from 2 to 32")
            && with(|t| t.sensor.bits = Some(1000)).contains("1000")
    );
    let late_test = ShakerTest {
        starts: vec![(0.0, start.clone()), (3.0, start)],
        ..valid_test.clone()
    };
    assert!(
        shaker_test(&spec, &modes, &late_test, &Control::default())
            .unwrap_err()
            .to_string()
            .contains("within the record")
    );
}
