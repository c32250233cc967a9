//! Stabilisation diagram: poles that are stable as the order grows.

use serde::Serialize;

use super::Pole;

/// Comparison of a pole with those of the previous order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stability {
    /// No pole near it.
    New,
    /// One within 1 % in frequency.
    Frequency,
    /// One within 1 % in frequency and 5 % in damping; where the line spacing is too coarse for
    /// that, within a tenth of a line, up to 20 %.
    Pole,
}

/// Pole of the diagram.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StablePole {
    /// Order.
    pub order: usize,
    /// Pole.
    pub pole: Pole,
    /// Comparison with the previous order.
    pub stable: Stability,
}

/// Limits of the usual diagram.
const FREQUENCY_LIMIT: f64 = 0.01;
const DAMPING_LIMIT: f64 = 0.05;
/// Half-widths `zeta f` that differ by less than this share of a line are also equal, up to this
/// share of the damping.
const HALF_WIDTH_LINE_SHARE: f64 = 0.1;
const COARSE_DAMPING_LIMIT: f64 = 0.2;
/// Upper bound on the damping ratio of a mode.
pub(in crate::modal) const MAX_DAMPING: f64 = 0.2;
/// Relative distance below which stable poles belong to one mode.
pub(super) const SAME_MODE_DISTANCE: f64 = 2e-3;
/// Minimum share of the orders above its first in which a mode is stable in frequency, and of those
/// in which it is also stable in damping.
const MIN_ORDER_SHARE: f64 = 0.6;
const SAME_DAMPING_DISTANCE: f64 = 0.3;

/// Builds the diagram from the poles of each order from 1, found from lines `line_hz` apart.
pub fn diagram(poles: &[Vec<Pole>], line_hz: f64) -> Vec<StablePole> {
    let mut result = Vec::new();
    for (k, order) in poles.iter().enumerate() {
        let previous_poles: &[Pole] = k.checked_sub(1).map_or(&[], |previous| &poles[previous]);
        for pole in order.iter().filter(|pole| pole.damping_ratio < MAX_DAMPING) {
            let has_equal_frequency = |other: &&Pole| {
                (other.frequency_hz / pole.frequency_hz - 1.0).abs() <= FREQUENCY_LIMIT
            };
            let width_hz = pole.damping_ratio * pole.frequency_hz;
            let limit = (HALF_WIDTH_LINE_SHARE * line_hz / width_hz)
                .clamp(DAMPING_LIMIT, COARSE_DAMPING_LIMIT);
            let has_equal_damping =
                |other: &Pole| (other.damping_ratio / pole.damping_ratio - 1.0).abs() <= limit;
            let stable = match () {
                () if previous_poles
                    .iter()
                    .filter(has_equal_frequency)
                    .any(has_equal_damping) =>
                {
                    Stability::Pole
                }
                () if previous_poles
                    .iter()
                    .any(|other| has_equal_frequency(&other)) =>
                {
                    Stability::Frequency
                }
                () => Stability::New,
            };
            result.push(StablePole {
                order: k + 1,
                pole: *pole,
                stable,
            });
        }
    }
    result
}

/// Selects one pole for each mode: from every cluster of stable poles the middle one of its upper
/// orders. A cluster must be stable in most of the orders from its first, and in at least five.
pub(super) fn modes(diagram: &[StablePole], low_hz: f64, high_hz: f64) -> Vec<Pole> {
    let is_candidate = |p: &&StablePole| {
        p.stable != Stability::New && (low_hz..=high_hz).contains(&p.pole.frequency_hz)
    };
    let mut stable: Vec<&StablePole> = diagram.iter().filter(is_candidate).collect();
    stable.sort_by(|a, b| a.pole.frequency_hz.total_cmp(&b.pole.frequency_hz));
    let last = diagram.iter().map(|p| p.order).max().unwrap_or(0);
    let mut clusters: Vec<Vec<&StablePole>> = Vec::new();
    for pole in stable {
        let belongs = |cluster: &Vec<&StablePole>| {
            cluster.last().is_some_and(|p| {
                pole.pole.frequency_hz / p.pole.frequency_hz - 1.0 <= SAME_MODE_DISTANCE
            })
        };
        match clusters.last_mut().filter(|cluster| belongs(cluster)) {
            Some(cluster) => cluster.push(pole),
            None => clusters.push(vec![pole]),
        }
    }
    clusters
        .iter()
        .filter_map(|cluster| representative_pole(cluster, last))
        .collect()
}

fn representative_pole(cluster: &[&StablePole], last: usize) -> Option<Pole> {
    let first = cluster.iter().map(|p| p.order).min()?;
    let mut orders: Vec<usize> = cluster.iter().map(|p| p.order).collect();
    orders.sort_unstable();
    orders.dedup();
    if orders.len() < 5 || (orders.len() as f64) < MIN_ORDER_SHARE * (last + 1 - first) as f64 {
        return None;
    }
    let stable_count = cluster
        .iter()
        .filter(|p| p.stable == Stability::Pole)
        .count() as f64;
    if stable_count < SAME_DAMPING_DISTANCE * cluster.len() as f64 {
        return None;
    }
    let from = orders[orders.len() / 2];
    let mut upper: Vec<Pole> = cluster
        .iter()
        .filter(|p| p.order >= from)
        .map(|p| p.pole)
        .collect();
    upper.sort_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio));
    Some(upper[upper.len() / 2])
}
