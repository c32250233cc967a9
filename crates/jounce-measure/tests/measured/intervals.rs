//! How often the stated intervals of identified modes hold the truth of the virtual rig.

use jounce::drive::Stream;
use jounce::linear::{Input, Response, frf};
use jounce::plant::{Plant, System};
use jounce::spec::SpecFile;
use jounce::structure;
use jounce_measure::modal::{Band, Settings, identify};
use jounce_measure::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_measure::response::{Chosen, Responses};
use jounce_measure::rig::{HammerTest, Sensor, hammer_test};
use jounce_measure::spectral::ImpactSettings;
use realfft::RealFftPlanner;

/// Three modes in the band and three above it, the first of them near.
const RIG: &str = r#"
[modal.beam]
frequency_hz = [62.0, 110.0, 205.0, 330.0, 470.0, 640.0]
damping_ratio = [0.012, 0.008, 0.006, 0.010, 0.005, 0.004]

[modal.beam.point]
struck = [1.0, -1.1, 0.9, 1.2, -1.0, 1.1]
tip = [1.5, 1.4, 1.3, -1.5, 1.2, 1.4]
middle = [0.8, -0.5, -0.9, 1.0, 0.7, -0.6]
"#;
const TRUTH: [(f64, f64); 3] = [(62.0, 0.012), (110.0, 0.008), (205.0, 0.006)];
const BAND_HZ: (f64, f64) = (30.0, 270.0);
const RATE_HZ: f64 = 2048.0;

fn plant() -> Plant {
    let spec = SpecFile::from_text(RIG).spec().unwrap_or_else(|faults| panic!("{faults}"));
    let modes = structure::modes(&spec).expect("modes");
    Plant::new(System::assemble(&spec, modes).expect("a system")).expect("a plant")
}

fn accelerations() -> Vec<Response> {
    ["beam.tip", "beam.middle"].map(|point| Response::Acceleration(point.to_owned())).to_vec()
}

/// Hits in one recording.
fn struck(plant: &Plant, (hits, block_s, noise): (usize, f64, f64), seed: u64) -> Recording {
    let test = HammerTest {
        point: "beam.struck".to_owned(),
        responses: accelerations(),
        hits,
        block_s,
        peak_force_n: 50.0,
        contact_time_s: 2e-3,
        rate_hz: RATE_HZ,
        sensor: Sensor { noise_ratio: noise, bits: Some(16) },
        seed,
    };
    hammer_test(plant, &test).unwrap_or_else(|fault| panic!("{fault}"))
}

/// A shaker's white noise, its answer in the steady state.
fn shaken(plant: &Plant, (samples, noise): (usize, f64), seed: u64) -> Recording {
    let mut stream = Stream::new(seed, 7);
    let force: Vec<f64> = (0..samples / 2).flat_map(|_| stream.normal_pair()).collect();
    let mut planner = RealFftPlanner::new();
    let (forward, backward) = (planner.plan_fft_forward(samples), planner.plan_fft_inverse(samples));
    let (mut input, mut spectrum) = (force.clone(), forward.make_output_vec());
    forward.process(&mut input, &mut spectrum).expect("the plan made the length");
    let frequency_hz: Vec<f64> = (0..spectrum.len()).map(|k| k as f64 * RATE_HZ / samples as f64).collect();
    let functions = frf(plant, &Input::Force("beam.struck".to_owned()), &accelerations(), &frequency_hz).expect("responses");
    let sensor = Sensor { noise_ratio: noise, bits: Some(16) };
    let mut channels = vec![Channel::new("force", Quantity::Force, "N", sensor.read(&force, &mut stream))];
    for function in functions {
        let mut bins: Vec<_> = spectrum.iter().zip(&function.value).map(|(f, h)| f * h / samples as f64).collect();
        let last = bins.len() - 1;
        (bins[0].im, bins[last].im) = (0.0, 0.0);
        let mut values = backward.make_output_vec();
        backward.process(&mut bins, &mut values).expect("the plan made the length");
        channels.push(Channel::new(&function.response.name(), Quantity::Acceleration, "m/s^2", sensor.read(&values, &mut stream)));
    }
    let grid = Grid::even(0.0, 1.0 / RATE_HZ, samples).expect("a grid");
    Recording { name: "shaken".to_owned(), over: Over::Time, grid, channels, findings: Vec::new() }
}

