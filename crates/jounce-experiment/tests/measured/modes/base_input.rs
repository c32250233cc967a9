//! Responses to the motion of a base and to a voltage: units, equal modes from every kind of input,
//! and errors.

use jounce_data::recording::{Channel, Grid, Over, Quantity, Recording};
use jounce_fft::Complex;
use jounce_identification::modal::{Band, ModalSettings, identify};
use jounce_identification::response::{
    ChannelChoice, Excitation, MeasuredResponses, ResponseError,
};
use jounce_signal::spectral::{Estimator, FrequencyResponse, ImpactSettings, WindowBias};
use std::f64::consts::TAU;

/// Frequency, Hz, damping ratio, participation at the tip. The participations sum to 1, as those of
/// all modes of a structure do.
const MODES: [(f64, f64, f64); 3] = [(40.0, 0.01, 1.5), (150.0, 0.015, -0.7), (290.0, 0.02, 0.2)];

/// Acceleration of the tip relative to the base, per acceleration of the base.
fn relative(hz: f64) -> Complex<f64> {
    let w = TAU * hz;
    let of = |(f, z, part): &(f64, f64, f64)| {
        *part * w * w / Complex::new((TAU * f).powi(2) - w * w, 2.0 * z * TAU * f * w)
    };
    MODES.iter().map(of).sum()
}

/// Motion of the tip per motion of the base, each of a given kind; the kinds differ by factors
/// `j w`.
fn transfer_function(output: Quantity, input: Quantity, hz: f64) -> Complex<f64> {
    let power = |quantity: Quantity| match quantity {
        Quantity::Displacement => 0,
        Quantity::Velocity => 1,
        _ => 2,
    };
    (relative(hz) + 1.0) * Complex::new(0.0, TAU * hz).powi(power(output) - power(input))
}

fn responses(output: Quantity, input: Quantity) -> MeasuredResponses {
    let frequency_hz: Vec<f64> = (40..1400).map(|k| f64::from(k) * 0.25).collect();
    let value: Vec<_> = frequency_hz
        .iter()
        .map(|hz| transfer_function(output, input, *hz))
        .collect();
    let coherence = vec![1.0; value.len()];
    MeasuredResponses {
        outputs: vec!["tip".to_owned()],
        references: vec!["base".to_owned()],
        names: vec!["tip".to_owned()],
        units: vec![String::new()],
        quantities: vec![output],
        input: "base".to_owned(),
        inputs: vec![input],
        functions: vec![FrequencyResponse {
            frequency_hz,
            value,
            coherence,
            blocks: 1,
            window_bias: WindowBias::Whole,
            leave_one_out: Vec::new(),
        }],
        hits: Vec::new(),
        block_s: None,
        window_decay_per_s: 0.0,
        issues: Vec::new(),
    }
}

/// Nine pairs of displacement, velocity and acceleration of tip and base: equal modes, and equal
/// participation. Measured: all within 1e-15.
#[test]
fn every_motion_of_tip_and_base_gives_the_same_modes_and_participation() {
    let kinds = [
        Quantity::Displacement,
        Quantity::Velocity,
        Quantity::Acceleration,
    ];
    for (output, input) in kinds
        .iter()
        .flat_map(|output| kinds.iter().map(move |input| (*output, *input)))
    {
        let responses = responses(output, input);
        let identification = identify(
            &Band::of(&responses, (10.0, 349.0)).expect("a band"),
            ModalSettings { order: 16 },
        )
        .expect("modes");
        assert_eq!(
            identification.modes.len(),
            3,
            "{output:?} {input:?}: {:?}",
            identification.modes
        );
        for (mode, (hz, ratio, part)) in identification.modes.iter().zip(MODES) {
            let participation = mode.base_participation(&responses).expect("a base")[0];
            let errors = [
                mode.frequency_hz / hz - 1.0,
                mode.damping_ratio / ratio - 1.0,
                participation.re / part - 1.0,
                participation.im / part,
            ];
            eprintln!(
                "{output:?} per {input:?}, {hz} Hz: {:.1e} {:.1e} {:.1e}",
                errors[0], errors[1], errors[2]
            );
            assert!(errors.iter().all(|error| error.abs() < 1e-12), "{errors:?}");
        }
    }
    assert_eq!(found_under_a_force(), None);
}

fn found_under_a_force() -> Option<usize> {
    let responses = responses(Quantity::Acceleration, Quantity::Force);
    let identification = identify(
        &Band::of(&responses, (10.0, 349.0)).expect("a band"),
        ModalSettings { order: 16 },
    )
    .expect("modes");
    identification.modes[0]
        .base_participation(&responses)
        .map(|parts| parts.len())
}

/// A noise-like signal and its double as the response, in given units.
fn shaker_record(
    input: (Quantity, &str),
    output: (Quantity, &str),
    turns: impl Fn(u32) -> f64,
) -> Recording {
    let values: Vec<f64> = (0..8000).map(turns).collect();
    let two_bases = values.iter().map(|x| 2.0 * x).collect();
    let channels = vec![
        Channel::new("in", input.0, input.1, values),
        Channel::new("out", output.0, output.1, two_bases),
    ];
    Recording {
        name: "shaken".to_owned(),
        over: Over::Time,
        grid: Grid::even(0.0, 1e-3, 8000).expect("a grid"),
        channels,
        issues: Vec::new(),
    }
}

