//! One numeric key of a spec as the parameter of a family of models.
//!
//! Derivatives by a drive, a gap or a stiffness have a closed form. With the steady state `Y = (i w
//! I - A)^-1 b F`:
//!
//! ```text
//! dY / df = -2 pi i (i w I - A)^-1 Y,   dY / dF = Y / F,   d(penetration) / d(gap) = -1,   d(force) / dk = force / k
//! ```

use super::{AnalysisError, Model};
use jounce_dynamics::{Kernel, ParameterSensitivity};
use jounce_linalg::c64;
use jounce_model::contact::Law;
use jounce_model::plant::{Drive, Plant};
use jounce_orbits::{ModelInstance, ParameterDerivatives, ParametricModel};
use jounce_spec::{DriveKind, NumericKey};
use std::f64::consts::TAU;

/// Family of models over one key.
#[derive(Debug)]
pub struct Parameter<'s> {
    base: &'s Model,
    key: &'s NumericKey,
    role: KeyRole,
    difference: f64,
}

/// Role of the key in the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum KeyRole {
    Frequency,
    Amplitude,
    Gap,
    Stiffness,
    Other,
}

impl<'s> Parameter<'s> {
    /// Creates the family of models of a spec over a key; `width` is the range of interest.
    pub fn new(base: &'s Model, key: &'s NumericKey, width: f64) -> Self {
        let segments: Vec<&str> = key.path().split('.').collect();
        let plain = matches!(
            base.kernel.plant.system.stops.first().map(|stop| stop.law),
            Some(Law::Hertz(_) | Law::HuntCrossley(_))
        );
        // Where two bases move relative to each other, the drive also changes the gap.
        let one_drive = base.kernel.plant.system.drives.len() == 1
            && base.kernel.plant.stop_between_bases().is_none();
        // The force of a displaced base is proportional to the square of its frequency.
        let moves_base = |name: &str| {
            base.spec
                .drive
                .get(name)
                .is_some_and(|drive| drive.kind == DriveKind::BaseDisplacement)
        };
        let one_stop = base.kernel.plant.system.stops.len() == 1;
        let role = match segments[..] {
            ["drive", name, "frequency"] if one_drive && !moves_base(name) => KeyRole::Frequency,
            ["drive", name, "amplitude"] if one_drive && !moves_base(name) => KeyRole::Amplitude,
            ["stop", _, "gap"] if one_stop => KeyRole::Gap,
            ["stop", _, "stiffness"] if one_stop && plain => KeyRole::Stiffness,
            _ => KeyRole::Other,
        };
        Self {
            base,
            key,
            role,
            difference: 1e-7 * width,
        }
    }

    /// Checks that periodic responses depend on a key.
    ///
    /// # Errors
    /// [`AnalysisError::OfRuns`].
    pub fn check_key(key: &NumericKey) -> Result<(), AnalysisError> {
        let key = key.path();
        if key.starts_with("run.") {
            Err(AnalysisError::OfRuns {
                key: key.to_owned(),
            })
        } else {
            Ok(())
        }
    }

    /// Returns the key.
    pub fn key(&self) -> &NumericKey {
        self.key
    }

    fn kernel(&self, parameter: f64) -> Result<Kernel, AnalysisError> {
        let with_drive = |change: fn(&mut Drive, f64)| -> Result<Kernel, AnalysisError> {
            let mut drives = self.base.kernel.plant.system.drives.clone();
            drives.iter_mut().for_each(|drive| change(drive, parameter));
            Ok(self.base.kernel.with_drives(drives)?)
        };
        match self.role {
            KeyRole::Frequency => with_drive(|drive, value| drive.frequency_hz = value),
            KeyRole::Amplitude => with_drive(|drive, value| drive.amplitude_n = value),
            _ => {
                let mut spec = self.base.spec.clone();
                self.key.set(&mut spec, parameter)?;
                Ok(self.base.changed(spec)?.kernel)
            }
        }
    }

    /// Returns the derivatives by the key, where they have a closed form.
    fn change(&self, kernel: &Kernel, parameter: f64) -> Option<ParameterDerivatives> {
        let plant = &kernel.plant;
        let of_stop = |drift: ParameterSensitivity| ParameterDerivatives {
            drift,
            steady: vec![0.0; plant.len()],
            period_relative: 0.0,
        };
        match self.role {
            KeyRole::Gap => Some(of_stop(ParameterSensitivity {
                gap_m: vec![1.0],
                ..ParameterSensitivity::default()
            })),
            KeyRole::Stiffness => Some(of_stop(ParameterSensitivity {
                force_relative: vec![1.0 / parameter],
                ..ParameterSensitivity::default()
            })),
            KeyRole::Frequency => {
                let tone = plant.tones.first()?;
                let resolved = plant
                    .diagonal
                    .block
                    .resolve(c64::new(0.0, tone.angular_frequency_rad_s), &tone.steady);
                let by = resolved.into_iter().map(|y| y * c64::new(0.0, -TAU));
                let drive = (TAU, -1.0 / parameter);
                Some(drive_derivatives(plant, by.collect(), drive))
            }
            KeyRole::Amplitude if parameter != 0.0 => {
                let tone = plant.tones.first()?;
                let by = tone.steady.iter().map(|y| *y / parameter);
                Some(drive_derivatives(plant, by.collect(), (0.0, 0.0)))
            }
            KeyRole::Amplitude | KeyRole::Other => None,
        }
    }
}

/// Returns the derivatives by a key of the drive from those of the steady state, of the angular
/// frequency, and of the period relative to itself.
fn drive_derivatives(
    plant: &Plant,
    steady: Vec<c64>,
    (frequency, period_relative): (f64, f64),
) -> ParameterDerivatives {
    let ports = plant
        .ports
        .iter()
        .map(|port| {
            port.displacement
                .iter()
                .zip(&steady)
                .map(|(c, y)| *y * *c)
                .sum()
        })
        .collect();
    let drift = ParameterSensitivity {
        tones: vec![(ports, frequency)],
        ..ParameterSensitivity::default()
    };
    ParameterDerivatives {
        drift,
        steady: steady.iter().map(|y| y.re).collect(),
        period_relative,
    }
}

impl ParametricModel for Parameter<'_> {
    type Error = AnalysisError;

    fn at(&self, parameter: f64) -> Result<ModelInstance, AnalysisError> {
        self.base.kernel.control.count_harvester();
        let kernel = self.kernel(parameter)?;
        check_periodic(&kernel)?;
        // The closed forms hold for a single conduction state only.
        let change = if kernel.plant.system.bridges.is_empty() {
            self.change(&kernel, parameter)
        } else {
            None
        };
        Ok(ModelInstance { kernel, change })
    }

    fn difference(&self) -> f64 {
        self.difference
    }
}

/// Checks that all drives are periodic.
pub(crate) fn check_periodic(kernel: &Kernel) -> Result<(), AnalysisError> {
    match kernel.plant.system.aperiodic() {
        None => Ok(()),
        Some(part) => Err(AnalysisError::Aperiodic { part }),
    }
}
