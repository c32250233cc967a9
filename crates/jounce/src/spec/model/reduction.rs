//! `[reduction]`

/// `[reduction]`
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// `modes`: how many modes of the assembled structure are kept; default 8.
    pub modes: usize,
    /// `mesh_tolerance`: wanted relative error of every kept frequency; default 1e-9.
    pub mesh_tolerance: f64,
}

impl Default for Reduction {
    fn default() -> Self {
        Self {
            modes: 8,
            mesh_tolerance: 1e-9,
        }
    }
}
