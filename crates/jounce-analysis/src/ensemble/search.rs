//! Ensemble that grows until the interval of the mean power has the requested width.
//!
//! Members are added in rounds of a fixed size. Each has its own seed, so the result is bitwise
//! identical for any number of threads.

use super::member::{BATCHES, Sampling};
use super::spectrum::VoltagePeriodograms;
use super::{DeviceEstimates, Estimate, IntervalOver, Member, StopEstimates, VoltageSpectrum};
use crate::run::{Limits, RunError, RunPlan, StartState};
use crate::{AnalysisError, Model};
use jounce_dynamics::IntegrationError;
use jounce_signal::{Samples, Window};
use jounce_spec::DriveSignal;
use rayon::prelude::*;

/// Definition of an ensemble.
#[derive(Debug)]
pub struct Ensemble<'s> {
    /// The harvester, with at least one drive of noise.
    pub base: &'s Model,
    /// Start state of every member.
    pub start: StartState,
    /// Members of a round; the total number of members where no width is requested.
    pub members: usize,
    /// Seed of the realisations.
    pub seed: u64,
    /// Requested relative half width of the interval of the mean power.
    pub relative_width: Option<f64>,
    /// Largest number of rounds.
    pub most_rounds: usize,
    /// True: sample the voltages for their spectral densities, which takes time.
    pub with_spectrum: bool,
}

/// Samples per cycle of the highest relevant frequency.
const SAMPLES_PER_CYCLE: f64 = 2.56;

/// Density of each voltage of a member, V^2/Hz.
type Densities = Vec<Vec<f64>>;

/// Result of an ensemble.
#[derive(Debug, Clone, PartialEq)]
pub struct EnsembleResult {
    /// Every member, by index.
    pub members: Vec<Member>,
    /// Mean power of all loads, W.
    pub power_w: Estimate,
    /// Contacts per second, Hz, over the members.
    pub contact_rate_hz: Estimate,
    /// Mean impact velocity over all contacts, m/s.
    pub mean_impact_velocity_m_s: f64,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean duration over all contacts, s.
    pub mean_contact_duration_s: f64,
    /// Estimates of each stop.
    pub stops: Vec<StopEstimates>,
    /// Estimates of each device behind a regulator.
    pub devices: Vec<DeviceEstimates>,
    /// Spectrum of each patch; empty where not requested.
    pub spectra: Vec<VoltageSpectrum>,
    /// True when the requested width was reached, or no width was requested; false after
    /// cancellation.
    pub reached: bool,
}

