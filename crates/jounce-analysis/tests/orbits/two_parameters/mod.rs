//! Curves over two keys: bifurcations, peaks, levels.

mod cusps;
mod levels;
mod peaks;
mod planes;
mod tracking;

use jounce_analysis::{BifurcationCurve, BifurcationSearch, Model};
use jounce_spec::SpecFile;

/// Curves of bifurcations over the frequency of the shaker and another key.
fn bifurcation_curves(
    file: &SpecFile,
    second_key: &str,
    ranges: [(f64, f64); 2],
    tolerance: f64,
) -> Vec<BifurcationCurve> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let keys = ["drive.shaker.frequency", second_key].map(|key| file.numeric_key(key).unwrap());
    let search = BifurcationSearch {
        base: &base,
        keys: [&keys[0], &keys[1]],
        ranges,
        tolerance,
        seeds: 0,
        longest_period: 1,
        peaks: false,
    };
    search.run().unwrap()
}
