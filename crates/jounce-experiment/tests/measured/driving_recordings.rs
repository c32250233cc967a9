//! Real recordings as base motion of the paper's harvester, with the table fixed. Without the
//! recordings the test prints that it is skipped.
//!
//! Without contact a second method gives the mean power: the Fourier transform of the base record
//! of the rig, times the frequency response, transformed back. The record is padded until the beam
//! is at rest. The difference is the content of the linear interpolation above half the sampling
//! rate.

use super::samples::real;
use jounce_analysis::run::StartState;
use jounce_control::Control;
use jounce_data::read;
use jounce_data::recording::{Grid, IssueKind, Recording};
use jounce_experiment::rig::{Disturbance, Sensor, ShakerTest, on_recorded_base, shaker_test};
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes_holding;
use jounce_signal::Samples;
use jounce_signal::spectral::{MeanPower, mean_power};
use jounce_spec::SpecFile;

const RATE_HZ: f64 = 1024.0;
const LOAD_OHM: f64 = 1e5;

/// Part of a channel in m/s^2, at uniform times.
struct Motion {
    file: &'static str,
    channel: &'static str,
    /// Value of 1 in the file, m/s^2.
    scale: f64,
    between_s: (f64, f64),
    traps: &'static [IssueKind],
}

fn motion(of: &Motion) -> Option<Recording> {
    let contents = read::file(&real(of.file)?).unwrap_or_else(|fault| panic!("{fault}"));
    let recording = contents
        .recordings
        .into_iter()
        .next()
        .expect("a recording")
        .even()
        .expect("even times");
    for trap in of.traps {
        assert!(
            recording.issues.iter().any(|issue| issue.kind == *trap),
            "{}: {trap:?} is not reported",
            of.file
        );
    }
    let rate_hz = recording.rate();
    let mut channel = recording
        .channel(of.channel)
        .unwrap_or_else(|fault| panic!("{fault}"))
        .clone();
    let part = |s: f64| ((s * rate_hz) as usize).min(channel.values.len());
    channel.values = channel.values[part(of.between_s.0)..part(of.between_s.1)]
        .iter()
        .map(|x| x * of.scale)
        .collect();
    let grid = Grid::even(0.0, 1.0 / rate_hz, channel.values.len()).expect("a grid");
    Some(Recording {
        grid,
        channels: vec![channel],
        ..recording
    })
}

/// Record of the rig and its mean power, for a gap.
fn driven(motion: &Recording, gap: &str) -> (Plant, Recording, MeanPower) {
    let mut file = SpecFile::from_text(include_str!(
        "../../../../examples/impact-harvester-2019/harvester.toml"
    ));
    file.set("stop.tip.gap", gap).expect("a key");
    file.set("circuit.load.resistance", "100 kohm")
        .expect("a key");
    let mut spec = file.spec().expect("a spec");
    let modes = modes_holding(&spec, &["table".to_owned()]).expect("modes");
    on_recorded_base(&mut spec, motion, &motion.channels[0].name, false).expect("a base");
    let plant =
        Plant::new(System::assemble(&spec, modes.clone()).expect("a system")).expect("a plant");
    let test = ShakerTest {
        rate_hz: RATE_HZ,
        duration_s: spec.run.duration_s,
        before_s: 0.0,
        starts: vec![(0.0, StartState::rest(&plant))],
        disturbance: Disturbance::NONE,
        accelerometers: Vec::new(),
        sensor: Sensor {
            noise_ratio: 0.0,
            bits: None,
        },
        seed: 1,
    };
    let record = shaker_test(&spec, &modes, &test, &Control::default())
        .unwrap_or_else(|fault| panic!("{fault}"));
    let power = mean_power(
        &Samples::new(&record.channels[0].values, RATE_HZ).expect("samples"),
        LOAD_OHM,
        false,
    )
    .expect("power");
    (plant, record, power)
}

