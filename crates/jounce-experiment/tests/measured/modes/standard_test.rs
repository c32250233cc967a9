//! The standard test of a harvester: the base shaken by noise, the voltage recorded over four loads.
//!
//! Each record gives the response in V per m/s^2 and from it the mode of the harvester under its load. The loaded modes fit the spec: frequency,
//! damping, coupling, capacitance; the flanks of the responses, where damping counts for little, its participation. From the fitted spec follow the
//! optimal load, and the power over a fifth load under the base as it was recorded there.

use jounce_analysis::AnalysisError;
use jounce_control::Control;
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_experiment::fit::{
    Deviation, Features, MeasuredLines, ModeFeature, ResponseFeature, fit,
};
use jounce_experiment::rig::Sensor;
use jounce_identification::modal::{Band, ModalSettings, Mode, identify};
use jounce_identification::response::{ChannelChoice, Excitation, MeasuredResponses};
use jounce_model::linear::{FrfInput, FrfResponse, frf, optimal_resistance};
use jounce_model::plant::{Plant, System};
use jounce_model::structure;
use jounce_signal::RandomStream;
use jounce_signal::spectral::{ImpactSettings, mean_power};
use jounce_spec::{Spec, SpecFile};
use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex;
use std::f64::consts::TAU;
use std::path::Path;

/// A cantilever of two modes with a patch, coupling squared 4 %, without stops; the drive is where the optimal load is asked for.
const RIG: &str = r#"
[modal.beam]
frequency_hz = [60.0, 370.0]
damping_ratio = [0.012, 0.01]
participation_sqrt_kg = [0.09, 0.05]

[modal.beam.point]
tip = [11.0, -10.0]

[modal.beam.patch.piezo]
coupling_n_per_v = [0.0151, 0.02]
capacitance = "40 nF"

[circuit.load]
patch = "beam.piezo"
resistance = "50 kohm"

[drive.shaker]
kind = "base-acceleration"
frequency = "61 Hz"
amplitude = "1 m/s^2"
"#;
/// The keys that are fitted and the deviations of their priors: the capacitance comes from a meter, the others from a first guess.
const KEYS: [(&str, f64); 5] = [
    ("modal.beam.frequency_hz.1", 0.05),
    ("modal.beam.damping_ratio.1", 0.5),
    ("modal.beam.patch.piezo.coupling_n_per_v.1", 0.3),
    ("modal.beam.patch.piezo.capacitance", 0.02),
    ("modal.beam.participation_sqrt_kg.1", 0.3),
];
const LOADS_OHM: [f64; 4] = [15e3, 50e3, 150e3, 500e3];
const FIFTH_OHM: f64 = 90e3;
const LOAD: &str = "circuit.load.resistance";
const RATE_HZ: f64 = 1024.0;
const SAMPLES: usize = 1 << 16;
/// Noise of each sensor over the rms of its signal.
const NOISE: f64 = 0.01;
/// Bands in which the mode is sought, the next one where none is clear in that before.
const BANDS_HZ: [(f64, f64); 3] = [(35.0, 110.0), (45.0, 85.0), (50.0, 76.0)];
/// Flanks of the responses, Hz: below and above the mode under every load, where it counts for little.
const FLANKS_HZ: [(f64, f64); 2] = [(42.0, 55.0), (68.0, 85.0)];
/// Length of a block: thirty decay times of the mode, and 31 blocks to tell the scatter by.
const BLOCK_S: f64 = 4.0;
/// One of so many lines of a flank is taken: windows make neighbours alike.
const EACH: usize = 4;

fn file() -> SpecFile {
    SpecFile::from_text(RIG)
}

fn spec() -> Spec {
    file().spec().unwrap_or_else(|faults| panic!("{faults}"))
}

fn plant(spec: &Spec) -> Plant {
    Plant::new(System::assemble(spec, structure::modes(spec).expect("modes")).expect("a system"))
        .expect("a plant")
}

fn with_load(spec: &Spec, ohm: f64) -> Plant {
    let mut spec = spec.clone();
    spec.set_si(LOAD, ohm).expect("a load");
    spec.take_drives_away();
    plant(&spec)
}

/// Voltage over the load per acceleration of the base.
fn voltage(plant: &Plant, frequency_hz: &[f64]) -> Vec<Complex<f64>> {
    let output = [FrfResponse::LoadVoltage("load".to_owned())];
    frf(plant, &FrfInput::BaseAcceleration, &output, frequency_hz)
        .expect("a response")
        .remove(0)
        .value
}

fn line_hz() -> Vec<f64> {
    (0..=SAMPLES / 2)
        .map(|k| k as f64 * RATE_HZ / SAMPLES as f64)
        .collect()
}

