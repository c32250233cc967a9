//! Harmonic balance at one point of a curve.

use super::compliance::PortCompliance;
use super::condensed::{Condensed, CoupledNodes};
use super::fourier_grid::FourierGrid;
use super::impulses::after_impulses;
use super::nodes::{ContactNode, ContactQuadrature};
use super::quadrature::QuadratureRules;
use super::transfer_function::add_tone;
use crate::{ParameterDerivatives, ShootingEvaluation};
use jounce_continuation::{Linearization, ResidualReport};
use jounce_dynamics::Kernel;
use jounce_linalg::c64;
use jounce_model::plant::{BlockDiagonal, Port};
use std::cell::OnceCell;
use std::f64::consts::TAU;

/// Highest harmonic of the modes that are not taken at rest at the start of the period. A force
/// that starts like `t^1.5` and lasts a tenth of the period moves a faster mode by less than
/// `(0.2 pi 512)^-2.5 = 6e-7` of its impulse.
const MAX_MODE_HARMONIC: f64 = 512.0;

/// Harmonic balance at one point.
#[derive(Debug)]
pub struct BalanceEvaluation {
    /// Value of the parameter.
    pub(super) parameter: f64,
    /// Harvester at this parameter.
    pub(super) kernel: Kernel,
    /// Harmonics of the force of each stop, `c_n` in N.
    pub(super) forces: Vec<Vec<c64>>,
    /// `w / p`, rad/s.
    pub(super) step_rad_s: f64,
    /// Period integrated from the state that the forces give.
    pub(super) shot: OnceCell<ShootingEvaluation>,
    /// Distance from the curve of the exact flow, relative to the allowed one.
    pub(super) excess: OnceCell<f64>,
    pub(super) by_parameter: Vec<f64>,
    unknown: Vec<f64>,
    grid: FourierGrid,
    between: PortCompliance,
    sides: Vec<ContactQuadrature>,
    residual: Vec<f64>,
    condensed: OnceCell<Option<Condensed>>,
}

impl BalanceEvaluation {
    /// Evaluates the harmonics of the displacement of each port, over a period of `cycles` drive
    /// cycles.
    pub(super) fn new(
        kernel: Kernel,
        parameter: f64,
        unknown: &[f64],
        cycles: u32,
        grid: &FourierGrid,
        rules: &QuadratureRules,
    ) -> Self {
        let plant = &kernel.plant;
        let tone = plant.tones.first();
        let step_rad_s = tone.map_or(1.0, |tone| tone.angular_frequency_rad_s) / f64::from(cycles);
        let harmonics = unknown.len() / plant.system.stops.len().max(1) / 2;
        let between = PortCompliance::new(plant, step_rad_s, harmonics);
        let sides =
            ContactQuadrature::all(plant, unknown, step_rad_s, (grid, rules), harmonics as f64);
        let forces: Vec<Vec<c64>> = sides
            .iter()
            .map(|side| side.harmonics(harmonics, |node| node.force_n))
            .collect();
        let mut residual = between.apply(&forces);
        residual
            .iter_mut()
            .zip(unknown)
            .for_each(|(entry, u)| *entry -= u);
        if tone.is_some() {
            blocks_of(&plant.ports, &mut residual, &between)
                .for_each(|(_, port, block)| add_tone(port.steady_m[0], cycles, block));
        }
        if !plant.system.signals.is_empty() {
            let resting = plant.resting();
            blocks_of(&plant.ports, &mut residual, &between).for_each(|(_, port, block)| {
                block[0] += port
                    .displacement
                    .iter()
                    .zip(&resting)
                    .map(|(c, y)| c * y)
                    .sum::<f64>();
            });
        }
        let (by_parameter, unknown, grid) =
            (vec![0.0; unknown.len()], unknown.to_vec(), grid.clone());
        let (shot, excess, condensed) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Self {
            parameter,
            kernel,
            forces,
            step_rad_s,
            shot,
            excess,
            by_parameter,
            unknown,
            grid,
            between,
            sides,
            residual,
            condensed,
        }
    }

    /// Returns the number of nodes in contact, which is the size of Newton's linear system.
    pub fn nodes(&self) -> usize {
        self.sides.iter().map(|side| side.nodes.len()).sum()
    }

    /// Sets `dR / dp` at fixed harmonics of the displacements, where the change is known: changes
    /// of the drive, of the compliance with its frequency, and of the force at each node.
    pub(super) fn changed(&mut self, change: &ParameterDerivatives, cycles: u32) {
        let (drift, highest) = (&change.drift, self.between.harmonics());
        let frequency_rad_s = drift
            .tone_of(0, 0)
            .map_or(0.0, |(_, frequency_rad_s)| frequency_rad_s);
        let phase_rate_change = frequency_rad_s / (self.step_rad_s * f64::from(cycles));
        let direct_n = |stop: usize, node: &ContactNode| {
            let slopes = node.slopes;
            slopes.damping_n_s_m * node.rate_m_s * phase_rate_change
                - slopes.stiffness_n_m * drift.gap_of(stop)
                + drift.force_relative_of(stop) * node.force_n
        };
        let mut derivative = self
            .between
            .frequency_derivative(&self.forces, frequency_rad_s / f64::from(cycles));
        let sides = || self.sides.iter().enumerate();
        if sides().any(|(stop, side)| side.nodes.iter().any(|node| direct_n(stop, node) != 0.0)) {
            let block: Vec<Vec<c64>> = sides()
                .map(|(stop, side)| side.harmonics(highest, |node| direct_n(stop, node)))
                .collect();
            derivative
                .iter_mut()
                .zip(self.between.apply(&block))
                .for_each(|(derivative, block)| *derivative += block);
        }
        let tone = |stop: usize| {
            drift
                .tone_of(0, stop)
                .map_or(c64::new(0.0, 0.0), |(displaced_m, _)| displaced_m)
        };
        blocks_of(&self.kernel.plant.ports, &mut derivative, &self.between)
            .for_each(|(stop, _, block)| add_tone(tone(stop), cycles, block));
        self.by_parameter = derivative;
    }

