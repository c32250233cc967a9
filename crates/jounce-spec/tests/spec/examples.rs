//! The example specs have their intended content.

use jounce_spec::{DriveKind, DriveSignal, Section, Side, Spec, SpecFile, Start, StopLaw};

use crate::{MODAL, paper, root};

/// The file has no table of damping, so its fault has no place and comes after those that have one;
/// the fault of an override comes first.
#[test]
fn faults_come_in_the_order_of_their_places() {
    let text = "[beam.b]\nmaterial = \"wood\"\nlength = \"50 mm\"\nwidth = \"10 mm\"\nthickness = \"0.5 mm\"\n[reduction]\nmodes = 3\n[colour]\n";
    let mut file = jounce_spec::SpecFile::from_text(text);
    file.set("beam.b.width", "-1 mm").unwrap();
    let faults = file.spec().unwrap_err();
    let places: Vec<(bool, usize)> = faults
        .as_slice()
        .iter()
        .map(|fault| (fault.set.is_some(), fault.line))
        .collect();
    assert_eq!(
        places,
        [(true, 0), (false, 2), (false, 8), (false, 0)],
        "{faults}"
    );
    assert_eq!(faults.as_slice()[3].key, "damping.ratios");
}

#[test]
fn the_structure_of_the_paper_reads_to_the_nearest_floats() {
    let spec = Spec::from_toml(&paper()).unwrap();
    let beam = &spec.beam["beam"];
    let read = [
        beam.length_m,
        beam.width_m,
        beam.thickness_m,
        beam.youngs_modulus_pa,
        beam.density_kg_m3,
        beam.point["tip"],
        beam.point["hammer"],
    ];
    assert_eq!(read, [0.315, 0.03, 0.98e-3, 65e9, 2750.0, 0.305, 0.015]);
    assert_eq!(beam.root, "table");
    let patch = &spec.patch["mfc"];
    assert_eq!(
        [
            patch.start_m,
            patch.length_m,
            patch.width_m,
            patch.thickness_m
        ],
        [9e-3, 85e-3, 30e-3, 0.3e-3]
    );
    assert_eq!(
        [
            patch.youngs_modulus_pa,
            patch.density_kg_m3,
            patch.d31_m_per_v.unwrap(),
            patch.capacitance_f.unwrap()
        ],
        [30.336e9, 5440.0, -170e-12, 177e-9]
    );
    assert_eq!(
        (patch.on.as_str(), patch.section),
        ("beam", Section::ThinSkin)
    );
    let mass = &spec.mass["table"];
    assert_eq!(
        [
            mass.mass_kg,
            mass.stiffness_n_m.unwrap(),
            mass.damping_ratio.unwrap()
        ],
        [12.0, 12.0 * std::f64::consts::TAU.powi(2), 0.3]
    );
}

#[test]
fn the_stop_and_the_circuit_of_the_paper_read_to_the_nearest_floats() {
    let spec = Spec::from_toml(&paper()).unwrap();
    let stop = &spec.stop["tip"];
    assert_eq!(
        (stop.at.as_str(), stop.frame.as_str(), stop.side, stop.gap_m),
        ("beam.tip", "ground", Side::Positive, 1e-3)
    );
    assert_eq!(
        stop.law,
        StopLaw::Hertz {
            stiffness: 1000.0,
            exponent: 1.5
        }
    );
    assert_eq!(
        (
            spec.circuit["load"].patch.as_str(),
            spec.circuit["load"].resistance_ohm
        ),
        ("mfc", 1e6)
    );
}

#[test]
fn the_drive_and_the_settings_of_the_paper_read_to_the_nearest_floats() {
    let spec = Spec::from_toml(&paper()).unwrap();
    let drive = &spec.drive["shaker"];
    assert_eq!((drive.at.as_str(), drive.kind), ("table", DriveKind::Force));
    assert_eq!(
        drive.signal,
        DriveSignal::Sine {
            amplitude: 200.0,
            frequency_hz: 13.0,
            phase_rad: 0.0
        }
    );
    assert_eq!(
        spec.damping.ratios,
        [
            0.00194, 0.00925, 0.00864, 0.00359, 0.00126, 0.00274, 0.00160
        ]
    );
    assert_eq!(
        (
            spec.damping.beyond,
            spec.reduction.modes,
            spec.reduction.mesh_tolerance
        ),
        (None, 8, 1e-9)
    );
    assert_eq!(
        (
            &spec.run.start,
            spec.run.duration_s,
            spec.run.average_over_s,
            spec.run.tolerance
        ),
        (&Start::Rest, 20.0, 10.0, 1e-7)
    );
}

#[test]
fn a_modal_structure_reads_its_long_literals_exactly() {
    let spec = Spec::from_toml(MODAL).unwrap();
    let modal = &spec.modal["harvester"];
    assert_eq!(
        modal.frequency_hz,
        [0.998_937_404_701_551_8, 8.669_055_209_030_168]
    );
    assert_eq!(
        modal.point["tip"][1].to_bits(),
        (-12.139139756805843_f64).to_bits()
    );
    assert_eq!(
        modal.patch["mfc"].coupling_n_per_v[0].to_bits(),
        (-1.098177670673766e-06_f64).to_bits()
    );
    assert_eq!(
        (
            modal.patch["mfc"].capacitance_f,
            spec.stop["tip"].frame.as_str()
        ),
        (177e-9, "harvester.table")
    );
}

#[test]
fn the_plant_given_as_numbers_loads_unchanged() {
    let file = SpecFile::read(root().join("bench/plant.toml")).unwrap();
    let spec = file.spec().unwrap_or_else(|faults| panic!("{faults}"));
    let modal = &spec.modal["harvester"];
    assert_eq!((modal.frequency_hz.len(), modal.point.len()), (8, 2));
    let again = Spec::from_toml(&spec.to_toml()).unwrap();
    assert_eq!(again, spec);
    for (value, literal) in modal.patch["mfc"].coupling_n_per_v.iter().zip(
        file.text()
            .split("coupling_n_per_v = [")
            .nth(1)
            .unwrap()
            .split([',', ']']),
    ) {
        assert_eq!(
            value.to_bits(),
            literal.trim().parse::<f64>().unwrap().to_bits()
        );
    }
}

#[test]
fn comments_order_units_and_written_defaults_do_not_change_the_hash() {
    let paper = Spec::from_toml(&paper()).unwrap();
    let other = crate::paper()
        .replace("\"1 mm\"", "\"0.1 cm\"")
        .replace("\"1 Mohm\"", "\"1000 k\u{3a9}\"")
        .replace("start = \"rest\"", "tolerance = 1e-7 # note");
    let other = Spec::from_toml(&other).unwrap();
    assert_eq!(
        (other.hash_hex(), other.hash_hex().len()),
        (paper.hash_hex(), 64)
    );
    let third =
        Spec::from_toml(&crate::paper().replace("\"1 mm\"", "\"1.0000000000000002 mm\"")).unwrap();
    assert_ne!(third.hash_hex(), paper.hash_hex());
}
