//! Drives, gravity and free bodies go together.

use super::Broken;
use super::overlap::free_below;
use crate::spec::nearest::clip;
use crate::spec::{Drive, DriveKind, DriveSignal, Quantity, Spec};

/// Most samples of one drive: 0.8 GB.
const MOST_SAMPLES: f64 = 1e8;

pub(super) fn check(spec: &Spec, broken: &mut Broken) {
    for (name, drive) in &spec.drive {
        check_kind(name, drive, broken);
        check_signal(spec, name, drive, broken);
        if drive.kind != DriveKind::Force {
            check_participation(spec, &format!("drive.{name}.kind"), "a motion of the base", broken);
        }
    }
    if spec.gravity.acceleration_m_s2.is_some_and(|acceleration| acceleration != 0.0) {
        check_participation(spec, "gravity.acceleration", "gravity", broken);
    }
    let pulled = spec.gravity.acceleration_m_s2.is_some_and(|acceleration| acceleration != 0.0);
    let met = |name: &str| spec.stop.values().any(|stop| [&stop.at, &stop.frame].iter().any(|point| free_below(spec, point) == Some(name)));
    for (name, _) in spec.mass.iter().filter(|(name, mass)| mass.on == "nothing" && !pulled && !met(name)) {
        let text = || "is \"nothing\", so the mass would drift for ever: give [gravity] or a [stop.NAME] that it strikes".to_owned();
        broken.push(|| format!("mass.{name}.on"), text);
    }
}

fn check_kind(name: &str, drive: &Drive, broken: &mut Broken) {
    let text = match (drive.kind, &drive.signal) {
        (DriveKind::BaseDisplacement, signal) if !matches!(signal, DriveSignal::Sine { .. }) => {
            "is \"base-displacement\", which goes with signal = \"sine\" only, as the others would jump in velocity where they start, end or bend: \
             give their second derivative as \"base-acceleration\""
        }
        (DriveKind::Force, DriveSignal::VelocityStep { .. }) => {
            "is \"force\", but a velocity step is one of the base: set kind = \"base-acceleration\""
        }
        _ => return,
    };
    broken.push(|| format!("drive.{name}.kind"), || text.to_owned());
}

fn check_signal(spec: &Spec, name: &str, drive: &Drive, broken: &mut Broken) {
    let hertz = |value: f64| Quantity::Frequency.write(value);
    let mut samples = 0.0;
    match drive.signal {
        DriveSignal::Noise { low_hz, high_hz, sample_rate_hz, .. } => {
            if low_hz >= high_hz {
                broken.push(|| format!("drive.{name}.low"), || format!("is {}, not below high = {}", hertz(low_hz), hertz(high_hz)));
            }
            let least_hz = 4.0 * high_hz;
            if let Some(rate_hz) = sample_rate_hz.filter(|rate_hz| *rate_hz < least_hz) {
                let text = || format!("is {}; at least four times high = {} is due", hertz(rate_hz), hertz(high_hz));
                broken.push(|| format!("drive.{name}.sample_rate"), text);
            }
            samples = sample_rate_hz.unwrap_or(DriveSignal::SAMPLES_PER_CYCLE * high_hz) * spec.run.duration_s;
        }
        DriveSignal::Chirp { from_hz, to_hz, duration_s, .. } => {
            samples = duration_s * from_hz.max(to_hz) * DriveSignal::CHIRP_SAMPLES_PER_CYCLE;
        }
        _ => {}
    }
    if samples > MOST_SAMPLES {
        let text = || format!("would take {samples:.1e} samples, more than {MOST_SAMPLES:.0e}; shorten the run or lower the frequency");
        broken.push(|| format!("drive.{name}.signal"), text);
    }
}

fn check_participation(spec: &Spec, key: &str, what: &str, broken: &mut Broken) {
    for (name, _) in spec.modal.iter().filter(|(_, modal)| modal.participation_sqrt_kg.is_empty() && !modal.frequency_hz.is_empty()) {
        let text = || format!("{what} acts on the mass of each mode: give modal.{}.participation_sqrt_kg", clip(name));
        broken.push(|| key.to_owned(), text);
    }
}
