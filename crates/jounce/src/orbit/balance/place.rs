//! The balance at one place of a curve.

use super::condensed::{Condensed, through};
use super::motion::{Motion, functions};
use super::nodes::{Node, nodes};
use super::rule::Rules;
use crate::continuation::Linear;
use crate::march::Kernel;
use crate::orbit::Shot;
use crate::orbit::compliance::{Grid, steady, transfer};
use faer::c64;
use std::cell::OnceCell;
use std::f64::consts::TAU;

/// The balance at one place.
#[derive(Debug)]
pub struct Balance {
    /// Value of the parameter.
    pub(super) parameter: f64,
    /// The harvester there.
    pub(super) kernel: Kernel,
    /// Harmonics of the force, N.
    pub(super) force: Vec<f64>,
    /// The period marched from the state that the forces give.
    pub(super) shot: OnceCell<Shot>,
    pub(super) by_parameter: Vec<f64>,
    unknown: Vec<f64>,
    step_rad_s: f64,
    compliance: Vec<c64>,
    nodes: Vec<Node>,
    residual: Vec<f64>,
    condensed: OnceCell<Condensed>,
}

impl Balance {
    /// With the harmonics of the displacement of the port, over a period of `cycles` of the drive.
    pub(super) fn new(kernel: Kernel, parameter: f64, unknown: &[f64], cycles: u32, grid: &Grid, rules: &Rules) -> Self {
        let plant = &kernel.plant;
        let step_rad_s = plant.tones.first().map_or(1.0, |tone| tone.angular_frequency_rad_s) / f64::from(cycles);
        let harmonics = unknown.len() / 2;
        let row = plant.ports.first().map_or_else(Vec::new, |port| port.displacement.clone());
        let compliance = transfer(&kernel, &row, cycles, harmonics);
        let nodes =
            plant.system.stops.first().map_or_else(Vec::new, |stop| {
                nodes(&Motion::new(unknown, step_rad_s, stop.gap_m, stop.law), grid, rules, harmonics as f64)
            });
        let mut force = vec![0.0; unknown.len()];
        let mut shape = vec![0.0; unknown.len()];
        for node in nodes.iter().filter(|node| node.force_n != 0.0) {
            functions(node.angle, &mut shape);
            force.iter_mut().zip(&shape).for_each(|(sum, value)| *sum += node.share * node.force_n * value);
        }
        let mut residual: Vec<f64> = through(&compliance, &force).zip(unknown).map(|(pushed, u)| pushed - u).collect();
        steady(plant, cycles, &mut residual);
        let by_parameter = vec![0.0; unknown.len()];
        let (unknown, shot, condensed) = (unknown.to_vec(), OnceCell::new(), OnceCell::new());
        Self { parameter, kernel, force, shot, by_parameter, unknown, step_rad_s, compliance, nodes, residual, condensed }
    }

    /// The periodic state at the start of the period, block coordinates without the steady part:
    ///
    /// ```text
    /// y = (I - e^(A T))^-1 int_0^T e^(A (T - t)) b F(t) dt
    /// ```
    ///
    /// All harmonics of the force are in it, those of the fastest mode too, which `d` may leave out because it hardly moves there.
    pub(super) fn state(&self, grid: &Grid, rules: &Rules) -> Vec<f64> {
        let plant = &self.kernel.plant;
        let block = &plant.diagonal.block;
        let mut state = vec![0.0; plant.len()];
        let (Some(port), Some(stop)) = (plant.ports.first(), plant.system.stops.first()) else { return state };
        let fastest_rad_s = block.pairs.iter().map(|pair| pair.eigenvalue().norm()).fold(0.0, f64::max);
        let highest = (fastest_rad_s / self.step_rad_s).max((self.unknown.len() / 2) as f64);
        let nodes = nodes(&Motion::new(&self.unknown, self.step_rad_s, stop.gap_m, stop.law), grid, rules, highest);
        let period_s = TAU / self.step_rad_s;
        for node in &nodes {
            let left_s = period_s * (1.0 - (node.angle / TAU).rem_euclid(1.0));
            let pushed = block.flow(left_s, &port.force);
            state.iter_mut().zip(pushed).for_each(|(sum, y)| *sum += node.share * period_s * node.force_n * y);
        }
        for (pair, y) in block.pairs.iter().zip(state.chunks_exact_mut(2)) {
            let [a, b, c, d] = pair.flow(period_s);
            let det = (1.0 - a) * (1.0 - d) - b * c;
            (y[0], y[1]) = (((1.0 - d) * y[0] + b * y[1]) / det, (c * y[0] + (1.0 - a) * y[1]) / det);
        }
        let paired = 2 * block.pairs.len();
        block.reals.iter().zip(&mut state[paired..]).for_each(|(rate, y)| *y /= -(rate * period_s).exp_m1());
        state
    }
}

impl Linear for Balance {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(&self, row: &[f64], corner: f64, right: &[f64], last: f64) -> Option<(Vec<f64>, f64)> {
        let condensed = self.condensed.get_or_init(|| Condensed::new(&self.nodes, &self.compliance, self.step_rad_s));
        condensed.bordered(&self.by_parameter, (row, corner), (right, last))
    }
}
