//! Arguments of a command with two questions: one about a spec, one about recordings.

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Arg, ArgGroup, ArgMatches, Args, Command, FromArgMatches};

/// Name of the option whose presence chooses the question about recordings.
const MEASURED: &str = "measured";

/// Arguments of both questions. An option of both, such as `--input`, is one argument with the help
/// of the second. An option of the other question is refused.
#[derive(Debug)]
pub struct ModelOrMeasured<A, B> {
    /// Arguments of the question about a spec.
    pub model: A,
    /// Arguments of the question about recordings.
    pub measured: B,
}

/// Returns the arguments and groups of a question; they get their order in the help from the
/// command that takes them.
fn question<Q: Args>() -> Command {
    Q::augment_args(Command::new("").next_display_order(None))
}

fn contains(question: &Command, argument: &Arg) -> bool {
    let mut arguments = question.get_arguments();
    arguments.any(|other| other.get_id() == argument.get_id())
}

/// Returns an error that names a given argument of the question that was not asked.
fn refuse_other<A: Args, B: Args>(matches: &ArgMatches) -> Result<(), clap::Error> {
    let is_given = |id: &str| matches.value_source(id) == Some(ValueSource::CommandLine);
    let (model, measured) = (question::<A>(), question::<B>());
    let (asked, other, reason) = match is_given(MEASURED) {
        true => (
            &measured,
            &model,
            "does not apply to recordings: omit it, or omit --measured",
        ),
        false => (
            &model,
            &measured,
            "applies to recordings: name them with --measured FILE..., or omit it",
        ),
    };
    let mut others = other.get_arguments().filter(|one| !contains(asked, one));
    let Some(argument) = others.find(|one| is_given(one.get_id().as_str())) else {
        return Ok(());
    };
    let name = match argument.get_long() {
        Some(long) => format!("--{long}"),
        None => argument.get_id().as_str().to_uppercase(),
    };
    let text = format!("{name} {reason}\n");
    Err(clap::Error::raw(ErrorKind::ArgumentConflict, text))
}

impl<A: Args, B: Args> Args for ModelOrMeasured<A, B> {
    fn augment_args(command: Command) -> Command {
        let (model, measured) = (question::<A>(), question::<B>());
        let own = model
            .get_arguments()
            .filter(|one| !contains(&measured, one));
        let groups: Vec<ArgGroup> = (model.get_groups().chain(measured.get_groups()))
            .cloned()
            .collect();
        command
            .args(own.cloned().collect::<Vec<_>>())
            .args(measured.get_arguments().cloned())
            .groups(groups)
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<A: Args, B: Args> FromArgMatches for ModelOrMeasured<A, B> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        refuse_other::<A, B>(matches)?;
        Ok(Self {
            model: A::from_arg_matches(matches)?,
            measured: B::from_arg_matches(matches)?,
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
