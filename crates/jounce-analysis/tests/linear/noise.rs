//! Linear responses to noise: closed forms of an oscillator, agreement of two methods, and errors.

use crate::expected::{plant, spec};
use jounce_model::linear::{
    LevelCrossing, NoiseInput, Random, RandomError, covariance, density, noise_bandwidth_hz,
    product, spectral_moment, statistical_bandwidth_hz,
};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::{Modes, modes};
use jounce_spec::Spec;
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

const FREQUENCY_HZ: f64 = 7.0;
const DENSITY: f64 = 0.3;
const WHITE: [f64; 2] = [0.0, f64::INFINITY];

/// A mass of 1 kg on a spring and a dashpot.
fn oscillator(damping_ratio: f64) -> Plant {
    let modes = Modes {
        frequency_rad_s: vec![TAU * FREQUENCY_HZ],
        damping_ratio: vec![damping_ratio],
        shape: BTreeMap::from([("mass".into(), vec![1.0])]),
        participation_sqrt_kg: vec![1.0],
        discretisation_error: vec![0.0],
        ..Modes::default()
    };
    Plant::new(System {
        modes: modes.into(),
        ..System::default()
    })
    .unwrap()
}

fn relative(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

/// Mean squares `S pi f / (4 zeta w^4)` and `S pi f / (4 zeta w^2)`, bandwidths
/// `pi zeta (1 - zeta^2) f`, `pi zeta f` and `2 pi zeta f / (1 + 4 zeta^2)`, upcrossings of the
/// mean `f`. Measured: 5.3e-13.
#[test]
fn an_oscillator_under_white_noise_is_its_closed_form() {
    let w = TAU * FREQUENCY_HZ;
    let mut worst = 0.0_f64;
    for zeta in [0.001, 0.02, 0.3, 0.6] {
        let plant = oscillator(zeta);
        let noise = [NoiseInput::of_base(&plant, DENSITY, WHITE)];
        let (displacement, speed) = (plant.displacement_row(&[1.0]), plant.velocity_row(&[1.0]));
        let covariance = covariance(&plant, &noise).unwrap();
        let square = DENSITY * PI * FREQUENCY_HZ / (4.0 * zeta * w.powi(4));
        let crossing = LevelCrossing {
            mean_m: 2e-3,
            deviation_m: product(&covariance, &displacement, &displacement).sqrt(),
            velocity_m_s: product(&covariance, &speed, &speed).sqrt(),
            level_m: 2e-3,
        };
        let errors = [
            relative(product(&covariance, &displacement, &displacement), square),
            relative(product(&covariance, &speed, &speed), w * w * square),
            product(&covariance, &displacement, &speed).abs() / (w * square),
            relative(
                spectral_moment(&plant, &noise, &displacement, 1).unwrap(),
                square,
            ),
            relative(
                noise_bandwidth_hz(&plant, &noise[0], &displacement).unwrap(),
                PI * zeta * (1.0 - zeta * zeta) * FREQUENCY_HZ,
            ),
            relative(
                noise_bandwidth_hz(&plant, &noise[0], &speed).unwrap(),
                PI * zeta * FREQUENCY_HZ,
            ),
            relative(
                statistical_bandwidth_hz(&plant, &noise, &displacement).unwrap(),
                TAU * zeta * FREQUENCY_HZ / (1.0 + 4.0 * zeta * zeta),
            ),
            relative(crossing.rate_hz(), FREQUENCY_HZ),
            relative(crossing.share_beyond(), 0.5),
        ];
        worst = errors.iter().fold(worst, |max, error| max.max(*error));
        assert!(
            errors.iter().all(|error| *error < 1e-9),
            "{zeta}: {errors:?}"
        );
    }
    eprintln!("largest error {worst:.1e}");
}

/// Any band, of oscillators below, at and above critical damping, against quadrature; bands sum to
/// white noise. Measured: 7.3e-16 of the white-noise result.
#[test]
fn a_band_is_the_integral_over_it() {
    let mut worst = 0.0_f64;
    for zeta in [0.01, 0.7, 1.0, 3.0] {
        let plant = oscillator(zeta);
        let rows = [plant.displacement_row(&[1.0]), plant.velocity_row(&[1.0])];
        for row in &rows {
            let by_solve = |band_hz: [f64; 2]| {
                product(
                    &covariance(&plant, &[NoiseInput::of_base(&plant, DENSITY, band_hz)]).unwrap(),
                    row,
                    row,
                )
            };
            let white = by_solve(WHITE);
            let mut sum = 0.0;
            for band_hz in [
                [0.0, 2.0],
                [2.0, 6.9],
                [6.9, 7.1],
                [7.1, 50.0],
                [50.0, f64::INFINITY],
            ] {
                let noise = [NoiseInput::of_base(&plant, DENSITY, band_hz)];
                let error = (by_solve(band_hz) - spectral_moment(&plant, &noise, row, 1).unwrap())
                    .abs()
                    / white;
                worst = worst.max(error);
                sum += by_solve(band_hz);
                assert!(error < 1e-9, "{zeta} {band_hz:?}: {error:e}");
            }
            assert!(
                relative(sum, white) < 1e-12,
                "{zeta}: {:e}",
                relative(sum, white)
            );
        }
    }
    eprintln!("largest error {worst:.1e}");
}

/// Two patches on circuits, one open, eight modes, three noises at once. Measured: 1.0e-15.
#[test]
fn both_methods_agree_on_harvesters() {
    for (example, settings) in [
        ("bimorph-erturk-2009", &[][..]),
        ("impact-harvester-2019", &[]),
        (
            "white-noise-adhikari-2009",
            &[("circuit.load.inductance", "51.73 H")],
        ),
    ] {
        let plant = plant(example, settings);
        let bands = [[0.0, 300.0], [20.0, 120.0], [80.0, f64::INFINITY]];
        let noises: Vec<NoiseInput> = bands
            .into_iter()
            .map(|band_hz| NoiseInput::of_base(&plant, DENSITY, band_hz))
            .collect();
        let covariance = covariance(&plant, &noises).unwrap();
        let points = plant
            .system
            .modes
            .shape
            .values()
            .flat_map(|shape| [plant.displacement_row(shape), plant.velocity_row(shape)]);
        let mut worst = 0.0_f64;
        for row in points
            .chain([plant.load_voltage_row(0), plant.voltage_row(0)])
            .filter(|row| row.iter().any(|c| *c != 0.0))
        {
            let (solved, integrated) = (
                product(&covariance, &row, &row),
                spectral_moment(&plant, &noises, &row, 1).unwrap(),
            );
            worst = worst.max(relative(integrated, solved));
        }
        eprintln!("{example}: {worst:.1e}");
        assert!(worst < 1e-8, "{example}: {worst:e}");
    }
}

/// The paper's harvester on a shaker with noise: all reported values, and their sums from the
/// densities.
#[test]
fn a_spec_is_evaluated_without_its_stop() {
    let spec =
        Spec::from_toml(include_str!("../../../../examples/random-base/shaker.toml")).unwrap();
    let random = Random::new(&spec).unwrap();
    let result = random.response().unwrap();
    let (load, stop) = (&result.loads[0], &result.stops[0]);
    eprintln!("{load:?} {stop:?}");
    assert!(
        load.difference_relative.abs() < 1e-9
            && relative(load.voltage_rms_v.powi(2) / 1e6, result.mean_power_w) < 1e-12
    );
    assert!(load.statistical_bandwidth_hz > 0.0 && load.noise_bandwidth_hz[0] > 0.0);
    assert!(
        stop.displacement_rms_m > 0.0
            && stop.reached_hz.unwrap() > 0.0
            && stop.share_beyond.unwrap() < 0.5
            && result.left_out.is_empty()
    );
    let frequencies_hz = random.frequencies_hz(2.0, 30.0, 20_000);
    let densities = random.densities(&frequencies_hz).unwrap();
    let until_third = |calls: &std::cell::Cell<u32>| calls.replace(calls.get() + 1) % 3 == 2;
    let (calls, complete) = (std::cell::Cell::new(0), &densities[0].value);
    let stopped = random
        .densities_until(&frequencies_hz, &|| until_third(&calls))
        .unwrap();
    assert_eq!(stopped[0].value, complete[..2]);
    let voltage = densities
        .iter()
        .find(|density| density.name == "load.load_voltage")
        .unwrap();
    let trapezia: f64 = (1..frequencies_hz.len())
        .map(|k| {
            0.5 * (frequencies_hz[k] - frequencies_hz[k - 1])
                * (voltage.value[k] + voltage.value[k - 1])
        })
        .sum();
    // Linear interpolation between the frequencies: 2e-5.
    assert!(
        relative(trapezia, load.voltage_rms_v.powi(2)) < 1e-3,
        "{trapezia}"
    );
    let system = System::assemble(&spec, modes(&spec).unwrap()).unwrap();
    let noises = NoiseInput::of_spec(&spec, &system.modes).unwrap();
    let plant = Plant::new(system).unwrap();
    assert_eq!(
        density(&plant, &noises, &plant.load_voltage_row(0), 31.0).unwrap(),
        0.0
    );
}

#[test]
fn a_spec_without_linear_response_is_refused() {
    let refused = |spec: &Spec| Random::new(spec).unwrap_err();
    assert_eq!(
        refused(&spec("bimorph-erturk-2009", &[])),
        RandomError::NoNoise
    );

    let rectified = spec("rectified-shu-lien-2006", &[]);
    assert!(
        matches!(refused(&rectified), RandomError::Rectified { circuit } if circuit == "rectifier")
    );
    let text = "[mass.ball]\non = \"nothing\"\nmass = \"1 kg\"\n[stop.wall]\nat = \"ball\"\ngap = \"1 mm\"\nlaw = \"rigid\"\nrestitution = 0.5\n\
        [drive.d]\nat = \"ball\"\nsignal = \"noise\"\npsd = \"1 N^2/Hz\"\nhigh = \"10 Hz\"\n";
    let free = refused(&Spec::from_toml(text).unwrap());
    assert!(
        matches!(&free, RandomError::Unsteady { drive, mode_hz: 0.0 } if drive == "d"),
        "{free}"
    );
}
