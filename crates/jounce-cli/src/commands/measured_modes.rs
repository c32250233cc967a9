//! `jounce modes --measured FILE...`

use crate::decay_arguments::DecayArguments;
use crate::failure::Failure;
use crate::hammer_arguments::{HammerArguments, print_hits};
use crate::measured_file::ends;
use crate::output::{self, line, print, with_uncertainty};
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::{Column, Table};
use jounce_measure::draw::{modal_fit, stabilisation};
use jounce_measure::modal::{
    Band, Identification, ModalSettings, Mode, Stability, identify, identify_decays, mac_matrix,
};
use jounce_measure::recording::{Issue, Quantity};
use jounce_measure::response::MeasuredResponses;
use std::path::Path;

/// Settings of the identification of modes.
#[derive(Debug, Args)]
pub struct BandArguments {
    /// Frequency band of the modes, as in 500Hz:4300Hz; by default all lines above 0.
    #[arg(long, value_name = "FROM:TO", requires = "measured")]
    between: Option<String>,
    /// Largest order of the stabilisation diagram, an integer from 2 to 400.
    #[arg(long, default_value_t = 40, requires = "measured")]
    order: usize,
}

impl BandArguments {
    fn between_hz(&self, highest: f64) -> Result<(f64, f64), Failure> {
        let Some(text) = &self.between else {
            return Ok((0.0, highest));
        };
        ends("--between", text, Unit::Frequency)
    }
}

/// Data that the modes were identified from.
struct ModeSource {
    /// Points of the mode shapes.
    outputs: Vec<String>,
    /// Points of the force, where there are several; each has a participation in a mode.
    references: Vec<String>,
    /// Responses or decays, one or more for each output.
    functions: Vec<String>,
    /// The responses of a hammer or shaker test.
    responses: Option<MeasuredResponses>,
    findings: Vec<Issue>,
}

/// Prints the modes of a hammer test, of free decays or of outputs only.
pub fn run(
    hammer: &HammerArguments,
    decay: &DecayArguments,
    band: &BandArguments,
    output: &OutputArguments,
) -> Result<(), Failure> {
    if !(2..=400).contains(&band.order) {
        return Err(Failure::usage(format!(
            "--order {}: give 2 to 400",
            band.order
        )));
    }
    let settings = ModalSettings { order: band.order };
    let (taken, found) = if decay.are_given() {
        let decays = decay.decays(&hammer.measured, &hammer.response)?;
        let found = identify_decays(&decays, band.between_hz(0.5 * decays.rate_hz)?, settings)?;
        (
            ModeSource {
                functions: decays.names(),
                outputs: decays.outputs,
                references: Vec::new(),
                responses: None,
                findings: decays.findings,
            },
            found,
        )
    } else {
        let responses = hammer.responses()?;
        let highest = responses.functions[0]
            .frequency_hz
            .last()
            .copied()
            .unwrap_or(0.0);
        let mut found = identify(&Band::of(&responses, band.between_hz(highest)?)?, settings)?;
        found
            .modes
            .iter_mut()
            .for_each(|mode| mode.without_decay(responses.window_decay_per_s));
        let MeasuredResponses {
            outputs,
            names: functions,
            findings,
            ..
        } = responses.clone();
        let references = if responses.references.len() > 1 {
            responses.references.clone()
        } else {
            Vec::new()
        };
        (
            ModeSource {
                outputs,
                references,
                functions,
                responses: Some(responses),
                findings,
            },
            found,
        )
    };
    if let Some(folder) = &output.out {
        write(folder, hammer, decay, &taken, &found)?;
    }
    if output.json {
        print(&to_json(&taken, &found));
        return Ok(());
    }
    taken.responses.iter().for_each(print_hits);
    line("mode  frequency_hz +- 95 %         damping_ratio +- 95 %");
    for (k, mode) in found.modes.iter().enumerate() {
        let frequency = with_uncertainty(mode.frequency_hz, mode.frequency_half_width_hz(), "");
        line(format!(
            "{:>4}  {frequency:<28}  {}",
            k + 1,
            with_uncertainty(mode.damping_ratio, mode.damping_half_width(), "")
        ));
    }
    if !taken.references.is_empty() {
        line(format!(
            "the force acts at {} points, which by reciprocity are also points of the shapes: {}",
            taken.references.len(),
            taken.references.join(", ")
        ));
    }
    print_doubt(&found);
    print_unexplained(&found);
    if let Some(responses) = &taken.responses {
        print_trust(responses, &found);
        print_participation(responses, &found);
    }
    Ok(())
}

