//! Orbits under sums of sinusoids whose frequencies have a common period.

use jounce_analysis::{BranchSearch, Model, OrbitMethodKind, Parameter, settled_orbit};
use jounce_dynamics::{Integrator, Kernel};
use jounce_orbits::{HarmonicBalance, OrbitError, Shooting};
use jounce_spec::SpecFile;
use std::f64::consts::TAU;

const GAP_M: f64 = 1e-3;

fn file(second_hz: f64) -> SpecFile {
    SpecFile::from_text(format!(
        "[mass.mass]\non = \"ground\"\nmass = \"1 kg\"\nfrequency = \"6 Hz\"\ndamping_ratio = 0.05\n\
         [stop.wall]\nat = \"mass\"\ngap = \"1 mm\"\nlaw = \"hertz\"\nstiffness = \"1e5 N/m^1.5\"\n\
         [drive.slow]\nat = \"mass\"\namplitude = \"1.5 N\"\nfrequency = \"5 Hz\"\n\
         [drive.fast]\nat = \"mass\"\namplitude = \"2 N\"\nfrequency = \"{second_hz} Hz\"\nphase = \"40 deg\"\n"
    ))
}

/// Displacement and velocity after a time, by RK4.
fn integrated(mut x: [f64; 2], time_s: f64) -> [f64; 2] {
    let (w, steps) = (TAU * 6.0, 400_000);
    let h = time_s / f64::from(steps);
    let rate = |t: f64, [q, v]: [f64; 2]| {
        let force =
            1.5 * (TAU * 5.0 * t).sin() + 2.0 * (TAU * 7.5 * t + 40.0_f64.to_radians()).sin();
        [
            v,
            force - w * w * q - 2.0 * 0.05 * w * v - 1e5 * (q - GAP_M).max(0.0).powf(1.5),
        ]
    };
    let add = |a: [f64; 2], b: [f64; 2], f: f64| [a[0] + f * b[0], a[1] + f * b[1]];
    for k in 0..steps {
        let t = f64::from(k) * h;
        let a = rate(t, x);
        let b = rate(t + 0.5 * h, add(x, a, 0.5 * h));
        let c = rate(t + 0.5 * h, add(x, b, 0.5 * h));
        let d = rate(t + h, add(x, c, h));
        x = std::array::from_fn(|i| x[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    x
}

/// 5 and 7.5 Hz have the common period 0.4 s. The orbit closes in an RK4 integration, and its
/// multipliers have Liouville's product `e^{-2 zeta w T}`, with or without impacts. The orbit is
/// also found along a branch over the gap, at its gap.
#[test]
fn two_frequencies_with_a_common_period_have_orbits() {
    let file = file(7.5);
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("stop.wall.gap").unwrap();
    let parameter = Parameter::new(&base, &key, GAP_M);
    let kernel: &Kernel = &base.kernel;
    let orbit = settled_orbit(
        &parameter,
        GAP_M,
        &vec![0.0; kernel.plant.len()],
        1e-11,
        1e-11,
    )
    .unwrap();
    let start =
        Shooting::new(&parameter, kernel, orbit.period_cycles, 1e-11).physical(orbit.start());
    let period_s = 0.4 * f64::from(orbit.period_cycles);
    let end = integrated([start[0], start[1]], period_s);
    let apart = [0, 1].map(|i| (end[i] - start[i]).abs() / start[1].abs());
    let product: f64 = orbit.multipliers.iter().map(|m| m.norm()).product();
    let exact = (-2.0 * 0.05 * TAU * 6.0 * period_s).exp();
    eprintln!(
        "{} cycles, {} contacts, apart by {apart:?}, product {product:e} and {exact:e}",
        orbit.period_cycles, orbit.contacts
    );
    assert!(
        orbit.contacts > 0
            && apart.iter().all(|apart| *apart < 1e-9)
            && (product / exact - 1.0).abs() < 1e-7
    );
    let mut integrator =
        Integrator::new(kernel, &kernel.plant.from_physical(&start, 0.0), 0.0, 1e-10).unwrap();
    integrator.advance_to(period_s).unwrap();
    assert_eq!(integrator.statistics().contacts, orbit.contacts);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: (0.8 * GAP_M, 1.2 * GAP_M),
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-10,
        seeds: 0,
        longest_period: orbit.period_cycles,
    };
    let branches = search.run().unwrap();
    let spans = |branch: &jounce_analysis::Branch| {
        let gaps = branch.points.iter().map(|point| point.parameter);
        branch.period_cycles == orbit.period_cycles
            && gaps.clone().any(|gap| gap < GAP_M)
            && gaps.clone().any(|gap| gap > GAP_M)
    };
    assert!(branches.iter().any(spans), "{} branches", branches.len());
}

/// Frequencies without a common period, and harmonic balance with several, are refused with a
/// suggestion.
#[test]
fn unsupported_analyses_of_several_frequencies_are_refused() {
    let incommensurate = file(7.123_456);
    let base = Model::new(incommensurate.spec().unwrap()).unwrap();
    let key = incommensurate.numeric_key("stop.wall.gap").unwrap();
    let parameter = Parameter::new(&base, &key, GAP_M);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: (0.8 * GAP_M, 1.2 * GAP_M),
        method: OrbitMethodKind::Shooting,
        tolerance: 1e-9,
        seeds: 0,
        longest_period: 1,
    };
    let refused = search.run().unwrap_err();
    assert!(
        matches!(refused, OrbitError::Frequencies { frequencies: 2 })
            && refused.to_string().contains("100 cycles"),
        "{refused}"
    );
    let even = file(7.5);
    let base = Model::new(even.spec().unwrap()).unwrap();
    let parameter = Parameter::new(&base, &key, GAP_M);
    let shooting = Shooting::new(&parameter, &base.kernel, 1, 1e-9);
    let method = HarmonicBalance::new(shooting, &base.kernel, 64, 1e-7).unwrap();
    let refused = jounce_continuation::Problem::at(&method, &vec![0.0; 129], GAP_M).unwrap_err();
    assert!(
        matches!(refused, OrbitError::Summed { frequencies: 2 })
            && refused.to_string().contains("shooting"),
        "{refused}"
    );
}
