//! Numbers of the signal of a drive. A number that the signal lacks reads as NaN and is not set.

use crate::{DriveSignal, FrequencySweep};

pub(super) fn signal_word(signal: &DriveSignal) -> &'static str {
    match signal {
        DriveSignal::Sine { .. } => "sine",
        DriveSignal::Chirp { .. } => "chirp",
        DriveSignal::HalfSine { .. } => "half-sine",
        DriveSignal::VelocityStep { .. } => "velocity-step",
        DriveSignal::Noise { .. } => "noise",
        DriveSignal::Recording { .. } => "recording",
    }
}

pub(super) fn blank_signal(word: &str) -> DriveSignal {
    let (hole, start_s) = (f64::NAN, 0.0);
    match word {
        "chirp" => DriveSignal::Chirp {
            amplitude: hole,
            from_hz: hole,
            to_hz: hole,
            sweep: FrequencySweep::default(),
            phase_rad: 0.0,
            start_s,
            duration_s: hole,
        },
        "half-sine" => DriveSignal::HalfSine {
            amplitude: hole,
            start_s,
            duration_s: hole,
        },
        "velocity-step" => DriveSignal::VelocityStep {
            velocity_m_s: hole,
            start_s,
        },
        "noise" => DriveSignal::Noise {
            density: hole,
            low_hz: 0.0,
            high_hz: hole,
            sample_rate_hz: None,
            seed: 1,
        },
        "recording" => DriveSignal::recording(""),
        _ => DriveSignal::Sine {
            amplitude: hole,
            frequency_hz: hole,
            phase_rad: 0.0,
        },
    }
}

pub(super) fn amplitude(signal: &DriveSignal) -> f64 {
    match *signal {
        DriveSignal::Sine { amplitude, .. }
        | DriveSignal::Chirp { amplitude, .. }
        | DriveSignal::HalfSine { amplitude, .. } => amplitude,
        _ => f64::NAN,
    }
}

pub(super) fn set_amplitude(signal: &mut DriveSignal, value: f64) {
    if let DriveSignal::Sine { amplitude, .. }
    | DriveSignal::Chirp { amplitude, .. }
    | DriveSignal::HalfSine { amplitude, .. } = signal
    {
        *amplitude = value;
    }
}

pub(super) fn ends(signal: &DriveSignal) -> [f64; 2] {
    if let DriveSignal::Chirp { from_hz, to_hz, .. } = *signal {
        [from_hz, to_hz]
    } else {
        [f64::NAN; 2]
    }
}

pub(super) fn set_end(signal: &mut DriveSignal, end: usize, value: f64) {
    if let DriveSignal::Chirp { from_hz, to_hz, .. } = signal {
        *[from_hz, to_hz][end] = value;
    }
}

pub(super) fn sweep_word(signal: &DriveSignal) -> &'static str {
    if matches!(
        signal,
        DriveSignal::Chirp {
            sweep: FrequencySweep::Logarithmic,
            ..
        }
    ) {
        "logarithmic"
    } else {
        "linear"
    }
}

pub(super) fn set_sweep(signal: &mut DriveSignal, word: &str) {
    if let DriveSignal::Chirp { sweep, .. } = signal {
        *sweep = if word == "logarithmic" {
            FrequencySweep::Logarithmic
        } else {
            FrequencySweep::Linear
        };
    }
}

pub(super) fn phase(signal: &DriveSignal) -> f64 {
    if let DriveSignal::Sine { phase_rad, .. } | DriveSignal::Chirp { phase_rad, .. } = *signal {
        phase_rad
    } else {
        f64::NAN
    }
}

pub(super) fn set_phase(signal: &mut DriveSignal, value: f64) {
    if let DriveSignal::Sine { phase_rad, .. } | DriveSignal::Chirp { phase_rad, .. } = signal {
        *phase_rad = value;
    }
}

pub(super) fn velocity(signal: &DriveSignal) -> f64 {
    if let DriveSignal::VelocityStep { velocity_m_s, .. } = *signal {
        velocity_m_s
    } else {
        f64::NAN
    }
}

pub(super) fn set_velocity(signal: &mut DriveSignal, value: f64) {
    if let DriveSignal::VelocityStep { velocity_m_s, .. } = signal {
        *velocity_m_s = value;
    }
}

pub(super) fn start(signal: &DriveSignal) -> f64 {
    match *signal {
        DriveSignal::Chirp { start_s, .. }
        | DriveSignal::HalfSine { start_s, .. }
        | DriveSignal::VelocityStep { start_s, .. }
        | DriveSignal::Recording { start_s, .. } => start_s,
        DriveSignal::Sine { .. } | DriveSignal::Noise { .. } => f64::NAN,
    }
}

pub(super) fn set_start(signal: &mut DriveSignal, value: f64) {
    match signal {
        DriveSignal::Chirp { start_s, .. }
        | DriveSignal::HalfSine { start_s, .. }
        | DriveSignal::VelocityStep { start_s, .. }
        | DriveSignal::Recording { start_s, .. } => *start_s = value,
        DriveSignal::Sine { .. } | DriveSignal::Noise { .. } => {}
    }
}

pub(super) fn duration(signal: &DriveSignal) -> f64 {
    if let DriveSignal::Chirp { duration_s, .. } | DriveSignal::HalfSine { duration_s, .. } =
        *signal
    {
        duration_s
    } else {
        f64::NAN
    }
}

pub(super) fn set_duration(signal: &mut DriveSignal, value: f64) {
    if let DriveSignal::Chirp { duration_s, .. } | DriveSignal::HalfSine { duration_s, .. } = signal
    {
        *duration_s = value;
    }
}

pub(super) fn band(signal: &DriveSignal) -> [f64; 2] {
    if let DriveSignal::Noise {
        low_hz, high_hz, ..
    } = *signal
    {
        [low_hz, high_hz]
    } else {
        [f64::NAN; 2]
    }
}

pub(super) fn set_band(signal: &mut DriveSignal, end: usize, value: f64) {
    if let DriveSignal::Noise {
        low_hz, high_hz, ..
    } = signal
    {
        *[low_hz, high_hz][end] = value;
    }
}
