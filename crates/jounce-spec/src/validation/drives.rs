//! Compatibility of drives, gravity and free bodies.

use std::cell::LazyCell;
use std::collections::BTreeSet;

use super::ValidationFaults;
use super::overlap::free_below;
use crate::nearest::clip;
use crate::{Drive, DriveKind, DriveSignal, GROUND, NO_SUPPORT, Quantity, Spec};

/// Sine of the start angle below which a displacement starts at 0; covers the roundoff of 180
/// degrees.
const ZERO_START_ANGLE: f64 = 1e-12;

/// Largest number of samples of one drive: 0.8 GB.
const MAX_DRIVE_SAMPLES: f64 = 1e8;

pub(super) fn check(spec: &Spec, faults: &mut ValidationFaults) {
    let supports = LazyCell::new(|| supports(spec));
    for (name, drive) in &spec.drive {
        check_kind(name, drive, faults);
        check_signal(spec, name, drive, faults);
        check_base(spec, &supports, (name, drive), faults);
        if drive.base() == Some(GROUND) {
            check_participation(
                spec,
                &format!("drive.{name}.kind"),
                "a motion of the base",
                faults,
            );
        }
    }
    if spec
        .gravity
        .acceleration_m_s2
        .is_some_and(|acceleration| acceleration != 0.0)
    {
        check_participation(spec, "gravity.acceleration", "gravity", faults);
    }
    let pulled = spec
        .gravity
        .acceleration_m_s2
        .is_some_and(|acceleration| acceleration != 0.0);
    let is_known = |name: &str| {
        spec.stop.values().any(|stop| {
            [&stop.at, &stop.frame]
                .iter()
                .any(|point| free_below(spec, point) == Some(name))
        })
    };
    for (name, _) in spec
        .mass
        .iter()
        .filter(|(name, mass)| mass.on == NO_SUPPORT && !pulled && !is_known(name))
    {
        let text = || {
            "is \"nothing\", so the mass would drift without bound; add [gravity] or a [stop.NAME] that it strikes".to_owned()
        };
        faults.push(|| format!("mass.{name}.on"), text);
    }
}

fn check_kind(name: &str, drive: &Drive, faults: &mut ValidationFaults) {
    let text = match (drive.kind, &drive.signal) {
        (
            DriveKind::BaseDisplacement,
            DriveSignal::Recording { .. } | DriveSignal::Noise { .. },
        ) => {
            "is \"base-displacement\", but linear interpolation jumps in velocity at every sample, an impulse on everything on the \
             base; give the acceleration with kind = \"base-acceleration\""
        }
        (DriveKind::BaseDisplacement, DriveSignal::VelocityStep { .. }) => {
            "is \"base-displacement\", but a velocity step is not a displacement signal; set kind = \"base-acceleration\""
        }
        (DriveKind::Force, DriveSignal::VelocityStep { .. }) => {
            "is \"force\", but a velocity step moves a base; set kind = \"base-acceleration\""
        }
        _ => return,
    };
    faults.push(|| format!("drive.{name}.kind"), || text.to_owned());
}

/// Returns the supports of beams, masses and stops.
fn supports(spec: &Spec) -> BTreeSet<&str> {
    let beams = spec.beam.values().map(|beam| beam.root.as_str());
    let plates = spec.plate.values().map(|plate| plate.on.as_str());
    let masses = spec.mass.values().map(|mass| mass.on.as_str());
    beams
        .chain(plates)
        .chain(masses)
        .chain(spec.stop.values().map(|stop| stop.frame.as_str()))
        .collect()
}

/// A base other than the ground has a unique name and supports an element; a displacement starts
/// without a jump.
fn check_base<'s, F: FnOnce() -> BTreeSet<&'s str>>(
    spec: &'s Spec,
    supports: &LazyCell<BTreeSet<&'s str>, F>,
    (name, drive): (&str, &Drive),
    faults: &mut ValidationFaults,
) {
    let Some(base) = drive.base() else { return };
    let key = || format!("drive.{name}.at");
    let at = clip(base);
    if base.contains('.') || base == NO_SUPPORT || spec.mass.contains_key(base) {
        let noun = if spec.mass.contains_key(base) {
            "a mass, which only a force moves"
        } else {
            "not the name of a base"
        };
        faults.push(key, || {
            format!("is \"{at}\", {noun}; give \"ground\" or the name of a base that supports roots, masses or stops")
        });
    } else if base != GROUND && !supports.contains(base) {
        let text = || {
            format!(
                "is \"{at}\", a base that supports nothing; name it as the `root` of a beam, the `on` of a plate or a mass or the `frame` of a stop, or omit \
                 `at` to move the ground"
            )
        };
        faults.push(key, text);
    }
    if let (DriveKind::BaseDisplacement, DriveSignal::Chirp { phase_rad, .. }) =
        (drive.kind, &drive.signal)
        && phase_rad.sin().abs() > ZERO_START_ANGLE
    {
        let text = || {
            "does not let the displacement start at 0, so the base would jump at the start of the chirp; omit `phase`".to_owned()
        };
        faults.push(|| format!("drive.{name}.phase"), text);
    }
}

fn check_signal(spec: &Spec, name: &str, drive: &Drive, faults: &mut ValidationFaults) {
    let hertz = |value: f64| Quantity::Frequency.write(value);
    let mut samples = 0.0;
    match drive.signal {
        DriveSignal::Noise {
            low_hz,
            high_hz,
            sample_rate_hz,
            ..
        } => {
            if low_hz >= high_hz {
                faults.push(
                    || format!("drive.{name}.low"),
                    || {
                        format!(
                            "is {}; it must be below high = {}",
                            hertz(low_hz),
                            hertz(high_hz)
                        )
                    },
                );
            }
            let least_hz = 4.0 * high_hz;
            if let Some(rate_hz) = sample_rate_hz.filter(|rate_hz| *rate_hz < least_hz) {
                let text = || {
                    format!(
                        "is {}; it must be at least four times high = {}",
                        hertz(rate_hz),
                        hertz(high_hz)
                    )
                };
                faults.push(|| format!("drive.{name}.sample_rate"), text);
            }
            samples = sample_rate_hz.unwrap_or(DriveSignal::SAMPLES_PER_CYCLE * high_hz)
                * spec.run.duration_s;
        }
        DriveSignal::Chirp {
            from_hz,
            to_hz,
            duration_s,
            ..
        } => {
            samples = duration_s * from_hz.max(to_hz) * DriveSignal::CHIRP_SAMPLES_PER_CYCLE;
        }
        _ => {}
    }
    if samples > MAX_DRIVE_SAMPLES {
        let text = || {
            format!(
                "has {samples:.1e} samples, more than the limit {MAX_DRIVE_SAMPLES:.0e}; shorten the run or lower the frequency"
            )
        };
        faults.push(|| format!("drive.{name}.signal"), text);
    }
}

fn check_participation(spec: &Spec, key: &str, noun: &str, faults: &mut ValidationFaults) {
    for (name, _) in spec.modal.iter().filter(|(_, modal)| {
        modal.participation_sqrt_kg.is_empty() && !modal.frequency_hz.is_empty()
    }) {
        let text = || {
            format!(
                "{noun} acts on the mass of each mode; give modal.{}.participation_sqrt_kg",
                clip(name)
            )
        };
        faults.push(|| key.to_owned(), text);
    }
}
