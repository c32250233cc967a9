//! Solver statistics of three runs, fixed: a change that needs more steps or iterations fails here.

use crate::plants::{bench, from_rest, kernel};

#[test]
fn work_of_the_paper_cases_at_the_default_tolerance() {
    for (amplitude_n, frequency_hz) in [(50.0, 11.0), (50.0, 6.0), (100.0, 11.0)] {
        let result = from_rest(&kernel(bench(amplitude_n, frequency_hz)), 20.0, 1e-7);
        insta::assert_debug_snapshot!(format!("work-{amplitude_n}N-{frequency_hz}Hz"), result.work);
    }
}
