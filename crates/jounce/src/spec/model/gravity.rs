//! `[gravity]`

/// `[gravity]`
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gravity {
    /// `acceleration` in the positive direction of motion, m/s^2; negative where gravity pulls the other way.
    pub acceleration_m_s2: Option<f64>,
}
