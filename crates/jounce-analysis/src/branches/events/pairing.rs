//! Pairing of the elements of two lists, each with one partner at most.

/// Returns pairs of indices of two lists with given lengths, lowest cost first. An element without
/// a partner of finite cost stays alone.
pub fn paired(from: usize, to: usize, cost: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize)> {
    let mut costs: Vec<(f64, usize, usize)> = (0..from)
        .flat_map(|i| (0..to).map(move |j| (i, j)))
        .map(|(i, j)| (cost(i, j), i, j))
        .collect();
    costs.retain(|(cost, ..)| cost.is_finite());
    costs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut used_from, mut used_to) = (vec![false; from], vec![false; to]);
    let mut pairs = Vec::with_capacity(from.min(to));
    for (_, i, j) in costs {
        if !used_from[i] && !used_to[j] {
            (used_from[i], used_to[j]) = (true, true);
            pairs.push((i, j));
        }
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_are_joined_first_and_what_is_left_over_stays_alone() {
        let (one, two): ([f64; 3], [f64; 2]) = ([0.0, 1.0, 5.0], [1.1, 0.2]);
        assert_eq!(
            paired(3, 2, |i, j| (one[i] - two[j]).abs()),
            [(0, 1), (1, 0)]
        );
        assert_eq!(
            paired(3, 2, |i, _| if i == 2 { 0.0 } else { f64::INFINITY }),
            [(2, 0)]
        );
    }
}
