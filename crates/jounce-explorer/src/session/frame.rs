//! Binary message of a response: a head in JSON and arrays of Float64.

use jounce::live::LinearCurve;
use serde_json::{Map, Value, json};

/// Response under construction.
#[derive(Debug, Clone, Default)]
pub struct Frame {
    head: Map<String, Value>,
    array_entries: Vec<Value>,
    numbers: Vec<f64>,
}

impl Frame {
    /// Creates a response to request number `id` of a kind.
    pub fn new(id: u64, kind: &str, stage: &str) -> Self {
        let mut frame = Self::default();
        frame.put("id", id).put("ask", kind).put("stage", stage);
        frame
    }

    /// Puts a value into the head.
    pub fn put(&mut self, name: &str, value: impl Into<Value>) -> &mut Self {
        self.head.insert(name.to_owned(), value.into());
        self
    }

    /// Puts all values of an object into the head.
    pub fn put_all(&mut self, object: &Value) -> &mut Self {
        for (name, value) in object.as_object().into_iter().flatten() {
            self.put(name, value.clone());
        }
        self
    }

    /// Adds an array.
    pub fn array(&mut self, name: &str, values: impl IntoIterator<Item = f64>) -> &mut Self {
        let first = self.numbers.len();
        self.numbers.extend(values);
        self.array_entries
            .push(json!([name, first, self.numbers.len() - first]));
        self
    }

    /// Adds a list as an array.
    pub fn list(&mut self, name: &str, values: &[f64]) -> &mut Self {
        self.array(name, values.iter().copied())
    }

    /// Adds a curve of the power without contact.
    pub fn curve(&mut self, name: &str, curve: &LinearCurve) -> &mut Self {
        self.list(&format!("{name}.x"), &curve.parameter)
            .list(&format!("{name}.power"), &curve.mean_power_w)
    }

    /// Returns the bytes of the message.
    pub fn encode(mut self) -> Vec<u8> {
        self.head
            .insert("arrays".to_owned(), Value::Array(self.array_entries));
        let mut head = Value::Object(self.head).to_string().into_bytes();
        let padded_length = (head.len() + 4).next_multiple_of(8) - 4;
        head.resize(padded_length, b' ');
        let mut bytes = Vec::with_capacity(4 + head.len() + 8 * self.numbers.len());
        // The head is far below 4 GiB: a spec has at most 16 MiB.
        bytes.extend_from_slice(&(head.len() as u32).to_le_bytes());
        bytes.extend_from_slice(&head);
        self.numbers
            .iter()
            .for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
        bytes
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn arrays_begin_at_multiples_of_eight_bytes() {
        for name in ["a", "ab", "abc", "abcdefghi"] {
            let mut frame = Frame::new(3, name, "done");
            frame.array("x", [1.5, f64::NAN]).array("y", [-2.0]);
            let bytes = frame.encode();
            let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
            assert_eq!((4 + length) % 8, 0);
            let head: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
            assert_eq!(head["arrays"], json!([["x", 0, 2], ["y", 2, 1]]));
            let last = f64::from_le_bytes(bytes[bytes.len() - 8..].try_into().unwrap());
            assert_eq!((bytes.len(), last), (4 + length + 24, -2.0));
        }
    }
}
