//! What the user says, checked and in SI units. One struct per kind of thing; names are the user's own.

use super::recording::Recording;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A whole spec: every thing by its own name, every quantity in SI units, every reference resolved.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spec {
    /// `[beam.NAME]`
    pub beam: BTreeMap<String, Beam>,
    /// `[patch.NAME]`
    pub patch: BTreeMap<String, Patch>,
    /// `[mass.NAME]`
    pub mass: BTreeMap<String, Mass>,
    /// `[modal.NAME]`
    pub modal: BTreeMap<String, Modal>,
    /// `[stop.NAME]`
    pub stop: BTreeMap<String, Stop>,
    /// `[circuit.NAME]`
    pub circuit: BTreeMap<String, Circuit>,
    /// `[drive.NAME]`
    pub drive: BTreeMap<String, Drive>,
    /// `[gravity]`
    pub gravity: Gravity,
    /// `[damping]`
    pub damping: Damping,
    /// `[reduction]`
    pub reduction: Reduction,
    /// `[run]`
    pub run: Run,
}

/// A uniform beam; its root is clamped to the ground, to a mass or to a point of another beam. A stepped beam is a chain of these.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// `material`: a name of the library, which gives modulus and density where they are not given; empty without.
    pub material: String,
    /// `length`
    pub length_m: f64,
    /// `width`
    pub width_m: f64,
    /// `thickness`
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `density`
    pub density_kg_m3: f64,
    /// `root`: `"ground"`, the name of a mass, or a point of another beam, `"arm.end"`; default `"ground"`.
    pub root: String,
    /// `[beam.NAME.point]`: named places along the beam, distance from the root, m. `NAME.root` and `NAME.end` always exist.
    pub point: BTreeMap<String, f64>,
}

/// A piezoelectric patch bonded on one face of a beam.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    /// `on`: name of the beam.
    pub on: String,
    /// `face`: `"top"` (default) or `"bottom"`.
    pub face: Face,
    /// `material`: a name of the library, which gives what is not given here; empty without.
    pub material: String,
    /// `start`: distance from the root, m.
    pub start_m: f64,
    /// `length`
    pub length_m: f64,
    /// `width`
    pub width_m: f64,
    /// `thickness`
    pub thickness_m: f64,
    /// `youngs_modulus`
    pub youngs_modulus_pa: f64,
    /// `density`; required with `laminate`; not used by `thin-skin` (the paper neglects the mass of the patch), default 0 there.
    pub density_kg_m3: f64,
    /// `d31`, m/V: strain along the beam per field through the thickness.
    pub d31_m_per_v: Option<f64>,
    /// `d33`, m/V: strain along the beam per field along it, between electrodes `electrode_spacing` apart; excludes `d31`.
    pub d33_m_per_v: Option<f64>,
    /// `electrode_spacing`, m; goes with `d33`.
    pub electrode_spacing_m: Option<f64>,
    /// `capacitance`, clamped, F; excludes `permittivity`.
    pub capacitance_f: Option<f64>,
    /// `permittivity` at constant strain of the layer as a plate capacitor, F/m.
    pub permittivity_f_m: Option<f64>,
    /// `strain_limit`: largest strain along the beam that it bears, dimensionless.
    pub strain_limit: Option<f64>,
    /// `section`; default `laminate`.
    pub section: Section,
}

impl Patch {
    /// Free strain along the beam per volt, 1/V: `d31 / thickness`, or `d33 / electrode_spacing`; NaN where neither is known.
    pub fn free_strain_per_v(&self) -> f64 {
        let along = self.d33_m_per_v.zip(self.electrode_spacing_m).map(|(d33, spacing)| d33 / spacing);
        along.or(self.d31_m_per_v.map(|d31| d31 / self.thickness_m)).unwrap_or(f64::NAN)
    }

    /// Clamped capacitance, F: as given, or `permittivity * width * length / thickness`; NaN where neither is known.
    pub fn clamped_capacitance_f(&self) -> f64 {
        let plate = || self.permittivity_f_m.map(|permittivity| permittivity * self.width_m * self.length_m / self.thickness_m);
        self.capacitance_f.or_else(plate).unwrap_or(f64::NAN)
    }
}

/// The face of a beam that carries a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Face {
    /// The face towards positive displacement.
    #[default]
    Top,
    /// The face towards negative displacement.
    Bottom,
}

