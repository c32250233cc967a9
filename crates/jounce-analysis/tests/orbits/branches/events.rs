//! Events on branches: no event is missed between two points at any tolerance, range or step limit;
//! stability agrees with integrations.

use crate::harvesters::bench;
use jounce_analysis::{
    Branch, BranchKind, BranchOptions, BranchSearch, Model, OrbitMethodKind, Parameter,
    QuantityLevel,
};
use jounce_dynamics::Integrator;
use jounce_orbits::{ParametricModel, Shooting};
use jounce_spec::SpecFile;

const METHODS: [OrbitMethodKind; 2] = [
    OrbitMethodKind::Shooting,
    OrbitMethodKind::HarmonicBalance { harmonics: 64 },
];

fn spec_with(changes: &[(&str, &str)]) -> SpecFile {
    let mut file = bench();
    changes
        .iter()
        .for_each(|(key, value)| file.set(key, value).unwrap());
    file
}

/// Branches of one drive cycle over the frequency, for given options and tolerance.
fn branches_with(
    file: &SpecFile,
    range: (f64, f64),
    (method, tolerance): (OrbitMethodKind, f64),
    options: &BranchOptions,
) -> Vec<Branch> {
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, range.1 - range.0);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range,
        method,
        tolerance,
        seeds: 0,
        longest_period: 1,
    };
    search.run_with(options).unwrap()
}

/// Labels except grazings in the order of the key, without those at the edges of a range.
fn labels(branches: &[Branch]) -> Vec<(BranchKind, f64)> {
    let all = branches
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .map(|label| (label.kind, label.at.parameter));
    let mut all: Vec<(BranchKind, f64)> = all
        .filter(|(kind, _)| *kind != BranchKind::Grazing)
        .collect();
    all.sort_by(|a, b| a.1.total_cmp(&b.1));
    all.dedup_by(|a, b| a.0 == b.0 && (a.1 - b.1).abs() < 1e-4);
    all
}

/// A pair of tori 0.05 Hz apart on a step of 0.3 Hz: at three tolerances, with two largest steps,
/// in one range or in three.
fn finds_the_pair_of_tori(file: &SpecFile, pair: [f64; 2]) {
    let mut known: Option<Vec<(BranchKind, f64)>> = None;
    for tolerance in [1e-7, 5e-10, 1e-10] {
        for largest_step in [0.4, 0.2] {
            for ranges in [
                &[(6.5, 20.0)][..],
                &[(6.5, 10.0), (10.0, 11.4), (11.4, 20.0)],
            ] {
                let options = BranchOptions {
                    largest_step,
                    ..BranchOptions::default()
                };
                let branches: Vec<Branch> = ranges
                    .iter()
                    .flat_map(|range| {
                        branches_with(
                            file,
                            *range,
                            (OrbitMethodKind::Shooting, tolerance),
                            &options,
                        )
                    })
                    .collect();
                let bifurcations = labels(&branches);
                let tori = bifurcations.iter().filter(|(kind, at)| {
                    *kind == BranchKind::NeimarkSacker && (10.4..10.6).contains(at)
                });
                let tori: Vec<f64> = tori.map(|(_, at)| *at).collect();
                eprintln!("{tolerance:e} {largest_step} {}: {tori:?}", ranges.len());
                assert!(
                    tori.len() == 2 && tori.iter().zip(pair).all(|(a, b)| (a - b).abs() < 1e-4),
                    "{tori:?}"
                );
                // At the coarsest tolerance the error of a turning point near the surface exceeds
                // the change over a step.
                let open = branches
                    .iter()
                    .flat_map(|branch| &branch.not_proved)
                    .filter(|part| part.event != BranchKind::Grazing);
                assert_eq!(open.count(), 0);
                assert!(
                    tolerance == 1e-7 || branches.iter().all(|branch| branch.not_proved.is_empty())
                );
                let known = known.get_or_insert_with(|| bifurcations.clone());
                let agree = bifurcations.len() == known.len()
                    && bifurcations
                        .iter()
                        .zip(&*known)
                        .all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-4);
                assert!(agree, "{bifurcations:?} {known:?}");
            }
        }
    }
}

