//! Hammer test of a model.

use std::f64::consts::PI;

use jounce_linalg::c64;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::Plant;
use jounce_signal::RandomStream;

use super::{RigError, Sensor};
use jounce_data::recording::{Channel, Grid, Issue, IssueKind, Over, Quantity, Recording};

/// Hammer test.
#[derive(Debug, Clone, PartialEq)]
pub struct HammerTest {
    /// Impact point.
    pub point: String,
    /// Recorded outputs in addition to the force.
    pub responses: Vec<FrfOutput>,
    /// Number of hits.
    pub hits: usize,
    /// Time between hits, s.
    pub block_s: f64,
    /// Peak force, N; each hit differs from it by up to 20 %.
    pub peak_force_n: f64,
    /// Contact duration, s; each hit differs from it by up to 10 %.
    pub contact_time_s: f64,
    /// Samples per second.
    pub rate_hz: f64,
    /// Sensors.
    pub sensor: Sensor,
    /// Seed of hits and noise.
    pub seed: u64,
}

/// Exponent at which a mode has decayed: its response has fallen by `exp(-18)`, to 1.5e-8.
const DECAY_EXPONENT: f64 = 18.0;
/// Maximum number of samples of a padded record.
const MAX_SAMPLES: usize = 1 << 23;
/// Share of a block before its hit.
const PRE_TRIGGER_SHARE: f64 = 0.02;
const PEAK_SCATTER: f64 = 0.2;
const TIME_SCATTER: f64 = 0.1;

/// Residual motion of a mode at the next hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualRinging {
    /// Frequency of the slowest mode, Hz.
    pub frequency_hz: f64,
    /// Share of its motion that remains after a block, `exp(-zeta w T)`.
    pub remaining_share: f64,
    /// Block length after which 1 % remains, s.
    pub block_s: f64,
}

/// Minimum residual motion that is reported.
const MIN_REPORTED_RINGING: f64 = 0.01;

/// Mode with the longest ringing between the hits of a test. Its residual motion at the next hit is
/// attributed to that hit: with blocks of equal length it does not average out, and the coherence
/// does not show it.
pub fn ringing(plant: &Plant, block_s: f64) -> Option<ResidualRinging> {
    let modes = &plant.system.modes;
    let rates = modes
        .frequency_rad_s
        .iter()
        .zip(&modes.damping_ratio)
        .map(|(w, zeta)| (*w, w * zeta))
        .filter(|(_, rate)| *rate > 0.0);
    let (w, rate) = rates.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(ResidualRinging {
        frequency_hz: w / std::f64::consts::TAU,
        remaining_share: (-rate * block_s).exp(),
        block_s: 100f64.ln() / rate,
    })
}

/// Records a hammer test of a linear plant: `force`, then the responses under their names.
///
/// # Errors
/// A setting out of its range, a point that does not exist, a mode without damping.
pub fn hammer_test(plant: &Plant, test: &HammerTest) -> Result<Recording, RigError> {
    check(test)?;
    let count = (test.hits as f64 * test.block_s * test.rate_hz).round() as usize;
    let padded = padded(plant, count, test.rate_hz)?;
    let mut stream = RandomStream::new(test.seed, 0);
    let force = force(test, count, &mut stream);
    let spectrum = spectrum(&force, padded);
    let frequency_hz: Vec<f64> = (0..spectrum.len())
        .map(|k| k as f64 * test.rate_hz / padded as f64)
        .collect();
    let functions = frf(
        plant,
        &FrfInput::Force(test.point.clone()),
        &test.responses,
        &frequency_hz,
    )?;
    let sensed = |truth: &[f64], stream: &mut RandomStream| test.sensor.read(truth, stream);
    let force_channel = Channel::new("force", Quantity::Force, "N", sensed(&force, &mut stream));
    let mut channels = vec![Channel {
        place: test.point.clone(),
        ..force_channel
    }];
    for function in functions {
        let bins = spectrum.iter().zip(&function.value).map(|(f, h)| f * h);
        let truth = samples(bins.collect(), padded);
        let (quantity, unit) = measured(&function.response);
        channels.push(Channel::new(
            &function.response.name(),
            quantity,
            unit,
            sensed(&truth[..count], &mut stream),
        ));
    }
    let slowest_mode = ringing(plant, test.block_s).filter(|slowest_mode| {
        test.hits > 1 && slowest_mode.remaining_share > MIN_REPORTED_RINGING
    });
    Ok(Recording {
        name: format!("hammer at {}", test.point),
        over: Over::Time,
        grid: Grid::even(0.0, 1.0 / test.rate_hz, count)?,
        channels,
        issues: slowest_mode.iter().map(ResidualRinging::issue).collect(),
    })
}

