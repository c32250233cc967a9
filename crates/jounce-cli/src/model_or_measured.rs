//! Arguments of a command with two questions: one about a spec, one about recordings.

use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

/// Arguments of both questions. An option of both, such as `--input`, is one argument with the help
/// of the second.
#[derive(Debug)]
pub struct ModelOrMeasured<A, B> {
    /// Options of the question about a spec.
    pub model: A,
    /// Arguments of the question about recordings.
    pub measured: B,
}

impl<A: Args, B: Args> Args for ModelOrMeasured<A, B> {
    fn augment_args(command: Command) -> Command {
        // The arguments get their order in the help from `command`.
        let empty = || Command::new("").next_display_order(None);
        let (model, measured) = (A::augment_args(empty()), B::augment_args(empty()));
        let is_shared = |one: &Arg| {
            let mut others = measured.get_arguments();
            others.any(|other| other.get_id() == one.get_id())
        };
        let own = model.get_arguments().filter(|one| !is_shared(one));
        command
            .args(own.cloned().collect::<Vec<_>>())
            .args(measured.get_arguments().cloned())
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<A: FromArgMatches, B: FromArgMatches> FromArgMatches for ModelOrMeasured<A, B> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
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
