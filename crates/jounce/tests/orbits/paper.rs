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

#[test]
fn timing() {
    use jounce::continuation::{Corrector, Direction, Family, Linear, Metric, Position, settle, tangent};
    use jounce::orbit::{Harvester, Shooting};
    let path = "/work/shared/plant/paper-plant.toml";
    let file = SpecFile::read(std::path::Path::new(path)).unwrap();
    let base = Prepared::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 16.0);
    let plant = &base.kernel.plant;
    for tol in [1e-7, 1e-9, 1e-11] {
        let clock = std::time::Instant::now();
        let (cycles, unknown) = jounce::study::settled_orbit(&parameter, 10.5, &vec![0.0; plant.len()], tol, 1e-10).unwrap();
        eprintln!("tol {tol:e} settle {cycles} {:.1} ms", 1e3 * clock.elapsed().as_secs_f64());
        let shooting = Shooting::new(&parameter, &base.kernel, cycles, tol);
        let timed = |name: &str, f: &dyn Fn()| {
            f();
            let c = std::time::Instant::now();
            for _ in 0..200 {
                f();
            }
            eprintln!("  {name}: {:.1} us", c.elapsed().as_secs_f64() * 5e3);
        };
        timed("harvester.at", &|| {
            parameter.at(10.6).unwrap();
        });
        timed("shoot", &|| {
            shooting.at(&unknown, 10.5).unwrap();
        });
        let k = parameter.at(10.5).unwrap().kernel;
        let y = k.plant.from_physical(&shooting.physical(&unknown), 0.0);
        timed("march", &|| {
            let mut m = jounce::march::Marcher::new(&k, &y, 0.0, tol).unwrap();
            m.advance_to(1.0 / 10.5).unwrap();
        });
        timed("vary", &|| {
            jounce::march::Variation::march(&k, &y, 0.0, 1.0 / 10.5, tol, &Default::default()).unwrap();
        });
        let position = Position { unknown: unknown.clone(), parameter: 10.5 };
        let metric = Metric::at(&position, 0.8);
        let shot = settle(&shooting, &Corrector { goal: 1e-9, most: 8 }, &metric, position).unwrap();
        let up = Direction { unknown: vec![0.0; unknown.len()], parameter: 1.0 };
        let v = jounce::march::Variation::march(&k, &y, 0.0, 1.0 / 10.5, tol, &Default::default()).unwrap();
        let segs = v.trajectory.segments();
        eprintln!(
            "  contact segs {} flight {} ; odd {}",
            segs.iter().filter(|s| s.force_n.is_some()).count(),
            segs.iter().filter(|s| s.force_n.is_none()).count(),
            segs.iter().filter(|s| s.force_n.is_some() && s.length_s.log2().fract() != 0.0).count()
        );
        timed("tangent", &|| {
            tangent(&shot.local, &metric, &up).unwrap();
        });
        timed("orbit", &|| {
            shooting.orbit(&shot.local, 0.0).unwrap();
        });
        let _ = shot.local.residual();
        let o = shooting.orbit(&shot.local, shot.error).unwrap();
        eprintln!("  power {:.9e} floquet {:.6} err {:.1e}", o.mean_power_w, o.floquet_max_abs(), o.error_estimate);
        timed("peaks", &|| {
            jounce::orbit::nearest_extremum_m(&shot.local);
        });
    }
}
