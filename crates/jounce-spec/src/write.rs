//! A spec as canonical TOML: every applicable key, in the order of the table of keys, in short
//! units.

use sha2::{Digest, Sha256};

use super::key::{Key, Kind, Slot, applies};
use super::keys::SPEC;
use super::{DriveSignal, Modal, Source, Spec};

impl Spec {
    /// Prints the spec as TOML. [`Spec::from_toml`] reads an identical spec back, bit for bit.
    ///
    /// Defaults are printed too; the spring of a mass is printed as its stiffness.
    ///
    /// # Validation
    /// `crates/jounce-spec/tests/spec/round_trip.rs`: random specs with all laws, sides and
    /// structures come back equal.
    pub fn to_toml(&self) -> String {
        let mut out = String::new();
        for key in SPEC {
            if let Slot::Inner(inner) = &key.slot {
                inner.write(self, key.info.name, &mut out);
            }
        }
        out.trim_start().to_owned()
    }

    /// Returns the SHA-256 of [`Spec::to_toml`] as 64 hexadecimal digits. Comments, order, units,
    /// written defaults and the `[source]` do not change it.
    pub fn hash_hex(&self) -> String {
        let without_source = Spec {
            source: Source::default(),
            ..self.clone()
        };
        let mut hasher = Sha256::new_with_prefix(without_source.to_toml().as_bytes());
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
        format!("{:x}", hasher.finalize())
    }
}

impl Modal {
    /// Prints the structure as `[modal.NAME]` with its tables, as [`Spec::to_toml`] does.
    pub fn to_toml(&self, name: &str) -> String {
        let spec = Spec {
            modal: [(name.to_owned(), self.clone())].into(),
            ..Spec::default()
        };
        let mut out = String::new();
        for key in SPEC.iter().filter(|key| key.info.name == "modal") {
            if let Slot::Inner(inner) = &key.slot {
                inner.write(&spec, key.info.name, &mut out);
            }
        }
        out.trim_start().to_owned()
    }
}

/// Prints one element under its header; `always` prints the header of an empty element too.
pub(super) fn write_keys<T>(
    keys: &[Key<T>],
    element: &T,
    path: &str,
    always: bool,
    out: &mut String,
) {
    let mut key_lines = String::new();
    let mut below = String::new();
    for key in keys.iter().filter(|key| applies(keys, element, &key.info)) {
        if let Some(value) = value(key, element) {
            line(&mut key_lines, key.info.name, &value);
        }
        write_below(key, element, path, &mut below);
    }
    if always || !key_lines.is_empty() {
        out.push_str(&format!("\n[{path}]\n{key_lines}"));
    }
    out.push_str(&below);
}

fn line(out: &mut String, name: &str, value: &str) {
    out.push_str(&format!("{name} = {value}\n"));
}

fn value<T>(key: &Key<T>, element: &T) -> Option<String> {
    let number = |value: f64| match key.kind_in(element) {
        Kind::Quantity(quantity) => quoted(&quantity.write(value)),
        _ => float(value),
    };
    match &key.slot {
        // A key that another one replaces has no number.
        Slot::Number { get, .. } => Some(get(element))
            .filter(|value| value.is_finite())
            .map(number),
        Slot::Optional { get, .. } => get(element).map(number),
        Slot::Count { get, .. } => Some(get(element).to_string()),
        Slot::Text { get, .. } => Some(get(element))
            .filter(|text| !text.is_empty())
            .map(|text| quoted(&text)),
        Slot::Texts { get, .. } => (!get(element).is_empty()).then(|| texts(get(element))),
        Slot::Numbers { get, .. } => (!get(element).is_empty()).then(|| list(get(element))),
        Slot::Derived { .. }
        | Slot::DerivedNumbers { .. }
        | Slot::NamedQuantities { .. }
        | Slot::NamedNumbers { .. }
        | Slot::Inner(_) => None,
    }
}

fn write_below<T>(key: &Key<T>, element: &T, path: &str, out: &mut String) {
    let path = format!("{path}.{}", key.info.name);
    let mut lines = String::new();
    match (&key.slot, key.info.kind) {
        (Slot::NamedQuantities { get, .. }, Kind::NamedQuantities(quantity)) => {
            for (name, value) in get(element) {
                line(
                    &mut lines,
                    &toml_edit::Key::new(name).to_string(),
                    &quoted(&quantity.write(*value)),
                );
            }
        }
        (Slot::NamedNumbers { get, .. }, _) => {
            for (name, values) in get(element) {
                line(
                    &mut lines,
                    &toml_edit::Key::new(name).to_string(),
                    &list(values),
                );
            }
        }
        (Slot::Inner(inner), _) => inner.write(element, &path, out),
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