fn continuous_signal(k: u32) -> f64 {
    (f64::from(k) * 0.7).sin() + (f64::from(k).powi(2) * 1e-4).sin()
}

fn of(record: &Recording, settings: &ImpactSettings) -> Result<MeasuredResponses, ResponseError> {
    let chosen = ChannelChoice {
        excitation: Excitation::Channel("in".to_owned()),
        ..ChannelChoice::default()
    };
    MeasuredResponses::of_hits(std::slice::from_ref(record), &chosen, settings)
}

const PLAIN: ImpactSettings = ImpactSettings {
    estimator: Estimator::H1,
    block_s: None,
    force_window: false,
    end_ratio: None,
    shaker: false,
};

#[test]
fn units_are_those_of_output_and_input() {
    use Quantity::{Acceleration, Displacement, Force, Velocity, Voltage};
    let cases = [
        (
            (Acceleration, "m/s^2"),
            (Voltage, "V"),
            "V/(m/s^2)",
            Some("V/g"),
            false,
        ),
        (
            (Acceleration, "m/s^2"),
            (Acceleration, "m/s^2"),
            "m/s^2/(m/s^2)",
            None,
            true,
        ),
        (
            (Acceleration, "m/s^2"),
            (Displacement, "m"),
            "m/(m/s^2)",
            Some("m/g"),
            false,
        ),
        ((Displacement, "m"), (Displacement, "m"), "m/m", None, true),
        ((Velocity, "m/s"), (Voltage, "V"), "V/(m/s)", None, false),
        ((Voltage, "V"), (Velocity, "m/s"), "m/s/V", None, false),
        (
            (Force, "N"),
            (Acceleration, "m/s^2"),
            "m/s^2/N",
            None,
            false,
        ),
    ];
    for (input, output, unit, per_g, transmits) in cases {
        let responses = of(&shaker_record(input, output, continuous_signal), &PLAIN)
            .unwrap_or_else(|fault| panic!("{fault}"));
        assert_eq!(
            (
                responses.units[0].as_str(),
                responses.inputs[0],
                responses.references[0].as_str()
            ),
            (unit, input.0, "in")
        );
        assert_eq!(
            responses.per_g(0),
            per_g.map(|unit| (9.806_65, unit.to_owned()))
        );
        assert_eq!(responses.is_transmissibility(0), transmits);
        assert!((responses.functions[0].value[112] - 2.0).norm() < 1e-9);
        // A written unit is read as that of a file of responses.
        assert_eq!(jounce_data::recording::Unit::per(unit), Some(input.0));
    }
}

#[test]
fn a_channel_that_cannot_be_an_input_is_refused() {
    let volts = (Quantity::Voltage, "V");
    let error = |record: &Recording, chosen: &ChannelChoice| {
        MeasuredResponses::of_hits(std::slice::from_ref(record), chosen, &PLAIN)
            .expect_err("a refusal")
            .to_string()
    };
    let channel = |name: &str| ChannelChoice {
        excitation: Excitation::Channel(name.to_owned()),
        ..ChannelChoice::default()
    };
    let without_unit = shaker_record((Quantity::Unknown, ""), volts, continuous_signal);
    assert!(error(&without_unit, &channel("in")).contains("has no unit"));
    let counts = shaker_record((Quantity::Unknown, "counts"), volts, continuous_signal);
    assert!(error(&counts, &channel("in")).contains("the unit counts"));
    let base = shaker_record((Quantity::Acceleration, "m/s^2"), volts, continuous_signal);
    assert!(error(&base, &ChannelChoice::default()).contains("--input"));
    assert!(
        error(
            &base,
            &ChannelChoice {
                excitation: Excitation::Force("in".to_owned()),
                ..ChannelChoice::default()
            }
        )
        .contains("--input")
    );
    assert!(error(&base, &channel("nowhere")).contains("nowhere"));
    assert!(
        error(
            &base,
            &ChannelChoice {
                responses: vec!["in".to_owned()],
                ..channel("in")
            }
        )
        .contains("cannot respond to itself")
    );
    let pulse = shaker_record((Quantity::Acceleration, "m/s^2"), volts, |k| {
        if (20..30).contains(&k) { 50.0 } else { 0.0 }
    });
    assert!(error(&pulse, &channel("in")).contains("--shaker"));
    assert!(
        of(
            &pulse,
            &ImpactSettings {
                shaker: true,
                ..PLAIN
            }
        )
        .is_ok()
    );
    let other = shaker_record((Quantity::Velocity, "m/s"), volts, continuous_signal);
    let fault = MeasuredResponses::of_hits(&[base, other], &channel("in"), &PLAIN)
        .expect_err("a refusal")
        .to_string();
    assert!(fault.contains("one kind of input"), "{fault}");
}
