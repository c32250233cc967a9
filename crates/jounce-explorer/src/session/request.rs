//! Requests of the page.

use jounce::live::{
    AttractorPlace, BandOptions, DesignFields, KeySpan, LoadOptions, OrbitPlace, ResponseOptions,
    SoughtOrbit,
};
use jounce::{BasinsOptions, EnsembleOptions};
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

impl Request {
    /// Returns the keys without a value: they are removed from the spec.
    pub fn removed_keys(&self) -> Vec<String> {
        let removed = self.set.iter().filter(|(_, value)| value.trim().is_empty());
        removed.map(|(key, _)| key.clone()).collect()
    }
}

/// Drives of the spec, or an excitation that replaces the first one.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ExcitationRequest {
    /// Drives of the spec.
    Spec,
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
    Design {
        /// Width of the sheet of the drawing, px.
        #[serde(default)]
        width: Option<f64>,
        /// Height for each view of the drawing, px; without one, no view is made smaller.
        #[serde(default)]
        height: Option<f64>,
    },
    /// Figures of the mode shapes.
    Modes,
    /// Branches over a key.
    Response {
        /// Range.
        #[serde(flatten)]
        span: KeySpan,
        /// Options of the fine response.
        #[serde(flatten)]
        options: ResponseOptions,
    },
    /// Orbit of a point of a response or of an attractor.
    Orbit(OrbitPlace),
    /// Stretch of the motion of an attractor without a period.
    AperiodicMotion(AttractorPlace),
    /// Points of a response whose orbits are given ones.
    BranchPoints {
        /// Number of the response.
        response: u64,
        /// The orbits; none where the page knows none.
        orbits: Vec<Option<SoughtOrbit>>,
    },
    /// Strain at the points of a response.
    Strain {
        /// Number of the response.
        response: u64,
    },
    /// Integrated points up and down over a key.
    Sweep {
        /// Range.
        #[serde(flatten)]
        span: KeySpan,
        /// Number of values.
        points: usize,
    },
    /// Mean power over the load.
    Load(LoadOptions),
    /// Basins of attraction over a plane of starts.
    Basins(BasinsOptions),
    /// Attractors at the present design from a cloud of starts.
    OperatingPoint(BasinsOptions),
    /// Mean power over realisations of the noise of the spec.
    Ensemble(EnsembleOptions),
    /// Goals and limits that a design can have.
    DesignOffer,
    /// The best design.
    DesignSearch(DesignFields),
    /// Band of the power under tolerances.
    Band(BandOptions),
    /// Response under the drives of the spec, noise or a recording.
    Shake {
        /// Excitation.
        by: ExcitationRequest,
    },
    /// Spec as text with the overrides, and the commands that give the same response.
    Export {
        /// Range.
        #[serde(flatten)]
        span: KeySpan,
        /// Fields of the link that the page reads.
        #[serde(default)]
        page: Vec<(String, String)>,
    },
    /// Writes the numbers into the file of the spec.
    Save {
        /// Text of the file with which the page has compared the design.
        before: String,
    },
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
            RequestKind::Design { .. } => "design",
            RequestKind::Modes => "modes",
            RequestKind::Response { .. } => "response",
            RequestKind::Orbit(_) => "orbit",
            RequestKind::AperiodicMotion(_) => "aperiodic-motion",
            RequestKind::BranchPoints { .. } => "branch-points",
            RequestKind::Strain { .. } => "strain",
            RequestKind::Sweep { .. } => "sweep",
            RequestKind::Load(_) => "load",
            RequestKind::Basins(_) => "basins",
            RequestKind::OperatingPoint(_) => "operating-point",
            RequestKind::Ensemble(_) => "ensemble",
            RequestKind::DesignOffer => "design-offer",
            RequestKind::DesignSearch(_) => "design-search",
            RequestKind::Band(_) => "band",
            RequestKind::Shake { .. } => "shake",
            RequestKind::Export { .. } => "export",
            RequestKind::Save { .. } => "save",
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
        let RequestKind::Response { span, options } = request.kind else {
            panic!("{request:?}")
        };
        assert_eq!((span.from, options), (12.0, ResponseOptions::default()));
        let request: Request = serde_json::from_str(
            r#"{"id": 8, "ask": "sweep", "over": "a.b", "from": 1, "to": 2, "points": 9}"#,
        )
        .unwrap();
        assert!(matches!(request.kind, RequestKind::Sweep { points: 9, .. }));
    }

    #[test]
    fn options_are_read_by_the_names_of_the_library() {
        let text = r#"{"id": 7, "ask": "response", "over": "a.b", "from": 1, "to": 2, "seeds": 3, "longest_period": 2}"#;
        let request: Request = serde_json::from_str(text).unwrap();
        let RequestKind::Response { options, .. } = request.kind else {
            panic!("{request:?}")
        };
        assert_eq!((options.seeds, options.longest_period), (3, 2));
        let text = r#"{"id": 8, "ask": "basins", "set": [], "starts": 225, "tolerance": 1e-6}"#;
        let request: Request = serde_json::from_str(text).unwrap();
        let expected = BasinsOptions {
            starts: 225,
            tolerance: 1e-6,
            ..Default::default()
        };
        assert!(matches!(request.kind, RequestKind::Basins(options) if options == expected));
        let text = text.replace("starts", "side");
        assert!(serde_json::from_str::<Request>(&text).is_err());
    }
}
