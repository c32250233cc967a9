//! Orbit of a point of a response, sampled over its period.

use super::force_curve::ForceCurves;
use super::limits;
use super::motion::{self, BeamMotion, Motion, PlateMotion};
use super::orbit_stop::OrbitStop;
use crate::error::Error;
use crate::live::LiveAnalysis;
use crate::live::responses::StoredResponse;
use jounce_analysis::run::ExceededLimit;
use jounce_analysis::{BranchPoint, Parameter};
use jounce_continuation::{CorrectedPoint, Corrector, Metric, Position, Problem, correct_at};
use jounce_control::Control;
use jounce_dynamics::TrajectoryState;
use jounce_model::plant::Stop;
use jounce_orbits::{Orbit, OrbitMethod, Shooting, ShootingEvaluation};
use jounce_signal::{Samples, Window};
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
/// Goal of Newton's method and its largest number of iterations.
const CORRECTOR: Corrector = Corrector {
    goal: 50.0 * TOLERANCE,
    most: 10,
};

/// Point of a stored response.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct BranchPlace {
    /// Number of the response.
    pub response: u64,
    /// Number of the branch in the response, from 0.
    pub branch: usize,
    /// Number of the point on the branch, from 0.
    pub point: usize,
    /// Value of the key near the point at which the orbit is computed, SI; by default the value at
    /// the point.
    #[serde(default)]
    pub parameter: Option<f64>,
}

/// A periodic orbit, sampled over its period.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OrbitResult {
    /// The key of the response.
    pub over: String,
    /// Its SI unit.
    pub unit: String,
    /// Its value, SI.
    pub parameter: f64,
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
    /// Largest modulus of a Floquet multiplier.
    pub floquet_max_abs: f64,
    /// Estimated relative error of state and mean power.
    pub error_estimate: f64,
    /// Floquet multipliers, real and imaginary part.
    pub multipliers: Vec<(f64, f64)>,
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
    /// Each limit of a patch with the value that exceeds it most or is nearest to it.
    pub limits: Vec<ExceededLimit>,
    /// Exceeded limits of patches, and deflections too large for a linear beam.
    pub warnings: Vec<String>,
}

impl LiveAnalysis {
    /// Computes the orbit of a point of a stored response, and samples it over its period.
    ///
    /// # Errors
    /// [`Error::Option`] for a response that is no longer stored or has no such point,
    /// [`Error::Continuation`] and [`Error::Orbit`] where the orbit cannot be computed.
    pub fn orbit(&self, place: &BranchPlace, control: &Control) -> Result<OrbitResult, Error> {
        let response = self.stored_response(place.response)?;
        let (cycles, point) = point_at(&response, place)?;
        let base = self.model(&response.spec, control)?;
        let parameter = response.parameter(&base);
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, TOLERANCE);
        let (orbit, solution) = match bifurcation_at(&response, place) {
            Some(own) => own_orbit(&shooting, own)?,
            None => corrected(&shooting, point, place.parameter.unwrap_or(point.parameter))?,
        };
        let shapes = self.shapes(&response.spec)?;
        let motion = motion::of_bodies(&solution.local, &shapes);
        let limits = limits::reached(&response.spec, &solution.local);
        let sampled = sampled(&response, &orbit, &solution, motion)?;
        let warnings = limits::warnings(&limits, &sampled.beams);
        Ok(OrbitResult {
            limits,
            warnings,
            ..sampled
        })
    }
}

/// Returns the period of a branch in drive cycles and a point of it.
pub(in crate::live) fn point_at<'r>(
    response: &'r StoredResponse,
    place: &BranchPlace,
) -> Result<(u32, &'r BranchPoint), Error> {
    let branch = response.branches.get(place.branch);
    let found = branch.and_then(|own| Some((own.period_cycles, own.points.get(place.point)?)));
    found.ok_or_else(|| {
        Error::option(
            "point",
            format!("{} of branch {}", place.point, place.branch),
            "this response has no such point; choose a point of its curves",
        )
    })
}

/// Orbit with its motion.
type Solution = (Orbit, CorrectedPoint<ShootingEvaluation>);

/// Returns the orbit at a value of the key from a point near it.
fn corrected(
    shooting: &Shooting<'_, Parameter<'_>>,
    point: &BranchPoint,
    parameter: f64,
) -> Result<Solution, Error> {
    let position = Position {
        unknown: point.orbit.start().to_vec(),
        parameter,
    };
    let metric = Metric::at(&position, 1.0);
    let solution = correct_at(shooting, &CORRECTOR, &metric, position)?;
    Ok((shooting.orbit(&solution.local, solution.error)?, solution))
}

/// Returns the orbit of a bifurcation as it was located. At a fixed value of the key Newton's method
/// finds no orbit at a fold.
fn own_orbit(
    shooting: &Shooting<'_, Parameter<'_>>,
    bifurcation: &BranchPoint,
) -> Result<Solution, Error> {
    let (orbit, parameter) = (bifurcation.orbit.clone(), bifurcation.parameter);
    let position = Position {
        unknown: orbit.start().to_vec(),
        parameter,
    };
    let local = shooting.at(orbit.start(), parameter)?;
    let error = orbit.error_estimate;
    let solution = CorrectedPoint {
        position,
        local,
        error,
        evaluations: 1,
    };
    Ok((orbit, solution))
}

/// Returns the bifurcation of the branch at the requested value of the key.
fn bifurcation_at<'r>(
    response: &'r StoredResponse,
    place: &BranchPlace,
) -> Option<&'r BranchPoint> {
    let parameter = place.parameter?;
    let mut all = response.branches.get(place.branch)?.bifurcations.iter();
    all.find(|own| own.at.parameter == parameter)
        .map(|own| &own.at)
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
    response: &StoredResponse,
    orbit: &Orbit,
    solution: &CorrectedPoint<ShootingEvaluation>,
    motion: Motion,
) -> Result<OrbitResult, Error> {
    let (evaluation, parameter) = (&solution.local, solution.position.parameter);
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
        OrbitStop::new(&response.spec, stop, &states, force_n.collect())
    };
    Ok(OrbitResult {
        over: response.key.path().to_owned(),
        unit: response.key.unit(),
        parameter,
        period_cycles: orbit.period_cycles,
        period_s: evaluation.period_s,
        mean_power_w: orbit.mean_power_w,
        voltage_rms_v: orbit.voltage_rms_v,
        contacts: orbit.contacts,
        max_penetration_m: orbit.max_penetration_m,
        stable: orbit.is_stable(),
        floquet_max_abs: orbit.floquet_max_abs(),
        error_estimate: orbit.error_estimate,
        multipliers: orbit
            .multipliers
            .iter()
            .map(|own| (own.re, own.im))
            .collect(),
        time_s: (0..instants.len()).map(|k| step_s * k as f64).collect(),
        voltage_v,
        spectrum_frequency_hz,
        spectrum_amplitude_peak_v,
        stops: plant.system.stops.iter().enumerate().map(stop).collect(),
        forces: ForceCurves::of(evaluation, samples_per_cycle),
        frames: motion.frames,
        beams: motion.beams,
        plates: motion.plates,
        limits: Vec::new(),
        warnings: Vec::new(),
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
