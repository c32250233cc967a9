//! Requests of the page.

use serde::Deserialize;

/// Largest number of overrides of a request.
pub const MAX_OVERRIDES: usize = 500;

/// One request.
#[derive(Debug, Clone, Deserialize)]
pub struct Request {
    /// Number of the request, which its responses repeat.
    pub id: u64,
    /// Overrides, as in `--set`.
    #[serde(default)]
    pub set: Vec<(String, String)>,
    /// Kind of the request.
    #[serde(flatten)]
    pub kind: RequestKind,
}

/// Range of a key, SI.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct KeySpan {
    /// The key.
    pub over: String,
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// Excitation that replaces the first drive.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExcitationRequest {
    /// Noise of a flat one-sided spectral density.
    Noise {
        /// Spectral density, in the square of the unit of the drive per Hz.
        density: f64,
        /// Lower end of the band, Hz.
        low_hz: f64,
        /// Upper end of the band, Hz.
        high_hz: f64,
    },
    /// A recording in any format that `jounce read` takes.
    Recording {
        /// Name of the file; its extension specifies the format.
        name: String,
        /// Content of the file, in base64.
        bytes: String,
        /// Name or number of the channel.
        channel: Option<String>,
        /// Value of 1 (SI) of the file in the SI unit of the drive.
        scale: f64,
    },
}

/// Kind of a request.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum RequestKind {
    /// Faults, controls and drawing.
    Design,
    /// Branches over a key.
    Response(KeySpan),
    /// Orbit of a point of a response.
    Orbit {
        /// Number of the response.
        #[serde(rename = "answer")]
        response: u64,
        /// Index of the branch in the response.
        branch: usize,
        /// Index of the point on the branch.
        point: usize,
    },
    /// Integrated points up and down over a key.
    Sweep {
        /// Range.
        #[serde(flatten)]
        range: KeySpan,
        /// Number of values.
        points: usize,
    },
    /// Mean power over the load.
    Load {
        /// Key of the resistance.
        over: String,
        /// Number of values.
        points: usize,
    },
    /// Basins of attraction.
    Basins {
        /// Values on each side of the plane of starts.
        side: usize,
    },
    /// Response under noise or a recording.
    Shake {
        /// Excitation.
        by: ExcitationRequest,
    },
    /// Spec as text with the overrides, and the commands that give the same response.
    Export(KeySpan),
    /// Cancels the work on one kind of request.
    Stop {
        /// Kind of the request.
        what: String,
    },
}

impl RequestKind {
    /// Returns the name of the kind.
    pub fn name(&self) -> &'static str {
        match self {
            RequestKind::Design => "design",
            RequestKind::Response(_) => "response",
            RequestKind::Orbit { .. } => "orbit",
            RequestKind::Sweep { .. } => "sweep",
            RequestKind::Load { .. } => "load",
            RequestKind::Basins { .. } => "basins",
            RequestKind::Shake { .. } => "shake",
            RequestKind::Export(_) => "export",
            RequestKind::Stop { .. } => "stop",
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn requests_are_read() {
        let text = r#"{"id": 7, "ask": "response", "set": [["stop.tip.gap", "0.9 mm"]], "over": "drive.shaker.frequency", "from": 12, "to": 14}"#;
        let request: Request = serde_json::from_str(text).unwrap();
        assert_eq!(
            (request.id, request.kind.name(), request.set.len()),
            (7, "response", 1)
        );
        assert!(
            matches!(request.kind, RequestKind::Response(KeySpan { from, .. }) if from == 12.0)
        );
        let request: Request = serde_json::from_str(
            r#"{"id": 8, "ask": "sweep", "over": "a.b", "from": 1, "to": 2, "points": 9}"#,
        )
        .unwrap();
        assert!(matches!(request.kind, RequestKind::Sweep { points: 9, .. }));
    }
}
