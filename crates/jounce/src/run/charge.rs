//! The balance of charge behind a rectifier over the averaging window.
//!
//! ```text
//! Q = integral V / R dt + integral V / R_leak dt + C (V_end - V_start)
//! ```
//!
//! `Q` (C) is what the diodes pass, which the march counts at the patches: what they displaced and did not keep. The right side is what the
//! storage (capacitance `C`, F, voltage `V`) makes of it, from the voltage along the record by quadrature. So the two sides share nothing
//! but the motion.
//!
//! Validation: `tests/march/rectified.rs`, 6e-15 behind a bridge and both kinds of SSHI, beside a stop; 2e-12 behind diodes that settle
//! within 1/4000 of a step.

use super::{RunAnswer, RunPlan};
use crate::march::Kernel;
use crate::plant::{Scheme, Storage};
use serde::Serialize;

/// Where the charge of one rectified circuit went within the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChargeAnswer {
    /// Name of the circuit.
    pub name: String,
    /// Passed by the diodes, C.
    pub passed_c: f64,
    /// Through the load, C.
    pub load_c: f64,
    /// Through the leakage of the storage, C.
    pub leakage_c: f64,
    /// Kept by the storage, C.
    pub storage_c: f64,
    /// What is left over, as a part of the largest of these.
    pub residual_relative: f64,
}

/// Places and weights of Kronrod's rule with 15 points on (-1, 1), and the weights of Gauss's with 7, at every second place.
/// Source: Piessens et al., QUADPACK (1983).
const KRONROD: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_225, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_7),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];

/// Relative difference of the two rules at which a panel is accepted, ...
const AGREED: f64 = 1e-12;
/// ... and how much more of it each halving lets pass: what a small piece leaves counts less, and roundoff ends the halving.
const MORE: f64 = 8.0;
/// Most halvings of a panel.
const MOST_HALVINGS: usize = 12;
/// Each piece of a step is this many times as long as what lies before it.
const GRADING: f64 = 16.0;

/// The charges of every circuit whose diodes feed a capacitor. The run must keep a record of its averaging window (see
/// [`RunPlan::balancing`]); without one there is no answer.
pub fn charges(kernel: &Kernel, answer: &RunAnswer, plan: &RunPlan) -> Vec<ChargeAnswer> {
    let plant = &kernel.plant;
    let from_s = plan.duration_s - plan.average_over_s;
    let recorded = answer.trajectory.segments().first().is_some_and(|first| first.start_s <= from_s * (1.0 + 1e-12));
    let mut found = Vec::new();
    for (k, bridge) in plant.system.bridges.iter().enumerate().filter(|_| recorded) {
        let (Storage::Capacitor { capacitance_f, load_ohm }, Some(node)) = (bridge.storage, plant.electrical.bridges[k].storage) else {
            continue;
        };
        // What extracts energy passes no charge.
        if matches!(bridge.scheme, Scheme::Extraction { .. }) {
            continue;
        }
        let place = 2 * plant.system.modes.len() + node;
        let voltages = |times_s: &[f64]| answer.trajectory.physical_at(kernel, times_s, place);
        let flux_v_s = integral(panels(kernel, answer, from_s, plan.duration_s), voltages);
        let kept_v = answer.end.voltage_v[node] - voltages(&[from_s]).first().copied().unwrap_or(f64::NAN);
        let passed_c = answer.rectified[k].mean_current_a * plan.average_over_s;
        let (load_c, leakage_c) = (flux_v_s / load_ohm, bridge.leakage_ohm.map_or(0.0, |ohm| flux_v_s / ohm));
        let storage_c = capacitance_f * kept_v;
        let largest_c = [passed_c, load_c, leakage_c, storage_c].iter().fold(0.0_f64, |max, charge| max.max(charge.abs()));
        let left_c = passed_c - load_c - leakage_c - storage_c;
        let residual_relative = if largest_c > 0.0 { left_c / largest_c } else { 0.0 };
        found.push(ChargeAnswer { name: bridge.name.clone(), passed_c, load_c, leakage_c, storage_c, residual_relative });
    }
    found
}

