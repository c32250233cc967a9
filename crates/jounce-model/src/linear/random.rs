//! Exact linear response of a spec to its stationary noises.
//!
//! Mean squares come from [`super::covariance()`]. Mean powers come from it and from a quadrature
//! over frequency; their difference is returned too. Stops are left out: Rice's formula gives the
//! rate at which their gap would be reached ([`super::LevelCrossing`]). Drives other than noise are
//! left out too; gravity shifts the mean.

use super::bandwidth::{noise_bandwidth_hz, sampling_frequencies_hz, statistical_bandwidth_hz};
use super::covariance::{covariance, product};
use super::level_crossing::LevelCrossing;
use super::noise::{NoiseInput, density, spectral_moment};
use super::random_response::{
    Density, RandomLoad, RandomPatch, RandomPoint, RandomResponse, RandomStop,
};
use crate::plant::{Plant, PlantError, System};
use crate::structure::{self, StructureError};
use jounce_linalg::Mat;
use jounce_spec::{Interface, Spec, Stop};
use std::collections::BTreeMap;

/// Lowest frequency of densities over the highest frequency of the noises, where the noises begin
/// at 0.
const LOWEST_SHARE: f64 = 1e-3;

/// Reason why a spec has no linear response to noise.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum RandomError {
    /// The structure.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// No noise.
    #[error(
        "no drive has signal = \"noise\", so there is no random response; use `jounce frf` for sinusoids"
    )]
    NoNoise,
    /// A circuit that is not linear.
    #[error(
        "circuit.{circuit}.interface is not linear, so no formula gives its response to noise; use `jounce ensemble`"
    )]
    Rectified {
        /// Name of the circuit.
        circuit: String,
    },
    /// A response that never becomes stationary.
    #[error(
        "drive.{drive} excites a mode at {mode_hz} Hz without damping or stiffness, so its response never becomes stationary; give the mode a damping ratio, or use `jounce ensemble`"
    )]
    Unsteady {
        /// Name of the drive.
        drive: String,
        /// Frequency of the mode, Hz.
        mode_hz: f64,
    },
}

impl RandomError {
    pub(super) fn unsteady((drive, mode_hz): (String, f64)) -> Self {
        Self::Unsteady { drive, mode_hz }
    }
}

/// A linear plant under noise.
#[derive(Debug)]
pub struct Random {
    plant: Plant,
    noises: Vec<NoiseInput>,
    covariance: Mat<f64>,
    left_out: Vec<String>,
    /// Noise that moves only one side of a stop, by the name of the stop.
    carriers: BTreeMap<String, String>,
}

impl Random {
    /// Builds the harvester of a spec under its noises and gravity, without its stops and other
    /// drives.
    ///
    /// # Errors
    /// Every variant of [`RandomError`].
    pub fn new(spec: &Spec) -> Result<Self, RandomError> {
        if let Some((name, _)) = spec
            .circuit
            .iter()
            .find(|(_, circuit)| circuit.interface != Interface::Resistor)
        {
            return Err(RandomError::Rectified {
                circuit: name.clone(),
            });
        }
        let modes = structure::modes(spec)?;
        let noises = NoiseInput::of_spec(spec, &modes)?;
        if noises.is_empty() {
            return Err(RandomError::NoNoise);
        }
        let omitted = spec
            .drive
            .keys()
            .filter(|name| noises.iter().all(|noise| noise.name != **name))
            .cloned()
            .collect();
        let mut linear_spec = spec.clone();
        linear_spec.take_drives_away();
        let plant = Plant::new(System::assemble(&linear_spec, modes)?)?;
        let covariance = covariance(&plant, &noises).map_err(RandomError::unsteady)?;
        let carriers = spec
            .stop
            .iter()
            .filter_map(|(name, stop)| Some((name.clone(), carrier(spec, stop, &noises)?)))
            .collect();
        Ok(Self {
            plant,
            noises,
            covariance,
            left_out: omitted,
            carriers,
        })
    }

    /// Returns the means and mean squares.
    ///
    /// # Errors
    /// [`RandomError::Plant`] where a quadrature meets an undamped mode.
    pub fn response(&self) -> Result<RandomResponse, RandomError> {
        let modes = &self.plant.system.modes;
        let loads = (0..self.plant.system.loads.len())
            .map(|load| self.load(load))
            .collect::<Result<Vec<_>, _>>()?;
        let patches = modes.patch.keys().enumerate();
        let point = |(name, shape): (&String, &Vec<f64>)| RandomPoint {
            name: name.clone(),
            displacement_rms_m: self.rms(&self.plant.displacement_row(shape)),
            velocity_rms_m_s: self.rms(&self.plant.velocity_row(shape)),
        };
        Ok(RandomResponse {
            drives: self.noises.iter().map(|noise| noise.name.clone()).collect(),
            left_out: self.left_out.clone(),
            mean_power_w: loads
                .iter()
                .map(|load| load.mean_power_w)
                .fold(0.0, |sum, load_w| sum + load_w),
            loads,
            patches: patches
                .map(|(index, name)| RandomPatch {
                    name: name.clone(),
                    voltage_rms_v: self.rms(&self.plant.voltage_row(index)),
                })
                .collect(),
            points: modes.shape.iter().map(point).collect(),
            stops: self.stops(),
        })
    }

    fn rms(&self, row: &[f64]) -> f64 {
        product(&self.covariance, row, row).max(0.0).sqrt()
    }

