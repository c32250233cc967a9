//! Converts units in instrument notation to SI.
//!
//! The specs define the unit grammar ([`jounce_units::Quantity`]); this file adds the spellings and
//! the customary units found in recordings.

use std::borrow::Cow;

use jounce_units::{Quantity as Spec, STANDARD_GRAVITY_M_S2};

use super::Quantity;
use super::unit_spelling::{normalised_spelling, unbracketed};

/// Parsed unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Measured quantity.
    pub quantity: Quantity,
    /// SI unit of the converted values.
    pub si: Cow<'static, str>,
    /// Factor that converts values to SI.
    pub factor: f64,
}

/// Quantities in the order of trial: `g` alone is an acceleration, never a gram.
const SI_UNITS: [(Quantity, Spec, &str); 11] = [
    (Quantity::Acceleration, Spec::Acceleration, "m/s^2"),
    (
        Quantity::AccelerationPsd,
        Spec::AccelerationPsd,
        "(m/s^2)^2/Hz",
    ),
    (Quantity::Velocity, Spec::Speed, "m/s"),
    (Quantity::Displacement, Spec::Length, "m"),
    (Quantity::Force, Spec::Force, "N"),
    (Quantity::ForcePsd, Spec::ForcePsd, "N^2/Hz"),
    (Quantity::Voltage, Spec::Voltage, "V"),
    (Quantity::Pressure, Spec::Pressure, "Pa"),
    // Seconds and hertz differ in dimension.
    (Quantity::Time, Spec::Time, "s"),
    (Quantity::Frequency, Spec::Frequency, "Hz"),
    (Quantity::Response, Spec::Stiffness, "N/m"),
];

/// Units outside SI: spelling in lower case, quantity, SI unit, factor (NIST SP 811, appendix B.8).
const CUSTOMARY_UNITS: [(&[&str], Quantity, &str, f64); 12] = [
    (
        &["lbf", "lb", "lbs", "pound", "pounds", "pound-force"],
        Quantity::Force,
        "N",
        4.448_221_615_260_5,
    ),
    (&["kgf", "kp"], Quantity::Force, "N", STANDARD_GRAVITY_M_S2),
    (
        &["in", "inch", "inches"],
        Quantity::Displacement,
        "m",
        0.0254,
    ),
    (&["ft", "foot", "feet"], Quantity::Displacement, "m", 0.3048),
    (&["mil", "mils"], Quantity::Displacement, "m", 2.54e-5),
    (
        &["in/s", "in/sec", "ips"],
        Quantity::Velocity,
        "m/s",
        0.0254,
    ),
    (&["ft/s", "ft/sec"], Quantity::Velocity, "m/s", 0.3048),
    (
        &["in/s^2", "in/sec^2"],
        Quantity::Acceleration,
        "m/s^2",
        0.0254,
    ),
    (
        &["ft/s^2", "ft/sec^2"],
        Quantity::Acceleration,
        "m/s^2",
        0.3048,
    ),
    // Never a milligram, because g is not a gram.
    (
        &["mg"],
        Quantity::Acceleration,
        "m/s^2",
        1e-3 * STANDARD_GRAVITY_M_S2,
    ),
    (&["psi"], Quantity::Pressure, "Pa", 6_894.757_293_168),
    (&["gal", "gals"], Quantity::Acceleration, "m/s^2", 0.01),
];

/// Quantities allowed in the numerator and denominator of a response.
const QUOTIENT_QUANTITIES: [Quantity; 6] = [
    Quantity::Acceleration,
    Quantity::Velocity,
    Quantity::Displacement,
    Quantity::Force,
    Quantity::Voltage,
    Quantity::Pressure,
];

impl Unit {
    /// Parses a unit in instrument notation (`G`, `m/s2`, `m/s²`, `Pounds`, `[g]`, `cm/s/s`, `g/N`);
    /// `None` if unknown.
    pub fn read(text: &str) -> Option<Self> {
        Self::read_plain(text).or_else(|| {
            let (numerator, denominator) = Self::quotient(text)?;
            // A denominator that is a quotient itself gets brackets.
            let si = if denominator.si.contains('/') {
                format!("{}/({})", numerator.si, denominator.si)
            } else {
                format!("{}/{}", numerator.si, denominator.si)
            };
            Some(Self {
                quantity: Quantity::Response,
                si: si.into(),
                factor: numerator.factor / denominator.factor,
            })
        })
    }

