//! `[drive.NAME]`

use crate::key::{Key, Keyed, Kind, Range, Slot};
use crate::{Drive, DriveKind, DriveSignal, GROUND, Quantity};

use super::FREQUENCY_LIMITS_HZ;
use super::drive_signal::{
    amplitude, band, blank_signal, duration, ends, phase, set_amplitude, set_band, set_duration,
    set_end, set_phase, set_start, set_sweep, set_velocity, signal_word, start, sweep_word,
    velocity,
};

const KINDS: &[&str] = &["force", "base-acceleration", "base-displacement"];
const BASE_KINDS: &[&str] = &["base-acceleration", "base-displacement"];
const SIGNALS: &[&str] = &[
    "sine",
    "chirp",
    "half-sine",
    "velocity-step",
    "noise",
    "recording",
];
const AMPLITUDES: &[&str] = &["sine", "chirp", "half-sine"];
const FREQUENCIES: Range = Range::from(FREQUENCY_LIMITS_HZ.0, FREQUENCY_LIMITS_HZ.1);

/// Largest seed: a double represents every integer up to this value exactly.
const MAX_SEED: f64 = 9_007_199_254_740_991.0;

impl Keyed for Drive {
    const KEYS: &'static [Key<Self>] = KEYS;

    fn blank() -> Self {
        Self {
            at: String::new(),
            kind: DriveKind::Force,
            signal: blank_signal("sine"),
        }
    }
}

