//! Mass of a connected structure in strain coordinates.

use super::placement::BodyPart;
use super::{Assembly, Row};
use crate::structure::error::StructureError;
use jounce_linalg::Mat;

impl Assembly<'_> {
    /// Returns the mass factor `G`.
    ///
    /// # Errors
    /// `NotRepresentable` if an entry is not finite.
    pub fn mass_factor(&self) -> Result<Mat<f64>, StructureError> {
        let rows = self.parts.iter().map(BodyPart::mass_rows).sum::<usize>();
        let mut factor = Mat::zeros(rows, self.columns);
        let mut row = 0;
        for body_part in &self.parts {
            body_part.add_mass(&mut factor, row);
            row += body_part.mass_rows();
        }
        if factor.iter().all(|entry| entry.is_finite()) {
            Ok(factor)
        } else {
            Err(StructureError::NotRepresentable {
                body: self.body.name().into(),
            })
        }
    }

    /// Returns the mass that moves with each strain coordinate under a unit translation of the
    /// structure: `G^T g`, with `g` the translation in the rows of `G`. Its product with a
    /// mass-normalised mode is the participation of the mode in a uniform acceleration of the base.
    ///
    /// # Errors
    /// As [`Assembly::mass_factor`].
    pub fn translated_mass(&self) -> Result<Row, StructureError> {
        let factor = self.mass_factor()?;
        let translation: Vec<f64> = self.parts.iter().flat_map(BodyPart::translation).collect();
        Ok(factor
            .column_iter()
            .map(|column| {
                column
                    .iter()
                    .zip(&translation)
                    .map(|(entry, unit)| entry * unit)
                    .sum()
            })
            .collect())
    }
}
