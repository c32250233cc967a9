//! Several structures in one spec, free masses, structures specified by their modes, damping.

use crate::paper::{
    attached_mass, bare_cantilever, greatest_relative_difference, paper, paper_beam, sprung_mass,
    table,
};
use jounce_model::structure::{StructureError, modes, modes_holding};
use jounce_spec::{Beam, Electrodes, Modal, ModalPatch, Section, Spec};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

#[test]
fn table_mode_takes_the_damping_of_the_table() {
    let modal = modes(&paper(Section::ThinSkin)).unwrap();
    assert_eq!(
        modal.damping_ratio,
        [
            0.3, 0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160
        ]
    );
    let clamped = modes_holding(&paper(Section::ThinSkin), &table()).unwrap();
    assert_eq!(clamped.damping_ratio, modal.damping_ratio[1..]);
    assert_eq!(clamped.shape["table"], [0.0; 7]);
    // A stiff spring puts the table's mode above all retained ones, which then do not use its
    // ratio.
    let mut stiff = paper(Section::ThinSkin);
    stiff.mass.get_mut("table").unwrap().stiffness_n_m = Some(12.0 * (TAU * 20e3).powi(2));
    assert_eq!(
        modes(&stiff).unwrap_err(),
        StructureError::MissingDamping {
            flexible: 8,
            given: 7
        }
    );
}

#[test]
fn independent_structures_keep_their_modes() {
    let single = modes(&paper(Section::ThinSkin)).unwrap();
    let mut spec = paper(Section::ThinSkin);
    spec.mass.insert(
        "anvil".into(),
        sprung_mass("ground", 2.0, 2.0 * (TAU * 20.0).powi(2), 0.1),
    );
    spec.beam.insert(
        "clamped".into(),
        Beam {
            point: BTreeMap::new(),
            ..paper_beam("ground")
        },
    );
    spec.modal.insert(
        "other".into(),
        Modal {
            frequency_hz: vec![0.5, 100.0],
            damping_ratio: vec![0.01, 0.02],
            participation_sqrt_kg: Vec::new(),
            point: BTreeMap::from([("tip".into(), vec![3.0, 4.0])]),
            patch: BTreeMap::new(),
        },
    );
    spec.damping.beyond = Some(0.005);
    spec.reduction.modes = 12;
    let modal = modes(&spec).unwrap();
    assert_eq!(modal.len(), 14);
    assert!(
        modal
            .frequency_rad_s
            .windows(2)
            .all(|pair| pair[0] <= pair[1])
    );
    let of_table: Vec<usize> = (0..14)
        .filter(|mode| modal.shape["table"][*mode] != 0.0)
        .collect();
    for (mode, index) in of_table.iter().enumerate() {
        assert!((modal.frequency_rad_s[*index] / single.frequency_rad_s[mode] - 1.0).abs() < 1e-12);
        assert!(
            (modal.shape["beam.tip"][*index] / single.shape["beam.tip"][mode] - 1.0).abs() < 1e-8
        );
        assert_eq!(modal.shape["clamped.end"][*index], 0.0);
    }
    let anvil = modal.shape["anvil"]
        .iter()
        .position(|value| *value != 0.0)
        .unwrap();
    assert!((modal.frequency_rad_s[anvil] / TAU - 20.0).abs() < 1e-12);
    assert!((modal.shape["anvil"][anvil] - 0.5_f64.sqrt()).abs() < 1e-15);
    assert_eq!(modal.damping_ratio[anvil], 0.1);
    assert_eq!(
        (modal.shape["other.tip"][0], modal.damping_ratio[0]),
        (3.0, 0.01)
    );
    assert_eq!(modal.discretisation_error[0], 0.0);
}

