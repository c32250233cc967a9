//! Temporary.
#![allow(clippy::unwrap_used, missing_docs)]
use jounce::spec::SpecFile;
use jounce::study::{JumpSearch, Prepared};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let mut file = SpecFile::read(std::path::Path::new(&a[1])).unwrap();
    let n = |k: usize| a[k].parse::<f64>().unwrap();
    for set in &a[9..] {
        let (key, value) = set.split_once('=').unwrap();
        file.set(key, &format!("\"{value}\"")).unwrap();
    }
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let keys = [&a[2], &a[5]].map(|key| file.numeric_key(key).unwrap());
    let search = JumpSearch {
        base: &base,
        keys: [&keys[0], &keys[1]],
        ranges: [(n(3), n(4)), (n(6), n(7))],
        tolerance: n(8),
        seeds: 0,
        longest_period: 2,
        peaks: std::env::var("NOPEAKS").is_err(),
    };
    for curve in search.run().unwrap() {
        let (first, last) = (curve.points[0], curve.points[curve.points.len() - 1]);
        println!(
            "{} {}: {} points {:.6} {:.4} to {:.6} {:.4} {:?}",
            curve.kind.name(),
            curve.period_cycles,
            curve.points.len(),
            first.parameter,
            first.parameter_2,
            last.parameter,
            last.parameter_2,
            curve.failures
        );
        if std::env::var("POINTS").is_ok() {
            curve.points.iter().for_each(|p| println!("   {:.9} {:.6} {:.9e}", p.parameter, p.parameter_2, p.mean_power_w));
        }
    }
}
