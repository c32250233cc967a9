//! `[damping]`

/// `[damping]`: damping ratios of the modes of all assembled beams, in ascending order, those of masses left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Damping {
    /// `ratios`: one per flexible mode in ascending order.
    pub ratios: Vec<f64>,
    /// `beyond`: ratio of the flexible modes after the list; needed only when there are more modes than ratios.
    pub beyond: Option<f64>,
}
