//! Attractors at the operating point of a design, with the peaks and warnings of their orbits.

use super::limits;
use super::motion;
use super::orbit::TOLERANCE;
use crate::basins::{AttractorResult, BasinsOptions, BasinsResult};
use crate::error::Error;
use crate::live::analysis::Shapes;
use crate::live::{Design, LiveAnalysis};
use jounce_analysis::run::{ExceededLimit, Warning};
use jounce_analysis::{KeyLine, Model};
use jounce_control::Control;
use jounce_orbits::{OrbitQuantity, ParametricModel, Shooting, ShootingEvaluation};
use serde::Serialize;

/// Attractors at the operating point of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct OperatingPoint {
    /// Attractors with their basin fractions.
    pub basins: BasinsResult,
    /// Peaks and warnings of each attractor, in the order of the attractors.
    pub peaks: Vec<AttractorPeaks>,
    /// Number of stops.
    pub stops: usize,
}

/// Peaks of an attractor over its period, and its warnings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorPeaks {
    /// Largest strain of any patch; `None` for an aperiodic attractor, and for a structure given by
    /// its modes.
    pub strain_peak: Option<f64>,
    /// Largest voltage of any patch, V; `None` for an aperiodic attractor, and without a patch.
    pub voltage_peak_v: Option<f64>,
    /// Each limit of a patch with the value that exceeds it most or is nearest to it.
    pub limits: Vec<ExceededLimit>,
    /// Exceeded limits of patches, and deflections too large for a linear beam.
    pub warnings: Vec<String>,
}

impl LiveAnalysis {
    /// Finds the attractors of a design as [`crate::Harvester::basins`], and integrates the period
    /// of each orbit for its peaks and warnings.
    ///
    /// # Errors
    /// As [`crate::Harvester::basins`].
    pub fn operating_point(
        &self,
        design: &Design,
        options: &BasinsOptions,
        control: &Control,
    ) -> Result<OperatingPoint, Error> {
        let harvester = design.harvester().with_control(control);
        let basins = harvester.basins(options)?;
        let base = harvester.model()?;
        let shapes = self.shapes(design.spec())?;
        let peaks = |own: &AttractorResult| AttractorPeaks::of(own, &base, &shapes);
        Ok(OperatingPoint {
            peaks: basins.attractors.iter().map(peaks).collect(),
            stops: base.kernel.plant.system.stops.len(),
            basins,
        })
    }
}

impl AttractorPeaks {
    /// Returns the peaks of an attractor. One without an orbit, or whose orbit cannot be
    /// integrated, has only the warnings of its basin.
    fn of(attractor: &AttractorResult, base: &Model, shapes: &Shapes) -> Self {
        let period = period(attractor, base);
        let over_period = period.map(|period| Self::over_period(&period, base, shapes));
        over_period.unwrap_or_else(|| {
            let found = attractor.warnings.iter().cloned().map(Warning::Limit);
            Self {
                strain_peak: None,
                voltage_peak_v: None,
                limits: Vec::new(),
                warnings: found.map(|warning| warning.to_string()).collect(),
            }
        })
    }

    fn over_period(period: &ShootingEvaluation, base: &Model, shapes: &Shapes) -> Self {
        let patches = &period.kernel.plant.system.modes.patch;
        let peak = |quantity: fn(usize) -> OrbitQuantity| {
            let peaks = (0..patches.len()).map(|patch| quantity(patch).of(period));
            peaks.max_by(f64::total_cmp)
        };
        let has_strain = patches.values().any(|patch| !patch.strain.is_empty());
        let limits = limits::reached(&base.spec, period);
        let motion = motion::of_bodies(period, shapes);
        Self {
            strain_peak: peak(OrbitQuantity::Strain).filter(|_| has_strain),
            voltage_peak_v: peak(OrbitQuantity::Voltage),
            warnings: limits::warnings(&limits, &motion.beams),
            limits,
        }
    }
}

/// Integrates the period of the orbit of an attractor; `None` without an orbit, or where the
/// integration fails.
fn period(attractor: &AttractorResult, base: &Model) -> Option<ShootingEvaluation> {
    let orbit = attractor.orbit.as_ref()?;
    let line = KeyLine::at(base);
    let kernel = line.at(0.0).ok()?.kernel;
    let shooting = Shooting::new(&line, &base.kernel, orbit.period_cycles, TOLERANCE);
    shooting.integrated(kernel, orbit.start()).ok()
}
