//! Largest voltages at the end of a run.

use super::cell::cell;
use crate::plants::kernel as of_system;
use jounce_analysis::run::{OutputPeaks, RunPlan, RunResult, StartState, output_peaks, simulate};
use jounce_dynamics::Kernel;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Plant, RectifierScheme, Storage, System};
use jounce_model::structure::modes;
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

const PAPER: &str = include_str!("../../../../../examples/impact-harvester-2019/harvester.toml");

fn changed(keys: &[(&str, &str)]) -> SpecFile {
    let mut file = SpecFile::from_text(PAPER);
    keys.iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file
}

fn run(file: &SpecFile, record_s: f64) -> (Kernel, RunPlan, RunResult, OutputPeaks) {
    let spec = file.spec().unwrap();
    let plant = Plant::new(System::assemble(&spec, modes(&spec).unwrap()).unwrap()).unwrap();
    let start = StartState::linear(&plant);
    let kernel = Kernel::new(plant).unwrap();
    let plan = RunPlan::of(&spec.run, record_s);
    let result = simulate(&kernel, &start, &plan).unwrap();
    let peaks = output_peaks(&kernel, &result);
    (kernel, plan, result, peaks)
}

/// One patch with a resistor, with an inductor parallel to and in series with it, and two patches
/// in series, without contact: closed form of the frequency response.
#[test]
fn peaks_without_contact_are_those_of_the_frequency_response() {
    let second = "[patch.second]\non = \"beam\"\nmaterial = \"MFC-P2\"\nstart = \"110 mm\"\nlength = \"60 mm\"\nwidth = \"30 mm\"\n\
        thickness = \"0.3 mm\"\n[stop.tip]";
    let resistive = PAPER.to_owned();
    let parallel = PAPER.replace(
        "resistance = \"1 Mohm\"",
        "resistance = \"1 Mohm\"\ninductance = \"200 H\"",
    );
    let series = PAPER
        .replace(
            "patch = \"mfc\"",
            "patches = [\"mfc\", \"second\"]\nwiring = \"series\"",
        )
        .replace("[stop.tip]", second);
    let series_inductor = parallel.replace("200 H\"", "200 H\"\ninductor = \"series\"");
    for text in [resistive, parallel, series_inductor, series] {
        let mut file = SpecFile::from_text(text.as_str());
        for (key, value) in [
            ("stop.tip.gap", "1 m"),
            ("drive.shaker.amplitude", "50 N"),
            ("run.duration", "2 s"),
            ("run.average_over", "1 s"),
        ] {
            file.set(key, value).unwrap();
        }
        let (kernel, _, result, peaks) = run(&file, 0.0);
        let patches = kernel
            .plant
            .system
            .modes
            .patch
            .keys()
            .map(|patch| FrfOutput::Voltage(patch.clone()));
        let outputs: Vec<FrfOutput> = std::iter::once(FrfOutput::LoadVoltage("load".into()))
            .chain(patches)
            .collect();
        let responses = frf(
            &kernel.plant,
            &FrfInput::Force("table".into()),
            &outputs,
            &[13.0],
        )
        .unwrap();
        let closed_v = responses
            .iter()
            .map(|response| 50.0 * response.value[0].norm());
        let peak_v = peaks.loads_v.iter().chain(&peaks.patches_v);
        let mut errors: Vec<f64> = peak_v
            .zip(closed_v)
            .map(|(peak_v, closed_v)| peak_v / closed_v - 1.0)
            .collect();
        errors.push(peaks.loads_v[0] / (2.0_f64.sqrt() * result.loads[0].voltage_rms_v) - 1.0);
        eprintln!("{errors:?} of {peaks:?}");
        assert!(
            errors.len() == outputs.len() + 1 && errors.iter().all(|error| error.abs() < 1e-12)
        );
        assert_eq!(peaks.first_v(), Some(peaks.loads_v[0]));
    }
}

