//! Warnings of a run.

use super::{
    ExceededLimit, Limits, OutputPeaks, RunPlan, RunResult, StopResult, ineffective, model_limits,
    subject::named,
};
use jounce_data::recording::Issue;
use jounce_dynamics::Kernel;
use jounce_model::plant::Plant;
use jounce_spec::{Quantity, Spec};
use serde::{Deserialize, Serialize};

/// Samples within the mean contact below which its force is not resolved.
const SAMPLES_PER_CONTACT: f64 = 10.0;

/// Deflection of a beam, relative to its length, up to which the linear model has no warning.
pub const MAX_DEFLECTION_SHARE: f64 = 0.1;

/// A warning of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(tag = "warning", rename_all = "kebab-case")]
pub enum Warning {
    /// The strain or voltage of a patch exceeds its limits.
    #[error("{0}")]
    Limit(ExceededLimit),
    /// A recording ends before the averaging window.
    #[error(
        "{}: its recording ends at {ends_s} s, but the averaging window goes from {from_s} s to {to_s} s, and after its end the drive is 0; shorten run.duration, or give a longer recording",
        named("drive", drive)
    )]
    RecordingEnds {
        /// Name of the drive.
        drive: String,
        /// Time of its last sample, s.
        ends_s: f64,
        /// Start of the averaging window, s.
        from_s: f64,
        /// End of the averaging window, s.
        to_s: f64,
    },
    /// The recording of a drive has a data-quality issue.
    #[error("{}: {issue}", named("drive", drive))]
    Recording {
        /// Name of the drive.
        drive: String,
        /// The issue.
        issue: Issue,
    },
    /// A device never starts.
    #[error(
        "{}: the device never starts in this run: the storage reaches {storage_v:.3} V at its end, and the regulator starts at {start_v} V; increase run.duration, or reduce the storage capacitance",
        named("circuit", circuit)
    )]
    NeverStarts {
        /// Name of the circuit.
        circuit: String,
        /// Storage voltage at the end of the run, V.
        storage_v: f64,
        /// Start voltage of the regulator, V.
        start_v: f64,
    },
    /// A contact passes the last point of its force table.
    #[error(
        "{}: the penetration reaches {}, past the last point of its table at {}, where the slope of the end continues; measure the law to larger forces",
        named("stop", stop),
        Quantity::Length.write_rounded(*penetration_m, 4),
        Quantity::Length.write_rounded(*last_m, 4)
    )]
    PastTable {
        /// Name of the stop.
        stop: String,
        /// Largest penetration, m.
        penetration_m: f64,
        /// Last point of the table, m.
        last_m: f64,
    },
    /// The retained modes do not resolve a contact.
    #[error(
        "{}: a contact lasts {} on average and excites modes up to about {}, but the highest retained mode has {}; retain more modes until the results do not change (`reduction.modes`)",
        named("stop", stop),
        Quantity::Time.write_rounded(*duration_s, 3),
        Quantity::Frequency.write_rounded(*needed_hz, 4),
        Quantity::Frequency.write_rounded(*highest_hz, 4)
    )]
    ShortContact {
        /// Name of the stop.
        stop: String,
        /// Mean contact duration, s.
        duration_s: f64,
        /// Highest retained frequency, Hz.
        highest_hz: f64,
        /// Frequency to which a pulse of this duration excites modes, Hz.
        needed_hz: f64,
    },
    /// Samples do not resolve the force of a contact.
    #[error(
        "{}: a contact lasts {} on average, but the stored samples are {} apart, so that its force curve lacks contacts and peaks; store at least {needed_hz} samples per second (`--sample-rate`)",
        named("stop", stop),
        Quantity::Time.write_rounded(*duration_s, 3),
        Quantity::Time.write_rounded(1.0 / sample_rate_hz, 3)
    )]
    Undersampled {
        /// Name of the stop.
        stop: String,
        /// Mean contact duration, s.
        duration_s: f64,
        /// Sampling rate of the stored end, Hz.
        sample_rate_hz: f64,
        /// Sampling rate with ten samples in the mean contact, Hz.
        needed_hz: f64,
    },
    /// The patches of a circuit cancel each other.
    #[error(
        "{}: its patches act against each other in every mode, so that they give less than one of them alone; reverse the polarity with a minus: patches = {reversed:?} instead of {patches:?}",
        named("circuit", circuit)
    )]
    Cancelling {
        /// Name of the circuit.
        circuit: String,
        /// Patches as the spec names them.
        patches: Vec<String>,
        /// Patches with the polarity with which they act together.
        reversed: Vec<String>,
    },
    /// A plate is too thick for the theory of thin plates.
    #[error(
        "{}: its thickness of {} is not small against the half-wavelength of the highest retained mode, {}: without shear and rotary inertia this frequency is about {:.1} % too high; retain fewer modes, or import the matrices of a solid",
        named("plate", plate),
        Quantity::Length.write_rounded(*thickness_m, 4),
        Quantity::Length.write_rounded(*half_wavelength_m, 4),
        100.0 * error
    )]
    ThickPlate {
        /// Name of the plate.
        plate: String,
        /// Thickness, m.
        thickness_m: f64,
        /// Half-wavelength of the highest retained mode, m.
        half_wavelength_m: f64,
        /// Estimated relative error of its frequency.
        error: f64,
    },
    /// A beam is too thick for Euler-Bernoulli theory.
    #[error(
        "{}: it is {:.1} thicknesses long: without shear and rotary inertia the frequency of its first mode is about {:.1} % too high; import the matrices of a solid", named("beam", beam), length_m / thickness_m, 100.0 * error
    )]
    ThickBeam {
        /// Name of the beam.
        beam: String,
        /// Length, m.
        length_m: f64,
        /// Thickness, m.
        thickness_m: f64,
        /// Estimated relative error of its first frequency.
        error: f64,
    },
    /// A patch of a library composite has another thickness than the product.
    #[error(
        "{}: its thickness is {:.4} mm, but the constants of {material} are those of a product {:.4} mm thick; give that thickness, or other constants instead of `material`", named("patch", patch), 1e3 * thickness_m, 1e3 * product_m
    )]
    CompositeThickness {
        /// Name of the patch.
        patch: String,
        /// Name of the material.
        material: String,
        /// Thickness of the patch, m.
        thickness_m: f64,
        /// Thickness of the product, m.
        product_m: f64,
    },
    /// A patch of the section `thin-skin` is not thin.
    #[error(
        "{}: it is {:.2} times as thick as its beam, but `section = \"thin-skin\"` is for a skin that is thin against the beam: it neglects the mass of the patch and the shift of the neutral axis; give `section = \"laminate\"`, or another thickness", named("patch", patch), thickness_m / beam_thickness_m
    )]
    ThickSkin {
        /// Name of the patch.
        patch: String,
        /// Thickness of the patch, m.
        thickness_m: f64,
        /// Thickness of its beam, m.
        beam_thickness_m: f64,
    },
    /// Damping ratios for modes that are not retained.
    #[error(
        "damping.ratios has {listed} numbers, but only {used} retained modes need one: all after number {used} are without effect; shorten the list, or retain more modes (`reduction.modes`)"
    )]
    UnusedRatios {
        /// Length of the list.
        listed: usize,
        /// Number of retained modes that take a ratio from it.
        used: usize,
    },
    /// A beam bends too far for the linear model.
    #[error(
        "{}: its deflection reaches {:.0} % of its length; the linear model holds up to about {:.0} %", named("beam", beam), 100.0 * share, 100.0 * MAX_DEFLECTION_SHARE
    )]
    LargeDeflection {
        /// Name of the beam.
        beam: String,
        /// Largest displacement of a point of the beam, relative to its length.
        share: f64,
    },
    /// The averaging window is no whole number of periods.
    #[error(
        "run.average_over is {average_over_s} s, {:.3} periods of the drives: the means depend on the phase of the window; give a whole number of periods of {period_s:.9} s", average_over_s / period_s
    )]
    PartOfPeriod {
        /// Length of the averaging window, s.
        average_over_s: f64,
        /// Common period of the drives, s.
        period_s: f64,
    },
    /// Nothing moves.
    #[error(
        "the spec has no drive, and nothing moves; add a [drive.NAME], or start from a state with `--start`"
    )]
    NoDrive,
    /// A force acts where no retained mode moves.
    #[error(
        "{}: it acts at a point that no retained mode moves, so that it has no effect; give a point that moves in `at`",
        named("drive", drive)
    )]
    Ineffective {
        /// Name of the drive.
        drive: String,
    },
    /// The energy balance does not close within the tolerance.
    #[error(
        "the energy balance is off by {residual_relative:.1e} of the largest energy, more than the tolerance of {tolerance:.0e}; compare with a run at a smaller tolerance. If its residual is as large, the cause is roundoff: look for a value of the spec that is far too large or too small, often a wrong unit (`jounce show` draws the harvester to scale)"
    )]
    Unbalanced {
        /// Energy residual over the largest energy.
        residual_relative: f64,
        /// Tolerance of the run.
        tolerance: f64,
    },
}

