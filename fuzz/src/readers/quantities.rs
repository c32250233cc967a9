//! Quantities with units, and ranges of them.

use super::{choice, text_of};
use jounce_spec::quantity_range;
use jounce_units::{Quantity, is_unit};

/// Kinds that an input selects by its first byte.
pub const KINDS: [Quantity; 29] = [
    Quantity::Length,
    Quantity::Volume,
    Quantity::Mass,
    Quantity::Time,
    Quantity::Frequency,
    Quantity::Force,
    Quantity::Pressure,
    Quantity::Density,
    Quantity::ChargePerForce,
    Quantity::Capacitance,
    Quantity::Resistance,
    Quantity::Stiffness,
    Quantity::ContactStiffness { exponent: 1.5 },
    Quantity::ContactStiffness { exponent: 2.37 },
    Quantity::Damping,
    Quantity::InverseSpeed,
    Quantity::Speed,
    Quantity::Acceleration,
    Quantity::AccelerationPsd,
    Quantity::ForcePsd,
    Quantity::Angle,
    Quantity::RotaryInertia,
    Quantity::RotaryStiffness,
    Quantity::Inductance,
    Quantity::Permittivity,
    Quantity::Voltage,
    Quantity::Current,
    Quantity::Power,
    Quantity::Strain,
];

/// A value that was read is finite, and its printed form reads back to the same bits.
pub fn quantity(data: &[u8]) {
    let Some((kind, rest)) = choice(data, KINDS.len()) else {
        return;
    };
    let (kind, text) = (KINDS[kind], text_of(rest));
    let _ = is_unit(&text);
    let value = match kind.read(&text) {
        Ok(value) => value,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    assert!(value.is_finite(), "{value}");
    let printed = kind.write(value);
    let again = kind.read(&printed).map(f64::to_bits);
    assert_eq!(again, Ok(value.to_bits()), "{printed}");
    if let Some((digits, exponent)) = kind.exact(&text) {
        let decimal: f64 = format!("{digits}e{exponent}").parse().expect("a number");
        assert_eq!(decimal, value, "{digits}e{exponent}");
    }
}

/// The values of a range are finite, ascend, and are as many as the text specifies.
pub fn range(data: &[u8]) {
    let Some((kind, rest)) = choice(data, KINDS.len()) else {
        return;
    };
    let (kind, text) = (KINDS[kind], text_of(rest));
    if let Ok(values) = quantity_range(kind, &text) {
        check(&text, &values, |part| kind.read(part).ok());
    }
}

/// Checks the values of a range against its text.
pub fn check(text: &str, values: &[f64], read: impl Fn(&str) -> Option<f64>) {
    assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let [from, to, spacing] = parts[..] else {
        assert_eq!(values.len(), text.split(',').count());
        return;
    };
    let (from, to) = (read(from).expect("an end"), read(to).expect("an end"));
    assert!(values.len() <= 1_000_000);
    assert!(
        values.windows(2).all(|pair| pair[0] <= pair[1]),
        "{values:?}"
    );
    assert_eq!(values.first(), Some(&from));
    assert!(values.last().is_some_and(|last| *last <= to), "{values:?}");
    let count = ["log", "x"]
        .iter()
        .find_map(|end| spacing.strip_suffix(end));
    let Some(count) = count else {
        let step = read(spacing).expect("a step");
        // Ends that differ by few units in the last place hold more decimals than doubles.
        if step < 1e-9 * from.abs().max(to.abs()) {
            return;
        }
        let expected = (to - from) / step + 1.0;
        let difference = expected - values.len() as f64;
        assert!(
            (-1e-6..1.0 + 1e-6).contains(&difference),
            "{expected} {}",
            values.len()
        );
        return;
    };
    assert_eq!(count.trim().parse(), Ok(values.len()));
    assert_eq!(values.last(), Some(&to));
}
