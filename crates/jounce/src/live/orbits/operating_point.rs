//! Attractors at the operating point of a design, with the peaks and warnings of their orbits.

use super::attractor_place::period;
use super::limits::{self, ReachedLimit};
use super::motion;
use crate::basins::{AttractorResult, BasinsOptions, BasinsResult};
use crate::error::Error;
use crate::live::analysis::Shapes;
use crate::live::{Design, LiveAnalysis};
use jounce_analysis::{BasinFraction, Model, wilson};
use jounce_control::Control;
use jounce_orbits::{Orbit, OrbitQuantity, ShootingEvaluation};
use serde::Serialize;

/// Attractors at the operating point of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct OperatingPoint {
    /// Attractors with their basin fractions.
    pub basins: BasinsResult,
    /// Peaks and warnings of each attractor, in the order of the attractors.
    pub peaks: Vec<AttractorPeaks>,
    /// Share of the starts by the limits of the patches.
    pub limit_shares: LimitShares,
    /// Number of stops.
    pub stops: usize,
}

/// Shares of the starts whose settled motion keeps all limits of the patches, exceeds one, or is
/// not known well enough.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LimitShares {
    /// Starts that reach an orbit within all limits.
    pub within: BasinFraction,
    /// Starts that reach an attractor beyond a limit.
    pub beyond: BasinFraction,
    /// Starts that failed, or reach an attractor without known peaks.
    pub unknown: BasinFraction,
}

/// Peaks of an attractor over its period, and its warnings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorPeaks {
    /// Largest strain of any patch; `None` for an aperiodic attractor, and for a structure given by
    /// its modes.
    pub strain_peak: Option<f64>,
    /// Largest voltage of any patch, V; `None` for an aperiodic attractor, and without a patch.
    pub voltage_peak_v: Option<f64>,
    /// Largest impact velocity at any stop, m/s, 0 without a contact; `None` for an aperiodic attractor.
    pub max_impact_velocity_m_s: Option<f64>,
    /// Each limit of a patch with the value that exceeds it most or is nearest to it; only exceeded
    /// ones of an aperiodic attractor.
    pub limits: Vec<ReachedLimit>,
    /// Deflections too large for a linear beam.
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
        let peaks: Vec<AttractorPeaks> = basins.attractors.iter().map(peaks).collect();
        Ok(OperatingPoint {
            limit_shares: LimitShares::of(&basins, &peaks),
            peaks,
            stops: base.kernel.plant.system.stops.len(),
            basins,
        })
    }
}

impl LimitShares {
    fn of(basins: &BasinsResult, peaks: &[AttractorPeaks]) -> Self {
        let (mut within, mut beyond) = (0, 0);
        for number in basins.points.iter().filter_map(|start| start.attractor) {
            let own = &peaks[number];
            let is_beyond = own.limits.iter().any(|own| own.excess > 0.0);
            match own.max_impact_velocity_m_s {
                _ if is_beyond => beyond += 1,
                Some(_) => within += 1,
                None => {}
            }
        }
        let share = |count| wilson(count, basins.finished);
        Self {
            within: share(within),
            beyond: share(beyond),
            unknown: share(basins.finished - within - beyond),
        }
    }
}

impl AttractorPeaks {
    /// Returns the peaks of an attractor. One without an orbit, or whose orbit cannot be
    /// integrated, has only the limits that its basin exceeds.
    fn of(attractor: &AttractorResult, base: &Model, shapes: &Shapes) -> Self {
        let orbit = attractor.attracting.as_ref().map(|own| &own.orbit);
        let period = orbit.and_then(|orbit| Some((orbit, period(orbit, base).ok()?)));
        let over_period =
            period.map(|(orbit, period)| Self::over_period(&period, orbit, base, shapes));
        over_period.unwrap_or_else(|| Self {
            strain_peak: None,
            voltage_peak_v: None,
            max_impact_velocity_m_s: None,
            limits: attractor.warnings.iter().map(ReachedLimit::of).collect(),
            warnings: Vec::new(),
        })
    }

    fn over_period(
        period: &ShootingEvaluation,
        orbit: &Orbit,
        base: &Model,
        shapes: &Shapes,
    ) -> Self {
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
            max_impact_velocity_m_s: Some(orbit.max_impact_velocity_m_s),
            warnings: limits::large_deflections(&motion.beams),
            limits: limits.iter().map(ReachedLimit::of).collect(),
        }
    }
}