    /// Numerator of the unit of a response: an acceleration in `m/s^2/N`.
    pub fn responds(text: &str) -> Option<Quantity> {
        Self::quotient(text).map(|(numerator, _)| numerator.quantity)
    }

    /// Denominator of the unit of a response: a force in `m/s^2/N`.
    pub fn per(text: &str) -> Option<Quantity> {
        Self::quotient(text).map(|(_, denominator)| denominator.quantity)
    }

    /// Parses the unit of one quantity.
    fn read_plain(text: &str) -> Option<Self> {
        let normalised = normalised_spelling(text);
        let lowercase = normalised.to_lowercase();
        if let Some((_, quantity, si, factor)) = CUSTOMARY_UNITS
            .iter()
            .find(|(names, ..)| names.contains(&lowercase.as_str()))
        {
            return Some(Self {
                quantity: *quantity,
                si: (*si).into(),
                factor: *factor,
            });
        }
        let known = |(quantity, spec, si): &(Quantity, Spec, &'static str)| {
            let factor = spec.read(&format!("1 {normalised}")).ok()?;
            Some(Self {
                quantity: *quantity,
                si: (*si).into(),
                factor,
            })
        };
        SI_UNITS.iter().find_map(known)
    }

    /// Splits a quotient into numerator and denominator: `A/B` at the last valid slash, or
    /// `(1/B)*(A)`, as some analysers write it.
    fn quotient(text: &str) -> Option<(Self, Self)> {
        let trimmed = unbracketed(text);
        let part_of = |text: &str| {
            Self::read_plain(text).filter(|unit| QUOTIENT_QUANTITIES.contains(&unit.quantity))
        };
        let inverse = |text: &str| part_of(unbracketed(text).strip_prefix("1/")?);
        let product = |(at, sign): (usize, &str)| {
            let (left_factor, right_factor) = (&trimmed[..at], &trimmed[at + sign.len()..]);
            part_of(left_factor)
                .zip(inverse(right_factor))
                .or_else(|| part_of(right_factor).zip(inverse(left_factor)))
        };
        let quotient_of = || {
            trimmed
                .rmatch_indices('/')
                .find_map(|(at, _)| Some((part_of(&trimmed[..at])?, part_of(&trimmed[at + 1..])?)))
        };
        quotient_of().or_else(|| trimmed.match_indices(['*', '\u{b7}']).find_map(product))
    }

