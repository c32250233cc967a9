//! Coverage of the stated intervals: shares of many clouds against those of all other clouds.
//!
//! ```text
//! JOUNCE_DRAWN_CLOUDS=60 cargo test --release -p jounce-analysis --test attractors shares_of_clouds -- --nocapture
//! ```

use crate::agreement::blocks_inside;
use crate::harvesters::{SEED, STARTS, cloud, number};
use crate::library::{AccountKind, accounts};
use crate::random_specs::random_spec;
use jounce_spec::SpecFile;

/// Random harvesters with several attractors, whose ends brute force confirms start by start.
const SEVERAL_ATTRACTORS: [u64; 5] = [15, 32, 33, 40, 42];

/// Clouds of every run, all of the first harvester.
const FEW_CLOUDS: usize = 20;

/// Number of shares of one harvester that were compared, and of those that lie in their interval. The
/// shares of a cloud add up to 1: that of the most frequent attractor is left out.
fn coverage(index: u64, clouds: usize) -> [usize; 2] {
    let file = SpecFile::from_text(random_spec(SEED, index));
    let all = clouds * STARTS;
    let mut accounts = accounts(&file, cloud(all));
    accounts.retain(|account| account.kind != AccountKind::Undecided);
    accounts.sort_by_key(|account| std::cmp::Reverse(account.starts.len()));
    let (mut checked, mut inside) = (0, 0);
    for account in &accounts[1..] {
        let starts = &account.starts[..];
        let found = blocks_inside((starts, starts), (clouds, STARTS), all);
        eprintln!(
            "harvester {index}: {} of {all} starts on {}, {found} of {clouds} shares inside",
            starts.len(),
            account.id
        );
        checked += clouds;
        inside += found;
    }
    [checked, inside]
}

#[test]
fn shares_of_clouds_lie_in_their_intervals_as_often_as_stated() {
    let (clouds, harvesters) = match number("JOUNCE_DRAWN_CLOUDS") {
        Some(clouds) => (clouds, &SEVERAL_ATTRACTORS[..]),
        None => (FEW_CLOUDS, &SEVERAL_ATTRACTORS[..1]),
    };
    let (mut checked, mut inside) = (0, 0);
    for index in harvesters {
        let [more, found] = coverage(*index, clouds);
        checked += more;
        inside += found;
    }
    // Three standard deviations of the count, of which 95 % are expected.
    let deviation = (0.95 * 0.05 * checked as f64).sqrt();
    let expected = 0.95 * checked as f64;
    assert!(
        (inside as f64 - expected).abs() <= 3.0 * deviation,
        "{inside} of {checked} shares lie in their intervals"
    );
    eprintln!("{inside} of {checked} shares lie in their intervals");
}