/// Transform of a record padded with zeros.
fn spectrum(values: &[f64], padded: usize) -> Vec<c64> {
    let forward = jounce_fft::forward(padded);
    let mut input = values.to_vec();
    input.resize(padded, 0.0);
    let mut bins = forward.make_output_vec();
    forward
        .process(&mut input, &mut bins)
        .expect("the plan made the length");
    bins
}

/// Samples of a padded record with a given transform.
fn samples(mut bins: Vec<c64>, padded: usize) -> Vec<f64> {
    // The transform of a real signal has real bins at both ends.
    let last = bins.len() - 1;
    (bins[0].im, bins[last].im) = (0.0, 0.0);
    let backward = jounce_fft::inverse(padded);
    let mut values = backward.make_output_vec();
    backward
        .process(&mut bins, &mut values)
        .expect("the plan made the length");
    values.iter_mut().for_each(|x| *x /= padded as f64);
    values
}

impl ResidualRinging {
    fn issue(&self) -> Issue {
        let message = format!(
            "the mode at {:.4} Hz still has {:.1} % of its motion at the next hit, and this \
            motion is attributed to that hit: use blocks of {:.0} s, or strike once per recording",
            self.frequency_hz,
            100.0 * self.remaining_share,
            self.block_s.ceil()
        );
        Issue::new(IssueKind::Ringing, 1, None, message)
    }
}

fn check(test: &HammerTest) -> Result<(), RigError> {
    test.sensor.check()?;
    let settings = [
        (
            "the number of hits",
            test.hits as f64,
            1.0,
            1000.0,
            "from 1 to 1000",
        ),
        (
            "the time between hits in samples",
            test.block_s * test.rate_hz,
            64.0,
            4e6,
            "from 64 to 4000000: change the rate or the time between hits",
        ),
        (
            "the contact time in samples",
            test.contact_time_s * test.rate_hz,
            3.0,
            1e5,
            "at least 3: raise the rate or soften the tip",
        ),
        (
            "the peak force",
            test.peak_force_n,
            f64::MIN_POSITIVE,
            1e6,
            "above 0",
        ),
    ];
    match settings
        .into_iter()
        .find(|(_, value, low, high, _)| !(*low..=*high).contains(value))
    {
        Some((name, value, _, _, allowed)) => Err(RigError::Setting {
            name,
            value,
            allowed,
        }),
        None => Ok(()),
    }
}

/// Length of the transforms: the record, and the time until the slowest mode has decayed.
fn padded(plant: &Plant, count: usize, rate_hz: f64) -> Result<usize, RigError> {
    let modes = &plant.system.modes;
    let mut slowest_rate = f64::INFINITY;
    for (w, zeta) in modes.frequency_rad_s.iter().zip(&modes.damping_ratio) {
        if w * zeta <= 0.0 {
            return Err(RigError::Undamped {
                frequency_hz: w / std::f64::consts::TAU,
            });
        }
        slowest_rate = slowest_rate.min(w * zeta);
    }
    let samples = count as f64 + DECAY_EXPONENT / slowest_rate * rate_hz;
    if samples > MAX_SAMPLES as f64 {
        return Err(RigError::Long {
            samples,
            most: MAX_SAMPLES,
        });
    }
    Ok((samples.ceil() as usize).next_power_of_two())
}

fn force(test: &HammerTest, count: usize, stream: &mut RandomStream) -> Vec<f64> {
    let mut force = vec![0.0; count];
    for hit in 0..test.hits {
        let peak = test.peak_force_n * (1.0 + PEAK_SCATTER * stream.symmetric());
        let length_s = test.contact_time_s * (1.0 + TIME_SCATTER * stream.symmetric());
        let start_s = (hit as f64 + PRE_TRIGGER_SHARE) * test.block_s;
        for (k, value) in force.iter_mut().enumerate() {
            let phase = (k as f64 / test.rate_hz - start_s) / length_s;
            if (0.0..1.0).contains(&phase) {
                *value += peak * (PI * phase).sin();
            }
        }
    }
    force
}

fn measured(response: &FrfOutput) -> (Quantity, &'static str) {
    match response {
        FrfOutput::Displacement(_) => (Quantity::Displacement, "m"),
        FrfOutput::Velocity(_) => (Quantity::Velocity, "m/s"),
        FrfOutput::Acceleration(_) => (Quantity::Acceleration, "m/s^2"),
        FrfOutput::Voltage(_) | FrfOutput::LoadVoltage(_) => (Quantity::Voltage, "V"),
    }
}
