//! `[damping]`

/// `[damping]`: damping ratios of the modes of all assembled beams, ascending in frequency, without
/// the modes of masses.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Damping {
    /// `ratios`: one per flexible mode, ascending in frequency.
    pub ratios: Vec<f64>,
    /// `beyond`: ratio of the flexible modes after the list; required only if there are more modes
    /// than ratios.
    pub beyond: Option<f64>,
}
