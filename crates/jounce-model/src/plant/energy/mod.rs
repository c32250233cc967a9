//! Energies of a run by exact integration.
//!
//! A power that is a sum of squares of outputs, `p(t) = sum_m weight_m (c_m . y + Re(S_m e^{i w
//! t}))^2`, is integrated without quadrature. With `A^T P + P A = -sum_m weight_m c_m c_m^T` and,
//! for each tone, `r = C (i w I + A)^-1`, `C = 2 sum_m weight_m S_m c_m`,
//!
//! ```text
//! B(t) = -y^T P y + Re(e^{i w t} r y) + (antiderivative of the steady part),
//! integral of p = [B] + 2 integral f (P b) . y dt - Re(r b integral f e^{i w t} dt)
//! ```
//!
//! because `d(y^T P y)/dt = -sum weight (c y)^2 + 2 f y^T P b` and `d(e^{i w t} r y)/dt = e^{i w t}
//! (C y + r b f)`. Only the contact force `f` needs integration; between contacts no evaluation is
//! required. A power that is linear in `y` (the power of the drive) has `P = 0`. Drives that are
//! linear in time between breakpoints add the terms of [`super::SignalMeter`].
//!
//! Validation: `crates/jounce-dynamics/tests/plant` compares with Gauss quadrature along exact
//! flows.

pub(super) mod lyapunov;
pub(super) mod quadratic;
pub(super) mod signal_meter;

use super::{Plant, PlantError, PowerOutput, SignalMeter, Tone};
use jounce_linalg::c64;
use quadratic::{Quadratic, Quadratics};
use std::sync::Arc;

/// A power that is integrated exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyMeter {
    /// Part independent of the drives; `None` for a power that is linear.
    quadratic: Option<Arc<Quadratic>>,
    /// Per tone: angular frequency and `r`.
    cross: Vec<(f64, Vec<c64>)>,
    /// Antiderivative of the steady part: slope, W, and terms `Re(a e^{i w t})`.
    steady_power_w: f64,
    steady_terms: Vec<(f64, c64)>,
    /// Per port: `P b`, and `r b` per tone.
    port_rows: Vec<Vec<f64>>,
    port_cross: Vec<Vec<c64>>,
    /// Contribution of the signals.
    signals: SignalMeter,
}

/// The three energies of every run.
#[derive(Debug, Clone, PartialEq)]
pub struct Meters {
    /// Energy delivered to each load, J, then to each of [`Plant::bridge_outputs`] and of
    /// [`Plant::leak_outputs`]; computed with the voltages measured from their zeros.
    pub loads: Vec<EnergyMeter>,
    /// Outputs of the bridges and of the leaks, whose energies follow those of the loads.
    pub outputs: Vec<PowerOutput>,
    /// Energy lost in modal damping and friction, J.
    pub damping: EnergyMeter,
    /// Energy put in by the drives, J.
    pub input: EnergyMeter,
}

impl Meters {
    /// Returns the meters of a plant.
    ///
    /// # Errors
    /// [`PlantError::Undamped`] if an undamped mode carries power.
    pub fn new(plant: &Plant) -> Result<Self, PlantError> {
        Ok(Self::under(&Quadratics::of(plant)?, plant))
    }

    /// Returns the meters from the quadratic forms of the plant, which do not depend on its drives.
    pub fn under(quadratics: &Quadratics, plant: &Plant) -> Self {
        let meter = |quadratic: &Arc<Quadratic>| EnergyMeter::squares(plant, quadratic);
        let loads = quadratics.loads.iter().map(meter).collect();
        let bridges = plant.bridge_outputs().into_iter();
        Self {
            loads,
            outputs: bridges.chain(plant.leak_outputs()).collect(),
            damping: meter(&quadratics.damping),
            input: EnergyMeter::drive(plant),
        }
    }
}

impl EnergyMeter {
    /// Returns `B(t)`, J; its differences are the energy except for the contact terms.
    pub fn boundary_j(&self, y: &[f64], time_s: f64) -> f64 {
        let mut sum = self.steady_power_w * time_s - self.quadratic_j(y);
        for (w, row) in &self.cross {
            let value: c64 = row.iter().zip(y).map(|(r, y)| *r * *y).sum();
            sum += (c64::cis(w * time_s) * value).re;
        }
        sum + self
            .steady_terms
            .iter()
            .map(|(w, a)| (a * c64::cis(w * time_s)).re)
            .sum::<f64>()
    }

    /// Returns `b^T P b`: the energy, J, counted by the meter after an impulse that sets the block
    /// coordinates to `b`, without drives.
    pub fn after_impulse_j(&self, b: &[f64]) -> f64 {
        self.quadratic_j(b)
    }

    /// Returns `y^T P y`, J.
    fn quadratic_j(&self, y: &[f64]) -> f64 {
        let Some(quadratic) = &self.quadratic else {
            return 0.0;
        };
        let column = |j: usize| {
            jounce_linalg::column(&quadratic.gramian, j)
                .iter()
                .zip(y)
                .map(|(p, y)| p * y)
                .sum::<f64>()
        };
        y.iter().enumerate().map(|(j, y)| y * column(j)).sum()
    }

    /// Returns the terms of the drives that are linear in time between breakpoints.
    pub fn signals(&self) -> &SignalMeter {
        &self.signals
    }

    /// Returns `P b` of a port: the row whose product with the force is integrated.
    pub fn port_row(&self, port: usize) -> &[f64] {
        &self.port_rows[port]
    }

