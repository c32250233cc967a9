//! `jounce modes --measured FILE...`

use crate::decay_arguments::DecayArguments;
use crate::failure::Failure;
use crate::hammer_arguments::{HammerArguments, print_hits};
use crate::measured_file::parse_interval;
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
        parse_interval("--between", text, Unit::Frequency)
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
    let (source, identification) = if decay.are_given() {
        let decays = decay.decays(&hammer.measured, &hammer.response)?;
        let identification =
            identify_decays(&decays, band.between_hz(0.5 * decays.rate_hz)?, settings)?;
        (
            ModeSource {
                functions: decays.names(),
                outputs: decays.outputs,
                references: Vec::new(),
                responses: None,
                findings: decays.findings,
            },
            identification,
        )
    } else {
        let responses = hammer.responses()?;
        let highest = responses.functions[0]
            .frequency_hz
            .last()
            .copied()
            .unwrap_or(0.0);
        let mut identification =
            identify(&Band::of(&responses, band.between_hz(highest)?)?, settings)?;
        identification
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
            identification,
        )
    };
    if let Some(folder) = &output.out {
        write(folder, hammer, decay, &source, &identification)?;
    }
    if output.json {
        print(&to_json(&source, &identification));
        return Ok(());
    }
    source.responses.iter().for_each(print_hits);
    line("mode  frequency_hz +- 95 %         damping_ratio +- 95 %");
    for (k, mode) in identification.modes.iter().enumerate() {
        let frequency = with_uncertainty(mode.frequency_hz, mode.frequency_half_width_hz(), "");
        line(format!(
            "{:>4}  {frequency:<28}  {}",
            k + 1,
            with_uncertainty(mode.damping_ratio, mode.damping_half_width(), "")
        ));
    }
    if !source.references.is_empty() {
        line(format!(
            "the force acts at {} points, which by reciprocity are also points of the shapes: {}",
            source.references.len(),
            source.references.join(", ")
        ));
    }
    print_doubtful_modes(&identification);
    print_unexplained(&identification);
    if let Some(responses) = &source.responses {
        print_model_check(responses, &identification);
        print_participation(responses, &identification);
    }
    Ok(())
}

/// Prints the participation of the base in each mode at each output.
fn print_participation(responses: &MeasuredResponses, identification: &Identification) {
    for (k, mode) in (1..).zip(&identification.modes) {
        for (output, value) in responses
            .outputs
            .iter()
            .zip(mode.base_participation(responses).unwrap_or_default())
        {
            line(
                format!(
                    "mode {k}: participation of the base at {output} {:.5} {}",
                    value.re, value.unit
                )
                .trim_end(),
            );
        }
    }
}

fn print_doubtful_modes(identification: &Identification) {
    let doubtful_modes: Vec<String> = (1..)
        .zip(&identification.modes)
        .filter(|(_, mode)| mode.is_doubtful())
        .map(|(k, _)| k.to_string())
        .collect();
    if !doubtful_modes.is_empty() {
        line(format!(
            "warning: the damping of mode {} is statistically indistinguishable from zero, so it may be noise; try a smaller --order or a narrower \
             --between: if the mode disappears, it is noise",
            doubtful_modes.join(", ")
        ));
    }
}

/// Maximum number of peaks that are listed.
const MAX_LISTED_PEAKS: usize = 8;

fn print_unexplained(identification: &Identification) {
    let peaks: Vec<String> = identification
        .unexplained
        .iter()
        .take(MAX_LISTED_PEAKS)
        .map(|peak| format!("{:.6}", peak.frequency_hz))
        .collect();
    if !peaks.is_empty() {
        let remaining_count = identification
            .unexplained
            .len()
            .saturating_sub(MAX_LISTED_PEAKS);
        line(format!(
            "warning: the responses have peaks at {}{} Hz that no mode explains; try a --between around them, or a larger --order",
            peaks.join(", "),
            if remaining_count > 0 {
                format!(" and {remaining_count} more")
            } else {
                String::new()
            }
        ));
    }
}

fn print_model_check(responses: &MeasuredResponses, identification: &Identification) {
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
    if identification.misfit > 1.0 && responses.block_s.is_some() {
        line(format!(
            "the residual of the modes is {:.1} times that expected from the coherence; the intervals are widened by this factor",
            identification.misfit.sqrt()
        ));
    }
}

/// Converts the modes with their shapes, normalised to 1 at the largest response.
fn to_json(source: &ModeSource, identification: &Identification) -> serde_json::Value {
    let mode = |mode: &Mode| {
        let (re, im): (Vec<f64>, Vec<f64>) = mode.shape().iter().map(|s| (s.re, s.im)).unzip();
        let participation = mode.participation.iter().take(source.references.len());
        let (participation_re, participation_im): (Vec<f64>, Vec<f64>) =
            participation.map(|b| (b.re, b.im)).unzip();
        serde_json::json!({
            "frequency_hz": mode.frequency_hz,
            "frequency_deviation_hz": mode.frequency_deviation_hz,
            "damping_ratio": mode.damping_ratio,
            "damping_deviation": mode.damping_deviation,
            "quantile_95": mode.quantile_95,
            "doubtful": mode.is_doubtful(),
            "shape": { "re": re, "im": im },
            "participation": { "re": participation_re, "im": participation_im },
            "base_participation": source.responses.as_ref().and_then(|responses| mode.base_participation(responses)),
        })
    };
    serde_json::json!({
        "modes": identification.modes.iter().map(mode).collect::<Vec<_>>(),
        "responses": source.outputs,
        "references": source.references,
        "mac": mac_matrix(&identification.modes),
        "misfit": identification.misfit,
        "unexplained": identification.unexplained,
        "stabilisation": identification.diagram,
        "hits": source.responses.as_ref().map_or(&[][..], |responses| &responses.hits),
        "block_s": source.responses.as_ref().and_then(|responses| responses.block_s),
        "window_decay_per_s": source.responses.as_ref().map_or(0.0, |responses| responses.window_decay_per_s),
        "findings": source.findings,
    })
}

fn write(
    folder: &Path,
    hammer: &HammerArguments,
    decay: &DecayArguments,
    source: &ModeSource,
    identification: &Identification,
) -> Result<(), Failure> {
    let manifest = if decay.are_given() {
        decay.manifest(&hammer.measured)?
    } else {
        hammer.manifest("modes")?
    };
    let number =
        |value: &dyn Fn(&Mode) -> f64| identification.modes.iter().map(value).collect::<Vec<f64>>();
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
    for (k, name) in source.outputs.iter().enumerate() {
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
    for (k, name) in source.references.iter().enumerate() {
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
    for (k, row) in (1..).zip(mac_matrix(&identification.modes)) {
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
    let diagram = &identification.diagram;
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
        &stabilisation("Stabilisation diagram", identification),
    )?;
    let title = match &source.responses {
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
            &source.functions,
            identification,
        ),
    )
}