/// A structure specified by its modes needs no beam, retains every mode, and cannot be fixed at a
/// point.
#[test]
fn modal_structures_need_no_beams() {
    let harvester = Modal {
        frequency_hz: vec![1.0, 8.0],
        damping_ratio: vec![0.05, 0.002],
        participation_sqrt_kg: vec![1.5, -0.1],
        point: BTreeMap::from([("tip".into(), vec![0.3, -12.0])]),
        patch: BTreeMap::from([(
            "mfc".into(),
            ModalPatch {
                coupling_n_per_v: vec![-1e-6, 2e-3],
                capacitance_f: 177e-9,
                leakage_ohm: None,
                electrodes: Electrodes::Circuit,
            },
        )]),
    };
    let mut spec = Spec {
        modal: BTreeMap::from([("harvester".into(), harvester)]),
        ..Spec::default()
    };
    let modal = modes(&spec).unwrap();
    assert_eq!(modal.frequency_rad_s, [TAU, TAU * 8.0]);
    assert_eq!(modal.damping_ratio, [0.05, 0.002]);
    assert_eq!(modal.participation_sqrt_kg, [1.5, -0.1]);
    assert_eq!(modal.shape["harvester.tip"], [0.3, -12.0]);
    assert_eq!(modal.patch["harvester.mfc"].coupling_n_per_v, [-1e-6, 2e-3]);
    assert_eq!(modal.patch["harvester.mfc"].capacitance_f, 177e-9);
    let error = modes_holding(&spec, &["harvester.table".into()]).unwrap_err();
    assert_eq!(
        error,
        StructureError::CannotHoldGiven {
            names: vec!["harvester.table".into()]
        }
    );
    spec.modal
        .get_mut("harvester")
        .unwrap()
        .point
        .insert("table".into(), vec![1.0]);
    let short = modes(&spec).unwrap_err();
    assert_eq!(
        short,
        StructureError::WrongLength {
            place: "modal.harvester.point.table".into(),
            found: 1,
            expected: 2
        }
    );
}

/// Two beams on one light mass: with equal beams the odd modes are those of the clamped beam, in
/// which the mass is at rest.
#[test]
fn equal_beams_on_one_mass_split_into_even_and_odd() {
    let mut spec = paper(Section::ThinSkin);
    spec.patch.clear();
    spec.beam.insert("second".into(), paper_beam("table"));
    spec.mass.get_mut("table").unwrap().mass_kg = 0.05;
    spec.damping.beyond = Some(0.01);
    let modal = modes(&spec).unwrap();
    let clamped = modes(&bare_cantilever(3)).unwrap();
    for (mode, exact) in clamped.frequency_rad_s.iter().enumerate() {
        let antisymmetric = modal
            .frequency_rad_s
            .iter()
            .position(|frequency| (frequency / exact - 1.0).abs() < 1e-10)
            .unwrap();
        assert!(modal.shape["table"][antisymmetric].abs() < 1e-9, "{mode}");
        assert!(
            (modal.shape["beam.end"][antisymmetric] + modal.shape["second.end"][antisymmetric])
                .abs()
                < 1e-8
        );
        assert!(modal.shape["beam.end"][antisymmetric] > 0.0);
    }
}

/// A mass without a spring: frequency 0, shape `1/sqrt(total mass)` everywhere; the other modes are
/// the limit of a soft spring.
#[test]
fn free_mass_has_a_rigid_body_mode() {
    let mut spec = paper(Section::ThinSkin);
    spec.mass
        .insert("table".into(), attached_mass("nothing", 0.1, 0.0));
    let free = modes(&spec).unwrap();
    let total_kg: f64 = 0.1 + 2750.0 * 0.03 * 0.98e-3 * 0.315;
    assert_eq!(
        (
            free.frequency_rad_s[0],
            free.damping_ratio[0],
            free.discretisation_error[0]
        ),
        (0.0, 0.0, 0.0)
    );
    for point in ["table", "beam.tip", "beam.end", "beam.root"] {
        assert!((free.shape[point][0] * total_kg.sqrt() - 1.0).abs() < 1e-14);
    }
    assert!(free.patch["mfc"].coupling_n_per_v[0].abs() < 1e-18);
    spec.mass
        .insert("table".into(), sprung_mass("ground", 0.1, 1e-6, 0.0));
    let soft = modes(&spec).unwrap();
    assert!(
        greatest_relative_difference(&free.frequency_rad_s[1..], &soft.frequency_rad_s[1..]) < 1e-8
    );
    assert!(
        greatest_relative_difference(&free.shape["beam.tip"][1..], &soft.shape["beam.tip"][1..])
            < 1e-6
    );
    assert!((soft.frequency_rad_s[0] / (1e-6 / total_kg).sqrt() - 1.0).abs() < 1e-8);
}
