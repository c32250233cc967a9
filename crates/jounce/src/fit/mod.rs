//! Keys of a spec fitted to measurements.

mod report;

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_experiment::fit::{Features, FitResult as FitEstimate, FittedKey, fit};
use serde::Serialize;

/// Fitted keys with their uncertainty, and the harvester with the fitted values.
#[derive(Debug, Clone, Serialize)]
pub struct FitResult {
    /// Keys, and features before and after.
    #[serde(flatten)]
    pub estimate: FitEstimate,
    /// Harvester with the fitted values.
    #[serde(skip)]
    pub fitted: Harvester,
}

impl Harvester {
    /// Fits keys to measured modes, frequency responses, powers, jumps and time histories. The
    /// progress of the control is the number of computed models.
    ///
    /// # Errors
    /// [`Error::Fit`] for features that do not fit the spec, or no convergence.
    ///
    /// ```
    /// use jounce::{Features, Harvester};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/impact-harvester-2019/harvester.toml")?;
    /// let features = Features::from_toml(
    ///     r#"
    ///     hold = ["table"]
    ///     frequency_deviation = 0.002
    ///     [free]
    ///     "beam.beam.youngs_modulus" = 0.03
    ///     [[mode]]
    ///     number = 1
    ///     frequency = "9.01 Hz"
    ///     "#,
    /// );
    /// let result = harvester.fit(&features.expect("features"))?;
    /// println!("{:.3e} Pa", result.estimate.keys[0].after);
    /// println!("{}", result.fitted.text());
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn fit(&self, features: &Features) -> Result<FitResult, Error> {
        let (file, spec, folder) = (self.file(), self.spec(), self.folder());
        let (estimate, _) = fit(file, spec, features, folder, self.control())?;
        let value = |key: &FittedKey| format!("{:?} {}", key.after, key.unit);
        let values: Vec<String> = estimate.keys.iter().map(value).collect();
        let keys = estimate.keys.iter().map(|key| key.key.as_str());
        let fitted = self.changed(keys.zip(values.iter().map(|value| value.trim())))?;
        Ok(FitResult { estimate, fitted })
    }
}
