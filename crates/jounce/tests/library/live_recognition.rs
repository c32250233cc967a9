//! Orbits of the live page that are found again by their motion, and motions without a period.

use crate::live::paper;
use jounce::live::{
    AttractorPlace, Design, KeySpan, LiveAnalysis, OperatingPoint, OrbitIdentity, OrbitPlace,
    OrbitResult, ResponseOptions, SoughtOrbit,
};
use jounce::{BasinsOptions, Control};

fn design(hertz: &str) -> Design {
    let frequency = ("drive.shaker.frequency".to_owned(), hertz.to_owned());
    Design::new(&paper(), &[frequency]).unwrap()
}

/// Attractors of a design, stored under a number.
fn attractors(analysis: &LiveAnalysis, design: &Design, number: u64) -> OperatingPoint {
    let basins = BasinsOptions {
        starts: 40,
        ..Default::default()
    };
    let found = analysis.operating_point(design, &basins, &Control::default());
    let found = found.unwrap();
    analysis.store_attractors(number, design, &found.basins);
    found
}

fn response(analysis: &LiveAnalysis, design: &Design, number: u64, from: f64, to: f64) {
    let span = KeySpan {
        over: "drive.shaker.frequency".into(),
        from,
        to,
    };
    let options = ResponseOptions::default();
    analysis
        .fine_response(number, design, &span, &options, &Control::default())
        .unwrap();
}

fn is_same(one: &OrbitResult, other: &OrbitResult) -> bool {
    let pairs = one.voltage_v.iter().zip(&other.voltage_v);
    let largest_v = one
        .voltage_v
        .iter()
        .fold(0.0, |max: f64, v| max.max(v.abs()));
    pairs.clone().count() == one.voltage_v.len()
        && pairs
            .into_iter()
            .all(|(a, b)| (a - b).abs() < 1e-5 * largest_v)
}

/// At 12.55 Hz two stable orbits of one period exist; a range from 12.8 Hz has none of them.
#[test]
fn orbits_have_their_own_points_in_every_response() {
    let (analysis, control) = (LiveAnalysis::default(), Control::default());
    let design = design("12.55 Hz");
    let found = attractors(&analysis, &design, 7);
    response(&analysis, &design, 8, 12.4, 12.6);
    response(&analysis, &design, 9, 12.2, 12.7);
    response(&analysis, &design, 10, 12.8, 13.0);
    let mut orbits = Vec::new();
    for own in &found.basins.attractors {
        let place = AttractorPlace {
            attractors: 7,
            attractor: own.id.clone(),
        };
        let sought = SoughtOrbit::Attractor(place.clone());
        let point = analysis
            .branch_point(8, &sought, &control)
            .unwrap()
            .unwrap();
        let orbit = analysis
            .orbit(&OrbitPlace::Branch(point), &control)
            .unwrap();
        assert_eq!(orbit.attractors, [place]);
        assert_eq!(analysis.branch_point(10, &sought, &control).unwrap(), None);

        // The numbers of a link lead to it in another response.
        let sought = SoughtOrbit::Identified(OrbitIdentity {
            parameter: 12.55,
            period_cycles: 1,
            section: orbit.section,
            bifurcation: None,
        });
        let point = analysis
            .branch_point(9, &sought, &control)
            .unwrap()
            .unwrap();
        let again = analysis
            .orbit(&OrbitPlace::Branch(point), &control)
            .unwrap();
        assert!(is_same(&orbit, &again));
        assert_eq!(analysis.branch_point(10, &sought, &control).unwrap(), None);
        orbits.push(orbit);
    }
    assert!(!is_same(&orbits[0], &orbits[1]));
}

/// At 12.7 Hz most starts end on a torus.
#[test]
fn a_torus_has_a_section_and_a_history() {
    let (analysis, control) = (LiveAnalysis::default(), Control::default());
    let found = attractors(&analysis, &design("12.7 Hz"), 3);
    let torus = found.basins.attractors.iter().find(|own| own.id == "torus");
    let torus = torus.unwrap();
    let place = AttractorPlace {
        attractors: 3,
        attractor: "torus".to_owned(),
    };
    let motion = analysis.aperiodic_motion(&place, &control).unwrap();
    assert_eq!(motion.section.len(), motion.cycles as usize + 1);
    assert!((motion.mean_power_w / torus.mean_power_w - 1.0).abs() < 0.05);
    // The history passes the section at the start of each of its cycles.
    let samples = motion.history.len() / motion.history_cycles;
    for (cycle, start) in motion.history.chunks(samples).enumerate() {
        let difference_m = start[0].displacement_m - motion.section[cycle].displacement_m;
        assert!(difference_m.abs() < 1e-9, "{cycle}: {difference_m}");
    }
    // No two points of the section are one: the motion has no period.
    let [first, rest @ ..] = &motion.section[..] else {
        panic!("no section")
    };
    let nearest_m = rest.iter().map(|own| {
        let away_m = own.displacement_m - first.displacement_m;
        away_m.hypot((own.velocity_m_s - first.velocity_m_s) / 80.0)
    });
    assert!(nearest_m.fold(f64::INFINITY, f64::min) > 1e-9);
    let without = AttractorPlace {
        attractor: "1z".to_owned(),
        ..place
    };
    let missing = analysis.aperiodic_motion(&without, &control).unwrap_err();
    assert!(missing.to_string().starts_with("attractor is 1z"));
}
