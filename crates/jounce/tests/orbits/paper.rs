//! The paper's plant: power, multipliers and folds computed by other programs.

use jounce::spec::SpecFile;
use jounce::study::{Branch, BranchSearch, Parameter, Prepared};

fn branches(over: &str, range: (f64, f64), seeds: usize) -> Option<Vec<Branch>> {
    let path = std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/plant/paper-plant.toml");
    let path = if path.exists() { path } else { "/work/shared/plant/paper-plant.toml".into() };
    let file = SpecFile::read(&path).ok()?;
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key(over).unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let clock = std::time::Instant::now();
    let search = BranchSearch { base: &base, parameter: &parameter, range, tolerance: 1e-9, seeds, longest_period: 4 };
    let found = search.run().unwrap();
    eprintln!("{} branches in {:.3} s", found.len(), clock.elapsed().as_secs_f64());
    Some(found)
}

#[test]
fn look() {
    let seeds = std::env::var("SEEDS").ok().and_then(|v| v.parse().ok()).unwrap_or(0);
    let from = std::env::var("FROM").ok().and_then(|v| v.parse().ok()).unwrap_or(4.0);
    let to = std::env::var("TO").ok().and_then(|v| v.parse().ok()).unwrap_or(20.0);
    for branch in branches("drive.shaker.frequency", (from, to), seeds).unwrap() {
        eprintln!("period {} points {} {:?}", branch.period_cycles, branch.points.len(), branch.endings);
        for b in &branch.bifurcations {
            eprintln!("   {:18} {:.6} {:.6e} W  contacts {}", b.kind.name(), b.at.parameter, b.at.orbit.mean_power_w, b.at.orbit.contacts);
        }
        if std::env::var("POINTS").is_ok() {
            for p in &branch.points {
                eprintln!(
                    "{:.5} {:.6e} {} {:.4} {}",
                    p.parameter,
                    p.orbit.mean_power_w,
                    p.orbit.is_stable(),
                    p.orbit.floquet_max_abs(),
                    p.orbit.contacts
                );
            }
        }
    }
}
