//! Invalid specs, each with its one error.

use crate::paper::{paper, paper_patch};
use jounce_model::structure::{modes, modes_holding, modes_on_cubic_mesh};
use jounce_spec::{Patch, Section, Spec};

/// A change to a valid spec, and the parts that its error must contain.
type Fault = (fn(&mut Spec), &'static [&'static str]);

const FAULTS: &[Fault] = &[
    (
        |spec| spec.patch.get_mut("mfc").unwrap().start_m = 0.25,
        &["patch.mfc covers 0.25 m to 0.335 m"],
    ),
    (
        |spec| {
            let second = Patch {
                start_m: 0.05,
                ..paper_patch(Section::ThinSkin)
            };
            spec.patch.insert("second".into(), second);
        },
        &["patches must not overlap"],
    ),
    (
        |spec| {
            let beam = spec.beam.get_mut("beam").unwrap();
            beam.point.insert("far".into(), 0.4);
        },
        &["beam.beam.point.far is 0.4 m"],
    ),
    (
        |spec| spec.beam.get_mut("beam").unwrap().youngs_modulus_pa = f64::NAN,
        &["beam.beam.youngs_modulus is NaN"],
    ),
    (
        |spec| {
            spec.patch.clear();
            spec.beam.get_mut("beam").unwrap().thickness_m = 1e-120;
        },
        &["outside the range of double precision"],
    ),
    (
        |spec| spec.beam.get_mut("beam").unwrap().root = "tabel".into(),
        &["\"tabel\"", "(ground, table)"],
    ),
    (|spec| spec.reduction.modes = 5000, &["at most 200"]),
    (
        |spec| spec.reduction.mesh_tolerance = 1e-17,
        &["between 1e-13 and 0.1"],
    ),
    (
        |spec| spec.reduction.modes = 10,
        &["9 flexible modes", "add 2"],
    ),
    (
        |spec| {
            spec.beam.clear();
            spec.patch.clear();
            spec.reduction.modes = 7;
        },
        &["7 modes are requested, but the structure has 1"],
    ),
];

#[test]
fn faults_are_errors_with_numbers() {
    for (change, parts) in FAULTS {
        let mut spec = paper(Section::ThinSkin);
        change(&mut spec);
        let error = modes(&spec).unwrap_err().to_string();
        for part in *parts {
            assert!(error.contains(part), "{error}");
        }
    }
}

#[test]
fn only_masses_can_be_held() {
    let error = modes_holding(&paper(Section::ThinSkin), &["beam.tip".into()])
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("only a mass on the base or a free mass can be held (table)"),
        "{error}"
    );
}

#[test]
fn a_cubic_mesh_has_a_limit() {
    for longest_element_m in [1e-300, 1e-5] {
        let error = modes_on_cubic_mesh(&paper(Section::ThinSkin), &[], longest_element_m)
            .unwrap_err()
            .to_string();
        assert!(error.contains("use longer elements"), "{error}");
    }
}
