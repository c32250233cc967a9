//! Coverage of the stated intervals: shares of many clouds against those of all other clouds.
//!
//! ```text
//! JOUNCE_DRAWN_CLOUDS=60 cargo test --release -p jounce-analysis --test attractors shares_of_clouds -- --nocapture
//! ```

use crate::harvesters::{SEED, STARTS, cloud, number};
use crate::library::{Account, AccountKind, accounts};
use crate::random_specs::random_spec;
use jounce_analysis::{Model, wilson};
use jounce_spec::SpecFile;

/// Random harvesters with several attractors, whose ends brute force confirms start by start.
const SEVERAL_ATTRACTORS: [u64; 5] = [15, 32, 33, 40, 42];

/// Clouds of every run, all of the first harvester.
const FEW_CLOUDS: usize = 20;

/// Number of shares compared, and of those that lie in their interval.
#[derive(Debug, Default, Clone, Copy)]
struct Coverage {
    checked: usize,
    inside: usize,
}

/// Compares the share of one attractor in each cloud with its share in all other clouds.
fn coverage_of(account: &Account, clouds: usize) -> Coverage {
    let mut coverage = Coverage::default();
    for cloud in 0..clouds {
        let starts = cloud * STARTS..(cloud + 1) * STARTS;
        let hits = account
            .starts
            .iter()
            .filter(|start| starts.contains(start))
            .count();
        let others = account.starts.len() - hits;
        let share = others as f64 / ((clouds - 1) * STARTS) as f64;
        let interval = wilson(hits, STARTS);
        coverage.checked += 1;
        coverage.inside += usize::from((interval.low..=interval.high).contains(&share));
    }
    coverage
}

/// Coverage of the shares of one harvester. The starts of a cloud are drawn one by one, so each block
/// of a large cloud is a cloud too. The shares of a cloud add up to 1: that of the most frequent
/// attractor is left out.
fn coverage_of_harvester(index: u64, clouds: usize) -> Coverage {
    let file = SpecFile::from_text(random_spec(SEED, index));
    let model = Model::new(file.spec().unwrap()).unwrap();
    let drive = &model.kernel.plant.system.drives[0];
    let key = format!("drive.{}.frequency", drive.name);
    let mut accounts = accounts(&file, (&key, drive.frequency_hz), cloud(clouds * STARTS));
    accounts.retain(|account| account.kind != AccountKind::Undecided);
    accounts.sort_by_key(|account| std::cmp::Reverse(account.starts.len()));
    let mut sum = Coverage::default();
    for account in &accounts[1..] {
        let Coverage { checked, inside } = coverage_of(account, clouds);
        eprintln!(
            "harvester {index}: {} of {} starts on {}, {inside} of {checked} shares inside",
            account.starts.len(),
            clouds * STARTS,
            account.id
        );
        sum.checked += checked;
        sum.inside += inside;
    }
    sum
}

#[test]
fn shares_of_clouds_lie_in_their_intervals_as_often_as_stated() {
    let (clouds, harvesters) = match number("JOUNCE_DRAWN_CLOUDS") {
        Some(clouds) => (clouds, &SEVERAL_ATTRACTORS[..]),
        None => (FEW_CLOUDS, &SEVERAL_ATTRACTORS[..1]),
    };
    let mut sum = Coverage::default();
    for index in harvesters {
        let Coverage { checked, inside } = coverage_of_harvester(*index, clouds);
        sum.checked += checked;
        sum.inside += inside;
    }
    let Coverage { checked, inside } = sum;
    // Three standard deviations of the count, of which 95 % are expected.
    let deviation = (0.95 * 0.05 * checked as f64).sqrt();
    let expected = 0.95 * checked as f64;
    assert!(
        (inside as f64 - expected).abs() <= 3.0 * deviation,
        "{inside} of {checked} shares lie in their intervals"
    );
    eprintln!("{inside} of {checked} shares lie in their intervals");
}
