//! `[drive.NAME]`

use crate::spec::key::{Key, Kind, Range};
use crate::spec::{Drive, DriveKind, Quantity};

use super::FREQUENCY_LIMITS_HZ;

pub(super) fn blank() -> Drive {
    Drive { at: String::new(), kind: DriveKind::Force, amplitude_n: f64::NAN, frequency_hz: f64::NAN, phase_rad: 0.0 }
}

pub(super) static KEYS: &[Key<Drive>] = &[
    Key::text("at", Kind::Reference { what: "a point or mass" }, "where it acts", |d: &Drive| d.at.clone(), |d, x| x.clone_into(&mut d.at)),
    Key::text("kind", Kind::Choice(&["force"]), "what it prescribes", |_: &Drive| "force".to_owned(), |d, _| d.kind = DriveKind::Force)
        .optional(),
    Key::quantity("amplitude", Quantity::Force, "amplitude, zero to peak", |d: &Drive| d.amplitude_n, |d, x| d.amplitude_n = x)
        .within(Range::NOT_NEGATIVE),
    Key::quantity("frequency", Quantity::Frequency, "frequency", |d: &Drive| d.frequency_hz, |d, x| d.frequency_hz = x)
        .within(Range::from(FREQUENCY_LIMITS_HZ.0, FREQUENCY_LIMITS_HZ.1)),
    Key::quantity("phase", Quantity::Angle, "phase at time zero", |d: &Drive| d.phase_rad, |d, x| d.phase_rad = x).optional(),
];
