//! Figures of the mode shapes of a design.

use super::Design;
use crate::error::Error;
use crate::modes::ModesOptions;
use serde::Serialize;

/// Figure of the first mode shapes along one beam or over one plate.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ModeFigure {
    /// Name of the figure: `modes-NAME`, as the file of `jounce modes --out`.
    pub name: String,
    /// The figure, SVG.
    pub svg: String,
}

impl Design {
    /// Draws the first mode shapes along each beam, and over each plate as filled contours with
    /// nodal lines. A structure given by its modes has no figure.
    ///
    /// # Errors
    /// As [`crate::Harvester::modes`], [`Error::Picture`].
    ///
    /// ```
    /// use jounce::{Harvester, live::Design};
    /// # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).unwrap();
    /// let harvester = Harvester::read("examples/plate-de-marqui-2009/harvester.toml")?;
    /// let figures = Design::new(&harvester, &[])?.mode_figures()?;
    /// assert_eq!(figures[0].name, "modes-plate");
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn mode_figures(&self) -> Result<Vec<ModeFigure>, Error> {
        let modes = self.harvester().modes(&ModesOptions::default())?;
        let figures = modes.figures().into_iter().map(|(name, figure)| {
            let svg = figure.to_svg()?;
            Ok(ModeFigure { name, svg })
        });
        figures.collect()
    }
}
