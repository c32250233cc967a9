//! Harmonic balance, condensed to the port (alternating frequency/time).
//!
//! ```text
//! R(d, p) = d_steady + K F(d - gap, d') - d,   K = DFT^-1 G DFT
//! ```
//!
//! The unknowns are the displacements of the port at equal times, as many as harmonics can be told apart; the plant enters by its
//! exact compliance `G` alone, however many modes it has. `F` has slopes while the point is in contact only, so that Newton's
//! linear system is solved at the samples in contact: with `J`, `J'` the slopes and `K'` the same operator to the velocity,
//!
//! ```text
//! (I - J K - J' K')_cc x_c = J r + J' r',   dd = K x + r
//! ```
//!
//! The error estimate comes from outside: the exact flow is marched over a period from the state that the harmonics give, and the
//! Newton correction of that flow is the distance to the orbit. It sees truncation and aliasing at once, whatever the law makes of
//! the tail of the spectrum (`n^-2.5` for Hertz, where an estimate that expects geometric decay would be wrong).
//!
//! Validation: `tests/orbits/balance.rs` compares with shooting.

use super::compliance::{Grid, steady_m, transfer};
use super::{Harvester, Orbit, OrbitError, OrbitMethod, Shooting, Shot, nearest_extremum_m};
use crate::contact::{ContactLaw, Law, Slopes};
use crate::continuation::{Family, Linear};
use crate::march::Kernel;
use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use std::cell::OnceCell;

/// Orbits of a harvester by harmonic balance.
#[derive(Debug)]
pub struct HarmonicBalance<'h, H> {
    /// Shooting on the same harvesters, for stability and for the error.
    pub shooting: Shooting<'h, H>,
    grid: Grid,
}

/// The balance at one place.
#[derive(Debug)]
pub struct Balance {
    parameter: f64,
    /// `w / p`, rad/s.
    step_rad_s: f64,
    kernel: Kernel,
    grid: Grid,
    /// `G` and `i n w / p G`.
    compliance: Vec<c64>,
    mobility: Vec<c64>,
    force_n: Vec<f64>,
    slopes: Vec<Slopes>,
    rate_dependent: bool,
    residual: Vec<f64>,
    by_parameter: Vec<f64>,
    shot: OnceCell<Shot>,
}

impl<'h, H: Harvester> HarmonicBalance<'h, H> {
    /// On `samples` (even) equal times of a period.
    ///
    /// # Errors
    /// [`OrbitError::Impulsive`] for a rigid stop.
    pub fn new(shooting: Shooting<'h, H>, kernel: &Kernel, samples: usize) -> Result<Self, OrbitError<H::Error>> {
        match kernel.plant.system.stops.first() {
            Some(stop) if matches!(stop.law, Law::Rigid(_)) => Err(OrbitError::Impulsive { stop: stop.name.clone() }),
            _ => Ok(Self { shooting, grid: Grid::new(samples) }),
        }
    }

    /// Samples per period.
    pub fn samples(&self) -> usize {
        self.grid.samples
    }

    /// The same unknown on another grid, by its harmonics.
    pub fn resampled(&self, unknown: &[f64], samples: usize) -> Vec<f64> {
        let mut coefficients = self.grid.coefficients(unknown);
        coefficients.resize(samples / 2 + 1, c64::new(0.0, 0.0));
        Grid::new(samples).values(&coefficients)
    }

    fn balance(&self, unknown: &[f64], parameter: f64) -> Result<Balance, OrbitError<H::Error>> {
        let kernel = self.shooting.harvester.at(parameter).map_err(OrbitError::Harvester)?.kernel;
        let plant = &kernel.plant;
        let [tone] = &plant.tones[..] else {
            return Err(OrbitError::Frequencies { frequencies: plant.tones.len() });
        };
        let (cycles, samples) = (self.shooting.cycles, self.grid.samples);
        let step = tone.angular_frequency_rad_s / f64::from(cycles);
        let row = plant.ports.first().map_or_else(|| vec![0.0; plant.len()], |port| port.displacement.clone());
        let compliance = transfer(&kernel, &row, cycles, samples);
        let mobility: Vec<c64> = compliance.iter().enumerate().map(|(n, g)| g * c64::new(0.0, n as f64 * step)).collect();
        let spectrum = self.grid.coefficients(unknown);
        let speeds: Vec<c64> = spectrum.iter().enumerate().map(|(n, d)| d * c64::new(0.0, n as f64 * step)).collect();
        let speed = self.grid.values(&speeds);
        let stop = plant.system.stops.first();
        let (gap_m, law) = stop.map_or((f64::INFINITY, None), |stop| (stop.gap_m, Some(stop.law)));
        let at = |k: usize| (unknown[k] - gap_m, speed[k]);
        let none = Slopes { stiffness_n_m: 0.0, damping_n_s_m: 0.0 };
        let (force_n, slopes) = (0..samples)
            .map(|k| match (at(k), law) {
                ((depth, rate), Some(law)) if depth > 0.0 => (law.force_n(depth, rate), slopes_of(law, depth, rate)),
                _ => (0.0, none),
            })
            .unzip::<f64, Slopes, Vec<_>, Vec<_>>();
        let pushed = self.grid.through(&compliance, &force_n);
        let steady = steady_m(&kernel, cycles, samples);
        let residual = (0..samples).map(|k| steady[k] + pushed[k] - unknown[k]).collect();
        let rate_dependent = matches!(law, Some(Law::KelvinVoigt(_) | Law::HuntCrossley(_)));
        let grid = self.grid.clone();
        let (by_parameter, shot) = (vec![0.0; samples], OnceCell::new());
        Ok(Balance {
            parameter,
            step_rad_s: step,
            kernel,
            grid,
            compliance,
            mobility,
            force_n,
            slopes,
            rate_dependent,
            residual,
            by_parameter,
            shot,
        })
    }

