//! Reason why a request has no result, as the page shows it.

use jounce::Error;
use jounce::live::FieldFault;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// Reason why a request has no result.
#[derive(Debug, Clone)]
pub enum RequestFault {
    /// Error of the library.
    Library(Arc<Error>),
    /// Faults of the fields of a design.
    Fields(Vec<FieldFault>),
    /// One sentence.
    Text(String),
}

impl RequestFault {
    /// Returns the faults for the page: key, line, message. Faults of the spec have the messages of
    /// the command line; `path` is the path of the spec. A table that lacks a key that the request
    /// removed has its fault at this key.
    pub fn list(&self, path: &Path, removed: &[String]) -> Value {
        let faults = match self {
            Self::Library(error) => match error.as_ref() {
                Error::Spec(faults) | Error::Range { faults, .. } => faults.as_slice(),
                error => return text(&error.to_string()),
            },
            Self::Fields(faults) => return json!(faults),
            Self::Text(message) => return text(message),
        };
        let entries = faults.iter().map(|fault| {
            let set = fault
                .set
                .as_ref()
                .and_then(|set| set.strip_prefix("--set ")?.split_once('='));
            let is_missing = |key: &&String| {
                key.rsplit_once('.').is_some_and(|(table, name)| {
                    table == fault.key && fault.message.contains(&format!("`{name}`"))
                })
            };
            let of_removal = removed.iter().find(is_missing);
            let own = of_removal.map_or(fault.key.as_str(), String::as_str);
            let key = set.map_or(own, |(key, _)| key);
            let message = match fault.set {
                Some(_) => fault.to_string(),
                None if fault.line == 0 => fault.message.clone(),
                None => format!("{}:{fault}", path.display()),
            };
            json!({ "key": key, "line": fault.line, "message": message })
        });
        entries.collect()
    }
}

fn text(message: &str) -> Value {
    json!([{ "key": "", "line": 0, "message": message }])
}

impl From<Error> for RequestFault {
    fn from(error: Error) -> Self {
        Self::Library(Arc::new(error))
    }
}

impl From<std::io::Error> for RequestFault {
    fn from(error: std::io::Error) -> Self {
        Self::Text(error.to_string())
    }
}

impl From<base64::DecodeError> for RequestFault {
    fn from(error: base64::DecodeError) -> Self {
        Self::Text(error.to_string())
    }
}
