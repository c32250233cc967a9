//! Result of an ensemble.

use jounce_analysis as analysis;
use jounce_analysis::run::{ExceededLimit, Warning, WorstExcess};
use jounce_analysis::{DeviceEstimates, Estimate, IntervalOver, Member, StopEstimates};
use serde::Serialize;

/// Means over realisations of noise with the half widths of their 95 % intervals; `None` for an
/// interval that cannot be estimated.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnsembleResult {
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Half width of its 95 % interval, W.
    pub mean_power_half_width_w: Option<f64>,
    /// Half width over the mean power.
    pub relative_width: Option<f64>,
    /// Values over which the intervals of the power and of the stops were computed.
    pub interval_over: IntervalOver,
    /// True where the required width was reached, or none was required, and the work was not
    /// stopped.
    pub reached: bool,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Half width of its 95 % interval, Hz.
    pub contact_rate_half_width_hz: Option<f64>,
    /// Mean impact velocity, m/s; 0 without contact.
    pub mean_impact_velocity_m_s: f64,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean duration of a contact, s; 0 without contact.
    pub mean_contact_duration_s: f64,
    /// Each stop.
    pub stops: Vec<EnsembleStop>,
    /// Each device behind a regulator.
    pub devices: Vec<EnsembleDevice>,
    /// Each patch whose voltage has a spectrum; none unless requested.
    pub patches: Vec<EnsemblePatch>,
    /// Largest energy residual of a member relative to its largest energy.
    pub energy_residual_relative: f64,
    /// Each finished member.
    pub members: Vec<Member>,
    /// Seed of the realisations.
    pub seed: u64,
    /// Warnings about the recordings of drives.
    pub warnings: Vec<Warning>,
}

/// Operation of a device behind a regulator.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnsembleDevice {
    /// Name of the circuit.
    pub name: String,
    /// Share of the time on, 0 to 1.
    pub on_fraction: f64,
    /// Half width of its 95 % interval.
    pub on_fraction_half_width: Option<f64>,
    /// Mean time to the first start over the members in which the device starts, s; `None` without
    /// such a member.
    pub cold_start_s: Option<f64>,
    /// Half width of its 95 % interval, s.
    pub cold_start_half_width_s: Option<f64>,
    /// Number of members in which the device never starts.
    pub never_started: usize,
    /// Longest time off in any member, s.
    pub longest_outage_s: f64,
    /// Completed tasks in all members.
    pub completed_tasks: u64,
    /// Interrupted tasks in all members.
    pub interrupted_tasks: u64,
    /// Mean power delivered to the device, W.
    pub mean_power_w: f64,
    /// Half width of its 95 % interval, W.
    pub mean_power_half_width_w: Option<f64>,
    /// Mean power that arrives at the storage minus the power needed to stay on, W.
    pub margin_w: f64,
    /// Half width of its 95 % interval, W.
    pub margin_half_width_w: Option<f64>,
}

/// Contacts of a stop.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnsembleStop {
    /// Name.
    pub name: String,
    /// Contacts per second, Hz.
    pub contact_rate_hz: f64,
    /// Half width of its 95 % interval, Hz.
    pub contact_rate_half_width_hz: Option<f64>,
    /// Mean impact velocity, m/s.
    pub mean_impact_velocity_m_s: f64,
    /// Half width of its 95 % interval, m/s.
    pub mean_impact_velocity_half_width_m_s: Option<f64>,
    /// Largest impact velocity, m/s.
    pub max_impact_velocity_m_s: f64,
    /// Mean duration of a contact, s.
    pub mean_contact_duration_s: f64,
    /// Half width of its 95 % interval, s.
    pub mean_contact_duration_half_width_s: Option<f64>,
    /// Longest duration of a contact, s.
    pub max_contact_duration_s: f64,
    /// Share of the time in contact.
    pub contact_duty: f64,
    /// Half width of its 95 % interval.
    pub contact_duty_half_width: Option<f64>,
    /// Largest contact force, N; 0 for impacts on a rigid stop.
    pub max_contact_force_n: f64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
}

/// Spectrum of the voltage of a patch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnsemblePatch {
    /// Name.
    pub name: String,
    /// Statistical bandwidth of the voltage, Hz.
    pub bandwidth_hz: f64,
    /// Half width of its 95 % interval over members, Hz.
    pub bandwidth_half_width_hz: Option<f64>,
    /// Power spectral density of the voltage.
    #[serde(skip)]
    pub spectrum: VoltageSpectrum,
}

