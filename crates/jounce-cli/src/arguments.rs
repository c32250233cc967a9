//! What can be typed.

use crate::commands::{
    basins, branch, check, completions, contact, diagram, ensemble, explore, fit, frf, jumps,
    materials, modes, new, noise, power, read, reproduce, rig, run, segments, show, spectra, study,
    sweep,
};
use clap::{Parser, Subcommand};

/// Simulates, analyses and designs vibro-impact piezoelectric energy harvesters.
///
/// Exit codes: 0 done, 2 wrong usage, 3 not converged (of `branch` and `jumps`: no part of the answer whole), 4 invalid input.
#[derive(Debug, Parser)]
#[command(name = "jounce", version, max_term_width = 110)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Writes a commented spec to start from, one per kind of harvester.
    New(new::New),
    /// Reads a spec and reports every fault in it.
    Check(check::Check),
    /// Draws the harvester to scale, so that a wrong number is seen.
    Show(show::Show),
    /// Natural frequencies, damping ratios and coupling factors of a spec, or the modes of a hammer or shaker test, of free decays, or of
    /// outputs alone.
    Modes(modes::Modes),
    /// Frequency response functions without contact, in closed form, or those of a hammer test.
    Frf(frf::Frf),
    /// Exact answer to stationary noise without contact: mean powers, rms values, bandwidths, how often a gap would be reached.
    Noise(noise::Noise),
    /// Marches one run and reports its mean power and its energy balance.
    Run(run::Run),
    /// Marches a run at every value of a key.
    Sweep(sweep::Sweep),
    /// Follows every branch of periodic answers over a range of a key, stable or not.
    Branch(branch::Branch),
    /// Follows the places where the answer jumps (folds, doublings, grazings) over two keys.
    Jumps(jumps::Jumps),
    /// Marches a bifurcation diagram, stepped or from many starts, and lays it over the continued branches.
    Diagram(diagram::Diagram),
    /// Finds the attractors, the share of random starts that each takes, and the power to be expected.
    Basins(basins::Basins),
    /// Marches realisations of noise and reports the mean power with its interval.
    Ensemble(ensemble::Ensemble),
    /// Opens a page in the browser whose drawing and curves follow every slider.
    Explore(explore::Explore),
    /// Computes one quantity at many points over the keys of a spec, in parts that any number of processes share.
    Study(study::Study),
    /// Computes the tables, figures and claims of the 2019 impact-harvester paper.
    Reproduce(reproduce::Reproduce),
    /// Reads a recording of any format and tells what is in it and what is odd about it.
    Read(read::Read),
    /// Mean power of a recorded voltage, with an interval that respects correlation.
    Power(power::Power),
    /// Contact time, exponent, restitution and stiffness from the force pulses of a hammer.
    Contact(contact::Contact),
    /// Cuts a long recording into stretches of one solution each, and names the solution of a model that each shows.
    Regimes(segments::Segments),
    /// Power spectral density, order lines and spectrogram of a recorded channel.
    Spectra(spectra::Spectra),
    /// Fits keys of a spec to what was measured (modes, frequency responses, powers, jumps, time histories), with intervals.
    Fit(fit::Fit),
    /// Records a model as the sensors of a rig would, hammer test or run, so that the truth is known.
    Rig(rig::Rig),
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
    /// True when answers and faults go to stdout as JSON.
    pub fn wants_json(&self) -> bool {
        match self {
            Command::New(command) => command.json,
            Command::Check(command) => command.output.json,
            Command::Show(command) => command.json,
            Command::Modes(command) => command.output.json,
            Command::Fit(command) => command.output.json,
            Command::Rig(command) => command.json,
            Command::Frf(command) => command.output.json,
            Command::Noise(command) => command.output.json,
            Command::Run(command) => command.output.json,
            Command::Sweep(command) => command.output.json,
            Command::Branch(command) => command.output.json,
            Command::Jumps(command) => command.output.json,
            Command::Diagram(command) => command.output.json,
            Command::Basins(command) => command.output.json,
            Command::Ensemble(command) => command.output.json,
            Command::Explore(command) => command.json,
            Command::Study(command) => command.wants_json(),
            Command::Reproduce(command) => command.json,
            Command::Read(command) => command.file.output.json,
            Command::Power(command) => command.output.json,
            Command::Contact(command) => command.file.output.json,
            Command::Regimes(command) => command.file.output.json,
            Command::Spectra(command) => command.file.output.json,
            Command::Materials(command) => command.json,
            Command::Schema | Command::Keys | Command::Completions(_) => false,
        }
    }
}
