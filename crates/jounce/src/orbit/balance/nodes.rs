//! The force at the nodes of all contacts.

use super::contact::{Contact, contacts};
use super::motion::Motion;
use super::rule::Rules;
use crate::contact::Slopes;
use crate::orbit::compliance::Grid;
use std::f64::consts::TAU;

/// Nodes per radian that the highest harmonic of interest turns through in a contact: a quarter of `pi` is the least that can tell
/// it from a lower one.
const PER_RADIAN: f64 = 0.8;

/// Nodes beside that, for the force itself.
const LEAST: f64 = 16.0;

/// A node.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// Angle of the period, rad.
    pub angle: f64,
    /// Weight in the mean over a period.
    pub share: f64,
    /// Rate of the penetration, m/s.
    pub rate_m_s: f64,
    /// Force, N.
    pub force_n: f64,
    /// Its slopes.
    pub slopes: Slopes,
}

/// Nodes of every contact of a motion, which tell apart harmonics of the force up to `highest`.
pub fn nodes(motion: &Motion, grid: &Grid, rules: &Rules, highest: f64) -> Vec<Node> {
    let mut found = Vec::new();
    for contact in contacts(motion, grid) {
        // The state at the start of the period sums what came before it: the rule must not run across.
        let parts = if contact.to > TAU { vec![(contact.from, TAU), (TAU, contact.to)] } else { vec![(contact.from, contact.to)] };
        parts.iter().filter(|(from, to)| from < to).for_each(|part| found.extend(between(motion, *part, rules, highest)));
        found.extend(entry(motion, contact));
    }
    found
}

fn between(motion: &Motion, (from, to): (f64, f64), rules: &Rules, highest: f64) -> impl Iterator<Item = Node> {
    let half = 0.5 * (to - from);
    let rule = rules.at_least(LEAST + PER_RADIAN * half * highest);
    rule.places.iter().zip(&rule.weights).map(move |(place, weight)| {
        let angle = from + half * (1.0 + place);
        let (depth_m, rate_m_s) = motion.at(angle);
        let force_n = motion.law.force_n(depth_m, rate_m_s);
        Node { angle, share: half * weight / TAU, rate_m_s, force_n, slopes: motion.law.slopes(depth_m, rate_m_s) }
    })
}

/// A force that starts with a jump moves with its edge: `dF = F(0, v) dd / v` per unit of time, all of it at the edge.
fn entry(motion: &Motion, contact: Contact) -> Option<Node> {
    let (_, rate_m_s) = motion.at(contact.from);
    let jump_n = motion.law.force_n(0.0, rate_m_s);
    let stiffness_n_m = jump_n * motion.step_rad_s / rate_m_s;
    (jump_n > 0.0).then_some(Node {
        angle: contact.from,
        share: 1.0 / TAU,
        rate_m_s,
        force_n: 0.0,
        slopes: Slopes { stiffness_n_m, damping_n_s_m: 0.0 },
    })
}
