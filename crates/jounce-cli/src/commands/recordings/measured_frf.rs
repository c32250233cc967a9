//! `jounce frf --measured FILE...`

use crate::failure::Failure;
use crate::hammer_arguments::HammerArguments;
use crate::measured_file::{or_issues, print_issues};
use crate::output::{self, line};
use crate::spec_arguments::OutputArguments;
use jounce::{MeasuredFrfResult, Recording};

/// Prints the responses of a hammer test.
pub fn run(hammer: &HammerArguments, output: &OutputArguments) -> Result<(), Failure> {
    let recordings = hammer.recordings()?;
    let result = Recording::measured_frf(&recordings, &hammer.options);
    let result = or_issues(result, &recordings)?;
    print_issues(result.used_issues());
    if let Some(folder) = &output.out {
        let manifest = hammer.manifest("frf")?;
        output::table(folder, "frf", &result.table()?, &manifest)?;
        output::figure(folder, "frf", &result.figure())?;
    }
    match output.json {
        true => line(output::to_json(&result)?),
        false => print_lines(&result),
    }
    Ok(())
}

/// Prints the result as lines of text.
fn print_lines(result: &MeasuredFrfResult) {
    result.hit_lines().iter().for_each(line);
    for response in &result.responses {
        let Some((k, size)) = response.highest() else {
            continue;
        };
        let per_g = response.per_g.as_ref().map_or_else(String::new, |per_g| {
            format!(" ({:.5e} {})", size * per_g.factor, per_g.unit)
        });
        let unit = match response.transmissibility {
            true => "(transmissibility)",
            false => &response.unit,
        };
        let (name, frequency_hz) = (&response.name, result.frequency_hz[k]);
        let coherence = response.coherence[k];
        line(format!(
            "{name}: highest {size:.5e} {unit}{per_g} at {frequency_hz:.4} Hz, coherence {coherence:.5}"
        ));
    }
}
