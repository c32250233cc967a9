//! Balances of charge and energy of rectifiers.

use super::cell::lossy_with_stop;
use crate::plants::{from_rest, kernel};
use jounce_analysis::run::{RunPlan, StartState, charges, simulate};
use jounce_dynamics::Integrator;
use jounce_model::plant::{RectifierScheme, Storage, System};

/// A bridge with drop, leakage and a load, against a stop. For every scheme the energy balances.
/// The charge through the diodes equals that of the storage, by Gauss quadrature of its currents
/// along the record.
#[test]
fn charge_and_energy_are_balanced() {
    let storage = Storage::Capacitor {
        capacitance_f: 5.0,
        load_ohm: 3.0,
    };
    for scheme in [
        RectifierScheme::Standard,
        RectifierScheme::ParallelSshi { inversion: 0.6 },
        RectifierScheme::SeriesSshi { inversion: 0.6 },
        RectifierScheme::Extraction { efficiency: 0.9 },
    ] {
        let kernel = kernel(lossy_with_stop(scheme, storage));
        let start = kernel
            .plant
            .from_physical(&StartState::rest(&kernel.plant).physical(), 0.0);
        let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-10).unwrap();
        integrator.start_record();
        integrator.advance_to(150.0).unwrap();
        let (energies, contacts) = (integrator.energies(), integrator.statistics().contacts);
        let (end, record) = (integrator.physical(), integrator.take_record());
        let node = kernel.plant.electrical.bridges[0].storage.unwrap();
        let storage_row = 2 * kernel.plant.system.modes.len() + node;
        let mut times = Vec::new();
        let (half, mut weights) = (0.5 / 3.0_f64.sqrt(), Vec::new());
        for segment in record.segments() {
            let panels = (segment.length_s / 0.002).ceil();
            let panel_s = segment.length_s / panels;
            for panel in 0..panels as usize {
                times.extend(
                    [0.5 - half, 0.5 + half]
                        .map(|part| segment.start_s + (panel as f64 + part) * panel_s),
                );
                weights.extend([0.5 * panel_s; 2]);
            }
        }
        let voltage = |at: &jounce_dynamics::TrajectoryState| {
            kernel.plant.to_physical(&at.state, at.time_s)[storage_row]
        };
        let leaks: f64 = record
            .at(&kernel, &times)
            .iter()
            .zip(weights)
            .map(|(at, weight)| weight * voltage(at))
            .sum();
        let charge_c = 5.0 * end[storage_row] + leaks * (1.0 / 3.0 + 1.0 / 40.0);
        let rectified = energies.rectified[0];
        eprintln!(
            "{scheme:?}: {contacts} contacts, residual {:.1e}, {rectified:?}, charge {charge_c:e}",
            energies.residual_relative()
        );
        assert!(contacts > 5 && energies.residual_relative().abs() < 1e-9);
        if !matches!(scheme, RectifierScheme::Extraction { .. }) {
            assert!(
                (rectified.charge_c / charge_c - 1.0).abs() < 1e-9,
                "{:e} and {charge_c:e}",
                rectified.charge_c
            );
        }
    }
}

/// Charge and energy that a run reports for its averaging window, before steady state. The charge
/// of the diodes, counted at the patches, equals that of load, leakage and storage, by the integral
/// of the storage voltage. Measured: 3e-15 at most.
#[test]
fn a_run_reports_its_charge_and_energy_balance() {
    let storage = Storage::Capacitor {
        capacitance_f: 5.0,
        load_ohm: 3.0,
    };
    for scheme in [
        RectifierScheme::Standard,
        RectifierScheme::ParallelSshi { inversion: 0.6 },
        RectifierScheme::SeriesSshi { inversion: 0.6 },
    ] {
        let kernel = kernel(lossy_with_stop(scheme, storage));
        let plan = RunPlan {
            duration_s: 100.0,
            average_over_s: 60.0,
            tolerance: 1e-9,
            record_s: 0.0,
        };
        let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        assert!(
            charges(&kernel, &result, &plan).is_empty(),
            "there is no record to balance"
        );
        let plan = plan.balancing(&kernel.plant);
        let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        let [charge] = &charges(&kernel, &result, &plan)[..] else {
            panic!("one circuit")
        };
        let rectified = &result.rectified[0];
        eprintln!(
            "{scheme:?}: {charge:?}, {} contacts, storage {:e} of {:e} W",
            result.contacts, rectified.storage_w, rectified.mean_power_w
        );
        assert!(
            charge.residual_relative.abs() < 1e-9
                && charge.storage_c.abs() > 0.01 * charge.passed_c
                && result.contacts > 3
        );
        assert!((charge.leakage_c / charge.load_c / (3.0 / 40.0) - 1.0).abs() < 1e-14);
        // C (V1^2 - V0^2) / 2 from the charge stored and the last voltage of the storage.
        let node = kernel.plant.electrical.bridges[0].storage.unwrap();
        let stored_j =
            charge.storage_c * (result.end.voltage_v[node] - 0.5 * charge.storage_c / 5.0);
        assert!((rectified.storage_w * plan.average_over_s / stored_j - 1.0).abs() < 1e-12);
    }
}

