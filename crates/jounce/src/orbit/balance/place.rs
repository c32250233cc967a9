//! The balance at one place of a curve.

use super::angles::Angles;
use super::condensed::{Condensed, Sides};
use super::impulses::after_impulses;
use super::motion::{self, Motion, real, through};
use super::nodes::{Node, nodes};
use super::response::Response;
use super::rule::Rules;
use crate::continuation::Linear;
use crate::march::Kernel;
use crate::orbit::compliance::{Grid, Transfer, add_tone};
use crate::orbit::{Change, Shot};
use faer::c64;
use std::cell::OnceCell;
use std::f64::consts::TAU;

/// Highest harmonic at which modes are told apart from rest at the start of the period: a force that starts like `t^1.5` and lasts
/// a tenth of the period moves a faster one by less than `(0.2 pi 512)^-2.5 = 6e-7` of its impulse.
const FASTEST: f64 = 512.0;

/// The balance at one place.
#[derive(Debug)]
pub struct Balance {
    /// Value of the parameter.
    pub(super) parameter: f64,
    /// The harvester there.
    pub(super) kernel: Kernel,
    /// Harmonics of the force, `c_n` in N.
    pub(super) force: Vec<c64>,
    /// `w / p`, rad/s.
    pub(super) step_rad_s: f64,
    /// The period marched from the state that the forces give.
    pub(super) shot: OnceCell<Shot>,
    /// Distance from the curve of the exact flow, beside the one allowed.
    pub(super) excess: OnceCell<f64>,
    pub(super) by_parameter: Vec<f64>,
    unknown: Vec<f64>,
    grid: Grid,
    compliance: Transfer,
    nodes: Vec<Node>,
    angles: Angles,
    residual: Vec<f64>,
    condensed: OnceCell<Option<Condensed>>,
}

impl Balance {
    /// With the harmonics of the displacement of the port, over a period of `cycles` of the drive.
    pub(super) fn new(kernel: Kernel, parameter: f64, unknown: &[f64], cycles: u32, grid: &Grid, rules: &Rules) -> Self {
        let plant = &kernel.plant;
        let tone = plant.tones.first();
        let step_rad_s = tone.map_or(1.0, |tone| tone.angular_frequency_rad_s) / f64::from(cycles);
        let (size, harmonics) = (unknown.len(), unknown.len() / 2);
        let row = plant.ports.first().map_or_else(Vec::new, |port| port.displacement.clone());
        let compliance = Transfer::new(plant, &row, step_rad_s, harmonics);
        let (nodes, angles) = match plant.system.stops.first() {
            Some(stop) => nodes(&Motion::new(unknown, step_rad_s, stop.gap_m, stop.law), grid, rules, harmonics as f64),
            None => (Vec::new(), Angles::new(&[])),
        };
        let force = gathered(&nodes, &angles, harmonics, |node| node.force_n);
        let mut residual = real(&through(&compliance.values, &force));
        residual.iter_mut().zip(unknown).for_each(|(pushed, u)| *pushed -= u);
        if let Some((port, _)) = plant.ports.first().zip(tone) {
            add_tone(port.steady_m[0], cycles, &mut residual);
        }
        let (by_parameter, unknown, grid) = (vec![0.0; size], unknown.to_vec(), grid.clone());
        let (shot, excess, condensed) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Self {
            parameter,
            kernel,
            force,
            step_rad_s,
            shot,
            excess,
            by_parameter,
            unknown,
            grid,
            compliance,
            nodes,
            angles,
            residual,
            condensed,
        }
    }

