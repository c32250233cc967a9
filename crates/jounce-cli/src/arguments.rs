//! Commands of the command line.

use crate::commands::{
    basins, bifurcations, branch, check, cite, completions, contact, design, diagram, ensemble,
    explore, export, fit, frf, import, materials, modes, new, noise, power, read, reproduce, rerun,
    restitution, rig, run, segments, sensitivity, show, spectra, study, sweep,
};
use clap::{Parser, Subcommand};

/// Simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
///
/// Exit codes: 0 success, 1 a different result (`rerun`), 2 wrong usage, 3 not converged (`branch` and `bifurcations`: no branch
/// or curve is complete; `design`: no design keeps the limits), 4 invalid input, or an output
/// that cannot be written, 130 stopped by the user.
#[derive(Debug, Parser)]
#[command(name = "jounce", version, max_term_width = 110)]
pub struct Arguments {
    /// Command to run.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Writes a commented template of a spec, one for each kind of harvester.
    New(new::New),
    /// Reads a spec and reports every fault in it.
    Check(check::Check),
    /// Lists the publications behind the harvester, its models and the methods that it admits, as text
    /// or BibTeX.
    Cite(cite::Cite),
    /// Draws the harvester to scale, which makes wrong numbers visible.
    Show(show::Show),
    /// Computes natural frequencies, damping ratios and coupling factors of a spec, or identifies
    /// modes from a hammer test, shaker test, free decays or outputs only.
    Modes(modes::Modes),
    /// Computes frequency response functions without contact in closed form, or estimates them from
    /// a hammer test.
    Frf(frf::Frf),
    /// Computes the exact response to stationary noise without contact: mean powers, rms values,
    /// bandwidths and gap crossing rates.
    Noise(noise::Noise),
    /// Integrates one run and reports its mean power and energy balance.
    Run(run::Run),
    /// Runs the model at every value of a key.
    Sweep(sweep::Sweep),
    /// Continues every branch of periodic orbits over a range of a key, stable or unstable.
    Branch(branch::Branch),
    /// Continues bifurcation curves (folds, period doublings, grazings) in two keys.
    #[command(alias = "jumps")]
    Bifurcations(bifurcations::Bifurcations),
    /// Computes a bifurcation diagram, stepped or from many starts, and plots it over the continued
    /// branches.
    Diagram(diagram::Diagram),
    /// Finds the attractors, the share of random starts that reach each, and the expected power.
    Basins(basins::Basins),
    /// Computes the derivatives of the results of a periodic orbit with respect to keys of the spec.
    Sensitivity(sensitivity::Sensitivity),
    /// Integrates realisations of noise and reports the mean power with its confidence interval.
    Ensemble(ensemble::Ensemble),
    /// Opens a page in the browser with sliders for the keys; the drawing and curves follow every
    /// change.
    Explore(explore::Explore),
    /// Computes one quantity at many points over the keys of a spec, in parts that several
    /// processes can share.
    Study(study::Study),
    /// Searches the values of keys with the largest power within limits, and examines the best
    /// design.
    Design(design::Design),
    /// Computes the tables, figures and claims of the 2019 impact-harvester paper.
    Reproduce(reproduce::Reproduce),
    /// Makes a stored table or picture again from its record and compares it bit by bit.
    Rerun(rerun::Rerun),
    /// Writes the model for other programs: as matrices, or as an equivalent circuit for SPICE.
    Export(export::Export),
    /// Reduces mass and stiffness matrices of another program to a structure given by its modes.
    Import(import::Import),
    /// Reads a recording of any supported format and reports its contents and its data-quality
    /// issues.
    Read(read::Read),
    /// Computes the mean power of a recorded voltage, with a confidence interval that accounts for
    /// correlation.
    Power(power::Power),
    /// Computes contact time, exponent, restitution and stiffness from the force pulses of a
    /// hammer.
    Contact(contact::Contact),
    /// Segments a recording by steady-state response and matches each segment to an attractor of
    /// the model.
    Segments(segments::Segments),
    /// Computes power spectral density, order lines and spectrogram of a recorded channel.
    Spectra(spectra::Spectra),
    /// Fits keys of a spec to measured modes, frequency responses, powers, jumps and time
    /// histories, with confidence intervals.
    Fit(fit::Fit),
    /// Simulates a hammer test or a shaker test with sensors, so that the true parameters are
    /// known.
    Rig(Box<rig::Rig>),
    /// Estimates the coefficient of restitution of a ball on a stop from their materials.
    Restitution(restitution::Restitution),
    /// Lists the materials that a spec can name, with their sources.
    Materials(materials::Materials),
    /// Prints the JSON Schema (draft-07) of a spec, for editors.
    Schema,
    /// Prints the reference of all keys of a spec, in Markdown.
    Keys,
    /// Prints a completion script for a shell.
    Completions(completions::Completions),
}

impl Command {
    /// True when results and faults go to stdout as JSON.
    pub fn wants_json(&self) -> bool {
        match self {
            Command::New(command) => command.json,
            Command::Check(command) => command.json,
            Command::Cite(command) => command.json,
            Command::Show(command) => command.json,
            Command::Modes(command) => command.output.json,
            Command::Fit(command) => command.output.json,
            Command::Rig(command) => command.json,
            Command::Frf(command) => command.output.json,
            Command::Noise(command) => command.output.json,
            Command::Run(command) => command.output.json,
            Command::Sweep(command) => command.output.json,
            Command::Branch(command) => command.output.json,
            Command::Bifurcations(command) => command.output.json,
            Command::Diagram(command) => command.output.json,
            Command::Basins(command) => command.output.json,
            Command::Sensitivity(command) => command.output.json,
            Command::Ensemble(command) => command.output.json,
            Command::Explore(command) => command.json,
            Command::Study(command) => command.wants_json(),
            Command::Design(command) => command.output.json,
            Command::Reproduce(command) => command.json,
            Command::Rerun(command) => command.json,
            Command::Export(command) => command.json,
            Command::Import(command) => command.json,
            Command::Read(command) => command.file.output.json,
            Command::Power(command) => command.output.json,
            Command::Contact(command) => command.file.output.json,
            Command::Segments(command) => command.file.output.json,
            Command::Spectra(command) => command.file.output.json,
            Command::Restitution(command) => command.json,
            Command::Materials(command) => command.json,
            Command::Schema | Command::Keys | Command::Completions(_) => false,
        }
    }
}
