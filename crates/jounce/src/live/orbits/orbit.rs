//! Orbit of a point of a response or of an attractor, sampled over its period.

use super::attractor_place::AttractorPlace;
use super::branch_place::BranchPlace;
use super::force_curve::ForceCurves;
use super::limits;
use super::motion::{self, BeamMotion, Motion, PlateMotion};
use super::orbit_stop::OrbitStop;
use super::stability;
use crate::error::Error;
use crate::live::LiveAnalysis;
use jounce_analysis::run::ExceededLimit;
use jounce_analysis::{BranchKind, SectionPoint};
use jounce_control::Control;
use jounce_dynamics::TrajectoryState;
use jounce_model::plant::Stop;
use jounce_orbits::{Orbit, ShootingEvaluation};
use jounce_signal::{Samples, Window};
use jounce_spec::Spec;
use serde::{Deserialize, Serialize};

/// Largest number of samples per drive cycle.
const SAMPLES_PER_CYCLE: usize = 480;
/// Largest number of samples of a period, except for the smallest number per drive cycle.
const MAX_SAMPLES: usize = 1920;
/// Smallest number of samples per drive cycle.
const MIN_SAMPLES_PER_CYCLE: usize = 60;
/// Largest frequency of the spectrum, in orders of the drive.
const MAX_SPECTRUM_ORDER: f64 = 12.0;
/// Relative tolerance of the integration.
pub(super) const TOLERANCE: f64 = 1e-9;

/// A periodic orbit, sampled over its period.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitResult {
    /// Period, in drive cycles.
    pub period_cycles: u32,
    /// Period, s.
    pub period_s: f64,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Rms voltage of the first load, V.
    pub voltage_rms_v: f64,
    /// Contacts per period.
    pub contacts: u64,
    /// Largest penetration, m.
    pub max_penetration_m: f64,
    /// True where all Floquet multipliers lie inside the unit circle.
    pub stable: bool,
    /// Kind of the bifurcation of the response whose orbit this is.
    pub bifurcation: Option<&'static str>,
    /// True where the orbit is neither stable nor unstable: only critical multipliers have modulus one.
    pub is_at_stability_limit: bool,
    /// Largest modulus of a Floquet multiplier.
    pub floquet_max_abs: f64,
    /// Estimated relative error of state and mean power.
    pub error_estimate: f64,
    /// Floquet multipliers, real and imaginary part.
    pub multipliers: Vec<(f64, f64)>,
    /// Motion at the start of the period.
    pub section: SectionPoint,
    /// Times of the samples, s.
    pub time_s: Vec<f64>,
    /// Voltage of the first patch, V.
    pub voltage_v: Vec<f64>,
    /// Frequencies of its spectrum, Hz.
    pub spectrum_frequency_hz: Vec<f64>,
    /// Peak amplitudes of its spectrum, V.
    pub spectrum_amplitude_peak_v: Vec<f64>,
    /// Each stop.
    pub stops: Vec<OrbitStop>,
    /// Contact forces with samples in every contact.
    pub forces: ForceCurves,
    /// Number of frames of the motion of the beams.
    pub frames: usize,
    /// Each beam.
    pub beams: Vec<BeamMotion>,
    /// Each plate.
    pub plates: Vec<PlateMotion>,
    /// Stored attractors of the same design whose orbit this is.
    pub attractors: Vec<AttractorPlace>,
    /// Each limit of a patch with the value that exceeds it most or is nearest to it.
    pub limits: Vec<ExceededLimit>,
    /// Exceeded limits of patches, and deflections too large for a linear beam.
    pub warnings: Vec<String>,
}

/// An orbit that the page shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum OrbitPlace {
    /// That of a point of a response.
    Branch(BranchPlace),
    /// That of an attractor.
    Attractor(AttractorPlace),
}

/// An orbit with its design and its motion over the period.
pub(super) struct ShownOrbit {
    pub spec: Spec,
    /// Kind of the bifurcation of the response whose orbit this is.
    pub bifurcation: Option<BranchKind>,
    pub orbit: Orbit,
    pub motion: ShootingEvaluation,
}

impl LiveAnalysis {
    /// Computes the orbit of a point of a stored response, or that of a stored attractor, and
    /// samples it over its period.
    ///
    /// # Errors
    /// [`Error::Option`] for a response or attractors that are no longer stored or have no such
    /// point or orbit, [`Error::Continuation`] and [`Error::Orbit`] where the orbit cannot be
    /// computed.
    pub fn orbit(&self, place: &OrbitPlace, control: &Control) -> Result<OrbitResult, Error> {
        let shown = match place {
            OrbitPlace::Branch(place) => self.branch_orbit(place, control)?,
            OrbitPlace::Attractor(place) => self.attractor_orbit(place, control)?,
        };
        let shapes = self.shapes(&shown.spec)?;
        let bodies = motion::of_bodies(&shown.motion, &shapes);
        let limits = limits::reached(&shown.spec, &shown.motion);
        sampled(&shown, bodies, limits, self.attractors_of(&shown))
    }
}

