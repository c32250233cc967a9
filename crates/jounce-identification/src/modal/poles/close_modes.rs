//! Separates close modes that a stabilisation diagram shows as one.
//!
//! With one reference, two modes of equal frequency appear as one; several references can separate
//! as many modes as there are references. Where most of the upper orders of the diagram contain
//! several poles at one frequency, each of them is an initial mode.

use super::stabilisation::Stability;
use super::{Pole, StablePole};

/// Maximum relative frequency distance of poles that belong to a mode and are nearest to it.
const MAX_FREQUENCY_DISTANCE: f64 = 5e-3;
/// Maximum ratio between the damping ratios of close modes.
const MAX_DAMPING_RATIO: f64 = 3.0;
/// Minimum share of the upper orders that contain so many poles.
const MIN_ORDER_SHARE: f64 = 0.6;

/// Returns the initial poles; each that represents several close ones is replaced by them, at most
/// `max_count` at one frequency.
pub(in crate::modal) fn split_close_modes(
    diagram: &[StablePole],
    start: &[Pole],
    max_count: usize,
) -> Vec<Pole> {
    let last = diagram.iter().map(|found| found.order).max().unwrap_or(0);
    let mut poles: Vec<Pole> = start
        .iter()
        .flat_map(|pole| poles_near(diagram, start, *pole, max_count, last))
        .collect();
    poles.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    poles
}

fn poles_near(
    diagram: &[StablePole],
    start: &[Pole],
    pole: Pole,
    max_count: usize,
    last: usize,
) -> Vec<Pole> {
    let distance = |a: Pole, b: Pole| (a.frequency_hz / b.frequency_hz - 1.0).abs();
    let is_near = |found: &&StablePole| {
        let (pole_distance, ratio) = (
            distance(found.pole, pole),
            found.pole.damping_ratio / pole.damping_ratio,
        );
        found.stable != Stability::New
            && pole_distance <= MAX_FREQUENCY_DISTANCE
            && start
                .iter()
                .all(|other| pole_distance <= distance(found.pole, *other))
            && (1.0 / MAX_DAMPING_RATIO..MAX_DAMPING_RATIO).contains(&ratio)
    };
    let mut of_order: Vec<Vec<Pole>> = vec![Vec::new(); last + 1];
    diagram
        .iter()
        .filter(is_near)
        .for_each(|found| of_order[found.order].push(found.pole));
    let Some(first) = of_order.iter().position(|poles| !poles.is_empty()) else {
        return vec![pole];
    };
    let upper = &of_order[first.midpoint(last)..];
    let is_frequent = |count: usize| {
        upper.iter().filter(|poles| poles.len() >= count).count() as f64
            >= MIN_ORDER_SHARE * upper.len() as f64
    };
    let Some(count) = (2..=max_count).rev().find(|count| is_frequent(*count)) else {
        return vec![pole];
    };
    // The middle one of the orders with exactly this number of poles; else the first of those with
    // more.
    let of_equal_count: Vec<&Vec<Pole>> =
        upper.iter().filter(|poles| poles.len() == count).collect();
    of_equal_count
        .get(of_equal_count.len() / 2)
        .map_or_else(|| vec![pole], |poles| poles.to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(order: usize, frequency_hz: f64) -> StablePole {
        StablePole {
            order,
            pole: Pole {
                frequency_hz,
                damping_ratio: 0.01,
            },
            stable: Stability::Pole,
        }
    }

    /// Two poles in most of the upper orders are two modes; an occasional second one is noise.
    #[test]
    fn two_near_poles_in_most_orders_are_two_modes() {
        let start = [
            Pole {
                frequency_hz: 50.0,
                damping_ratio: 0.01,
            },
            Pole {
                frequency_hz: 80.0,
                damping_ratio: 0.01,
            },
        ];
        let two_poles = (5..=20)
            .flat_map(|order| [found(order, 49.98), found(order, 50.03), found(order, 80.0)]);
        let occasional_pole = (5..=20)
            .filter(|order| order % 3 == 0)
            .map(|order| found(order, 80.1));
        let diagram: Vec<StablePole> = two_poles.chain(occasional_pole).collect();
        let frequencies: Vec<f64> = split_close_modes(&diagram, &start, 2)
            .iter()
            .map(|pole| pole.frequency_hz)
            .collect();
        assert_eq!(frequencies, [49.98, 50.03, 80.0]);
        assert_eq!(split_close_modes(&diagram, &start, 1).len(), 2);
    }
}