/// How a patch changes the section of its beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Section {
    /// `"thin-skin"`: `EI_b + E_p b_p h_p (h/2)^2` about the beam's mid-plane, no patch mass (the paper's own).
    ThinSkin,
    /// `"laminate"`: full section about the shifted neutral axis, with the patch's mass.
    #[default]
    Laminate,
}

/// A rigid mass. On a spring it moves along the drive direction and may carry beams; without one it is part of what it stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct Mass {
    /// `on`: `"ground"` (default), a mass, a point of a beam, or `"nothing"` for a free mass.
    pub on: String,
    /// `mass`
    pub mass_kg: f64,
    /// `rotary_inertia` about the point that it is fixed to, kg m^2; default 0. For a mass without spring on a beam.
    pub rotary_inertia_kg_m2: f64,
    /// `frequency` (of the mass alone on its spring) or `stiffness`, at most one of them; stored as stiffness, N/m. `None`: no spring.
    pub stiffness_n_m: Option<f64>,
    /// `damping_ratio`: damping ratio of the coupled mode in which this mass moves most; with a spring only.
    pub damping_ratio: Option<f64>,
}

/// A structure given by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct Modal {
    /// `frequency_hz`: plain numbers, Hz, ascending; 0 for a rigid-body mode.
    pub frequency_hz: Vec<f64>,
    /// `damping_ratio`
    pub damping_ratio: Vec<f64>,
    /// `participation_sqrt_kg`: mass times mass-normalised shape, summed over the structure, kg^1/2, one per mode; empty where not given.
    pub participation_sqrt_kg: Vec<f64>,
    /// `[modal.NAME.point]`: mass-normalised shape at each point, kg^-1/2.
    pub point: BTreeMap<String, Vec<f64>>,
    /// `[modal.NAME.patch.PATCH]`
    pub patch: BTreeMap<String, ModalPatch>,
}

/// A patch of a structure given by its modes.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalPatch {
    /// `coupling_n_per_v`: plain numbers, one per mode.
    pub coupling_n_per_v: Vec<f64>,
    /// `capacitance`
    pub capacitance_f: f64,
}

/// What a point strikes.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// `at`: the striking point, `"beam.tip"`, `"table"`, `"harvester.tip"`.
    pub at: String,
    /// `frame`: `"ground"` (default) or the body or point that carries the stop; the reaction acts there.
    pub frame: String,
    /// `side`: `"positive"` (default) or `"negative"`: the direction in which the point must move to strike.
    pub side: Side,
    /// `gap`, m; may be negative (preloaded contact).
    pub gap_m: f64,
    /// `law` and its numbers.
    pub law: StopLaw,
}

/// On which side of the point at rest a stop stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Struck by moving in the positive direction.
    #[default]
    Positive,
    /// Struck by moving in the negative direction.
    Negative,
}

/// The contact law of a stop. `delta` is the penetration, m; `delta'` its rate, m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StopLaw {
    /// `law = "hertz"`: `F = stiffness * delta^exponent`; keys `stiffness` (N/m^exponent), `exponent` (default 1.5, at least 1).
    Hertz {
        /// N/m^exponent
        stiffness: f64,
        /// dimensionless
        exponent: f64,
    },
    /// `law = "spring"`: `F = stiffness * delta`; key `stiffness` (N/m).
    Spring {
        /// N/m
        stiffness_n_m: f64,
    },
    /// `law = "kelvin-voigt"`: `F = max(0, stiffness * delta + damping * delta')`; keys `stiffness` (N/m), `damping` (N s/m).
    KelvinVoigt {
        /// N/m
        stiffness_n_m: f64,
        /// N s/m
        damping_n_s_m: f64,
    },
    /// `law = "hunt-crossley"`: `F = stiffness * delta^exponent * max(0, 1 + damping * delta')`; keys `stiffness`, `exponent`, `damping` (s/m).
    HuntCrossley {
        /// N/m^exponent
        stiffness: f64,
        /// dimensionless
        exponent: f64,
        /// s/m
        damping_s_m: f64,
    },
    /// `law = "cubic"`: `F = stiffness * delta + cubic_stiffness * delta^3` on both sides of the rest place, of either sign; keys
    /// `stiffness` (N/m, default 0), `cubic_stiffness` (N/m^3).
    Cubic {
        /// N/m
        stiffness_n_m: f64,
        /// N/m^3
        cubic_stiffness_n_m3: f64,
    },
    /// `law = "rigid"`: instantaneous rebound with a coefficient of restitution; key `restitution` (0 to 1).
    Rigid {
        /// dimensionless
        restitution: f64,
    },
}

