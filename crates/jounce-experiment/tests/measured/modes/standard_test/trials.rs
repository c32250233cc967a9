//! One trial: four records, a fit, and where the truth lies in each interval.

use super::predictions::{coupling_squared, mean_squares, optimum, power, sensor_deviation};
use super::records::{flank_feature, identified_mode, loaded_mode, record};
use super::{FIFTH_OHM, FLANKS_HZ, KEYS, LOADS_OHM, RATE_HZ, file, with_load};
use jounce_analysis::AnalysisError;
use jounce_control::Control;
use jounce_experiment::fit::{Features, FitResult, fit};
use jounce_fft::Complex;
use jounce_model::plant::Plant;
use jounce_signal::spectral::mean_power;
use jounce_signal::{NORMAL_95, RandomStream};
use jounce_spec::Spec;
use std::f64::consts::TAU;
use std::path::Path;

/// What a trial finds: name, and where the truth lies in its interval: -1 at the lower end, 1 at the upper end.
pub type Inside = Vec<(&'static str, f64)>;

fn normalized_error((low, high): (f64, f64), truth: f64) -> f64 {
    (2.0 * truth - low - high) / (high - low)
}

/// The truth with every fitted key drawn from its prior.
fn first_guess(truth: &Spec, stream: &mut RandomStream) -> Spec {
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
    guess
}

/// Features of the records over four loads, and where the loaded modes lie in their intervals.
fn features_of_records(
    truth: &Spec,
    responses: &[Vec<Complex<f64>>],
    stream: &mut RandomStream,
) -> (Features, Inside) {
    let mut inside = Inside::new();
    let mut features = Features {
        free: KEYS.map(|(key, prior)| (key.to_owned(), prior)).to_vec(),
        ..Features::default()
    };
    for (ohm, response) in LOADS_OHM.iter().zip(responses) {
        let (responses, mode) = identified_mode(record(response, stream));
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
    (features, inside)
}

/// Where the true keys lie in the intervals of the fitted ones.
fn fitted_keys(truth: &Spec, result: &FitResult) -> Inside {
    let (file, mut inside) = (file(), Inside::new());
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
    inside
}

/// Where the measured power over the fifth load lies in the interval of the prediction.
fn fifth_load(
    result: &FitResult,
    fitted: &Spec,
    response: &[Complex<f64>],
    stream: &mut RandomStream,
) -> f64 {
    let fifth = record(response, stream);
    let volts = jounce_signal::Samples::new(&fifth.channels[1].values, RATE_HZ).expect("samples");
    let measured = mean_power(&volts, FIFTH_OHM, false)
        .expect("a power")
        .mean_power_w;
    let base = mean_squares(&fifth.channels[0].values);
    let predicted = result
        .derived(fitted, |spec| power(spec, &base))
        .expect("a power");
    // The interval of the prediction is that of the fitted keys; the noise of the sensors adds to it.
    let noise = NORMAL_95 * sensor_deviation(fitted, &base);
    let widened =
        |end: f64, sign: f64| predicted.value + sign * (end - predicted.value).hypot(noise);
    normalized_error(
        (widened(predicted.low, -1.0), widened(predicted.high, 1.0)),
        measured,
    )
}

pub fn trial(truth: &Spec, responses: &[Vec<Complex<f64>>], seed: u64) -> Inside {
    let mut stream = RandomStream::new(seed, 23);
    let guess = first_guess(truth, &mut stream);
    let (features, mut inside) = features_of_records(truth, responses, &mut stream);
    let (result, fitted) = fit(
        &file(),
        &guess,
        &features,
        Path::new("."),
        &Control::default(),
    )
    .unwrap_or_else(|fault| panic!("{seed}: {fault}"));
    inside.extend(fitted_keys(truth, &result));
    let mut holds = |name, of: &dyn Fn(&Spec) -> Result<f64, AnalysisError>| {
        let (interval, value) = (
            result.derived(&fitted, of).expect("a number"),
            of(truth).expect("a number"),
        );
        inside.push((name, normalized_error((interval.low, interval.high), value)));
    };
    holds("coupling", &coupling_squared);
    holds("optimal load", &optimum);
    let fifth = fifth_load(&result, &fitted, &responses[LOADS_OHM.len()], &mut stream);
    inside.push(("fifth load", fifth));
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