/// Power spectral density of a voltage.
#[derive(Debug, Clone, PartialEq)]
pub struct VoltageSpectrum {
    /// Middle of each bin, Hz.
    pub frequency_hz: Vec<f64>,
    /// One-sided power spectral density in each bin, V^2/Hz.
    pub density_v2_hz: Vec<f64>,
    /// Half width of its 95 % interval over members, V^2/Hz.
    pub density_half_width_v2_hz: Vec<f64>,
}

impl EnsembleResult {
    pub(super) fn new(found: analysis::EnsembleResult, seed: u64, warnings: Vec<Warning>) -> Self {
        let residual = |max: f64, member: &Member| max.max(member.energy_residual_relative.abs());
        Self {
            mean_power_w: found.power_w.mean,
            mean_power_half_width_w: half_width(&found.power_w),
            relative_width: finite(found.power_w.relative_width()),
            interval_over: found.power_w.interval,
            reached: found.reached,
            contact_rate_hz: found.contact_rate_hz.mean,
            contact_rate_half_width_hz: half_width(&found.contact_rate_hz),
            mean_impact_velocity_m_s: found.mean_impact_velocity_m_s,
            max_impact_velocity_m_s: found.max_impact_velocity_m_s,
            mean_contact_duration_s: found.mean_contact_duration_s,
            stops: found.stops.into_iter().map(EnsembleStop::of).collect(),
            devices: found.devices.into_iter().map(EnsembleDevice::of).collect(),
            patches: found.spectra.into_iter().map(EnsemblePatch::of).collect(),
            energy_residual_relative: found.members.iter().fold(0.0, residual),
            members: found.members,
            seed,
            warnings,
        }
    }

    /// Returns the messages about recordings that end too early and about exceeded limits of
    /// patches in members.
    pub fn warnings(&self) -> Vec<String> {
        let exceeded: Vec<&[ExceededLimit]> = self
            .members
            .iter()
            .map(|member| member.exceeded.as_slice())
            .collect();
        let place = |number: usize| format!("member {}", self.members[number].index);
        let limits = WorstExcess::messages(&exceeded, "members", place);
        self.warnings
            .iter()
            .map(ToString::to_string)
            .chain(limits)
            .collect()
    }
}

impl EnsembleDevice {
    fn of(device: DeviceEstimates) -> Self {
        Self {
            name: device.name,
            on_fraction: device.on_fraction.mean,
            on_fraction_half_width: half_width(&device.on_fraction),
            cold_start_s: finite(device.cold_start_s.mean),
            cold_start_half_width_s: half_width(&device.cold_start_s),
            never_started: device.never_started,
            longest_outage_s: device.longest_outage_s,
            completed_tasks: device.completed_tasks,
            interrupted_tasks: device.interrupted_tasks,
            mean_power_w: device.mean_power_w.mean,
            mean_power_half_width_w: half_width(&device.mean_power_w),
            margin_w: device.margin_w.mean,
            margin_half_width_w: half_width(&device.margin_w),
        }
    }
}

impl EnsembleStop {
    fn of(stop: StopEstimates) -> Self {
        Self {
            name: stop.name,
            contact_rate_hz: stop.contact_rate_hz.mean,
            contact_rate_half_width_hz: half_width(&stop.contact_rate_hz),
            mean_impact_velocity_m_s: stop.mean_impact_velocity_m_s.mean,
            mean_impact_velocity_half_width_m_s: half_width(&stop.mean_impact_velocity_m_s),
            max_impact_velocity_m_s: stop.max_impact_velocity_m_s,
            mean_contact_duration_s: stop.mean_contact_duration_s.mean,
            mean_contact_duration_half_width_s: half_width(&stop.mean_contact_duration_s),
            max_contact_duration_s: stop.max_contact_duration_s,
            contact_duty: stop.contact_duty.mean,
            contact_duty_half_width: half_width(&stop.contact_duty),
            max_contact_force_n: stop.max_contact_force_n,
            max_penetration_m: stop.max_penetration_m,
        }
    }
}

impl EnsemblePatch {
    fn of(spectrum: analysis::VoltageSpectrum) -> Self {
        let density = |value: fn(&Estimate) -> f64| spectrum.density.iter().map(value).collect();
        Self {
            bandwidth_hz: spectrum.bandwidth_hz.mean,
            bandwidth_half_width_hz: half_width(&spectrum.bandwidth_hz),
            spectrum: VoltageSpectrum {
                density_v2_hz: density(|estimate| estimate.mean),
                density_half_width_v2_hz: density(|estimate| estimate.half_width),
                frequency_hz: spectrum.frequency_hz,
            },
            name: spectrum.patch,
        }
    }
}

fn half_width(estimate: &Estimate) -> Option<f64> {
    finite(estimate.half_width)
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