/// A base under white noise of 3 m/s^2 rms and the voltage in the steady state, with noise of 1 % of the rms of each.
fn record(response: &[Complex<f64>], stream: &mut RandomStream) -> Recording {
    let base: Vec<f64> = (0..SAMPLES / 2)
        .flat_map(|_| stream.normal_pair())
        .map(|x| 3.0 * x)
        .collect();
    let mut planner = RealFftPlanner::new();
    let (forward, backward) = (
        planner.plan_fft_forward(SAMPLES),
        planner.plan_fft_inverse(SAMPLES),
    );
    let (mut input, mut bins) = (base.clone(), forward.make_output_vec());
    forward
        .process(&mut input, &mut bins)
        .expect("the plan made the length");
    bins.iter_mut()
        .zip(response)
        .for_each(|(bin, h)| *bin *= h / SAMPLES as f64);
    let last = bins.len() - 1;
    (bins[0].im, bins[last].im) = (0.0, 0.0);
    let mut volts = backward.make_output_vec();
    backward
        .process(&mut bins, &mut volts)
        .expect("the plan made the length");
    let sensor = Sensor {
        noise_ratio: NOISE,
        bits: Some(16),
    };
    let channels = vec![
        Channel::new(
            "base",
            Quantity::Acceleration,
            "m/s^2",
            sensor.read(&base, stream),
        ),
        Channel::new("piezo", Quantity::Voltage, "V", sensor.read(&volts, stream)),
    ];
    let grid = Grid::even(0.0, 1.0 / RATE_HZ, SAMPLES).expect("a grid");
    Recording {
        name: "shaken".to_owned(),
        over: Over::Time,
        grid,
        channels,
        issues: Vec::new(),
    }
}

/// The response that a record gives, and the one mode in its band.
fn identified_mode(record: Recording) -> (MeasuredResponses, Mode) {
    let chosen = ChannelChoice {
        excitation: Excitation::Channel("base".to_owned()),
        ..ChannelChoice::default()
    };
    let responses = MeasuredResponses::of_hits(
        &[record],
        &chosen,
        &ImpactSettings {
            block_s: Some(BLOCK_S),
            ..ImpactSettings::default()
        },
    )
    .unwrap_or_else(|fault| panic!("{fault}"));
    assert_eq!(
        (responses.units[0].as_str(), responses.functions[0].blocks),
        ("V/(m/s^2)", 31)
    );
    assert_eq!(responses.per_g(0), Some((9.806_65, "V/g".to_owned())));
    let identify_in = |band| {
        identify(
            &Band::of(&responses, band).expect("a band"),
            ModalSettings::default(),
        )
        .ok()
    };
    let identification = BANDS_HZ
        .into_iter()
        .find_map(identify_in)
        .expect("modes in one of the bands");
    let mode = identification
        .modes
        .into_iter()
        .filter(|mode| (55.0..68.0).contains(&mode.frequency_hz));
    let mode = mode
        .max_by(|a, b| a.residue[0].norm().total_cmp(&b.residue[0].norm()))
        .expect("a mode");
    (responses, mode)
}

/// Half of an interval of 95 % as a deviation, relative.
fn deviation(half_width: f64, value: f64) -> Deviation {
    Deviation::Given(half_width / Mode::QUANTILE_95 / value)
}

fn conditions(ohm: f64) -> Vec<(String, String)> {
    vec![(LOAD.to_owned(), format!("{ohm} ohm"))]
}

fn loaded_mode(mode: &Mode, ohm: f64) -> ModeFeature {
    let (hz, ratio) = (mode.frequency_hz, mode.damping_ratio);
    ModeFeature {
        number: 1,
        frequency: Some((hz, deviation(mode.frequency_half_width_hz(), hz))),
        damping_ratio: Some((ratio, deviation(mode.damping_half_width(), ratio))),
        loaded: true,
        set: conditions(ohm),
    }
}

/// Lines of a flank with the deviation by their coherence.
fn flank_feature(
    responses: &MeasuredResponses,
    (low, high): (f64, f64),
    ohm: f64,
) -> ResponseFeature {
    let function = &responses.functions[0];
    let inside =
        (0..function.value.len()).filter(|k| (low..=high).contains(&function.frequency_hz[*k]));
    let lines: Vec<usize> = inside.step_by(EACH).collect();
    let square = lines
        .iter()
        .map(|k| function.relative_deviation(*k).powi(2))
        .sum::<f64>()
        / lines.len() as f64;
    let value = lines.iter().map(|k| function.value[*k]).collect();
    ResponseFeature {
        input: FrfInput::BaseAcceleration,
        output: FrfResponse::LoadVoltage("load".to_owned()),
        lines: MeasuredLines::Complex(
            lines.iter().map(|k| function.frequency_hz[*k]).collect(),
            value,
        ),
        absolute: false,
        deviation: Deviation::Given(square.sqrt()),
        set: conditions(ohm),
    }
}

