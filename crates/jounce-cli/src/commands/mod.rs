//! One file per command, in folders by what a command computes.

pub mod completions;
pub mod explore;
mod linear;
mod orbits;
mod recordings;
pub mod reproduce;
pub mod rerun;
mod runs;
mod specs;

pub use linear::{frf, modes, noise};
pub use orbits::{basins, bifurcations, branch, diagram, sensitivity};
pub use recordings::{contact, fit, power, read, rig, segments, spectra};
pub use runs::{design, ensemble, run, study, sweep};
pub use specs::{check, cite, export, import, materials, new, restitution, show};

use crate::arguments::Command;
use crate::failure::Failure;
use crate::output::line;

/// Runs a command.
pub fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::New(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::Cite(command) => command.run(),
        Command::Show(command) => command.run(),
        Command::Modes(command) => command.run(),
        Command::Fit(command) => command.run(),
        Command::Rig(command) => command.run(),
        Command::Frf(command) => command.run(),
        Command::Noise(command) => command.run(),
        Command::Run(command) => command.run(),
        Command::Sweep(command) => command.run(),
        Command::Branch(command) => command.run(),
        Command::Bifurcations(command) => command.run(),
        Command::Diagram(command) => command.run(),
        Command::Basins(command) => command.run(),
        Command::Sensitivity(command) => command.run(),
        Command::Ensemble(command) => command.run(),
        Command::Study(command) => command.run(),
        Command::Design(command) => command.run(),
        Command::Explore(command) => command.run(),
        Command::Reproduce(command) => command.run(),
        Command::Rerun(command) => command.run(),
        Command::Export(command) => command.run(),
        Command::Import(command) => command.run(),
        Command::Read(command) => command.run(),
        Command::Power(command) => command.run(),
        Command::Contact(command) => command.run(),
        Command::Segments(command) => command.run(),
        Command::Spectra(command) => command.run(),
        Command::Restitution(command) => command.run(),
        Command::Materials(command) => command.run(),
        Command::Completions(command) => command.run(),
        Command::Schema => {
            line(format!("{:#}", jounce::schema()));
            Ok(())
        }
        Command::Keys => {
            line(jounce::key_reference());
            Ok(())
        }
    }
}
