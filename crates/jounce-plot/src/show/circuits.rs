//! Circuits of a spec as elements between two wires.

use super::words::value;
use crate::{DrawnCircuit, DrawnElement};
use jounce_spec::{Circuit, Device, Interface, Quantity, Regulator, Spec, Wiring};

/// Returns all circuits, then each patch without a circuit, with open wires.
pub fn circuits(spec: &Spec) -> Vec<DrawnCircuit> {
    let closed = spec.circuit.iter().map(|(name, circuit)| DrawnCircuit {
        label: name.clone(),
        elements: elements(spec, circuit),
    });
    let modal = spec.modal.iter().flat_map(|(body, modal)| {
        modal
            .patch
            .keys()
            .map(move |patch| format!("{body}.{patch}"))
    });
    let open = spec
        .patch
        .keys()
        .cloned()
        .chain(modal)
        .filter(|patch| is_open(spec, patch));
    let open = open.map(|patch| DrawnCircuit {
        label: "none: open".to_owned(),
        elements: vec![DrawnElement::Patches(vec![(patch, false)])],
    });
    closed.chain(open).collect()
}

/// Returns the name of a patch, marked if it has no circuit.
pub fn marked(spec: &Spec, patch: &str) -> String {
    if is_open(spec, patch) {
        format!("{patch} (open)")
    } else {
        patch.to_owned()
    }
}

fn is_open(spec: &Spec, patch: &str) -> bool {
    !spec
        .circuit
        .values()
        .any(|circuit| circuit.connections().any(|(name, _)| name == patch))
}

fn elements(spec: &Spec, circuit: &Circuit) -> Vec<DrawnElement> {
    let mut circuit_elements = patches(circuit);
    let resistor =
        DrawnElement::Resistor(vec![value(Quantity::Resistance, circuit.resistance_ohm)]);
    if circuit.interface == Interface::Resistor {
        if let Some(inductance_h) = circuit.inductance_h {
            let words = vec![value(Quantity::Inductance, inductance_h)];
            circuit_elements.push(match circuit.inductor {
                Wiring::Parallel => DrawnElement::Inductor(words),
                Wiring::Series => DrawnElement::SeriesInductor(words),
            });
        }
        circuit_elements.push(resistor);
        return circuit_elements;
    }
    circuit_elements.push(DrawnElement::Block(block(circuit)));
    if let Some(battery_v) = circuit.battery_v {
        circuit_elements.push(DrawnElement::Battery(vec![value(
            Quantity::Voltage,
            battery_v,
        )]));
        return circuit_elements;
    }
    circuit_elements.extend(
        circuit.storage_f.map(|storage_f| {
            DrawnElement::Capacitor(vec![value(Quantity::Capacitance, storage_f)])
        }),
    );
    let leakage = |ohm: f64| {
        DrawnElement::Resistor(vec![value(Quantity::Resistance, ohm), "leakage".to_owned()])
    };
    circuit_elements.extend(circuit.leakage_ohm.map(leakage));
    match spec.regulator.get(&circuit.regulator) {
        Some(regulator) => {
            circuit_elements.push(DrawnElement::Block(regulated(regulator)));
            let device = spec.device.get(&circuit.device);
            let words = |device| DrawnElement::Block(consumption(&circuit.device, device));
            circuit_elements.extend(device.map(words));
        }
        None => circuit_elements.push(resistor),
    }
    circuit_elements
}

/// Returns the labels in the block of a regulator.
fn regulated(regulator: &Regulator) -> Vec<String> {
    let name = match regulator.chip.is_empty() {
        true => "regulator".to_owned(),
        false => regulator.chip.clone(),
    };
    vec![
        name,
        format!("starts at {}", value(Quantity::Voltage, regulator.start_v)),
        format!("stops at {}", value(Quantity::Voltage, regulator.stop_v)),
        format!("output {}", value(Quantity::Voltage, regulator.output_v)),
    ]
}

/// Returns the labels in the block of a device.
fn consumption(name: &str, device: &Device) -> Vec<String> {
    let phase = |what: &str, current_a: Option<f64>, time_s: Option<f64>| {
        let (current_a, time_s) = (current_a?, time_s?);
        let current = value(Quantity::Current, current_a);
        Some(format!(
            "{what} {current}, {}",
            value(Quantity::Time, time_s)
        ))
    };
    let period = |period_s: f64| format!("every {}", value(Quantity::Time, period_s));
    let sleep = value(Quantity::Current, device.sleep_a);
    let mut words = vec![name.to_owned()];
    words.extend(phase("measures", device.measure_a, device.measure_s));
    words.extend(phase("sends", device.send_a, device.send_s));
    words.push(format!("sleeps {sleep}"));
    words.extend(device.period_s.map(period));
    words
}

fn patches(circuit: &Circuit) -> Vec<DrawnElement> {
    let names: Vec<(String, bool)> = circuit
        .connections()
        .map(|(name, sign)| (name.to_owned(), sign < 0.0))
        .collect();
    match circuit.wiring {
        Wiring::Series => vec![DrawnElement::Patches(names)],
        Wiring::Parallel => names
            .into_iter()
            .map(|name| DrawnElement::Patches(vec![name]))
            .collect(),
    }
}

/// Returns the labels in the block of a power interface.
fn block(circuit: &Circuit) -> Vec<String> {
    let name = match circuit.interface {
        Interface::Resistor => "",
        Interface::Bridge => "full bridge",
        Interface::ParallelSshi => "parallel SSHI",
        Interface::SeriesSshi => "series SSHI",
        Interface::Sece => "SECE",
    };
    let mut words = vec![name.to_owned()];
    if circuit.diode_drop_v > 0.0 {
        words.push(format!(
            "drop 2 × {}",
            value(Quantity::Voltage, circuit.diode_drop_v)
        ));
    }
    words.extend(
        circuit
            .quality_factor
            .map(|quality| format!("Q = {quality}")),
    );
    if circuit.interface == Interface::Sece {
        words.push(format!("{} % arrive", 100.0 * circuit.efficiency));
    }
    words
}
