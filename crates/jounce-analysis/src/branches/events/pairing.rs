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
    loop {
        // Cost and number of the nearest element of the other list.
        let mut of_row = vec![(f64::INFINITY, None); from];
        let mut of_column = vec![(f64::INFINITY, None); to];
        for &i in &rows {
            for &j in &columns {
                let cost = costs[i * to + j];
                if cost < of_row[i].0 {
                    of_row[i] = (cost, Some(j));
                }
                if cost < of_column[j].0 {
                    of_column[j] = (cost, Some(i));
                }
            }
        }
        let partner = |i: usize| of_row[i].1.filter(|j| of_column[*j].1 == Some(i));
        let found = rows.iter().filter_map(|&i| Some((i, partner(i)?)));
        let before = pairs.len();
        pairs.extend(found);
        if pairs.len() == before {
            break;
        }
        rows.retain(|&i| partner(i).is_none());
        columns.retain(|&j| pairs[before..].iter().all(|(_, other)| j != *other));
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