/// Against an independent Runge-Kutta integration with separate shooting: 10.47358 and 10.52108 Hz.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_pair_of_tori_inside_one_step_is_found() {
    let changes = [
        ("drive.shaker.amplitude", "\"80 N\""),
        ("circuit.load.resistance", "\"100 kohm\""),
        ("stop.tip.frame", "\"harvester.table\""),
    ];
    finds_the_pair_of_tori(&spec_with(&changes), [10.47358, 10.52108]);
}

/// Against the same independent integration: 10.46710 and 10.52154 Hz.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_pair_of_tori_does_not_depend_on_the_tolerance() {
    let changes = [
        ("drive.shaker.amplitude", "\"100 N\""),
        ("modal.harvester.damping_ratio.1", "0.3"),
    ];
    finds_the_pair_of_tori(&spec_with(&changes), [10.46710, 10.52154]);
}

/// Mean power between two labels of a level, by both methods: the labels are where the power of the
/// points crosses the level.
#[test]
fn a_level_of_power_is_labelled_where_the_branch_passes_it() {
    let file = bench();
    let plant = Model::new(file.spec().unwrap()).unwrap().kernel.plant;
    let level = QuantityLevel::parse("mean_power=50 uW", &plant).unwrap();
    let force = QuantityLevel::parse("contact_force.tip=0.05 N", &plant).unwrap();
    let options = BranchOptions {
        levels: vec![level, force],
        ..BranchOptions::default()
    };
    let [shooting, balance] = METHODS.map(|method| {
        let branches = branches_with(&file, (10.5, 14.0), (method, 1e-10), &options);
        for branch in &branches {
            let mut crossings = branch.points.windows(2).map(|two| {
                two.iter()
                    .map(|point| point.orbit.mean_power_w > 50e-6)
                    .collect::<Vec<_>>()
            });
            let crossings = crossings.by_ref().filter(|two| two[0] != two[1]).count();
            let bifurcations: Vec<_> = branch
                .bifurcations
                .iter()
                .filter(|label| label.level.as_deref() == Some("mean_power=50 uW"))
                .collect();
            assert!(
                bifurcations.len() == crossings && crossings > 0,
                "{} {crossings}",
                bifurcations.len()
            );
            assert!(
                bifurcations
                    .iter()
                    .all(|label| (label.at.orbit.mean_power_w / 50e-6 - 1.0).abs() < 1e-6)
            );
        }
        branches
            .iter()
            .flat_map(|branch| &branch.bifurcations)
            .filter(|label| label.kind == BranchKind::Level)
            .map(|label| label.at.parameter)
            .collect::<Vec<_>>()
    });
    eprintln!("{shooting:?} {balance:?}");
    assert!(
        shooting.len() == balance.len()
            && shooting
                .iter()
                .zip(&balance)
                .all(|(a, b)| (a - b).abs() < 1e-5)
    );
    for text in [
        "mean_power=50 V",
        "force=2 N",
        "contact_force.wall=2 N",
        "mean_power=-1 W",
        "mean_power",
    ] {
        let reason = QuantityLevel::parse(text, &plant).unwrap_err();
        assert!(reason.contains(text), "{reason}");
    }
}

