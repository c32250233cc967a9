//! Readable and refused texts of quantities.

use super::*;

#[test]
fn values_are_the_nearest_floats() {
    let contact = Quantity::ContactStiffness { exponent: 1.5 };
    for (quantity, text, value) in [
        (Quantity::Length, "0.98 mm", 0.98e-3),
        (Quantity::Length, "315 mm", 0.315),
        (Quantity::Length, "85 \u{b5}m", 85e-6),
        (Quantity::Pressure, "30.336 GPa", 30.336e9),
        (Quantity::Pressure, "65 kN/mm^2", 65e9),
        (Quantity::Density, "5440 kg/m^3", 5440.0),
        (Quantity::Density, "2.75 g/cm\u{b3}", 2750.0),
        (Quantity::ChargePerForce, "-170 pC/N", -170e-12),
        (Quantity::ChargePerForce, "-170 pm/V", -170e-12),
        (Quantity::Capacitance, "177 nF", 177e-9),
        (Quantity::Resistance, "1 Mohm", 1e6),
        (Quantity::Resistance, "1 k\u{3a9}", 1e3),
        (Quantity::Resistance, "0.1 \u{2126}", 0.1),
        (Quantity::Stiffness, "2 kN/mm", 2e6),
        (Quantity::Damping, "10 N s/m", 10.0),
        (Quantity::Damping, "10 N*s/m", 10.0),
        (Quantity::Damping, "10 N\u{b7}s\u{b7}m\u{207b}\u{b9}", 10.0),
        (contact, "1000 N/m^1.5", 1000.0),
        (contact, "1000 N/m^(3/2)", 1000.0),
        (contact, "1 kN m^-1.5", 1000.0),
        (Quantity::Frequency, "13Hz", 13.0),
        (Quantity::Frequency, "600 1/min", 10.0),
        (Quantity::Frequency, "600 rpm", 10.0),
        (Quantity::Frequency, "4 /s", 4.0),
        (Quantity::Time, "20 min", 1200.0),
        (Quantity::Angle, "180 deg", std::f64::consts::PI),
        (Quantity::Mass, "12 g", 0.012),
        (Quantity::Volume, "20 cm^3", 2e-5),
        (Quantity::InverseSpeed, "0.3 s/m", 0.3),
        (Quantity::Speed, "250 mm/s", 0.25),
        (Quantity::Acceleration, "9.81 m/s^2", 9.81),
        (Quantity::Acceleration, "2 g", 19.6133),
        (Quantity::AccelerationPsd, "3 (m/s^2)^2/Hz", 3.0),
        (Quantity::AccelerationPsd, "1 g^2/Hz", 9.80665 * 9.80665),
        (Quantity::ForcePsd, "0.5 N^2/Hz", 0.5),
        (Quantity::Strain, "400 ppm", 400e-6),
        (Quantity::Strain, "400 ustrain", 400e-6),
        (Quantity::Strain, "400 \u{b5}strain", 400e-6),
        (Quantity::Strain, "0.04 %", 400e-6),
        (Quantity::Strain, "400 um/m", 400e-6),
        (Quantity::Strain, "4e-4 strain", 400e-6),
    ] {
        assert_eq!(
            quantity.read(text).unwrap().to_bits(),
            f64::to_bits(value),
            "{text}"
        );
    }
    // 10^4.5 is not a power of ten with an integer exponent: one rounding more.
    let value = contact.read("1 N/mm^1.5").unwrap();
    assert!(
        (value / 31_622.776_601_683_793 - 1.0).abs() < 4e-16,
        "{value}"
    );
}

/// Texts that are refused: quantity, text, part of the message.
const REFUSED: [(Quantity, &str, &str); 17] = [
    (
        Quantity::Frequency,
        "13 mm",
        "\"13 mm\" is a length; expected a frequency in Hz, kHz, 1/min",
    ),
    (
        Quantity::Frequency,
        "13 rad/s",
        "\"13 rad/s\" is an angular frequency; expected a frequency in Hz, kHz, 1/min",
    ),
    (
        Quantity::Frequency,
        "13",
        "13 has no unit; expected a frequency in Hz, kHz, 1/min",
    ),
    (
        Quantity::Force,
        "fifty N",
        "\"fifty N\" does not start with a number; expected a force in N, mN, kN",
    ),
    (
        Quantity::Force,
        "nan N",
        "\"nan N\" does not start with a number; expected a force in N, mN, kN",
    ),
    (
        Quantity::Force,
        "5 newtons",
        "\"5 newtons\": \"newtons\" is not a known unit; expected a force in N, mN, kN",
    ),
    (
        Quantity::Acceleration,
        "1 grms",
        "\"grms\" is not a known unit (did you mean g?; the key specifies whether the value is rms or zero to peak, a unit does not); expected an acceleration in m/s^2, g",
    ),
    (
        Quantity::Damping,
        "5 N/m s",
        "a product after a quotient is ambiguous; use parentheses, as in N/(m s)",
    ),
    (
        Quantity::Length,
        "1,5 mm",
        "write decimals with a point, not a comma",
    ),
    (
        Quantity::Length,
        "1e400 mm",
        "\"1e400 mm\" is too large or too small for a number in m",
    ),
    (
        Quantity::Length,
        "1e-400 mm",
        "\"1e-400 mm\" is too large or too small for a number in m",
    ),
    (
        Quantity::Pressure,
        "1 N/m2",
        "write a power with ^, as in m^2",
    ),
    (
        Quantity::Pressure,
        "1 N/m^99",
        "powers must be from -12 to 12",
    ),
    (
        Quantity::Pressure,
        "1 N/(m^2",
        "a parenthesis is not closed",
    ),
    (Quantity::Pressure, "1 N//m^2", "unexpected `/`"),
    (Quantity::Pressure, "1 N/", "the unit is incomplete"),
    (
        Quantity::ContactStiffness { exponent: 2.0 },
        "1 N/m^1.5",
        "is a contact stiffness in N/m^1.5; expected a contact stiffness in N/m^2, kN/m^2",
    ),
];

/// A text of any length is examined without a call for each of its parentheses.
#[test]
fn a_long_text_is_no_unit() {
    assert!(crate::is_unit(&format!(
        "{}m{}",
        "(".repeat(99),
        ")".repeat(99)
    )));
    assert!(!crate::is_unit(&"(".repeat(1 << 20)));
}

#[test]
fn wrong_texts_are_refused_with_the_units_that_fit() {
    for (quantity, text, message) in REFUSED {
        let refusal = quantity.read(text).unwrap_err().to_string();
        assert!(refusal.contains(message), "{text}: {refusal}");
    }
}
