//! The live page against the questions of the command line.

use jounce::live::{
    AttractorPlace, BranchPlace, Design, KeySpan, LiveAnalysis, OrbitPlace, OrbitResult,
    ResponseOptions,
};
use jounce::{BasinsOptions, Control, Harvester, RunOptions};
use jounce_analysis::{BranchSearch, Model, OrbitMethodKind, Parameter};

pub(crate) fn paper() -> Harvester {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/impact-harvester-2019/harvester.toml"
    );
    Harvester::read(path).unwrap()
}

fn span() -> KeySpan {
    KeySpan {
        over: "drive.shaker.frequency".into(),
        from: 12.8,
        to: 13.0,
    }
}

/// Orbit of the first point of the first branch of a response, at a value of its key if one is given.
fn first_orbit(
    harvester: &Harvester,
    span: &KeySpan,
    options: &ResponseOptions,
    parameter: Option<f64>,
) -> OrbitResult {
    let (analysis, control) = (LiveAnalysis::default(), Control::default());
    let design = Design::new(harvester, &[]).unwrap();
    analysis
        .fine_response(1, &design, span, options, &control)
        .unwrap();
    let place = OrbitPlace::Branch(BranchPlace {
        response: 1,
        branch: 0,
        point: 0,
        parameter,
    });
    analysis.orbit(&place, &control).unwrap()
}

#[test]
fn the_fine_response_is_the_search_of_branch_and_its_orbits_are_found_again() {
    let (harvester, analysis, control) = (paper(), LiveAnalysis::default(), Control::default());
    let design = Design::new(&harvester, &[]).unwrap();
    let (span, options) = (span(), ResponseOptions::default());
    let fine = analysis
        .fine_response(5, &design, &span, &options, &control)
        .unwrap();

    let base = Model::new(harvester.spec().clone()).unwrap();
    let key = harvester.file().numeric_key(&span.over).unwrap();
    let parameter = Parameter::new(&base, &key, span.to - span.from);
    let search = BranchSearch {
        base: &base,
        parameter: &parameter,
        range: (span.from, span.to),
        method: OrbitMethodKind::Shooting,
        tolerance: options.tolerance,
        seeds: options.seeds,
        longest_period: options.longest_period,
    };
    let expected = search.run().unwrap();
    assert_eq!(fine.branches.len(), expected.len());
    for (branch, expected) in fine.branches.iter().zip(&expected) {
        let powers_w: Vec<f64> = expected
            .points
            .iter()
            .map(|point| point.orbit.mean_power_w)
            .collect();
        assert_eq!(branch.mean_power_w, powers_w);
    }

    let place = |response, point| {
        OrbitPlace::Branch(BranchPlace {
            response,
            branch: 0,
            point,
            parameter: None,
        })
    };
    let orbit = analysis.orbit(&place(5, 0), &control).unwrap();
    let ratio = orbit.mean_power_w / fine.branches[0].mean_power_w[0];
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
    assert_eq!(orbit.time_s.len(), orbit.stops[0].displacement_m.len());
    let missing = analysis.orbit(&place(5, 1_000_000), &control).unwrap_err();
    assert!(missing.to_string().starts_with("point is 1000000"));
    let missing = analysis.orbit(&place(6, 0), &control).unwrap_err();
    assert!(missing.to_string().starts_with("response is 6"));
    let width = analysis.bandwidth(5, &options, &control).unwrap().unwrap();
    assert!(width.width > 0.0 && width.width <= span.to - span.from);
}

/// At 12.55 Hz a period-1 orbit without contact and one with contact attract (`jounce basins`).
#[test]
fn the_orbit_of_an_attractor_is_its_own_and_a_point_of_a_branch_is_recognised_by_its_motion() {
    let harvester = paper();
    let (analysis, control) = (LiveAnalysis::default(), Control::default());
    let frequency = |value: &str| ("drive.shaker.frequency".to_owned(), value.to_owned());
    let design = Design::new(&harvester, &[frequency("12.55 Hz")]).unwrap();
    let basins = BasinsOptions {
        starts: 40,
        ..Default::default()
    };
    let found = analysis
        .operating_point(&design, &basins, &control)
        .unwrap();
    analysis.store_attractors(7, &design, &found.basins);
    let place = |id: &str| AttractorPlace {
        attractors: 7,
        attractor: id.to_owned(),
    };
    assert_eq!(found.basins.attractors.len(), 2);
    for own in &found.basins.attractors {
        let orbit = OrbitPlace::Attractor(place(&own.id));
        let orbit = analysis.orbit(&orbit, &control).unwrap();
        assert_eq!(orbit.attractors, [place(&own.id)]);
        assert_eq!(orbit.mean_power_w, own.mean_power_w);
    }
    let missing = OrbitPlace::Attractor(place("9z"));
    let missing = analysis.orbit(&missing, &control).unwrap_err();
    assert!(missing.to_string().starts_with("attractor is 9z"));

    let span = KeySpan {
        from: 12.4,
        to: 12.6,
        ..span()
    };
    let options = ResponseOptions::default();
    let fine = analysis
        .fine_response(8, &design, &span, &options, &control)
        .unwrap();
    let mut recognised = Vec::new();
    for (number, branch) in fine.branches.iter().enumerate() {
        for (point, ends) in branch.parameter.windows(2).enumerate() {
            if (ends[0] - 12.55) * (ends[1] - 12.55) > 0.0 {
                continue;
            }
            let own = OrbitPlace::Branch(BranchPlace {
                response: 8,
                branch: number,
                point,
                parameter: Some(12.55),
            });
            let orbit = analysis.orbit(&own, &control).unwrap();
            assert_eq!(orbit.stable, orbit.attractors.len() == 1);
            for place in orbit.attractors {
                let mut all = found.basins.attractors.iter();
                let same = all.find(|own| own.id == place.attractor).unwrap();
                assert!((orbit.mean_power_w / same.mean_power_w - 1.0).abs() < 1e-5);
                recognised.push(place.attractor);
            }
        }
    }
    recognised.sort();
    assert_eq!(recognised, ["1a", "1b"]);
}