/// Random points along branches of four harvesters: the multipliers agree with an integration from
/// a perturbation of 1e-6, over 300 cycles or more where these do not decide.
#[test]
#[ignore = "long: runs with ./test --long"]
fn stability_agrees_with_integrations_after_a_perturbation() {
    let specs = [
        spec_with(&[]),
        spec_with(&[
            ("drive.shaker.amplitude", "\"80 N\""),
            ("circuit.load.resistance", "\"100 kohm\""),
            ("stop.tip.frame", "\"harvester.table\""),
        ]),
        spec_with(&[
            ("drive.shaker.amplitude", "\"100 N\""),
            ("modal.harvester.damping_ratio.1", "0.3"),
        ]),
        spec_with(&[("stop.tip.gap", "\"0 mm\"")]),
    ];
    let (mut checked, mut unstable) = (0, 0);
    for (index, file) in specs.iter().enumerate() {
        let range = (4.0, 20.0);
        let base = Model::new(file.spec().unwrap()).unwrap();
        let key = file.numeric_key("drive.shaker.frequency").unwrap();
        let parameter = Parameter::new(&base, &key, range.1 - range.0);
        let points: Vec<_> = branches_with(
            file,
            range,
            (OrbitMethodKind::Shooting, 1e-10),
            &BranchOptions::default(),
        )
        .into_iter()
        .flat_map(|branch| branch.points)
        .collect();
        for k in 0..50 {
            let share = (f64::from(k * 4 + index as i32) * 0.618_033_988_749_895).fract();
            let point = &points[(share * points.len() as f64) as usize];
            let largest = point.orbit.floquet_max_abs();
            if (largest - 1.0).abs() < 1e-4 {
                continue;
            }
            let kernel = parameter.at(point.parameter).unwrap().kernel;
            let shooting = Shooting::new(&parameter, &kernel, 1, 1e-10);
            let grown = growth(&kernel, &shooting, point.orbit.start());
            assert_eq!(
                grown < 1.0,
                largest < 1.0,
                "{index}: {} Hz, {largest}, {grown}",
                point.parameter
            );
            (checked, unstable) = (checked + 1, unstable + usize::from(largest > 1.0));
        }
    }
    eprintln!("{checked} places, {unstable} unstable");
    assert!(checked > 180 && unstable > 20);
}

/// Growth factor per cycle of a perturbation over the last two thirds of 300 cycles, or until it
/// has changed by a factor of a thousand. A least-squares line through the logarithms gives it,
/// since the size of a complex pair oscillates. If the perturbation has changed by less than a
/// factor of ten, the integration continues, for up to 9600 cycles.
fn growth<H: ParametricModel>(
    kernel: &jounce_dynamics::Kernel,
    shooting: &Shooting<'_, H>,
    start: &[f64],
) -> f64 {
    let size = |u: &[f64]| u.iter().map(|u| u * u).sum::<f64>().sqrt();
    let kick = 1e-6 * size(start);
    let perturbed_start: Vec<f64> = start
        .iter()
        .enumerate()
        .map(|(i, u)| u + kick * (1.0 + i as f64).sin())
        .collect();
    let cycle_s = kernel.plant.period_s().unwrap();
    let mut integrators = [start, &perturbed_start].map(|from| {
        Integrator::new(
            kernel,
            &kernel.plant.from_physical(&shooting.physical(from), 0.0),
            0.0,
            1e-11,
        )
        .unwrap()
    });
    let mut distances = Vec::new();
    loop {
        let time_s = (distances.len() + 1) as f64 * cycle_s;
        let [plain, from] = integrators.each_mut().map(|integrator| {
            integrator.advance_to(time_s).unwrap();
            shooting.unknown(&kernel.plant.to_physical(&integrator.state(), time_s))
        });
        let distance = size(
            &from
                .iter()
                .zip(&plain)
                .map(|(a, b)| a - b)
                .collect::<Vec<_>>(),
        );
        distances.push(distance);
        let (count, change) = (
            distances.len(),
            (distance / distances[distances.len() / 3]).ln().abs(),
        );
        let is_decided = count.is_multiple_of(300) && change > 10_f64.ln() || count == 9600;
        if is_decided || !(1e-3 * kick..1e3 * kick).contains(&distance) {
            break;
        }
    }
    let part = &distances[(distances.len() - 1) / 3..];
    let middle = 0.5 * (part.len() - 1) as f64;
    let (mut up, mut along) = (0.0, 0.0);
    for (k, distance) in part.iter().enumerate() {
        let offset = k as f64 - middle;
        (up, along) = (up + offset * distance.ln(), along + offset * offset);
    }
    if along == 0.0 {
        part[0] / kick
    } else {
        (up / along).exp()
    }
}
