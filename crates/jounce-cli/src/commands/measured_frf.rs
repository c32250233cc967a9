//! `jounce frf --measured FILE...`

use crate::failure::Failure;
use crate::hammer_arguments::{HammerArguments, print_hits};
use crate::output::{self, line, print};
use crate::spec_arguments::OutputArguments;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::measured_responses;
use jounce_measure::response::MeasuredResponses;
use jounce_measure::spectral::FrequencyResponse;
use std::path::Path;

/// Prints the responses of a hammer test.
pub fn run(hammer: &HammerArguments, output: &OutputArguments) -> Result<(), Failure> {
    let responses = hammer.responses()?;
    if let Some(folder) = &output.out {
        write(folder, hammer, &responses)?;
    }
    if output.json {
        let references = responses.references.len().max(1);
        let response_json = |(k, function): (usize, &FrequencyResponse)| {
            let (re, im): (Vec<f64>, Vec<f64>) =
                function.value.iter().map(|h| (h.re, h.im)).unzip();
            let response = serde_json::json!({
                "re": re,
                "im": im,
                "unit": responses.units[k],
                "per_g": responses.per_g(k).map(|(factor, unit)| serde_json::json!({ "factor": factor, "unit": unit })),
                "transmissibility": responses.is_transmissibility(k),
                "coherence": function.coherence,
                "output": responses.outputs[k / references],
                "reference": responses.references.get(k % references),
            });
            (responses.names[k].clone(), response)
        };
        let response_map: serde_json::Map<String, serde_json::Value> = responses
            .functions
            .iter()
            .enumerate()
            .map(response_json)
            .collect();
        print(&serde_json::json!({
            "frequency_hz": responses.functions[0].frequency_hz,
            "responses": response_map,
            "input": responses.input,
            "outputs": responses.outputs,
            "references": responses.references,
            "hits": responses.hits,
            "block_s": responses.block_s,
            "window_decay_per_s": responses.window_decay_per_s,
            "findings": responses.findings,
        }));
        return Ok(());
    }
    print_hits(&responses);
    for (number, ((name, unit), function)) in responses
        .names
        .iter()
        .zip(&responses.units)
        .zip(&responses.functions)
        .enumerate()
    {
        let lines = function.value.iter().enumerate().skip(1);
        if let Some((k, highest)) = lines.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) {
            let (frequency_hz, coherence, size) = (
                function.frequency_hz[k],
                function.coherence[k],
                highest.norm(),
            );
            let per_g = responses
                .per_g(number)
                .map_or_else(String::new, |(factor, unit)| {
                    format!(" ({:.5e} {unit})", size * factor)
                });
            let unit = if responses.is_transmissibility(number) {
                "(transmissibility)"
            } else {
                unit
            };
            line(format!(
                "{name}: highest {size:.5e} {unit}{per_g} at {frequency_hz:.4} Hz, coherence {coherence:.5}"
            ));
        }
    }
    Ok(())
}

fn write(
    folder: &Path,
    hammer: &HammerArguments,
    responses: &MeasuredResponses,
) -> Result<(), Failure> {
    let frequency_hz = responses.functions[0].frequency_hz.clone();
    let mut table = Table::new(vec![Column::new(
        "frequency_hz",
        "Hz",
        "frequency",
        frequency_hz,
    )])?;
    for ((name, unit), function) in responses
        .names
        .iter()
        .zip(&responses.units)
        .zip(&responses.functions)
    {
        let (re, im): (Vec<f64>, Vec<f64>) = function.value.iter().map(|h| (h.re, h.im)).unzip();
        table.push(Column::new(&format!("{name}.re"), unit, "real part", re))?;
        table.push(Column::new(
            &format!("{name}.im"),
            unit,
            "imaginary part",
            im,
        ))?;
        table.push(Column::new(
            &format!("{name}.coherence"),
            "",
            "coherence",
            function.coherence.clone(),
        ))?;
    }
    output::table(folder, "frf", &table, &hammer.manifest("frf")?)?;
    output::figure(
        folder,
        "frf",
        &measured_responses("Measured frequency responses", responses),
    )
}