/// Prints the participation of the base in each mode at each output.
fn print_participation(responses: &MeasuredResponses, found: &Identification) {
    for (k, mode) in (1..).zip(&found.modes) {
        for (output, of) in responses
            .outputs
            .iter()
            .zip(mode.base_participation(responses).unwrap_or_default())
        {
            line(
                format!(
                    "mode {k}: participation of the base at {output} {:.5} {}",
                    of.re, of.unit
                )
                .trim_end(),
            );
        }
    }
}

fn print_doubt(found: &Identification) {
    let doubtful: Vec<String> = (1..)
        .zip(&found.modes)
        .filter(|(_, mode)| mode.is_doubtful())
        .map(|(k, _)| k.to_string())
        .collect();
    if !doubtful.is_empty() {
        line(format!(
            "warning: the damping of mode {} is statistically indistinguishable from zero, so it may be noise; try a smaller --order or a narrower \
             --between: if the mode disappears, it is noise",
            doubtful.join(", ")
        ));
    }
}

/// Maximum number of peaks that are listed.
const MAX_LISTED_PEAKS: usize = 8;

fn print_unexplained(found: &Identification) {
    let peaks: Vec<String> = found
        .unexplained
        .iter()
        .take(MAX_LISTED_PEAKS)
        .map(|peak| format!("{:.6}", peak.frequency_hz))
        .collect();
    if !peaks.is_empty() {
        let more = found.unexplained.len().saturating_sub(MAX_LISTED_PEAKS);
        line(format!(
            "warning: the responses have peaks at {}{} Hz that no mode explains; try a --between around them, or a larger --order",
            peaks.join(", "),
            if more > 0 {
                format!(" and {more} more")
            } else {
                String::new()
            }
        ));
    }
}

fn print_trust(responses: &MeasuredResponses, found: &Identification) {
    if responses.window_decay_per_s > 0.0 {
        line(format!(
            "damping of the exponential window, {:.5} 1/s, was subtracted",
            responses.window_decay_per_s
        ));
    }
    if responses.block_s.is_none() {
        line(
            "response functions contain no noise estimate; the intervals are computed from the residual of each line",
        );
    }
    if found.misfit > 1.0 && responses.block_s.is_some() {
        line(format!(
            "the residual of the modes is {:.1} times that expected from the coherence; the intervals are widened by this factor",
            found.misfit.sqrt()
        ));
    }
}

/// Converts the modes with their shapes, normalised to 1 at the largest response.
fn to_json(taken: &ModeSource, found: &Identification) -> serde_json::Value {
    let mode = |mode: &Mode| {
        let (re, im): (Vec<f64>, Vec<f64>) = mode.shape().iter().map(|s| (s.re, s.im)).unzip();
        let moved = mode.participation.iter().take(taken.references.len());
        let (moved_re, moved_im): (Vec<f64>, Vec<f64>) = moved.map(|b| (b.re, b.im)).unzip();
        serde_json::json!({
            "frequency_hz": mode.frequency_hz,
            "frequency_deviation_hz": mode.frequency_deviation_hz,
            "damping_ratio": mode.damping_ratio,
            "damping_deviation": mode.damping_deviation,
            "quantile_95": mode.quantile_95,
            "doubtful": mode.is_doubtful(),
            "shape": { "re": re, "im": im },
            "participation": { "re": moved_re, "im": moved_im },
            "base_participation": taken.responses.as_ref().and_then(|responses| mode.base_participation(responses)),
        })
    };
    serde_json::json!({
        "modes": found.modes.iter().map(mode).collect::<Vec<_>>(),
        "responses": taken.outputs,
        "references": taken.references,
        "mac": mac_matrix(&found.modes),
        "misfit": found.misfit,
        "unexplained": found.unexplained,
        "stabilisation": found.diagram,
        "hits": taken.responses.as_ref().map_or(&[][..], |responses| &responses.hits),
        "block_s": taken.responses.as_ref().and_then(|responses| responses.block_s),
        "window_decay_per_s": taken.responses.as_ref().map_or(0.0, |responses| responses.window_decay_per_s),
        "findings": taken.findings,
    })
}

