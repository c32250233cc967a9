//! Modes of a hammer or shaker test, of free decays and of output-only tests.

mod options;
mod report;
mod result;
mod tables;

pub use options::MeasuredModesOptions;
pub use result::{ComplexValues, MeasuredMode, MeasuredModesResult};

use crate::error::Error;
use crate::measured_frf::{MeasuredFrfOptions, MeasuredFrfResult};
use crate::recording::Recording;
use jounce_data::recording::Over;
use jounce_identification::modal::{
    Band, Identification, ModalSettings, identify, identify_decays, mac_matrix,
};
use jounce_identification::response::{AmbientSettings, Decays};

impl Recording {
    /// Identifies the modes of a hammer or shaker test, of free decays or of outputs only, with the
    /// uncertainty of each.
    ///
    /// # Errors
    /// Those of [`Recording::measured_frf`], and [`Error::Modal`] where there is no clear mode or
    /// the band has too few lines.
    ///
    /// ```no_run
    /// use jounce::{MeasuredFrfOptions, MeasuredModesOptions, ReadOptions, Recording};
    /// let recordings = [Recording::read("hammer.csv", &ReadOptions::default())?];
    /// let band = MeasuredModesOptions { between_hz: Some((5.0, 200.0)), ..Default::default() };
    /// let result = Recording::measured_modes(&recordings, &MeasuredFrfOptions::default(), &band)?;
    /// for mode in &result.modes {
    ///     println!("{} Hz, damping ratio {}", mode.frequency_hz, mode.damping_ratio);
    /// }
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn measured_modes(
        recordings: &[Self],
        test: &MeasuredFrfOptions,
        options: &MeasuredModesOptions,
    ) -> Result<MeasuredModesResult, Error> {
        options.check()?;
        let settings = ModalSettings {
            order: options.order,
        };
        if options.is_unforced() {
            test.refuse_input()?;
            let decays = decays(recordings, &test.response, options)?;
            let between_hz = options.between_hz.unwrap_or((0.0, 0.5 * decays.rate_hz));
            let found = identify_decays(&decays, between_hz, settings)?;
            return Ok(MeasuredModesResult::of_decays(decays, found));
        }
        let frf = Self::measured_frf(recordings, test)?;
        let highest_hz = frf.frequency_hz.last().copied().unwrap_or(0.0);
        let between_hz = options.between_hz.unwrap_or((0.0, highest_hz));
        let mut found = identify(&Band::of(&frf.data, between_hz)?, settings)?;
        for mode in &mut found.modes {
            mode.without_decay(frf.window_decay_per_s);
        }
        Ok(MeasuredModesResult::of_responses(frf, found))
    }
}

/// Returns the decays of recordings without a measured input.
fn decays(
    recordings: &[Recording],
    responses: &[String],
    options: &MeasuredModesOptions,
) -> Result<Decays, Error> {
    if options.free_decay {
        let records = recordings.iter().map(Recording::load_all);
        let records = records.collect::<Result<Vec<_>, _>>()?;
        return Ok(Decays::free(&records, responses, options.span_s)?);
    }
    let [recording] = recordings else {
        let count = recordings.len();
        let expected = format!("it takes one recording, but {count} are given");
        return Err(Error::option("output_only", "given", expected));
    };
    if recording.over() == Over::Frequency {
        return Ok(Decays::of_spectrum(recording.data(), responses)?);
    }
    let settings = AmbientSettings {
        responses: responses.to_vec(),
        references: options.reference.clone(),
        lags_s: options.lags_s,
    };
    Ok(Decays::ambient(&recording.load_all()?, &settings)?)
}

impl MeasuredModesResult {
    fn of_decays(decays: Decays, found: Identification) -> Self {
        let functions = decays.names();
        let used_channels = decays.outputs.iter().chain(&decays.references).cloned();
        Self {
            issues: decays.issues,
            used_channels: used_channels.collect(),
            ..Self::new(found, functions, decays.outputs, Vec::new(), None)
        }
    }

    fn of_responses(frf: MeasuredFrfResult, found: Identification) -> Self {
        let functions = frf.responses.iter().map(|response| response.name.clone());
        let references = match &frf.references[..] {
            [] | [_] => Vec::new(),
            several => several.to_vec(),
        };
        let outputs = frf.outputs.clone();
        Self::new(found, functions.collect(), outputs, references, Some(frf))
    }

    fn new(
        found: Identification,
        functions: Vec<String>,
        responses: Vec<String>,
        references: Vec<String>,
        frf: Option<MeasuredFrfResult>,
    ) -> Self {
        let modes = found.modes.iter();
        let modes = modes.map(|mode| MeasuredMode::of(mode, references.len(), frf.as_ref()));
        let of_frf = frf.as_ref();
        Self {
            modes: modes.collect(),
            responses,
            references,
            mac: mac_matrix(&found.modes),
            misfit: found.misfit,
            unexplained: found.unexplained.clone(),
            stabilisation: found.diagram.clone(),
            hits: of_frf.map_or_else(Vec::new, |frf| frf.hits.clone()),
            block_s: of_frf.and_then(|frf| frf.block_s),
            window_decay_per_s: of_frf.map_or(0.0, |frf| frf.window_decay_per_s),
            issues: of_frf.map_or_else(Vec::new, |frf| frf.issues.clone()),
            functions,
            frf,
            identification: found,
            used_channels: Vec::new(),
        }
    }
}
