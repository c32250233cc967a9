//! Table 2: natural frequencies of the clamped beam, with the paper's section and with the
//! laminate.
//!
//! Source: impact-harvester paper (2019), Table 2; density of the patch 5440 kg/m^3 from its
//! manufacturer (the paper neglects the mass of the patch).

use crate::harvester::PaperHarvester;
use crate::{NamedTable, ReproduceError};
use jounce_io::table::{Column, Table};
use jounce_model::structure::modes_holding;

/// Frequencies of the paper's model, Hz, as printed.
const PAPER_HZ: [f64; 7] = [8.66, 50.3, 140.9, 278.9, 457.6, 681.9, 960.5];
/// Half of the last printed digit, Hz.
const HALF_DIGIT_HZ: [f64; 7] = [0.005, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05];
/// Measured frequencies of the paper, Hz.
const MEASURED_HZ: [f64; 7] = [9.01, 49.7, 133.2, 262.8, 436.2, 651.3, 918.1];

/// Frequencies of the clamped beam, Hz.
pub(crate) struct Frequencies {
    pub thin_skin_hz: Vec<f64>,
    pub laminate_hz: Vec<f64>,
}

impl Frequencies {
    /// Computes the frequencies for both sections.
    pub fn compute() -> Result<Self, ReproduceError> {
        let clamped = |section: &str| -> Result<Vec<f64>, ReproduceError> {
            let spec =
                PaperHarvester::spec(&[("patch.mfc.section".to_owned(), section.to_owned())])?;
            let modes = modes_holding(&spec, &["table".to_owned()])?;
            Ok(modes
                .frequency_rad_s
                .iter()
                .map(|w| w / std::f64::consts::TAU)
                .collect())
        };
        Ok(Self {
            thin_skin_hz: clamped("thin-skin")?,
            laminate_hz: clamped("laminate")?,
        })
    }

    /// True where the computed frequencies match every printed digit of the paper's model column.
    pub fn match_print(&self) -> bool {
        let mut all = self.thin_skin_hz.iter().zip(PAPER_HZ).zip(HALF_DIGIT_HZ);
        self.thin_skin_hz.len() == PAPER_HZ.len()
            && all.all(|((ours, paper), half)| (ours - paper).abs() <= half)
    }

    /// Returns the largest relative distance from the measurement, for the thin skin and the
    /// laminate.
    pub fn worst_errors(&self) -> (f64, f64) {
        let worst = |ours: &[f64]| {
            errors_percent(ours)
                .iter()
                .fold(0.0, |worst: f64, error| worst.max(error.abs()))
                / 100.0
        };
        (worst(&self.thin_skin_hz), worst(&self.laminate_hz))
    }

    /// Returns the table.
    pub fn table(&self) -> Result<NamedTable, ReproduceError> {
        let table = Table::new(vec![
            Column::new("mode", "", "Mode", (1..=7).collect::<Vec<u64>>()),
            Column::new(
                "measured_hz",
                "Hz",
                "Measured (paper)",
                MEASURED_HZ.to_vec(),
            ),
            Column::new("paper_model_hz", "Hz", "Model (paper)", PAPER_HZ.to_vec()),
            Column::new(
                "thin_skin_hz",
                "Hz",
                "Model (ours, thin skin)",
                self.thin_skin_hz.clone(),
            ),
            Column::new(
                "thin_skin_error_percent",
                "%",
                "its error",
                errors_percent(&self.thin_skin_hz),
            ),
            Column::new(
                "laminate_hz",
                "Hz",
                "Laminate with patch mass",
                self.laminate_hz.clone(),
            ),
            Column::new(
                "laminate_error_percent",
                "%",
                "its error",
                errors_percent(&self.laminate_hz),
            ),
        ])?;
        let caption =
            "Table 2. Natural frequencies with the table fixed; errors against the measurement.";
        Ok(NamedTable::new("table-2", caption, 4, table))
    }
}

fn errors_percent(ours_hz: &[f64]) -> Vec<f64> {
    ours_hz
        .iter()
        .zip(MEASURED_HZ)
        .map(|(ours, measured)| 100.0 * (ours / measured - 1.0))
        .collect()
}
