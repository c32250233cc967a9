//! Modes of independent structures, merged in ascending frequency; a structure is at rest in the
//! modes of the others.

use crate::structure::modes::{Modes, PatchModes};

/// Origin of each merged mode: `(part, mode of the part)`.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::structure) struct ModeOrder(Vec<(usize, usize)>);

impl ModeOrder {
    /// Merges in ascending frequency; at equal frequencies the earlier part comes first.
    pub fn ascending(frequencies: &[&[f64]]) -> Self {
        let of_part = |(part, list): (usize, &&[f64])| {
            (0..list.len())
                .map(move |mode| (part, mode))
                .collect::<Vec<_>>()
        };
        let mut order: Vec<_> = frequencies.iter().enumerate().flat_map(of_part).collect();
        order.sort_by(|one, other| {
            frequencies[one.0][one.1].total_cmp(&frequencies[other.0][other.1])
        });
        Self(order)
    }

    /// Returns the first `modes` merged modes.
    pub fn first(mut self, modes: usize) -> Self {
        self.0.truncate(modes);
        self
    }

    /// Number of merged modes.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the required number of modes of `part`.
    pub fn needed(&self, part: usize) -> usize {
        self.0.iter().filter(|(of, _)| *of == part).count()
    }

    /// Returns the index of a mode of a part among the merged modes.
    pub fn index_of(&self, part: usize, mode: usize) -> Option<usize> {
        self.0.iter().position(|entry| *entry == (part, mode))
    }

    /// Distributes one value per mode of `part` over the merged modes; zero in the modes of other
    /// parts.
    pub fn spread(&self, part: usize, values: &[f64]) -> Vec<f64> {
        self.0
            .iter()
            .map(|(of, mode)| if *of == part { values[*mode] } else { 0.0 })
            .collect()
    }

    /// Returns the value of each merged mode, from one list per part.
    pub fn gather(&self, values: &[&[f64]]) -> Vec<f64> {
        self.0
            .iter()
            .map(|(part, mode)| values[*part][*mode])
            .collect()
    }
}

/// Returns all modes of several structures, and their order.
pub(in crate::structure) fn merged(parts: &[Modes]) -> (ModeOrder, Modes) {
    let lists = |list: fn(&Modes) -> &[f64]| parts.iter().map(list).collect::<Vec<_>>();
    let frequencies = lists(|part| &part.frequency_rad_s);
    let order = ModeOrder::ascending(&frequencies);
    let mut modes = Modes {
        frequency_rad_s: order.gather(&frequencies),
        damping_ratio: order.gather(&lists(|part| &part.damping_ratio)),
        participation_sqrt_kg: order.gather(&lists(|part| &part.participation_sqrt_kg)),
        discretisation_error: order.gather(&lists(|part| &part.discretisation_error)),
        ..Modes::default()
    };
    for (index, part) in parts.iter().enumerate() {
        let spread = |values: &Vec<f64>| order.spread(index, values);
        // Several parts may stand on one base.
        for (name, values) in &part.base_sqrt_kg {
            let sum = modes
                .base_sqrt_kg
                .entry(name.clone())
                .or_insert_with(|| vec![0.0; order.0.len()]);
            for (sum, value) in sum.iter_mut().zip(spread(values)) {
                *sum += value;
            }
        }
        modes.shape.extend(
            part.shape
                .iter()
                .map(|(name, values)| (name.clone(), spread(values))),
        );
        modes.patch.extend(part.patch.iter().map(|(name, patch)| {
            let (coupling_n_per_v, strain) = (
                spread(&patch.coupling_n_per_v),
                patch
                    .strain
                    .iter()
                    .map(|place| place.mapped(spread))
                    .collect(),
            );
            (
                name.clone(),
                PatchModes {
                    coupling_n_per_v,
                    strain,
                    capacitance_f: patch.capacitance_f,
                    leakage_ohm: patch.leakage_ohm,
                },
            )
        }));
    }
    (order, modes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn part(name: &str, frequency_rad_s: &[f64]) -> Modes {
        let count = frequency_rad_s.len();
        let shape: Vec<f64> = (1..=count).map(|mode| mode as f64).collect();
        Modes {
            frequency_rad_s: frequency_rad_s.to_vec(),
            damping_ratio: vec![0.1; count],
            shape: BTreeMap::from([(name.to_owned(), shape.clone())]),
            patch: BTreeMap::from([(
                name.to_owned(),
                PatchModes {
                    coupling_n_per_v: shape,
                    capacitance_f: 1e-9,
                    leakage_ohm: None,
                    strain: Vec::new(),
                },
            )]),
            participation_sqrt_kg: vec![0.5; count],
            base_sqrt_kg: BTreeMap::from([("shelf".to_owned(), frequency_rad_s.to_vec())]),
            discretisation_error: vec![0.0; count],
            ..Modes::default()
        }
    }

    #[test]
    fn merged_modes_ascend_and_rest_in_each_other() {
        let (order, modes) = merged(&[part("one", &[1.0, 4.0, 5.0]), part("two", &[0.0, 4.0])]);
        assert_eq!(modes.frequency_rad_s, [0.0, 1.0, 4.0, 4.0, 5.0]);
        assert_eq!(modes.shape["one"], [0.0, 1.0, 2.0, 0.0, 3.0]);
        assert_eq!(
            modes.patch["two"].coupling_n_per_v,
            [1.0, 0.0, 0.0, 2.0, 0.0]
        );
        assert_eq!(
            (order.index_of(1, 1), order.index_of(1, 2)),
            (Some(3), None)
        );
        // The base moves both parts.
        assert_eq!(modes.base_sqrt_kg["shelf"], modes.frequency_rad_s);
        let first = order.first(3);
        assert_eq!((first.len(), first.needed(0), first.needed(1)), (3, 2, 1));
    }
}
