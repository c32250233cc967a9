//! `jounce frf --measured FILE...`

use crate::failure::Failure;
use crate::hammer_arguments::{HammerArguments, tell_hits};
use crate::output::{self, line, print};
use crate::spec_arguments::OutputArguments;
use jounce::table::{Column, Table};
use jounce_measure::draw::measured_responses;
use jounce_measure::response::Responses;
use jounce_measure::spectral::FrequencyResponse;
use std::path::Path;

/// Prints the responses of a hammer test.
pub fn run(hammer: &HammerArguments, output: &OutputArguments) -> Result<(), Failure> {
    let found = hammer.responses()?;
    if let Some(folder) = &output.out {
        write(folder, hammer, &found)?;
    }
    if output.json {
        let references = found.references.len().max(1);
        let one = |(k, function): (usize, &FrequencyResponse)| {
            let (re, im): (Vec<f64>, Vec<f64>) = function.value.iter().map(|h| (h.re, h.im)).unzip();
            let told = serde_json::json!({
                "re": re,
                "im": im,
                "unit": found.units[k],
                "coherence": function.coherence,
                "output": found.outputs[k / references],
                "reference": found.references.get(k % references),
            });
            (found.names[k].clone(), told)
        };
        let listed: serde_json::Map<String, serde_json::Value> = found.functions.iter().enumerate().map(one).collect();
        print(&serde_json::json!({
            "frequency_hz": found.functions[0].frequency_hz,
            "responses": listed,
            "outputs": found.outputs,
            "references": found.references,
            "hits": found.hits,
            "block_s": found.block_s,
            "window_decay_per_s": found.window_decay_per_s,
            "findings": found.findings,
        }));
        return Ok(());
    }
    tell_hits(&found);
    for ((name, unit), function) in found.names.iter().zip(&found.units).zip(&found.functions) {
        let lines = function.value.iter().enumerate().skip(1);
        if let Some((k, highest)) = lines.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) {
            let (frequency_hz, coherence) = (function.frequency_hz[k], function.coherence[k]);
            line(format!("{name}: highest {:.5e} {unit} at {frequency_hz:.4} Hz, coherence {coherence:.5}", highest.norm()));
        }
    }
    Ok(())
}

fn write(folder: &Path, hammer: &HammerArguments, found: &Responses) -> Result<(), Failure> {
    let frequency_hz = found.functions[0].frequency_hz.clone();
    let mut table = Table::new(vec![Column::new("frequency_hz", "Hz", "frequency", frequency_hz)])?;
    for ((name, unit), function) in found.names.iter().zip(&found.units).zip(&found.functions) {
        let (re, im): (Vec<f64>, Vec<f64>) = function.value.iter().map(|h| (h.re, h.im)).unzip();
        table.push(Column::new(&format!("{name}.re"), unit, "real part", re))?;
        table.push(Column::new(&format!("{name}.im"), unit, "imaginary part", im))?;
        table.push(Column::new(&format!("{name}.coherence"), "", "coherence", function.coherence.clone()))?;
    }
    output::table(folder, "frf", &table, &hammer.manifest("frf")?)?;
    output::figure(folder, "frf", &measured_responses("Measured frequency responses", found))
}