/// Where the load draws the most under the drive of the spec.
fn optimum(spec: &Spec) -> Result<f64, AnalysisError> {
    Ok(optimal_resistance(&plant(spec), 0)
        .expect("an optimum")
        .resistance_ohm)
}

fn coupling_squared(spec: &Spec) -> Result<f64, AnalysisError> {
    Ok(
        jounce_model::linear::couplings(&structure::modes(spec).expect("modes"))[0]
            .coupling_squared,
    )
}

/// Mean power over the fifth load under a base as it was recorded, all its lines at which the first mode responds.
fn power(spec: &Spec, base: &[(f64, f64)]) -> Result<f64, AnalysisError> {
    let frequency_hz: Vec<f64> = base.iter().map(|(hz, _)| *hz).collect();
    let voltages = voltage(&with_load(spec, FIFTH_OHM), &frequency_hz);
    Ok(voltages
        .iter()
        .zip(base)
        .map(|(h, (_, square))| h.norm_sqr() * square)
        .sum::<f64>()
        / FIFTH_OHM)
}

/// Standard deviation of that power by the noise of the sensors, W. Noise adds `2 Re(X* N)` to the square of a line `X`; the noise of the base
/// stands in the prediction, that of the voltage in the measured power.
fn sensor_deviation(spec: &Spec, base: &[(f64, f64)]) -> f64 {
    let frequency_hz: Vec<f64> = base.iter().map(|(hz, _)| *hz).collect();
    let voltages = voltage(&with_load(spec, FIFTH_OHM), &frequency_hz);
    let mean_squares: Vec<(f64, f64)> = voltages
        .iter()
        .zip(base)
        .map(|(h, (_, square))| (h.norm_sqr(), *square))
        .collect();
    let base_noise = NOISE.powi(2) * base.iter().map(|(_, square)| square).sum::<f64>()
        / mean_squares.len() as f64;
    let volt_noise = NOISE.powi(2)
        * mean_squares
            .iter()
            .map(|(h, square)| h * square)
            .sum::<f64>()
        / mean_squares.len() as f64;
    let variance = mean_squares
        .iter()
        .map(|(h, square)| 2.0 * h * square * (h * base_noise + volt_noise))
        .sum::<f64>();
    variance.sqrt() / FIFTH_OHM
}

/// Mean square of each line of a record.
fn mean_squares(values: &[f64]) -> Vec<(f64, f64)> {
    let plan = RealFftPlanner::new().plan_fft_forward(values.len());
    let (mut input, mut bins) = (values.to_vec(), plan.make_output_vec());
    plan.process(&mut input, &mut bins)
        .expect("the plan made the length");
    let square = |(hz, bin): (f64, &Complex<f64>)| {
        (hz, 2.0 * bin.norm_sqr() / (values.len() as f64).powi(2))
    };
    line_hz()
        .into_iter()
        .zip(&bins)
        .map(square)
        .filter(|(hz, _)| *hz > 1.0)
        .collect()
}