fn trials(name: &str, count: u64, settings: &ImpactSettings, record: impl Fn(u64) -> Recording) {
    let mut inside = [[0_u32; 2]; 3];
    let (mut bias, mut square, mut stated) = ([[0.0; 2]; 3], [[0.0; 2]; 3], [[0.0; 2]; 3]);
    let (mut found_all, mut misfit, mut extra) = (0_u32, 0.0, 0);
    let clock = std::time::Instant::now();
    for seed in 0..count {
        let responses = Responses::of_hits(&[record(seed)], &Chosen::default(), settings).unwrap_or_else(|fault| panic!("{fault}"));
        let band = Band::of(&responses, BAND_HZ).expect("a band");
        let mut found = identify(&band, Settings { order: 16 }).unwrap_or_else(|fault| panic!("{seed}: {fault}"));
        found.modes.iter_mut().for_each(|mode| mode.without_decay(responses.window_decay_per_s));
        misfit += found.misfit / count as f64;
        extra += found.modes.len() as i32 - 3;
        for (r, (hz, ratio)) in TRUTH.into_iter().enumerate() {
            let near = found.modes.iter().find(|mode| (mode.frequency_hz / hz - 1.0).abs() < 0.02);
            let Some(mode) = near else { continue };
            found_all += 1;
            let off = [mode.frequency_hz - hz, mode.damping_ratio - ratio];
            let deviation = [mode.frequency_deviation_hz, mode.damping_deviation];
            for k in 0..2 {
                inside[r][k] += u32::from(off[k].abs() <= mode.quantile_95 * deviation[k]);
                bias[r][k] += off[k] / count as f64;
                square[r][k] += off[k] * off[k] / count as f64;
                stated[r][k] += deviation[k] * deviation[k] / count as f64;
            }
        }
    }
    eprintln!("{name}: found {found_all} of {}, extra {extra}, misfit {misfit:.2}, {:.1} s", 3 * count, clock.elapsed().as_secs_f64());
    for r in 0..3 {
        for k in 0..2 {
            let spread = (square[r][k] - bias[r][k] * bias[r][k]).sqrt();
            eprintln!(
                "  {r}{}: inside {:.3}, spread {spread:.2e}, bias/spread {:.2}, stated/spread {:.2}",
                ["f", "z"][k],
                f64::from(inside[r][k]) / count as f64,
                bias[r][k] / spread,
                stated[r][k].sqrt() / spread
            );
        }
    }
    let all: u32 = inside.iter().flatten().sum();
    eprintln!("  all {:.3}", f64::from(all) / (6 * count) as f64);
}

#[test]
fn stated_intervals_hold_the_truth_of_the_rig() {
    let plant = plant();
    let count: u64 = std::env::var("TRIALS").ok().and_then(|t| t.parse().ok()).unwrap_or(400);
    let plain = ImpactSettings::default();
    let windowed = ImpactSettings { end_ratio: Some(0.01), ..plain };
    let blocks = |block_s| ImpactSettings { block_s: Some(block_s), ..plain };
    trials("5 hits, 1 %", count, &plain, |seed| struck(&plant, (5, 2.0, 0.01), seed));
    trials("5 hits, 5 %", count, &plain, |seed| struck(&plant, (5, 2.0, 0.05), seed));
    trials("3 hits, 1 %", count, &plain, |seed| struck(&plant, (3, 2.0, 0.01), seed));
    trials("20 hits, 1 %", count, &plain, |seed| struck(&plant, (20, 2.0, 0.01), seed));
    trials("20 hits, 0.1 %", count, &plain, |seed| struck(&plant, (20, 2.0, 0.001), seed));
    trials("5 hits, window", count, &windowed, |seed| struck(&plant, (5, 2.0, 0.01), seed));
    trials("5 hits, short blocks", count, &ImpactSettings { block_s: Some(0.5), ..plain }, |seed| struck(&plant, (5, 2.0, 0.01), seed));
    trials("shaker", count, &blocks(2.0), |seed| shaken(&plant, (1 << 15, 0.01), seed));
    trials("shaker, long", count, &blocks(2.0), |seed| shaken(&plant, (1 << 17, 0.01), seed));
}
