//! Attractors and their shares against plain marches, and exponents against closed forms.

use crate::harvesters::bench;
use jounce::march::{Kernel, Marcher};
use jounce::orbit::Harvester;
use jounce::reference::ImpactOscillator;
use jounce::study::{Basins, BasinsAnswer, Cloud, Parameter, Prepared, largest_exponent};
use std::f64::consts::TAU;

const CLOUD: Cloud = Cloud { starts: 24, seed: 3, spread: 20.0 };

fn basins(frequency_hz: f64) -> BasinsAnswer {
    let file = bench();
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    Basins { base: &base, parameter: &parameter, value: frequency_hz, cloud: CLOUD, tolerance: 1e-8 }.run().unwrap()
}

/// Mean power over the last cycles of a long march.
fn marched_power_w(kernel: &Kernel, start: &[f64], frequency_hz: f64) -> f64 {
    let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(start, 0.0), 0.0, 1e-8).unwrap();
    marcher.advance_to(1200.0 / frequency_hz).unwrap();
    let before: f64 = marcher.energies().loads_j.iter().sum();
    marcher.advance_to(1212.0 / frequency_hz).unwrap();
    (marcher.energies().loads_j.iter().sum::<f64>() - before) * frequency_hz / 12.0
}

#[test]
fn shares_are_those_of_plain_marches() {
    let frequency_hz = 12.0;
    let answer = basins(frequency_hz);
    for a in &answer.attractors {
        eprintln!("{}: {:.6e} W, {:?}", a.id, a.mean_power_w, a.share);
    }
    assert!(answer.attractors.len() > 1, "two attractors are known at 12 Hz");
    let file = bench();
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let kernel = Parameter::new(&base, &key, 1.0).at(frequency_hz).unwrap().kernel;
    let mut sum = 0.0;
    for index in 0..CLOUD.starts {
        let power_w = marched_power_w(&kernel, &CLOUD.start(&kernel.plant, index), frequency_hz);
        let home = answer.attractors.iter().find(|a| a.starts.contains(&index)).unwrap();
        assert!((power_w / home.mean_power_w - 1.0).abs() < 1e-4, "start {index}: {power_w:e} W, not on {}", home.id);
        sum += power_w / CLOUD.starts as f64;
    }
    assert!((answer.expected_power_w / sum - 1.0).abs() < 1e-4, "{} {sum}", answer.expected_power_w);
    assert!(answer.expected_power_low_w < sum && sum < answer.expected_power_high_w);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let with = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| basins(12.0));
    assert_eq!(with(1), with(3));
}

/// Without contact every motion decays like the slowest mode.
#[test]
fn the_exponent_of_a_linear_plant_is_its_slowest_decay() {
    let mut file = bench();
    file.set("stop.tip.gap", "\"500 mm\"").unwrap();
    let kernel = Prepared::new(file.spec().unwrap()).unwrap().kernel;
    let slowest = kernel.plant.diagonal.block.eigenvalues().iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
    let found = largest_exponent(&kernel, &vec![0.0; kernel.plant.len()], 640, 1e-8).unwrap();
    eprintln!("exponent {} +- {}, slowest decay {slowest}", found.exponent_per_s, found.error_per_s);
    assert!((found.exponent_per_s / slowest - 1.0).abs() < 2e-2 && !found.is_chaotic());
}

/// A stable orbit has the exponent `ln |multiplier| / T` of the closed form; an oscillator that chatters past its doublings has a
/// positive one, the same by the divergence of two marches.
#[test]
fn exponents_of_the_impact_oscillator() {
    let oscillator = |gap: f64, frequency_ratio: f64| ImpactOscillator { frequency_ratio, damping_ratio: 0.05, restitution: 0.8, gap };
    let kernel = |gap: f64, frequency_ratio: f64| {
        Kernel::new(jounce::plant::Plant::new(oscillator(gap, frequency_ratio).system(0.3)).unwrap()).unwrap()
    };
    let settled = |kernel: &Kernel, frequency_ratio: f64| {
        let mut marcher = Marcher::new(kernel, &kernel.plant.from_physical(&[0.0, 0.0], 0.0), 0.0, 1e-10).unwrap();
        marcher.advance_to(400.0 * TAU / frequency_ratio).unwrap();
        marcher.state()
    };
    let stable = kernel(0.5, 0.8);
    let found = largest_exponent(&stable, &settled(&stable, 0.8), 320, 1e-10).unwrap();
    let [trace, determinant] = oscillator(0.5, 0.8).orbits(1).pop().unwrap().trace_determinant;
    let modulus = if trace * trace < 4.0 * determinant {
        determinant.sqrt()
    } else {
        0.5 * (trace.abs() + (trace * trace - 4.0 * determinant).sqrt())
    };
    let exact = modulus.ln() * 0.8 / TAU;
    eprintln!("stable: {} +- {}, closed form {exact}", found.exponent_per_s, found.error_per_s);
    assert!((found.exponent_per_s / exact - 1.0).abs() < 2e-2 && !found.is_chaotic());
}
