//! `jounce modes --measured FILE...`

use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::measured_file::{or_issues, print_issues};
use crate::option_names::on_command_line;
use crate::output::{self, line, with_uncertainty};
use crate::spec_arguments::OutputArguments;
use jounce::{Error, MeasuredModesOptions, MeasuredModesResult, Recording};
use std::path::Path;

/// Prints the modes of a hammer test, of free decays or of outputs only.
pub fn run(
    hammer: &HammerArguments,
    options: &MeasuredModesOptions,
    output: &OutputArguments,
) -> Result<(), Failure> {
    let recordings = hammer.recordings()?;
    let result = Recording::measured_modes(&recordings, &hammer.options, options);
    let result = or_issues(result, &recordings)?;
    print_issues(result.used_issues());
    if let Some(folder) = &output.out {
        write(folder, hammer, options, &result)?;
    }
    match output.json {
        true => line(output::to_json(&result)?),
        false => print_lines(&result),
    }
    Ok(())
}

fn write(
    folder: &Path,
    hammer: &HammerArguments,
    options: &MeasuredModesOptions,
    result: &MeasuredModesResult,
) -> Result<(), Failure> {
    let manifest = hammer.manifest("modes")?;
    let manifest = manifest.with_options(options).map_err(Error::from)?;
    output::table(folder, "modes", &result.table()?, &manifest)?;
    output::table(folder, "modes-mac", &result.mac_table()?, &manifest)?;
    let diagram = result.stabilisation_table()?;
    output::table(folder, "modes-stabilisation", &diagram, &manifest)?;
    output::figure(folder, "modes-stabilisation", &result.figure())?;
    output::figure(folder, "modes-fit", &result.fit_figure())
}

/// Prints the result as lines of text.
fn print_lines(result: &MeasuredModesResult) {
    let hits = result.frf.iter().flat_map(|frf| frf.hit_lines());
    hits.for_each(line);
    line("mode  frequency_hz +- 95 %         damping_ratio +- 95 %");
    for (number, mode) in (1..).zip(&result.modes) {
        let frequency = with_uncertainty(mode.frequency_hz, mode.frequency_half_width_hz(), "");
        let damping = with_uncertainty(mode.damping_ratio, mode.damping_half_width(), "");
        line(format!("{number:>4}  {frequency:<28}  {damping}"));
    }
    let references = &result.references;
    if !references.is_empty() {
        line(format!(
            "the force acts at {} points, which by reciprocity are also points of the shapes: {}",
            references.len(),
            references.join(", ")
        ));
    }
    for warning in result.warnings() {
        line(format!("warning: {}", on_command_line(&warning)));
    }
    result.notes().iter().for_each(line);
    for (number, mode) in (1..).zip(&result.modes) {
        let values = mode.base_participation.iter().flatten();
        for (output, value) in result.responses.iter().zip(values) {
            let text = format!(
                "mode {number}: participation of the base at {output} {:.5} {}",
                value.re, value.unit
            );
            line(text.trim_end());
        }
    }
}