    /// Returns the periodic state at the start of the period, block coordinates without the steady
    /// part:
    ///
    /// ```text
    /// y = y_0 + (I - e^(A T))^-1 int_0^T e^(A (T - t)) sum_b b F(t) dt
    /// ```
    ///
    /// `y_0` is the equilibrium under gravity. The sum includes the harmonics of the force at fast
    /// modes, also those above the last harmonic of the unknown.
    pub(super) fn state(&self, rules: &QuadratureRules) -> Vec<f64> {
        let plant = &self.kernel.plant;
        let block = &plant.diagonal.block;
        let orders = block
            .pairs
            .iter()
            .map(|pair| pair.eigenvalue().norm() / self.step_rad_s);
        let harmonics = self.between.harmonics() as f64;
        let most = MAX_MODE_HARMONIC.max(harmonics);
        let fastest = orders.fold(harmonics, f64::max).min(most);
        let period_s = TAU / self.step_rad_s;
        let mut state = vec![0.0; plant.len()];
        let sides = ContactQuadrature::all(
            plant,
            &self.unknown,
            self.step_rad_s,
            (&self.grid, rules),
            fastest,
        );
        for (port, ContactQuadrature { nodes, .. }) in plant.ports.iter().zip(sides) {
            let remaining_s: Vec<f64> = nodes
                .iter()
                .map(|node| period_s * (1.0 - (node.angle / TAU).rem_euclid(1.0)))
                .collect();
            let impulses_n_s: Vec<f64> = nodes
                .iter()
                .map(|node| node.share * period_s * node.force_n)
                .collect();
            let end_state = after_impulses(
                block,
                &port.force,
                most * self.step_rad_s,
                &remaining_s,
                &impulses_n_s,
            );
            state
                .iter_mut()
                .zip(end_state)
                .for_each(|(sum, y)| *sum += y);
        }
        make_periodic(block, period_s, &mut state);
        if !plant.system.signals.is_empty() {
            state
                .iter_mut()
                .zip(plant.resting())
                .for_each(|(y, resting)| *y += resting);
        }
        state
    }
}

/// Replaces the effect of the forces of one period by that of all periods: a state `y` by
/// `(I - e^(A T))^-1 y`, 0 for the motions of free bodies.
fn make_periodic(block: &BlockDiagonal, period_s: f64, state: &mut [f64]) {
    let free = block.free();
    for ((pair, y), free) in block
        .pairs
        .iter()
        .zip(state.chunks_exact_mut(2))
        .zip(free.chunks_exact(2))
    {
        if free[0] {
            (y[0], y[1]) = (0.0, 0.0);
            continue;
        }
        let [a, b, c, d] = pair.flow(period_s);
        let det = (1.0 - a) * (1.0 - d) - b * c;
        (y[0], y[1]) = (
            ((1.0 - d) * y[0] + b * y[1]) / det,
            (c * y[0] + (1.0 - a) * y[1]) / det,
        );
    }
    let paired = 2 * block.pairs.len();
    for ((rate, y), free) in block
        .reals
        .iter()
        .zip(&mut state[paired..])
        .zip(&free[paired..])
    {
        *y = if *free {
            0.0
        } else {
            *y / -(rate * period_s).exp_m1()
        };
    }
}

/// Returns the index, port and harmonics of each stop.
fn blocks_of<'h>(
    ports: &'h [Port],
    harmonics: &'h mut [f64],
    between: &PortCompliance,
) -> impl Iterator<Item = (usize, &'h Port, &'h mut [f64])> {
    let block = harmonics.chunks_exact_mut(between.size());
    ports
        .iter()
        .zip(block)
        .enumerate()
        .map(|(stop, (port, block))| (stop, port, block))
}

impl Linearization for BalanceEvaluation {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Reports the residual by harmonic of the drive, m rms.
    fn parts(&self) -> ResidualReport {
        let plant = &self.kernel.plant;
        let cycles = plant.tones.first().map_or(1.0, |tone| {
            (tone.angular_frequency_rad_s / self.step_rad_s).round()
        });
        let several = plant.system.stops.len() > 1;
        let sizes = self
            .residual
            .chunks_exact(self.between.size())
            .zip(&plant.system.stops)
            .flat_map(|(block, stop)| {
                let of = if several {
                    format!(" of stop.{}", stop.name)
                } else {
                    String::new()
                };
                let mean = (format!("the mean{of}"), block[0].abs());
                let name = move |n: usize| format!("harmonic {}{of}", n as f64 / cycles);
                std::iter::once(mean).chain(
                    block[1..]
                        .chunks_exact(2)
                        .enumerate()
                        .map(move |(k, pair)| (name(k + 1), pair[0].hypot(pair[1]))),
                )
            });
        ResidualReport {
            unit: "m rms",
            sizes: sizes.collect(),
        }
    }

    fn bordered(
        &self,
        row: &[f64],
        corner: f64,
        right: &[f64],
        last: f64,
    ) -> Option<(Vec<f64>, f64)> {
        let sides = CoupledNodes {
            each: &self.sides,
            between: &self.between,
            step_rad_s: self.step_rad_s,
        };
        let make = || {
            Condensed::new(
                sides,
                &self.between.responses(&self.grid),
                &self.by_parameter,
                (row, corner),
            )
        };
        self.condensed.get_or_init(make).as_ref()?.bordered(
            sides,
            &self.by_parameter,
            (row, corner),
            (right, last),
        )
    }
}
