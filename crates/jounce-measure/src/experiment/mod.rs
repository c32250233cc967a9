//! The experimental half of the 2019 paper: Table 2 measured and figures 10 to 13 on the virtual rig, and the model updated to Table 2.
//!
//! The paper prints its records as pictures only, so no record here is of a laboratory: a model is recorded as the paper's sensors would
//! have recorded it (1536 Hz, 85 s), noise and a wandering shaker with it, and the commands for recordings analyse it. What was put in is
//! known, and stands beside what comes out. The frequencies of Table 2 are printed, and the model is fitted to those.
//!
//! Source: "Experimental validation of an impact off-resonance energy harvester" (2019), section 5.
mod error;
mod load;
mod modal_test;
mod record;
mod updated;

use jounce::integrate::Control;
use jounce::reproduce::{Chapter, NamedFigure, NamedTable, Reproduction};
use rayon::prelude::*;

pub use error::ExperimentError;

use load::{ABOVE_RESONANCE, BELOW_RESONANCE, PowerOverLoad};
use modal_test::ModalTest;
use record::Alternating;
use updated::Updated;

/// Samples per second of the paper's records.
const RATE_HZ: f64 = 1536.0;
/// Their length, s.
const RECORD_S: f64 = 85.0;
/// White noise of every sensor, over the rms of its signal: a guess, the paper does not tell.
const NOISE: f64 = 0.01;

/// Table 2 and figures 10 to 13 from the virtual rig, and the model updated to Table 2; `paper` has the printed numbers beside them, `control` ends the marches early.
///
/// # Errors
/// None is expected but where the control stops it: the inputs are built in. See [`ExperimentError`].
pub fn chapters(paper: &Reproduction, control: &Control) -> Result<Vec<Chapter>, ExperimentError> {
    let printed = |column: &str| {
        paper
            .table("table-2")
            .and_then(|named| named.table.floats(column))
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
        paragraphs: modal.words(),
        tables: vec![modal.table()?],
        figures: modal.figures(),
    };
    let model = Chapter {
        heading: "Table 2: the updated model against the measured column".to_owned(),
        paragraphs: updated.words(printed("paper_model_hz")),
        tables: updated.tables()?,
        figures: vec![updated.figure()],
    };
    let power = Chapter {
        heading: "Figures 10 and 11 (simulated): power over load from records".to_owned(),
        paragraphs: load::words(&loads),
        tables: loads
            .iter()
            .map(PowerOverLoad::table)
            .collect::<Result<Vec<NamedTable>, _>>()?,
        figures: loads
            .iter()
            .map(PowerOverLoad::figure)
            .collect::<Vec<NamedFigure>>(),
    };
    let jumping = Chapter {
        heading: "Figures 12 and 13 (simulated): a record of two solutions".to_owned(),
        paragraphs: record.words(),
        tables: vec![record.table()?],
        figures: record.figures()?,
    };
    Ok(vec![table_2, model, power, jumping])
}
