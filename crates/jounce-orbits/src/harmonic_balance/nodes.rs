//! Force of a stop at the nodes of all its contacts.

use super::angles::Angles;
use super::contact::{ContactInterval, contacts};
use super::fourier_grid::FourierGrid;
use super::motion::{self, PortMotion};
use super::quadrature::QuadratureRules;
use jounce_linalg::c64;
use jounce_model::contact::Slopes;
use jounce_model::plant::{Plant, Stop};
use std::f64::consts::TAU;

/// Nodes per radian that the highest harmonic of interest rotates in a contact. Five eighths is the
/// minimum that distinguishes it from a lower one, because `dx / ds` is 5/4 in the middle of the
/// rule.
const NODES_PER_RADIAN: f64 = 0.64;

/// Additional nodes for the force.
const MIN_NODES: f64 = 16.0;

/// Quadrature node in contact.
#[derive(Debug, Clone, Copy)]
pub struct ContactNode {
    /// Angle of the period, rad.
    pub angle: f64,
    /// Weight in the mean over a period.
    pub share: f64,
    /// Rate of the penetration, m/s; 0 where the law does not depend on it.
    pub rate_m_s: f64,
    /// Force, N.
    pub force_n: f64,
    /// Slopes of the force.
    pub slopes: Slopes,
}

/// Nodes of every contact with one stop, and their angles.
#[derive(Debug)]
pub struct ContactQuadrature {
    /// Nodes.
    pub nodes: Vec<ContactNode>,
    /// Angles of the nodes.
    pub angles: Angles,
}

impl ContactQuadrature {
    /// Creates the nodes of a motion, dense enough for harmonics of the force up to `highest`.
    fn new(motion: &PortMotion, grid: &FourierGrid, rules: &QuadratureRules, highest: f64) -> Self {
        let (mut positions, mut entries) = (Vec::new(), Vec::new());
        for contact in contacts(motion, grid) {
            // The state at the start of the period sums the force before it: the rule must not
            // extend across.
            let parts = if contact.to > TAU {
                vec![(contact.from, TAU), (TAU, contact.to)]
            } else {
                vec![(contact.from, contact.to)]
            };
            parts
                .iter()
                .filter(|(from, to)| from < to)
                .for_each(|part| positions.extend(between(*part, rules, highest)));
            entries.extend(entry(motion, contact));
        }
        let inner = Angles::new(
            &positions
                .iter()
                .map(|(angle, _)| *angle)
                .collect::<Vec<f64>>(),
        );
        let [depths_m, rates_m_s] = motion.along(&inner);
        let node =
            |((angle, share), (depth_m, rate_m_s)): (&(f64, f64), (&f64, &f64))| ContactNode {
                angle: *angle,
                share: *share,
                rate_m_s: *rate_m_s,
                force_n: motion.law.force_n(*depth_m, *rate_m_s),
                slopes: motion.law.slopes(*depth_m, *rate_m_s),
            };
        let mut nodes: Vec<ContactNode> = positions
            .iter()
            .zip(depths_m.iter().zip(&rates_m_s))
            .map(node)
            .collect();
        if entries.is_empty() {
            return Self {
                nodes,
                angles: inner,
            };
        }
        nodes.append(&mut entries);
        let angles = Angles::new(&nodes.iter().map(|node| node.angle).collect::<Vec<f64>>());
        Self { nodes, angles }
    }

    /// Returns the nodes of every stop of a plant, at the harmonics of the displacements of the
    /// ports; `step_rad_s` is `w / p`.
    pub fn all(
        plant: &Plant,
        unknown: &[f64],
        step_rad_s: f64,
        (grid, rules): (&FourierGrid, &QuadratureRules),
        highest: f64,
    ) -> Vec<Self> {
        let stops = &plant.system.stops;
        let blocks = unknown.chunks_exact(unknown.len() / stops.len().max(1));
        let side = |(stop, block): (&Stop, &[f64])| {
            Self::new(
                &PortMotion::new(block, step_rad_s, stop.gap_m, stop.law),
                grid,
                rules,
                highest,
            )
        };
        stops.iter().zip(blocks).map(side).collect()
    }

    /// Returns the `c_n` of a force given at the nodes.
    pub fn harmonics(&self, highest: usize, force_n: impl Fn(&ContactNode) -> f64) -> Vec<c64> {
        self.gathered(
            &self
                .nodes
                .iter()
                .map(|node| node.share * force_n(node))
                .collect::<Vec<f64>>(),
            highest,
        )
    }

    /// Returns the `c_n` of a force given at the nodes with their weights included.
    pub fn gathered(&self, weights: &[f64], highest: usize) -> Vec<c64> {
        motion::harmonics(&self.angles.moments(weights, highest))
    }
}

/// Returns the angles of the nodes of an interval, with their weights.
fn between(
    (from, to): (f64, f64),
    rules: &QuadratureRules,
    highest: f64,
) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * (to - from);
    let rule = rules.at_least(MIN_NODES + NODES_PER_RADIAN * half * highest);
    rule.positions
        .iter()
        .zip(&rule.weights)
        .map(move |(position, weight)| (from + half * (1.0 + position), half * weight / TAU))
}

/// Returns the node for the edge of a force that starts with a jump: `dF = F(0, v) dd / v` per unit
/// of time, all at the edge.
fn entry(motion: &PortMotion, contact: ContactInterval) -> Option<ContactNode> {
    let (_, rate_m_s) = motion.at(contact.from);
    let jump_n = motion.law.force_n(0.0, rate_m_s);
    let stiffness_n_m = jump_n * motion.step_rad_s / rate_m_s;
    (jump_n > 0.0).then_some(ContactNode {
        angle: contact.from,
        share: 1.0 / TAU,
        rate_m_s,
        force_n: 0.0,
        slopes: Slopes {
            stiffness_n_m,
            damping_n_s_m: 0.0,
        },
    })
}