/// Mean power of the linear harvester over the record, by Fourier transforms.
fn transformed_w(plant: &Plant, record: &Recording) -> f64 {
    let base = &record.channel("base.acceleration").expect("a base").values;
    // The first mode decays to 1e-5 in 110 s.
    let padded = (base.len() + 120 * RATE_HZ as usize).next_power_of_two();
    let (forward, backward) = (jounce_fft::forward(padded), jounce_fft::inverse(padded));
    let mut input = base.clone();
    input.resize(padded, 0.0);
    let mut bins = forward.make_output_vec();
    forward
        .process(&mut input, &mut bins)
        .expect("the plan made both");
    let hz: Vec<f64> = (0..bins.len())
        .map(|k| k as f64 * RATE_HZ / padded as f64)
        .collect();
    let h = &frf(
        plant,
        &FrfInput::BaseAcceleration,
        &[FrfOutput::LoadVoltage("load".to_owned())],
        &hz,
    )
    .expect("a response")[0]
        .value;
    bins.iter_mut().zip(h).for_each(|(bin, h)| *bin *= h);
    let last = bins.len() - 1;
    (bins[0].im, bins[last].im) = (0.0, 0.0);
    let mut voltage = backward.make_output_vec();
    backward
        .process(&mut bins, &mut voltage)
        .expect("the plan made both");
    voltage[..base.len()]
        .iter()
        .map(|v| (v / padded as f64).powi(2))
        .sum::<f64>()
        / base.len() as f64
        / LOAD_OHM
}

/// Prints mean powers without and with impact; the former agrees with the transforms within
/// `allowed`.
fn check(of: &Motion, allowed: f64) {
    let Some(motion) = motion(of) else { return };
    let (plant, record, linear) = driven(&motion, "1 m");
    let (_, _, impact) = driven(&motion, "1 mm");
    let error = linear.mean_power_w / transformed_w(&plant, &record) - 1.0;
    eprintln!(
        "{}: linear {:.3e} +- {:.1e} W ({error:.1e} off by transforms), impact {:.3e} +- {:.1e} W",
        of.file, linear.mean_power_w, linear.half_width_w, impact.mean_power_w, impact.half_width_w
    );
    assert!(error.abs() < allowed, "{error:e}");
    assert!(
        impact.mean_power_w > 0.0 && impact.half_width_w > 0.0 && impact.mean_power_w.is_finite()
    );
}

/// 50 Hz with linear interpolation between the samples; the file in SI has no issue. The component
/// is S90W with a peak of 0.214 g, not S00E.
#[test]
fn el_centro_drives_the_harvester() {
    check(
        &Motion {
            file: "elcentro_1940/elcentro_1940_s90w_si.csv",
            channel: "a_m_s2",
            scale: 1.0,
            between_s: (0.0, 60.0),
            traps: &[],
        },
        5e-3,
    );
}

/// In g without a stated unit, padded by zeros for the first 6 s. The subject stands until 50 s and
/// walks until 180 s; 315 s to 359 s is the strongest part.
#[test]
fn a_foot_drives_the_harvester() {
    let (file, traps) = (
        "human_gait/foot_data.mat",
        &[
            IssueKind::ZeroPadding,
            IssueKind::Constant,
            IssueKind::Assumed,
        ][..],
    );
    for between_s in [(70.0, 170.0), (315.0, 359.0)] {
        check(
            &Motion {
                file,
                channel: "foot_data(5)",
                scale: 9.80665,
                between_s,
                traps,
            },
            5e-3,
        );
    }
}

/// Time stamps jitter by more than a percent.
#[test]
fn a_hand_carried_logger_drives_the_harvester() {
    let (file, traps) = (
        "endaq_ide/test_si.csv",
        &[IssueKind::Jitter, IssueKind::Resampled][..],
    );
    check(
        &Motion {
            file,
            channel: "ay_m_s2",
            scale: 1.0,
            between_s: (0.0, 60.0),
            traps,
        },
        5e-3,
    );
}

/// Counts of a converter of +-2 g (16384 to 1 g), time stamps in integer milliseconds with gaps.
#[test]
fn a_sawn_tree_drives_the_harvester() {
    let (file, traps) = (
        "tree_vibration/chainsaw_1.csv",
        &[IssueKind::Jitter, IssueKind::Gap, IssueKind::RawCounts][..],
    );
    check(
        &Motion {
            file,
            channel: "accel_x",
            scale: 9.80665 / 16384.0,
            between_s: (0.0, 60.0),
            traps,
        },
        5e-3,
    );
}