    /// Nodes in contact: the size of Newton's linear system.
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// `dR / dp` at fixed harmonics of the displacement, where the change is known: of the drive, of the compliance with its
    /// frequency, and of the force at each node.
    pub(super) fn changed(&mut self, change: &Change, cycles: u32) {
        let drift = &change.drift;
        let (displaced_m, frequency_rad_s) = drift.tone_of(0, 0).unwrap_or_default();
        let hastened = frequency_rad_s / (self.step_rad_s * f64::from(cycles));
        let own_n = |node: &Node| {
            let slopes = node.slopes;
            slopes.damping_n_s_m * node.rate_m_s * hastened - slopes.stiffness_n_m * drift.gap_of(0)
                + drift.force_relative_of(0) * node.force_n
        };
        let slide = frequency_rad_s / f64::from(cycles);
        let slid: Vec<c64> = self.compliance.slopes.iter().enumerate().map(|(n, slope)| slope * c64::new(0.0, n as f64 * slide)).collect();
        let mut moved = through(&slid, &self.force);
        if self.nodes.iter().any(|node| own_n(node) != 0.0) {
            let own = gathered(&self.nodes, &self.angles, self.unknown.len() / 2, own_n);
            moved.iter_mut().zip(through(&self.compliance.values, &own)).for_each(|(moved, own)| *moved += own);
        }
        let mut by_parameter = real(&moved);
        add_tone(displaced_m, cycles, &mut by_parameter);
        self.by_parameter = by_parameter;
    }

    /// The periodic state at the start of the period, block coordinates without the steady part:
    ///
    /// ```text
    /// y = (I - e^(A T))^-1 int_0^T e^(A (T - t)) b F(t) dt
    /// ```
    ///
    /// All harmonics of the force are in it, those of fast modes too, which `d` may leave out because it hardly moves there.
    pub(super) fn state(&self, rules: &Rules) -> Vec<f64> {
        let plant = &self.kernel.plant;
        let block = &plant.diagonal.block;
        let (Some(port), Some(stop)) = (plant.ports.first(), plant.system.stops.first()) else { return vec![0.0; plant.len()] };
        let order = |rate_rad_s: f64| rate_rad_s / self.step_rad_s;
        let orders = block.pairs.iter().map(|pair| order(pair.eigenvalue().norm()));
        let harmonics = (self.unknown.len() / 2) as f64;
        let fastest = orders.fold(harmonics, f64::max).min(FASTEST.max(harmonics));
        let (nodes, _) = nodes(&Motion::new(&self.unknown, self.step_rad_s, stop.gap_m, stop.law), &self.grid, rules, fastest);
        let period_s = TAU / self.step_rad_s;
        let left_s: Vec<f64> = nodes.iter().map(|node| period_s * (1.0 - (node.angle / TAU).rem_euclid(1.0))).collect();
        let impulses_n_s: Vec<f64> = nodes.iter().map(|node| node.share * period_s * node.force_n).collect();
        let mut state = after_impulses(block, &port.force, &left_s, &impulses_n_s);
        for (pair, y) in block.pairs.iter().zip(state.chunks_exact_mut(2)) {
            if order(pair.eigenvalue().norm()) > fastest {
                (y[0], y[1]) = (0.0, 0.0);
                continue;
            }
            let [a, b, c, d] = pair.flow(period_s);
            let det = (1.0 - a) * (1.0 - d) - b * c;
            (y[0], y[1]) = (((1.0 - d) * y[0] + b * y[1]) / det, (c * y[0] + (1.0 - a) * y[1]) / det);
        }
        let paired = 2 * block.pairs.len();
        block
            .reals
            .iter()
            .zip(&mut state[paired..])
            .for_each(|(rate, y)| *y = if *rate == 0.0 { 0.0 } else { *y / -(rate * period_s).exp_m1() });
        state
    }
}

/// Harmonics of a force given at the nodes.
fn gathered(nodes: &[Node], angles: &Angles, harmonics: usize, force_n: impl Fn(&Node) -> f64) -> Vec<c64> {
    let weights: Vec<f64> = nodes.iter().map(|node| node.share * force_n(node)).collect();
    motion::harmonics(&angles.moments(&weights, harmonics))
}

impl Linear for Balance {
    fn residual(&self) -> &[f64] {
        &self.residual
    }

    fn bordered(&self, row: &[f64], corner: f64, right: &[f64], last: f64) -> Option<(Vec<f64>, f64)> {
        let Self { nodes, angles, step_rad_s, .. } = self;
        let sides = Sides { nodes, angles, compliance: &self.compliance.values, step_rad_s: *step_rad_s };
        let make = || Condensed::new(sides, &Response::new(&self.compliance.values, &self.grid), &self.by_parameter, (row, corner));
        self.condensed.get_or_init(make).as_ref()?.bordered(sides, &self.by_parameter, (row, corner), (right, last))
    }
}