/// Diodes of 10 ohm on a storage of 10 nF settle within 0.1 us, with steps of 0.4 ms; those of 10
/// milliohm within 0.1 ns. Then the load draws 1e-9 of the current that the path could carry.
/// Measured: 2e-13 at most.
#[test]
fn the_charge_of_diodes_far_faster_than_a_step_is_balanced() {
    let starter = jounce_spec::starter::Starter::of("bimorph-with-rectifier").unwrap();
    for (storage, diode) in [
        ("1 nF", "10 ohm"),
        ("10 nF", "10 ohm"),
        ("10 nF", "0.01 ohm"),
    ] {
        let mut file = jounce_spec::SpecFile::from_text(starter.spec);
        for (key, value) in [
            ("circuit.store.storage", storage),
            ("circuit.store.diode_resistance", diode),
            ("circuit.store.leakage_resistance", "1 Mohm"),
            ("run.duration", "0.6 s"),
            ("run.average_over", "0.2 s"),
        ] {
            file.set(key, value).unwrap();
        }
        let spec = file.spec().unwrap();
        let kernel = kernel(
            System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap(),
        );
        let plan = RunPlan {
            duration_s: 0.6,
            average_over_s: 0.2,
            tolerance: 1e-9,
            record_s: 0.0,
        }
        .balancing(&kernel.plant);
        let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
        let [charge] = &charges(&kernel, &result, &plan)[..] else {
            panic!("one circuit")
        };
        eprintln!(
            "{storage}, {diode}: residual {:.1e}, {charge:?}",
            charge.residual_relative
        );
        assert!(
            charge.residual_relative.abs() < 1e-11
                && result.energies.residual_relative().abs() < 1e-9
        );
    }
}

/// Diodes of 1 ohm on a patch of 177 nF settle within 0.2 us. The instant at which they block is
/// known only to the roundoff of a voltage, so the integration in contact must not require more. An
/// event function not checked at the start of a contact would be passed late, at some tolerances
/// only.
#[test]
fn diodes_far_faster_than_the_motion_change_during_a_contact() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/impact-harvester-2019/harvester.toml"
    );
    let mut file = jounce_spec::SpecFile::read(path).unwrap();
    for (key, value) in [
        ("circuit.load.interface", "bridge"),
        ("circuit.load.storage", "1 uF"),
        ("circuit.load.diode_resistance", "1 ohm"),
        ("drive.shaker.amplitude", "200 N"),
        ("drive.shaker.frequency", "13 Hz"),
    ] {
        file.set(key, value).unwrap();
    }
    let spec = file.spec().unwrap();
    let kernel =
        kernel(System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap());
    let fine = from_rest(&kernel, 1.0, 1e-10);
    assert!(fine.contacts > 3);
    for tolerance in [1e-6, 1e-7, 1e-8, 1e-9] {
        let result = from_rest(&kernel, 1.0, tolerance);
        let (change, residual) = (
            result.mean_power_w / fine.mean_power_w - 1.0,
            result.energies.residual_relative(),
        );
        eprintln!(
            "{tolerance:e}: {} contacts, power {:e} W, {change:.1e}, residual {residual:.1e}",
            result.contacts, result.mean_power_w
        );
        assert!(
            change.abs() < 1e-5 && residual.abs() < 1e-8,
            "{tolerance:e}: {change:e}, {residual:e}"
        );
    }
}