/// Returns the states at so many equally spaced times of the period.
pub(super) fn sample_states(
    evaluation: &ShootingEvaluation,
    samples: usize,
) -> Vec<TrajectoryState> {
    let cycle_s = evaluation.cycle_s();
    let samples_per_cycle = samples / evaluation.trajectories.len();
    let times: Vec<f64> = (0..samples_per_cycle)
        .map(|k| cycle_s * k as f64 / samples_per_cycle as f64)
        .collect();
    evaluation
        .trajectories
        .iter()
        .flat_map(|trajectory| trajectory.at(&evaluation.kernel, &times))
        .collect()
}

fn sampled(
    shown: &ShownOrbit,
    bodies: Motion,
    limits: Vec<ExceededLimit>,
    attractors: Vec<AttractorPlace>,
) -> Result<OrbitResult, Error> {
    let (orbit, evaluation) = (&shown.orbit, &shown.motion);
    let plant = &evaluation.kernel.plant;
    let cycles = evaluation.trajectories.len();
    let samples_per_cycle = SAMPLES_PER_CYCLE
        .min(MAX_SAMPLES / cycles)
        .max(MIN_SAMPLES_PER_CYCLE);
    let instants = sample_states(evaluation, samples_per_cycle * cycles);
    let states: Vec<Vec<f64>> = instants
        .iter()
        .map(|instant| plant.to_physical(&instant.state, instant.time_s))
        .collect();
    let step_s = evaluation.period_s / instants.len() as f64;
    let first_voltage = |state: &Vec<f64>| plant.patch_voltages_v(state).first().copied();
    let voltage_v: Vec<f64> = states
        .iter()
        .map(|state| first_voltage(state).unwrap_or(0.0))
        .collect();
    let max_frequency_hz = MAX_SPECTRUM_ORDER * cycles as f64 / evaluation.period_s * 1.0001;
    let (spectrum_frequency_hz, spectrum_amplitude_peak_v) =
        spectrum(&voltage_v, step_s, max_frequency_hz)?;
    let stop = |(number, stop): (usize, &Stop)| {
        let force_n = instants.iter().map(|instant| instant.forces_n[number]);
        OrbitStop::new(&shown.spec, stop, &states, force_n.collect())
    };
    Ok(OrbitResult {
        period_cycles: orbit.period_cycles,
        period_s: evaluation.period_s,
        mean_power_w: orbit.mean_power_w,
        voltage_rms_v: orbit.voltage_rms_v,
        contacts: orbit.contacts,
        max_penetration_m: orbit.max_penetration_m,
        stable: orbit.is_stable(),
        bifurcation: shown.bifurcation.map(BranchKind::name),
        is_at_stability_limit: stability::is_at_limit(orbit, shown.bifurcation),
        floquet_max_abs: orbit.floquet_max_abs(),
        error_estimate: orbit.error_estimate,
        multipliers: orbit
            .multipliers
            .iter()
            .map(|own| (own.re, own.im))
            .collect(),
        section: SectionPoint::of(&plant.system, &states[0]),
        time_s: (0..instants.len()).map(|k| step_s * k as f64).collect(),
        voltage_v,
        spectrum_frequency_hz,
        spectrum_amplitude_peak_v,
        stops: plant.system.stops.iter().enumerate().map(stop).collect(),
        forces: ForceCurves::of(evaluation, samples_per_cycle),
        warnings: limits::warnings(&limits, &bodies.beams),
        frames: bodies.frames,
        beams: bodies.beams,
        plates: bodies.plates,
        attractors,
        limits,
    })
}

/// Returns frequencies and peak amplitudes up to a frequency.
fn spectrum(
    values: &[f64],
    step_s: f64,
    max_frequency_hz: f64,
) -> Result<(Vec<f64>, Vec<f64>), Error> {
    let spectrum = Samples::new(values, 1.0 / step_s)?.spectrum(Window::Rectangular);
    let lines = spectrum
        .frequency_hz
        .into_iter()
        .zip(spectrum.amplitude_peak);
    Ok(lines
        .take_while(|(frequency_hz, _)| *frequency_hz <= max_frequency_hz)
        .unzip())
}
