//! Questions with their names in Rust, on the command line, in Python and in studies.

use crate::basins::BasinsOptions;
use crate::bifurcations::BifurcationsOptions;
use crate::branch::BranchOptions;
use crate::contact::ContactOptions;
use crate::design::DesignOptions;
use crate::diagram::DiagramOptions;
use crate::ensemble::EnsembleOptions;
use crate::export::ExportOptions;
use crate::frf::FrfOptions;
use crate::import::ImportOptions;
use crate::measured_frf::MeasuredFrfOptions;
use crate::measured_modes::MeasuredModesOptions;
use crate::modes::ModesOptions;
use crate::noise::NoiseOptions;
use crate::options::{OptionDefinition, definitions};
use crate::power::PowerOptions;
use crate::recording::ReadOptions;
use crate::reproduce::ReproduceOptions;
use crate::restitution::RestitutionOptions;
use crate::rig::RigOptions;
use crate::run::RunOptions;
use crate::segments::SegmentsOptions;
use crate::sensitivity::SensitivityOptions;
use crate::spectra::SpectraOptions;
use crate::study::StudyOptions;
use crate::sweep::SweepOptions;
use clap::Args;
use serde::Serialize;

/// A question with its names and its options.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Question {
    /// The result, in a few words.
    pub about: &'static str,
    /// Method of the library.
    pub method: &'static str,
    /// Command of the program `jounce`.
    pub command: &'static str,
    /// Call of the Python package.
    pub python: &'static str,
    /// Name in a study; `None` for a question that a study does not compute.
    pub quantity: Option<&'static str>,
    /// Options with their definitions.
    pub options: Vec<OptionDefinition>,
}

/// Returns all questions that have options, in the order of the documentation.
///
/// ```
/// let questions = jounce::questions();
/// let run = questions.iter().find(|question| question.command == "run").unwrap();
/// assert_eq!(run.method, "Harvester::run");
/// assert!(run.options.iter().any(|option| option.name == "tolerance"));
/// ```
pub fn questions() -> Vec<Question> {
    let groups = [
        without_contact(),
        of_runs_and_orbits(),
        of_many_runs(),
        of_other_programs(),
        of_recordings(),
    ];
    groups.into_iter().flatten().collect()
}

fn question<O: Args>(
    about: &'static str,
    [method, command, python]: [&'static str; 3],
    quantity: Option<&'static str>,
) -> Question {
    Question {
        about,
        method,
        command,
        python,
        quantity,
        options: definitions::<O>(),
    }
}

/// Returns the questions about a harvester without contact.
fn without_contact() -> Vec<Question> {
    vec![
        question::<ModesOptions>(
            "natural frequencies, couplings and mode shapes",
            ["Harvester::modes", "modes", "Spec.modes"],
            Some("modes"),
        ),
        question::<FrfOptions>(
            "frequency responses without contact",
            ["Harvester::frf", "frf", "Spec.frf"],
            Some("frf"),
        ),
        question::<NoiseOptions>(
            "response to noise without contact",
            ["Harvester::noise", "noise", "Spec.noise"],
            Some("noise"),
        ),
    ]
}

/// Returns the questions about runs, periodic orbits and attractors.
fn of_runs_and_orbits() -> Vec<Question> {
    vec![
        question::<RunOptions>(
            "response from a start in time",
            ["Harvester::run", "run", "Spec.run"],
            Some("run"),
        ),
        question::<SweepOptions>(
            "responses over values of a key",
            ["Harvester::sweep", "sweep", "Spec.sweep"],
            Some("sweep"),
        ),
        question::<BranchOptions>(
            "branches of periodic orbits over a key",
            ["Harvester::branch", "branch", "Spec.branch"],
            Some("branch"),
        ),
        question::<BifurcationsOptions>(
            "bifurcation curves in two keys",
            [
                "Harvester::bifurcations",
                "bifurcations",
                "Spec.bifurcations",
            ],
            Some("bifurcations"),
        ),
        question::<DiagramOptions>(
            "bifurcation diagram over a key",
            ["Harvester::diagram", "diagram", "Spec.diagram"],
            Some("diagram"),
        ),
        question::<BasinsOptions>(
            "attractors and the share of starts that reach each",
            ["Harvester::basins", "basins", "Spec.basins"],
            Some("basins"),
        ),
        question::<SensitivityOptions>(
            "derivatives of the results of an orbit with respect to keys",
            ["Harvester::sensitivity", "sensitivity", "Spec.sensitivity"],
            None,
        ),
    ]
}

/// Returns the questions about realisations, parametric studies and simulated tests.
fn of_many_runs() -> Vec<Question> {
    vec![
        question::<EnsembleOptions>(
            "means over realisations of noise",
            ["Harvester::ensemble", "ensemble", "Spec.ensemble"],
            Some("ensemble"),
        ),
        question::<StudyOptions>(
            "one quantity over several keys",
            ["Study::run", "study run", "Study.run"],
            None,
        ),
        question::<DesignOptions>(
            "keys with the largest power within limits",
            ["Design::run", "design", "Spec.design"],
            None,
        ),
        question::<RigOptions>(
            "simulated recordings of the sensors of a test",
            ["Harvester::rig", "rig", "Spec.rig"],
            None,
        ),
        question::<ReproduceOptions>(
            "tables, figures and claims of the 2019 paper",
            ["reproduce", "reproduce", "reproduce"],
            None,
        ),
        question::<RestitutionOptions>(
            "coefficient of restitution from materials",
            ["restitution", "restitution", "restitution"],
            None,
        ),
    ]
}

/// Returns the questions about models of other programs.
fn of_other_programs() -> Vec<Question> {
    vec![
        question::<ExportOptions>(
            "the model as matrices or as a circuit",
            ["Harvester::export", "export", "Spec.export"],
            None,
        ),
        question::<ImportOptions>(
            "modes of matrices of another program",
            ["import_matrices", "import", "import_matrices"],
            None,
        ),
    ]
}

/// Returns the questions about recordings.
fn of_recordings() -> Vec<Question> {
    vec![
        question::<ReadOptions>(
            "contents of a file of an instrument",
            ["RecordedFile::read", "read", "read_recordings"],
            None,
        ),
        question::<PowerOptions>(
            "mean power of voltages over their loads",
            ["Recording::power", "power", "power"],
            None,
        ),
        question::<SpectraOptions>(
            "density, order lines and spectrogram of a channel",
            ["Recording::spectra", "spectra", "spectra"],
            None,
        ),
        question::<MeasuredFrfOptions>(
            "frequency responses of a hammer or shaker test",
            ["Recording::measured_frf", "frf", "measured_frf"],
            None,
        ),
        question::<MeasuredModesOptions>(
            "modes of a test",
            ["Recording::measured_modes", "modes", "measured_modes"],
            None,
        ),
        question::<ContactOptions>(
            "contact laws of force pulses",
            ["Recording::contact", "contact", "contact"],
            None,
        ),
        question::<SegmentsOptions>(
            "parts of a recording that show one attractor each",
            ["Recording::segments", "segments", "segments"],
            None,
        ),
    ]
}