impl Warning {
    /// Returns a warning for each stop whose contacts samples at a rate do not resolve: `n` samples
    /// within a half-sine pulse miss its peak by up to `1 - cos(pi / (2 n))`, 1.2 % for ten. A shorter
    /// or steeper pulse than the mean one needs more.
    pub fn of_sampling(stops: &[StopResult], sample_rate_hz: f64) -> Vec<Self> {
        let deformed = stops.iter().filter(|stop| !stop.is_rigid);
        let coarse = deformed.filter_map(|stop| {
            let duration_s = stop.mean_contact_duration_s;
            let needed_hz = (SAMPLES_PER_CONTACT / duration_s).ceil();
            (duration_s > 0.0 && sample_rate_hz < needed_hz).then(|| Self::Undersampled {
                stop: stop.name.clone(),
                duration_s,
                sample_rate_hz,
                needed_hz,
            })
        });
        coarse.collect()
    }

    /// Returns a warning for each beam on which the peak displacement of a point is no longer small.
    pub fn of_deflections(spec: &Spec, plant: &Plant, peaks: &OutputPeaks) -> Vec<Self> {
        let large = spec.beam.iter().filter_map(|(name, beam)| {
            let is_on_beam =
                |point: &str| point.split_once('.').is_some_and(|(body, _)| body == name);
            let points = plant.system.modes.shape.keys().zip(&peaks.points_m);
            let largest_m = points
                .filter(|(point, _)| is_on_beam(point))
                .fold(0.0, |max: f64, (_, peak_m)| max.max(*peak_m));
            let share = largest_m / beam.length_m;
            (share > MAX_DEFLECTION_SHARE).then(|| Self::LargeDeflection {
                beam: name.clone(),
                share,
            })
        });
        large.collect()
    }

