//! Uniform grids of stamped and damaged recordings.

use super::*;
use crate::recording::{Over, Quantity};

fn recording(stamps: Vec<f64>, values: Vec<f64>) -> Recording {
    let (grid, issues) = Grid::from_stamps(stamps).unwrap();
    let channels = vec![Channel::new("a", Quantity::Unknown, "", values)];
    Recording {
        name: "r".to_owned(),
        over: Over::Time,
        grid,
        channels,
        issues,
    }
}

/// Linear interpolation reproduces a straight line for any stamps, across the gap too.
#[test]
fn jittered_stamps_and_missing_samples_of_a_line_come_out_exact() {
    let stamps: Vec<f64> = (0..200)
        .filter(|k| !(77..79).contains(k))
        .map(|k| f64::from(k) + 0.3 * f64::from((k * 37 % 11) - 5) / 5.0)
        .collect();
    let mut values: Vec<f64> = stamps.iter().map(|t| 2.0 * t - 3.0).collect();
    values[20] = f64::NAN;
    let even = recording(stamps.clone(), values).even().unwrap();
    let Grid::Even { start, step, .. } = even.grid else {
        panic!("even places")
    };
    for (k, value) in even.channels[0].values.iter().enumerate() {
        // Sample 20 is interpolated as if its stamp were uniform: the error is its jitter.
        let position = start + k as f64 * step;
        let error = (value - (2.0 * position - 3.0)).abs();
        assert!(
            error
                < if (18.0..22.0).contains(&position) {
                    1.3
                } else {
                    1e-9
                },
            "{k}: {error}"
        );
    }
    let kinds: Vec<_> = even.issues.iter().map(|issue| issue.kind).collect();
    for kind in [
        IssueKind::Jitter,
        IssueKind::Gap,
        IssueKind::Bridged,
        IssueKind::Resampled,
    ] {
        assert!(kinds.contains(&kind), "{kind:?} is missing in {kinds:?}");
    }
}

/// A sine of 200 Hz and rms 1 at 1 kHz, its stamps written to seven digits, some samples lost.
/// The rate equals the grid rate, recorded samples are unchanged, and the error of the mean
/// power is within the bound of the interpolation.
#[test]
fn missing_samples_do_not_change_the_others() {
    for missing in [vec![1234], vec![7, 8, 9, 10, 11, 12, 13, 2000, 2002]] {
        let sine = |k: u32| {
            std::f64::consts::SQRT_2 * (std::f64::consts::TAU * 0.2 * f64::from(k) + 0.1).sin()
        };
        let retained: Vec<u32> = (0..4000).filter(|k| !missing.contains(k)).collect();
        let stamps: Vec<f64> = retained
            .iter()
            .map(|k| (f64::from(*k) * 1e4 + f64::from(k % 3) - 1.0).round() * 1e-7)
            .collect();
        let result = recording(stamps, retained.iter().map(|k| sine(*k)).collect());
        let kinds: Vec<_> = result.issues.iter().map(|issue| issue.kind).collect();
        assert_eq!(kinds, [IssueKind::Gap]);
        assert!(
            (result.rate() / 1000.0 - 1.0).abs() < 1e-7,
            "{}",
            result.rate()
        );
        let even = result.even().unwrap();
        let Grid::Even { step, count, .. } = even.grid else {
            panic!("even places")
        };
        assert!((step / 1e-3 - 1.0).abs() < 1e-7 && count == 4000);
        let values = &even.channels[0].values;
        assert!(retained.iter().all(|k| values[*k as usize] == sine(*k)));
        let power = values.iter().map(|x| x * x).sum::<f64>() / 4000.0;
        assert!(
            (power - 1.0).abs() < 2.0 * missing.len() as f64 / 4000.0,
            "{power}"
        );
        assert_eq!(
            even.issues.last().map(|issue| (issue.kind, issue.count)),
            Some((IssueKind::Bridged, missing.len()))
        );
    }
}

/// Two bursts, the second one stamped years later: a uniform grid would not fit into memory.
/// Exact stamps lie on a grid with gaps, jittered ones do not.
#[test]
fn bursts_that_lie_years_apart_are_refused() {
    for jitter in [0.0, 3e-4] {
        let at = |k: u32| 1e-3 * f64::from(k) + jitter * (f64::from(k * 37 % 11) - 5.0) / 5.0;
        let second = (0..1000).map(|k| 1.7e9 + at(k));
        let stamps: Vec<f64> = (0..1000).map(at).chain(second).collect();
        let error = recording(stamps, vec![0.0; 2000]).even().unwrap_err();
        assert!(
            matches!(error, GridError::Sparse { samples: 2000, positions } if positions > 1e12),
            "{error:?}"
        );
    }
}

/// Stamps in steps of their last digit: a missing one is lost; where the rate is lower than the
/// digits, every 19th step is long.
#[test]
fn missing_sample_is_not_a_rounded_stamp() {
    let kinds = |stamps: Vec<f64>| -> Vec<IssueKind> {
        Grid::from_stamps(stamps)
            .unwrap()
            .1
            .iter()
            .map(|result| result.kind)
            .collect()
    };
    assert_eq!(
        kinds(
            (0..2000)
                .filter(|k| *k != 777)
                .map(|k| f64::from(k) / 100.0)
                .collect()
        ),
        [IssueKind::Gap]
    );
    assert_eq!(
        kinds(
            (0..2000)
                .map(|k| (f64::from(k) / 0.95).round() / 100.0)
                .collect()
        ),
        [IssueKind::RoundedStamps]
    );
}

#[test]
fn stamps_with_few_digits_are_even_and_backward_ones_refused() {
    let stamps: Vec<f64> = (0..1000)
        .map(|k| (f64::from(k) * 1e6 / 1536.0).round() * 1e-6)
        .collect();
    let (grid, issues) = Grid::from_stamps(stamps).unwrap();
    assert!(
        issues.is_empty() && (grid.rate() / 1536.0 - 1.0).abs() < 1e-6,
        "{}",
        grid.rate()
    );
    assert!(matches!(
        Grid::from_stamps(vec![0.0, 2.0, 1.0]),
        Err(GridError::Backwards { sample: 2, .. })
    ));
    assert!(matches!(
        Grid::from_stamps(vec![0.0, f64::NAN]),
        Err(GridError::NotANumber { sample: 1, .. })
    ));
    assert!(matches!(
        Grid::from_stamps(vec![0.0]),
        Err(GridError::Few { count: 1 })
    ));
    assert!(Grid::from_stamps(vec![1.0, 1.0]).is_err());
}