/// The steps of the record between two times, in pieces: start and length, s. Nothing jumps within one.
fn panels(kernel: &Kernel, answer: &RunAnswer, from_s: f64, to_s: f64) -> Vec<(f64, f64)> {
    let within = answer.trajectory.segments().iter().flat_map(|segment| {
        let (start_s, end_s) = (segment.start_s.max(from_s), (segment.start_s + segment.length_s).min(to_s));
        let fastest_rad_s = kernel.in_regime(segment.regime).map_or(0.0, |own| own.plant.fastest_rad_s());
        graded(start_s, end_s - start_s, fastest_rad_s)
    });
    within.filter(|(_, length_s)| *length_s > 0.0).collect()
}

/// A step in pieces, the first of which ends before the fastest rate has decayed. Diodes that settle within less than the distance from the
/// start of a step to its first place would be seen by neither rule, and both would agree.
fn graded(start_s: f64, length_s: f64, fastest_rad_s: f64) -> Vec<(f64, f64)> {
    let mut ends_s = vec![length_s];
    while let Some(first_s) = ends_s.last().copied().filter(|first_s| first_s * fastest_rad_s > 1.0) {
        ends_s.push(first_s / GRADING);
    }
    let mut after_s = 0.0;
    let piece = |end_s: f64| {
        let from_s = std::mem::replace(&mut after_s, end_s);
        (start_s + from_s, end_s - from_s)
    };
    ends_s.into_iter().rev().map(piece).collect()
}

/// Integral over panels of a function that is asked at ascending times, many at once; panels where the two rules differ are halved.
fn integral(mut panels: Vec<(f64, f64)>, values: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
    let places: Vec<(f64, f64, f64)> = KRONROD.iter().map(|(x, k, g)| (-x, *k, *g)).chain(KRONROD.iter().rev().skip(1).copied()).collect();
    let mut sum = 0.0;
    for halving in 0..=MOST_HALVINGS {
        let times: Vec<f64> =
            panels.iter().flat_map(|(start, length)| places.iter().map(move |(x, ..)| start + 0.5 * length * (1.0 + x))).collect();
        let found = values(&times);
        let mut rough = Vec::new();
        let agreed = AGREED * MORE.powi(halving as i32);
        for (panel, own) in panels.iter().zip(found.chunks_exact(places.len())) {
            let weighed = |weight: fn(&(f64, f64, f64)) -> f64| -> f64 {
                0.5 * panel.1 * places.iter().zip(own).map(|(place, value)| weight(place) * value).sum::<f64>()
            };
            let (kronrod, gauss) = (weighed(|place| place.1), weighed(|place| place.2));
            if (kronrod - gauss).abs() <= agreed * kronrod.abs() || halving == MOST_HALVINGS {
                sum += kronrod;
            } else {
                let half = 0.5 * panel.1;
                rough.extend([(panel.0, half), (panel.0 + half, half)]);
            }
        }
        panels = rough;
        if panels.is_empty() {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fast decay at the start of one of two panels, and a sine: measured 1e-15.
    #[test]
    fn panels_are_halved_until_the_rules_agree() {
        let value = |t: f64| (-400.0 * t).exp() + t.sin();
        let exact = (1.0 - (-400.0_f64 * 3.0).exp()) / 400.0 + 1.0 - 3.0_f64.cos();
        let found = integral(vec![(0.0, 1.0), (1.0, 2.0)], |times| times.iter().map(|t| value(*t)).collect());
        assert!((found / exact - 1.0).abs() < 1e-12, "{:e}", found / exact - 1.0);
    }

    /// Decays from a twentieth of a panel to 1e-9 of it, on a sine: the closed form to 1e-14. On one panel both rules agree beside it.
    #[test]
    fn what_decays_within_a_small_part_of_a_panel_is_seen() {
        for rate in [20.0, 1e3, 4e3, 1e5, 1e9_f64] {
            let value = |t: f64| 1.0 + t.sin() + 1e-3 * (-rate * t).exp();
            let exact = 2.0 - 1.0_f64.cos() - 1e-3 * (-rate).exp_m1() / rate;
            let over = |panels| integral(panels, |times| times.iter().map(|t| value(*t)).collect()) / exact - 1.0;
            let (whole, pieces) = (over(vec![(0.0, 1.0)]), over(graded(0.0, 1.0, rate)));
            eprintln!("rate {rate:e}: {whole:.1e} on one panel, {pieces:.1e} on {} pieces", graded(0.0, 1.0, rate).len());
            assert!(pieces.abs() < 1e-14, "{pieces:e}");
        }
    }
}
