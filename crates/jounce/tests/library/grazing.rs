//! Derivatives next to a grazing: a linear oscillator whose amplitude is nearly the gap of its stop.

use jounce::{Harvester, SensitivityOptions, SensitivityResult};
use jounce_linalg::c64;
use std::f64::consts::TAU;

const SPEC: &str = r#"
[modal.m]
frequency_hz = [10.0]
damping_ratio = [0.02]
[modal.m.point]
tip = [1.3]
[modal.m.patch.p]
coupling_n_per_v = [0.004]
capacitance = "150 nF"
[circuit.load]
patch = "m.p"
resistance = "80 kohm"
[stop.s]
at = "m.tip"
gap = "GAP m"
LAW
[drive.d]
at = "m.tip"
kind = "force"
amplitude = "0.7 N"
frequency = "9.7 Hz"
[run]
duration = "1 s"
average_over = "1 s"
"#;

const KELVIN_VOIGT: &str =
    "law = \"kelvin-voigt\"\nstiffness = \"0.1 N/m\"\ndamping = \"0.05 N s/m\"";
const HERTZ: &str = "law = \"hertz\"\nstiffness = \"1000 N/m^1.5\"";
const RIGID: &str = "law = \"rigid\"\nrestitution = 0.5";

/// Force, N; angular frequency of the drive, rad/s; dashpot of the stop, N s/m.
const FORCE_N: f64 = 0.7;
const DRIVE_RAD_S: f64 = TAU * 9.7;
const DASHPOT_N_S_M: f64 = 0.05;

/// Displacement per force, m/N, and voltage per displacement, V/m, at an angular frequency.
fn responses(w: f64) -> [c64; 2] {
    let (mass_kg, natural) = (1.3_f64.powi(-2), TAU * 10.0);
    let coupling = 0.004 / 1.3;
    let i = c64::new(0.0, 1.0);
    let voltage = i * w * coupling / (1.0 / 80e3 + i * w * 150e-9);
    let mechanical = c64::new(natural * natural - w * w, 2.0 * 0.02 * natural * w) * mass_kg;
    [(mechanical + voltage * coupling).inv(), voltage]
}

fn amplitude_m() -> f64 {
    FORCE_N * responses(DRIVE_RAD_S)[0].norm()
}

/// Returns the sensitivities with a gap less than the amplitude by a fraction of it.
fn at(law: &str, beyond: f64) -> SensitivityResult {
    let gap_m = amplitude_m() * (1.0 - beyond);
    let text = SPEC
        .replace("GAP", &format!("{gap_m:e}"))
        .replace("LAW", law);
    let keys = ["stop.s.gap", "drive.d.amplitude"];
    let options = SensitivityOptions {
        key: keys.map(str::to_owned).to_vec(),
        starts: 3,
        ..Default::default()
    };
    let harvester = Harvester::from_text(&text, "").unwrap();
    harvester.sensitivity(&options).unwrap()
}

/// Returns the derivative of the mean power and the change to the grazing, of a key.
fn of(result: &SensitivityResult, key: &str) -> (f64, f64) {
    let row = result.keys.iter().find(|row| row.key == key).unwrap();
    (row.derivatives[0].derivative, row.grazing_change.unwrap())
}

/// A turning point `d` past the surface of a dashpot changes the momentum by `J = c d` in each period
/// `T`. That is a force `-(2 J / T) e^(i arg x)` at the frequency of the drive, so that the power
/// changes by `dP = -P (4 J / (T F)) cos arg x`; and the displacement at this time, in all harmonics,
/// by `-J G`, `G = (H(0) + 2 Re sum H(n w)) / T`.
#[test]
fn a_derivative_jumps_by_its_closed_form_at_a_grazing_of_a_dashpot() {
    let [displacement, voltage] = responses(DRIVE_RAD_S);
    let period_s = TAU / DRIVE_RAD_S;
    let power_w = (voltage * amplitude_m()).norm_sqr() / (2.0 * 80e3);
    let harmonics: f64 = (1..2000)
        .map(|n| 2.0 * responses(f64::from(n) * DRIVE_RAD_S)[0].re)
        .sum();
    let returned_m_per_n_s = (responses(1e-9)[0].re + harmonics) / period_s;
    let impulse_n_s_m = DASHPOT_N_S_M / (1.0 + DASHPOT_N_S_M * returned_m_per_n_s);
    let cosine = displacement.re / displacement.norm();
    let jump = power_w * 4.0 * impulse_n_s_m * cosine / (period_s * FORCE_N);

    let [outside, inside] = [-1e-6, 1e-7].map(|beyond| at(KELVIN_VOIGT, beyond));
    let [(by_gap_outside, change), (by_gap_inside, _)] =
        [&outside, &inside].map(|found| of(found, "stop.s.gap"));
    eprintln!("{by_gap_inside} W/m, closed form {jump} W/m");
    // The spring adds a part of the order of k / c sqrt(2 d / a) to the impulse.
    assert!(
        (by_gap_inside / jump - 1.0).abs() < 1e-3,
        "{by_gap_inside} {jump}"
    );
    assert_eq!(by_gap_outside, 0.0);
    // Without contact the amplitude is proportional to the force and does not depend on the gap.
    let excess_m = amplitude_m() * 1e-6;
    assert!((change / -excess_m - 1.0).abs() < 1e-6, "{change}");
    let (_, force_change_n) = of(&outside, "drive.d.amplitude");
    assert!(
        (force_change_n / (FORCE_N * 1e-6) - 1.0).abs() < 1e-6,
        "{force_change_n}"
    );
    let sides = [&outside, &inside].map(|found| found.grazing.clone().unwrap());
    assert_eq!(
        sides.each_ref().map(|one| one.side),
        ["no-contact", "contact"]
    );
    assert!(
        sides
            .iter()
            .all(|one| one.across == "jump" && one.turning_point == "maximum")
    );
    let texts = [&outside, &inside].map(|found| found.grazing_text().unwrap());
    assert!(texts[0].contains("a contact appears") && texts[1].contains("a contact vanishes"));
    assert!(at(KELVIN_VOIGT, -1.0).grazing_text().is_none());
}

/// With Hertz's law the impulse is of the order of the square of the distance, so that the derivative
/// by the gap is nearly 0 next to the grazing, as without contact.
#[test]
fn a_derivative_is_continuous_at_a_grazing_with_hertz_law() {
    let [near, far] = [1e-6, 1e-5].map(|beyond| at(HERTZ, beyond));
    let ratio = of(&far, "stop.s.gap").0 / of(&near, "stop.s.gap").0;
    assert!((ratio / 10.0 - 1.0).abs() < 0.05, "{ratio}");
    assert_eq!(near.grazing.unwrap().across, "continuous");
}

/// At a rigid stop the derivative grows with the inverse root of the distance.
#[test]
fn a_derivative_has_no_bound_at_a_grazing_of_a_rigid_stop() {
    let [far, near] = [1e-4, 1e-5].map(|beyond| at(RIGID, beyond));
    assert_eq!(far.period_cycles, near.period_cycles);
    let ratio = of(&near, "stop.s.gap").0 / of(&far, "stop.s.gap").0;
    assert!((ratio / 10.0_f64.sqrt() - 1.0).abs() < 0.01, "{ratio}");
    let grazing = near.grazing.unwrap();
    assert_eq!((grazing.across, grazing.side), ("unbounded", "contact"));
}
