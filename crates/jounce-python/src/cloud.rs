//! Cloud of starts of a call.

use crate::failure::Failure;
use jounce_core::analysis::Cloud;

/// Maximum number of starts of a cloud.
const MAX_STARTS: usize = 100_000_000;

/// Default seed and size of a cloud, the size in gaps.
const SEED: u64 = 1;
const SPREAD: f64 = 10.0;

/// Options of a cloud.
#[derive(Clone, Copy)]
pub struct CloudOptions {
    pub starts: Option<usize>,
    pub seed: Option<u64>,
    pub spread: Option<f64>,
}

impl CloudOptions {
    /// Returns the cloud, with a default number of starts.
    pub fn cloud(self, starts: usize) -> Result<Cloud, Failure> {
        let cloud = Cloud {
            starts: self.starts.unwrap_or(starts),
            seed: self.seed.unwrap_or(SEED),
            spread: self.spread.unwrap_or(SPREAD),
        };
        let &Cloud { starts, spread, .. } = &cloud;
        if (1..=MAX_STARTS).contains(&starts) && spread > 0.0 && spread.is_finite() {
            return Ok(cloud);
        }
        let reason = format!(
            "starts is {starts} and spread {spread}; starts must be from 1 to {MAX_STARTS}, spread greater than 0 and finite"
        );
        let details = serde_json::json!({ "starts": starts, "least_starts": 1, "most_starts": MAX_STARTS, "spread": spread });
        Err(Failure::new("ArgumentError", reason).with(details))
    }

    /// Refuses the options where there is no cloud; `alternative` names the option that needs one.
    pub fn refuse_options(self, alternative: &str) -> Result<(), Failure> {
        let options = [
            ("starts", self.starts.is_some()),
            ("seed", self.seed.is_some()),
            ("spread", self.spread.is_some()),
        ];
        match options.into_iter().find(|(_, is_given)| *is_given) {
            None => Ok(()),
            Some((option, _)) => {
                let reason = format!(
                    "{option} needs a cloud of starts: {alternative} or leave {option} out"
                );
                Err(Failure::new("ArgumentError", reason)
                    .with(serde_json::json!({ "option": option })))
            }
        }
    }
}
