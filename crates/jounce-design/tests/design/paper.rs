//! The paper's harvester at 11 Hz and 50 N: what its strain limit costs.
//!
//! The strain of a limit is that of the outer face of the patch, at its largest place and time, with
//! all harmonics. Its closed-form estimates take the first mode of a cantilever under its inertia,
//! with the stiffness of the patch.

use super::problem_of;
use jounce_control::Control;
use jounce_design::{DesignOutcome, SearchEnd, design};
use jounce_spec::SpecFile;
use std::f64::consts::TAU;
use std::path::Path;

/// Frequency of the drive, Hz, and one near the first resonance.
const DRIVE_HZ: f64 = 11.0;
const RESONANCE_HZ: f64 = 8.67;

fn paper() -> SpecFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/impact-harvester-2019/harvester.toml");
    SpecFile::read(&path).unwrap()
}

fn outcome(file: &SpecFile, drive_hz: f64, text: &str) -> DesignOutcome {
    let mut file = file.clone();
    file.set("drive.shaker.frequency", &format!("{drive_hz} Hz"))
        .unwrap();
    file.set("drive.shaker.amplitude", "50 N").unwrap();
    let problem = problem_of(&file.text(), text).unwrap();
    design(&problem, &Control::default(), None, None).unwrap()
}

/// Length of the beam, both ends of the patch and the contact point, m.
const LENGTH_M: f64 = 0.315;
const PATCH_M: [f64; 2] = [0.009, 0.094];
const CONTACT_M: f64 = 0.305;

/// Bending stiffness of the covered beam relative to the bare one; height of the outer face of the
/// patch above the neutral axis, m; coupling, N m/V; capacitance, F.
const STIFFNESS: f64 = 1.42861;
const OUTER_M: f64 = 0.98e-3 + 0.3e-3 - 0.57001e-3;
const COUPLING: f64 = 8.6639e-5;
const CAPACITANCE_F: f64 = 177e-9;

/// First mode of a uniform cantilever.
fn mode(x_m: f64) -> f64 {
    let k = 1.875_104_068_711_961_f64;
    let ratio = (k.cosh() + k.cos()) / (k.sinh() + k.sin());
    let z = k * x_m / LENGTH_M;
    z.cosh() - z.cos() - ratio * (z.sinh() - z.sin())
}

/// Integral by the midpoint rule.
fn integral([from, to]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    const CELLS: u32 = 400;
    let width = (to - from) / f64::from(CELLS);
    let middle = |k: u32| from + width * (f64::from(k) + 0.5);
    (0..CELLS).map(|k| width * function(middle(k))).sum()
}

/// Curvature under the inertia of the mode, in any unit.
fn curvature(x_m: f64) -> f64 {
    let moment = integral([x_m, LENGTH_M], |s| mode(s) * (s - x_m));
    match (PATCH_M[0]..=PATCH_M[1]).contains(&x_m) {
        true => moment / STIFFNESS,
        false => moment,
    }
}

/// Strain at the root of the patch per displacement of the contact point, 1/m.
fn strain_per_displacement() -> f64 {
    let displacement = integral([0.0, CONTACT_M], |x| (CONTACT_M - x) * curvature(x));
    OUTER_M * curvature(PATCH_M[0]) / displacement
}

/// Largest power of a sinusoidal motion with a strain at the root of the patch, W: with the slope
/// difference `s` of its ends, the current `i w gamma s` gives `w gamma^2 s^2 / (4 C)` to
/// `R = 1 / (w C)`.
fn largest_power_w(drive_hz: f64, strain: f64) -> f64 {
    let slope = integral(PATCH_M, curvature) / curvature(PATCH_M[0]) * strain / OUTER_M;
    TAU * drive_hz * (COUPLING * slope).powi(2) / (4.0 * CAPACITANCE_F)
}

/// A design found by a search over runs: gap 1 mm, 391 N/m^1.5 and 75 kohm give 3.8 mW. Its strain is
/// 894 ppm; the closed form gives 942 ppm at the 43 mm that the contact point travels, which are those of
/// the table and of the harmonics too.
#[test]
fn a_design_of_3_8_milliwatts_strains_its_patch_by_900_ppm() {
    let mut file = paper();
    file.set("stop.tip.stiffness", "391 N/m^1.5").unwrap();
    let found = outcome(
        &file,
        DRIVE_HZ,
        "evaluations = 4\n[free]\n\"circuit.load.resistance\" = \"75kohm:75.01kohm\"\n\
         [goal]\nmaximise = \"stable-power\"\nstarts = 20\n\
         [limits]\n\"patch.mfc.strain\" = \"1\"\n\"stop.tip.displacement\" = \"1 m\"\n",
    );
    let [strain, travel] = [&found.limits[0], &found.limits[1]].map(|one| one.value);
    let by_hand = strain_per_displacement() * travel;
    eprintln!("strain {strain}, by hand {by_hand}, travel {travel} m");
    assert!(
        (found.best.mean_power_w / 3.766e-3 - 1.0).abs() < 1e-3,
        "{found:?}"
    );
    assert!((strain / 8.94e-4 - 1.0).abs() < 1e-3, "{strain}");
    assert!((by_hand / strain - 1.0).abs() < 0.1, "{by_hand} {strain}");
}

