//! Circuits of a spec as elements between two wires.

use super::words::value;
use crate::{DrawnCircuit, DrawnElement};
use jounce_spec::{Circuit, Interface, Quantity, Spec, Wiring};

/// Returns all circuits, then each patch without a circuit, with open wires.
pub fn circuits(spec: &Spec) -> Vec<DrawnCircuit> {
    let closed = spec.circuit.iter().map(|(name, circuit)| DrawnCircuit {
        label: name.clone(),
        elements: elements(circuit),
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

fn elements(circuit: &Circuit) -> Vec<DrawnElement> {
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
    circuit_elements.push(resistor);
    circuit_elements
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