    /// Returns the energy, J, that the contact force of one port adds to `[B]`, from `integral f (P
    /// b) . y dt` (J) and, per tone, `integral f e^{i w t} dt` (N s).
    pub fn contact_j(&self, port: usize, work_j: f64, impulse_n_s: &[c64]) -> f64 {
        2.0 * work_j
            - self.port_cross[port]
                .iter()
                .zip(impulse_n_s)
                .map(|(rb, f)| (rb * f).re)
                .sum::<f64>()
    }

    fn squares(plant: &Plant, quadratic: &Arc<Quadratic>) -> Self {
        // C = 2 Q S
        let forcings: Vec<Vec<c64>> = plant
            .tones
            .iter()
            .map(|tone| quadratic.slope(&tone.steady))
            .collect();
        let (mut mean, mut terms) = (0.0, Vec::new());
        for (forcing, k) in forcings.iter().zip(&plant.tones) {
            for l in &plant.tones {
                let (wk, wl) = (k.angular_frequency_rad_s, l.angular_frequency_rad_s);
                let sum: c64 = forcing
                    .iter()
                    .zip(&l.steady)
                    .map(|(c, s)| c * s * 0.25)
                    .sum();
                let difference: c64 = forcing
                    .iter()
                    .zip(&l.steady)
                    .map(|(c, s)| c * s.conj() * 0.25)
                    .sum();
                terms.push((wk + wl, sum / c64::new(0.0, wk + wl)));
                match wk == wl {
                    true => mean += difference.re,
                    false => terms.push((wk - wl, difference / c64::new(0.0, wk - wl))),
                }
            }
        }
        // A square contains a signal only through the state.
        let steady = vec![vec![c64::new(0.0, 0.0); plant.tones.len()]; plant.forcings.len()];
        let none = (vec![vec![0.0; plant.len()]; plant.forcings.len()], steady);
        Self::finish(
            plant,
            Some(Arc::clone(quadratic)),
            forcings,
            (mean, terms),
            none,
        )
    }

    /// Meter of `integral F(t) x_d'(t) dt`, summed over drives, and of the work of bases through
    /// the contacts between them.
    fn drive(plant: &Plant) -> Self {
        let n = plant.system.modes.len();
        let velocities = plant.diagonal.to_physical.view((n, 0), (n, plant.len()));
        let along = |tone: &Tone, j: usize| {
            tone.force
                .iter()
                .zip(velocities.column(j).iter())
                .map(|(g, v)| g * *v)
                .sum()
        };
        let forcings: Vec<Vec<c64>> = plant
            .tones
            .iter()
            .map(|tone| (0..plant.len()).map(|j| along(tone, j)).collect())
            .collect();
        let (mut mean, mut terms) = (0.0, Vec::new());
        for (forcing, tone) in forcings.iter().zip(&plant.tones) {
            for other in &plant.tones {
                let (wk, wl) = (tone.angular_frequency_rad_s, other.angular_frequency_rad_s);
                let sum: c64 = forcing
                    .iter()
                    .zip(&other.steady)
                    .map(|(g, s)| g * s * 0.5)
                    .sum();
                let difference: c64 = forcing
                    .iter()
                    .zip(&other.steady)
                    .map(|(g, s)| g * s.conj() * 0.5)
                    .sum();
                terms.push((wk + wl, sum / c64::new(0.0, wk + wl)));
                match wk == wl {
                    true => mean += difference.re,
                    false => terms.push((wk - wl, difference / c64::new(0.0, wk - wl))),
                }
            }
        }
        // A signal acts as a force on the state and on the steady motion.
        let speeds: Vec<Vec<f64>> = plant
            .system
            .signals
            .iter()
            .map(|signal| plant.signal_power_row(signal))
            .collect();
        let steady = speeds.iter().map(|row| plant.steady_output(row)).collect();
        let mut meter = Self::finish(plant, None, forcings, (mean, terms), (speeds, steady));
        // Bases also do work through the contacts between them: f Re(i w X e^{i w t}).
        for (cross, port) in meter.port_cross.iter_mut().zip(&plant.ports) {
            for ((rb, x), tone) in cross.iter_mut().zip(&port.approach_m).zip(&plant.tones) {
                *rb -= c64::new(0.0, tone.angular_frequency_rad_s) * x;
            }
        }
        meter
    }

    fn finish(
        plant: &Plant,
        quadratic: Option<Arc<Quadratic>>,
        forcings: Vec<Vec<c64>>,
        (mean, terms): (f64, Vec<(f64, c64)>),
        power: (Vec<Vec<f64>>, Vec<Vec<c64>>),
    ) -> Self {
        let cross: Vec<(f64, Vec<c64>)> = (plant.tones.iter().zip(forcings))
            .map(|(tone, forcing)| {
                let w = tone.angular_frequency_rad_s;
                // (i w I + A)^-1 = -((-i w) I - A)^-1
                let row = plant
                    .diagonal
                    .block
                    .resolve_row(c64::new(0.0, -w), &forcing);
                (w, row.into_iter().map(|r| -r).collect())
            })
            .collect();
        let tone_rows: Vec<&[c64]> = cross.iter().map(|(_, row)| &row[..]).collect();
        let product = |b: &[f64]| match &quadratic {
            Some(quadratic) => super::product(&quadratic.gramian, b),
            None => vec![0.0; b.len()],
        };
        Self {
            port_rows: plant
                .ports
                .iter()
                .map(|port| product(&port.force))
                .collect(),
            port_cross: (plant.ports.iter())
                .map(|port| {
                    cross
                        .iter()
                        .map(|(_, row)| crate::plant::coupled_plant::dot(&port.force, row))
                        .collect()
                })
                .collect(),
            signals: SignalMeter::new(plant, power, product, &tone_rows),
            quadratic,
            cross,
            steady_power_w: mean,
            steady_terms: terms,
        }
    }
}
