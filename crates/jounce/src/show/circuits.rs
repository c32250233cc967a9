//! The circuits of a spec as elements between two wires.

use super::words::value;
use crate::picture::{DrawnCircuit, DrawnElement};
use crate::spec::{Circuit, Interface, Quantity, Spec, Wiring};

/// All circuits; patches without one are open and are not drawn here.
pub fn circuits(spec: &Spec) -> Vec<DrawnCircuit> {
    spec.circuit.iter().map(|(name, circuit)| DrawnCircuit { label: name.clone(), elements: elements(circuit) }).collect()
}

fn elements(circuit: &Circuit) -> Vec<DrawnElement> {
    let mut found = patches(circuit);
    let resistor = DrawnElement::Resistor(vec![value(Quantity::Resistance, circuit.resistance_ohm)]);
    if circuit.interface == Interface::Resistor {
        if let Some(inductance_h) = circuit.inductance_h {
            let words = vec![value(Quantity::Inductance, inductance_h)];
            found.push(match circuit.inductor {
                Wiring::Parallel => DrawnElement::Inductor(words),
                Wiring::Series => DrawnElement::SeriesInductor(words),
            });
        }
        found.push(resistor);
        return found;
    }
    found.push(DrawnElement::Block(block(circuit)));
    if let Some(battery_v) = circuit.battery_v {
        found.push(DrawnElement::Battery(vec![value(Quantity::Voltage, battery_v)]));
        return found;
    }
    found.extend(circuit.storage_f.map(|storage_f| DrawnElement::Capacitor(vec![value(Quantity::Capacitance, storage_f)])));
    let leakage = |ohm: f64| DrawnElement::Resistor(vec![value(Quantity::Resistance, ohm), "leakage".to_owned()]);
    found.extend(circuit.leakage_ohm.map(leakage));
    found.push(resistor);
    found
}

fn patches(circuit: &Circuit) -> Vec<DrawnElement> {
    let names: Vec<(String, bool)> = circuit.connections().map(|(name, sign)| (name.to_owned(), sign < 0.0)).collect();
    match circuit.wiring {
        Wiring::Series => vec![DrawnElement::Patches(names)],
        Wiring::Parallel => names.into_iter().map(|name| DrawnElement::Patches(vec![name])).collect(),
    }
}

/// What the words in the block of an interface say.
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
        words.push(format!("drop 2 × {}", value(Quantity::Voltage, circuit.diode_drop_v)));
    }
    words.extend(circuit.quality_factor.map(|quality| format!("Q = {quality}")));
    if circuit.interface == Interface::Sece {
        words.push(format!("{} % arrive", 100.0 * circuit.efficiency));
    }
    words
}
