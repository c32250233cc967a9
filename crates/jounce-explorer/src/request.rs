//! What the page asks.

use serde::Deserialize;

/// Most overrides of a request.
pub const MAX_OVERRIDES: usize = 500;

/// One request.
#[derive(Debug, Clone, Deserialize)]
pub struct Request {
    /// Number that its answers carry.
    pub id: u64,
    /// Overrides, as in `--set`.
    #[serde(default)]
    pub set: Vec<(String, String)>,
    /// What is asked.
    #[serde(flatten)]
    pub ask: RequestKind,
}

/// A range of a key, SI.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct KeySpan {
    /// The key.
    pub over: String,
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// What takes the place of the first drive.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExcitationRequest {
    /// Noise of a flat one-sided density.
    Noise {
        /// In the square of the unit of the drive per Hz.
        density: f64,
        /// Lower end of the band.
        low_hz: f64,
        /// Upper end.
        high_hz: f64,
    },
    /// A recording in any format that `jounce read` takes.
    Recording {
        /// The name of the file: its ending tells the format.
        name: String,
        /// What the file holds, in base64.
        bytes: String,
        /// Name or number of the channel.
        channel: Option<String>,
        /// What 1 in SI in the file stands for, in the SI unit of the drive.
        scale: f64,
    },
}

/// What is asked.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
pub enum RequestKind {
    /// Faults, controls and drawing.
    Design,
    /// Branches over a key.
    Response(KeySpan),
    /// The orbit of a point of a response.
    Orbit {
        /// Number of the response.
        answer: u64,
        /// Number of the branch in it.
        branch: usize,
        /// Number of the point on it.
        point: usize,
    },
    /// Marched points up and down over a key.
    Sweep {
        /// The range.
        #[serde(flatten)]
        range: KeySpan,
        /// Number of values.
        points: usize,
    },
    /// Mean power against the load.
    Load {
        /// The resistance, a key.
        over: String,
        /// Number of values.
        points: usize,
    },
    /// Where starts end.
    Basins {
        /// Values on each side of the plane of starts.
        side: usize,
    },
    /// The harvester under noise or a recording.
    Shake {
        /// What shakes it.
        by: ExcitationRequest,
    },
    /// The spec as text, with the overrides written into it, and the lines that give the same response.
    Export(KeySpan),
    /// Stops the work on one kind of request.
    Stop {
        /// The kind.
        what: String,
    },
}

impl RequestKind {
    /// Name of the lane.
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
            (request.id, request.ask.name(), request.set.len()),
            (7, "response", 1)
        );
        assert!(matches!(request.ask, RequestKind::Response(KeySpan { from, .. }) if from == 12.0));
        let request: Request = serde_json::from_str(
            r#"{"id": 8, "ask": "sweep", "over": "a.b", "from": 1, "to": 2, "points": 9}"#,
        )
        .unwrap();
        assert!(matches!(request.ask, RequestKind::Sweep { points: 9, .. }));
    }
}