impl Ensemble<'_> {
    /// Number of members where not given.
    pub const DEFAULT_MEMBERS: usize = 16;

    /// Integrates the members. After cancellation the result covers the finished members, possibly
    /// zero.
    ///
    /// # Errors
    /// [`AnalysisError::NoNoise`], or the first integration that failed.
    pub fn run(&self) -> Result<EnsembleResult, AnalysisError> {
        let control = &self.base.kernel.control;
        let mut members: Vec<Member> = Vec::new();
        let mut spectra = vec![
            VoltagePeriodograms::default();
            if self.with_spectrum {
                self.base.kernel.plant.system.modes.patch.len()
            } else {
                0
            }
        ];
        loop {
            let first = members.len();
            control.expect(self.members);
            let round: Result<Vec<Option<(Member, Densities)>>, AnalysisError> = (first
                ..first + self.members)
                .into_par_iter()
                .map(|index| self.member(index))
                .collect();
            for (member, densities) in round?.into_iter().flatten() {
                members.push(member);
                spectra
                    .iter_mut()
                    .zip(densities)
                    .for_each(|(sums, density)| sums.add(&density));
            }
            let result = self.result(&members);
            let reached = result.reached && !control.is_stopped();
            if reached || members.len() >= self.members * self.most_rounds || control.is_stopped() {
                let names = self.base.kernel.plant.system.modes.patch.keys().cloned();
                let resolution_hz = 1.0 / self.base.spec.run.average_over_s;
                let spectra = spectra
                    .iter()
                    .zip(names)
                    .map(|(sums, name)| sums.to_spectrum(name, resolution_hz))
                    .collect();
                return Ok(EnsembleResult {
                    members,
                    spectra,
                    reached,
                    ..result
                });
            }
        }
    }

    /// Returns a member, with the density of each voltage where requested; `None` for one that was
    /// cancelled.
    fn member(&self, index: usize) -> Result<Option<(Member, Densities)>, AnalysisError> {
        // Generating a realisation takes as long as many steps, so after cancellation the remaining
        // ones are not generated.
        if self.base.kernel.control.is_stopped() {
            return Ok(None);
        }
        let kernel = self.base.realised(self.seed, index as u64)?;
        let run = &self.base.spec.run;
        let (plan, limits) = (
            RunPlan::of(run, 0.0),
            Limits::of(&self.base.spec, &kernel.plant),
        );
        let per_batch = self.samples_per_batch();
        let voltages_v =
            vec![Vec::with_capacity(per_batch * BATCHES); kernel.plant.system.modes.patch.len()];
        let mut sampling = self.with_spectrum.then_some(Sampling {
            per_batch,
            voltages_v,
        });
        let member = match Member::integrate(
            &kernel,
            &limits,
            &self.start,
            &plan,
            index,
            sampling.as_mut(),
        ) {
            Err(IntegrationError::Stopped { .. }) => return Ok(None),
            result => result.map_err(RunError::from)?,
        };
        kernel.control.count();
        let rate_hz = (per_batch * BATCHES) as f64 / run.average_over_s;
        let density = |values: &Vec<f64>| {
            Samples::new(values, rate_hz).map(|samples| samples.density(Window::Hann))
        };
        let voltages = sampling
            .map(|sampling| sampling.voltages_v)
            .unwrap_or_default();
        let densities = voltages.iter().map(density).collect::<Result<Vec<_>, _>>();
        let not_finite = |_| {
            RunError::from(IntegrationError::NotFinite {
                time_s: run.duration_s,
            })
        };
        Ok(Some((member, densities.map_err(not_finite)?)))
    }

    /// Number of samples sufficient for the noise and for every mode.
    fn samples_per_batch(&self) -> usize {
        let highs = self
            .base
            .spec
            .drive
            .values()
            .filter_map(|drive| match drive.signal {
                DriveSignal::Noise { high_hz, .. } => Some(high_hz),
                _ => None,
            });
        let modes = self
            .base
            .kernel
            .plant
            .system
            .modes
            .frequency_rad_s
            .iter()
            .map(|w| w / std::f64::consts::TAU);
        let highest_hz = highs.chain(modes).fold(0.0_f64, f64::max);
        (SAMPLES_PER_CYCLE * highest_hz * self.base.spec.run.average_over_s / BATCHES as f64)
            .ceil()
            .max(16.0) as usize
    }

    fn result(&self, members: &[Member]) -> EnsembleResult {
        let power_w = Estimate::of_power(members);
        let contacts = members
            .iter()
            .map(|member| member.contacts)
            .sum::<u64>()
            .max(1) as f64;
        let over_contacts = |value: fn(&Member) -> f64| {
            members
                .iter()
                .map(|m| m.contacts as f64 * value(m))
                .sum::<f64>()
                / contacts
        };
        let rates: Vec<f64> = members
            .iter()
            .map(|member| member.contact_rate_hz)
            .collect();
        let batch_s = self.base.spec.run.average_over_s / BATCHES as f64;
        let stops = self.base.kernel.plant.system.stops.iter().enumerate();
        EnsembleResult {
            stops: stops
                .map(|(index, stop)| StopEstimates::of(&stop.name, members, index, batch_s))
                .collect(),
            devices: DeviceEstimates::of_all(&self.base.kernel.plant, members, batch_s),
            spectra: Vec::new(),
            members: Vec::new(),
            contact_rate_hz: Estimate::of(&rates, IntervalOver::Members),
            mean_impact_velocity_m_s: over_contacts(|member| member.mean_impact_velocity_m_s),
            max_impact_velocity_m_s: members
                .iter()
                .fold(0.0, |max, member| max.max(member.max_impact_velocity_m_s)),
            mean_contact_duration_s: over_contacts(|member| member.mean_contact_duration_s),
            reached: self
                .relative_width
                .is_none_or(|width| power_w.relative_width() <= width),
            power_w,
        }
    }
}
