//! `[reduction]`

/// `[reduction]`
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// `modes`: number of retained modes of the assembled structure; default 8.
    pub modes: usize,
    /// `mesh_tolerance`: required relative error of every retained frequency; default 1e-9.
    pub mesh_tolerance: f64,
}

impl Reduction {
    /// Largest number of retained modes: higher modes are far outside the validity of beam theory,
    /// and the dense solve is slow.
    pub const MAX_MODES: usize = 200;
}

impl Default for Reduction {
    fn default() -> Self {
        Self {
            modes: 8,
            mesh_tolerance: 1e-9,
        }
    }
}
