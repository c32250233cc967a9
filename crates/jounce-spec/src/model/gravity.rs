//! `[gravity]`

/// `[gravity]`
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gravity {
    /// `acceleration` along the positive direction of motion, m/s^2; negative if gravity acts in
    /// the opposite direction.
    pub acceleration_m_s2: Option<f64>,
}