fn write(
    folder: &Path,
    hammer: &HammerArguments,
    decay: &DecayArguments,
    taken: &ModeSource,
    found: &Identification,
) -> Result<(), Failure> {
    let manifest = if decay.are_given() {
        decay.manifest(&hammer.measured)?
    } else {
        hammer.manifest("modes")?
    };
    let number = |of: &dyn Fn(&Mode) -> f64| found.modes.iter().map(of).collect::<Vec<f64>>();
    let mut table = Table::new(vec![
        Column::new(
            "frequency_hz",
            "Hz",
            "undamped natural frequency",
            number(&|mode| mode.frequency_hz),
        ),
        Column::new(
            "frequency_deviation_hz",
            "Hz",
            "standard deviation of the frequency",
            number(&|mode| mode.frequency_deviation_hz),
        ),
        Column::new(
            "damping_ratio",
            "",
            "damping ratio",
            number(&|mode| mode.damping_ratio),
        ),
        Column::new(
            "damping_deviation",
            "",
            "standard deviation of the damping ratio",
            number(&|mode| mode.damping_deviation),
        ),
        Column::new(
            "quantile_95",
            "",
            "half width of the 95 % interval in standard deviations",
            number(&|mode| mode.quantile_95),
        ),
    ])?;
    for (k, name) in taken.outputs.iter().enumerate() {
        let about = "shape, normalised to 1 at the largest response";
        table.push(Column::new(
            &format!("{name}.shape.re"),
            "",
            about,
            number(&|mode| mode.shape()[k].re),
        ))?;
        table.push(Column::new(
            &format!("{name}.shape.im"),
            "",
            about,
            number(&|mode| mode.shape()[k].im),
        ))?;
    }
    for (k, name) in taken.references.iter().enumerate() {
        let about = "participation of a force, by reciprocity the shape at its point, normalised to 1 at the largest";
        table.push(Column::new(
            &format!("{name}.participation.re"),
            "",
            about,
            number(&|mode| mode.participation[k].re),
        ))?;
        table.push(Column::new(
            &format!("{name}.participation.im"),
            "",
            about,
            number(&|mode| mode.participation[k].im),
        ))?;
    }
    output::table(folder, "modes", &table, &manifest)?;
    let mut mac = Table::new(vec![Column::new(
        "frequency_hz",
        "Hz",
        "undamped natural frequency",
        number(&|mode| mode.frequency_hz),
    )])?;
    for (k, row) in (1..).zip(mac_matrix(&found.modes)) {
        mac.push(Column::new(
            &format!("mode_{k}"),
            "",
            "modal assurance criterion with this mode",
            row,
        ))?;
    }
    output::table(folder, "modes-mac", &mac, &manifest)?;
    let stable = |stable: Stability| match stable {
        Stability::New => "new",
        Stability::Frequency => "frequency",
        Stability::Pole => "pole",
    };
    let diagram = &found.diagram;
    let table = Table::new(vec![
        Column::new(
            "order",
            "",
            "order of the denominator",
            diagram
                .iter()
                .map(|pole| pole.order as u64)
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "frequency_hz",
            "Hz",
            "frequency of the pole",
            diagram
                .iter()
                .map(|p| p.pole.frequency_hz)
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "damping_ratio",
            "",
            "damping ratio of the pole",
            diagram
                .iter()
                .map(|p| p.pole.damping_ratio)
                .collect::<Vec<_>>(),
        ),
        Column::new(
            "stable",
            "",
            "agreement with the order below",
            diagram
                .iter()
                .map(|p| stable(p.stable).to_owned())
                .collect::<Vec<_>>(),
        ),
    ])?;
    output::table(folder, "modes-stabilisation", &table, &manifest)?;
    output::figure(
        folder,
        "modes-stabilisation",
        &stabilisation("Stabilisation diagram", found),
    )?;
    let title = match &taken.responses {
        None => "One-sided spectra",
        Some(responses)
            if responses
                .inputs
                .iter()
                .all(|input| *input == Quantity::Force) =>
        {
            "Displacement per force"
        }
        Some(_) => "Displacement, or voltage, per input",
    };
    output::figure(
        folder,
        "modes-fit",
        &modal_fit(
            &format!("{title}: measured and reconstructed from the modes"),
            &taken.functions,
            found,
        ),
    )
}
