//! `[device.NAME]`

/// An electronic device with a duty cycle, supplied by a regulator.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// `sleep_current` for the rest of each period, A.
    pub sleep_a: f64,
    /// `measure_current`, A.
    pub measure_a: Option<f64>,
    /// `measure_time` at the start of each period, s.
    pub measure_s: Option<f64>,
    /// `send_current`, A.
    pub send_a: Option<f64>,
    /// `send_time` after the measurement, s.
    pub send_s: Option<f64>,
    /// `period` of the duty cycle, s; `None` without one.
    pub period_s: Option<f64>,
}
