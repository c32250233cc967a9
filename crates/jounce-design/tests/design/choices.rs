//! Free keys that are choices: materials, contact laws with their own keys, numbers.

use super::{LINEAR, outcome_of, problem_of};
use jounce_design::DesignOutcome;
use jounce_spec::SpecFile;

const STOP: &str =
    "[stop.s]\nat = \"m.tip\"\nlaw = \"hertz\"\ngap = \"1 mm\"\nstiffness = \"5e4 N/m^1.5\"\n";

fn impact() -> String {
    let driven = LINEAR.replace("amplitude = \"0.7 N\"", "amplitude = \"4 N\"");
    format!("{driven}{STOP}")
}

/// A design with some free keys, over the gap.
fn over_gap(spec: &str, free: &str, goal: &str) -> DesignOutcome {
    let text = format!(
        "evaluations = 400\n[free]\n\"stop.s.gap\" = \"0.2mm:1.5mm\"\n{free}[goal]\nmaximise = \"{goal}\"\nstarts = 4\n"
    );
    outcome_of(spec, &text)
}

fn with(spec: &str, values: &[(&str, &str)]) -> String {
    let mut file = SpecFile::from_text(spec);
    for (key, value) in values {
        file.set(key, value).unwrap();
    }
    file.spec().unwrap().to_toml()
}

/// The best of three laws, one with a range of its own, against a design of each law alone.
#[test]
fn a_contact_law_with_its_own_keys_is_the_best_of_designs_one_by_one() {
    let spec = impact();
    let goal = "stable-power";
    let free = "\"stop.s\" = [{ law = \"hertz\" }, { law = \"spring\", stiffness = \"2e3 N/m\" }, \
        { law = \"hunt-crossley\", damping = \"0.01:1:log s/m\" }]\n";
    let found = over_gap(&spec, free, goal);
    let hunt_crossley = with(
        &spec,
        &[
            ("stop.s.law", "hunt-crossley"),
            ("stop.s.damping", "0.1 s/m"),
        ],
    );
    let spring = with(
        &spec,
        &[("stop.s.law", "spring"), ("stop.s.stiffness", "2e3 N/m")],
    );
    let alone = [
        over_gap(&spec, "", goal),
        over_gap(&spring, "", goal),
        over_gap(
            &hunt_crossley,
            "\"stop.s.damping\" = \"0.01:1:log s/m\"\n",
            goal,
        ),
    ];
    let powers = alone.each_ref().map(|one| one.best.mean_power_w);
    let best = (0..3)
        .max_by(|a, b| powers[*a].total_cmp(&powers[*b]))
        .unwrap();
    let power = found.best.mean_power_w;
    assert!(
        (power / powers[best] - 1.0).abs() < 2e-3,
        "{power} {powers:?} {found:?}"
    );
    let laws = ["hertz", "spring", "hunt-crossley"];
    assert_eq!(found.best.set["stop.s.law"], laws[best]);
    let has = |key: &str| found.best.set.contains_key(key);
    assert_eq!(
        (has("stop.s.stiffness"), has("stop.s.damping")),
        (best == 1, best == 2)
    );
    // The settings are those of `--set`: the spec with them has the power of the design.
    let set: Vec<(&str, &str)> = found
        .best
        .set
        .iter()
        .map(|(key, value)| (key.as_str(), value.as_str()))
        .collect();
    let again = over_gap(&with(&spec, &set), "", goal);
    assert!((again.before.goals[goal] / power - 1.0).abs() < 1e-6);
}

const CANTILEVER: &str = "[beam.b]\nmaterial = \"steel\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"1 mm\"\n\
    [patch.p]\non = \"b\"\nmaterial = \"PZT-5A\"\nstart = \"0 mm\"\nlength = \"50 mm\"\nwidth = \"20 mm\"\nthickness = \"0.3 mm\"\n\
    [circuit.load]\npatch = \"p\"\nresistance = \"100 kohm\"\n\
    [drive.d]\nat = \"b.end\"\namplitude = \"0.1 N\"\nfrequency = \"20 Hz\"\n[damping]\nbeyond = 0.01\n\
    [reduction]\nmodes = 3\n[run]\nduration = \"1 s\"\naverage_over = \"1 s\"\n";