    fn load(&self, index: usize) -> Result<RandomLoad, RandomError> {
        let (plant, load) = (&self.plant, &self.plant.system.loads[index]);
        let row = plant.load_voltage_row(index);
        let voltage_rms_v = self.rms(&row);
        let mean_power_w = voltage_rms_v * voltage_rms_v / load.resistance_ohm;
        let spectral_power_w = spectral_moment(plant, &self.noises, &row, 1)? / load.resistance_ohm;
        let difference = spectral_power_w - mean_power_w;
        Ok(RandomLoad {
            name: load.name.clone(),
            mean_power_w,
            spectral_power_w,
            difference_relative: if difference == 0.0 {
                0.0
            } else {
                difference / mean_power_w
            },
            voltage_rms_v,
            noise_bandwidth_hz: self
                .noises
                .iter()
                .map(|noise| noise_bandwidth_hz(plant, noise, &row))
                .collect::<Result<_, _>>()?,
            statistical_bandwidth_hz: statistical_bandwidth_hz(plant, &self.noises, &row)?,
        })
    }

    fn stops(&self) -> Vec<RandomStop> {
        let rest = self.plant.resting();
        let stop = |(stop, port): (&crate::plant::Stop, &crate::plant::Port)| {
            let crossing = LevelCrossing {
                mean_m: port
                    .displacement
                    .iter()
                    .zip(&rest)
                    .map(|(row, y)| row * y)
                    .sum(),
                deviation_m: self.rms(&port.displacement),
                velocity_m_s: self.rms(&port.velocity),
                level_m: stop.gap_m,
            };
            let carrier = self.carriers.get(&stop.name).cloned();
            let stays = carrier.is_none();
            RandomStop {
                name: stop.name.clone(),
                gap_m: stop.gap_m,
                mean_m: crossing.mean_m,
                displacement_rms_m: crossing.deviation_m,
                reached_hz: stays.then(|| crossing.rate_hz()),
                share_beyond: stays.then(|| crossing.share_beyond()),
                carried_by: carrier,
            }
        };
        self.plant
            .system
            .stops
            .iter()
            .zip(&self.plant.ports)
            .map(stop)
            .collect()
    }

    /// Returns the default band of densities, Hz: the band of the noises, from a thousandth of its
    /// upper end if it begins at 0.
    pub fn usual_band_hz(&self) -> [f64; 2] {
        let ends = self.noises.iter().map(|noise| noise.band_hz);
        let [low, high] = ends.fold([f64::INFINITY, 0.0_f64], |[low, high], [from, to]| {
            [low.min(from), high.max(to)]
        });
        [low.max(LOWEST_SHARE * high), high]
    }

    /// Returns frequencies between two limits, Hz, ascending: evenly spaced, and closer around each
    /// resonance.
    pub fn frequencies_hz(&self, from_hz: f64, to_hz: f64, points: usize) -> Vec<f64> {
        let mut all: Vec<f64> = (0..points)
            .map(|k| from_hz + (to_hz - from_hz) * k as f64 / (points - 1) as f64)
            .collect();
        all.extend(
            sampling_frequencies_hz(&self.plant)
                .into_iter()
                .filter(|frequency| (from_hz..=to_hz).contains(frequency)),
        );
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    /// Returns the power spectral densities of the voltages and displacements, at each frequency.
    ///
    /// # Errors
    /// [`RandomError::Plant`] at an undamped mode.
    pub fn densities(&self, frequency_hz: &[f64]) -> Result<Vec<Density>, RandomError> {
        self.densities_until(frequency_hz, &|| false)
    }

    /// Returns the densities, each up to the frequency at which `is_stopped` is first true.
    ///
    /// # Errors
    /// As [`Random::densities`].
    pub fn densities_until(
        &self,
        frequency_hz: &[f64],
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<Vec<Density>, RandomError> {
        let (plant, modes) = (&self.plant, &self.plant.system.modes);
        let loads = plant.system.loads.iter().enumerate();
        let loads = loads.map(|(index, load)| {
            (
                format!("{}.load_voltage", load.name),
                "V^2/Hz",
                plant.load_voltage_row(index),
            )
        });
        let patches = modes.patch.keys().enumerate();
        let patches = patches.map(|(index, name)| {
            (
                format!("{name}.voltage"),
                "V^2/Hz",
                plant.voltage_row(index),
            )
        });
        let points = modes.shape.iter().map(|(name, shape)| {
            (
                format!("{name}.displacement"),
                "m^2/Hz",
                plant.displacement_row(shape),
            )
        });
        (loads.chain(patches).chain(points))
            .map(|(name, unit, row)| {
                let frequencies = frequency_hz.iter().take_while(|_| !is_stopped());
                let value = frequencies
                    .map(|frequency| density(plant, &self.noises, &row, *frequency))
                    .collect::<Result<_, _>>()?;
                Ok(Density { name, unit, value })
            })
            .collect()
    }
}

/// Returns the noise that moves the base of only one side of a stop.
fn carrier(spec: &Spec, stop: &Stop, noises: &[NoiseInput]) -> Option<String> {
    let under = [&stop.at, &stop.frame].map(|point| spec.base_under(point));
    let carries = |noise: &&NoiseInput| {
        noise
            .base
            .as_deref()
            .is_some_and(|base| (under[0] == base) != (under[1] == base))
    };
    noises.iter().find(carries).map(|noise| noise.name.clone())
}
