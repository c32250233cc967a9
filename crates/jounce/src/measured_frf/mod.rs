//! Frequency responses of a hammer or shaker test.

mod hits;
mod options;
mod report;
mod result;

pub use options::{FrfEstimator, FunctionParts, MeasuredFrfOptions};
pub use result::{MeasuredFrfResult, MeasuredResponse, PerG};

use crate::error::Error;
use crate::recording::Recording;
use jounce_data::recording::Over;
use jounce_identification::response::{MeasuredResponses, bridged, paired};

impl Recording {
    /// Computes the frequency responses of a hammer or shaker test from one or more recordings over
    /// time; recordings over frequency are taken as response functions.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::Response`] for channels that do not exist or do not suit, a
    /// record without a hit, or recordings that do not belong together.
    ///
    /// ```no_run
    /// use jounce::{MeasuredFrfOptions, ReadOptions, Recording};
    /// let recordings = [Recording::read("hammer.csv", &ReadOptions::default())?];
    /// let result = Recording::measured_frf(&recordings, &MeasuredFrfOptions::default())?;
    /// for response in &result.responses {
    ///     println!("{} in {}", response.name, response.unit);
    /// }
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn measured_frf(
        recordings: &[Self],
        options: &MeasuredFrfOptions,
    ) -> Result<MeasuredFrfResult, Error> {
        let settings = options.settings()?;
        let choice = options.choice()?;
        let is_function = |one: &Self| one.over() == Over::Frequency;
        if options.functions.is_some() || recordings.iter().all(is_function) {
            let functions = recordings.iter().map(|one| one.data().clone()).collect();
            let functions = match options.parts() {
                Some(parts) => paired(functions, parts)?,
                None => functions,
            };
            let functions = match options.bridge {
                true => bridged(functions),
                false => functions,
            };
            let data = MeasuredResponses::from_functions(&functions)?;
            return Ok(MeasuredFrfResult::of(data));
        }
        let records = recordings.iter().map(Self::load_all);
        let records = records.collect::<Result<Vec<_>, _>>()?;
        let data = MeasuredResponses::of_hits(&records, &choice, &settings)?;
        Ok(MeasuredFrfResult::of(data))
    }
}
