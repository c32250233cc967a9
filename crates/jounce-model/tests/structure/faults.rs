//! Invalid specs, each with its one error.

use crate::paper::{paper, paper_patch};
use jounce_model::structure::{modes, modes_holding, modes_on_cubic_mesh};
use jounce_spec::{Patch, Section, Spec};

#[test]
fn faults_are_errors_with_numbers() {
    let fault_with = |change: fn(&mut Spec)| {
        let mut spec = paper(Section::ThinSkin);
        change(&mut spec);
        modes(&spec).unwrap_err().to_string()
    };
    let patch_beyond = fault_with(|spec| spec.patch.get_mut("mfc").unwrap().start_m = 0.25);
    assert!(
        patch_beyond.contains("patch.mfc covers 0.25 m to 0.335 m"),
        "{patch_beyond}"
    );
    let overlap = fault_with(|spec| {
        spec.patch.insert(
            "second".into(),
            Patch {
                start_m: 0.05,
                ..paper_patch(Section::ThinSkin)
            },
        );
    });
    assert!(overlap.contains("patches must not overlap"), "{overlap}");
    let outside = fault_with(|spec| {
        spec.beam
            .get_mut("beam")
            .unwrap()
            .point
            .insert("far".into(), 0.4);
    });
    assert!(
        outside.contains("beam.beam.point.far is 0.4 m"),
        "{outside}"
    );
    let nan = fault_with(|spec| spec.beam.get_mut("beam").unwrap().youngs_modulus_pa = f64::NAN);
    assert!(nan.contains("beam.beam.youngs_modulus is NaN"), "{nan}");
    let thin = fault_with(|spec| {
        spec.patch.clear();
        spec.beam.get_mut("beam").unwrap().thickness_m = 1e-120;
    });
    assert!(
        thin.contains("outside the range of double precision"),
        "{thin}"
    );
    let root = fault_with(|spec| spec.beam.get_mut("beam").unwrap().root = "tabel".into());
    assert!(
        root.contains("\"tabel\"") && root.contains("(ground, table)"),
        "{root}"
    );
    let many = fault_with(|spec| spec.reduction.modes = 5000);
    assert!(many.contains("at most 200"), "{many}");
    let tolerance = fault_with(|spec| spec.reduction.mesh_tolerance = 1e-17);
    assert!(tolerance.contains("between 1e-13 and 0.1"), "{tolerance}");
    let damping = fault_with(|spec| spec.reduction.modes = 10);
    assert!(
        damping.contains("9 flexible modes") && damping.contains("add 2"),
        "{damping}"
    );
    let masses_only = fault_with(|spec| {
        spec.beam.clear();
        spec.patch.clear();
        spec.reduction.modes = 7;
    });
    assert!(
        masses_only.contains("7 modes are requested, but the structure has 1"),
        "{masses_only}"
    );
    let error = modes_holding(&paper(Section::ThinSkin), &["beam.tip".into()])
        .unwrap_err()
        .to_string();
    assert!(error.contains("only a mass can be held (table)"), "{error}");
    let endless = modes_on_cubic_mesh(&paper(Section::ThinSkin), &[], 1e-300)
        .unwrap_err()
        .to_string();
    assert!(endless.contains("use longer elements"), "{endless}");
    let fine = modes_on_cubic_mesh(&paper(Section::ThinSkin), &[], 1e-5)
        .unwrap_err()
        .to_string();
    assert!(fine.contains("use longer elements"), "{fine}");
}