    /// Returns the stop, beam, plate, circuit, drive or patch that the warning names; empty for none.
    pub fn subject(&self) -> &str {
        match self {
            Self::Limit(exceeded) => &exceeded.patch,
            Self::CompositeThickness { patch, .. } | Self::ThickSkin { patch, .. } => patch,
            Self::RecordingEnds { drive, .. }
            | Self::Recording { drive, .. }
            | Self::Ineffective { drive } => drive,
            Self::NeverStarts { circuit, .. } | Self::Cancelling { circuit, .. } => circuit,
            Self::PastTable { stop, .. }
            | Self::ShortContact { stop, .. }
            | Self::Undersampled { stop, .. } => stop,
            Self::ThickPlate { plate, .. } => plate,
            Self::ThickBeam { beam, .. } | Self::LargeDeflection { beam, .. } => beam,
            Self::PartOfPeriod { .. }
            | Self::NoDrive
            | Self::UnusedRatios { .. }
            | Self::Unbalanced { .. } => "",
        }
    }

    /// Returns all warnings of a run.
    pub fn of(spec: &Spec, kernel: &Kernel, plan: &RunPlan, result: &RunResult) -> Vec<Self> {
        let limits = Limits::of(spec, &kernel.plant)
            .exceeded(kernel, &result.trajectory, result.peak_window_s)
            .into_iter()
            .map(Self::Limit);
        let residual_relative = result.energies.residual_relative();
        let is_balanced = residual_relative.abs() <= plan.tolerance || result.is_trivial();
        let unbalanced = (!is_balanced).then_some(Self::Unbalanced {
            residual_relative,
            tolerance: plan.tolerance,
        });
        let noticed = spec.issues().filter(|(_, issue)| !issue.kind.is_note());
        let noticed = noticed.map(|(drive, issue)| Self::Recording {
            drive: drive.to_owned(),
            issue: issue.clone(),
        });
        limits
            .chain(ineffective::devices(&kernel.plant, result))
            .chain(noticed)
            .chain(model_limits::of_contacts(spec, kernel, result))
            .chain(Self::of_model(spec, &kernel.plant, plan))
            .chain(ineffective::no_drive(spec, result))
            .chain(unbalanced)
            .collect()
    }
}
