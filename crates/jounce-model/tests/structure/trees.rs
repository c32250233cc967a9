//! Beams on beams, masses on beams: against characteristic equations and receptances.

use crate::paper::{
    attached_mass, bare_cantilever, greatest_relative_difference, paper_beam, sprung_mass,
};
use jounce_model::reference::Cantilever;
use jounce_model::structure::{StructureError, modes, modes_holding};
use jounce_spec::{Beam, Spec};
use std::collections::BTreeMap;

const LENGTH_M: f64 = 0.315;
const STIFFNESS_N_M2: f64 = 65e9 * 0.03 * 0.98e-3 * 0.98e-3 * 0.98e-3 / 12.0;
const MASS_PER_LENGTH_KG_M: f64 = 2750.0 * 0.03 * 0.98e-3;

/// Left side of the characteristic equation of a cantilever with tip mass ratio `a` and inertia
/// ratio `c`, over `cosh` (Erturk and Inman, Smart Mater. Struct. 18 (2009) 025009).
fn characteristic(l: f64, a: f64, c: f64) -> f64 {
    let (sin, cos, tanh, part) = (l.sin(), l.cos(), l.tanh(), 1.0 / l.cosh());
    part + cos + l * a * (cos * tanh - sin) - l.powi(3) * c * (sin + tanh * cos)
        + l.powi(4) * a * c * (part - cos)
}

fn with_tip(mass_kg: f64, rotary_inertia_kg_m2: f64) -> Spec {
    let mut spec = bare_cantilever(6);
    spec.mass.insert(
        "tip".into(),
        attached_mass("beam.end", mass_kg, rotary_inertia_kg_m2),
    );
    spec
}

/// Measured: the residual over its slope, relative to the root, is below 2e-14.
#[test]
fn a_tip_mass_with_rotary_inertia_solves_its_characteristic_equation() {
    let beam_kg = MASS_PER_LENGTH_KG_M * LENGTH_M;
    for (a, c) in [(0.5, 0.0), (1.4, 0.0), (0.3, 0.02), (20.0, 1.5)] {
        let modal = modes(&with_tip(a * beam_kg, c * beam_kg * LENGTH_M * LENGTH_M)).unwrap();
        for frequency in &modal.frequency_rad_s {
            let root =
                (frequency * (MASS_PER_LENGTH_KG_M / STIFFNESS_N_M2).sqrt()).sqrt() * LENGTH_M;
            let slope = (characteristic(root * (1.0 + 1e-5), a, c)
                - characteristic(root * (1.0 - 1e-5), a, c))
                / 2e-5;
            let error = (characteristic(root, a, c) / slope).abs();
            assert!(error < 1e-12, "{a} {c}: {root} {error:e}");
        }
        assert_eq!(modal.shape["tip"], modal.shape["beam.end"]);
        // The base also moves the tip mass: mode 1 has most of the mass.
        let squares: f64 = modal
            .participation_sqrt_kg
            .iter()
            .map(|value| value * value)
            .sum();
        assert!(
            squares < beam_kg * (1.0 + a) && squares > beam_kg * (0.9 + a),
            "{squares}"
        );
    }
}

/// Characteristic equation of a beam of phase `l` on a rotating clamp, `c = EI / (k_r L)`, with a
/// tip mass ratio `a`, over `cosh`: from `w = A (cosh - cos) + B sinh + C sin` with
/// `B + C = 2 c l A`, `w'' = 0` and `w''' = -a l w` at the end.
fn characteristic_on_clamp(l: f64, a: f64, c: f64) -> f64 {
    let (sin, cos, tanh, part) = (l.sin(), l.cos(), l.tanh(), 1.0 / l.cosh());
    cos + part - (c + a) * l * (sin - cos * tanh) - 2.0 * a * c * l * l * sin * tanh
}

/// Measured: the residual over its slope, relative to the root, is below 2.1e-15.
#[test]
fn a_clamp_that_turns_solves_its_characteristic_equation() {
    let beam_kg = MASS_PER_LENGTH_KG_M * LENGTH_M;
    for (a, c) in [(0.0, 0.05), (0.01, 0.05), (0.5, 3.0), (1.4, 1e-3)] {
        let mut spec = if a > 0.0 {
            with_tip(a * beam_kg, 0.0)
        } else {
            bare_cantilever(6)
        };
        let rigid = modes(&spec).unwrap();
        spec.beam.get_mut("beam").unwrap().root_stiffness_n_m_rad =
            Some(STIFFNESS_N_M2 / (c * LENGTH_M));
        let modal = modes(&spec).unwrap();
        assert_eq!(modal.len(), 6);
        for (frequency, clamped) in modal.frequency_rad_s.iter().zip(&rigid.frequency_rad_s) {
            let root =
                (frequency * (MASS_PER_LENGTH_KG_M / STIFFNESS_N_M2).sqrt()).sqrt() * LENGTH_M;
            let at = |l: f64| characteristic_on_clamp(l, a, c);
            let slope = (at(root * (1.0 + 1e-5)) - at(root * (1.0 - 1e-5))) / 2e-5;
            let error = (at(root) / slope).abs();
            assert!(error < 1e-13, "{a} {c}: {root} {error:e}");
            assert!(frequency < clamped, "{a} {c}: {frequency} {clamped}");
        }
        // The root does not move; it only rotates.
        assert!(modal.shape["beam.root"].iter().all(|value| *value == 0.0));
    }
}

