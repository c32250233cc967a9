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
    /// `tolerance`: wanted relative error of the response; default 1e-7.
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

/// Where a run starts from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Start {
    /// `"rest"`
    #[default]
    Rest,
    /// `"linear"`: the steady state of the harvester without its stop.
    Linear,
    /// Any other string with a dot or a slash in it: path of a state file saved by another run (relative to the spec file).
    State(String),
}
