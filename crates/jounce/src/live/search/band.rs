//! Band of the power over the key of a response, under tolerances.

use super::FieldFault;
use crate::error::Error;
use crate::live::orbits::{BranchPlace, point_at};
use crate::live::{Design, LiveAnalysis};
use jounce_analysis::KnownOrbit;
use jounce_control::Control;
use jounce_design::{DesignError, PowerBand, PowerBandSearch, Tolerance};
use jounce_spec::Fault;
use serde::{Deserialize, Serialize};

/// Number of values of the key.
const POINTS: usize = 61;
/// Number of drawn designs.
const DRAWS: usize = 64;
/// Seed of the draws.
const SEED: u64 = 1;

/// Options of [`LiveAnalysis::band`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BandOptions {
    /// Point of a stored response whose orbit is followed.
    #[serde(flatten)]
    pub place: BranchPlace,
    /// Tolerances, as in a design file.
    pub tolerance: Vec<(String, String)>,
}

/// Band of the power of an orbit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BandResult {
    /// The key of the response.
    pub over: String,
    /// Number of drawn designs.
    pub draws: usize,
    /// The band.
    #[serde(flatten)]
    pub band: PowerBand,
}

impl BandOptions {
    /// Returns the faults of the tolerances in an error; `None` for another error.
    pub fn faults(&self, error: &Error) -> Option<Vec<FieldFault>> {
        let Error::Design(error) = error else {
            return None;
        };
        let DesignError::Faults(faults) = error.as_ref() else {
            return None;
        };
        let field = |fault: &Fault| FieldFault {
            table: "tolerance".to_owned(),
            key: fault.key.clone(),
            message: fault.message.clone(),
        };
        Some(faults.iter().map(field).collect())
    }
}

impl LiveAnalysis {
    /// Computes the quantiles of the power over the range of a stored response. The orbit of a
    /// point is followed to each design that is drawn from the tolerances, and over the range from
    /// there.
    ///
    /// # Errors
    /// [`Error::Option`] for a response that is no longer stored, [`Error::Design`] with the faults
    /// of the tolerances, [`Error::Stopped`].
    pub fn band(
        &self,
        design: &Design,
        options: &BandOptions,
        control: &Control,
    ) -> Result<BandResult, Error> {
        let tolerances = tolerances(design, &options.tolerance)?;
        let response = self.stored_response(options.place.response)?;
        let (period_cycles, point) = point_at(&response, &options.place)?;
        let base = self.model(&response.spec, control)?;
        let (low, high) = response.range;
        let value = |k: usize| low + (high - low) * k as f64 / (POINTS - 1) as f64;
        let search = PowerBandSearch {
            base: &base,
            key: &response.key,
            values: (0..POINTS).map(value).collect(),
            orbit: KnownOrbit {
                period_cycles,
                state: point.orbit.start().to_vec(),
                parameter: point.parameter,
            },
            tolerances: &tolerances,
            draws: DRAWS,
            seed: SEED,
        };
        let band = search.run()?;
        if control.is_stopped() {
            return Err(Error::Stopped);
        }
        Ok(BandResult {
            over: response.key.path().to_owned(),
            draws: DRAWS,
            band,
        })
    }
}

/// Reads tolerances.
fn tolerances(design: &Design, texts: &[(String, String)]) -> Result<Vec<Tolerance>, Error> {
    let (mut all, mut faults) = (Vec::new(), Vec::new());
    if texts.is_empty() {
        let message = "no tolerance is given; add one, such as 0.05 mm of a gap";
        faults.push(Fault::without_position("tolerance", message));
    }
    for (key, text) in texts {
        match Tolerance::read(design.harvester().file(), key, text) {
            Ok(tolerance) => all.push(tolerance),
            Err(messages) => faults.extend(
                messages
                    .into_iter()
                    .map(|message| Fault::without_position(key, message)),
            ),
        }
    }
    match faults.is_empty() {
        true => Ok(all),
        false => Err(DesignError::Faults(faults).into()),
    }
}