static KEYS: &[Key<Drive>] = &[
    Key::text("kind", Kind::Choice(KINDS), "prescribed quantity", |d: &Drive| kind_word(d.kind).to_owned(), |d, x| d.kind = kind(x))
        .optional(),
    Key::text(
        "signal",
        Kind::Choice(SIGNALS),
        "waveform",
        |d: &Drive| signal_word(&d.signal).to_owned(),
        |d, x| d.signal = blank_signal(x),
    )
    .optional(),
    Key::text("at", Kind::Reference { what: "a point or mass" }, "point or mass on which the force acts", |d: &Drive| d.at.clone(), |d, x| x.clone_into(&mut d.at))
        .when("kind", &["force"]),
    Key::text(
        "at",
        Kind::Reference { what: "a base or \"ground\"" },
        "base that moves: `\"ground\"`, or a name used as the support of roots, masses and stop frames",
        |d: &Drive| d.base().unwrap_or(GROUND).to_owned(),
        |d, x| if x == GROUND { d.at.clear() } else { x.clone_into(&mut d.at) },
    )
    .when("kind", BASE_KINDS)
    .optional(),
    Key::quantity(
        "amplitude",
        Quantity::Force,
        "zero-to-peak amplitude: a force, an acceleration (m/s^2, g) with `base-acceleration`, a length with `base-displacement`",
        |d: &Drive| amplitude(&d.signal),
        |d, x| set_amplitude(&mut d.signal, x),
    )
    .within(Range::NOT_NEGATIVE)
    .when("signal", AMPLITUDES)
    .measured_by("kind", size),
    Key::quantity(
        "frequency",
        Quantity::Frequency,
        "frequency",
        |d: &Drive| d.frequency_hz().unwrap_or(f64::NAN),
        |d, x| {
            if let DriveSignal::Sine { frequency_hz, .. } = &mut d.signal {
                *frequency_hz = x;
            }
        },
    )
    .within(FREQUENCIES)
    .when("signal", &["sine"]),
    Key::quantity(
        "from",
        Quantity::Frequency,
        "start frequency",
        |d: &Drive| ends(&d.signal)[0],
        |d, x| set_end(&mut d.signal, 0, x),
    )
    .within(FREQUENCIES)
    .when("signal", &["chirp"]),
    Key::quantity("to", Quantity::Frequency, "end frequency", |d: &Drive| ends(&d.signal)[1], |d, x| set_end(&mut d.signal, 1, x))
        .within(FREQUENCIES)
        .when("signal", &["chirp"]),
    Key::text(
        "sweep",
        Kind::Choice(&["linear", "logarithmic"]),
        "variation of the frequency with time",
        |d: &Drive| sweep_word(&d.signal).to_owned(),
        |d, x| set_sweep(&mut d.signal, x),
    )
    .when("signal", &["chirp"])
    .optional(),
    Key::quantity("phase", Quantity::Angle, "phase at the start of the signal", |d: &Drive| phase(&d.signal), |d, x| set_phase(&mut d.signal, x))
        .when("signal", &["sine", "chirp"])
        .optional(),
    Key::quantity(
        "velocity",
        Quantity::Speed,
        "change of the base velocity",
        |d: &Drive| velocity(&d.signal),
        |d, x| set_velocity(&mut d.signal, x),
    )
    .when("signal", &["velocity-step"]),
    Key::quantity("start", Quantity::Time, "start time of the signal", |d: &Drive| start(&d.signal), |d, x| set_start(&mut d.signal, x))
        .within(Range::NOT_NEGATIVE)
        .when("signal", &["chirp", "half-sine", "velocity-step", "recording"])
        .optional(),
    Key::quantity("duration", Quantity::Time, "duration of the signal", |d: &Drive| duration(&d.signal), |d, x| set_duration(&mut d.signal, x))
        .within(Range::POSITIVE)
        .when("signal", &["chirp", "half-sine"]),
    Key::quantity(
        "psd",
        Quantity::ForcePsd,
        "one-sided power spectral density; with `base-acceleration` in (m/s^2)^2/Hz or g^2/Hz",
        |d: &Drive| if let DriveSignal::Noise { density, .. } = d.signal { density } else { f64::NAN },
        |d, x| {
            if let DriveSignal::Noise { density, .. } = &mut d.signal {
                *density = x;
            }
        },
    )
    .within(Range::NOT_NEGATIVE)
    .when("signal", &["noise"])
    .measured_by("kind", density),
    Key::quantity(
        "low",
        Quantity::Frequency,
        "lower band limit",
        |d: &Drive| band(&d.signal)[0],
        |d, x| set_band(&mut d.signal, 0, x),
    )
    .within(Range::from(0.0, FREQUENCY_LIMITS_HZ.1))
    .when("signal", &["noise"])
    .optional(),
    Key::quantity(
        "high",
        Quantity::Frequency,
        "upper band limit",
        |d: &Drive| band(&d.signal)[1],
        |d, x| set_band(&mut d.signal, 1, x),
    )
    .within(FREQUENCIES)
    .when("signal", &["noise"]),
    Key::with_slot(
        "seed",
        Kind::Count,
        "seed of the random realisation",
        Slot::Count {
            get: |d: &Drive| if let DriveSignal::Noise { seed, .. } = d.signal { seed as usize } else { 0 },
            set: |d, x| {
                if let DriveSignal::Noise { seed, .. } = &mut d.signal {
                    *seed = x as u64;
                }
            },
        },
    )
    .within(Range::from(0.0, MAX_SEED))
    .when("signal", &["noise"])
    .optional(),
    Key::text(
        "file",
        Kind::Path,
        "recording in any format that `jounce read` accepts; path relative to the spec",
        |d: &Drive| if let DriveSignal::Recording { file, .. } = &d.signal { file.clone() } else { String::new() },
        |d, x| {
            if let DriveSignal::Recording { file, .. } = &mut d.signal {
                x.clone_into(file);
            }
        },
    )
    .when("signal", &["recording"]),
    Key::text(
        "channel",
        Kind::Text,
        "name of the channel or its number from 1; if omitted, the only varying channel with a fitting unit",
        |d: &Drive| recorded(d).and_then(|[channel, _]| channel.clone()).unwrap_or_default(),
        |d, x| {
            if let DriveSignal::Recording { channel, .. } = &mut d.signal {
                *channel = Some(x.to_owned());
            }
        },
    )
    .when("signal", &["recording"])
    .optional(),
    Key::text(
        "unit",
        Kind::Text,
        "unit of the channel if the file gives no unit, such as `\"g\"`",
        |d: &Drive| recorded(d).and_then(|[_, unit]| unit.clone()).unwrap_or_default(),
        |d, x| {
            if let DriveSignal::Recording { unit, .. } = &mut d.signal {
                *unit = Some(x.to_owned());
            }
        },
    )
    .when("signal", &["recording"])
    .optional(),
    Key::number(
        "scale",
        "factor on the values of the recording",
        |d: &Drive| if let DriveSignal::Recording { scale, .. } = d.signal { scale } else { f64::NAN },
        |d, x| {
            if let DriveSignal::Recording { scale, .. } = &mut d.signal {
                *scale = x;
            }
        },
    )
    .when("signal", &["recording"])
    .optional(),
    Key::text(
        "mean",
        Kind::Choice(&["kept", "removed"]),
        "keep or remove the mean of the channel: `kept` by default for a force, `removed` for an acceleration (gravity and offset)",
        |d: &Drive| match d.signal {
            DriveSignal::Recording { keep_mean: Some(kept), .. } => if kept { "kept" } else { "removed" }.to_owned(),
            _ => String::new(),
        },
        |d, x| {
            if let DriveSignal::Recording { keep_mean, .. } = &mut d.signal {
                *keep_mean = Some(x == "kept");
            }
        },
    )
    .when("signal", &["recording"])
    .optional(),
    Key::with_slot(
        "sample_rate",
        Kind::Quantity(Quantity::Frequency),
        "samples per second: of the noise (default 10 times `high`), or of a recording whose file contains no times",
        Slot::Optional {
            get: |d: &Drive| match d.signal {
                DriveSignal::Noise { sample_rate_hz, .. } | DriveSignal::Recording { sample_rate_hz, .. } => sample_rate_hz,
                _ => None,
            },
            set: |d, x| {
                if let DriveSignal::Noise { sample_rate_hz, .. } | DriveSignal::Recording { sample_rate_hz, .. } = &mut d.signal {
                    *sample_rate_hz = Some(x);
                }
            },
        },
    )
    .within(Range::above(0.0, 1e9))
    .when("signal", &["noise", "recording"])
    .optional(),
];