    /// The period marched from the state that the harmonics give.
    fn shot<'b>(&self, local: &'b Balance) -> Result<&'b Shot, OrbitError<H::Error>> {
        if let Some(shot) = local.shot.get() {
            return Ok(shot);
        }
        let shot = self.shooting.at(&self.state(local), local.parameter)?;
        Ok(local.shot.get_or_init(|| shot))
    }

    /// State at the start of the period, energy coordinates: steady part and the sum of all harmonics of the force.
    fn state(&self, local: &Balance) -> Vec<f64> {
        let plant = &local.kernel.plant;
        let (Some(tone), Some(port)) = (plant.tones.first(), plant.ports.first()) else {
            return self.shooting.unknown(&plant.to_physical(&vec![0.0; plant.len()], 0.0));
        };
        let column: Vec<c64> = port.force.iter().map(|b| c64::new(*b, 0.0)).collect();
        let step = tone.angular_frequency_rad_s / f64::from(self.shooting.cycles);
        let mut state = vec![0.0; plant.len()];
        let last = self.grid.samples / 2;
        for (n, f) in local.grid.coefficients(&local.force_n).iter().enumerate() {
            let share = if n == 0 || n == last { 1.0 } else { 2.0 };
            let response = plant.diagonal.block.resolve(c64::new(0.0, n as f64 * step), &column);
            state.iter_mut().zip(response).for_each(|(sum, y)| *sum += share * (y * f).re);
        }
        self.shooting.unknown(&plant.to_physical(&state, 0.0))
    }

    /// Mean power of each load, W: `sum_n |V_n|^2 / R` over all harmonics of the voltage.
    fn loads_w(&self, local: &Balance) -> Vec<f64> {
        let plant = &local.kernel.plant;
        let names: Vec<&String> = plant.system.modes.patch.keys().collect();
        let force = local.grid.coefficients(&local.force_n);
        let cycles = self.shooting.cycles as usize;
        (plant.system.loads.iter())
            .map(|load| {
                let Some(patch) = names.iter().position(|name| **name == load.patch) else { return 0.0 };
                let row = plant.voltage_row(patch);
                let steady = plant.steady_output(&row);
                let through = transfer(&local.kernel, &row, self.shooting.cycles, local.grid.samples);
                let square: f64 = (through.iter().zip(&force).enumerate())
                    .map(|(n, (g, f))| {
                        let driven = if n == cycles { steady.iter().sum::<c64>() * 0.5 } else { c64::new(0.0, 0.0) };
                        let share = if n == 0 { 1.0 } else { 2.0 };
                        share * (g * f + driven).norm_sqr()
                    })
                    .sum();
                let alone = if through.is_empty() { steady.iter().map(|v| 0.5 * v.norm_sqr()).sum() } else { square };
                alone / load.resistance_ohm
            })
            .collect()
    }
}

fn slopes_of(law: Law, depth: f64, rate: f64) -> Slopes {
    match law {
        Law::Hertz(law) => law.slopes(depth, rate),
        Law::KelvinVoigt(law) => law.slopes(depth, rate),
        Law::HuntCrossley(law) => law.slopes(depth, rate),
        Law::Rigid(_) => Slopes { stiffness_n_m: 0.0, damping_n_s_m: 0.0 },
    }
}

impl<H: Harvester> Family for HarmonicBalance<'_, H> {
    type Local = Balance;
    type Error = OrbitError<H::Error>;

    fn at(&self, unknown: &[f64], parameter: f64) -> Result<Balance, Self::Error> {
        let mut local = self.balance(unknown, parameter)?;
        let step = self.shooting.harvester.difference();
        let ahead = self.balance(unknown, parameter + step)?;
        local.by_parameter = ahead.residual.iter().zip(&local.residual).map(|(a, b)| (a - b) / step).collect();
        Ok(local)
    }
}

