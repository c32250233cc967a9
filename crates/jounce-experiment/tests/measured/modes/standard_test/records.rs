//! Records of the shaken harvester, and the modes and lines that they give.

use super::{BANDS_HZ, BLOCK_S, EACH, LOAD, NOISE, RATE_HZ, SAMPLES};
use crate::modes::fourier::{spectrum, steady_response};
use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_experiment::fit::{Deviation, MeasuredLines, ModeFeature, ResponseFeature};
use jounce_experiment::rig::Sensor;
use jounce_fft::Complex;
use jounce_identification::modal::{Band, ModalSettings, Mode, identify};
use jounce_identification::response::{ChannelChoice, Excitation, MeasuredResponses};
use jounce_model::linear::{FrfInput, FrfOutput};
use jounce_signal::spectral::ImpactSettings;
use jounce_signal::{NORMAL_95, RandomStream};

/// A base under white noise of 3 m/s^2 rms and the voltage in the steady state, with noise of 1 % of the rms of each.
pub fn record(response: &[Complex<f64>], stream: &mut RandomStream) -> Recording {
    let base: Vec<f64> = (0..SAMPLES / 2)
        .flat_map(|_| stream.normal_pair())
        .map(|x| 3.0 * x)
        .collect();
    let volts = steady_response(&spectrum(&base), response, SAMPLES);
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
pub fn identified_mode(record: Recording) -> (MeasuredResponses, Mode) {
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
    Deviation::Given(half_width / NORMAL_95 / value)
}

fn conditions(ohm: f64) -> Vec<(String, String)> {
    vec![(LOAD.to_owned(), format!("{ohm} ohm"))]
}

pub fn loaded_mode(mode: &Mode, ohm: f64) -> ModeFeature {
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
pub fn flank_feature(
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
        output: FrfOutput::LoadVoltage("load".to_owned()),
        lines: MeasuredLines::Complex(
            lines.iter().map(|k| function.frequency_hz[*k]).collect(),
            value,
        ),
        absolute: false,
        deviation: Deviation::Given(square.sqrt()),
        set: conditions(ohm),
    }
}
