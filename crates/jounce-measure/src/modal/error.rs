//! Why no modes are found.

/// Responses that give no modes.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ModalError {
    /// Responses of unequal length, or none.
    #[error(
        "response {response} has {lines} lines and the frequencies are {expected}; at least one response of as many lines is needed"
    )]
    Lengths {
        /// Number of the response, from 1.
        response: usize,
        /// Its lines.
        lines: usize,
        /// Number of frequencies.
        expected: usize,
    },
    /// A band with too few lines for the order.
    #[error(
        "between {low_hz} and {high_hz} Hz lie {lines} lines; order {order} needs at least {needed}: widen the band, refine the lines or lower the order"
    )]
    Few {
        /// Lower end, Hz.
        low_hz: f64,
        /// Upper end, Hz.
        high_hz: f64,
        /// Lines in the band.
        lines: usize,
        /// Largest order.
        order: usize,
        /// Lines that it needs.
        needed: usize,
    },
    /// A line that is not a number.
    #[error(
        "response {response} is not a number at {frequency_hz} Hz: does the input vanish there? Bridge such lines (--bridge, bridge=True), or leave them out of the band"
    )]
    NotFinite {
        /// Number of the response, from 1.
        response: usize,
        /// Frequency of the line, Hz.
        frequency_hz: f64,
    },
    /// Equations without a solution.
    #[error(
        "the equations have no solution at any order up to {order}: all responses are zero, or the same lines stand twice; look at the responses, or widen the band"
    )]
    Singular {
        /// The order.
        order: usize,
    },
    /// No pole stays where it is.
    #[error(
        "no pole is stable from order to order between {low_hz} and {high_hz} Hz: there is no clear mode, or the coherence is too low"
    )]
    NoMode {
        /// Lower end, Hz.
        low_hz: f64,
        /// Upper end, Hz.
        high_hz: f64,
    },
    /// Every pole that was found may be one of noise.
    #[error(
        "there is no clear mode between {low_hz} and {high_hz} Hz: every pole found there ({}, at {} Hz) is doubtful, since its damping cannot be \
         told from none, as that of poles which noise makes; try a longer record, a narrower band, or another order",
        frequency_hz.len(),
        first(frequency_hz)
    )]
    Doubtful {
        /// Lower end, Hz.
        low_hz: f64,
        /// Upper end, Hz.
        high_hz: f64,
        /// The frequencies of the poles, Hz.
        frequency_hz: Vec<f64>,
    },
}

/// Frequencies that are told one by one.
const MAX_LISTED_FREQUENCIES: usize = 6;

fn first(frequency_hz: &[f64]) -> String {
    let first: Vec<String> = frequency_hz
        .iter()
        .take(MAX_LISTED_FREQUENCIES)
        .map(|f| format!("{f:.4}"))
        .collect();
    let more = if frequency_hz.len() > MAX_LISTED_FREQUENCIES {
        ", ..."
    } else {
        ""
    };
    format!("{}{more}", first.join(", "))
}