/// Two halves joined end to end are one beam; measured 3e-14.
#[test]
fn a_chain_of_equal_beams_is_one_beam() {
    let single = modes(&bare_cantilever(8)).unwrap();
    let mut spec = bare_cantilever(8);
    let half = Beam {
        length_m: LENGTH_M / 2.0,
        point: BTreeMap::new(),
        ..paper_beam("ground")
    };
    spec.beam = [
        ("one".into(), half.clone()),
        (
            "two".into(),
            Beam {
                root: "one.end".into(),
                ..half
            },
        ),
    ]
    .into();
    let chain = modes(&spec).unwrap();
    assert!(greatest_relative_difference(&chain.frequency_rad_s, &single.frequency_rad_s) < 1e-12);
    // "one.end" moves at least half as far as "two.end" in some modes and then defines the sign.
    let ends = |modes: &[f64]| modes.iter().map(|value| value.abs()).collect::<Vec<_>>();
    assert!(
        greatest_relative_difference(
            &ends(&chain.shape["two.end"]),
            &ends(&single.shape["beam.end"])
        ) < 1e-10
    );
    assert_eq!(chain.shape["two.root"], chain.shape["one.end"]);
}

/// A beam on a tip mass at the end of another beam rotates with it, as if clamped to that end.
#[test]
fn a_rigid_mass_passes_the_slope_on() {
    let build = |root: &str, with_mass: bool| {
        let mut spec = bare_cantilever(6);
        spec.beam.insert(
            "arm".into(),
            Beam {
                length_m: 0.1,
                point: BTreeMap::new(),
                ..paper_beam(root)
            },
        );
        if with_mass {
            spec.mass
                .insert("joint".into(), attached_mass("beam.end", 1e-12, 0.0));
        }
        modes(&spec).unwrap()
    };
    let error = greatest_relative_difference(
        &build("joint", true).frequency_rad_s,
        &build("beam.end", false).frequency_rad_s,
    );
    assert!(error < 1e-9, "{error:e}");
}

/// `receptance(w) = 1 / (m w^2) - 1 / k` at every frequency, with the receptance of the bare beam's
/// tip from its closed-form modes and its static remainder. Measured: 2e-10 of the receptance's
/// scale (the sum has 200 modes).
#[test]
fn a_sprung_mass_on_the_tip_agrees_with_the_receptance_of_the_beam() {
    let beam = Cantilever {
        bending_stiffness_n_m2: STIFFNESS_N_M2,
        mass_per_length_kg_m: MASS_PER_LENGTH_KG_M,
        length_m: LENGTH_M,
    };
    let (mass_kg, stiffness_n_m) = (0.01, 40.0);
    let mut spec = bare_cantilever(4);
    spec.mass.insert(
        "absorber".into(),
        sprung_mass("beam.end", mass_kg, stiffness_n_m, 0.2),
    );
    let modal = modes(&spec).unwrap();
    let tip_square = 4.0 / (MASS_PER_LENGTH_KG_M * LENGTH_M);
    let static_rest = LENGTH_M.powi(3) / (3.0 * STIFFNESS_N_M2);
    for w in &modal.frequency_rad_s {
        // 1/(a - b) - 1/a = b / (a (a - b)): the dynamic part beyond the static deflection.
        let dynamic: f64 = (0..200)
            .map(|mode| {
                let square = beam.frequency_rad_s(mode).powi(2);
                tip_square * w * w / (square * (square - w * w))
            })
            .sum();
        let (left, right) = (
            static_rest + dynamic,
            1.0 / (mass_kg * w * w) - 1.0 / stiffness_n_m,
        );
        assert!(
            (left - right).abs() < 1e-8 * (left.abs() + static_rest),
            "{w}: {left:e} {right:e}"
        );
    }
    assert_eq!(
        modal
            .damping_ratio
            .iter()
            .filter(|ratio| **ratio == 0.2)
            .count(),
        1
    );
}

/// Two sprung masses of one body have one mode each, although both move most in the same one.
#[test]
fn each_sprung_mass_adds_one_mode() {
    let mut spec = bare_cantilever(4);
    spec.mass
        .insert("one".into(), sprung_mass("beam.end", 0.01, 40.0, 0.2));
    spec.mass
        .insert("two".into(), sprung_mass("one", 0.0001, 0.4, 0.3));
    let modal = modes(&spec).unwrap();
    for ratio in [0.2, 0.3] {
        assert_eq!(
            modal
                .damping_ratio
                .iter()
                .filter(|value| **value == ratio)
                .count(),
            1,
            "{:?}",
            modal.damping_ratio
        );
    }
}

#[test]
fn a_structure_without_support_is_refused() {
    let mut cycle = bare_cantilever(4);
    cycle.beam.insert("one".into(), paper_beam("two.end"));
    cycle.beam.insert("two".into(), paper_beam("one.end"));
    assert_eq!(
        modes(&cycle).unwrap_err(),
        StructureError::SupportCycle { name: "one".into() }
    );
    let mut unknown_point = with_tip(0.1, 0.0);
    unknown_point.mass.get_mut("tip").unwrap().on = "beam.top".into();
    assert!(
        modes(&unknown_point)
            .unwrap_err()
            .to_string()
            .contains("mass.tip.on is \"beam.top\"")
    );
    let mut without_spring = with_tip(0.1, 0.0);
    without_spring.mass.get_mut("tip").unwrap().on = "ground".into();
    assert_eq!(
        modes(&without_spring).unwrap_err(),
        StructureError::MissingSpring { mass: "tip".into() }
    );
    let error = modes_holding(&with_tip(0.1, 0.0), &["tip".into()]).unwrap_err();
    assert!(
        matches!(error, StructureError::CannotHold { .. }),
        "{error}"
    );
    let names = ["tip", "tabel"].map(String::from);
    let error = modes_holding(&with_tip(0.1, 0.0), &names).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("cannot hold \"tip\", \"tabel\" fixed"),
        "{error}"
    );
}
