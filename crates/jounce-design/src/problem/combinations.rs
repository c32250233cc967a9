//! Combinations of choices, and the free keys that belong to them.

use super::{FreeKey, FreeValues, Problem};

impl Problem {
    /// Returns the index of the combination of choices at a place of the unit cube.
    pub(crate) fn variant(&self, place: &[f64]) -> usize {
        let mut stride = 1;
        let mut index = 0;
        for (free, place) in self.free.iter().zip(place) {
            if let FreeValues::Choice(choices) = &free.values {
                index += stride * free.choice(*place);
                stride *= choices.len();
            }
        }
        index
    }

    /// Returns the number of combinations of choices; 1 without a choice.
    pub(crate) fn variant_count(&self) -> usize {
        self.variants.len()
    }

    /// Returns the index of each choice of a combination, with the index of its free key.
    pub(super) fn choices_of(&self, variant: usize) -> Vec<(usize, usize)> {
        let (mut rest, mut all) = (variant, Vec::new());
        for (index, free) in self.free.iter().enumerate() {
            if let FreeValues::Choice(choices) = &free.values {
                all.push((index, rest % choices.len()));
                rest /= choices.len();
            }
        }
        all
    }

    /// Returns the choices of a combination as they are written.
    pub(super) fn choices_text(&self, variant: usize) -> String {
        let text = |(index, choice): (usize, usize)| {
            let free = &self.free[index];
            let count = free.choice_count() as f64;
            format!(
                "{} = {}",
                free.path,
                free.text((choice as f64 + 0.5) / count)
            )
        };
        let all = self.choices_of(variant).into_iter().map(text);
        all.collect::<Vec<_>>().join(", ")
    }

    /// Returns the change of a condition as it is written.
    pub(super) fn change_text(&self, change: usize) -> String {
        let pairs = self.changes[change].iter();
        let text = pairs.map(|(path, value)| format!("{path} = {value}"));
        text.collect::<Vec<_>>().join(", ")
    }

    /// True where a free key belongs to the choices at a place of the unit cube.
    pub(crate) fn applies(&self, index: usize, place: &[f64]) -> bool {
        let with = self.free[index].with;
        with.is_none_or(|with| self.free[with.free].choice(place[with.free]) == with.choice)
    }

    /// Returns the free keys that belong to the choices at a place, each with its index and its
    /// coordinate.
    pub(crate) fn applying<'p, 'c>(
        &'p self,
        place: &'c [f64],
    ) -> impl Iterator<Item = (usize, &'p FreeKey, f64)> + use<'p, 'c> {
        let all = self.free.iter().zip(place).enumerate();
        let all = all.map(|(index, (free, coordinate))| (index, free, *coordinate));
        all.filter(|(index, ..)| self.applies(*index, place))
    }

    /// Returns the place of the spec as given; `None` where a value is not allowed.
    pub(crate) fn given(&self) -> Option<Vec<f64>> {
        let mut place: Vec<f64> = Vec::with_capacity(self.free.len());
        for (index, free) in self.free.iter().enumerate() {
            // A choice stands before its ranges.
            let coordinate = match self.applies(index, &place) {
                true => free.place(&self.spec)?,
                false => 0.5,
            };
            place.push(coordinate);
        }
        Some(place)
    }
}
