//! Response to the drives of a design, or to noise or a recording in place of the first one.

use super::time_history::{self, Extremes, SpectralDensity};
use super::{Design, LiveAnalysis};
use crate::error::Error;
use jounce_analysis::run::{RunPlan, Warning, output_peaks, simulate};
use jounce_control::Control;
use jounce_model::linear::Random;
use jounce_spec::{DriveSignal, Spec, SpecFile};
use serde::Serialize;
use std::path::PathBuf;

/// Length of a run under noise, s.
const NOISE_S: f64 = 60.0;
/// Fraction of the run under noise that is averaged.
const AVERAGED_SHARE: f64 = 0.75;
/// Longest recording, s.
const MAX_DURATION_S: f64 = 3600.0;
/// Relative tolerance of the integration.
const TOLERANCE: f64 = 1e-6;

/// Drives of a design, or an excitation in place of the first one.
#[derive(Debug, Clone, PartialEq)]
pub enum Excitation {
    /// Drives of the design, over the run of its spec.
    OfSpec,
    /// Noise of a flat one-sided spectral density.
    Noise {
        /// Spectral density, in the square of the unit of the drive per Hz.
        density: f64,
        /// Lower end of the band, Hz.
        low_hz: f64,
        /// Upper end of the band, Hz.
        high_hz: f64,
    },
    /// A recording with one channel.
    Recording {
        /// File with times and values.
        file: PathBuf,
        /// Value of 1 (SI) of the file in the SI unit of the drive.
        scale: f64,
    },
}

/// Response to an excitation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExcitationResult {
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Mean power without contact under noise, W; `None` without noise, and for a harvester without
    /// a linear response.
    pub linear_power_w: Option<f64>,
    /// Contacts that began in the averaging window.
    pub contacts: u64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// Length of the run, s.
    pub duration_s: f64,
    /// Length of the averaging window at its end, s.
    pub average_over_s: f64,
    /// Voltage of the first patch, V.
    pub voltage: Extremes,
    /// Displacement towards the first stop, m; `None` without a stop.
    pub displacement: Option<Extremes>,
    /// Gap of the first stop, m.
    pub gap_m: Option<f64>,
    /// Spectral density of the voltage, V^2/Hz; `None` for a run that is too short.
    pub density: Option<SpectralDensity>,
    /// Warnings, as those of [`crate::Harvester::run`].
    pub warnings: Vec<Warning>,
}

impl LiveAnalysis {
    /// Integrates from the start of the spec: over the run of the spec, over a recording, or over a
    /// minute of noise.
    ///
    /// # Errors
    /// [`Error::NoDrive`] without a drive to replace, [`Error::Spec`] for noise or a recording that
    /// the spec does not allow, [`Error::Option`] for a recording that is too long,
    /// [`Error::Analysis`] for an integration that does not converge.
    pub fn excite(
        &self,
        design: &Design,
        excitation: &Excitation,
        control: &Control,
    ) -> Result<ExcitationResult, Error> {
        let mut spec = excitation.in_place_of_drive(design)?;
        let (duration_s, average_over_s, tolerance) = excitation.times(&spec);
        if duration_s > MAX_DURATION_S {
            let expected = format!("give one of at most {MAX_DURATION_S:.0} s");
            let value = format!("{duration_s:.0} s long");
            return Err(Error::option("recording", value, expected));
        }
        // The realisation of noise has the length of the run.
        (spec.run.duration_s, spec.run.average_over_s) = (duration_s, average_over_s);
        let base = self.model(&spec, control)?;
        let start = base.start(design.harvester().folder())?;
        let kernel = base.from_state(&start)?;
        let plan = RunPlan {
            duration_s,
            average_over_s,
            tolerance,
            record_s: duration_s,
        };
        control.expect_run(duration_s);
        let result = simulate(&kernel, &start, &plan)?;
        let linear = || Random::new(&spec).and_then(|random| random.response());
        let linear_power_w = match excitation {
            Excitation::Recording { .. } => None,
            Excitation::Noise { .. } | Excitation::OfSpec => {
                linear().ok().map(|response| response.mean_power_w)
            }
        };
        let histories = time_history::of_run(&kernel, &result, duration_s)?;
        let mut warnings = Warning::of(&spec, &kernel, &plan, &result);
        let peaks = output_peaks(&kernel, &result);
        warnings.extend(Warning::of_deflections(&spec, &kernel.plant, &peaks));
        Ok(ExcitationResult {
            mean_power_w: result.mean_power_w,
            linear_power_w,
            contacts: result.contacts,
            max_penetration_m: result.max_penetration_m,
            duration_s,
            average_over_s,
            voltage: histories.voltage,
            displacement: histories.displacement,
            gap_m: kernel.plant.system.stops.first().map(|stop| stop.gap_m),
            density: histories.density,
            warnings,
        })
    }
}

impl Excitation {
    /// Returns the spec of a design with this excitation in place of its first drive, after the
    /// same checks as any spec.
    fn in_place_of_drive(&self, design: &Design) -> Result<Spec, Error> {
        let mut spec = design.spec().clone();
        let Some(signal) = self.signal() else {
            return Ok(spec);
        };
        let drive = spec.drive.values_mut().next();
        let what = "noise or a recording";
        drive.ok_or(Error::NoDrive { what })?.signal = signal;
        let file = SpecFile::from_text(spec.to_toml());
        Ok(file.in_folder(design.harvester().folder()).spec()?)
    }

    /// Returns duration, averaging window, s, and tolerance of a run.
    fn times(&self, spec: &Spec) -> (f64, f64, f64) {
        match (self, recorded_s(spec)) {
            (Self::OfSpec, _) => {
                let run = &spec.run;
                (run.duration_s, run.average_over_s, run.tolerance)
            }
            (_, Some(recorded_s)) => (recorded_s, recorded_s, TOLERANCE),
            (_, None) => (NOISE_S, AVERAGED_SHARE * NOISE_S, TOLERANCE),
        }
    }

    /// Returns the signal in place of the first drive; `None` for the drives of the spec.
    fn signal(&self) -> Option<DriveSignal> {
        Some(match self {
            Self::OfSpec => return None,
            &Self::Noise {
                density,
                low_hz,
                high_hz,
            } => DriveSignal::Noise {
                density,
                low_hz,
                high_hz,
                sample_rate_hz: None,
                seed: 1,
            },
            Self::Recording { file, scale } => {
                let mut signal = DriveSignal::recording(&file.display().to_string());
                if let DriveSignal::Recording {
                    scale: factor,
                    keep_mean,
                    ..
                } = &mut signal
                {
                    (*factor, *keep_mean) = (*scale, Some(true));
                }
                signal
            }
        })
    }
}

/// Returns the length of the first recording among the drives, s.
fn recorded_s(spec: &Spec) -> Option<f64> {
    spec.drive.values().find_map(|drive| match &drive.signal {
        DriveSignal::Recording {
            record: Some(record),
            ..
        } => Some(record.duration_s()),
        _ => None,
    })
}
