//! Attractors of a model, with the states needed to continue from them.

use jounce_analysis::run::StartState;
use jounce_analysis::{Attractor, Basins, Cloud, InitialStates, Model, Parameter, Recognition};
use jounce_control::Control;
use jounce_model::plant::Plant;
use jounce_orbits::{Orbit, Shooting};
use jounce_spec::{NumericKey, Spec};

use super::{SolutionError, Waveform};

/// Settings of the search for solutions.
#[derive(Debug, Clone, PartialEq)]
pub struct SolutionSearch {
    /// Number of random starts.
    pub starts: usize,
    /// Seed of the starts.
    pub seed: u64,
    /// Size of the cloud of starts, in gaps (or steady amplitudes, where those are larger).
    pub spread: f64,
    /// Relative tolerance of the runs.
    pub tolerance: f64,
    /// Circuit whose voltage is used; `None` for the first one.
    pub load: Option<String>,
}

impl Default for SolutionSearch {
    fn default() -> Self {
        Self {
            starts: 40,
            seed: 1,
            spread: 10.0,
            tolerance: 1e-8,
            load: None,
        }
    }
}

/// Solution of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Id: drive cycles of the period and a letter in order of decreasing power, as in
    /// [`jounce_analysis::Attractor`]: `1a`, `3a`; `chaos`; `torus`.
    pub id: String,
    /// Drive cycles of its period; `None` without an orbit.
    pub period_cycles: Option<u32>,
    /// Mean power of all loads, W.
    pub mean_power_w: f64,
    /// Contacts per period.
    pub contacts: u64,
    /// Share of the starts that converge to this solution.
    pub share: f64,
    /// State on the orbit at the initial angles of the drives; `None` without an orbit.
    pub start: Option<StartState>,
    /// Voltage across the load; `None` without an orbit.
    pub waveform: Option<Waveform>,
}

/// Finds the solutions of a spec under its single sinusoidal drive; a solution whose share is below
/// about `3 / starts` may be missed. `control` can cancel the runs.
///
/// # Errors
/// [`SolutionError`].
pub fn solutions(
    spec: &Spec,
    search: &SolutionSearch,
    control: &Control,
) -> Result<Vec<Solution>, SolutionError> {
    let base = Model::watched(spec.clone(), control)?;
    let drives: Vec<(&String, f64)> = base
        .spec
        .drive
        .iter()
        .filter_map(|(name, drive)| Some((name, drive.frequency_hz()?)))
        .collect();
    let [(name, drive_hz)] = drives[..] else {
        return Err(SolutionError::Drives {
            found: drives.len(),
        });
    };
    let load = load(&base.kernel.plant, search.load.as_deref())?;
    let key = NumericKey::find(&base.spec, &format!("drive.{name}.frequency"))?;
    let parameter = Parameter::new(&base, &key, drive_hz);
    let starts = InitialStates::Cloud(Cloud {
        starts: search.starts,
        seed: search.seed,
        spread: search.spread,
    });
    let study = Basins {
        base: &base,
        starts,
        recognition: Recognition::at(search.tolerance),
    };
    let basins = study.run()?;
    if let (true, Some((_, first))) = (basins.attractors.is_empty(), basins.lost.first()) {
        return Err(SolutionError::Lost {
            starts: search.starts,
            first: first.clone(),
        });
    }
    let continuation = Continuation {
        parameter: &parameter,
        base: &base,
        drive_hz,
        load,
        tolerance: search.tolerance,
    };
    basins
        .attractors
        .into_iter()
        .map(|attractor| continuation.solution(attractor))
        .collect()
}

/// Model from which a run continues on an attractor.
struct Continuation<'m> {
    parameter: &'m Parameter<'m>,
    base: &'m Model,
    drive_hz: f64,
    /// Index of the load whose voltage is used.
    load: usize,
    tolerance: f64,
}

impl Continuation<'_> {
    fn solution(&self, attractor: Attractor) -> Result<Solution, SolutionError> {
        let (start, waveform) = attractor
            .orbit()
            .map(|orbit| self.on_orbit(orbit))
            .transpose()?
            .unzip();
        Ok(Solution {
            period_cycles: attractor.orbit().map(|orbit| orbit.period_cycles),
            id: attractor.id,
            mean_power_w: attractor.mean_power_w,
            contacts: attractor.contacts_per_period,
            share: attractor.share.fraction,
            start,
            waveform,
        })
    }

    /// State on an orbit at the initial angles of the drives, and the voltage over a period.
    fn on_orbit(&self, orbit: &Orbit) -> Result<(StartState, Waveform), SolutionError> {
        let (kernel, cycles) = (&self.base.kernel, orbit.period_cycles);
        let physical =
            Shooting::new(self.parameter, kernel, cycles, self.tolerance).physical(orbit.start());
        let plant = &kernel.plant;
        let start = StartState::from_blocks(plant, &plant.from_physical(&physical, 0.0), 0.0);
        let waveform = Waveform::of(
            kernel,
            &start,
            cycles,
            self.drive_hz,
            self.load,
            self.tolerance,
        )?;
        Ok((start, waveform))
    }
}

/// Index of the load whose voltage is used.
fn load(plant: &Plant, requested: Option<&str>) -> Result<usize, SolutionError> {
    let loads = &plant.system.loads;
    let Some(requested) = requested else {
        return if loads.is_empty() {
            Err(SolutionError::NoLoad)
        } else {
            Ok(0)
        };
    };
    loads
        .iter()
        .position(|load| load.name == requested)
        .ok_or_else(|| SolutionError::UnknownLoad {
            requested: requested.to_owned(),
            known: loads
                .iter()
                .map(|load| load.name.clone())
                .collect::<Vec<_>>()
                .join(", "),
        })
}
