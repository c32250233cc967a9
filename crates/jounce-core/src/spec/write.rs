//! A spec as canonical TOML: every applicable key, in the order of the table of keys, in short
//! units.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::key::{Key, Kind, Slot, applies};
use super::keys::SPEC;
use super::{DriveSignal, Spec};

impl Spec {
    /// Prints the spec as TOML. [`Spec::from_toml`] reads an identical spec back, bit for bit.
    ///
    /// Defaults are printed too; the spring of a mass is printed as its stiffness.
    ///
    /// # Validation
    /// `tests/spec_round_trip.rs`: random specs with all laws, sides and structures come back
    /// equal.
    pub fn to_toml(&self) -> String {
        let mut out = String::new();
        for key in SPEC {
            if let Slot::Inner(inner) = &key.slot {
                inner.write(self, key.info.name, &mut out);
            }
        }
        out.trim_start().to_owned()
    }

    /// Returns the SHA-256 of [`Spec::to_toml`] as 64 hexadecimal digits. Comments, order, units
    /// and written defaults do not change it.
    pub fn hash_hex(&self) -> String {
        let mut hasher = Sha256::new_with_prefix(self.to_toml().as_bytes());
        // Recordings enter by their samples, because a file may change under its name.
        for drive in self.drive.values() {
            if let DriveSignal::Recording {
                record: Some(record),
                ..
            } = &drive.signal
            {
                [record.step_s]
                    .iter()
                    .chain(record.values.iter())
                    .for_each(|value| hasher.update(value.to_le_bytes()));
            }
        }
        hasher
            .finalize()
            .iter()
            .fold(String::new(), |mut hex, byte| {
                write!(hex, "{byte:02x}").expect("writing to a string cannot fail");
                hex
            })
    }
}

/// Prints one element under its header; `always` prints the header of an empty element too.
pub(super) fn write_keys<T>(
    keys: &[Key<T>],
    thing: &T,
    path: &str,
    always: bool,
    out: &mut String,
) {
    let mut own = String::new();
    let mut below = String::new();
    for key in keys.iter().filter(|key| applies(keys, thing, &key.info)) {
        if let Some(value) = value(key, thing) {
            line(&mut own, key.info.name, &value);
        }
        write_below(key, thing, path, &mut below);
    }
    if always || !own.is_empty() {
        out.push_str(&format!("\n[{path}]\n{own}"));
    }
    out.push_str(&below);
}

fn line(out: &mut String, name: &str, value: &str) {
    out.push_str(&format!("{name} = {value}\n"));
}

fn value<T>(key: &Key<T>, thing: &T) -> Option<String> {
    let number = |value: f64| match key.kind_in(thing) {
        Kind::Quantity(quantity) => quoted(&quantity.write(value)),
        _ => float(value),
    };
    match &key.slot {
        Slot::Number { get, .. } => Some(number(get(thing))),
        Slot::Optional { get, .. } => get(thing).map(number),
        Slot::Count { get, .. } => Some(get(thing).to_string()),
        Slot::Text { get, .. } => Some(get(thing))
            .filter(|text| !text.is_empty())
            .map(|text| quoted(&text)),
        Slot::Texts { get, .. } => (!get(thing).is_empty()).then(|| texts(get(thing))),
        Slot::Numbers { get, .. } => (!get(thing).is_empty()).then(|| list(get(thing))),
        Slot::Derived { .. }
        | Slot::NamedQuantities { .. }
        | Slot::NamedNumbers { .. }
        | Slot::Inner(_) => None,
    }
}

fn write_below<T>(key: &Key<T>, thing: &T, path: &str, out: &mut String) {
    let path = format!("{path}.{}", key.info.name);
    let mut lines = String::new();
    match (&key.slot, key.info.kind) {
        (Slot::NamedQuantities { get, .. }, Kind::NamedQuantities(quantity)) => {
            for (name, value) in get(thing) {
                line(
                    &mut lines,
                    &toml_edit::Key::new(name).to_string(),
                    &quoted(&quantity.write(*value)),
                );
            }
        }
        (Slot::NamedNumbers { get, .. }, _) => {
            for (name, values) in get(thing) {
                line(
                    &mut lines,
                    &toml_edit::Key::new(name).to_string(),
                    &list(values),
                );
            }
        }
        (Slot::Inner(inner), _) => inner.write(thing, &path, out),
        _ => {}
    }
    if !lines.is_empty() {
        out.push_str(&format!("\n[{path}]\n{lines}"));
    }
}

fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}

/// Returns the shortest digits that read back as the same bits.
fn float(value: f64) -> String {
    format!("{value:?}")
}

fn texts(values: &[String]) -> String {
    format!(
        "[{}]",
        values
            .iter()
            .map(|value| quoted(value))
            .collect::<Vec<_>>()
            .join(", ")
    )
}

fn list(values: &[f64]) -> String {
    format!(
        "[{}]",
        values
            .iter()
            .map(|value| float(*value))
            .collect::<Vec<_>>()
            .join(", ")
    )
}
