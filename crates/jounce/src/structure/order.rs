//! Modes of independent structures, merged in ascending frequency: a structure is at rest in the modes of the others.

use super::modes::{Modes, PatchModes};

/// Which part each merged mode comes from: `(part, mode of the part)`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order(Vec<(usize, usize)>);

impl Order {
    /// Ascending in frequency; of equal frequencies the earlier part comes first.
    pub fn ascending(frequencies: &[&[f64]]) -> Self {
        let of_part = |(part, list): (usize, &&[f64])| (0..list.len()).map(move |mode| (part, mode)).collect::<Vec<_>>();
        let mut order: Vec<_> = frequencies.iter().enumerate().flat_map(of_part).collect();
        order.sort_by(|one, other| frequencies[one.0][one.1].total_cmp(&frequencies[other.0][other.1]));
        Self(order)
    }

    /// The first `modes` of them.
    pub fn first(mut self, modes: usize) -> Self {
        self.0.truncate(modes);
        self
    }

    /// Number of merged modes.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// How many modes of `part` are needed.
    pub fn needed(&self, part: usize) -> usize {
        self.0.iter().filter(|(of, _)| *of == part).count()
    }

    /// Place of a mode of a part among the merged modes.
    pub fn place(&self, part: usize, mode: usize) -> Option<usize> {
        self.0.iter().position(|entry| *entry == (part, mode))
    }

    /// One value per mode of `part`, spread over the merged modes; zero in those of other parts.
    pub fn spread(&self, part: usize, values: &[f64]) -> Vec<f64> {
        self.0.iter().map(|(of, mode)| if *of == part { values[*mode] } else { 0.0 }).collect()
    }

    /// The value of each merged mode, from one list per part.
    pub fn gather(&self, values: &[&[f64]]) -> Vec<f64> {
        self.0.iter().map(|(part, mode)| values[*part][*mode]).collect()
    }
}

/// All modes of several structures, and their order.
pub(super) fn merged(parts: &[Modes]) -> (Order, Modes) {
    let lists = |list: fn(&Modes) -> &[f64]| parts.iter().map(list).collect::<Vec<_>>();
    let frequencies = lists(|part| &part.frequency_rad_s);
    let order = Order::ascending(&frequencies);
    let mut modes = Modes {
        frequency_rad_s: order.gather(&frequencies),
        damping_ratio: order.gather(&lists(|part| &part.damping_ratio)),
        discretisation_error: order.gather(&lists(|part| &part.discretisation_error)),
        ..Modes::default()
    };
    for (index, part) in parts.iter().enumerate() {
        let spread = |values: &Vec<f64>| order.spread(index, values);
        modes.shape.extend(part.shape.iter().map(|(name, values)| (name.clone(), spread(values))));
        modes.patch.extend(part.patch.iter().map(|(name, patch)| {
            let coupling_n_per_v = spread(&patch.coupling_n_per_v);
            (name.clone(), PatchModes { coupling_n_per_v, ..*patch })
        }));
    }
    (order, modes)
}