/// A linear load across one patch or several.
#[derive(Debug, Clone, PartialEq)]
pub struct Circuit {
    /// `patch`: `"mfc"` or `"harvester.mfc"`; empty where `patches` is given.
    pub patch: String,
    /// `patches`: several, `["top", "-bottom"]`; a minus connects a patch the other way round.
    pub patches: Vec<String>,
    /// `wiring` of several patches; default parallel.
    pub wiring: Wiring,
    /// `resistance`, ohm, > 0.
    pub resistance_ohm: f64,
    /// `inductance`, H; `None` without an inductor.
    pub inductance_h: Option<f64>,
    /// `inductor`: how it stands to the resistor; default parallel.
    pub inductor: Wiring,
    /// `interface`; default resistor.
    pub interface: Interface,
    /// `storage`: smoothing capacitor behind the diodes, F.
    pub storage_f: Option<f64>,
    /// `battery` instead of it, V.
    pub battery_v: Option<f64>,
    /// `diode_drop` of each of the two diodes of a path, V.
    pub diode_drop_v: f64,
    /// `diode_resistance` of each while it conducts, ohm.
    pub diode_resistance_ohm: f64,
    /// `leakage_resistance` across the storage capacitor, ohm; `None` without.
    pub leakage_ohm: Option<f64>,
    /// `quality_factor` of the inductor and its switch.
    pub quality_factor: Option<f64>,
    /// `efficiency` of an extraction, 0 to 1.
    pub efficiency: f64,
}

/// What stands between the patches and what takes their energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interface {
    /// `"resistor"`: nothing.
    #[default]
    Resistor,
    /// `"bridge"`: a full bridge of diodes.
    Bridge,
    /// `"parallel-sshi"`: a bridge, and an inductor with a switch across the patches.
    ParallelSshi,
    /// `"series-sshi"`: a bridge behind an inductor with a switch.
    SeriesSshi,
    /// `"sece"`: synchronous electric charge extraction.
    Sece,
}

impl Circuit {
    /// Every patch of the circuit with the sign of its connection.
    pub fn connections(&self) -> impl Iterator<Item = (&str, f64)> {
        let single = Some(self.patch.as_str()).filter(|patch| !patch.is_empty()).map(|patch| (patch, 1.0));
        let several = self.patches.iter().map(|patch| patch.strip_prefix('-').map_or((patch.as_str(), 1.0), |name| (name, -1.0)));
        single.into_iter().chain(several)
    }
}

/// How two electrical things stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wiring {
    /// `"parallel"`: the same voltage.
    #[default]
    Parallel,
    /// `"series"`: the same current.
    Series,
}

/// What shakes the harvester.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    /// `at`: point or mass on which a force acts; empty for motions of the base.
    pub at: String,
    /// `kind`; default `force`.
    pub kind: DriveKind,
    /// `signal` and its numbers; default `sine`.
    pub signal: DriveSignal,
}

/// What a drive prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DriveKind {
    /// `"force"`: a force on a point, N.
    #[default]
    Force,
    /// `"base-acceleration"`: acceleration of the ground with everything that stands on it, m/s^2. Displacements are relative to it.
    BaseAcceleration,
    /// `"base-displacement"`: displacement of the ground, m; sinusoids only. Displacements are relative to it.
    BaseDisplacement,
}

