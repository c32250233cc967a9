//! Bifurcation diagrams by integration against continued branches, and attractors matched along the
//! key.

use crate::harvesters::{bench, branches};
use jounce_analysis::{
    AttractorKind, AttractorTracks, Branch, BranchKind, Cloud, Diagram, DiagramOrder, DiagramPoint,
    Model, OrbitMethodKind, Parameter,
};

fn visits(values: &[f64], order: DiagramOrder) -> (Vec<DiagramPoint>, Option<AttractorTracks>) {
    let file = bench();
    let base = Model::new(file.spec().unwrap()).unwrap();
    let key = file.numeric_key("drive.shaker.frequency").unwrap();
    let parameter = Parameter::new(&base, &key, 1.0);
    let study = Diagram {
        base: &base,
        parameter: &parameter,
        values,
        order,
        cycles: 32,
        tolerance: 1e-8,
    };
    let visits = study.run(None, &|_| ()).unwrap();
    let history = matches!(order, DiagramOrder::Starts(_)).then(|| study.history(&visits).unwrap());
    (visits, history)
}

fn values(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count)
        .map(|k| from + (to - from) * k as f64 / (count - 1) as f64)
        .collect()
}

/// Power of the stable orbits of some branches at a value, between their points.
fn powers_w(branches: &[Branch], value: f64) -> Vec<f64> {
    branches
        .iter()
        .flat_map(|branch| branch.crossings(value))
        .map(|(_, power_w)| power_w)
        .collect()
}

/// Stepped up and down, the integrations stay on the branch, and jump within one step of its fold.
#[test]
fn stepped_runs_lie_on_the_branches_and_jump_at_their_folds() {
    let branches_found = branches(&bench(), (11.4, 12.8), OrbitMethodKind::Shooting, 0);
    let upper = branches_found
        .iter()
        .flat_map(|branch| &branch.bifurcations)
        .filter(|at| at.kind == BranchKind::Fold);
    let upper_hz = upper.map(|at| at.at.parameter).fold(0.0, f64::max);
    let values = values(11.9, 12.8, 31);
    let (visits, _) = visits(&values, DiagramOrder::Both);
    assert_eq!(visits.len(), 62);
    let on = |visit: &DiagramPoint| {
        powers_w(&branches_found, visit.parameter)
            .iter()
            .any(|power_w| (visit.mean_power_w / power_w - 1.0).abs() < 0.02)
    };
    assert!(
        visits
            .iter()
            .filter(|visit| visit.motion == AttractorKind::Orbit && visit.period_cycles == 1)
            .all(on)
    );
    // On the way up, power falls by a factor of more than ten at the fold.
    let up = &visits[..31];
    let jump = up
        .windows(2)
        .find(|pair| pair[1].mean_power_w < 0.1 * pair[0].mean_power_w)
        .unwrap();
    eprintln!(
        "fold {upper_hz} Hz, jump from {} to {} Hz",
        jump[0].parameter, jump[1].parameter
    );
    assert!(jump[0].parameter < upper_hz && upper_hz < jump[1].parameter);
}

/// Two coexisting attractors retain their ids from value to value, and the third appears where its
/// branch folds.
#[test]
fn attractors_keep_their_ids() {
    let values = values(13.2, 13.8, 13);
    let (visits, history) = visits(
        &values,
        DiagramOrder::Starts(Cloud {
            starts: 8,
            seed: 1,
            spread: 10.0,
        }),
    );
    let history = history.unwrap();
    for attractor in &history.attractors {
        eprintln!(
            "{} {:?} {:?} {:?} {}",
            attractor.id,
            attractor.motion,
            attractor.born,
            attractor.died,
            attractor.seen.len()
        );
    }
    let low = &history.attractors[0];
    assert!(
        low.id == "1a"
            && low.seen.len() == values.len()
            && low.born.is_none()
            && low.died.is_none()
    );
    let triple: Vec<_> = history
        .attractors
        .iter()
        .filter(|attractor| attractor.period_cycles == 3)
        .collect();
    assert!(
        triple.len() == 1 && triple[0].id == "3a" && triple[0].died.is_none(),
        "one orbit of period 3, not {}",
        triple.len()
    );
    assert!(triple[0].born.is_some() && triple[0].seen.len() > 8);
    // Every start has an attractor of its kind, and the shares at each value sum to one.
    for (visit, home) in visits.iter().zip(&history.homes) {
        let home = &history.attractors[home.unwrap()];
        assert!(home.motion == visit.motion && home.period_cycles == visit.period_cycles);
    }
    for value in &values {
        let shares = history
            .attractors
            .iter()
            .flat_map(|attractor| &attractor.seen)
            .filter(|seen| seen.parameter == *value);
        assert!((shares.map(|seen| seen.fraction).sum::<f64>() - 1.0).abs() < 1e-12);
    }
}

/// The orbit of period 3 is one track, from fold to fold, over steps too coarse for an integration
/// from value to value.
#[test]
#[ignore = "long: runs with ./test --long"]
fn attractors_keep_their_ids_over_coarse_steps() {
    // Folds of the continued branch of period 3.
    let lives = 13.219458..14.186757;
    for count in [6, 11] {
        let values = values(13.2, 14.2, count);
        let (_, history) = visits(
            &values,
            DiagramOrder::Starts(Cloud {
                starts: 6,
                seed: 1,
                spread: 10.0,
            }),
        );
        let history = history.unwrap();
        let triple: Vec<_> = history
            .attractors
            .iter()
            .filter(|attractor| attractor.period_cycles == 3)
            .collect();
        let seen: Vec<f64> = triple
            .iter()
            .flat_map(|track| track.seen.iter().map(|seen| seen.parameter))
            .collect();
        let expected: Vec<f64> = values
            .into_iter()
            .filter(|value| lives.contains(value))
            .collect();
        assert!(
            triple.len() == 1 && seen == expected,
            "{count} values, {} ids: {seen:?}",
            triple.len()
        );
    }
}

#[test]
fn any_number_of_threads_gives_the_same_diagram() {
    let run_on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            visits(
                &values(13.4, 13.6, 3),
                DiagramOrder::Starts(Cloud {
                    starts: 4,
                    seed: 2,
                    spread: 10.0,
                }),
            )
        })
    };
    assert_eq!(run_on(1), run_on(3));
}

/// The points of an orbit are its states at each cycle in coordinates of the stop.
#[test]
fn a_section_of_an_orbit_has_a_point_for_each_cycle() {
    let (visits, _) = visits(
        &[13.6],
        DiagramOrder::Starts(Cloud {
            starts: 6,
            seed: 1,
            spread: 10.0,
        }),
    );
    for visit in visits
        .iter()
        .filter(|visit| visit.motion == AttractorKind::Orbit)
    {
        assert_eq!(visit.section.len(), visit.period_cycles as usize);
    }
}
