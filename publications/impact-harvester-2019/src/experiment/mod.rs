//! Experimental half of the 2019 paper: Table 2 and figures 10 to 13 measured in a virtual test,
//! and the model updated to Table 2.
//!
//! The paper prints its records only as figures, so no laboratory record is used. Instead, a model
//! is recorded as by the paper's sensors (1536 Hz, 85 s), with noise and drift of the shaker. The
//! commands for recordings analyse these records. Results are compared with the known inputs. The
//! frequencies of Table 2 are printed, and the model is fitted to those.
//!
//! Source: "Experimental validation of an impact off-resonance energy harvester" (2019), section 5.
mod error;
mod load;
mod modal_test;
mod record;
mod updated;

use crate::{Chapter, NamedFigure, NamedTable, Reproduction};
use jounce_control::Control;
use rayon::prelude::*;

pub use error::ExperimentError;

use load::{ABOVE_RESONANCE, BELOW_RESONANCE, PowerOverLoad};
use modal_test::ModalTest;
use record::Alternating;
use updated::Updated;

/// Sampling rate of the paper's records, Hz.
const RATE_HZ: f64 = 1536.0;
/// Length of the records, s.
const RECORD_S: f64 = 85.0;
/// White noise of every sensor, relative to the RMS of its signal: an assumption, not given in the
/// paper.
const NOISE: f64 = 0.01;

/// Computes Table 2 and figures 10 to 13 in the virtual test, and the model updated to Table 2.
/// `paper` supplies the printed numbers for comparison; `control` can stop the runs early.
///
/// # Errors
/// None expected unless `control` stops it, because the inputs are built in. See
/// [`ExperimentError`].
pub fn chapters(paper: &Reproduction, control: &Control) -> Result<Vec<Chapter>, ExperimentError> {
    let printed = |column: &str| {
        paper
            .table("table-2")
            .and_then(|table| table.table.floats(column))
            .unwrap_or_default()
    };
    let (modal, (loads, record)) = rayon::join(
        || {
            Ok::<_, ExperimentError>((
                ModalTest::compute(printed("measured_hz"))?,
                Updated::compute(control)?,
            ))
        },
        || {
            rayon::join(
                || {
                    [ABOVE_RESONANCE, BELOW_RESONANCE]
                        .into_par_iter()
                        .map(|case| PowerOverLoad::compute(case, control))
                        .collect::<Result<Vec<_>, _>>()
                },
                || Alternating::compute(control),
            )
        },
    );
    let ((modal, updated), loads, record) = (modal?, loads?, record?);
    let table_2 = Chapter {
        heading: "Table 2 measured (simulated): modal test of the virtual rig".to_owned(),
        paragraphs: modal.summary(),
        tables: vec![modal.table()?],
        figures: modal.figures(),
    };
    let model = Chapter {
        heading: "Table 2: the updated model against the measured column".to_owned(),
        paragraphs: updated.summary(printed("paper_model_hz")),
        tables: updated.tables()?,
        figures: vec![updated.figure()],
    };
    let power = Chapter {
        heading: "Figures 10 and 11 (simulated): power over load from records".to_owned(),
        paragraphs: load::summary(&loads),
        tables: loads
            .iter()
            .map(PowerOverLoad::table)
            .collect::<Result<Vec<NamedTable>, _>>()?,
        figures: loads
            .iter()
            .map(PowerOverLoad::figure)
            .collect::<Vec<NamedFigure>>(),
    };
    let alternating = Chapter {
        heading: "Figures 12 and 13 (simulated): a record of two solutions".to_owned(),
        paragraphs: record.summary(),
        tables: vec![record.table()?],
        figures: record.figures()?,
    };
    Ok(vec![table_2, model, power, alternating])
}