/// The course of a drive in time; amplitudes in N, m/s^2 or m, by the kind of the drive.
#[derive(Debug, Clone, PartialEq)]
pub enum DriveSignal {
    /// `"sine"`: `amplitude * sin(2 pi frequency t + phase)`.
    Sine {
        /// `amplitude`, zero to peak.
        amplitude: f64,
        /// `frequency`
        frequency_hz: f64,
        /// `phase`, rad; default 0.
        phase_rad: f64,
    },
    /// `"chirp"`: a sinusoid whose frequency goes from `from` to `to` in the time `duration`.
    Chirp {
        /// `amplitude`, zero to peak.
        amplitude: f64,
        /// `from`
        from_hz: f64,
        /// `to`
        to_hz: f64,
        /// `sweep`; default `linear`.
        sweep: FrequencySweep,
        /// `phase` at its start, rad; default 0.
        phase_rad: f64,
        /// `start`, s; default 0.
        start_s: f64,
        /// `duration`, s.
        duration_s: f64,
    },
    /// `"half-sine"`: the pulse `amplitude * sin(pi (t - start) / duration)`.
    HalfSine {
        /// `amplitude`, peak.
        amplitude: f64,
        /// `start`, s; default 0.
        start_s: f64,
        /// `duration`, s.
        duration_s: f64,
    },
    /// `"velocity-step"`: the base jumps to another velocity.
    VelocityStep {
        /// `velocity`, m/s.
        velocity_m_s: f64,
        /// `start`, s; default 0.
        start_s: f64,
    },
    /// `"noise"`: Gaussian noise of a flat one-sided power spectral density from `low` to `high`.
    Noise {
        /// `psd`, one-sided: N^2/Hz or (m/s^2)^2/Hz.
        density: f64,
        /// `low`; default 0.
        low_hz: f64,
        /// `high`
        high_hz: f64,
        /// `sample_rate`; default [`DriveSignal::SAMPLES_PER_CYCLE`] times `high`.
        sample_rate_hz: Option<f64>,
        /// `seed`; default 1.
        seed: u64,
    },
    /// `"recording"`: samples of a file, joined by straight lines; 0 before the first and after the last.
    Recording {
        /// `file`: path of a CSV file, relative to the spec.
        file: String,
        /// `scale`: what 1 in the file stands for, in SI; default 1.
        scale: f64,
        /// `start`: time of the first sample in the run, s; default 0.
        start_s: f64,
        /// `sample_rate`: what the file is checked against.
        sample_rate_hz: Option<f64>,
        /// What the file holds; `None` until it is read.
        record: Option<Arc<Recording>>,
    },
}

/// How the frequency of a chirp goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FrequencySweep {
    /// By the same number of hertz in each second.
    #[default]
    Linear,
    /// By the same factor in each second.
    Logarithmic,
}

impl DriveSignal {
    /// Samples of noise in a cycle of its highest frequency.
    pub const SAMPLES_PER_CYCLE: f64 = 10.0;
    /// Samples of a chirp in its shortest cycle.
    pub const CHIRP_SAMPLES_PER_CYCLE: f64 = 256.0;
}

impl Drive {
    /// Frequency of a sinusoid, Hz.
    pub fn frequency_hz(&self) -> Option<f64> {
        if let DriveSignal::Sine { frequency_hz, .. } = self.signal { Some(frequency_hz) } else { None }
    }
}

/// `[gravity]`
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gravity {
    /// `acceleration` in the positive direction of motion, m/s^2; negative where gravity pulls the other way.
    pub acceleration_m_s2: Option<f64>,
}

/// `[damping]`: damping ratios of the modes of all assembled beams, in ascending order, those of masses left out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Damping {
    /// `ratios`: one per flexible mode in ascending order.
    pub ratios: Vec<f64>,
    /// `beyond`: ratio of the flexible modes after the list; needed only when there are more modes than ratios.
    pub beyond: Option<f64>,
}

/// `[reduction]`
#[derive(Debug, Clone, PartialEq)]
pub struct Reduction {
    /// `modes`: how many modes of the assembled structure are kept; default 8.
    pub modes: usize,
    /// `mesh_tolerance`: wanted relative error of every kept frequency; default 1e-9.
    pub mesh_tolerance: f64,
}

impl Default for Reduction {
    fn default() -> Self {
        Self { modes: 8, mesh_tolerance: 1e-9 }
    }
}

/// `[run]`
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// `start`; default rest.
    pub start: Start,
    /// `duration`, s.
    pub duration_s: f64,
    /// `average_over`: length of the averaging window at the end of the run, s; at most `duration`.
    pub average_over_s: f64,
    /// `tolerance`: wanted relative error of the response; default 1e-7.
    pub tolerance: f64,
}

impl Default for Run {
    fn default() -> Self {
        Self { start: Start::Rest, duration_s: 20.0, average_over_s: 10.0, tolerance: 1e-7 }
    }
}

/// Where a run starts from.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Start {
    /// `"rest"`
    #[default]
    Rest,
    /// `"linear"`: the steady state of the harvester without its stop.
    Linear,
    /// Any other string with a dot or a slash in it: path of a state file saved by another run (relative to the spec file).
    State(String),
}
