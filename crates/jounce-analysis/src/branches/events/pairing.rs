//! Pairing of the elements of two lists, each with one partner at most.

/// Returns pairs of indices of two lists with given lengths: the pair of lowest cost first, then that
/// of the remaining elements, and so on; sorted by index. An element without a partner of finite cost
/// stays alone.
///
/// Two elements that are each other's nearest are such a pair, whatever the others are.
pub fn paired(from: usize, to: usize, cost: impl Fn(usize, usize) -> f64) -> Vec<(usize, usize)> {
    let costs: Vec<f64> = (0..from * to).map(|k| cost(k / to, k % to)).collect();
    let (mut rows, mut columns): (Vec<usize>, Vec<usize>) =
        ((0..from).collect(), (0..to).collect());
    let mut pairs = Vec::with_capacity(from.min(to));
    let nearest = |others: &[usize], cost: &dyn Fn(usize) -> f64| {
        let finite = others.iter().copied().filter(|k| cost(*k).is_finite());
        finite.min_by(|a, b| cost(*a).total_cmp(&cost(*b)))
    };
    loop {
        let is_mutual =
            |i: &usize, j: &usize| nearest(&rows, &|row| costs[row * to + j]) == Some(*i);
        let found: Vec<(usize, usize)> = rows
            .iter()
            .filter_map(|i| Some((*i, nearest(&columns, &|column| costs[i * to + column])?)))
            .filter(|(i, j)| is_mutual(i, j))
            .collect();
        if found.is_empty() {
            break;
        }
        rows.retain(|row| found.iter().all(|(i, _)| i != row));
        columns.retain(|column| found.iter().all(|(_, j)| j != column));
        pairs.extend(found);
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
