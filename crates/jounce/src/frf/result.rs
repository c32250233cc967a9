//! Result of frequency responses.

use serde::{Serialize, Serializer};

/// Frequency responses without contact, per newton at a point or per m/s^2 of the base; sign
/// convention `e^{+i w t}`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrfResult {
    /// Excitation point, or `base`.
    pub input: String,
    /// Names of the fixed masses.
    pub held: Vec<String>,
    /// Frequencies, Hz.
    pub frequency_hz: Vec<f64>,
    /// Acceleration of every point, or displacement relative to the base that is excited; voltage
    /// of every patch and of every circuit.
    #[serde(serialize_with = "by_name")]
    pub responses: Vec<FrfResponse>,
}

/// One frequency response.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrfResponse {
    /// Name, as in `beam.tip.acceleration` or `mfc.voltage`.
    #[serde(skip)]
    pub name: String,
    /// Real part at each frequency.
    pub re: Vec<f64>,
    /// Imaginary part at each frequency.
    pub im: Vec<f64>,
    /// Unit of both parts.
    pub unit: &'static str,
}

impl FrfResponse {
    /// True where the excitation does not move the output at any frequency.
    pub fn is_zero(&self) -> bool {
        self.re.iter().chain(&self.im).all(|value| *value == 0.0)
    }

    /// Returns the number of the frequency with the largest magnitude, and that magnitude.
    pub fn highest(&self) -> Option<(usize, f64)> {
        let magnitudes = self.re.iter().zip(&self.im).map(|(re, im)| re.hypot(*im));
        magnitudes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

fn by_name<S: Serializer>(responses: &[FrfResponse], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(responses.iter().map(|response| (&response.name, response)))
}