/// What a trial finds: name, and where the truth lies in its interval: -1 at the lower end, 1 at the upper end.
type Inside = Vec<(&'static str, f64)>;

fn normalized_error((low, high): (f64, f64), truth: f64) -> f64 {
    (2.0 * truth - low - high) / (high - low)
}

fn trial(truth: &Spec, responses: &[Vec<Complex<f64>>], seed: u64) -> Inside {
    let mut stream = RandomStream::new(seed, 23);
    let mut guess = truth.clone();
    let file = file();
    for (key, prior) in KEYS {
        let value = file
            .numeric_key(key)
            .expect("a key")
            .get(truth)
            .expect("a value");
        guess
            .set_si(key, value * (prior * stream.normal_pair()[0]).exp())
            .expect("a value");
    }
    let mut inside = Inside::new();
    let mut features = Features {
        free: KEYS.map(|(key, prior)| (key.to_owned(), prior)).to_vec(),
        ..Features::default()
    };
    for (ohm, response) in LOADS_OHM.iter().zip(responses) {
        let (responses, mode) = identified_mode(record(response, &mut stream));
        let (hz, ratio) = pole(&with_load(truth, *ohm));
        inside.push((
            "loaded frequency",
            (hz - mode.frequency_hz) / mode.frequency_half_width_hz(),
        ));
        inside.push((
            "loaded damping",
            (ratio - mode.damping_ratio) / mode.damping_half_width(),
        ));
        features.modes.push(loaded_mode(&mode, *ohm));
        features
            .responses
            .extend(FLANKS_HZ.map(|band| flank_feature(&responses, band, *ohm)));
    }
    let (result, fitted) = fit(
        &file,
        &guess,
        &features,
        Path::new("."),
        &Control::default(),
    )
    .unwrap_or_else(|fault| panic!("{seed}: {fault}"));
    for (name, key) in ["frequency", "damping", "", "", "participation"]
        .into_iter()
        .zip(&result.keys)
        .filter(|(name, _)| !name.is_empty())
    {
        let value = file
            .numeric_key(&key.key)
            .expect("a key")
            .get(truth)
            .expect("a value");
        inside.push((name, normalized_error((key.low, key.high), value)));
    }
    let mut holds = |name, of: &dyn Fn(&Spec) -> Result<f64, AnalysisError>| {
        let (interval, value) = (
            result.derived(&fitted, of).expect("a number"),
            of(truth).expect("a number"),
        );
        inside.push((name, normalized_error((interval.low, interval.high), value)));
    };
    holds("coupling", &coupling_squared);
    holds("optimal load", &optimum);
    let fifth = record(&responses[LOADS_OHM.len()], &mut stream);
    let volts = jounce_signal::Samples::new(&fifth.channels[1].values, RATE_HZ).expect("samples");
    let measured = mean_power(&volts, FIFTH_OHM, false)
        .expect("a power")
        .mean_power_w;
    let base = mean_squares(&fifth.channels[0].values);
    let predicted = result
        .derived(&fitted, |spec| power(spec, &base))
        .expect("a power");
    // The interval of the prediction is that of the fitted keys; the noise of the sensors adds to it.
    let noise = Mode::QUANTILE_95 * sensor_deviation(&fitted, &base);
    let widened =
        |end: f64, sign: f64| predicted.value + sign * (end - predicted.value).hypot(noise);
    inside.push((
        "fifth load",
        normalized_error(
            (widened(predicted.low, -1.0), widened(predicted.high, 1.0)),
            measured,
        ),
    ));
    inside
}

/// Frequency, Hz, and damping ratio of the first pole that turns.
fn pole(plant: &Plant) -> (f64, f64) {
    let upper_half_plane = plant
        .diagonal
        .block
        .pairs
        .iter()
        .map(|pair| pair.eigenvalue())
        .filter(|p| p.im > 0.0);
    let p = upper_half_plane
        .min_by(|a, b| a.norm().total_cmp(&b.norm()))
        .expect("a pole");
    (p.norm() / TAU, -p.re / p.norm())
}

/// Trials of every run; `JOUNCE_TRIALS=200` makes as many as the figure rests on.
const TRIALS: u64 = 16;

/// Measured in 800 trials: the intervals hold 93.6 % of the frequencies and 94.4 % of the damping ratios of the loaded modes, 92.8 % of the
/// fitted ones, 95.5 % of the couplings, 92.9 % of the optimal loads and 93.9 % of the powers over the fifth load; each share of 800 has a
/// standard deviation of 0.9 %. Without the noise of the sensors the intervals hold 90 % of these powers: they are 0.22 % wide on each side,
/// and the noise of the base moves the prediction by 0.06 % (standard deviation).
#[test]
fn intervals_of_the_standard_test_have_their_coverage() {
    let trials = std::env::var("JOUNCE_TRIALS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(TRIALS);
    let truth = spec();
    let at = line_hz();
    let response = |ohm: &f64| voltage(&with_load(&truth, *ohm), &at);
    let responses: Vec<Vec<Complex<f64>>> =
        LOADS_OHM.iter().chain([&FIFTH_OHM]).map(response).collect();
    let inside_by_trial: Vec<Inside> = (0..trials)
        .into_par_iter()
        .map(|seed| trial(&truth, &responses, seed))
        .collect();
    for name in [
        "loaded frequency",
        "loaded damping",
        "frequency",
        "damping",
        "participation",
        "coupling",
        "optimal load",
        "fifth load",
    ] {
        let of: Vec<f64> = inside_by_trial
            .iter()
            .flatten()
            .filter(|(of, _)| *of == name)
            .map(|(_, normalized_error)| *normalized_error)
            .collect();
        let mean = |of: &dyn Fn(f64) -> f64, all: &[f64]| {
            all.iter()
                .map(|normalized_error| of(*normalized_error))
                .sum::<f64>()
                / all.len() as f64
        };
        let share = mean(
            &|normalized_error| f64::from(u8::from(normalized_error.abs() <= 1.0)),
            &of,
        );
        let (middle, rms) = (
            mean(&|normalized_error| normalized_error, &of),
            mean(&|normalized_error| normalized_error * normalized_error, &of).sqrt(),
        );
        eprintln!(
            "{name}: {share:.4} of {} inside, truth at {middle:.2} and {rms:.2} rms of the half width",
            of.len()
        );
        let allowed = match name {
            // Of 16 trials three misses are as rare as one in a hundred.
            _ if trials < 200 => 0.8..=1.0,
            _ => 0.92..=0.98,
        };
        assert!(allowed.contains(&share), "{name}: {share}");
    }
}