impl<H: Harvester> OrbitMethod for HarmonicBalance<'_, H> {
    type Fault = H::Error;

    fn cycles(&self) -> u32 {
        self.shooting.cycles
    }

    fn orbit(&self, local: &Balance, error: f64) -> Result<Orbit, Self::Error> {
        let shot = self.shot(local)?;
        let mut orbit = self.shooting.orbit(shot, error)?;
        let loads_w = self.loads_w(local);
        orbit.mean_power_w = loads_w.iter().sum();
        let first = loads_w.first().zip(local.kernel.plant.system.loads.first());
        orbit.voltage_rms_v = first.map_or(0.0, |(power_w, load)| (power_w * load.resistance_ohm).sqrt());
        let size = shot.looks[0].iter().map(|u| u * u).sum::<f64>().sqrt();
        let right: Vec<f64> = shot.residual().iter().map(|r| -r).collect();
        let fixed = vec![0.0; right.len()];
        let distance =
            shot.bordered(&fixed, 1.0, &right, 0.0).map_or(f64::INFINITY, |(change, _)| change.iter().map(|d| d * d).sum::<f64>().sqrt());
        orbit.error_estimate = error + distance / size.max(f64::MIN_POSITIVE);
        Ok(orbit)
    }

    fn contacts(&self, local: &Balance) -> Result<u64, Self::Error> {
        Ok(self.shot(local)?.contacts)
    }

    fn nearest_extremum_m(&self, local: &Balance) -> Result<Option<f64>, Self::Error> {
        Ok(nearest_extremum_m(self.shot(local)?))
    }

    fn scale_m(&self, local: &Balance) -> f64 {
        local.kernel.plant.scale_m()
    }

    fn unknown_of(&self, state: &[f64], parameter: f64) -> Result<Vec<f64>, Self::Error> {
        let shot = self.shooting.at(state, parameter)?;
        Ok(shot.displacements_m(self.grid.samples))
    }
}

impl Linear for Balance {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(&self, row: &[f64], corner: f64, right: &[f64], last: f64) -> Option<(Vec<f64>, f64)> {
        // Forces x at the samples in contact and dp:  dd = K x + by dp - right.
        let contact: Vec<usize> =
            (0..self.slopes.len()).filter(|k| self.slopes[*k].stiffness_n_m != 0.0 || self.slopes[*k].damping_n_s_m != 0.0).collect();
        let (m, count) = (contact.len(), self.grid.samples);
        let unit: Vec<f64> = (0..count).map(|k| f64::from(u8::from(k == 0))).collect();
        let place = self.grid.through(&self.compliance, &unit);
        let speed = if self.rate_dependent { self.grid.through(&self.mobility, &unit) } else { Vec::new() };
        let back: Vec<c64> = self.compliance.iter().map(|g| g.conj()).collect();
        let row_back = self.grid.through(&back, row);
        let (by, right_slope) = if self.rate_dependent {
            (self.slope_in_time(&self.by_parameter), self.slope_in_time(right))
        } else {
            (vec![0.0; count], vec![0.0; count])
        };
        let column_size = self.by_parameter.iter().fold(f64::MIN_POSITIVE, |max, b| max.max(b.abs()));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let bottom = dot(row, &self.by_parameter) + corner;
        let force_size = contact.iter().map(|k| self.slopes[*k].stiffness_n_m.abs()).fold(f64::MIN_POSITIVE, f64::max);
        let row_size = contact.iter().map(|k| (row_back[*k] * force_size).abs()).fold((bottom / column_size).abs(), f64::max);
        let matrix = Mat::from_fn(m + 1, m + 1, |i, j| {
            let slope = |i: usize| self.slopes[contact[i]];
            match (i < m, j < m) {
                (true, true) => {
                    let lag = (contact[i] + count - contact[j]) % count;
                    let felt =
                        slope(i).stiffness_n_m * place[lag] + if self.rate_dependent { slope(i).damping_n_s_m * speed[lag] } else { 0.0 };
                    f64::from(u8::from(i == j)) - felt
                }
                (true, false) => {
                    -(slope(i).stiffness_n_m * self.by_parameter[contact[i]] + slope(i).damping_n_s_m * by[contact[i]])
                        / (column_size * force_size)
                }
                (false, true) => row_back[contact[j]] * force_size / row_size,
                (false, false) => bottom / (column_size * row_size),
            }
        });
        let sides = Mat::from_fn(m + 1, 1, |i, _| {
            if i == m {
                return (last + dot(row, right)) / row_size;
            }
            let (k, slope) = (contact[i], self.slopes[contact[i]]);
            -(slope.stiffness_n_m * right[k] + slope.damping_n_s_m * right_slope[k]) / force_size
        });
        let solution = matrix.partial_piv_lu().solve(&sides);
        let parameter = solution[(m, 0)] / column_size;
        let mut force = vec![0.0; count];
        contact.iter().enumerate().for_each(|(i, k)| force[*k] = solution[(i, 0)] * force_size);
        let pushed = self.grid.through(&self.compliance, &force);
        let unknown: Vec<f64> = (0..count).map(|k| pushed[k] + self.by_parameter[k] * parameter - right[k]).collect();
        (parameter.is_finite() && unknown.iter().all(|u| u.is_finite())).then_some((unknown, parameter))
    }
}

impl Balance {
    /// Derivative in time of values on the grid.
    fn slope_in_time(&self, values: &[f64]) -> Vec<f64> {
        let step = self.step_rad_s;
        let turned: Vec<c64> = self.grid.coefficients(values).iter().enumerate().map(|(n, v)| v * c64::new(0.0, n as f64 * step)).collect();
        self.grid.values(&turned)
    }
}
