//! Exact response to noise without contact.

mod options;
mod report;

pub use options::NoiseOptions;

use crate::error::Error;
use crate::harvester::Harvester;
use crate::options::check_band;
use jounce_model::linear::{Density, Random, RandomLoad, RandomPatch, RandomPoint, RandomStop};
use serde::Serialize;

/// Means, mean squares and power spectral densities of the response to noise without contact.
/// Stops are omitted: the crossing rates of their gaps are given instead.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NoiseResult {
    /// Names of the drives with noise.
    pub drives: Vec<String>,
    /// Names of the omitted drives, which are not noise.
    pub left_out: Vec<String>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Each load.
    pub loads: Vec<RandomLoad>,
    /// Each patch.
    pub patches: Vec<RandomPatch>,
    /// Each point.
    pub points: Vec<RandomPoint>,
    /// Each stop.
    pub stops: Vec<RandomStop>,
    /// Frequencies of the densities, Hz, closer around each resonance.
    #[serde(skip)]
    pub frequency_hz: Vec<f64>,
    /// One-sided power spectral density of every voltage and displacement.
    #[serde(skip)]
    pub densities: Vec<Density>,
}

impl Harvester {
    /// Computes the exact response to the noises of the spec without contact. Drives other than
    /// noise and stops are omitted.
    ///
    /// # Errors
    /// [`Error::Option`] for a wrong band, [`Error::Noise`] for a spec without noise or without a
    /// stationary linear response, [`Error::Stopped`].
    ///
    /// ```
    /// use jounce::{Harvester, NoiseOptions};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/random-base/harvester.toml")?;
    /// let result = harvester.noise(&NoiseOptions { points: 100, ..Default::default() })?;
    /// println!("{:.3e} W", result.mean_power_w);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn noise(&self, options: &NoiseOptions) -> Result<NoiseResult, Error> {
        let random = Random::new(self.spec())?;
        let [low_hz, high_hz] = random.usual_band_hz();
        let low_hz = options.low_hz.unwrap_or(low_hz);
        let high_hz = options.high_hz.unwrap_or(high_hz);
        check_band([low_hz, high_hz], options.points)?;
        let frequency_hz = random.frequencies_hz(low_hz, high_hz, options.points);
        let response = random.response()?;
        let densities = random.densities_until(&frequency_hz, &|| self.control().is_stopped())?;
        if self.control().is_stopped() {
            return Err(Error::Stopped);
        }
        Ok(NoiseResult {
            drives: response.drives,
            left_out: response.left_out,
            mean_power_w: response.mean_power_w,
            loads: response.loads,
            patches: response.patches,
            points: response.points,
            stops: response.stops,
            frequency_hz,
            densities,
        })
    }
}