/// At 600 ppm a sinusoidal motion of this beam at 11 Hz gives 2.5 mW at most; 3.5 mW needs 715 ppm.
/// Without its stop, near its first resonance, the harvester has this ratio of power and strain.
#[test]
fn power_within_a_strain_is_bounded_by_a_closed_form() {
    let mut file = paper();
    file.set("stop.tip", "").unwrap();
    let load_ohm = 1.0 / (TAU * RESONANCE_HZ * CAPACITANCE_F);
    let text = format!(
        "evaluations = 4\n[free]\n\"circuit.load.resistance\" = \"{load_ohm}ohm:{}ohm\"\n\
         [goal]\nmaximise = \"stable-power\"\nstarts = 4\n[limits]\n\"patch.mfc.strain\" = \"1\"\n",
        1.001 * load_ohm
    );
    let found = outcome(&file, RESONANCE_HZ, &text);
    let (power_w, strain) = (found.best.mean_power_w, found.limits[0].value);
    let bound_w = largest_power_w(RESONANCE_HZ, strain);
    eprintln!(
        "{power_w} W at {strain}, bound {bound_w} W, at 600 ppm {} W",
        largest_power_w(DRIVE_HZ, 6e-4)
    );
    assert!(
        (power_w / bound_w - 1.0).abs() < 0.03,
        "{power_w} {bound_w}"
    );
    assert!(largest_power_w(DRIVE_HZ, 7.0e-4) < 3.5e-3);
}

/// Three searches for the best gap, stiffness and load within 600 ppm, each with its own starts: all
/// lead to the same power, which at least 90 % of the starts reach. Ten seeds do so too.
#[test]
#[ignore = "long: runs with ./test --long"]
fn three_seeds_lead_to_the_same_power() {
    let search = |seed: u64| {
        let text = format!(
            "seed = {seed}\nevaluations = 1000\n[free]\n\"stop.tip.gap\" = \"0.2mm:3mm\"\n\
             \"stop.tip.stiffness\" = \"100:1e5:log N/m^1.5\"\n\"circuit.load.resistance\" = \"10kohm:3Mohm:log\"\n\
             [goal]\nmaximise = \"expected-power\"\nstarts = 50\n\
             [limits]\n\"patch.mfc.strain\" = \"600 ppm\"\nbasin_fraction = 0.9\n"
        );
        outcome(&paper(), DRIVE_HZ, &text)
    };
    let all: Vec<DesignOutcome> = (1..=3).map(search).collect();
    let powers: Vec<f64> = all.iter().map(|one| one.best.mean_power_w).collect();
    let largest = powers.iter().copied().fold(0.0, f64::max);
    assert!(largest < largest_power_w(DRIVE_HZ, 6e-4), "{powers:?}");
    for one in &all {
        let best = &one.best;
        assert!(one.feasible && best.basin_fraction >= 0.9, "{one:?}");
        assert!(best.mean_power_w > 0.97 * largest, "{powers:?}");
        assert!(best.expected_power_w > 0.9 * best.mean_power_w, "{best:?}");
        assert!(one.limits[0].value <= 6e-4, "{one:?}");
    }
}

/// A search converges only where it has found the optimum of each combination of choices as often as
/// that of the best one: here the laminate with a Hertz stop has 1.96 mW, and a Hunt-Crossley stop,
/// to which more starts lead, 1.09 mW.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_search_over_choices_converges_with_all_of_them() {
    let text = "seed = 3\nevaluations = 1000\n[free]\n\"patch.mfc.section\" = [\"thin-skin\", \"laminate\"]\n\
        \"stop.tip.gap\" = \"0.2mm:3mm\"\n\"stop.tip\" = [{ law = \"hertz\", stiffness = \"100:1e5:log N/m^1.5\" }, \
        { law = \"hunt-crossley\", damping = \"0.01:1:log s/m\" }, { law = \"spring\", stiffness = \"2e3 N/m\" }]\n\
        [goal]\nmaximise = \"stable-power\"\nstarts = 10\n";
    let problem = problem_of(&paper().text(), text).unwrap();
    let found = design(&problem, &Control::default(), None, None).unwrap();
    let power_w = found.best.mean_power_w;
    assert!(
        power_w > 1.9e-3 || found.ended_by != SearchEnd::Converged,
        "{power_w} {:?}",
        found.ended_by
    );
}