/// Channel and unit of a recording.
fn recorded(drive: &Drive) -> Option<[&Option<String>; 2]> {
    if let DriveSignal::Recording { channel, unit, .. } = &drive.signal {
        Some([channel, unit])
    } else {
        None
    }
}

/// `None` for a displacement given by samples: no such drive exists.
fn size(drive: &Drive) -> Option<Quantity> {
    match drive.kind {
        DriveKind::Force => Some(Quantity::Force),
        DriveKind::BaseAcceleration => Some(Quantity::Acceleration),
        DriveKind::BaseDisplacement => has_smooth_pieces(&drive.signal).then_some(Quantity::Length),
    }
}

/// Signals with an analytic form, which can also prescribe a displacement.
fn has_smooth_pieces(signal: &DriveSignal) -> bool {
    matches!(
        signal,
        DriveSignal::Sine { .. } | DriveSignal::Chirp { .. } | DriveSignal::HalfSine { .. }
    )
}

fn density(drive: &Drive) -> Option<Quantity> {
    match drive.kind {
        DriveKind::Force => Some(Quantity::ForcePsd),
        DriveKind::BaseAcceleration => Some(Quantity::AccelerationPsd),
        DriveKind::BaseDisplacement => None,
    }
}

fn kind_word(kind: DriveKind) -> &'static str {
    KINDS[kind as usize]
}

fn kind(word: &str) -> DriveKind {
    match word {
        "base-acceleration" => DriveKind::BaseAcceleration,
        "base-displacement" => DriveKind::BaseDisplacement,
        _ => DriveKind::Force,
    }
}
