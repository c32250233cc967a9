//! `[run]`

/// `[run]`
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// `start`; default rest.
    pub start: Start,
    /// `duration`, s.
    pub duration_s: f64,
    /// `average_over`: length of the averaging window at the end of the run, s; at most `duration`.
    pub average_over_s: f64,
    /// `tolerance`: required relative error of the response; default 1e-7.
    pub tolerance: f64,
}

impl Default for Run {
    fn default() -> Self {
        Self {
            start: Start::Rest,
            duration_s: 20.0,
            average_over_s: 10.0,
            tolerance: 1e-7,
        }
    }
}

/// Initial condition of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Start {
    /// `"rest"`
    #[default]
    Rest,
    /// `"linear"`: steady state of the harvester without its stops.
    Linear,
    /// Any other string that contains a dot or a slash: path of a state file saved by another run,
    /// relative to the spec file.
    State(String),
}