    /// True where the conversion changes values, or the unit is not SI.
    pub fn converts(&self) -> bool {
        self.factor != 1.0
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Factors from NIST SP 811, appendix B.8.
    #[test]
    fn units_of_instruments_are_understood() {
        let cases = [
            ("g", Quantity::Acceleration, 9.80665),
            ("G's", Quantity::Acceleration, 9.80665),
            ("(G)", Quantity::Acceleration, 9.80665),
            ("m/s2", Quantity::Acceleration, 1.0),
            ("[m/s\u{b2}]", Quantity::Acceleration, 1.0),
            ("m/s/s", Quantity::Acceleration, 1.0),
            ("cm/s/s", Quantity::Acceleration, 0.01),
            ("in/s^2", Quantity::Acceleration, 0.0254),
            ("ft/s\u{b2}", Quantity::Acceleration, 0.3048),
            ("m\u{b7}s\u{207b}\u{b2}", Quantity::Acceleration, 1.0),
            ("m s-2", Quantity::Acceleration, 1.0),
            ("m\u{b7}s\u{207b}\u{b9}", Quantity::Velocity, 1.0),
            ("mg", Quantity::Acceleration, 9.80665e-3),
            ("mil", Quantity::Displacement, 2.54e-5),
            ("ft", Quantity::Displacement, 0.3048),
            ("gal", Quantity::Acceleration, 0.01),
            ("g^2/Hz", Quantity::AccelerationPsd, 9.80665 * 9.80665),
            ("Pounds", Quantity::Force, 4.448_221_615_260_5),
            ("lbf", Quantity::Force, 4.448_221_615_260_5),
            ("kN", Quantity::Force, 1000.0),
            ("Volts", Quantity::Voltage, 1.0),
            ("mV", Quantity::Voltage, 1e-3),
            ("ms", Quantity::Time, 1e-3),
            ("Sec", Quantity::Time, 1.0),
            ("Second", Quantity::Time, 1.0),
            ("milliseconds", Quantity::Time, 1e-3),
            ("kHz", Quantity::Frequency, 1000.0),
            ("um", Quantity::Displacement, 1e-6),
            ("inch", Quantity::Displacement, 0.0254),
            ("psi", Quantity::Pressure, 6_894.757_293_168),
            ("(m/s^2)^2/Hz", Quantity::AccelerationPsd, 1.0),
            ("[(m/s^2)^2/Hz]", Quantity::AccelerationPsd, 1.0),
        ];
        for (text, quantity, factor) in cases {
            let unit = Unit::read(text).unwrap_or_else(|| panic!("{text} is not understood"));
            assert_eq!(unit.quantity, quantity, "{text}");
            assert!(
                (unit.factor / factor - 1.0).abs() < 1e-15,
                "{text}: {}",
                unit.factor
            );
        }
    }

    /// Unit, its SI unit, quantity of the numerator, and factor: the quotient of two factors of NIST
    /// SP 811, appendix B.8.
    const RESPONSES: [(&str, &str, Quantity, f64); 20] = [
        ("m/s^2/N", "m/s^2/N", Quantity::Acceleration, 1.0),
        ("(m/s^2)/N", "m/s^2/N", Quantity::Acceleration, 1.0),
        ("[m/s2/N]", "m/s^2/N", Quantity::Acceleration, 1.0),
        ("((m/s\u{b2})/(N))", "m/s^2/N", Quantity::Acceleration, 1.0),
        ("(1/N)*(m/s\u{b2})", "m/s^2/N", Quantity::Acceleration, 1.0),
        (
            "g*(1/lbf)",
            "m/s^2/N",
            Quantity::Acceleration,
            9.80665 / 4.448_221_615_260_5,
        ),
        ("m/s/s/N", "m/s^2/N", Quantity::Acceleration, 1.0),
        ("g/N", "m/s^2/N", Quantity::Acceleration, 9.80665),
        ("G/N", "m/s^2/N", Quantity::Acceleration, 9.80665),
        (
            "g/lbf",
            "m/s^2/N",
            Quantity::Acceleration,
            9.80665 / 4.448_221_615_260_5,
        ),
        ("m/s/N", "m/s/N", Quantity::Velocity, 1.0),
        (
            "in/s/lbf",
            "m/s/N",
            Quantity::Velocity,
            0.0254 / 4.448_221_615_260_5,
        ),
        ("m/N", "m/N", Quantity::Displacement, 1.0),
        ("um/mN", "m/N", Quantity::Displacement, 1e-3),
        ("V/N", "V/N", Quantity::Voltage, 1.0),
        ("Volts/Newton", "V/N", Quantity::Voltage, 1.0),
        ("mV/g", "V/(m/s^2)", Quantity::Voltage, 1e-3 / 9.80665),
        ("V/(m/s^2)", "V/(m/s^2)", Quantity::Voltage, 1.0),
        ("g/g", "m/s^2/(m/s^2)", Quantity::Acceleration, 1.0),
        ("Pa/V", "Pa/V", Quantity::Pressure, 1.0),
    ];

    #[test]
    fn units_of_responses_are_understood_and_their_si_unit_reads_back() {
        for (text, si, numerator, factor) in RESPONSES {
            let unit = Unit::read(text).unwrap_or_else(|| panic!("{text} is not understood"));
            assert_eq!(
                (unit.quantity, unit.si.as_ref(), Unit::responds(text)),
                (Quantity::Response, si, Some(numerator)),
                "{text}"
            );
            assert!(
                (unit.factor / factor - 1.0).abs() < 1e-15,
                "{text}: {}",
                unit.factor
            );
            assert_eq!(
                Unit::read(si),
                Some(Unit {
                    factor: 1.0,
                    ..unit.clone()
                }),
                "{text}"
            );
            assert_eq!(Unit::responds(si), Some(numerator), "{text}");
        }
        assert_eq!(Unit::responds("m/s^2"), None);
    }

    #[test]
    fn what_is_no_unit_is_none() {
        for text in [
            "", "counts", "LSB", "NONE", "-1", "1e5", "\u{fffd}", "/N", "m//N", "counts/N", "V/s",
            "m/s^2/", ")(", "(N",
        ] {
            assert_eq!(Unit::read(text), None, "{text}");
        }
    }
}