/// With impacts, in steady state and in the transient: a hundred thousand samples over the interval
/// of the peak.
#[test]
fn peaks_with_impacts_are_those_of_many_samples() {
    // A steady state that repeats over the averaging window needs a record of one cycle, another
    // motion that of the window, of 13 cycles.
    for (amplitude, frequency_hz, duration, record_s, settles, cycles) in [
        ("50 N", 11.0, "40 s", 0.0, true, 1.0),
        ("50 N", 11.0, "40 s", 1.0, true, 1.0),
        ("200 N", 13.0, "3 s", 1.0, false, 13.0),
    ] {
        let frequency = format!("{frequency_hz} Hz");
        let file = changed(&[
            ("drive.shaker.amplitude", amplitude),
            ("drive.shaker.frequency", &frequency),
            ("run.duration", duration),
            ("run.average_over", "1 s"),
        ]);
        let (kernel, plan, result, peaks) = run(&file, record_s);
        let settlement = result.settlement.unwrap();
        let samples = 1 << 17;
        let times: Vec<f64> = (0..=samples)
            .map(|k| {
                plan.duration_s - cycles / frequency_hz * (1.0 - f64::from(k) / f64::from(samples))
            })
            .collect();
        let instants = result.trajectory.at(&kernel, &times);
        let sizes = instants.iter().map(|at| {
            kernel
                .plant
                .patch_voltages_v(&kernel.plant.to_physical(&at.state, at.time_s))[0]
                .abs()
        });
        let most_v = sizes.fold(0.0, f64::max);
        let sampling_error = 1.0 - most_v / peaks.patches_v[0];
        eprintln!(
            "{amplitude}, settled: {}, {cycles} cycles: {most_v} V, {sampling_error:e} less than the peak",
            settlement.settled
        );
        assert!(
            settlement.settled == settles && (-1e-12..1e-7).contains(&sampling_error),
            "{sampling_error:e}"
        );
        assert_eq!(peaks.loads_v, peaks.patches_v);
    }
}

/// Ideal diodes clamp the patch at the voltage of the battery.
#[test]
fn a_bridge_holds_the_peak_of_its_patch() {
    let kernel = of_system(cell(
        0.3,
        0.02,
        1.0,
        RectifierScheme::Standard,
        Storage::Battery { voltage_v: 1.5 },
    ));
    let plan = RunPlan {
        duration_s: 200.0 * TAU,
        average_over_s: 20.0 * TAU,
        tolerance: 1e-9,
        record_s: 0.0,
    };
    let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
    let peaks = output_peaks(&kernel, &result);
    eprintln!("{peaks:?}, {:e} A", result.rectified[0].mean_current_a);
    assert!(result.rectified[0].mean_current_a > 0.1 && peaks.loads_v.is_empty());
    // Two diodes of 1e-6 ohm conduct some amperes.
    assert!((peaks.patches_v[0] - 1.5).abs() < 1e-5 && peaks.first_v() == Some(peaks.patches_v[0]));
}

/// A drive that is not periodic: the largest voltage of the record, and no voltage without a
/// record.
#[test]
fn a_drive_without_a_period_needs_a_record() {
    let text = PAPER.replace(
        "amplitude = \"200 N\"\nfrequency = \"13 Hz\"",
        "signal = \"chirp\"\namplitude = \"50 N\"\nfrom = \"9 Hz\"\nto = \"14 Hz\"\nduration = \"4 s\"",
    );
    let mut file = SpecFile::from_text(text.as_str());
    file.set("run.duration", "4 s").unwrap();
    file.set("run.average_over", "2 s").unwrap();
    let (_, _, _, none) = run(&file, 0.0);
    assert!(none.loads_v[0].is_nan() && none.patches_v[0].is_nan() && none.first_v().is_none());
    let (kernel, _, result, peaks) = run(&file, 2.0);
    let times: Vec<f64> = (0..=200_000).map(|k| 2.0 + 1e-5 * f64::from(k)).collect();
    let instants = result.trajectory.at(&kernel, &times);
    let sizes = instants.iter().map(|at| {
        kernel
            .plant
            .patch_voltages_v(&kernel.plant.to_physical(&at.state, at.time_s))[0]
            .abs()
    });
    let sampling_error = 1.0 - sizes.fold(0.0, f64::max) / peaks.patches_v[0];
    eprintln!("{peaks:?}, looks miss {sampling_error:e}");
    assert!(
        (-1e-12..1e-6).contains(&sampling_error),
        "{sampling_error:e}"
    );
}

/// A drive of 3 kHz with the transient of the start in the averaging window of 3000 cycles: the peak is
/// not below the rms voltage. Without a record of the window there is no peak.
#[test]
fn a_transient_of_many_cycles_has_its_peak() {
    let file = changed(&[
        ("drive.shaker.frequency", "3 kHz"),
        ("run.start", "rest"),
        ("run.duration", "1 s"),
        ("run.average_over", "1 s"),
    ]);
    let spec = file.spec().unwrap();
    let plant = Plant::new(System::assemble(&spec, modes(&spec).unwrap()).unwrap()).unwrap();
    let kernel = Kernel::new(plant).unwrap();
    let plan = RunPlan::of(&spec.run, 0.0);
    let run = |plan: &RunPlan| simulate(&kernel, &StartState::rest(&kernel.plant), plan).unwrap();
    assert!(output_peaks(&kernel, &run(&plan)).loads_v[0].is_nan());
    let result = run(&plan.watching(&spec, &kernel.plant));
    let peak_v = output_peaks(&kernel, &result).loads_v[0];
    let rms_v = result.loads[0].voltage_rms_v;
    assert!(
        peak_v > rms_v && result.peak_window_s == 1.0,
        "{peak_v} {rms_v}"
    );
}