/// Two choices and a range: every combination computed alone.
#[test]
fn materials_of_beam_and_patch_are_the_best_of_all_combinations() {
    let design = |spec: &str, free: &str| {
        let text = format!(
            "evaluations = 300\n[free]\n{free}\"circuit.load.resistance\" = \"1kohm:10Mohm:log\"\n\
             [goal]\nmaximise = \"expected-power\"\nstarts = 2\n"
        );
        outcome_of(spec, &text)
    };
    let (beams, patches) = (["steel", "aluminium"], ["PZT-5A", "PZT-5H", "MFC-P2"]);
    let free = "\"beam.b.material\" = [\"steel\", \"aluminium\"]\n\"patch.p.material\" = [\"PZT-5A\", \"PZT-5H\", \"MFC-P2\"]\n";
    let found = design(CANTILEVER, free);
    let mut best = (0.0, "", "");
    for beam in beams {
        for patch in patches {
            let spec = with(
                CANTILEVER,
                &[("beam.b.material", beam), ("patch.p.material", patch)],
            );
            let power = design(&spec, "").best.mean_power_w;
            if power > best.0 {
                best = (power, beam, patch);
            }
        }
    }
    let set = &found.best.set;
    assert_eq!(
        (
            set["beam.b.material"].as_str(),
            set["patch.p.material"].as_str()
        ),
        (best.1, best.2)
    );
    assert!(
        (found.best.mean_power_w / best.0 - 1.0).abs() < 1e-8,
        "{found:?} {best:?}"
    );
}

#[test]
fn numbers_can_be_choices() {
    let text = "evaluations = 40\n[free]\n\"reduction.modes\" = [1, 3]\n\"drive.d.amplitude\" = [\"0.1 N\", \"0.2 N\"]\n\
        [goal]\nmaximise = \"expected-power\"\nstarts = 2\n";
    let found = outcome_of(CANTILEVER, text);
    let [modes, amplitude] = &found.best.keys[..] else {
        panic!("{found:?}")
    };
    assert_eq!(modes.before, "3");
    assert_eq!(amplitude.value, "0.2 N");
}

#[test]
fn a_choice_without_its_keys_names_what_is_missing() {
    let goal = "[goal]\nmaximise = \"expected-power\"\n";
    let error = |free: &str| {
        let text = format!("[free]\n{free}\n{goal}");
        problem_of(&impact(), &text).map_or_else(|error| error.to_string(), |_| String::new())
    };
    let missing = error("\"stop.s.law\" = [\"hertz\", \"hunt-crossley\"]");
    for part in [
        "line 2",
        "\"hunt-crossley\"",
        "`damping` is missing",
        "\"stop.s\" = [{ law = \"hertz\" }, { law = \"hunt-crossley\", damping = ",
    ] {
        assert!(missing.contains(part), "{part}: {missing}");
    }
    assert!(!missing.contains("--set"), "{missing}");
    let wrong_unit = error("\"stop.s\" = [{ law = \"hertz\" }, { law = \"spring\" }]");
    assert!(
        wrong_unit.contains("law = \"spring\"") && wrong_unit.contains("N/m^1.5"),
        "{wrong_unit}"
    );
    let unknown = error("\"stop.s.law\" = [\"hertz\", \"hertzz\"]");
    assert!(
        unknown.contains("did you mean `hertz`") && !unknown.contains("[{"),
        "{unknown}"
    );
    let twice = error("\"stop.s.frame\" = [\"ground\", \"ground\"]");
    assert!(twice.contains("lists \"ground\" twice"), "{twice}");
    let single = error("\"stop.s.law\" = [\"hertz\"]");
    assert!(single.contains("at least two"), "{single}");
    let both = error(
        "\"stop.s.stiffness\" = \"1e3:1e4 N/m^1.5\"\n\"stop.s\" = [{ law = \"hertz\" }, { law = \"spring\", stiffness = \"2e3 N/m\" }]",
    );
    assert!(
        both.contains("free.stop.s.stiffness") && both.contains("twice"),
        "{both}"
    );
    let range = error(
        "\"stop.s\" = [{ law = \"hertz\" }, { law = \"hunt-crossley\", damping = \"1:0.1 s/m\" }]",
    );
    assert!(
        range.contains("stop.s.damping") && range.contains("no range"),
        "{range}"
    );
}
