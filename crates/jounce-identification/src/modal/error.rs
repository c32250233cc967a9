//! Errors of modal analysis.

/// Error of a modal analysis.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ModalError {
    /// Responses of unequal length, or no response.
    #[error(
        "response {response} has {lines} lines, but there are {expected} frequencies; at least \
        one response is needed, with equal numbers"
    )]
    Lengths {
        /// Number of the response, from 1.
        response: usize,
        /// Number of its lines.
        lines: usize,
        /// Number of frequencies.
        expected: usize,
    },
    /// The band has too few lines for the order.
    #[error(
        "there are {lines} lines between {low_hz} and {high_hz} Hz; order {order} needs at least \
        {needed}: widen the band, refine the lines or lower the order"
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
        /// Minimum number of lines.
        needed: usize,
    },
    /// A line is not a number.
    #[error(
        "response {response} is not a number at {frequency_hz} Hz: does the input vanish there? Bridge such lines (--bridge, bridge=True), or leave them out of the band"
    )]
    NotFinite {
        /// Number of the response, from 1.
        response: usize,
        /// Frequency of the line, Hz.
        frequency_hz: f64,
    },
    /// The equations have no solution.
    #[error(
        "the equations have no solution at any order up to {order}: all responses are zero, or \
        lines are duplicated; check the responses, or widen the band"
    )]
    Singular {
        /// The order.
        order: usize,
    },
    /// No pole is stable.
    #[error(
        "no pole is stable from order to order between {low_hz} and {high_hz} Hz: there is no clear mode, or the coherence is too low"
    )]
    NoMode {
        /// Lower end, Hz.
        low_hz: f64,
        /// Upper end, Hz.
        high_hz: f64,
    },
    /// The modes of all blocks except one cannot be fitted.
    #[error(
        "the modes cannot be fitted without block {block} of {blocks}, so their deviations are \
        unknown; try a longer record, a narrower band, or another order"
    )]
    LeaveOneOut {
        /// Number of the block that is left out, from 1.
        block: usize,
        /// Number of blocks.
        blocks: usize,
    },
    /// All poles may be noise.
    #[error(
        "there is no clear mode between {low_hz} and {high_hz} Hz: all poles found there ({}, at \
        {} Hz) have damping statistically indistinguishable from zero and may be noise; try a \
        longer record, a narrower band, or another order",
        frequency_hz.len(),
        first(frequency_hz)
    )]
    Doubtful {
        /// Lower end, Hz.
        low_hz: f64,
        /// Upper end, Hz.
        high_hz: f64,
        /// Frequencies of the poles, Hz.
        frequency_hz: Vec<f64>,
    },
}

/// Maximum number of frequencies listed in a message.
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
