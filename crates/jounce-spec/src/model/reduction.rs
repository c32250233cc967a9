//! `[reduction]`

/// `[reduction]`
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// `modes`: number of retained modes of the assembled structure; default 8.
    pub modes: usize,
    /// `mesh_tolerance`: required relative error of every retained frequency; default 1e-9.
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