#[test]
fn a_reversed_range_and_a_key_without_a_number_are_refused() {
    let harvester = paper();
    let path = [("run.start".to_owned(), "./secret.json".to_owned())];
    let error = Design::new(&harvester, &path).unwrap_err();
    assert!(error.to_string().contains("give a key with a number"));
    let reversed = KeySpan {
        from: 13.0,
        to: 12.0,
        ..span()
    };
    let error = reversed.text(&Design::new(&harvester, &[]).unwrap());
    assert!(
        error
            .unwrap_err()
            .to_string()
            .contains("smaller to a larger")
    );
}

/// The displacement of a plate, continued from the cells to its corner, is the one towards the stop
/// there.
#[test]
fn a_plate_moves_as_the_point_that_strikes() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/plate-de-marqui-2009/stop.toml"
    );
    let span = KeySpan {
        over: "drive.shaker.frequency".into(),
        from: 54.0,
        to: 55.0,
    };
    let options = ResponseOptions {
        seeds: 0,
        ..Default::default()
    };
    let orbit = first_orbit(&Harvester::read(path).unwrap(), &span, &options, None);
    assert!(orbit.beams.is_empty() && orbit.period_cycles == 1);
    let (plate, stop) = (&orbit.plates[0], &orbit.stops[0]);
    assert_eq!((plate.name.as_str(), plate.size_m), ("plate", [0.1, 0.06]));
    let ratio = stop.displacement_m.len() / plate.displacement_m.len();
    let largest_m = plate.max_displacement_m();
    for (instant, columns) in plate.displacement_m.iter().enumerate() {
        let (i, j) = (columns.len() - 1, columns[0].len() - 1);
        let corner_m = 2.0 * columns[i][j] - 0.5 * (columns[i - 1][j] + columns[i][j - 1]);
        let expected_m = stop.displacement_m[instant * ratio];
        assert!(
            (corner_m - expected_m).abs() < 2e-3 * largest_m,
            "{instant}: {corner_m} {expected_m}"
        );
    }
    assert_eq!(plate.pictures().unwrap().len(), 24);
}

/// A contact with a stiff stop is as short as the interval between the equal samples of an orbit. The
/// largest force is that of a run.
#[test]
fn the_force_of_a_short_contact_has_its_peak() {
    let spec = "modal.h = { frequency_hz = [10.0], damping_ratio = [0.05], participation_sqrt_kg = [1.0], point.tip = [1.0] }
        drive.d = { at = 'h.tip', amplitude = '4 N', frequency = '12 Hz' }
        run.duration = '20 s'
        [stop.s]
        at = 'h.tip'
        side = 'positive'
        gap = '1 mm'
        law = 'hunt-crossley'
        stiffness = '1e11 N/m^1.5'
        damping = '1 s/m'";
    let harvester = Harvester::from_text(spec, ".").unwrap();
    let span = KeySpan {
        over: "drive.d.frequency".into(),
        from: 11.9,
        to: 12.1,
    };
    let orbit = first_orbit(&harvester, &span, &ResponseOptions::default(), Some(12.0));
    let run = harvester.run(&RunOptions::default()).unwrap();
    let expected_n = run.max_contact_force_n;
    let peak_n = |force_n: &[f64]| force_n.iter().copied().fold(0.0, f64::max);
    let [dense_n, even_n] =
        [&orbit.forces.force_n[0], &orbit.stops[0].force_n].map(|own| peak_n(own));
    assert!(
        (dense_n / expected_n - 1.0).abs() < 1e-2,
        "{dense_n} {expected_n}"
    );
    assert!(
        even_n < 0.97 * expected_n,
        "the contact is not short: {even_n} {expected_n}"
    );
    assert!(orbit.forces.time_s.is_sorted());
}
